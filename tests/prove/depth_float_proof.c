/* depth_float.c.
 *
 * SPDX-License-Identifier: MIT
 */
#include "prove.h"

#include "pipeline.h"

#include "depth_float.c"

static struct zs_view view;

static void any_view(uint32_t bits, uint32_t exponent_bits, int k)
{
    struct zs_camera camera;
    view.perspective = 1;
    view.shift = any_i32(-34, 30);
    camera.z_near = any_i64((int64_t)OCTAVE_LO(k), (int64_t)OCTAVE_HI(k));
    camera.z_far = any_i64(2, (int64_t)1 << 60);
    (void)float_setup(&view, &camera, bits, exponent_bits);
}

/* PROVE float_setups: near of 2^-16 to 2^29 world units by octave, every shift of units, 8 and 16 bits, exponents of 3 .. 5 */
void float_setups(void)
{
    for (uint32_t bits = 8; bits <= 16; bits += 8)
        for (uint32_t e = 3; e <= 5; e++)
            for (int k = 0; k <= 45; k++)
                any_view(bits, e, k);
}

/* PROVE float_keys: 8 and 16 bits, exponents of 3 .. 5, near of 2^8 .. 2^30 camera units by octave, every z by octave */
void float_keys(void)
{
    for (uint32_t bits = 8; bits <= 16; bits += 8)
        for (uint32_t e = 3; e <= 5; e++) {
            any_view(bits, e, 0);
            view.key_shift = any_i32(1, 24); /* near = key_mul / 2^key_shift */
            view.key_mul = any_u32(1u << 31, UINT32_MAX);
            for (int k = 8; k <= 30; k++)
                (void)float_vertex(&view, any_i32((int32_t)OCTAVE_LO(k), (int32_t)OCTAVE_HI(k)),
                                   any_u32(1u << 31, UINT32_MAX), 31 - k);
        }
}

/* PROVE float_inverses_of: octave and mantissa of every key, 8 and 16 bits, exponents 3 .. 5; not the shifts by octaves of
 * three vertices */
void float_inverses_of(void)
{
    for (uint32_t bits = 8; bits <= 16; bits += 8)
        for (uint32_t e = 3; e <= 5; e++) {
            any_view(bits, e, 0);
            for (int32_t o = 1; o <= (int32_t)view.key_octaves; o++) {
                const uint32_t d = any_u32(0, view.key_top + 0xffffu);
                const int32_t of = octave_of(&view, d);
                ASSERT(of >= 1 && of <= (int32_t)view.key_octaves);
                (void)mantissa_of(&view, d, o);
            }
        }
}

/* PROVE float_rounding: shifts 1 .. 63, sums of 64 bits, any */
void float_rounding(void)
{
    for (int32_t shift = 1; shift < 64; shift++) {
        (void)rounded(any_u64(0, UINT64_MAX), shift, 0);
        (void)rounded(any_u64(0, UINT64_MAX), shift, 1);
    }
    for (int32_t last = 1; last <= 31; last++) {
        const int32_t down = octaves_down(any_u64(0, UINT64_MAX), last);
        ASSERT(down >= 1 && down <= last);
    }
}
