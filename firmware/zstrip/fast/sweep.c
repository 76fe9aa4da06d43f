/* Facing, box and bin of a mesh's triangles on Armv6-M, in assembler, for those that face the eye,
 * are small and have their vertices: 62 cycles where a triangle is turned away, 190 where it is
 * binned, in place of 78 and 330. Scene teapot on an RP2040 takes 0.21 of 6.7 million cycles less.
 * 640 bytes.
 *
 * Exact: it is zs_sweep_each (fast/batch.c), which takes what is rare; every frame on an Armv6-M
 * is drawn by it (tests/property/scene_sums.sh, tests/boards/pico.sh).
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/assemble.h"
#include "fast/sweep.h"

#if ZS_SET_UP

#define OF(field) offsetof(struct zs_sweep, field)
_Static_assert(OF(x_end) == OF(x) + 4 && OF(full) < 128 && OF(instance) < 64 && OF(base) < 64,
               "loads reach so far");
_Static_assert(offsetof(struct zs_tri, next) == 6 && offsetof(struct zs_tri, paint) == 8 &&
                   offsetof(struct zs_tri, instance) == 10 && sizeof(struct zs_tri) == 12,
               "as stored below");

/* The next triangle: r0, r1: its first vertex; r2, r3 and r6, r7: the others from there; r4: twice
 * its area. 8b: it is not small. */
#define LOOK                                                                                       \
    "1:\n\tmov r7, r11\n\tldrh r4, [r7]\n\tldrh r5, [r7, #4]\n\tldrh r6, [r7, #2]\n\t"             \
    "adds r7, #6\n\tmov r11, r7\n\t"                                                               \
    "mov r0, r10\n\tcmp r4, r0\n\tbcs 8b\n\tcmp r5, r0\n\tbcs 8b\n\tcmp r6, r0\n\tbcs 8b\n\t"      \
    "movs r0, #12\n\tmuls r4, r0\n\tmuls r5, r0\n\tmuls r6, r0\n\t"                                \
    "add r4, r9\n\tadd r5, r9\n\tadd r6, r9\n\t"                                                   \
    "ldmia r4!, {r0, r1}\n\tldmia r5!, {r2, r3}\n\tldmia r6, {r6, r7}\n\t"                         \
    "subs r2, r0\n\tsubs r3, r1\n\tsubs r6, r0\n\tsubs r7, r1\n\t"                                 \
    "sxth r4, r2\n\tcmp r4, r2\n\tbne 8b\n\tsxth r4, r3\n\tcmp r4, r3\n\tbne 8b\n\t"               \
    "sxth r4, r6\n\tcmp r4, r6\n\tbne 8b\n\tsxth r4, r7\n\tcmp r4, r7\n\tbne 8b\n\t"               \
    "movs r4, r2\n\tmuls r4, r7\n\tmovs r5, r6\n\tmuls r5, r3\n\tsubs r4, r5\n\t"

/* The corners' numbers to the record r0, from the mesh's at r4: first, second, third. */
#define CORNERS(first, second, third)                                                              \
    "ldrh r5, [r4, #" first "]\n\tadd r5, lr\n\tstrh r5, [r0]\n\t"                                 \
    "ldrh r5, [r4, #" second "]\n\tadd r5, lr\n\tstrh r5, [r0, #2]\n\t"                            \
    "ldrh r5, [r4, #" third "]\n\tadd r5, lr\n\tstrh r5, [r0, #4]\n\t"

/* The record's corners, the top one first; r5: s. */
#define TURN                                                                                       \
    "mov r5, r8\n\tldr r4, [r5, %[full]]\n\tldr r5, [r5, %[out]]\n\t"                              \
    "cmp r5, r4\n\tbeq 14b\n\t"                                                                    \
    "mov r12, r0\n\tmovs r0, r5\n\t"                                                               \
    "asrs r4, r2, #31\n\tadds r4, r3\n\tasrs r5, r6, #31\n\tadds r5, r7\n\t"                       \
    "orrs r4, r5\n\tbmi 2f\n\t"                                                                    \
    "mov r4, r11\n\tsubs r4, #6\n\t" CORNERS("0", "4", "2") "b 4f\n"                               \
    "2:\n\tsubs r4, r2, r6\n\tasrs r4, #31\n\tsubs r5, r3, r7\n\tadds r4, r5\n\tbmi 3f\n\t"        \
    "mov r4, r11\n\tsubs r4, #6\n\t" CORNERS("2", "0", "4") "b 4f\n"                               \
    "3:\n\tmov r4, r11\n\tsubs r4, #6\n\t" CORNERS("4", "2", "0") "4:\n\t"

/* first = first sample at or after the least of 0, first and last, from `from`; last: the greatest.
 * Uses r4. */
#define SAMPLES(from, first, last)                                                                 \
    "cmp " first ", " last "\n\tble 1f\n\t"                                                        \
    "movs r4, " first "\n\tmovs " first ", " last "\n\tmovs " last ", r4\n"                        \
    "1:\n\tasrs r4, " first ", #31\n\tands " first ", r4\n\t"                                      \
    "asrs r4, " last ", #31\n\tbics " last ", r4\n\tadds " from ", #127\n\t"                       \
    "adds " first ", " from "\n\tadds " last ", " from "\n\t"                                      \
    "asrs " first ", #8\n\tasrs " last ", #8\n\t"

/* Compute the attributes of corner k of the record r1, if they are not known. r5: words a vertex,
 * r6: all attributes, r7: what says so. */
#define ATTRIBUTES(k)                                                                              \
    "ldrh r2, [r1, #" k "]\n\tmuls r2, r5\n\tlsls r2, #1\n\tldrh r3, [r6, r2]\n\t"                 \
    "cmp r3, r7\n\tbne 1f\n\tldrh r1, [r1, #" k "]\n\tadds r2, r6\n\tldr r0, [r4]\n\t"             \
    "bl zs_bin_attributes\n\tldr r1, [r4, %[out]]\n\tsubs r1, #12\n"                               \
    "1:\n\t"

/* r1: the number of the triangle before r11. Bytes by 6: by 2, then by 3 modulo 2^32. Uses r2. */
#define NUMBER                                                                                     \
    "ldr r1, [sp]\n\tmov r2, r11\n\tsubs r1, r2\n\tlsrs r1, #1\n\tldr r2, 11f\n\tmuls r1, r2\n\t"  \
    "ldr r2, [sp, #8]\n\tsubs r1, r2, r1\n\tsubs r1, #1\n\t"

/* r0: the strip of columns [r2, r6), rows [r3, r7); r4: s. What is drawn in none is counted. */
#define BOX                                                                                        \
    "mov r4, r8\n\tldr r0, [r4, %[x]]\n\tcmp r6, r0\n\tble 6f\n\tldr r0, [r4, %[x_end]]\n\t"       \
    "cmp r2, r0\n\tbge 6f\n\tmovs r1, #1\n\tcmp r2, r6\n\tbge 3f\n\t"                              \
    "movs r1, #0\n\tcmp r3, r7\n\tbge 3f\n\t"                                                      \
    "ldr r0, [r4, %[row]]\n\tsubs r0, r3, r0\n\tldr r2, [r4, %[rows]]\n\tcmp r0, r2\n\tbcs 3f\n\t" \
    "ldr r0, [r4, %[mul]]\n\tmuls r0, r3\n\tldr r1, [r4, %[shift]]\n\tlsrs r0, r1\n\tb 4f\n"       \
    "3:\n\tmov r0, r8\n\tmovs r2, r3\n\tmovs r3, r7\n\tbl zs_sweep_aside\n\t"                      \
    "ldrh r1, [r4, %[base]]\n\tmov lr, r1\n\tadds r1, r0, #1\n\tlsrs r1, #16\n\tbeq 4f\n\tb 5b\n"  \
    "6:\n\tldr r0, [r4, %[outcome]]\n\tldr r1, [r0, %[off]]\n\tadds r1, #1\n\t"                    \
    "str r1, [r0, %[off]]\n\tb 5b\n"                                                               \
    "4:\n\t"

/* Append the record to strip r0's bin. */
#define PLACE                                                                                      \
    "ldr r1, [r4, %[out]]\n\tldrh r2, [r4, %[instance]]\n\tstrh r2, [r1, #10]\n\t"                 \
    "lsls r0, #1\n\tldr r2, [r4, %[bin]]\n\tldrh r3, [r2, r0]\n\tstrh r3, [r1, #6]\n\t"            \
    "ldr r3, [r4, %[n]]\n\tstrh r3, [r2, r0]\n\tadds r3, #1\n\tstr r3, [r4, %[n]]\n\t"             \
    "movs r2, r1\n\tadds r2, #12\n\tstr r2, [r4, %[out]]\n\t"                                      \
    "ldr r5, [r4, %[varyings]]\n\tcmp r5, #0\n\tbeq 2f\n\t"                                        \
    "ldr r0, [r4]\n\tmovs r2, %[attr]\n\tldr r6, [r0, r2]\n\tldr r7, 12f\n\t"                      \
    ATTRIBUTES("0") ATTRIBUTES("2") ATTRIBUTES("4")                                                \
    "ldrh r0, [r4, %[base]]\n\tmov lr, r0\n"                                                       \
    "2:\n\tldr r3, [r4, %[face]]\n\tmovs r0, #0\n\tcmp r3, #0\n\tbne 3f\n\t"                       \
    "strh r0, [r1, #8]\n\tb 5b\n"                                                                  \
    "3:\n\t" NUMBER                                                                                \
    "ldr r0, [r4]\n\tldr r2, 13f\n\tadds r0, r2\n\tblx r3\n\t"                                     \
    "ldr r1, [r4, %[out]]\n\tsubs r1, #4\n\tstrh r0, [r1]\n\tb 7b\n\t"                             \
    ".align 2\n"                                                                                   \
    "11:\n\t.word 0xaaaaaaab\n12:\n\t.word %c[unknown]\n13:\n\t.word %c[shading]\n"

#define OPERANDS                                                                                   \
    : [pool] "i"(OF(pool)), [n_verts] "i"(OF(n_verts)), [keep] "i"(OF(keep)), [base] "i"(OF(base)),\
      [full] "i"(OF(full)), [out] "i"(OF(out)), [x] "i"(OF(x)), [x_end] "i"(OF(x_end)),            \
      [row] "i"(OF(row)), [rows] "i"(OF(rows)), [mul] "i"(OF(strip_mul)),                          \
      [shift] "i"(OF(strip_shift)), [outcome] "i"(OF(outcome)),                                    \
      [off] "i"(4 * ZS_OUTCOME_OFFSCREEN), [instance] "i"(OF(instance)), [bin] "i"(OF(bin)),       \
      [n] "i"(OF(n)), [varyings] "i"(OF(varyings)), [face] "i"(OF(face)),                          \
      [attr] "i"(offsetof(struct zs_renderer, attr)), [unknown] "i"(ZS_ATTR_UNKNOWN),              \
      [shading] "i"(offsetof(struct zs_renderer, shading))

/* Bin those that face the eye and are small, up to `end` or to one that is for zs_sweep_each();
 * return its number. r8: s, r9: pool, r10: n_verts, r11: the next triangle's corners; lr: base.
 * [sp]: end of the corners, keep, end. */
ZS_NAKED uint32_t zs_sweep_by_hand(struct zs_sweep *s ZS_TAKEN, uint32_t t ZS_TAKEN,
                                   uint32_t end ZS_TAKEN, const uint16_t (*tri)[3] ZS_TAKEN)
{
    __asm__ volatile(
        ".syntax unified\n\t"
        "push {r4, r5, r6, r7, lr}\n\t"
        "mov r4, r8\n\tmov r5, r9\n\tmov r6, r10\n\tmov r7, r11\n\tpush {r4, r5, r6, r7}\n\t"
        "sub sp, #12\n\tmov r8, r0\n\tmov r11, r3\n\tstr r2, [sp, #8]\n\tsubs r2, r1\n\t"
        "movs r4, #6\n\tmuls r2, r4\n\tadds r3, r2\n\tstr r3, [sp]\n\t"
        "ldr r1, [r0, %[pool]]\n\tmov r9, r1\n\tldr r1, [r0, %[n_verts]]\n\tmov r10, r1\n\t"
        "ldr r1, [r0, %[keep]]\n\tstr r1, [sp, #4]\n\tb 7f\n"
        /* the one before r11 is outside, or ends this */
        "8:\n\tmov r0, r8\n\tmov r1, r11\n\tsubs r1, #6\n\tbl zs_sweep_outside\n\t"
        "cmp r0, #0\n\tbne 7f\n"
        "14:\n\t" NUMBER "movs r0, r1\n\tb 10f\n"
        "7:\n\tmov r4, r8\n\tldrh r1, [r4, %[base]]\n\tmov lr, r1\n\tb 5f\n" LOOK
        "ldr r5, [sp, #4]\n\tmuls r5, r4\n\tbpl 2f\n"
        "5:\n\tldr r0, [sp]\n\tcmp r0, r11\n\tbne 1b\n\tldr r0, [sp, #8]\n"
        "10:\n\tadd sp, #12\n\tpop {r4, r5, r6, r7}\n\t"
        "mov r8, r4\n\tmov r9, r5\n\tmov r10, r6\n\tmov r11, r7\n\tpop {r4, r5, r6, r7, pc}\n"
        "2:\n\tcmp r4, #0\n\tble 14b\n\t" TURN
        "mov r0, r12\n\t" SAMPLES("r0", "r2", "r6") SAMPLES("r1", "r3", "r7") BOX PLACE
        : OPERANDS);
}

#endif
