/* Instance culling: bounding spheres against the view frustum.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/cold.h"
#include "core/cull.h"
#include "core/fx.h"
#include "core/pass.h"
#include "core/primitive.h"
#include "core/rotation.h"
#include "core/usual.h"
#include "core/view.h"

#define SCALE_MAX ((uint64_t)1 << 47) /* q32_32: 32768 steps are then 2^30 world units */

static void reach_out(int64_t *reach, int64_t at, int64_t r)
{
    const int64_t far_side = zs_size64(at) + r;
    if (*reach < far_side)
        *reach = far_side;
}

ZS_RARE void zs_cull_axes(zs_q2_30 out[9], const struct zs_instance *in,
                          const struct zs_camera *camera)
{
    zs_q2_30 view[9];
    zs_view_axes(view, camera);
    zs_rotation_mul(out, view, zs_usual_rotation(in->pose.rot));
}

/* Return the bounding sphere's radius, q48_16 world units, rounded up. scale: world units of a mesh
 * step, q32_32, at most SCALE_MAX: the product is at most 2^63. */
static int64_t radius_of(const struct zs_mesh *mesh, uint64_t scale)
{
    return (int64_t)((mesh->radius + 1u) * scale >> 16) + 1;
}

static int range_ok(const struct zs_instance *in)
{
    const struct zs_pose *pose = &in->pose;
    const uint64_t scale = zs_usual_scale(in);
    return zs_within(pose->pos, 3, ZS_WORLD_MAX) && scale <= SCALE_MAX &&
           radius_of(in->mesh, scale) <= (int64_t)ZS_WORLD_MAX * 65536 &&
           zs_rotation_ok(zs_usual_rotation(pose->rot));
}

/* Compute the bounding sphere of an instance whose fields are in range. A mesh whose centre is 0
 * is not rotated for it: 300 small cubes take 6 % less on the Cortex-M3, 11 % on the M0, for 18
 * bytes. */
static int bounds(struct zs_bounds *b, const struct zs_renderer *r, const struct zs_instance *in)
{
    const struct zs_camera *const camera = &r->camera;
    const struct zs_mesh *mesh = in->mesh;
    const uint64_t scale = zs_usual_scale(in);
    const int centered = !(mesh->center[0] | mesh->center[1] | mesh->center[2]);
    zs_q2_30 view[9], both[9];
    int32_t from[3], center[3];
    zs_view_axes(view, camera);
    if (!centered)
        zs_rotation_mul(both, view, zs_usual_rotation(in->pose.rot));
    b->r = radius_of(mesh, scale);
    b->reach = 0;
    for (int k = 0; k < 3; k++) {
        from[k] = in->pose.pos[k] - camera->pos[k];
        center[k] = mesh->center[k];
    }
    for (int k = 0; k < 3; k++) {
        const int64_t at = zs_dot(view + 3 * k, from); /* <= 3 * 2^60 */
        const int64_t origin = zs_round_shift(at, 14); /* q48_16, <= 2^47.6 */
        b->c[k] = origin;
        if (!centered) { /* the offset is at most 3 * 2^45, then 2^46.6 * 2^47 / 2^46 */
            const int64_t off = zs_dot(both + 3 * k, center);
            b->c[k] += zs_mulshift_s64(off, scale, 46);
        }
        reach_out(&b->reach, b->c[k], b->r);
        reach_out(&b->reach, origin, 0);
    }
    b->slack = (b->reach >> 16) + 16; /* arithmetic errors are below 2^-26 of reach, those of the
                                         rotations below 2^-20; zs_cull_walk adds the error of
                                         rounding to camera units */
    const struct zs_primitive *const primitive = in->material->primitive;
    return primitive ? primitive->ops ? primitive->ops->widen(r, in, b) : ZS_ERR_NULL : ZS_OK;
}

int zs_cull_bounds(struct zs_bounds *b, const struct zs_renderer *r, const struct zs_instance *in)
{
    return range_ok(in) ? bounds(b, r, in) : ZS_ERR_RANGE;
}

/* Return the signed distance from a side plane, positive inside, q48_16, nearest. lateral is |x| or
 * |y|. */
static int64_t side_distance(const int32_t normal[2], int64_t lateral, int64_t z)
{
    return zs_mulshift_s64(z, (uint64_t)normal[1], 30) -
           zs_mulshift_s64(lateral, (uint64_t)normal[0], 30);
}

int zs_cull_sphere(const struct zs_bounds *b, const struct zs_camera *camera,
                   const struct zs_view *view)
{
    const int64_t r = b->r + b->slack;
    if (b->c[2] + r < camera->z_near || b->c[2] - r > camera->z_far)
        return 1;
    for (int k = 0; k < 2; k++) {
        const int64_t lateral = zs_size64(b->c[k]);
        if (view->perspective
                ? side_distance(view->side[k], lateral, b->c[2]) < -r
                : lateral - r > (k ? camera->height / 2 + 1 : zs_cull_half_width(camera, view)))
            return 1;
    }
    return 0;
}

ZS_SHARED int64_t zs_cull_half_width(const struct zs_camera *camera, const struct zs_view *view)
{
    return (camera->height / 2 + 1) * view->width / view->height + 1; /* < 2^59 */
}

int zs_cull_box(const struct zs_renderer *r, const struct zs_bounds *b, struct zs_box *box)
{
    const struct zs_view *view = &r->view;
    const int64_t reach = b->r + b->slack;
    const int32_t z[2] = { zs_view_length(view, b->c[2] - reach) - 1, /* lengths are off by 1 */
                           zs_min32(zs_view_length(view, b->c[2] + reach) + 1, view->z_far) };
    struct zs_vertex at = { 0, 0, 0 };
    if (z[0] < view->z_near || z[0] > z[1])
        return 0;
    *box = (struct zs_box){ INT32_MAX, INT32_MIN, INT32_MAX, INT32_MIN, 0 };
    for (int k = 3; k >= 0; k--) { /* corners of the sphere's bounding cube, the nearest last */
        struct zs_point p = { { 0, 0, z[k >> 1] } };
        for (int i = 0; i < 2; i++) {
            const int32_t c = zs_view_length(view, b->c[i] + (k & 1 ? reach : -reach));
            p.c[i] = (int32_t)(zs_mul_ss(c + (k & 1 ? 1 : -1), view->ratio) >> 30) + (k & 1);
        }
        (void)zs_xform_project(r, &p, &at); /* 0: outside the guard band, so outside the frame */
        box->x0 = zs_min32(box->x0, (at.x >> ZS_SUBPX_BITS) - 1);
        box->x1 = zs_max32(box->x1, (at.x >> ZS_SUBPX_BITS) + 2);
        box->y0 = zs_min32(box->y0, (at.y >> ZS_SUBPX_BITS) - 1);
        box->y1 = zs_max32(box->y1, (at.y >> ZS_SUBPX_BITS) + 2);
    }
    box->nearest = at.d;
    return 1;
}

int zs_cull_walk(struct zs_bounds *b, const struct zs_renderer *r, uint32_t number)
{
    (void)bounds(b, r, zs_instance_of(r, number)); /* zs_frame_begin has checked it */
    /* -3 .. 30; from 20 on, the 1 below dominates */
    const int32_t shift = zs_min32(r->view.shift, 28);
    b->slack += ((8 << 19) >> (shift + 3)) + 1; /* 8 camera units: the error of a vertex */
    return zs_cull_sphere(b, &r->camera, &r->view);
}
