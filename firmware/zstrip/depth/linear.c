/* Keys that are linear in distance: (z - n) / (f - n) * (B - 1).
 *
 * Orthographic: keys are linear on the screen too; only set-up and vertex function are used.
 *
 * Perspective: keys are not linear on the screen, but 1/z is. w = 2^62 / z is shifted until the
 * largest of a triangle's three values is below 2^40, and interpolated over the screen with 24 more
 * fraction bits. Every pixel takes a reciprocal. Errors, as parts of z, with r the triangle's ratio
 * of farthest to nearest:
 *   rounding of w at the vertices     r * 2^-40 (largest w >= 2^39), or 2^-33 if no bit was shifted
 *                                     out
 *   steps, at most 2^13 of 2^-24 ulp  r * 2^-50
 *   truncation to 32 bits, reciprocal 2^-31 + 2^-30
 * Times z / (f - n) * 65535 buckets: below 0.005 for r <= 2^15 and f >= 2n, and below 0.1 for f - n
 * >= f / 1024. In a slab thinner than that no margin of a key holds (pixelwise 2). For each pixel,
 * a 64-bit sum takes two instructions, the reciprocal about forty.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/depth.h"
#include "core/fx.h"
#include "core/plane.h"
#include "core/rows.h"

static ZS_RARE int linear_setup(struct zs_view *view, const struct zs_camera *camera, uint32_t bits)
{
    view->screen_linear = !view->perspective;
    view->piece_shift = view->perspective ? 0u : 31u;
    view->key_top = ((1u << bits) - 1u) << 16;
    view->piece_base = view->key_top + 0xffffu;
    view->key_far = 0;
    view->key_slow = view->key_known = 0;
    /* C = (B - 1) / ((f - n) in camera units) as key_mul / 2^key_shift, key_mul in [2^30, 2^31) */
    const uint64_t range = (uint64_t)(camera->z_far - camera->z_near); /* q48_16, < 2^61 */
    view->pixelwise = (uint8_t)(view->perspective << (range < (uint64_t)camera->z_far >> 10));
    const int lz = zs_clz64(range);
    const uint64_t c = zs_muldiv_u64((uint64_t)(view->key_top >> 16) << 46, (uint64_t)1 << 32,
                                     range << lz); /* [2^21, 2^31) */
    const int up = zs_clz32((uint32_t)c) - 1;
    ZS_FACT(up >= 0 && up <= 9);
    view->key_mul = (uint32_t)c << up;
    /* (B-1) 2^78 / (range 2^lz) = c; (f - n) = range * 2^(shift - 16) */
    view->key_shift = 78 - lz - 16 + view->shift + up;
    return ZS_OK;
}

/* Return above * key_mul / 2^shift, nearest, clamped to `most`. -31 <= shift */
static inline uint32_t key_of(const struct zs_view *view, uint32_t above, int32_t shift,
                              uint32_t most)
{
    const uint64_t product = zs_mul_uu(above, view->key_mul); /* < 2^63 */
    ZS_FACT(shift >= -31);
    if (shift > 63)
        return 0;
    const uint64_t key = shift > 0 ? ((product >> (shift - 1)) + 1u) >> 1 : product << -shift;
    return key > most ? most : (uint32_t)key;
}

static uint32_t linear_vertex(const struct zs_view *view, int32_t z, uint32_t rcp, int32_t lz)
{
    (void)rcp;
    (void)lz;
    if (view->perspective)
        return (uint32_t)z;
    /* z >= near: the difference is below 2^31.1 */
    return key_of(view, (uint32_t)z - (uint32_t)view->z_near, view->key_shift - 16, view->key_top);
}

static uint64_t linear_inverse(const struct zs_view *view, uint32_t d)
{
    (void)view;
    return ((uint64_t)1 << 62) / d;
}

static uint32_t linear_key(const struct zs_view *view, uint32_t d)
{
    const uint32_t n = (uint32_t)view->z_near;
    return view->perspective ? key_of(view, d > n ? d - n : 0u, view->key_shift - 16, view->key_top)
                             : d;
}

static int linear_planes(struct zs_job *job)
{
    uint64_t w[3], most = 0;
    for (int k = 0; k < 3; k++) {
        w[k] = linear_inverse(&job->r->view, job->v[k]->d);
        if (most < w[k])
            most = w[k];
    }
    int32_t cut = 0;
    while (most >> cut >= (uint64_t)1 << 40) /* z >= 2^8: at most 2^54 */
        cut++;
    for (int k = 0; k < 3; k++)
        w[k] = (uint64_t)zs_round_shift((int64_t)w[k], cut);
    zs_plane64(&job->geom, w[0], w[1], w[2], &job->w64);
    job->w64_scale = 9 + cut; /* z = reciprocal of w's top 32 bits * 2^(leading zeros - scale) */
    return 0;
}

/* Return the key of a pixel from w in 40.24 bits. */
static uint32_t pixel_key(const struct zs_view *view, uint64_t w, int32_t scale)
{
    if (w == 0)
        /* does not happen on a covered pixel, but the result is defined */
        return view->key_top >> 16;
    const int lz = zs_clz64(w);
    const uint32_t rcp = zs_recip((uint32_t)(w << lz >> 32));
    const int32_t q = scale - lz; /* z = rcp / 2^q */
    const uint64_t z_near = q >= 0 ? (uint64_t)(uint32_t)view->z_near << q
                                   : (uint64_t)(uint32_t)view->z_near >> -q;
    const uint32_t above = rcp > z_near ? (uint32_t)(rcp - z_near) : 0u;
    return key_of(view, above, view->key_shift + q, (view->key_top >> 16) - 1u);
}

/* Draw a scanline: each pixel is a piece of its own. */
static void linear_row(struct zs_job *job, const struct zs_row *row)
{
    uint64_t w = row->w + zs_times(job->w64.gx, row->i0);
    for (int32_t i = row->i0; i < row->i1; i++, w += job->w64.gx)
        job->piece(job, row, i, i + 1, pixel_key(&job->r->view, w, job->w64_scale) << 16, 0);
}

const struct zs_depth zs_depth_linear = {
    .setup = linear_setup, .vertex = linear_vertex, .planes = linear_planes, .walk = zs_depth_walk,
    .row = linear_row, .inverse = linear_inverse, .key = linear_key
};
