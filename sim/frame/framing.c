/* Framing.
 *
 * SPDX-License-Identifier: MIT
 */
#include "framing.h"

#include <string.h>

#include "sim.h"
#include "vec.h"

#define PI 3.14159265358979323846
#define MARGIN 1.05      /* air around a framed model */
#define DEPTH_MARGIN 1.01 /* radii that near and far stand off */
#define INSIDE 1000.0    /* far / near where the eye is inside the model */
#define THIN 32768.0     /* far / (far - near) that the renderer still takes, half of it */
#define FOCAL_MIN 0x1p-16
#define FOCAL_MAX 0x1p23
#define PARALLEL 0x1p-19 /* sine of the angle between --up and the view: the renderer needs 2^-20 */

/* How far a sphere's middle must be for the sphere to fit. */
static double fit_distance(const struct sim_view *v, double radius, double half_angle)
{
    const double across = atan(tan(half_angle) * v->width / v->height);
    return MARGIN * radius / sin(fmin(half_angle, across));
}

static int place_eye(struct sim_view *v, const struct sim_options *o, const struct sim_model *model,
                     double half_angle)
{
    memcpy(v->at, o->has_at ? o->at : model->center, sizeof v->at);
    if (o->has_eye) {
        memcpy(v->eye, o->eye, sizeof v->eye);
        return SIM_OK;
    }
    double off[3], dir[3] = { 0.5, 0.35, 1.0 };
    sim_sub(off, model->center, v->at);
    const double radius = model->radius + sqrt(sim_dot(off, off));
    const double distance = fit_distance(v, radius, half_angle);
    (void)sim_unit(dir);
    for (int k = 0; k < 3; k++)
        v->eye[k] = v->at[k] + distance * dir[k];
    return SIM_OK;
}

static int find_axes(struct sim_view *v, const struct sim_options *o, const char *file)
{
    double up[3];
    sim_sub(v->back, v->eye, v->at);
    if (!(sim_unit(v->back) > 0.0))
        return sim_refuse(file, 0,
                          "the eye %g,%g,%g is the point that it looks at; move --eye or --at",
                          v->eye[0], v->eye[1], v->eye[2]);
    memcpy(up, o->up, sizeof up);
    (void)sim_unit(up);
    sim_cross(v->right, up, v->back);
    if (!(sim_unit(v->right) > PARALLEL))
        return sim_refuse(file, 0, "--up %g,%g,%g is parallel to the view; give another, as 0,0,1",
                          o->up[0], o->up[1], o->up[2]);
    sim_cross(v->up, v->back, v->right);
    return SIM_OK;
}

static int find_depth(struct sim_view *v, const struct sim_options *o,
                      const struct sim_model *model)
{
    const char *file = model->file;
    double to[3];
    sim_sub(to, v->eye, model->center);
    const double z = sim_dot(to, v->back), r = DEPTH_MARGIN * model->radius;
    const double half = fmax(r, fabs(z) / THIN);
    v->near_z = z - half;
    v->far_z = z + half;
    if (!v->orthographic) {
        if (v->far_z <= 0.0) /* the model is behind the eye: nothing will be seen */
            v->far_z = r;
        v->near_z = fmax(v->near_z, v->far_z / INSIDE);
    }
    if (o->has_near)
        v->near_z = o->near_z;
    if (o->has_far)
        v->far_z = o->far_z;
    if (o->has_near && !o->has_far && v->far_z <= v->near_z)
        v->far_z = v->near_z + 2.0 * half + fabs(v->near_z);
    if (o->has_far && !o->has_near && v->near_z >= v->far_z)
        v->near_z = v->orthographic ? v->far_z - 2.0 * half : v->far_z / INSIDE;
    if (!v->orthographic && (v->far_z - v->near_z) * 65536.0 < v->far_z)
        return sim_refuse(file, 0,
                          "near %.9g and far %.9g are closer than far / 65536; move them apart",
                          v->near_z, v->far_z);
    return SIM_OK;
}

int sim_view_plan(struct sim_view *view, const struct sim_options *o, const struct sim_model *model)
{
    struct sim_view *v = view;
    const double half_angle = o->fov * PI / 360.0;
    memset(v, 0, sizeof *v);
    v->orthographic = o->projection == ZS_ORTHOGRAPHIC;
    v->width = (int)o->size[0];
    v->height = (int)o->size[1];
    v->focal = v->height / 2.0 / tan(half_angle);
    if (!(v->focal >= FOCAL_MIN && v->focal <= FOCAL_MAX))
        return sim_refuse(model->file, 0,
                          "--fov %g makes a focal length of %g px; the renderer holds %g to %g",
                          o->fov, v->focal, FOCAL_MIN, FOCAL_MAX);
    int status = place_eye(v, o, model, half_angle);
    if (status == SIM_OK)
        status = find_axes(v, o, model->file);
    if (status == SIM_OK)
        status = find_depth(v, o, model);
    if (status != SIM_OK)
        return status;
    double to[3];
    sim_sub(to, v->eye, v->at);
    v->span = 2.0 * tan(half_angle) * sqrt(sim_dot(to, to));
    for (int k = 0; k < 3; k++)
        v->light[k] =
            o->has_light ? o->light[k] : 0.8 * v->back[k] - 0.5 * v->right[k] + 0.8 * v->up[k];
    (void)sim_unit(v->light);
    return SIM_OK;
}

#define POLE 0.017 /* radians that the eye stays off the upright axis */

void sim_view_orbit(double eye[3], const struct sim_view *view, const double up[3], double yaw, double pitch,
                    double factor)
{
    const double quarter = 1.57079632679489661923;
    double axis[3] = { up[0], up[1], up[2] }, off[3], front[3];
    (void)sim_unit(axis);
    sim_sub(off, view->eye, view->at);
    const double distance = factor * sim_unit(off);
    sim_cross(front, view->right, axis); /* away from the axis, level */
    (void)sim_unit(front);
    const double now = asin(fmax(-1.0, fmin(1.0, sim_dot(off, axis))));
    const double rise = fmax(POLE - quarter, fmin(quarter - POLE, now + pitch)), level = cos(rise);
    for (int k = 0; k < 3; k++)
        eye[k] = view->at[k] +
                 distance * (level * (cos(yaw) * front[k] + sin(yaw) * view->right[k]) + sin(rise) * axis[k]);
}

enum sim_depth sim_depth_of(const struct sim_options *o, const struct sim_view *view)
{
    if (view->orthographic)
        return SIM_DEPTH_linear;
    if (o->depth != SIM_DEPTH_float && o->depth != SIM_DEPTH_DEFAULT)
        return o->depth;
    const double ratio = view->far_z / view->near_z; /* as zs_depth_float, but for the last bits of the bounds */
    return ratio <= 128.0 ? SIM_DEPTH_e3m13 : ratio <= 32768.0 ? SIM_DEPTH_e4m12 : SIM_DEPTH_e5m11;
}

const struct sim_depth_mapping sim_depths[SIM_DEPTH_DEFAULT] = {
#define ROW(name_, any_camera_) { .name = #name_, .depth = &zs_depth_##name_, .any_camera = any_camera_ },
    ZS_DEPTH_EACH(ROW)
#undef ROW
};

/* ---- Pools ----------------------------------------------------------------------------------------------------- */

#define GUARD_PX (ZS_GUARD_PX - 64.0) /* safely inside the guard band */
#define PIECES 7u                     /* triangles that clipping can make of one */
#define NEW_VERTS 9u                  /* vertices of what it makes */

int sim_view_clips(const struct sim_view *v, const double center[3], double radius)
{
    double to[3];
    sim_sub(to, center, v->eye);
    const double z = -sim_dot(to, v->back);
    const double x = fabs(sim_dot(to, v->right)) + radius, y = fabs(sim_dot(to, v->up)) + radius;
    if (z - radius <= v->near_z || z + radius >= v->far_z)
        return 1;
    const double px = v->orthographic ? v->height / v->span : v->focal / (z - radius);
    return fmax(x, y) * px > GUARD_PX;
}

struct sim_pools sim_pools_of(uint64_t n_tris, uint64_t n_verts, int clips)
{
    return (struct sim_pools){ .tris = clips ? n_tris * PIECES : n_tris,
                               .verts = n_verts + (clips ? n_tris * NEW_VERTS : 0) };
}
