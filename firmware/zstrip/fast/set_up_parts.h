/* What set-up in assembler shares. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_SET_UP_PARTS_H
#define ZS_SET_UP_PARTS_H

#include "fast/set_up.h"

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

#endif
