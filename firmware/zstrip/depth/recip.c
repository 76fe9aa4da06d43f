/* Keys that are linear on the screen: (1/n - 1/z) / (1/n - 1/f) * (B - 1).
 *
 * The key is computed as K (z - n) / z with K = (B - 1) f / (f - n). The difference z - n is exact,
 * so the error is relative to the key: 2^-29 of it from the reciprocal, plus one ulp of uq16_16.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/depth.h"
#include "core/fx.h"

ZS_RARE int zs_recip_setup(struct zs_view *view, const struct zs_camera *camera, uint32_t bits)
{
    if (!view->perspective)
        return ZS_ERR_DEPTH; /* 1/z is not linear on an orthographic screen */
    view->screen_linear = 1;
    view->pixelwise = 0;
    view->piece_shift = 31;
    view->key_top = ((1u << bits) - 1u) << 16;
    view->piece_base = view->key_top + 0xffffu;
    const uint64_t f = (uint64_t)camera->z_far, n = (uint64_t)camera->z_near;
    /* K in uq48_16 times 2^14; f / (f - n) <= 2^16 by the camera's check, so < 2^63 */
    const uint64_t k = zs_muldiv_u64((uint64_t)view->key_top << 14, f, f - n);
    view->key_far = k >> 14;
    view->key_slow = view->key_known = 0;
    const int up = zs_clz64(k);
    ZS_FACT(up >= 1 && up <= 26);
    view->key_mul = (uint32_t)(k << up >> 32); /* K in uq_16 * 2^(14 + up - 32), >= 2^31 */
    view->key_shift = 14 + up;                 /* for that factor and t's 32 bits; 15 .. 40 */
    return ZS_OK;
}

uint32_t zs_recip_vertex(const struct zs_view *view, int32_t z, uint32_t rcp, int32_t lz)
{
    const uint32_t above = (uint32_t)(z - view->z_near) << lz; /* < z << lz < 2^32 */
    const uint64_t t = zs_mul_uu(above, rcp) >> 31;            /* (z - n) / z, uq0_32 */
    const uint64_t key = t * view->key_mul >> view->key_shift; /* < 2^64; floor */
    return key > view->key_top ? view->key_top : (uint32_t)key;
}

/* Return w, proportional to n / z = 1 - key / K. */
uint64_t zs_recip_inverse(const struct zs_view *view, uint32_t d)
{
    return view->key_far > d ? view->key_far - d : 1u;
}

const struct zs_depth zs_depth_recip = { .setup = zs_recip_setup,
                                         .vertex = zs_recip_vertex,
                                         .inverse = zs_recip_inverse };
