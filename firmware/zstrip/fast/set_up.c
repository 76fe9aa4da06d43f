/* Set-up of tiny triangles on Armv6-M, in assembler: rows, area and its reciprocal, and the plane
 * of the keys. It is what core/raster.c and core/plane.c do for them, bit for bit, whose compiler
 * spills on a core with eight registers: 380 cycles in place of 620. Scene teapot on an RP2040
 * takes 0.42 of 7.77 million cycles less. 748 bytes.
 *
 * Exact: tests/checks/set_up.c compares it with the core on an emulated Cortex-M0.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/fast.h"
#include "core/plane.h"
#include "fast/set_up_parts.h"

#if ZS_SET_UP

_Static_assert(sizeof(struct zs_vertex) == 12 && offsetof(struct zs_vertex, d) == 8 &&
                   offsetof(struct zs_tri, v) == 0,
               "a record of the pools");
_Static_assert(AT(key.gx) == AT(key) + 4 && AT(key.gy) == AT(key) + 8, "stored at once");
_Static_assert(AT(cut_end) == AT(row) + 4 && AT(row_end) == AT(row) + 8 &&
                   AT(row_mid) == AT(row) + 12 && AT(row_last) == AT(row) + 16,
               "stored at once");
_Static_assert(AT(geom.dx2) == AT(geom) + 4 && AT(geom.dy1) == AT(geom) + 8 &&
                   AT(geom.dy2) == AT(geom) + 12 && AT(geom.area) == AT(geom) + 16 &&
                   AT(geom.ia) == AT(geom) + 24 && AT(geom.ja) == AT(geom) + 28 &&
                   AT(geom.ax) == AT(geom) + 32 && AT(geom.ay) == AT(geom) + 36 &&
                   AT(geom.rcp) == AT(geom) + 40 && AT(geom.exp) == AT(geom) + 44 &&
                   AT(geom.tiny) == AT(geom) + 48,
               "stored in three parts");
_Static_assert(ZS_TINY == 1 << 14 && ZS_TINY_AREA == 1 << 13 && ZS_SUBPX_BITS == 8 &&
                   ZS_CUT_ROWS == 16 && ZS_PLANE_KEY == 5,
               "as below");

/* Records of the corners to job->v, r2, r3 and r4. Their keys, which must not saturate and are in
 * one piece of the mapping: the first one to key.base, differences from it to key.gx, key.gy. */
#define CORNERS                                                                                    \
    "ldr r1, [r0, %[tri]]\n\tldrh r2, [r1]\n\tldrh r3, [r1, #2]\n\tldrh r4, [r1, #4]\n\t"          \
    "ldr r1, [r0, %[r]]\n\tmovs r5, %[vert]\n\tldr r1, [r1, r5]\n\tmovs r5, #12\n\t"               \
    "muls r2, r5\n\tmuls r3, r5\n\tmuls r4, r5\n\tadds r2, r1\n\tadds r3, r1\n\tadds r4, r1\n\t"   \
    "movs r1, r0\n\tadds r1, %[v]\n\tstmia r1!, {r2, r3, r4}\n\t"                                  \
    "ldr r5, [r2, #8]\n\tldr r6, [r3, #8]\n\tldr r7, [r4, #8]\n\tldr r1, [r0, %[limit]]\n\t"       \
    "cmp r5, r1\n\tbcs 7f\n\tcmp r6, r1\n\tbcs 7f\n\tcmp r7, r1\n\tbcs 7f\n\t"                     \
    "movs r1, r5\n\teors r1, r6\n\tsubs r6, r5\n\tstr r6, [r0, %[gx]]\n\t"                         \
    "movs r6, r5\n\teors r6, r7\n\torrs r1, r6\n\tsubs r7, r5\n\tstr r7, [r0, %[gy]]\n\t"          \
    "movs r6, %[piece]\n\tldr r6, [r0, r6]\n\tlsrs r1, r6\n\tbne 7f\n\t"                           \
    "str r5, [r0, %[key]]\n\t"

/* The top corner to lr and r12; differences, r1, r3 and r4, r5, and the area to job->geom, to whose
 * anchor r2 is moved. */
#define SIZES                                                                                      \
    "ldmia r2!, {r5, r6}\n\tmov lr, r5\n\tmov r12, r6\n\t"                                         \
    "ldr r1, [r3]\n\tsubs r1, r5\n\tldr r7, [r3, #4]\n\tsubs r7, r6\n\t"                           \
    "ldr r3, [r4]\n\tsubs r3, r5\n\tldr r5, [r4, #4]\n\tsubs r5, r6\n\tmovs r4, r7\n\t"            \
    /* tiny */                                                                                     \
    "movs r2, #1\n\tlsls r2, #14\n\tadds r6, r1, r2\n\tadds r7, r3, r2\n\torrs r6, r7\n\t"         \
    "movs r7, r4\n\torrs r7, r5\n\tlsls r7, #1\n\torrs r6, r7\n\tlsrs r6, #15\n\tbne 7f\n\t"       \
    "movs r6, r1\n\tmuls r6, r5\n\tmovs r7, r3\n\tmuls r7, r4\n\tsubs r6, r7\n\t" /* area */       \
    "lsrs r7, r6, #13\n\tbeq 7f\n\t"                                                               \
    "movs r7, #0\n\tmovs r2, r0\n\tadds r2, %[geom]\n\tstmia r2!, {r1, r3, r4, r5, r6, r7}\n\t"

/* Rows in the strip. 6f: none. */
#define ROWS                                                                                       \
    /* mid_right */                                                                                \
    "subs r1, r3\n\tasrs r1, #31\n\tsubs r3, r4, r5\n\tadds r1, r3\n\tlsrs r1, #31\n\t"            \
    "strb r1, [r0, %[right]]\n\tstrb r7, [r0, %[saturates]]\n\t"                                   \
    /* first samples: r3; r6, r7, in order */                                                      \
    "mov r3, r12\n\tadds r3, #127\n\tadds r6, r3, r4\n\tadds r7, r3, r5\n\t"                       \
    "asrs r3, #8\n\tasrs r6, #8\n\tasrs r7, #8\n\t"                                                \
    "cmp r6, r7\n\tble 1f\n\tmovs r4, r6\n\tmovs r6, r7\n\tmovs r7, r4\n"                          \
    "1:\n\t"                                                                                       \
    "ldr r4, [r0, %[y0]]\n\tcmp r3, r4\n\tbge 1f\n\tmovs r3, r4\n"                                 \
    "1:\n\t"                                                                                       \
    "ldr r5, [r0, %[y1]]\n\tcmp r7, r5\n\tbge 1f\n\tmovs r5, r7\n"                                 \
    "1:\n\t"                                                                                       \
    "cmp r3, r5\n\tbge 6f\n\t"                                                                     \
    "movs r4, r3\n\tadds r4, #16\n\tcmp r4, r5\n\tble 1f\n\tmovs r4, r5\n"                         \
    "1:\n\t"                                                                                       \
    "movs r1, r0\n\tadds r1, %[row]\n\tstmia r1!, {r3, r4, r5, r6, r7}\n\t"

/* The anchor, the first pixel's place. */
#define ANCHOR                                                                                     \
    "mov r5, lr\n\tasrs r3, r5, #8\n\tmov r6, r12\n\tasrs r4, r6, #8\n\t"                          \
    "movs r7, #128\n\tuxtb r5, r5\n\tsubs r5, r7, r5\n\tuxtb r6, r6\n\tsubs r6, r7, r6\n\t"        \
    "stmia r2!, {r3, r4, r5, r6}\n\t"

/* The area's leading zeros, 2 .. 18, to r7; its reciprocal, as zs_recip, to job->geom and, in
 * halves, to r12 and lr. The ways out are in its middle, 6 without rows, 7 declined: branches are
 * short. */
#define RECIPROCAL                                                                                 \
    "subs r2, #24\n\tldr r3, [r2]\n\tldr r6, 8f\n\t"                                               \
    "movs r7, #8\n\tlsrs r4, r3, #16\n\tbeq 1f\n\tlsrs r5, r4, #8\n\tbeq 2f\n\t"                   \
    "movs r7, #0\n\tmovs r4, r5\n\tb 2f\n"                                                         \
    "6:\n\tstr r7, [r0, %[last]]\n\tmovs r0, %[none]\n\tpop {r3, pc}\n"                            \
    "7:\n\tmovs r0, #0\n\tpop {r3, pc}\n"                                                          \
    "1:\n\tmovs r7, #16\n\tlsrs r4, r3, #8\n"                                                      \
    "2:\n\tldrb r4, [r6, r4]\n\tadds r7, r4\n\t"                                                   \
    /* zs_recip: r3, from area 2^r7 in r3 */                                                       \
    "lsls r3, r7\n\tlsls r4, r3, #1\n\tlsrs r4, #24\n\tlsls r4, #1\n\tldr r5, 8f + 4\n\t"          \
    "adds r5, r4\n\tldrh r4, [r5]\n\tldrh r5, [r5, #2]\n\tsubs r5, r4, r5\n\t"                     \
    "lsls r6, r3, #9\n\tlsrs r6, #16\n\tmuls r5, r6\n\tlsrs r5, #1\n\t"                            \
    "lsls r4, #15\n\tsubs r4, r5\n\tmovs r1, #1\n\tlsls r1, #31\n\tadds r2, r4, r1\n\t"            \
    "uxth r5, r2\n\tmov r12, r5\n\tlsrs r5, r2, #16\n\tmov lr, r5\n\t" HIGH_OF_PRODUCT             \
    "subs r1, r3\n\tmov r4, lr\n\tmuls r4, r1\n\tmov r5, r12\n\tmuls r5, r1\n\t"                   \
    "asrs r5, #16\n\tadds r4, r5\n\tasrs r4, #15\n\tadds r4, r2\n\t"                               \
    "bmi 1f\n\tmovs r4, #0\n\tmvns r4, r4\n"                                                       \
    "1:\n\t"                                                                                       \
    "uxth r1, r4\n\tmov r12, r1\n\tlsrs r1, r4, #16\n\tmov lr, r1\n\t"                             \
    "rsbs r5, r7, #0\n\tmovs r6, #1\n\t"                                                           \
    "movs r3, r0\n\tadds r3, %[rcp]\n\tstmia r3!, {r4, r5, r6}\n\t"

/* Differences of keys. */
#define KEYS "ldr r3, [r0, %[gx]]\n\tldr r4, [r0, %[gy]]\n\t"

ZS_NAKED void zs_set_up_part(void)
{
    __asm__ volatile(
        ".syntax unified\n\t"
        "push {r3, lr}\n\t" /* [sp]: gx */
        CORNERS SIZES ROWS ANCHOR RECIPROCAL
        /* gradients */
        "subs r3, #44\n\tldmia r3!, {r1, r2}\n\t" GRADIENT("0", KEYS, "8f", "5", "7b")
        "str r3, [sp]\n\t"
        "movs r3, r0\n\tadds r3, %[geom]\n\tldmia r3!, {r1, r2}\n\t"
        "" GRADIENT("1", KEYS, "8f", "5", "9f")
        "rsbs r5, r3, #0\n\tldr r4, [sp]\n\t"
        /* zs_plane_step */
        "movs r3, r0\n\tadds r3, %[ax]\n\tldmia r3!, {r1, r2}\n\tldr r3, [r0, %[key]]\n\t"
        "asrs r6, r4, #8\n\tmuls r6, r1\n\tadds r3, r6\n\t"
        "asrs r6, r5, #8\n\tmuls r6, r2\n\tadds r3, r6\n\t"
        "uxtb r6, r4\n\tmuls r1, r6\n\tuxtb r6, r5\n\tmuls r2, r6\n\tadds r1, r2\n\t"
        "adds r1, #128\n\tasrs r1, #8\n\tadds r3, r1\n\t"
        "movs r1, #128\n\tlsls r1, #8\n\tadds r3, r1\n\t" /* half a bucket */
        "movs r1, r0\n\tadds r1, %[key]\n\tstmia r1!, {r3, r4, r5}\n\t"
        "movs r0, %[rows]\n\tpop {r3, pc}\n"
        "9:\n\tmovs r0, #0\n\tpop {r3, pc}\n\t"
        ".align 2\n"
        "8:\n\t.word zs_clz8, zs_recip_table\n"
        :
        : [r] "i"(AT(r)), [tri] "i"(AT(tri)), [vert] "i"(offsetof(struct zs_renderer, vert)),
          [v] "i"(AT(v)), [key] "i"(AT(key)), [gx] "i"(AT(key.gx)), [gy] "i"(AT(key.gy)),
          [limit] "i"(AT(key_limit)), [piece] "i"(AT(piece_shift)), [geom] "i"(AT(geom)),
          [right] "i"(AT(mid_right)), [saturates] "i"(AT(saturates)), [y0] "i"(AT(y0)),
          [y1] "i"(AT(y1)), [row] "i"(AT(row)), [last] "i"(AT(row_last)), [rcp] "i"(AT(geom.rcp)),
          [ax] "i"(AT(geom.ax)), [rows] "i"(ZS_SET_UP_ROWS), [none] "i"(ZS_SET_UP_NONE));
}

ZS_NAKED enum zs_set_up zs_set_up(struct zs_job *job __attribute__((unused)))
{
    __asm__ volatile(".syntax unified\n\tpush {r4, r5, r6, r7, lr}\n\tbl zs_set_up_part\n\t"
    "pop {r4, r5, r6, r7, pc}");
}

#endif
