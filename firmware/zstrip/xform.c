/* Vertices: mesh steps to camera units, camera units to the screen.
 *
 * Errors, in camera units (everything in view is below 2^30 of them):
 *   matrix         view, view times pose and scale are each rounded to 2^-30 of a row element, on a lever
 *                  of at most reach: about 1.3 in all, common to all vertices of a pose
 *   rounding       1/2, once, after the exact sum
 * On the screen: 2^scale_bits / z sub-pixels for each of them, and 1/2 sub-pixel of snapping.
 *
 * Vertices of two meshes that share pose and scale and stand on the same grid get the same camera
 * position, bit for bit: m, t and shift depend on pose, scale and frame alone.
 *
 * SPDX-License-Identifier: MIT
 */
#include "pipeline.h"
#include "rotation.h"

#define SHIFT_MAX 29 /* keeps t below 2^60 and each product below 2^61 */

/* Clip tests that no vertex of the instance can fail are left out. */
static void clip_needs(struct zs_xform *xf, const struct zs_renderer *r, const struct zs_bounds *b,
                       const struct zs_camera *camera)
{
    const int64_t z0 = b->c[2] - b->r - b->slack, z1 = b->c[2] + b->r + b->slack;
    int64_t side = 0;
    for (int k = 0; k < 2; k++) {
        const int64_t c = b->c[k] < 0 ? -b->c[k] : b->c[k];
        if (side < c + b->r + b->slack)
            side = c + b->r + b->slack;
    }
    const int always = r->config.skip_off & ZS_SKIP_CLIPTEST;
    xf->clip_depth = always || z0 <= camera->z_near || z1 >= camera->z_far;
    /* |x| * focal <= guard * z; world units and whole pixels, rounded against us */
    const int64_t side_w = (side >> 16) + 1;                           /* <= 2^32 */
    const int64_t guard_px = ZS_GUARD_PX - 2;
    if (r->view.perspective)
        xf->clip_guard = always || z0 <= 0 ||
                         side_w * (int64_t)((camera->focal >> 32) + 1) > guard_px * (z0 >> 16);
    else /* |x| * height_px / height <= guard */
        xf->clip_guard = always || side_w * r->config.height > guard_px * (camera->height >> 16);
}

static void light_direction(struct zs_xform *xf, const struct zs_light *light)
{
    const zs_q2_30 *rot = xf->instance->pose.rot;
    for (int k = 0; k < 3; k++) {
        int64_t sum = 0; /* transposed rotation: world to mesh */
        for (int j = 0; j < 3; j++)
            sum += (int64_t)rot[3 * j + k] * light->dir[j];
        xf->light[k] = (int32_t)zs_round_shift(sum, 30); /* <= 2^30 (1 + 2^-19) */
    }
}

int zs_xform_instance(struct zs_renderer *r, uint32_t number, const struct zs_bounds *b)
{
    struct zs_xform *xf = &r->xform;
    const struct zs_view *view = &r->view;
    const struct zs_instance *in = &r->scene->instance[number];
    const int32_t to_units = view->shift - 16;
    if (to_units >= 0 ? b->reach >= (int64_t)1 << (30 - to_units)
                      : b->reach >> -to_units >= 1 << 30)
        return 0;
    xf->instance = in;
    xf->number = (uint16_t)number;

    /* scale = mantissa * 2^exp / 2^32, mantissa in [2^30, 2^31) */
    const uint64_t scale = (uint64_t)in->mesh->scale * in->pose.scale;
    int32_t exp = 33 - zs_clz64(scale);
    const uint32_t mantissa = (uint32_t)(exp >= 0 ? scale >> exp : scale << -exp);
    if (in->mesh->pos_lo)
        exp -= 8; /* positions count in 1/256 steps */
    int32_t shift = 31 - exp - view->shift; /* m = rotation * mantissa / 2^31 */
    ZS_ASSERT(shift >= 0);
    int32_t extra = 0;
    if (shift > SHIFT_MAX) {
        extra = shift - SHIFT_MAX > 30 ? 30 : shift - SHIFT_MAX;
        shift = SHIFT_MAX;
    }
    xf->shift = (uint8_t)shift;
    zs_q2_30 both[9];
    zs_rotation_mul(both, view->rot, in->pose.rot);
    for (int k = 0; k < 9; k++)
        xf->m[k] = (int32_t)zs_round_shift((int64_t)both[k] * mantissa, 31 + extra);
    for (int k = 0; k < 3; k++) {
        int64_t at = 0; /* q2_30 * world units, |.| <= 2^60.6 */
        for (int j = 0; j < 3; j++)
            at += (int64_t)view->rot[3 * k + j] * (in->pose.pos[j] - view->pos[j]);
        xf->t[k] = zs_scale2(at, view->shift + shift - 30);
    }
    clip_needs(xf, r, b, &r->camera);
    light_direction(xf, &r->scene->light);
    return 1;
}

void zs_xform_vertex(const struct zs_xform *xf, uint32_t v, struct zs_point *out)
{
    const struct zs_mesh *mesh = xf->instance->mesh;
    int32_t p[3] = { mesh->pos[v][0], mesh->pos[v][1], mesh->pos[v][2] };
    if (mesh->pos_lo)
        for (int k = 0; k < 3; k++)
            p[k] = p[k] * 256 + mesh->pos_lo[v][k]; /* |.| <= 2^23 */
    const int32_t shift = xf->shift;
    const int64_t half = ((int64_t)1 << shift) >> 1;
    for (int k = 0; k < 3; k++) {
        const int32_t *m = &xf->m[3 * k];
        const int64_t sum = xf->t[k] + (int64_t)m[0] * p[0] + (int64_t)m[1] * p[1] +
                            (int64_t)m[2] * p[2]; /* |.| < 2^60 + 3 * 2^61 */
        out->c[k] = (int32_t)((sum + half) >> shift);
    }
}

uint32_t zs_xform_outcode(const struct zs_view *view, const struct zs_point *p)
{
    const int32_t z = p->c[2];
    uint32_t code = 0;
    if (z < view->z_near)
        return ZS_OUT_NEAR; /* the sides say nothing before the near plane */
    if (z > view->z_far)
        code = ZS_OUT_FAR;
    const int64_t limit = view->perspective ? (int64_t)view->guard * z : (int64_t)view->guard;
    const int32_t up = view->perspective ? view->scale_bits : 0;
    const int64_t x = (int64_t)p->c[0] * ((int64_t)1 << up);         /* |.| <= 2^30.1 * 2^31 */
    const int64_t y = (int64_t)p->c[1] * ((int64_t)1 << up);
    if (x < -limit)
        code |= ZS_OUT_LEFT;
    if (x > limit)
        code |= ZS_OUT_RIGHT;
    if (y < -limit)
        code |= ZS_OUT_TOP;
    if (y > limit)
        code |= ZS_OUT_BOTTOM;
    return code;
}

static uint32_t magnitude(int32_t v)
{
    return v < 0 ? 0u - (uint32_t)v : (uint32_t)v;
}

/* Magnitude first, so that a mirrored scene snaps to mirrored places. mag < 2^63, shift > 0. Saturates
 * beyond the guard band. */
static int32_t snap(uint64_t mag, int32_t shift, int32_t coarse, int32_t sign)
{
    const uint64_t half = (uint64_t)1 << (shift + coarse - 1);
    const uint64_t steps = (mag + half) >> (shift + coarse);
    const int32_t v = steps > (uint64_t)ZS_GUARD_SUBPX >> coarse ? (int32_t)ZS_GUARD_SUBPX + 1
                                                                 : (int32_t)steps << coarse;
    return sign < 0 ? -v : v;
}

int zs_xform_project(const struct zs_renderer *r, const struct zs_point *p, struct zs_vertex *out)
{
    const struct zs_view *view = &r->view;
    const int32_t z = p->c[2];
    int32_t x, y, lz = 0;
    uint32_t rcp = 0;
    if (z < view->z_near || z > view->z_far)
        return 0;
    if (view->perspective) {
        lz = zs_clz32((uint32_t)z);                               /* 1 .. 23: z in [2^8, 2^30] */
        rcp = zs_recip((uint32_t)z << lz);                        /* 2^(63 - lz) / z */
        const int32_t shift = 63 - lz - view->scale_bits;         /* 9 .. 54 */
        x = snap((uint64_t)magnitude(p->c[0]) * rcp, shift, view->snap, p->c[0]);
        y = snap((uint64_t)magnitude(p->c[1]) * rcp, shift, view->snap, p->c[1]);
    } else { /* one more bit: the shift may be 0 */
        const int32_t shift = view->scale_bits + 1;
        x = snap((uint64_t)magnitude(p->c[0]) << 1, shift, view->snap, p->c[0]);
        y = snap((uint64_t)magnitude(p->c[1]) << 1, shift, view->snap, p->c[1]);
    }
    out->x = view->cx + x;
    out->y = view->cy + y;
    out->d = r->config.depth->vertex(view, z, rcp, lz);
    return zs_abs32(x) <= ZS_GUARD_SUBPX && zs_abs32(y) <= ZS_GUARD_SUBPX;
}
