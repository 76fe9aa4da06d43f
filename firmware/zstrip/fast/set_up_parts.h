/* What set-up in assembler shares. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_SET_UP_PARTS_H
#define ZS_SET_UP_PARTS_H

#include "fast/set_up.h"

/* Parts of set-up, for code in assembler: r0 a job, r0 the result as of the function without _part.
 * All other registers change. */
void zs_set_up_part(void);
/* zs_set_up_part and zs_set_up_cuts_part, on an RP2040; r3, r4: the first cut with a pixel, one
 * beyond the last. ZS_SET_UP_EMPTY: there is none. */
void zs_set_up_rows_part(void);
#define ZS_SET_UP_EMPTY (ZS_SET_UP_ROWS + 1)
void zs_set_up_smooth_part(void);
void zs_set_up_texture_part(void); /* r1: the set */
void zs_set_up_coarse_part(void); /* the same for colours that are affine, without weights */
void zs_set_up_cuts_part(void); /* of zs_fast_edges, on an RP2040: the rows from r1 on */

/* What such code saves and restores. */
#define ZS_SAVED                                                                                   \
    ".syntax unified\n\tpush {r4, r5, r6, r7, lr}\n\t"                                             \
    "mov r4, r8\n\tmov r5, r9\n\tmov r6, r10\n\tmov r7, r11\n\tpush {r4, r5, r6, r7}\n\t"
#define ZS_RESTORED                                                                                \
    "pop {r4, r5, r6, r7}\n\t"                                                                     \
    "mov r8, r4\n\tmov r9, r5\n\tmov r10, r6\n\tmov r11, r7\n\tpop {r4, r5, r6, r7, pc}\n\t"

#define AT(field) offsetof(struct zs_job, field)

/* r3 = the high word of its product with a factor whose halves are in r12 (low) and lr (high).
 * Uses r4, r5, r6. No sum of middle products overflows. */
#define HIGH_OF_PRODUCT                                                                            \
    "uxth r4, r3\n\tlsrs r3, #16\n\t"                                                              \
    "mov r5, r12\n\tmovs r6, r5\n\tmuls r5, r4\n\tmuls r6, r3\n\tlsrs r5, #16\n\tadds r5, r6\n\t"  \
    "mov r6, lr\n\tmuls r4, r6\n\tmuls r3, r6\n\tlsrs r6, r5, #16\n\tadds r3, r6\n\t"              \
    "uxth r5, r5\n\tadds r4, r5\n\tlsrs r4, #16\n\tadds r3, r4\n\t"

/* r3 = 256 (r3 d[1] - r4 d[0]) / area, as gradient() of core/plane.c. `load` loads r3 and r4; d: r1
 * and r2; r7: leading zeros of the area; r12, lr: halves of its reciprocal. `table` is where the
 * address of zs_clz8 is; `least` is the kind of plane. Uses r1 to r6. Leads to `steep` where it is
 * too steep. n: a digit, to tell labels apart. */
#define GRADIENT(n, load, table, least, steep)                                                     \
    load                                                                                           \
    /* zs_cross_short: r3 r2 - r4 r1 */                                                            \
    "asrs r5, r3, #16\n\tmuls r5, r2\n\tasrs r6, r4, #16\n\tmuls r6, r1\n\tsubs r5, r6\n\t"        \
    "uxth r3, r3\n\tmuls r3, r2\n\tuxth r4, r4\n\tmuls r4, r1\n\tsubs r3, r4\n\t"                  \
    "asrs r4, r3, #31\n\tlsls r6, r5, #16\n\tasrs r5, #16\n\tadds r3, r6\n\tadcs r5, r4\n\t"       \
    /* r1: sign; r5 r3: magnitude; r2: down */                                                     \
    "asrs r1, r5, #31\n\teors r3, r1\n\teors r5, r1\n\tsubs r3, r1\n\tsbcs r5, r1\n\t"             \
    "movs r2, #23\n\tsubs r2, r7\n\tcmp r5, #0\n\tbeq 3" n "f\n\t"                                 \
    /* r4: leading zeros of r5 */                                                                  \
    "ldr r6, " table "\n\tlsrs r4, r5, #8\n\tbne 1" n "f\n\t"                                      \
    "ldrb r4, [r6, r5]\n\tadds r4, #24\n\tb 2" n "f\n"                                             \
    "1" n ":\n\tldrb r4, [r6, r4]\n\tadds r4, #16\n"                                               \
    "2" n ":\n\tlsls r5, r4\n\tmovs r6, #32\n\tsubs r6, r4\n\tlsrs r3, r6\n\torrs r3, r5\n\t"      \
    "subs r2, r6\n\tcmp r2, #" least "\n\tbge 3" n "f\n\tb " steep "\n"                            \
    "3" n ":\n\t" HIGH_OF_PRODUCT                                                                  \
    "subs r2, #1\n\tlsrs r3, r2\n\tadds r3, #1\n\tlsrs r3, #1\n\teors r3, r1\n\tsubs r3, r1\n\t"

/* Of value c: differences to the stack from `at` on; r7: its range. r2, r3, r4: the corners'
 * values. Uses r5 and r6. */
#define RANGE(c, at)                                                                               \
    "ldrh r5, [r2, #2 * " #c "]\n\tldrh r6, [r3, #2 * " #c "]\n\tldrh r7, [r4, #2 * " #c "]\n\t"   \
    "subs r6, r5\n\tsubs r7, r5\n\tstr r6, [sp, #" #at "]\n\tstr r7, [sp, #4 + " #at "]\n\t"       \
    "cmp r6, r7\n\tble 1f\n\tmovs r5, r6\n\tmovs r6, r7\n\tmovs r7, r5\n"                          \
    "1:\n\tasrs r5, r6, #31\n\tands r6, r5\n\tasrs r5, r7, #31\n\tbics r7, r5\n\tsubs r7, r6\n\t"

/* The corners' values, of r0, a job, to r2, r3, r4. Uses r1, r5, r6. */
#define VALUES                                                                                     \
    "ldr r1, [r0, %[r]]\n\tmovs r5, %[attr]\n\tldr r5, [r1, r5]\n\tldrb r6, [r1, %[n]]\n\t"        \
    "lsls r6, #1\n\tldr r1, [r0, %[tri]]\n\t"                                                      \
    "ldrh r2, [r1]\n\tldrh r3, [r1, #2]\n\tldrh r4, [r1, #4]\n\t"                                  \
    "muls r2, r6\n\tmuls r3, r6\n\tmuls r4, r6\n\tadds r2, r5\n\tadds r3, r5\n\tadds r4, r5\n\t"

/* zs_persp_slow of the job at r1, which is moved: r4: change, r6: least. In one octave the least is
 * w itself (depth/float.c), in units of the keys; elsewhere key_slow. Uses r3, r5, r7. */
#define SLOW(never)                                                                                \
    "adds r1, %[v]\n\tldmia r1!, {r3, r4, r5}\n\t"                                                 \
    "ldr r3, [r3, #8]\n\tldr r4, [r4, #8]\n\tldr r5, [r5, #8]\n\t"                                 \
    "cmp r3, r4\n\tbls 1f\n\tmovs r6, r3\n\tmovs r3, r4\n\tmovs r4, r6\n"                          \
    "1:\n\tcmp r5, r4\n\tbls 1f\n\tmovs r4, r5\n\tb 2f\n"                                          \
    "1:\n\tcmp r5, r3\n\tbcs 2f\n\tmovs r3, r5\n"                                                  \
    "2:\n\tadds r1, %[slow]\n\tldmia r1!, {r6, r7}\n\tcmp r4, r7\n\tbhi " never "\n\t"             \
    "movs r5, r3\n\teors r5, r4\n\tcmp r5, r6\n\tbhi 1f\n\t"                                       \
    "movs r5, r6\n\tbics r5, r4\n\tadds r6, r5\n\tadds r6, #2\n"                                   \
    "1:\n\tsubs r4, r3\n\tcmp r4, r6\n\tbhi " never "\n\t"

/* r1 becomes r7, if that is more. */
#define MOST "cmp r7, r1\n\tbls 1f\n\tmovs r1, r7\n1:\n\t"

/* The weights' product for one difference: r0: up, r6: rcp, r7: half, r1: n. */
#define WEIGHT(d) "lsls " #d ", r0\n\tmuls " #d ", r6\n\tadds " #d ", r7\n\tasrs " #d ", r1\n\t"

/* Colours of the job r0: differences to the stack at at0, at1, at2, and four weights to r2 .. r5
 * (y2, y1, x2, x1); r9: down, r11: the job, r12: the first vertex's colours. Leads to 7f, with 0 in
 * r0 where they are not affine by the sufficient test, with -1 where weights are too coarse. */
#define ZS_WEIGHTS(at0, at1, at2)                                                                  \
    VALUES "mov r12, r2\n\tmovs r1, #0\n\t"                                                        \
    RANGE(0, at0) MOST RANGE(1, at1) MOST RANGE(2, at2) MOST                                       \
    "mov r11, r0\n\tmov lr, r1\n\tmovs r1, r0\n\t" SLOW("9f") "mov r1, lr\n\t"                     \
    /* affine_enough, the sufficient test */                                                       \
    "lsrs r4, #16\n\tadds r4, #1\n\tmuls r4, r1\n\tlsrs r6, %[bound]\n\tcmp r4, r6\n\t"            \
    "bhi 9f\n\t"                                                                                   \
    /* n: r1 */                                                                                    \
    "ldr r7, 8f\n\tmovs r2, #1\n\torrs r1, r2\n\tlsrs r2, r1, #8\n\tbne 1f\n\t"                    \
    "ldrb r2, [r7, r1]\n\tmovs r3, #8\n\tb 2f\n"                                                   \
    "1:\n\tldrb r2, [r7, r2]\n\tmovs r3, #16\n"                                                    \
    "2:\n\tsubs r1, r3, r2\n\t"                                                                    \
    /* dx, dy: r2 to r5; up: r0 */                                                                 \
    "mov r0, r11\n\tadds r0, %[geom]\n\tldr r2, [r0, #48]\n\tcmp r2, #0\n\tbeq 9f\n\t"             \
    "ldmia r0!, {r2, r3, r4, r5}\n\t"                                                              \
    "asrs r6, r2, #31\n\teors r6, r2\n\tasrs r0, r3, #31\n\teors r0, r3\n\t"                       \
    "orrs r6, r0\n\torrs r6, r4\n\torrs r6, r5\n\tlsrs r0, r6, #8\n\tbne 1f\n\t"                   \
    "ldrb r0, [r7, r6]\n\tadds r0, #7\n\tb 2f\n"                                                   \
    "4:\n\tmovs r0, #0\n\tmvns r0, r0\n\tb 7f\n9:\n\tmovs r0, #0\n\tb 7f\n\t"                      \
    ".align 2\n"                                                                                   \
    "8:\n\t.word zs_clz8\n"                                                                        \
    "1:\n\tldrb r0, [r7, r0]\n\tsubs r0, #1\n"                                                     \
    /* rcp: r6, down: r7 */                                                                        \
    "2:\n\tmov r7, r11\n\tadds r7, %[rcp]\n\tldr r6, [r7]\n\tldr r7, [r7, #4]\n\t"                 \
    "adds r7, r0\n\tadds r7, #31\n\tsubs r7, r1\n\tcmp r7, #5\n\tblt 4b\n\tmov r9, r7\n\t"         \
    "adds r7, r0\n\tadds r7, #3\n\tcmp r1, r7\n\tbgt 4b\n\t"                                       \
    "lsrs r6, #16\n\tmovs r7, #1\n\tlsls r7, r1\n\tlsrs r7, #1\n\t"                                \
    WEIGHT(r2) WEIGHT(r3) WEIGHT(r4) WEIGHT(r5)
/* Of colour c, whose differences are on the stack at `at`, by weights on the stack from `w` on: gx
 * to r2, gy to r3, 32 times the way to the anchor to r1. r8: half, r9: down, r10: ax, r11: ay. Uses
 * r4 to r6; r7: most. */
#define ZS_COLOR(c, at, most, w)                                                                   \
    "ldr r5, [sp, #" #at "]\n\tldr r6, [sp, #4 + " #at "]\n\tmovs r7, #" #most "\n\t"              \
    "muls r5, r7\n\tmuls r6, r7\n\tadds r5, #128\n\tasrs r5, #8\n\t"                               \
    "adds r6, #128\n\tasrs r6, #8\n\t"                                                             \
    "ldr r2, [sp, #12 + " #w "]\n\tmuls r2, r5\n\tldr r4, [sp, #8 + " #w "]\n\tmuls r4, r6\n\t"    \
    "subs r2, r4\n\tldr r3, [sp, #" #w "]\n\tmuls r3, r6\n\tldr r4, [sp, #4 + " #w "]\n\t"         \
    "muls r4, r5\n\tsubs r3, r4\n\t"                                                               \
    "add r2, r8\n\tadd r3, r8\n\tmov r4, r9\n\tasrs r2, r4\n\tasrs r3, r4\n\t"                     \
    "asrs r1, r2, #3\n\tmov r4, r10\n\tmuls r1, r4\n\tasrs r4, r3, #3\n\tmov r5, r11\n\t"          \
    "muls r4, r5\n\tadds r1, r4\n\t"
/* r1 += the colour's code at the first vertex; r12: its colours, r7: most. */
#define ZS_CODE(c)                                                                                 \
    "mov r5, r12\n\tldrh r4, [r5, #2 * " #c "]\n\tmuls r4, r7\n\tlsrs r5, r4, #16\n\t"             \
    "adds r4, r5\n\tadds r1, r4\n\t"
#define ZS_WEIGHTS_OF                                                                              \
    [r] "i"(AT(r)), [tri] "i"(AT(tri)), [attr] "i"(offsetof(struct zs_renderer, attr)),            \
        [n] "i"(offsetof(struct zs_renderer, config.varyings)), [v] "i"(AT(v)),                    \
        [slow] "i"(AT(key_slow) - AT(v) - 12), [bound] "i"(ZS_SPAN_BOUND_LOG2 + 4),                \
        [geom] "i"(AT(geom)), [rcp] "i"(AT(geom.rcp))

/* Behind a triangle that is drawn: r4 the job. Leads to `next` where the next one in the list is of
 * the same instance, and job->tri is that one. at: where the offset of job->chain is. */
#define ZS_CHAIN(at, next)                                                                         \
    "ldr r0, [r4, %[last]]\n\tldr r1, [r4, %[y1]]\n\tcmp r0, r1\n\tbgt 1f\n\t"                     \
    "ldr r0, " at "\n\tldr r1, [r4, r0]\n\tcmp r1, #0\n\tbeq 1f\n\t"                               \
    "ldr r2, [r4, %[tri]]\n\tldrh r3, [r2, #6]\n\tldrh r5, [r2, #10]\n\tadds r0, r3, #1\n\t"       \
    "lsrs r0, #16\n\tbne 1f\n\tmovs r0, #12\n\tmuls r3, r0\n\tadds r3, r1\n\t"                     \
    "ldrh r0, [r3, #10]\n\tcmp r0, r5\n\tbne 1f\n\tstr r3, [r4, %[tri]]\n\tb " next "\n1:\n\t"
#define ZS_CHAIN_OF [last] "i"(AT(tri_end)), [y1] "i"(AT(y1)), [tri] "i"(AT(tri))

/* The end of zs_fast.draw, of which 9b draws a triangle of the job at the stack's top, which has
 * `bytes`. 3: its rows are drawn, r0 pixels of them tested: count both, and go on with rows that
 * are left, and with the next triangle. 11: r0 is 0 where it is declined. stats, chain: where
 * their offsets are. */
#define ZS_DRAWN(stats, chain, bytes)                                                              \
    "3:\n\tldr r4, [sp]\n\tldr r3, [r4, %[r]]\n\tldr r2, " stats "\n\tadds r3, r2\n\t"             \
    "ldr r2, [r3]\n\tadds r2, #1\n\tstr r2, [r3]\n\t"                                              \
    "ldr r2, [r3, %[tested]]\n\tadds r2, r0\n\tstr r2, [r3, %[tested]]\n\t"                        \
    "ldr r0, [r4, %[end]]\n\tldr r1, [r4, %[row_end]]\n\tcmp r0, r1\n\tbge 7f\n\t"                 \
    "movs r0, r4\n\tbl go_on\n"                                                                   \
    "7:\n\tldr r4, [sp]\n\t" ZS_CHAIN(chain, "9b") "movs r0, #1\n4:\n\tadd sp, #" bytes "\n\t"    \
    ZS_RESTORED "11:\n\tcmp r0, #0\n\tbeq 4b\n\tb 7b\n"
/* 6: the triangle is drawn by otherwise(job). */
#define ZS_OTHERWISE(stats)                                                                        \
    "6:\n\tldr r0, [sp]\n\tldr r1, [r0, %[r]]\n\tldr r2, " stats "\n\tldr r3, [r1, r2]\n\t"        \
    "adds r3, #1\n\tstr r3, [r1, r2]\n\tbl otherwise\n\tb 7b\n\t"
#define ZS_DRAWN_OF                                                                                \
    [stats] "i"(offsetof(struct zs_renderer, stats.tris_setup)),                                   \
        [tested] "i"(offsetof(struct zs_stats, pixels_tested) -                                    \
                     offsetof(struct zs_stats, tris_setup))

#endif
