/* Vectors, and 3 x 3 rotations in q2_30, row-major. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_ROTATION_H
#define ZS_ROTATION_H

#include "core/fx.h"
#include "zstrip.h"

/* Return 1 if n components are all at most `most` in size. */
int zs_within(const int32_t *v, int n, int32_t most);
#define ZS_UNIT_MOST (ZS_Q30_ONE + (1 << 10)) /* a component of a unit vector, and 2^-20 */
/* Return 1 if the rows are orthonormal, to 2^-20, and form a right-handed system. */
int zs_rotation_ok(const zs_q2_30 m[9]);
/* out = a * b, nearest. out is neither a nor b. */
void zs_rotation_mul(zs_q2_30 out[9], const zs_q2_30 a[9], const zs_q2_30 b[9]);
/* Scale v to length 1. |component| < 2^63 - 2^32. Return ZS_OK; ZS_ERR_VECTOR: v is 0 0 0, and out
 * is untouched. */
int zs_unit64(zs_q2_30 out[3], const int64_t v[3]);
/* Return a value with the bit length of the largest |component|; 0 for 0 0 0. */
uint32_t zs_vector_size(const int32_t v[3]);
/* w = v * 2^n, each component at most 2^31. Return w . w, <= 3 * 2^62. */
uint64_t zs_vector_scaled(int64_t w[3], const int32_t v[3], int n);
/* out = a * b for one row a, nearest. out is neither a nor b. */
void zs_rotation_row(zs_q2_30 out[3], const zs_q2_30 a[3], const zs_q2_30 b[9]);
/* a . b, in the product of their units (for q2_30: q4_60). The lengths are below 2^31. */
int64_t zs_dot(const int32_t a[3], const int32_t b[3]);
/* Component k of a x b, |.| < 2^63. */
int64_t zs_cross_at(const int32_t a[3], const int32_t b[3], int k);
/* out = a x b for unit vectors, q2_30. out is neither a nor b. */
void zs_cross(zs_q2_30 out[3], const zs_q2_30 a[3], const zs_q2_30 b[3]);

#endif
