/* Set-up of smooth colours on Armv6-M, in assembler: it is zs_smooth_start (shade/smooth.c), bit
 * for bit, for tiny triangles that are affine. 400 cycles in place of 640. Scene teapot on an
 * RP2040 takes 0.36 of 7.77 million cycles less. 724 bytes.
 *
 * Exact: tests/checks/set_up.c compares it with zs_smooth_start on an emulated Cortex-M0.
 *
 * SPDX-License-Identifier: MIT
 */
#include "fast/set_up_parts.h"

#if ZS_SET_UP

#include "shade/persp.h"

_Static_assert(sizeof(((struct zs_config *)0)->varyings) == 1 && sizeof(struct zs_plane) == 12 &&
                   AT(geom.rcp) == AT(geom) + 40 && AT(geom.exp) == AT(geom) + 44 &&
                   AT(geom.tiny) == AT(geom) + 48 && AT(geom.ay) == AT(geom.ia) + 12 &&
                   AT(key_known) == AT(key_slow) + 4,
               "as loaded below");

/* r1 becomes r7, if that is more. */
#define MOST "cmp r7, r1\n\tbls 1f\n\tmovs r1, r7\n1:\n\t"

/* The weights' product for one difference: r0: up, r6: rcp, r7: half, r1: n. */
#define WEIGHT(d) "lsls " #d ", r0\n\tmuls " #d ", r6\n\tadds " #d ", r7\n\tasrs " #d ", r1\n\t"

/* The plane of colour c to r0, which is moved. [sp]: weights y2, y1, x2, x1, then ia, ja, then
 * differences; r8: half, r9: down, r10: ax, r11: ay, r12: the first vertex's colours, lr: half a
 * code. */
#define PLANE(c, at, most, up)                                                                     \
    "ldr r5, [sp, #" #at "]\n\tldr r6, [sp, #4 + " #at "]\n\tmovs r7, #" #most "\n\t"              \
    "muls r5, r7\n\tmuls r6, r7\n\tadds r5, #128\n\tasrs r5, #8\n\t"                               \
    "adds r6, #128\n\tasrs r6, #8\n\t"                                                             \
    "ldr r2, [sp, #12]\n\tmuls r2, r5\n\tldr r4, [sp, #8]\n\tmuls r4, r6\n\tsubs r2, r4\n\t"       \
    "ldr r3, [sp]\n\tmuls r3, r6\n\tldr r4, [sp, #4]\n\tmuls r4, r5\n\tsubs r3, r4\n\t"            \
    "add r2, r8\n\tadd r3, r8\n\tmov r4, r9\n\tasrs r2, r4\n\tasrs r3, r4\n\t"                     \
    "asrs r1, r2, #3\n\tmov r4, r10\n\tmuls r1, r4\n\tasrs r4, r3, #3\n\tmov r5, r11\n\t"          \
    "muls r4, r5\n\tadds r1, r4\n\tadds r1, #16\n\tasrs r1, #5\n\t"                                \
    "mov r5, r12\n\tldrh r4, [r5, #2 * " #c "]\n\tmuls r4, r7\n\tlsrs r5, r4, #16\n\t"             \
    "adds r4, r5\n\tadds r1, r4\n\t"                                                               \
    "ldr r4, [sp, #16]\n\tmuls r4, r2\n\tsubs r1, r4\n\t"                                          \
    "ldr r4, [sp, #20]\n\tmuls r4, r3\n\tsubs r1, r4\n\t"                                          \
    "add r1, lr\n\tlsls r1, #" #up "\n\tlsls r2, #" #up "\n\tlsls r3, #" #up "\n\t"                \
    "stmia r0!, {r1, r2, r3}\n\t"

ZS_NAKED int zs_set_up_smooth(struct zs_job *job __attribute__((unused)))
{
    __asm__ volatile(
        ".syntax unified\n\t"
        "push {r4, r5, r6, r7, lr}\n\t"
        "mov r4, r8\n\tmov r5, r9\n\tmov r6, r10\n\tmov r7, r11\n\tpush {r4, r5, r6, r7}\n\t"
        "sub sp, #48\n\t"
        VALUES "mov r12, r2\n\tmovs r1, #0\n\t"
        RANGE(0, 24) MOST RANGE(1, 32) MOST RANGE(2, 40) MOST
        "mov r11, r0\n\tmov lr, r1\n\tmovs r1, r0\n\t" SLOW("9f") "mov r1, lr\n\t"
        /* affine_enough, the sufficient test */
        "lsrs r4, #16\n\tadds r4, #1\n\tmuls r4, r1\n\tlsrs r6, %[bound]\n\tcmp r4, r6\n\t"
        "bhi 9f\n\t"
        /* n: r1 */
        "ldr r7, 8f\n\tmovs r2, #1\n\torrs r1, r2\n\tlsrs r2, r1, #8\n\tbne 1f\n\t"
        "ldrb r2, [r7, r1]\n\tmovs r3, #8\n\tb 2f\n"
        "1:\n\tldrb r2, [r7, r2]\n\tmovs r3, #16\n"
        "2:\n\tsubs r1, r3, r2\n\t"
        /* dx, dy: r2 to r5; up: r0 */
        "mov r0, r11\n\tadds r0, %[geom]\n\tldr r2, [r0, #48]\n\tcmp r2, #0\n\tbeq 9f\n\t"
        "ldmia r0!, {r2, r3, r4, r5}\n\t"
        "asrs r6, r2, #31\n\teors r6, r2\n\tasrs r0, r3, #31\n\teors r0, r3\n\t"
        "orrs r6, r0\n\torrs r6, r4\n\torrs r6, r5\n\tlsrs r0, r6, #8\n\tbne 1f\n\t"
        "ldrb r0, [r7, r6]\n\tadds r0, #7\n\tb 2f\n"
        "9:\n\tmovs r0, #0\n\tb 7f\n\t"
        ".align 2\n"
        "8:\n\t.word zs_clz8\n"
        "1:\n\tldrb r0, [r7, r0]\n\tsubs r0, #1\n"
        /* rcp: r6, down: r7 */
        "2:\n\tmov r7, r11\n\tadds r7, %[rcp]\n\tldr r6, [r7]\n\tldr r7, [r7, #4]\n\t"
        "adds r7, r0\n\tadds r7, #31\n\tsubs r7, r1\n\tcmp r7, #5\n\tblt 9b\n\tmov r9, r7\n\t"
        "adds r7, r0\n\tadds r7, #3\n\tcmp r1, r7\n\tbgt 9b\n\t"
        "lsrs r6, #16\n\tmovs r7, #1\n\tlsls r7, r1\n\tlsrs r7, #1\n\t"
        WEIGHT(r2) WEIGHT(r3) WEIGHT(r4) WEIGHT(r5)
        "mov r0, sp\n\tstmia r0!, {r2, r3, r4, r5}\n\t"
        "mov r7, r11\n\tadds r7, %[ia]\n\tldmia r7!, {r1, r2, r3, r4}\n\t"
        "stmia r0!, {r1, r2}\n\tmov r10, r3\n\tmov r0, r11\n\tmov r11, r4\n\t"
        "mov r1, r9\n\tmovs r2, #1\n\tlsls r2, r1\n\tlsrs r2, #1\n\tmov r8, r2\n\t"
        "movs r2, #128\n\tlsls r2, #8\n\tmov lr, r2\n\t"
        "adds r0, %[c]\n\tmovs r2, %[affine]\n\tstr r2, [r0, %[sub]]\n\t"
        PLANE(0, 24, 31, 11) PLANE(1, 32, 63, 10) PLANE(2, 40, 31, 11)
        "movs r0, #1\n"
        "7:\n\tadd sp, #48\n\tpop {r4, r5, r6, r7}\n\t"
        "mov r8, r4\n\tmov r9, r5\n\tmov r10, r6\n\tmov r11, r7\n\tpop {r4, r5, r6, r7, pc}\n\t"
        :
        : [r] "i"(AT(r)), [tri] "i"(AT(tri)), [attr] "i"(offsetof(struct zs_renderer, attr)),
          [n] "i"(offsetof(struct zs_renderer, config.varyings)), [v] "i"(AT(v)),
          [slow] "i"(AT(key_slow) - AT(v) - 12), [bound] "i"(ZS_SPAN_BOUND_LOG2 + 4),
          [geom] "i"(AT(geom)), [rcp] "i"(AT(geom.rcp)), [ia] "i"(AT(geom.ia)), [c] "i"(AT(c)),
          [affine] "i"(ZS_AFFINE), [sub] "i"(AT(sub_log2) - AT(c)));
}

#endif
