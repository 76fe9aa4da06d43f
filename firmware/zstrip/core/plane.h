/* Gradients: planes over the screen. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_PLANE_H
#define ZS_PLANE_H

#include "core/job.h"

/* Set job->v, job->mid_right, and the differences and area in job->geom. a is the top vertex; a, b,
 * c are clockwise. */
void zs_plane_sides(struct zs_job *job, const struct zs_vertex *a, const struct zs_vertex *b,
                    const struct zs_vertex *c);
/* Set the other fields of job->geom. */
void zs_plane_geom(struct zs_job *job);
enum zs_plane_kind { /* the value is least_shift: gradients of 2^(32 - least_shift) and more are
                        computed by division */
                     ZS_PLANE_WIDE = 2, /* 31 significant bits: error below the larger of 2^-21 of
                                           the largest value and (W + H + 1) / 2 * 2^-31 */
                     ZS_PLANE_KEY = 5   /* buckets or codes, uq16_16: error below 0.005 of one */
};
#define ZS_TOO_STEEP INT32_MIN
/* Return 256 n / area, nearly nearest, or ZS_TOO_STEEP if it is 2^(32 - least_shift) or more. |n|
 * <= 2^48; lz is the number of leading zeros of the area, 1 .. 31, and rcp is 2^63 / (area 2^lz).
 */
int32_t zs_plane_quotient(int64_t n, uint32_t rcp, int32_t lz, int32_t least_shift);
/* The same, inlined; tiny: a constant, 1 if lz <= 18. */
ZS_ALWAYS_INLINE int32_t zs_quotient(int64_t n, uint32_t rcp, int32_t lz, int32_t least_shift,
                                     int tiny)
{
    /* With m = |n| 2^k: 256 |n| / area = p / 2^(down + k), where p = m (2^63 / (area 2^lz)) / 2^32.
     * If |n| fits 32 bits, k is 0: to normalise m would only shift zeros in and out again, with the
     * same result, because successive floors compose. */
    const int32_t sign = (int32_t)(n >> 32);
    uint32_t m = (uint32_t)n, hi = (uint32_t)sign;
    if (sign < 0) {
        m = 0u - m;
        hi = ~hi + (m == 0);
    }
    ZS_FACT(hi <= 1u << 16);
    int32_t down = 23 - lz;
    if (hi) {
        const int32_t up = zs_clz32(hi), less = 32 - up; /* up: 15 .. 31 */
        m = hi << up | m >> less;
        down -= less;
        if (down < least_shift)
            return ZS_TOO_STEEP;
    } else if (!tiny && down < least_shift) { /* tiny: lz <= 18 */
        if (!m)
            return 0;
        const int32_t up = zs_min32(zs_clz32(m), 16); /* by 16, it is not too steep any more */
        m <<= up;
        down += up;
        if (down < least_shift)
            return ZS_TOO_STEEP;
    }
    m = ((zs_umulh(m, rcp) >> (down - 1)) + 1u) >> 1; /* down is 2 .. 22; m <= 2^30 */
    return sign < 0 ? -(int32_t)m : (int32_t)m;
}

/* Return dv1 d[1] - dv2 d[0], modulo 2^64. */
uint64_t zs_plane_numerator(uint64_t dv1, uint64_t dv2, const int32_t d[2]);
/* Compute the gradients of a value from its values at job->v[0 .. 2]. */
void zs_plane32(const struct zs_geom *g, uint32_t v0, uint32_t v1, uint32_t v2,
                int32_t kind, struct zs_plane *out); /* enum zs_plane_kind, as a word */
void zs_plane64(const struct zs_geom *g, uint64_t v0, uint64_t v1, uint64_t v2,
                struct zs_plane64 *out);

#endif
