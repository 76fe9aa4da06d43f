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
        "7:\n\tadd sp, #48\n\tpop {pc}\n\t"
        :
        : ZS_WEIGHTS_OF, [ia] "i"(AT(geom.ia)), [c] "i"(AT(c)), [affine] "i"(ZS_AFFINE),
          [sub] "i"(AT(sub_log2) - AT(c)));
}

ZS_NAKED int zs_set_up_smooth(struct zs_job *job __attribute__((unused)))
{
    __asm__ volatile(ZS_SAVED "bl zs_set_up_smooth_part\n\t" ZS_RESTORED);
}

#endif
