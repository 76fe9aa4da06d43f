/* In passes, where it has some, and from other sides.
 *
 * SPDX-License-Identifier: MIT
 */
#define STAGE_ORBIT 1 /* stage_orbit is ours */
#include "demo_frame.h"

#include <math.h>
#include <string.h>

#include "stage.h"
#include "vec.h"

#define Q30 1073741824.0
#define STEEPEST 1.55 /* radians above or below the horizon */

static const struct demo *own;
static const char *own_name;

void sim_demo_own(const struct demo *demo, const char *name)
{
    own = demo;
    own_name = name;
}

int sim_demo_is_own(const struct demo *demo)
{
    return demo == own;
}

uint32_t sim_demo_count(void)
{
    return n_demos + n_pieces + (own != NULL);
}

const struct demo *sim_demo_at(uint32_t i)
{
    return i < n_demos ? demos[i] : i < n_demos + n_pieces ? &pieces[i - n_demos]->demo : own;
}

const char *sim_demo_name(const struct demo *demo)
{
    return demo == own ? own_name : demo->name;
}

const struct demo *sim_demo_named(const char *name)
{
    for (uint32_t i = 0; i < sim_demo_count(); i++)
        if (strcmp(sim_demo_name(sim_demo_at(i)), name) == 0)
            return sim_demo_at(i);
    return NULL;
}

const struct piece *sim_demo_piece(const struct demo *demo)
{
    for (uint32_t i = 0; i < n_pieces; i++)
        if (demo == &pieces[i]->demo)
            return pieces[i];
    return NULL;
}

void sim_demo_method(struct zs_config *config, const struct demo *demo, int method)
{
    const struct piece *piece = sim_demo_piece(demo);
    sim_method_apply(config, &sim_methods[method]);
    if (piece != NULL && piece->method != NULL)
        config->method = piece->method;
}

struct posed {
    const struct piece *piece;
    const struct demo_frame *f;
};

static int draw(void *ctx, struct zs_renderer *r, const struct zs_sink *sink)
{
    static struct zs_pass_memory memory[PIECE_PASSES_MAX];
    const struct posed *p = ctx;
    return piece_render(r, p->piece, &p->f->scene, &p->f->camera, memory, sink);
}

int sim_demo_render(struct sim_frame *frame, const struct demo *demo, const struct demo_frame *f,
                    const struct zs_config *config, const char *what, const struct zs_sink *to)
{
    struct posed posed = { sim_demo_piece(demo), f };
    const struct sim_drawing drawing = { draw, &posed, config->width, config->height, 0 };
    if (posed.piece == NULL)
        return sim_frame_render_to(frame, &f->scene, &f->camera, config, what, to);
    return sim_frame_render_by(frame, &drawing, config, what, to);
}

/* ---- From other sides -------------------------------------------------------------------------------- */

static struct sim_orbit orbit = SIM_ORBIT_HOME; /* of the piece that is posed */

/* How far the middle of the instances is along the view, between near and far. */
static double middle(const struct demo_frame *at, const double back[3])
{
    const struct zs_camera *camera = &at->camera;
    const double lo = (double)camera->z_near / 65536.0, hi = (double)camera->z_far / 65536.0;
    double sum = 0.0;
    for (uint32_t i = 0; i < at->scene.n_instances; i++)
        for (int k = 0; k < 3; k++)
            sum -= back[k] * ((double)at->scene.instance[i].pose.pos[k] - (double)camera->pos[k]);
    const double z = at->scene.n_instances > 0 ? sum / at->scene.n_instances : lo;
    return fmin(fmax(z, 2.0 * lo), hi);
}

static void rows_of(double row[3][3], const struct zs_camera *camera)
{
    for (int i = 0; i < 9; i++)
        row[i / 3][i % 3] = (double)camera->rot[i] / Q30;
    if (camera->rot[0] == 0 && camera->rot[4] == 0 && camera->rot[8] == 0 && camera->rot[2] == 0)
        row[0][0] = row[1][1] = row[2][2] = 1.0; /* no rotation */
}

/* What is z units in front of the camera, toward -back, stays there; its own axes are the rows of rot. */
static void move(struct zs_camera *camera, double row[3][3], double z, const struct sim_orbit *by)
{
    static const double up[3] = { 0.0, 1.0, 0.0 };
    const double now = asin(fmax(-1.0, fmin(1.0, row[2][1]))), most = fmax(STEEPEST, fabs(now));
    const double pitch = fmax(-most, fmin(most, now + by->pitch)) - now;
    double eye[3];
    for (int k = 0; k < 3; k++)
        eye[k] = (double)camera->pos[k] - row[2][k] * z;
    for (int i = 0; i < 3; i++)
        sim_turned(row[i], row[i], up, by->yaw);
    sim_turned(row[1], row[1], row[0], -pitch);
    sim_turned(row[2], row[2], row[0], -pitch);
    for (int k = 0; k < 3; k++)
        camera->pos[k] = (int32_t)lround(eye[k] + row[2][k] * z * by->distance);
    for (int i = 0; i < 9; i++)
        camera->rot[i] = (int32_t)lround(row[i / 3][i % 3] * Q30);
    if (by->distance > 1.0)
        camera->z_far += (int64_t)(z * (by->distance - 1.0) * 65536.0);
    else if (z > 0.0)
        camera->z_near = (int64_t)((double)camera->z_near * by->distance);
}

static int is_home(const struct sim_orbit *by)
{
    return by->yaw == 0.0 && by->pitch == 0.0 && by->distance == 1.0;
}

/* Of a piece, from where its own camera is placed. */
void stage_orbit(struct zs_camera *camera, int32_t distance)
{
    double row[3][3];
    if (is_home(&orbit))
        return;
    rows_of(row, camera);
    move(camera, row, (double)distance, &orbit);
}

void sim_demo_pose(struct demo_frame *f, const struct demo *demo, uint32_t t, uint16_t w, uint16_t h,
                   const struct sim_orbit *by)
{
    double row[3][3];
    orbit = *by;
    demo->pose(f, t, w, h);
    orbit = (struct sim_orbit)SIM_ORBIT_HOME;
    if (is_home(by) || sim_demo_piece(demo) != NULL)
        return;
    rows_of(row, &f->camera);
    move(&f->camera, row, middle(f, row[2]), by);
}
