/* Vertex transform: mesh steps to camera units, camera units to the screen.
 *
 * Errors, in camera units (everything in view is below 2^30 of them):
 *   matrix         the view matrix, its product with the pose, and the scale are each rounded to
 *                  2^-30 of a row element, which is multiplied by at most reach: about 1.3 in all,
 *                  the same for all vertices of a pose
 *   rounding       1/2, once, after the exact sum
 * On the screen, each camera unit is 2^scale_bits / z sub-pixels; snapping adds 1/2 sub-pixel.
 *
 * If two meshes share pose and scale, and both or neither have pos_lo, vertices at one position get
 * the same camera position, bit for bit: m, t and shift depend on these and on the frame alone.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/cull.h"
#include "core/depth.h"
#include "core/fx.h"
#include "core/pass.h"
#include "core/rotation.h"
#include "core/usual.h"
#include "core/xform.h"
#include "zs_shader.h"

#define SHIFT_MAX 29 /* keeps t below 2^60, and ZS_ROW_S2 at most 14 */
#define SPLIT_MAX 15

/* Set one row of c = (m . p + t) / 2^shift, nearest; m is in row[0 .. 2]. |m| <= 2^30, |t| < 2^60,
 * |t / 2^shift| < 2^30. With a shift of at most 15, t_low is in [0, 2^15); with a larger one, in
 * [-2^28, 2^28). */
static ZS_RARE void row_set(int32_t row[ZS_ROW_WORDS], int64_t t, int32_t shift)
{
    const int32_t half = (1 << shift) >> 1;
#if ZS_ROW_WIDE
    row[3] = (int32_t)(t + half);
    row[4] = (int32_t)((t + half) >> 32);
    row[5] = shift;
    row[6] = 32 - shift;
#else
    const int32_t s = shift < SPLIT_MAX ? shift : SPLIT_MAX;
    for (int j = 0; j < 3; j++) {
        const int32_t high = (row[j] + ((1 << s) >> 1)) >> s;
        row[ZS_ROW_HIGH + j] = high;
        row[ZS_ROW_LOW + j] -= high * (1 << s); /* ZS_ROW_LOW is 0 */
    }
    const int32_t t_high = (int32_t)((t + half + (shift > s ? half : 0)) >> shift);
    row[ZS_ROW_T_HIGH] = t_high;
    row[ZS_ROW_T_LOW] = (int32_t)(t + half - zs_mul_ss(t_high, 1 << shift));
    row[ZS_ROW_S] = s;
    row[ZS_ROW_S2] = shift - s;
#endif
}

ZS_RARE int zs_xform_instance(struct zs_renderer *r, uint32_t number, const struct zs_bounds *b)
{
    struct zs_xform *xf = &r->xform;
    const struct zs_view *view = &r->view;
    const struct zs_instance *in = zs_instance_of(r, number);
    ZS_ASSERT(view->shift >= -3 && view->shift <= 30);
    if (zs_clz64((uint64_t)b->reach) < 18 + view->shift) /* 2^30 camera units */
        return 0;
    xf->instance = in;
    xf->number = number;
    xf->cull = in->material->cull;

    /* scale = mantissa * 2^exp / 2^32, mantissa in [2^30, 2^31) */
    const uint64_t scale = zs_usual_scale(in);
    const int32_t lz = zs_clz64(scale);
    const int32_t mantissa = (int32_t)(zs_scale2((int64_t)scale, lz - 2) >> 31); /* lz >= 16 */
    int32_t exp = 33 - lz;
    if (in->mesh->pos_lo)
        exp -= 8;                           /* positions are in 1/256 steps */
    int32_t shift = 31 - exp - view->shift; /* m = rotation * mantissa / 2^31 */
    ZS_ASSERT(shift >= 0);
    int32_t extra = 0;
    if (shift > SHIFT_MAX) {
        extra = shift - SHIFT_MAX > 30 ? 30 : shift - SHIFT_MAX;
        shift = SHIFT_MAX;
    }
    const zs_q2_30 *const rot = zs_usual_rotation(in->pose.rot);
    zs_q2_30 both[9];
    zs_rotation_mul(both, view->rot, rot);
    int32_t from[3];
    for (int k = 0; k < 3; k++)
        from[k] = in->pose.pos[k] - view->pos[k];
    for (int k = 0; k < 3; k++) {
        const int64_t at = zs_dot(view->rot + 3 * k, from); /* q2_30 * world units, < 2^60.8 */
        int32_t *const row = xf->row + k * ZS_ROW_WORDS;
        for (int j = 0; j < 3; j++)
            row[j] = (int32_t)zs_round_shift(zs_mul_ss(both[3 * k + j], mantissa), 31 + extra);
        row_set(row, zs_scale2(at, view->shift + shift - 30), shift);
    }
    r->shading.instance = in;
    r->shading.light = &r->light;
    r->shading.camera = &r->camera;
    zs_rotation_row(r->shading.dir, r->light.dir, rot); /* by the transpose: world to mesh */
    return view->mirror ? view->mirror->move(r) : 1;
}

/* ---- Vertices -------------------------------------------------------------------------------- */

int32_t zs_xform_fine(const int32_t row[ZS_ROW_WORDS], const int16_t pos[3],
                      const uint8_t pos_lo[3])
{
#if ZS_ROW_WIDE
    const int32_t shift = row[5], *const m = row;
    int64_t sum = (int64_t)((uint64_t)(uint32_t)row[4] << 32 | (uint32_t)row[3]);
#else
    const int32_t s = row[ZS_ROW_S], shift = s + row[ZS_ROW_S2];
    /* |.| < 2^60 + 2^29 */
    int64_t sum = row[ZS_ROW_T_HIGH] * ((int64_t)1 << shift) + row[ZS_ROW_T_LOW];
    int32_t m[3];
    for (int j = 0; j < 3; j++)
        m[j] = row[ZS_ROW_HIGH + j] * (1 << s) + row[ZS_ROW_LOW + j];
#endif
    for (int j = 0; j < 3; j++)
        sum += zs_mul_ss(m[j], pos_lo ? pos[j] * 256 + pos_lo[j] : pos[j]); /* <= 2^53 */
    return (int32_t)(sum >> shift);
}

void zs_xform_vertex(const struct zs_xform *xf, uint32_t v, struct zs_point *out)
{
    const struct zs_mesh *mesh = xf->instance->mesh;
    const struct zs_shader *shader = xf->instance->material->shader;
    const int32_t *row = xf->row;
    if (shader->place)
        shader->place(xf, v, out);
    else if (!ZS_FOR_SIZE && !mesh->pos_lo)
        zs_matrix_rows(row, mesh->pos[v], out->c, 1);
    else
        for (int k = 0; k < 3; k++, row += ZS_ROW_WORDS)
            out->c[k] = zs_xform_fine(row, mesh->pos[v], mesh->pos_lo ? mesh->pos_lo[v] : 0);
}

/* Return the largest |x'| or |y'| inside the guard band at distance z > 0. */
static uint32_t guard_at(const struct zs_view *view, int32_t z)
{
    if (!view->perspective)
        return view->guard > UINT32_MAX ? UINT32_MAX : (uint32_t)view->guard;
    const uint64_t limit = zs_mul_uu((uint32_t)ZS_GUARD_SUBPX, (uint32_t)z); /* < 2^52 */
    const uint32_t high = (uint32_t)(limit >> 32), low = (uint32_t)limit;
    const int32_t down = view->scale_bits; /* 8 .. 31 */
    return high >> down ? UINT32_MAX : high << (32 - down) | low >> down;
}

uint32_t zs_xform_outcode(const struct zs_view *view, const struct zs_point *p)
{
    const int32_t x = p->c[0], y = p->c[1], z = p->c[2];
    uint32_t code = 0;
    if (z < view->z_near) {
        code = ZS_OUT_NEAR; /* the sides are not defined before the near plane */
    } else {
        if (z > view->z_far)
            code = ZS_OUT_FAR;
        const uint32_t limit = guard_at(view, z);
        if (zs_size32(x) > limit)
            code |= x < 0 ? ZS_OUT_LEFT : ZS_OUT_RIGHT;
        if (zs_size32(y) > limit)
            code |= y < 0 ? ZS_OUT_TOP : ZS_OUT_BOTTOM;
    }
    return view->mirror ? view->mirror->outcode(view, p, code) : code;
}

/* ---- Projection ------------------------------------------------------------------------------ */

/* Return a screen coordinate relative to the viewport's centre, sub-pixels: at * rcp / 2^shift,
 * rounded to the nearest multiple of 2^snap. The magnitude is rounded, so that a mirrored scene
 * snaps to mirrored positions. A coordinate beyond the guard band is clamped to one sub-pixel
 * outside it. 0 < shift <= 64 */
static ZS_NOINLINE int32_t placed(const struct zs_view *view, int32_t at, uint32_t rcp,
                                  int32_t shift)
{
    const uint32_t most = (uint32_t)ZS_GUARD_SUBPX >> view->snap;
    const uint64_t twice = zs_mul_uu(zs_size32(at), rcp) >> (shift - 1); /* the product: < 2^63 */
    const uint64_t steps = (twice + 1u) >> 1;
    const int32_t v = steps > most ? (int32_t)ZS_GUARD_SUBPX + 1 : (int32_t)steps << view->snap;
    return at < 0 ? -v : v;
}

/* Project in place, from camera units to the screen; on entry d is z. Return 0 if the point is
 * before near, beyond far or outside the guard band. */
ZS_NOINLINE int zs_xform_project_at(const struct zs_renderer *r, struct zs_vertex *at)
{
    const struct zs_view *view = &r->view;
    const struct zs_depth *depth = r->view.depth;
    const int32_t z = (int32_t)at->d;
    if (z < view->z_near || z > view->z_far)
        return 0;
    uint32_t rcp = 1u << 31;
    int32_t lz = 0, shift = 31 + view->scale_bits;
    if (view->perspective) {
        lz = zs_clz32((uint32_t)z); /* 1 .. 23: z in [2^8, 2^30] */
        rcp = ZS_RECIP_STEPS ? zs_recip((uint32_t)z << lz)
                             : zs_recip16((uint32_t)z << lz); /* 2^(63 - lz) / z */
        shift = 63 - lz - view->scale_bits;                   /* 9 .. 54 */
    }
    at->d = depth->vertex(view, z, rcp, lz);
    /* products are below 2^63: a shift of 64 or more gives 0 */
    shift = zs_min32(shift + view->snap, 64);
    const int32_t x = placed(view, at->x, rcp, shift), y = placed(view, at->y, rcp, shift);
    at->x = view->cx + x;
    at->y = view->cy + y;
    return zs_abs32(x) <= ZS_GUARD_SUBPX && zs_abs32(y) <= ZS_GUARD_SUBPX;
}

int zs_xform_project(const struct zs_renderer *r, const struct zs_point *p, struct zs_vertex *out)
{
    out->x = p->c[0];
    out->y = p->c[1];
    out->d = (uint32_t)p->c[2];
    return zs_xform_project_at(r, out);
}

void zs_xform_screen(const struct zs_renderer *r, uint32_t v, struct zs_vertex *out)
{
    struct zs_point p;
    zs_xform_vertex(&r->xform, v, &p);
    const uint32_t code = zs_xform_outcode(&r->view, &p);
    if (code || !zs_xform_project(r, &p, out)) /* or rounded out of the guard band */
        out->d = ZS_D_OUT + code;
}
