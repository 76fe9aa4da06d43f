/* Eyes on a circle.
 *
 * SPDX-License-Identifier: MIT
 */
#include "turntable.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "framing.h"
#include "render.h"
#include "sim.h"
#include "vec.h"

#define TURN 6.28318530717958647692
#define FOV 35.0       /* degrees */
#define ELEVATION 0.36 /* radians */
#define AIR 1.06
#define FRAMED 24u /* directions that the model must be whole in */

int sim_turntable_view(struct sim_options *out, const struct sim_options *o,
                       const struct sim_model *model, uint32_t k, uint32_t n)
{
    struct sim_view view;
    double axis[3] = { o->up[0], o->up[1], o->up[2] }, from[3], to[3];
    const int status = sim_view_plan(&view, o, model);
    if (status != SIM_OK)
        return status;
    (void)sim_unit(axis);
    sim_sub(from, view.eye, view.at);
    sim_turned(to, from, axis, TURN * k / n);
    *out = *o;
    out->has_eye = out->has_at = 1;
    for (int i = 0; i < 3; i++) {
        out->at[i] = view.at[i];
        out->eye[i] = k == 0 ? view.eye[i] : view.at[i] + to[i];
    }
    return SIM_OK;
}

int sim_turntable_draw(struct sim_moving *m, struct sim_lost *lost, const struct sim_options *o,
                       const struct sim_model *model, uint32_t n)
{
    uint8_t **frame = sim_alloc(n, sizeof *frame);
    struct sim_kept_scene kept = { 0 };
    int status = SIM_OK;
    *m = (struct sim_moving){ 0, 0, n, (SIM_TURNTABLE_MS + n / 2u) / n, frame };
    m->delay_ms = m->delay_ms < 10 ? 10 : m->delay_ms;
    for (uint32_t k = 0; status == SIM_OK && k < n; k++) {
        struct sim_options view;
        struct sim_picture seen;
        status = sim_turntable_view(&view, o, model, k, n);
        if (status == SIM_OK)
            status = sim_render_model(&seen, &kept, model, &view);
        if (status != SIM_OK)
            break;
        m->width = seen.width;
        m->height = seen.height;
        frame[k] = seen.rgb;
        seen.rgb = NULL;
        sim_picture_free(&seen);
    }
    if (status == SIM_OK && lost != NULL)
        memcpy(lost, kept.scene.lost, sizeof kept.scene.lost);
    sim_kept_free(&kept);
    return status;
}

void sim_turntable_free(struct sim_moving *m)
{
    for (uint32_t k = 0; m->frame != NULL && k < m->n_frames; k++)
        free(m->frame[k]);
    free((void *)(uintptr_t)m->frame);
    memset(m, 0, sizeof *m);
}

/* ---- Framing --------------------------------------------------------------------------------- */

/* Two unit vectors across an axis: one is where the front of a model is, as far as that is across it. */
static void across(double front[3], double side[3], const double axis[3])
{
    double hint[3] = { 0.0, 0.0, 1.0 };
    if (fabs(axis[2]) > 0.9) /* what stands upright along z faces the reader along -y */
        hint[1] = -1.0, hint[2] = 0.0;
    sim_cross(side, axis, hint);
    (void)sim_unit(side);
    sim_cross(front, side, axis);
}

/* Least distance at which every point of the model is seen from a direction. tan_x, tan_y: of half the field of view.
 */
static double distance_for(const struct sim_model *model, const double at[3], const double back[3],
                           const double up[3], double tan_x, double tan_y)
{
    double right[3], above[3], most = 0.0;
    sim_cross(right, up, back);
    (void)sim_unit(right);
    sim_cross(above, back, right);
    for (uint32_t i = 0; i < model->n_points; i++) {
        double p[3];
        sim_sub(p, model->point[i], at);
        const double z = sim_dot(p, back);
        most = fmax(most,
                    z + fmax(fabs(sim_dot(p, right)) / tan_x, fabs(sim_dot(p, above)) / tan_y));
    }
    return most;
}

void sim_turntable_frame(struct sim_options *o, const struct sim_model *model)
{
    double axis[3] = { o->up[0], o->up[1], o->up[2] }, front[3], side[3], first[3] = { 0 },
           distance = 0.0;
    const double tan_y = tan(FOV / 720.0 * TURN),
                 tan_x = tan_y * (double)o->size[0] / (double)o->size[1];
    (void)sim_unit(axis);
    across(front, side, axis);
    o->fov = FOV;
    memcpy(o->at, model->center, sizeof o->at);
    for (uint32_t k = 0; k < FRAMED; k++) {
        const double angle = TURN *
                             (0.08 + (double)k / FRAMED); /* a little from the side at first */
        double back[3];
        for (int i = 0; i < 3; i++)
            back[i] = cos(ELEVATION) * (cos(angle) * front[i] + sin(angle) * side[i]) +
                      sin(ELEVATION) * axis[i];
        if (k == 0)
            memcpy(first, back, sizeof first);
        distance = fmax(distance, distance_for(model, o->at, back, axis, tan_x, tan_y));
    }
    for (int i = 0; i < 3; i++)
        o->eye[i] = o->at[i] + AIR * distance * first[i];
    o->has_eye = o->has_at = 1;
}
