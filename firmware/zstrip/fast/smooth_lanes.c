/* Smooth shading on an RP2040: rows of zs_fast_smooth with colours and keys in the interpolators,
 * which step all four of them, and pieces of rows of what is drawn piece by piece: triangles in two
 * octaves of the keys, and over pixels that are uncleared. A pixel takes 16 cycles in place of 24,
 * a row 64 in place of 115: 0.35 of 8.4 million cycles in scene teapot; set-up in assembler, and
 * pieces, 0.32 of 7.1. 670 bytes.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/fast.h"
#include "core/fx.h"
#include "fast/lanes.h"

/* Lanes: red and green; blue and, above it, the key. */
#define RED ZS_LANES_FIELD(16u, 11u, 15u)
#define GREEN ZS_LANES_FIELD(21u, 5u, 10u)
#define BLUE ZS_LANES_FIELD(27u, 0u, 4u)
#define KEY ZS_LANES_FIELD(0u, 16u, 31u)

#if ZS_RP2040

#define PIXEL                                                                                      \
    ZS_LANES_POP_1(r7)                                                                             \
    ZS_LANES_POP_0(r3)                                                                             \
    "orrs r3, r7\n\tlsrs r7, #16\n\t"                                                              \
    "ldrh r2, [r4, r5]\n\tcmp r7, r2\n\tbcs 4f\n\t"                                                \
    "rev16 r3, r3\n\tstrh r7, [r4, r5]\n\tstrh r3, [r6, r5]\n"

/* r1: the lanes; ctrl and base[2] of both. Uses r4 to r7. */
#define SHIFTS                                                                                     \
    "movs r1, #0xd0\n\tlsls r1, #24\n\tadds r1, #0x80\n\tadr r7, 8f\n\t"                           \
    "ldmia r7!, {r4, r5, r6}\n\tstr r4, [r1, #0x2c]\n\tstr r5, [r1, #0x30]\n\t"                    \
    "str r6, [r1, #0x6c]\n\tldr r4, [r7]\n\tstr r4, [r1, #0x70]\n\t"                               \
    "movs r4, #0\n\tstr r4, [r1, #0x10]\n\tstr r4, [r1, #0x50]\n\t"
#define SHIFTS_AT                                                                                  \
    ".align 2\n8:\n\t.word %c[red], %c[green], %c[blue], %c[all]\n"
#define SHIFTS_OF                                                                                  \
    [red] "i"(RED), [green] "i"(GREEN), [blue] "i"(BLUE), [all] "i"(KEY)

#define AT(field) offsetof(struct zs_job, field)

/* A plane from r7: lane to column r2 of the row r3. */
#define STEP_TO(accum, base)                                                                       \
    "ldmia r7!, {r4, r5, r6}\n\tstr r5, [r1, #" #base "]\n\tmuls r5, r2\n\tadds r4, r5\n\t"        \
    "muls r6, r3\n\tadds r4, r6\n\tstr r4, [r1, #" #accum "]\n\t"

ZS_NAKED void zs_lanes_smooth_span(
    struct zs_job *job __attribute__((unused)), const struct zs_row *row __attribute__((unused)),
    int32_t i0 __attribute__((unused)), int32_t i1 __attribute__((unused)),
    uint32_t sum __attribute__((unused)), uint32_t step __attribute__((unused)))
{
    __asm__ volatile(
        ".syntax unified\n\t"
        "mov r12, r4\n\tldrb r4, [r0, %[saturates]]\n\tcmp r4, #0\n\tbne 6f\n\t"
        "movs r4, %[sub]\n\tldr r4, [r0, r4]\n\tcmp r4, %[affine]\n\tbne 6f\n\t"
        "mov r4, r12\n\tpush {r4, r5, r6, r7, lr}\n\t"
        "ldr r4, [r1, %[at]]\n\tadds r4, r3\n\tlsls r4, #1\n\tsubs r3, r2, r3\n\tlsls r3, #1\n\t"
        "bge 7f\n\tmov r12, r4\n\tmov lr, r3\n\tldr r3, [r1]\n\t" SHIFTS
        "movs r7, r0\n\tadds r7, %[c]\n\t" STEP_TO(0, 8) STEP_TO(4, 12) STEP_TO(0x40, 0x48)
        "ldr r4, [sp, #20]\n\tstr r4, [r1, #0x44]\n\tldr r4, [sp, #24]\n\tstr r4, [r1, #0x4c]\n\t"
        "ldr r4, [r0, %[depth]]\n\tadd r4, r12\n\tldr r6, [r0, %[color]]\n\tadd r6, r12\n\t"
        "movs r0, r1\n\tmov r5, lr\n"
        "3:\n\t" PIXEL
        "4:\n\tadds r5, #2\n\tbmi 3b\n"
        "7:\n\tpop {r4, r5, r6, r7, pc}\n"
        "6:\n\tmov r4, r12\n\tpush {r0, r1}\n\tldr r0, 9f\n\tstr r0, [sp, #4]\n\tpop {r0, pc}\n\t"
        SHIFTS_AT
        "9:\n\t.word zs_fast_less\n"
        :
        : SHIFTS_OF, [saturates] "i"(AT(saturates)), [sub] "i"(AT(sub_log2)),
          [affine] "i"(ZS_AFFINE), [at] "i"(offsetof(struct zs_row, at)), [c] "i"(AT(c)),
          [depth] "i"(AT(depth)), [color] "i"(AT(color)));
}

#else

#define PIXEL pixel

static int pixel(struct zs_lanes *lanes, const struct zs_lanes_set *set, uint16_t *depth,
                 uint16_t *color)
{
    (void)set;
    const uint32_t key = zs_lanes_pop(&lanes[1]), red_green = zs_lanes_pop(&lanes[0]);
    if (key >> 16 >= *depth)
        return 0;
    *depth = (uint16_t)(key >> 16);
    *color = zs_wire16((uint16_t)(red_green | key));
    return 1;
}
#endif
ZS_LANES_ROWS(rows, PIXEL, "")

void zs_lanes_smooth_rows(struct zs_job *job)
{
    static const struct zs_lanes_set set = { { RED, GREEN, BLUE, KEY }, 0, 0, 0 };
    zs_lanes_draw(job, &set, &job->c[2], rows);
}
