/* Set-up of smooth colours on Armv6-M, in assembler: it is zs_smooth_start (shade/smooth.c), bit
 * for bit, for tiny triangles that are affine. 400 cycles in place of 640. Scene teapot on an
 * RP2040 takes 0.36 of 7.77 million cycles less. 720 bytes. Thin ones, for which weights are too
 * coarse, 0.18 of 6.04; 620 bytes.
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

/* The plane of colour c to r0, which is moved. [sp]: weights y2, y1, x2, x1, then ia, ja, then
 * differences; r8: half, r9: down, r10: ax, r11: ay, r12: the first vertex's colours, lr: half a
 * code. */
#define PLANE(c, at, most, up)                                                                     \
    ZS_COLOR(c, at, most, 0)                                                                       \
    "adds r1, #16\n\tasrs r1, #5\n\t" ZS_CODE(c)                                                   \
    "ldr r4, [sp, #16]\n\tmuls r4, r2\n\tsubs r1, r4\n\t"                                          \
    "ldr r4, [sp, #20]\n\tmuls r4, r3\n\tsubs r1, r4\n\t"                                          \
    "add r1, lr\n\tlsls r1, #" #up "\n\tlsls r2, #" #up "\n\tlsls r3, #" #up "\n\t"                \
    "stmia r0!, {r1, r2, r3}\n\t"

ZS_NAKED void zs_set_up_smooth_part(void)
{
    __asm__ volatile(
        ".syntax unified\n\t"
        "push {lr}\n\tsub sp, #48\n\t"
        ZS_WEIGHTS(24, 32, 40)
        "mov r0, sp\n\tstmia r0!, {r2, r3, r4, r5}\n\t"
        "mov r7, r11\n\tadds r7, %[ia]\n\tldmia r7!, {r1, r2, r3, r4}\n\t"
        "stmia r0!, {r1, r2}\n\tmov r10, r3\n\tmov r0, r11\n\tmov r11, r4\n\t"
        "mov r1, r9\n\tmovs r2, #1\n\tlsls r2, r1\n\tlsrs r2, #1\n\tmov r8, r2\n\t"
        "movs r2, #128\n\tlsls r2, #8\n\tmov lr, r2\n\t"
        "adds r0, %[c]\n\tmovs r2, %[affine]\n\tstr r2, [r0, %[sub]]\n\t"
        PLANE(0, 24, 31, 11) PLANE(1, 32, 63, 10) PLANE(2, 40, 31, 11)
        "movs r0, #1\n"
        "7:\n\tadd sp, #48\n\tcmp r0, #0\n\tbge 1f\n\tmov r0, r11\n\t"
        "bl zs_set_up_coarse_part\n1:\n\tpop {pc}\n\t"
        :
        : ZS_WEIGHTS_OF, [ia] "i"(AT(geom.ia)), [c] "i"(AT(c)), [affine] "i"(ZS_AFFINE),
          [sub] "i"(AT(sub_log2) - AT(c)));
}

/* Colour c to the stack: its code at the first vertex, differences from it, the planes' shift. r2,
 * r3, r4: the corners' values. */
#define CODES(c, most, up)                                                                         \
    "ldrh r5, [r2, #2 * " #c "]\n\tmovs r7, #" #most "\n\tmuls r5, r7\n\tlsrs r6, r5, #16\n\t"     \
    "adds r5, r6\n\tldrh r6, [r3, #2 * " #c "]\n\tmuls r6, r7\n\tlsrs r1, r6, #16\n\t"             \
    "adds r6, r1\n\tsubs r6, r5\n\tldrh r1, [r4, #2 * " #c "]\n\tmuls r1, r7\n\t"                  \
    "lsrs r7, r1, #16\n\tadds r7, r1\n\tsubs r7, r5\n\tadd r1, sp, #16 * " #c "\n\t"               \
    "stmia r1!, {r5, r6, r7}\n\tmovs r7, #" #up "\n\tstr r7, [r1]\n\t"
#define CHANGES "mov r3, r9\n\tldr r4, [r3, #8]\n\tldr r3, [r3, #4]\n\t"

/* Where weights are too coarse, in thin triangles: each gradient by itself, as zs_plane32. r9:
 * the colour on the stack, where its plane takes its place, r10: gx, r11: the job. */
ZS_NAKED void zs_set_up_coarse_part(void)
{
    __asm__ volatile(
        ".syntax unified\n\t"
        "push {lr}\n\tsub sp, #48\n\t" VALUES
        CODES(0, 31, 11) CODES(1, 63, 10) CODES(2, 31, 11)
        "mov r11, r0\n\tmov r1, sp\n\tmov r9, r1\n"
        "4:\n\tmov r7, r11\n\tadds r7, %[rcp]\n\tldmia r7!, {r2, r3}\n\trsbs r7, r3, #0\n\t"
        "uxth r3, r2\n\tmov r12, r3\n\tlsrs r2, #16\n\tmov lr, r2\n\t"
        "mov r3, r11\n\tadds r3, %[geom] + 8\n\tldmia r3!, {r1, r2}\n\t"
        GRADIENT("0", CHANGES, "8f", "5", "6f") "mov r10, r3\n\t"
        "mov r3, r11\n\tadds r3, %[geom]\n\tldmia r3!, {r1, r2}\n\t"
        GRADIENT("1", CHANGES, "8f", "5", "6f") "rsbs r5, r3, #0\n\tmov r4, r10\n\t"
        "mov r6, r11\n\tadds r6, %[ia]\n\tldmia r6, {r1, r2, r3, r6}\n\t"
        "asrs r7, r4, #8\n\tmuls r7, r3\n\tasrs r0, r5, #8\n\tmuls r0, r6\n\tadds r7, r0\n\t"
        "uxtb r0, r4\n\tmuls r3, r0\n\tuxtb r0, r5\n\tmuls r6, r0\n\tadds r3, r6\n\t"
        "adds r3, #128\n\tasrs r3, #8\n\tadds r3, r7\n\t"
        "muls r1, r4\n\tsubs r3, r1\n\tmuls r2, r5\n\tsubs r3, r2\n\t"
        "mov r1, r9\n\tldr r2, [r1]\n\tadds r3, r2\n\tmovs r2, #128\n\tlsls r2, #8\n\t"
        "adds r3, r2\n\t"
        "ldr r2, [r1, #12]\n\tlsls r3, r2\n\tlsls r4, r2\n\tlsls r5, r2\n\t"
        "stmia r1!, {r3, r4, r5}\n\tadds r1, #4\n\tmov r9, r1\n\tadd r2, sp, #48\n\tcmp r1, r2\n\t"
        "beq 5f\n\tb 4b\n6:\n\tmovs r0, #0\n\tb 7f\n"
        "5:\n\tmov r0, r11\n\tadds r0, %[c]\n\tmovs r2, %[affine]\n\tstr r2, [r0, %[sub]]\n\t"
        "mov r1, sp\n\t"
        "ldmia r1!, {r3, r4, r5, r6}\n\tstmia r0!, {r3, r4, r5}\n\t"
        "ldmia r1!, {r3, r4, r5, r6}\n\tstmia r0!, {r3, r4, r5}\n\t"
        "ldmia r1!, {r3, r4, r5}\n\tstmia r0!, {r3, r4, r5}\n\tmovs r0, #1\n"
        "7:\n\tadd sp, #48\n\tpop {pc}\n\t"
        ".align 2\n8:\n\t.word zs_clz8\n"
        :
        : ZS_WEIGHTS_OF, [ia] "i"(AT(geom.ia)), [c] "i"(AT(c)), [affine] "i"(ZS_AFFINE),
          [sub] "i"(AT(sub_log2) - AT(c)));
}

ZS_NAKED int zs_set_up_smooth(struct zs_job *job __attribute__((unused)))
{
    __asm__ volatile(ZS_SAVED "bl zs_set_up_smooth_part\n\t" ZS_RESTORED);
}

#endif
