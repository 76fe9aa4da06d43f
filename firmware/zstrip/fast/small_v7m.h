/* Small triangles on Armv7-M, in assembler: what triangles of one colour (fast/solid_v7m.c) and
 * textured ones (fast/texture_v7m.c) have alike. Each macro is a part of a function whose stack
 * frame has the fields AT(...), which F_... give the offsets of. It is fast/small.h, bit for bit.
 * Internal.
 *
 * Labels: 1: a triangle in r1. 8: it is drawn, or has no row here. 9: it is declined. 18: the list
 * ends.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_SMALL_V7M_H
#define ZS_SMALL_V7M_H

#include "core/job.h"

#if ZS_V7M

#include "fast/small.h"

_Static_assert(sizeof(struct zs_vertex) == 12 && offsetof(struct zs_vertex, d) == 8 &&
                   sizeof(struct zs_tri) == 12 && offsetof(struct zs_tri, next) == 6 &&
                   offsetof(struct zs_tri, paint) == 8 && offsetof(struct zs_tri, instance) == 10,
               "records of the pools");
_Static_assert(ZS_TINY == 1 << 14 && ZS_TINY_AREA == 1 << 13 && ZS_SUBPX_BITS == 8 &&
                   ZS_TINY_SIDE == 65 && ZS_PLANE_KEY == 5 && ZS_SMALL_SAFE == 1 << 17 &&
                   ZS_NIL == 0xffff,
               "as below");

#define TEXT(n) #n
#define NUMBER(n) TEXT(n)
#define AT(name) "[sp, #" NUMBER(F_##name) "]"

/* The vertices: r6, r7, r8 the top one; r9, r10, r11 and r2, r3, r4 the others, less it; r0: twice
 * the area. 9f: declined. 20f: in the last piece, or LAST is 0; back at 2. Then r4 is the third
 * key's difference, negated. */
#define LOOK                                                                                       \
    "ldrh r3, [r1]\n\tldrh r4, [r1, #2]\n\tldrh r2, [r1, #4]\n\t"                                  \
    "ldr r0, " AT(POOL) "\n\tmovs r5, #12\n\t"                                                    \
    "mla r3, r3, r5, r0\n\tmla r4, r4, r5, r0\n\tmla r2, r2, r5, r0\n\t"                           \
    "ldmia r3, {r6, r7, r8}\n\tldmia r4, {r9, r10, r11}\n\tldmia r2, {r2, r3, r4}\n\t"             \
    "sub r9, r9, r6\n\tsub r10, r10, r7\n\tsubs r2, r2, r6\n\tsubs r3, r3, r7\n\t"                 \
    "add r0, r9, #0x4000\n\tadd r5, r2, #0x4000\n\torrs r0, r5\n\torr r5, r10, r3\n\t"             \
    "orr r0, r0, r5, lsl #1\n\tcmp r0, #0x8000\n\tbcs 9f\n\t" /* tiny */                           \
    "mul r0, r9, r3\n\tmls r0, r2, r10, r0\n\tcmp r0, #0x2000\n\tblt 9f\n\t"                       \
    "eor r5, r8, r11\n\teor r12, r8, r4\n\torr r5, r5, r12\n\tldr r12, " AT(SHIFT) "\n\t"         \
    "lsrs r5, r5, r12\n\tbne 9f\n\t" /* one piece */                                               \
    "ldr r5, " AT(LAST) "\n\tcmp r8, r5\n\tbcs 20f\n"                                             \
    "2:\n\tsub r11, r11, r8\n\tsub r4, r8, r4\n\t"

/* r1 = zs_recip_inline(area 2^lz); r5 = 22 - lz, `down` of zs_quotient less one. */
#define RECIPROCAL                                                                                 \
    "clz r5, r0\n\tlsl r12, r0, r5\n\tubfx r1, r12, #23, #8\n\tubfx lr, r12, #7, #16\n\t"          \
    "ldr r0, 30f\n\tadd r0, r0, r1, lsl #1\n\tldrh r1, [r0]\n\tldrh r0, [r0, #2]\n\t"              \
    "subs r0, r1, r0\n\tmul r0, r0, lr\n\tlsls r1, r1, #15\n\torr r1, r1, #0x80000000\n\t"         \
    "sub r1, r1, r0, lsr #1\n\tumull r0, lr, r12, r1\n\trsb lr, lr, #0x80000000\n\t"               \
    "smull r0, r12, r1, lr\n\tlsl r12, r12, #1\n\torr r12, r12, r0, lsr #31\n\t"                   \
    "add r1, r1, r12\n\tadds r1, r1, lr, lsl #1\n\tit pl\n\tmovpl r1, #-1\n\trsb r5, r5, #22\n\t"

/* low = zs_quotient(r11 a - r4' b), with r4 = -r4'. sign, hi: other registers. big: its numerator
 * is beyond 32 bits; back at `back`, where low is twice the magnitude, plus 1. */
#define QUOTIENT(low, hi, sign, a, b, big, back)                                                   \
    "smull " low ", " hi ", r11, " a "\n\tsmlal " low ", " hi ", r4, " b "\n\t"                    \
    "asr " sign ", " hi ", #31\n\teor " low ", " low ", " sign "\n\t"                              \
    "eor " hi ", " hi ", " sign "\n\tsubs " low ", " low ", " sign "\n\t"                          \
    "sbcs " hi ", " hi ", " sign "\n\tbne " big "\n\t"                                             \
    "umull " hi ", " low ", " low ", r1\n\tlsr " low ", " low ", r5\n\tadd " low ", #1\n"          \
    back ":\n\teor " low ", " sign ", " low ", lsr #1\n\tsub " low ", " low ", " sign "\n\t"
#define BIG(low, hi, back)                                                                         \
    "strd r6, r7, " AT(TWO) "\n\tclz r6, " hi "\n\trsb r7, r6, #32\n\tlsl " hi ", " hi ", r6\n\t" \
    "lsr " low ", " low ", r7\n\torr " low ", " low ", " hi "\n\tsub r7, r5, r7\n\t"               \
    "ldr r6, " AT(TWO) "\n\tcmp r7, #4\n\tblt 9b\n\tumull " hi ", " low ", " low ", r1\n\t"       \
    "lsr " low ", " low ", r7\n\tadd " low ", #1\n\tldr r7, " AT(TWO_2) "\n\tb " back "\n"

/* r6 = x, r7 = off, of struct zs_small; lr: the first row in the strip; r1, r11: rows from it to
 * the one below the middle vertex, to the one beyond the last; r4: column 0. 23f: near the
 * viewport's sides; back at 5. 8f: no row in the strip. */
#define PLACE                                                                                      \
    "asrs r5, r6, #8\n\tsub r4, r5, #65\n\tldr r11, " AT(EDGE) "\n\tcmp r4, r11\n\tbcs 23f\n"     \
    "5:\n\tuxtb r6, r6\n\tadd r6, r6, #0x4080\n\tadds r7, #127\n\t"                                \
    "cmp r10, r3\n\tite lt\n\taddlt r11, r7, r3\n\taddge r11, r7, r10\n\t"                         \
    "ite lt\n\taddlt r1, r7, r10\n\taddge r1, r7, r3\n\t"                                          \
    "asr r11, r11, #8\n\tasrs r1, r1, #8\n\tasr lr, r7, #8\n\tstr r11, " AT(TRI_END) "\n\t"       \
    "ldr r5, " AT(Y0) "\n\tcmp lr, r5\n\tit lt\n\tmovlt lr, r5\n\t"                               \
    "ldr r5, " AT(Y1) "\n\tcmp r11, r5\n\tit gt\n\tmovgt r11, r5\n\tcmp lr, r11\n\tbge 8f\n\t"    \
    "cmp r1, r11\n\tit gt\n\tmovgt r1, r11\n\tcmp r1, lr\n\tit lt\n\tmovlt r1, lr\n\t"             \
    "rsb r7, r7, #255\n\tadd r7, r7, lr, lsl #8\n\tsub r1, r1, lr\n\tsub r11, r11, lr\n\t"

/* The side below the middle vertex (dx, dy), to (to_dx, to_dy). r5: off of its first row. */
#define LOWER(dx, dy, to_dx, to_dy, turn)                                                          \
    "add r11, r6, " dx "\n\tsub r5, r5, " dy "\n\tsub r1, " to_dy ", " dy "\n\t"                   \
    "mul r11, r11, r1\n\tadd r11, r11, r1, lsl #8\n\tlsls r1, r1, #8\n\tstr r1, " AT(NEXT) "\n\t" \
    "sub r1, " to_dx ", " dx "\n\tmla r11, r5, r1, r11\n\tlsls r1, r1, #8\n\t"                     \
    "str r1, " AT(STEP) "\n\tsub r11, r11, #1\n\tstr r11, " AT(SUM) "\n\t"                   \
    "movs r1, " turn "\n\tstr r1, " AT(TURN) "\n\t"

/* r8: the key at column 0 of the first row; r5, r11: sums of the sides; r12: what a row adds to the
 * key. `mid` and `end` are the same if no row is below the middle vertex. */
#define SIDES(mid, end)                                                                            \
    "cmp " mid ", " end "\n\tbeq 6f\n\tadd r5, r7, r1, lsl #8\n\tcmp r10, r3\n\tbge 17f\n\t"       \
    LOWER("r9", "r10", "r2", "r3", "#1") "b 6f\n"                                                  \
    "17:\n\t" LOWER("r2", "r3", "r9", "r10", "#0")                                                 \
    "6:\n\t"                                                                                       \
    "smull r5, r11, r0, r6\n\tsmlal r5, r11, r12, r7\n\trsbs r5, r5, #128\n\tmvn r11, r11\n\t"     \
    "adc r11, r11, #0\n\tlsrs r5, r5, #8\n\torr r5, r5, r11, lsl #24\n\tadd r8, r8, r5\n\t"        \
    "add r8, r8, #0x8000\n\trsb r12, r12, #0\n\t"                                                  \
    "mul r5, r6, r3\n\tmla r5, r7, r2, r5\n\tadd r5, r5, r3, lsl #8\n\tsubs r5, #1\n\t"            \
    "mul r11, r6, r10\n\tmla r11, r7, r9, r11\n\tadd r11, r11, r10, lsl #8\n\tsub r11, r11, #1\n\t"\
    "lsls r3, r3, #8\n\tlsls r2, r2, #8\n\tlsl r10, r10, #8\n\tlsl r9, r9, #8\n\t"                 \
    "strd r3, r2, [sp]\n\tstrd r10, r9, [sp, #8]\n\t"

/* The next triangle to r1, and back to 1; 18f: none. 24f: this one goes on below the strip; back at
 * 16. */
#define NEXT                                                                                       \
    "8:\n\tldr r1, " AT(TRI) "\n\tstr r1, " AT(DRAWN) "\n\tldrh r2, [r1, #6]\n\t"                \
    "movw r4, #0xffff\n\tcmp r2, r4\n\tbeq 18f\n\tldr r3, " AT(ALL) "\n\t"                        \
    "add r2, r2, r2, lsl #1\n\tadd r2, r3, r2, lsl #2\n\tldrh r4, [r2, #10]\n\t"                   \
    "ldr r5, " AT(INSTANCE) "\n\tcmp r4, r5\n\tbne 18f\n\t"                                       \
    "ldr r4, " AT(TRI_END) "\n\tldr r5, " AT(Y1) "\n\tcmp r4, r5\n\tbgt 24f\n"                   \
    "16:\n\tmov r1, r2\n\tb 1b\n"

/* Columns: as zs_small_place. width: what loads the viewport's to r11. */
#define NEAR_SIDES(width)                                                                          \
    "23:\n\tmov r5, r9\n\tcmp r2, r5\n\tit lt\n\tmovlt r5, r2\n\tand r5, r5, r5, asr #31\n\t"      \
    "add r5, r6\n\tadds r5, #127\n\tbmi 9b\n\t"                                                    \
    "mov r5, r9\n\tcmp r2, r5\n\tit gt\n\tmovgt r5, r2\n\tbic r5, r5, r5, asr #31\n\t"             \
    "add r5, r6\n\tadds r5, #127\n\tasrs r5, r5, #8\n\t" width "\n\tcmp r5, r11\n\tbgt 9b\n\tb 5b\n"
/* As zs_small64_next. keep: what loads job->keep to r4. */
#define GOES_ON(keep)                                                                              \
    "24:\n\t" keep "\n\tcmp r4, #0\n\tbeq 16b\n\t"                                                 \
    "ldr r5, [r4]\n\tsubs r6, r1, r3\n\tlsrs r6, r6, #2\n\tldr r7, 30f + 4\n\tmuls r6, r7\n\t"     \
    "strh r6, [r5]\n\tadds r5, r1, #6\n\tstr r5, [r4]\n\tb 16b\n"

#endif
#endif
