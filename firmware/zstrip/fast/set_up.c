/* Set-up of tiny triangles on Armv6-M, in assembler: rows, area and its reciprocal, and the plane
 * of the keys. It is what core/raster.c and core/plane.c do for them, bit for bit, whose compiler
 * spills on a core with eight registers: 380 cycles in place of 620. Scene teapot on an RP2040
 * takes 0.42 of 7.77 million cycles less. 750 bytes. On an RP2040, with the columns in between
 * (zs_set_up_rows_part, for fast/smooth_lanes.c and texture_lanes.c), 0.07 of 5.86; 1,130 bytes.
 *
 * Exact: tests/checks/set_up.c compares it with the core on an emulated Cortex-M0; what draws on an
 * RP2040, frames (tests/boards/pico.sh).
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
                   AT(row_mid) == AT(row) + 12 && AT(tri_end) == AT(row) + 16,
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
#define RECIPROCAL(exits)                                                                          \
    "subs r2, #24\n\tldr r3, [r2]\n\tldr r6, 8f\n\t"                                               \
    "movs r7, #8\n\tlsrs r4, r3, #16\n\tbeq 1f\n\tlsrs r5, r4, #8\n\tbeq 2f\n\t"                   \
    "movs r7, #0\n\tmovs r4, r5\n\tb 2f\n"                                                         \
    exits                                                                                          \
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

/* 6: no rows, 7: declined. */
#define EXITS(leave)                                                                               \
    "6:\n\tstr r7, [r0, %[last]]\n\tmovs r0, %[none]\n\t" leave "7:\n\tmovs r0, #0\n\t" leave

/* Differences of keys. */
#define KEYS "ldr r3, [r0, %[gx]]\n\tldr r4, [r0, %[gy]]\n\t"

/* The plane of the keys. leave, leave2: where a gradient that is too steep leads. [sp]: gx. */
#define PLANE(leave, leave2)                                                                       \
    /* gradients */                                                                                \
    "subs r3, #44\n\tldmia r3!, {r1, r2}\n\t" GRADIENT("0", KEYS, "8f", "5", leave)                \
    "str r3, [sp]\n\t"                                                                             \
    "movs r3, r0\n\tadds r3, %[geom]\n\tldmia r3!, {r1, r2}\n\t"                                   \
    "" GRADIENT("1", KEYS, "8f", "5", leave2)                                                      \
    "rsbs r5, r3, #0\n\tldr r4, [sp]\n\t"                                                          \
    /* zs_plane_step */                                                                            \
    "movs r3, r0\n\tadds r3, %[ax]\n\tldmia r3!, {r1, r2}\n\tldr r3, [r0, %[key]]\n\t"             \
    "asrs r6, r4, #8\n\tmuls r6, r1\n\tadds r3, r6\n\t"                                            \
    "asrs r6, r5, #8\n\tmuls r6, r2\n\tadds r3, r6\n\t"                                            \
    "uxtb r6, r4\n\tmuls r1, r6\n\tuxtb r6, r5\n\tmuls r2, r6\n\tadds r1, r2\n\t"                  \
    "adds r1, #128\n\tasrs r1, #8\n\tadds r3, r1\n\t"                                              \
    "movs r1, #128\n\tlsls r1, #8\n\tadds r3, r1\n\t" /* half a bucket */                          \
    "movs r1, r0\n\tadds r1, %[key]\n\tstmia r1!, {r3, r4, r5}\n\t"

#define SET_UP_OF                                                                                  \
    [r] "i"(AT(r)), [tri] "i"(AT(tri)), [vert] "i"(offsetof(struct zs_renderer, vert)),            \
    [v] "i"(AT(v)), [key] "i"(AT(key)), [gx] "i"(AT(key.gx)), [gy] "i"(AT(key.gy)),                \
    [limit] "i"(AT(key_limit)), [piece] "i"(AT(piece_shift)), [geom] "i"(AT(geom)),                \
    [right] "i"(AT(mid_right)), [saturates] "i"(AT(saturates)), [y0] "i"(AT(y0)),                  \
    [y1] "i"(AT(y1)), [row] "i"(AT(row)), [last] "i"(AT(tri_end)), [rcp] "i"(AT(geom.rcp)),       \
    [ax] "i"(AT(geom.ax)), [rows] "i"(ZS_SET_UP_ROWS), [none] "i"(ZS_SET_UP_NONE),                 \
    [ia] "i"(AT(geom.ia)), [cut] "i"(AT(cut)), [end] "i"(AT(cut_end)),                             \
    [row_end] "i"(AT(row_end)), [empty] "i"(ZS_SET_UP_EMPTY)

ZS_NAKED void zs_set_up_part(void)
{
    __asm__ volatile(
        ".syntax unified\n\t"
        "push {r3, lr}\n\t" /* [sp]: gx */
        CORNERS SIZES ROWS ANCHOR RECIPROCAL(EXITS("pop {r3, pc}\n"))
        PLANE("7b", "9f")
        "movs r0, %[rows]\n\tpop {r3, pc}\n"
        "9:\n\tmovs r0, #0\n\tpop {r3, pc}\n\t"
        ".align 2\n"
        "8:\n\t.word zs_clz8, zs_recip_table\n"
        :
        : SET_UP_OF);
}

ZS_NAKED enum zs_set_up zs_set_up(struct zs_job *job __attribute__((unused)))
{
    __asm__ volatile(".syntax unified\n\tpush {r4, r5, r6, r7, lr}\n\tbl zs_set_up_part\n\t"
    "pop {r4, r5, r6, r7, pc}");
}

#if ZS_RP2040

/* Start a division by SIO. Eight cycles later the quotient is at 0x70. */
#define DIVIDE(sum, span, step)                                                                    \
    "str " #sum ", [r5, #0x60]\n\tstr " #span ", [r5, #0x64]\n\tadd " #sum ", " #step "\n\t"

/* A side from the top vertex to (dx, dy); dx becomes 256 dx. r2: x, r5: off. Uses r1. */
#define SIDE(sum, span, dx, dy)                                                                    \
    "mov " #span ", " #dy "\n\tmovs " #sum ", r2\n\tmuls " #sum ", " #span "\n\t"                  \
    "mov r1, " #dx "\n\t"                                                                          \
    "muls r1, r5\n\tadds " #sum ", r1\n\tlsls " #span ", #8\n\tadds " #sum ", " #span "\n\t"       \
    "subs " #sum ", #1\n\tmov r1, " #dx "\n\tlsls r1, #8\n\tmov " #dx ", r1\n\t"

/* The side below the middle vertex (dx / 256, dy), to (to_dx / 256, to_dy). r2: the next cut. Uses
 * r1, r4, r5. */
#define LOWER(sum, span, dx, dy, to_dx, to_dy)                                                     \
    "mov r1, " #dx "\n\tasrs r1, #8\n\tmov r4, " #to_dx "\n\tasrs r4, #8\n\tsubs r4, r1\n\t"       \
    "mov " #span ", " #to_dy "\n\tmov r5, " #dy "\n\tsubs " #span ", r5\n\t"                       \
    "ldr " #sum ", [sp, #16]\n\tadds " #sum ", r1\n\tmuls " #sum ", " #span "\n\t"                 \
    "ldr r1, [sp, #8]\n\tsubs r1, r2, r1\n\tlsls r1, #6\n\tsubs r1, r5\n\tldr r5, [sp, #20]\n\t"   \
    "adds r1, r5\n\tmuls r1, r4\n\tadds " #sum ", r1\n\tlsls " #span ", #8\n\t"                    \
    "adds " #sum ", " #span "\n\tsubs " #sum ", #1\n\tlsls r4, #8\n\tmov " #dx ", r4\n\t"

/* Columns, as zs_set_up_cuts_part has them (fast/fast_edges.c), of rows r3 to r4; r6: the middle
 * vertex's; r8 to r11: dx1, dx2, dy1, dy2; lr: ax, r12: ay. Then r3 and r4: cuts, from the first
 * that has a pixel to the last. On the stack: gx, job, cuts, x, off, ay. 9b: no pixel. */
#define COLUMNS                                                                                    \
    "mov r1, lr\n\tuxtb r2, r1\n\tasrs r1, #8\n\tsubs r1, #65\n\tmovs r5, #129\n\tlsls r5, #7\n\t" \
    "adds r2, r5\n\tlsls r5, r3, #8\n\tadds r5, #128\n\tmov r7, r12\n\tsubs r5, r7\n\t"            \
    "str r7, [sp, #24]\n\tmov r12, r1\n\tcmp r6, r4\n\tble 1f\n\tmovs r6, r4\n"                    \
    "1:\n\tsubs r6, r3\n\tsubs r4, r3\n\tldr r7, 8f + 8\n\tadds r7, r0\n\t"                        \
    "lsls r6, #2\n\tadds r6, r7\n\tlsls r4, #2\n\tadds r4, r7\n\tadd r1, sp, #4\n\t"               \
    "stmia r1!, {r0}\n\tstr r7, [r1]\n\tstr r4, [r1, #4]\n\tstr r2, [r1, #8]\n\t"                  \
    "str r5, [r1, #12]\n\tmovs r4, r6\n\t" SIDE(r0, r6, r8, r10) SIDE(r3, r7, r9, r11)             \
    "ldr r2, [sp, #8]\n\tcmp r4, r2\n\tbls 5f\n"                                                   \
    "2:\n\tmovs r5, #0xd0\n\tlsls r5, #24\n\t" DIVIDE(r3, r7, r9)                                  \
    "b 1f\n1:\tb 1f\n1:\tb 1f\n1:\tnop\n"                                                          \
    "3:\n\tldr r1, [r5, #0x70]\n\t" DIVIDE(r0, r6, r8)                                             \
    "add r1, r12\n\tstrh r1, [r2]\n\tb 1f\n1:\tb 1f\n1:\t"                                         \
    "ldr r1, [r5, #0x70]\n\t" DIVIDE(r3, r7, r9)                                                   \
    "add r1, r12\n\tstrh r1, [r2, #2]\n\tadds r2, #4\n\tcmp r2, r4\n\tbne 3b\n\t"                  \
    "mov r1, r9\n\tsubs r3, r1\n" /* it has gone a row too far */                                  \
    "5:\n\tldr r4, [sp, #12]\n\tcmp r2, r4\n\tbcs 4f\n\tcmp r10, r11\n\tblt 1f\n\t"                \
    LOWER(r3, r7, r9, r11, r8, r10) "ldr r4, [sp, #12]\n\tb 2b\n"                                  \
    "1:\n\t" LOWER(r0, r6, r8, r10, r9, r11) "ldr r4, [sp, #12]\n\tb 2b\n"                         \
    "4:\n\tldr r0, [sp, #4]\n\tldr r3, [sp, #8]\n"                                                 \
    "1:\n\tldr r1, [r3]\n\tsxth r2, r1\n\tasrs r1, #16\n\tcmp r2, r1\n\tblt 1f\n\t"                \
    "adds r3, #4\n\tcmp r3, r4\n\tbne 1b\n\tldr r1, [r0, %[end]]\n\tldr r2, [r0, %[row_end]]\n\t"  \
    "cmp r1, r2\n\tblt 2f\n\tb 9b\n"                                                               \
    "1:\n\tsubs r4, #4\n\tldr r1, [r4]\n\tsxth r2, r1\n\tasrs r1, #16\n\tcmp r2, r1\n\tbge 1b\n\t" \
    "adds r4, #4\n\tstr r3, [sp, #8]\n\tstr r4, [sp, #12]\n2:\n\t"

ZS_NAKED void zs_set_up_rows_part(void)
{
    __asm__ volatile(
        ".syntax unified\n\t"
        "push {lr}\n\tsub sp, #28\n\t" CORNERS SIZES
        "mov r8, r1\n\tmov r9, r3\n\tmov r10, r4\n\tmov r11, r5\n\t" ROWS "b 1f\n"
        EXITS("add sp, #28\n\tpop {pc}\n")
        "9:\n\tmovs r0, %[empty]\n\tadd sp, #28\n\tpop {pc}\n1:\n\t" COLUMNS
        "ldr r6, [sp, #24]\n\tmov r12, r6\n\tmovs r2, r0\n\tadds r2, %[ia]\n\t"
        ANCHOR RECIPROCAL("") PLANE("7b", "7b")
        "movs r0, %[rows]\n\tldr r3, [sp, #8]\n\tldr r4, [sp, #12]\n\tadd sp, #28\n\tpop {pc}\n\t"
        ".align 2\n8:\n\t.word zs_clz8, zs_recip_table, %c[cut]\n"
        :
        : SET_UP_OF);
}

#endif

#endif
