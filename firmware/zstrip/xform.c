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

#define SHIFT_MAX 29 /* keeps t below 2^60, and shift_high 14 */
#define SPLIT_MAX 15

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
            sum += zs_mul_ss(rot[3 * j + k], light->dir[j]);
        xf->light[k] = (int32_t)zs_round_shift(sum, 30); /* <= 2^30 (1 + 2^-19) */
    }
}

/* m in row k, column j. |m| <= 2^30 */
static void axis_factor(struct zs_xform *xf, int k, int j, int32_t m)
{
    const int32_t s = (int32_t)xf->shift_low;
    const int32_t high = (m + ((1 << s) >> 1)) >> s;
    xf->axis[k].high[j] = high;
    xf->axis[k].low[j] = m - high * (1 << s);
}

/* t in row k, rounding added. |t| < 2^60 + 2^28, |t / 2^shift| < 2^30 + 1. A shift of at most 15 leaves t_low in
 * [0, 2^15), a larger one in [-2^28, 2^28). */
static void axis_set(struct zs_xform *xf, int k, int64_t t)
{
    const uint32_t shift = xf->shift_low + xf->shift_high;
    const int64_t rounded = xf->shift_high ? t + ((int64_t)1 << (shift - 1)) : t;
    xf->axis[k].t_high = (int32_t)(rounded >> shift);
    xf->axis[k].t_low = (int32_t)(t - xf->axis[k].t_high * ((int64_t)1 << shift));
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
    xf->shift_low = (uint32_t)(shift < SPLIT_MAX ? shift : SPLIT_MAX);
    xf->shift_high = (uint32_t)shift - xf->shift_low;
    zs_q2_30 both[9];
    zs_rotation_mul(both, view->rot, in->pose.rot);
    for (int k = 0; k < 3; k++) {
        int64_t at = 0; /* q2_30 * world units, |.| <= 2^60.6 */
        for (int j = 0; j < 3; j++)
            at += zs_mul_ss(view->rot[3 * k + j], in->pose.pos[j] - view->pos[j]);
        axis_set(xf, k, zs_scale2(at, view->shift + shift - 30) + (((int64_t)1 << shift) >> 1));
        for (int j = 0; j < 3; j++)
            axis_factor(xf, k, j, (int32_t)zs_round_shift(zs_mul_su(both[3 * k + j], mantissa), 31 + extra));
    }
    clip_needs(xf, r, b, &r->camera);
    light_direction(xf, &r->scene->light);
    return 1;
}

/* ---- Vertices --------------------------------------------------------------------------------------- */

/* (m . p + t) >> shift, exactly. With m = high 2^s + low, t = t_high 2^shift + t_low, the sum is
 *   high . p 2^s + (low . p + t_low) + t_high 2^shift
 * and floors follow each other: the bracket gives its part above 2^s to the first sum. With a shift of 15 or less, s is
 * the shift and all is modulo 2^32, as the result is. With a larger one s is 15, and the sum of high fits: a row of
 * the matrix is no longer than 2^30 (1 + 2^-18), p no longer than 2^15 sqrt 3. */
static inline int32_t along(const struct zs_xform *xf, const struct zs_axis *a, int32_t x, int32_t y, int32_t z)
{
    const int32_t low = a->low[0] * x + a->low[1] * y + a->low[2] * z + a->t_low; /* |.| <= 3 * 2^29 + 2^28 */
    const uint32_t high = (uint32_t)a->high[0] * (uint32_t)x + (uint32_t)a->high[1] * (uint32_t)y +
                          (uint32_t)a->high[2] * (uint32_t)z + (uint32_t)(low >> xf->shift_low); /* < 1.74 * 2^30 + 2^17 */
    return (int32_t)((uint32_t)((int32_t)high >> xf->shift_high) + (uint32_t)a->t_high);
}

/* The same for positions in 1/256 steps, in 64 bits. |p| <= 2^23 */
static int32_t along_fine(const struct zs_xform *xf, const struct zs_axis *a, const int32_t p[3])
{
    const uint32_t s = xf->shift_low, shift = s + xf->shift_high;
    int64_t sum = a->t_high * ((int64_t)1 << shift) + a->t_low; /* |.| < 2^60 + 2^29 */
    for (int j = 0; j < 3; j++)
        sum += zs_mul_ss(a->high[j] * (1 << s) + a->low[j], p[j]); /* |.| <= 2^53 */
    return (int32_t)(sum >> shift);
}

/* Apart: meshes with pos_lo are the exception. */
static ZS_NOINLINE void vertex_fine(const struct zs_xform *xf, uint32_t v, struct zs_point *out)
{
    const struct zs_mesh *mesh = xf->instance->mesh;
    int32_t p[3];
    for (int k = 0; k < 3; k++)
        p[k] = mesh->pos[v][k] * 256 + mesh->pos_lo[v][k];
    for (int k = 0; k < 3; k++)
        out->c[k] = along_fine(xf, &xf->axis[k], p);
}

void zs_xform_vertex(const struct zs_xform *xf, uint32_t v, struct zs_point *out)
{
    const struct zs_mesh *mesh = xf->instance->mesh;
    if (mesh->pos_lo) {
        vertex_fine(xf, v, out);
        return;
    }
    const int16_t *p = mesh->pos[v];
    const int32_t x = p[0], y = p[1], z = p[2];
    for (int k = 0; k < 3; k++)
        out->c[k] = along(xf, &xf->axis[k], x, y, z);
}

/* The largest |x'| and |y'| at distance z > 0 that are inside the guard band. */
static uint32_t guard_at(const struct zs_view *view, int32_t z)
{
    const uint64_t limit = view->perspective
                               ? zs_mul_uu((uint32_t)ZS_GUARD_SUBPX, (uint32_t)z) >> view->scale_bits /* < 2^51 */
                               : view->guard;
    return limit > UINT32_MAX ? UINT32_MAX : (uint32_t)limit;
}

static uint32_t magnitude(int32_t v)
{
    return v < 0 ? 0u - (uint32_t)v : (uint32_t)v;
}

uint32_t zs_xform_outcode(const struct zs_view *view, const struct zs_point *p)
{
    const int32_t x = p->c[0], y = p->c[1], z = p->c[2];
    uint32_t code = 0;
    if (z < view->z_near)
        return ZS_OUT_NEAR; /* the sides say nothing before the near plane */
    if (z > view->z_far)
        code = ZS_OUT_FAR;
    const uint32_t limit = guard_at(view, z);
    if (magnitude(x) > limit)
        code |= x < 0 ? ZS_OUT_LEFT : ZS_OUT_RIGHT;
    if (magnitude(y) > limit)
        code |= y < 0 ? ZS_OUT_TOP : ZS_OUT_BOTTOM;
    return code;
}

/* Steps from the frame's middle with the sign of the point's coordinate: magnitude first, so that a mirrored scene
 * snaps to mirrored places. Saturates beyond the guard band. */
static inline int32_t placed(uint32_t steps, int32_t coarse, int32_t sign)
{
    const int32_t v = steps > (uint32_t)ZS_GUARD_SUBPX >> coarse ? (int32_t)ZS_GUARD_SUBPX + 1 : (int32_t)(steps << coarse);
    return sign < 0 ? -v : v;
}

/* mag / 2^shift, nearest, saturated. mag < 2^63, 0 < shift */
static ZS_NOINLINE uint32_t steps_wide(uint64_t mag, int32_t shift)
{
    const uint64_t steps = (mag + ((uint64_t)1 << (shift - 1))) >> shift;
    return steps > UINT32_MAX ? UINT32_MAX : (uint32_t)steps;
}

/* |c| * rcp / 2^shift, nearest, saturated. |c| <= 2^31, 0 < shift <= 58. From 33 on the low half of the product cannot carry. */
static inline uint32_t steps_of(int32_t c, uint32_t rcp, int32_t shift)
{
    const uint32_t mag = magnitude(c);
    if (shift > 32)
        return (zs_umulh(mag, rcp) + (1u << (shift - 33))) >> (shift - 32); /* < 2^31 + 2^25 */
    return steps_wide(zs_mul_uu(mag, rcp), shift);
}

int zs_xform_project(const struct zs_renderer *r, const struct zs_point *p, struct zs_vertex *out)
{
    const struct zs_view *view = &r->view;
    const int32_t z = p->c[2], coarse = view->snap;
    int32_t lz = 0;
    uint32_t rcp = 0, sx, sy;
    if (z < view->z_near || z > view->z_far)
        return 0;
    if (view->perspective) {
        lz = zs_clz32((uint32_t)z);        /* 1 .. 23: z in [2^8, 2^30] */
        rcp = zs_recip((uint32_t)z << lz); /* 2^(63 - lz) / z */
        const int32_t shift = 63 - lz - view->scale_bits + coarse; /* 9 .. 58 */
        sx = steps_of(p->c[0], rcp, shift);
        sy = steps_of(p->c[1], rcp, shift);
    } else { /* one more bit: the shift may be 0 */
        sx = steps_wide((uint64_t)magnitude(p->c[0]) << 1, view->scale_bits + coarse + 1);
        sy = steps_wide((uint64_t)magnitude(p->c[1]) << 1, view->scale_bits + coarse + 1);
    }
    const int inside = sx <= (uint32_t)ZS_GUARD_SUBPX >> coarse && sy <= (uint32_t)ZS_GUARD_SUBPX >> coarse;
    out->x = view->cx + placed(sx, coarse, p->c[0]);
    out->y = view->cy + placed(sy, coarse, p->c[1]);
    const struct zs_depth *depth = r->config.depth;
    out->d = depth->vertex(view, z, rcp, lz);
    return inside;
}

/* From camera units to the pool. Return 0: outside near, far or guard. */
static int settle(const struct zs_renderer *r, const struct zs_point *p, struct zs_vertex *out)
{
    const struct zs_xform *xf = &r->xform;
    uint32_t code = 0;
    if (xf->clip_depth | xf->clip_guard)
        code = zs_xform_outcode(&r->view, p);
    if (!code) {
        if (zs_xform_project(r, p, out))
            return 1;
        code = zs_xform_outcode(&r->view, p); /* a sphere that is smaller than its mesh */
    }
    out->x = (int32_t)code;
    out->y = 0;
    out->d = ZS_D_OUT;
    return 0;
}

int zs_xform_screen(const struct zs_renderer *r, uint32_t v, struct zs_vertex *out)
{
    struct zs_point p;
    zs_xform_vertex(&r->xform, v, &p);
    return settle(r, &p, out);
}

int zs_xform_mesh(const struct zs_renderer *r, struct zs_vertex *out)
{
    const uint32_t n = r->xform.instance->mesh->n_verts;
    int inside = 1;
    for (uint32_t v = 0; v < n; v++)
        inside &= zs_xform_screen(r, v, out + v);
    return inside;
}
