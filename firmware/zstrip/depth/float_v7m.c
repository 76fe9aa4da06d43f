/* Vertices to the screen on Armv7-M, in assembler, for a perspective camera with all sub-pixel bits
 * and floating-point depth: 72 instructions a vertex in place of 84. On a Cortex-M3 it saves 1.2 %
 * of scene relief, 1.3 % of sheet; flyover, where many vertices are outside, takes 0.7 % more. 300
 * bytes, in programs that name one of these mappings.
 *
 * Exact: it is screen() of fast/screen.c with the depth of depth/float.c. tests/checks/v7m.c
 * compares it with the core on an emulated M3 and M7; most frames on M3, M4 and M7 have their
 * vertices from it (tests/property/scene_sums.sh).
 *
 * SPDX-License-Identifier: MIT
 */
#include "arch/screen_v7m.h"
#include "core/depth.h"
#include "core/fx.h"

#if ZS_V7M

#define IS(field, at) (offsetof(struct zs_screen_of, field) == (at))
_Static_assert(IS(range, 4) && IS(down, 8) && IS(common, 12) && IS(cx, 16) && IS(mul, 24) &&
                   IS(fraction, 32) && IS(view, 40) && sizeof(struct zs_vertex) == 12,
               "as below");

/* r1, r2, r3: x, y, z; 9f: it is nearer than near, or farther than far. */
#define LOOK                                                                                       \
    "ldmia r12, {r1, r2, r3}\n\tldrd r4, r5, [r0]\n\tsubs r4, r3, r4\n\tcmp r4, r5\n\tbhi 9f\n\t"
/* r6: leading zeros of z; r8: its reciprocal, zs_recip_inline(z 2^r6). */
#define RECIPROCAL                                                                                 \
    "clz r6, r3\n\tlsl r7, r3, r6\n\tubfx r8, r7, #23, #8\n\tubfx r9, r7, #7, #16\n\t"             \
    "add r10, r11, r8, lsl #1\n\tldrh r8, [r10]\n\tldrh r10, [r10, #2]\n\t"                        \
    "sub r10, r8, r10\n\tmul r10, r10, r9\n\tlsl r8, r8, #15\n\torr r8, r8, #0x80000000\n\t"       \
    "sub r8, r8, r10, lsr #1\n\tumull r10, r9, r7, r8\n\trsb r9, r9, #0x80000000\n\t"              \
    "smull r10, r3, r8, r9\n\tlsls r3, r3, #1\n\torr r3, r3, r10, lsr #31\n\tadd r8, r8, r3\n\t"   \
    "adds r8, r8, r9, lsl #1\n\tit pl\n\tmovpl r8, #-1\n\t"
/* r4, r5: where it is; 9f: far from the middle, or its product needs more bits. */
#define PROJECT                                                                                    \
    "ldrd r9, r10, [r0, #8]\n\tsub r9, r9, r6\n\tcmp r9, #31\n\tbhi 9f\n\t"                        \
    "eor r4, r1, r1, asr #31\n\tsub r4, r4, r1, asr #31\n\t"                                       \
    "eor r5, r2, r2, asr #31\n\tsub r5, r5, r2, asr #31\n\t"                                       \
    "umull r3, r4, r4, r8\n\tumull r3, r5, r5, r8\n\tlsr r4, r4, r9\n\tlsr r5, r5, r9\n\t"         \
    "adds r4, #1\n\tadds r5, #1\n\torr r3, r4, r5\n\tcmp r3, #0x200000\n\tbcs 9f\n\t"              \
    "asrs r1, r1, #31\n\tasrs r2, r2, #31\n\teor r4, r1, r4, lsr #1\n\teor r5, r2, r5, lsr #1\n\t" \
    "subs r4, r4, r1\n\tsubs r5, r5, r2\n\tldrd r1, r2, [r0, #16]\n\tadd r4, r4, r1\n\t"           \
    "add r5, r5, r2\n\t"
/* r7: its depth; 8f: it is in a far octave, or nearer than near; back at 7. r10: number of
 * octaves. */
#define DEPTH                                                                                      \
    "ldrd r1, r2, [r0, #24]\n\tumull r3, r1, r1, r8\n\tadd r6, r6, r2\n\tcmp r1, #0\n\t"           \
    "itt ge\n\taddge r6, #-1\n\tlslge r1, r1, #1\n\tcmp r6, r10\n\tbcs 8f\n\t"                     \
    "ldrd r2, r7, [r0, #32]\n\tlsl r6, r6, r2\n\tsub r7, r7, r6\n\trsb r2, r2, #30\n\t"            \
    "lsrs r1, r2\n\tadds r1, #1\n\tsub r7, r7, r1, lsr #1\n"

ZS_NAKED struct zs_vertex *zs_screen_v7m(const struct zs_screen_of *of ZS_TAKEN,
                                         struct zs_vertex *at ZS_TAKEN,
                                         struct zs_vertex *end ZS_TAKEN)
{
    __asm__ volatile(
        ".syntax unified\n\tpush {r4, r5, r6, r7, r8, r9, r10, r11, r12, lr}\n\t"
        "mov r12, r1\n\tmov lr, r2\n\tldr r11, 30f\n\tcmp r12, lr\n\tbeq 9f\n"
        "1:\n\t" LOOK RECIPROCAL PROJECT DEPTH
        "7:\n\tstrd r4, r5, [r12], #12\n\tstr r7, [r12, #-4]\n\tcmp r12, lr\n\tbne 1b\n"
        "9:\n\tmov r0, r12\n\tpop {r4, r5, r6, r7, r8, r9, r10, r11, r12, pc}\n"
        "8:\n\tpush {r0, r1, r12, lr}\n\tldr r0, [r0, #40]\n\tldr r1, [r12, #8]\n\t"
        "mov r2, r8\n\tclz r3, r1\n\tbl zs_float_vertex\n\tmov r7, r0\n\t"
        "pop {r0, r1, r12, lr}\n\tb 7b\n\t.align 2\n30:\n\t.word zs_recip_table\n");
}

#endif
