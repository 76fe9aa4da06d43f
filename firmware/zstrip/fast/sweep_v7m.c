/* Facing, box and bin of a mesh's triangles on Armv7-M, in assembler, for those that face the
 * eye, are small and have their vertices: some 110 instructions for one that is binned, in place
 * of 149; the pool's room is looked at once for all. On a Cortex-M3 it saves 3.6 % of scene
 * relief, 6.6 % of sheet (0.7 of 10.5 million instructions), and 0.9 and 1.6 % by reading the
 * colours of raw faces. 540 bytes.
 *
 * Exact: it is zs_sweep_each (fast/batch.c), which takes what is rare. tests/checks/v7m.c compares
 * them on an emulated M3 and M7; every frame on M3, M4 and M7 is binned by it
 * (tests/property/scene_sums.sh).
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/assemble.h"
#include "fast/sweep.h"

#if ZS_V7M

#define OF(field) offsetof(struct zs_sweep, field)
_Static_assert(OF(n_verts) == OF(pool) + 4 && OF(x_end) == OF(x) + 4 && OF(rows) == OF(row) + 4 &&
                   OF(strip_shift) == OF(strip_mul) + 4 && OF(n) == OF(bin) + 4 &&
                   OF(instance) == OF(base) + 2 && OF(face) == OF(varyings) + 4,
               "loaded two at a time");
_Static_assert(offsetof(struct zs_tri, next) == 6 && offsetof(struct zs_tri, paint) == 8 &&
                   offsetof(struct zs_tri, instance) == 10 && sizeof(struct zs_tri) == 12 &&
                   sizeof(struct zs_vertex) == 12,
               "as stored below");

/* r8: s, r10: the corners of the next triangle, r11: the next record. [sp]: end of the corners;
 * those of triangle 1, from which numbers count; base in both halves of a word. */

/* r0, r1, r2: numbers of the corners; r3, r4: the first one; r5, r6 and r7, r12: the others from
 * there. 8b: it is not small; 7b: it does not face the eye. */
#define LOOK                                                                                       \
    "1:\n\tldrh r0, [r10], #6\n\tldrh r1, [r10, #-2]\n\tldrh r2, [r10, #-4]\n\t"                   \
    "ldrd r12, lr, [r8, %[pool]]\n\tcmp r0, lr\n\titt cc\n\tcmpcc r1, lr\n\tcmpcc r2, lr\n\t"      \
    "bcs 8b\n\tmovs r7, #12\n\tmla r3, r0, r7, r12\n\tmla r5, r1, r7, r12\n\t"                     \
    "mla r7, r2, r7, r12\n\tldrd r3, r4, [r3]\n\tldrd r5, r6, [r5]\n\tldrd r7, r12, [r7]\n\t"      \
    "subs r5, r5, r3\n\tsubs r6, r6, r4\n\tsubs r7, r7, r3\n\tsub r12, r12, r4\n\t"                \
    "add lr, r5, #0x8000\n\tadd r9, r6, #0x8000\n\torr lr, lr, r9\n\tadd r9, r7, #0x8000\n\t"      \
    "orr lr, lr, r9\n\tadd r9, r12, #0x8000\n\torr lr, lr, r9\n\tcmp lr, #0x10000\n\tbcs 8b\n\t"   \
    "mul lr, r5, r12\n\tmls lr, r7, r6, lr\n\tcmp lr, #0\n\tble 7b\n\t"

/* The top corner first: r0, r2: the three, of which r0 holds two; r4, r6: rows from r4 to r6. */
#define TURN                                                                                       \
    "17:\n\tadds r4, #127\n\tadd lr, r6, r5, asr #31\n\tadd r9, r12, r7, asr #31\n\t"              \
    "orrs lr, lr, r9\n\tbmi 2f\n\t"                                                                \
    "orr r0, r0, r1, lsl #16\n\tcmp r6, r12\n\tit lt\n\tmovlt r6, r12\n\tadds r6, r6, r4\n\t"      \
    "b 4f\n"                                                                                       \
    "2:\n\tsub lr, r5, r7\n\tsub r9, r6, r12\n\tadds lr, r9, lr, asr #31\n\tbpl 3f\n\t"            \
    "orr lr, r1, r2, lsl #16\n\tmov r2, r0\n\tmov r0, lr\n\tbic r12, r12, r12, asr #31\n\t"        \
    "add r12, r12, r4\n\tadds r4, r4, r6\n\tmov r6, r12\n\tb 4f\n"                                 \
    "3:\n\torr r0, r2, r0, lsl #16\n\tmov r2, r1\n\tbic r6, r6, r6, asr #31\n\t"                   \
    "adds r6, r6, r4\n\tadd r4, r4, r12\n"                                                         \
    "4:\n\tasrs r4, r4, #8\n\tasrs r6, r6, #8\n\t"

/* Columns from lr to r5. 6f: outside those that are drawn; 9f: no column, no row, or not in the
 * band's rows; back at 5. r7: the strip. */
#define BOX                                                                                        \
    "cmp r5, r7\n\tite lt\n\tmovlt lr, r5\n\tmovge lr, r7\n\tit lt\n\tmovlt r5, r7\n\t"            \
    "and lr, lr, lr, asr #31\n\tbic r5, r5, r5, asr #31\n\tadds r3, #127\n\tadd lr, lr, r3\n\t"    \
    "add r5, r5, r3\n\tasr lr, lr, #8\n\tasrs r5, r5, #8\n\t"                                      \
    "ldrd r7, r9, [r8, %[x]]\n\tcmp r5, r7\n\tble 6f\n\tcmp lr, r9\n\tbge 6f\n\t"                  \
    "cmp lr, r5\n\tbge 9f\n\tcmp r4, r6\n\tbge 9f\n\t"                                             \
    "ldrd r7, r9, [r8, %[row]]\n\tsubs r7, r4, r7\n\tcmp r7, r9\n\tbcs 9f\n\t"                     \
    "ldrd r7, r9, [r8, %[mul]]\n\tmul r7, r4, r7\n\tlsr r7, r7, r9\n"

/* Append the record to the strip's bin. 10f: with attributes; back at 11. */
#define PLACE                                                                                      \
    "5:\n\tldrd r1, r3, [r8, %[bin]]\n\tadd r1, r1, r7, lsl #1\n\tldrh r7, [r1]\n\t"               \
    "strh r3, [r1]\n\tadds r3, #1\n\tstr r3, [r8, %[n]]\n\t"                                       \
    "ldr r3, [sp, #8]\n\tldr r4, [r8, %[base]]\n\t"                                                \
    "adds r0, r0, r3\n\tadds r2, r2, r3\n\tbfi r2, r7, #16, #16\n\tstrd r0, r2, [r11], #12\n\t"    \
    "ldrd r1, r2, [r8, %[varyings]]\n\tstr r4, [r11, #-4]\n\tcbnz r1, 10f\n"                       \
    "11:\n\tcbnz r2, 12f\n\tldr r0, [r8, %[raw]]\n\tcbz r0, 13f\n\tldr r1, [sp, #4]\n\t"           \
    "sub r1, r10, r1\n\tldr r3, 30f\n\tmuls r1, r3, r1\n\tldrh r0, [r0, r1]\n\trev16 r0, r0\n"     \
    "13:\n\tstrh r0, [r11, #-4]\n\tb 7f\n"                                                         \
    "12:\n\tldr r1, [sp, #4]\n\tsub r1, r10, r1\n\tlsrs r1, r1, #1\n\tldr r3, 30f\n\t"             \
    "muls r1, r3, r1\n\tldr r0, [r8]\n\tadd r0, r0, %[shading]\n\tblx r2\n\tb 13b\n"               \
    "10:\n\tmov r0, r8\n\tsub r1, r11, #12\n\tbl zs_sweep_attributes\n\t"                          \
    "ldr r2, [r8, %[face]]\n\tb 11b\n"                                                             \
    "6:\n\tldr r0, [r8, %[outcome]]\n\tldr r1, [r0, %[off]]\n\tadds r1, #1\n\t"                    \
    "str r1, [r0, %[off]]\n\tb 7f\n"                                                               \
    "9:\n\tpush {r0, r2}\n\tcmp lr, r5\n\tite ge\n\tmovge r1, #1\n\tmovlt r1, #0\n\t"              \
    "mov r0, r8\n\tmov r2, r4\n\tmov r3, r6\n\tbl zs_sweep_aside\n\tmov r7, r0\n\t"                \
    "pop {r0, r2}\n\tmovw r1, #0xffff\n\tcmp r7, r1\n\tbne 5b\n"

/* Bin those that face the eye and are small, up to `end` or to one that is for zs_sweep_each();
 * return its number. s->keep >= 0, and the pool has room for all. */
ZS_NAKED uint32_t zs_sweep_by_hand(struct zs_sweep *s ZS_TAKEN, uint32_t t ZS_TAKEN,
                                   uint32_t end ZS_TAKEN, const uint16_t (*tri)[3] ZS_TAKEN)
{
    __asm__ volatile(".syntax unified\n\tpush {r3, r4, r5, r6, r7, r8, r9, r10, r11, lr}\n\t"
        "sub sp, #16\n\tmov r8, r0\n\tmov r10, r3\n\tldr r11, [r0, %[out]]\n\t"
        "movs r4, #6\n\tmls r5, r1, r4, r3\n\tadds r6, r5, r4\n\tmla r7, r2, r4, r5\n\t"
        "ldrh r0, [r0, %[base]]\n\torr r0, r0, r0, lsl #16\n\t"
        "strd r7, r6, [sp]\n\tstr r0, [sp, #8]\n\tb 14f\n"
        /* the one before r10 has no area, or is turned away: where none is culled it is turned */
        "7:\n\tbeq 15f\n\tldr r9, [r8, %[keep]]\n\tcmp r9, #0\n\tbne 14f\n\t"
        "mov r9, r1\n\tmov r1, r2\n\tmov r2, r9\n\tmov r9, r5\n\tmov r5, r7\n\tmov r7, r9\n\t"
        "mov r9, r6\n\tmov r6, r12\n\tmov r12, r9\n\tb 17f\n"
        "15:\n\tsub r10, r10, #6\n\tb 16f\n"
        /* it is outside, or ends this */
        "8:\n\tmov r0, r8\n\tsub r1, r10, #6\n\tbl zs_sweep_outside\n\tcmp r0, #0\n\tbeq 15b\n"
        "14:\n\tldr r0, [sp]\n\tcmp r10, r0\n\tbeq 16f\n\t"
        LOOK TURN BOX PLACE
        "7:\n\tldr r0, [sp]\n\tcmp r10, r0\n\tbne 1b\n"
        "16:\n\tldr r1, [sp, #4]\n\tsub r0, r10, r1\n\tadds r0, #6\n\tlsrs r0, r0, #1\n\t"
        "ldr r3, 30f\n\tmuls r0, r3, r0\n\tstr r11, [r8, %[out]]\n\t"
        "add sp, #16\n\tpop {r3, r4, r5, r6, r7, r8, r9, r10, r11, pc}\n\t"
        ".align 2\n30:\n\t.word 0xaaaaaaab\n"
        :
        : [pool] "i"(OF(pool)), [keep] "i"(OF(keep)), [base] "i"(OF(base)), [out] "i"(OF(out)),
          [x] "i"(OF(x)), [row] "i"(OF(row)), [mul] "i"(OF(strip_mul)), [bin] "i"(OF(bin)),
          [n] "i"(OF(n)), [varyings] "i"(OF(varyings)), [face] "i"(OF(face)), [raw] "i"(OF(raw)),
          [outcome] "i"(OF(outcome)), [off] "i"(4 * ZS_OUTCOME_OFFSCREEN),
          [shading] "i"(offsetof(struct zs_renderer, shading)));
}

#endif
