/* Small triangles of one colour on Armv7-M, in assembler, one triangle of the list after the
 * other: set-up, rows and pixels without a call, where a compiler has 13 registers for 18 values
 * of a row and spills. On a Cortex-M3 it saves 13 % of scene relief (0.21 of 1.65 million
 * instructions), 18 % of sheet (2.2 of 12.7), 9 % of mesh: set-up and list take some 190
 * instructions a triangle in place of 320, a row 17 in place of 19. 1,280 bytes, the functions in
 * C 1,150.
 *
 * Exact: it is fast/small.h and small_draw of fast/fast_solid.c, bit for bit. tests/checks/v7m.c
 * compares them on an emulated M3 and M7; every frame of one colour on M3, M4 and M7 is drawn by it
 * (tests/property/scene_sums.sh).
 *
 * SPDX-License-Identifier: MIT
 */
#include "fast/solid_v7m.h"

#if ZS_V7M

#include "fast/small.h"

/* What is the same for all triangles of the list, and what the loop found. The first words are
 * copied to the stack. */
struct hand {
    const struct zs_vertex *pool;
    uint32_t shift, last; /* log2 of a linear piece; the least depth of the last piece */
    uint32_t edge;        /* columns less both margins and one; 0: all triangles are looked at */
    int32_t y0, y1;
    uintptr_t base; /* of depth: row 0 of the frame, a pixel left of the viewport */
    uintptr_t pitch, beside; /* bytes from row to row; from a key to its colour */
    const struct zs_tri *all;
    uint32_t instance; /* whose triangles it goes on to; 65536: one triangle */
    /* not copied */
    uint32_t piece_base;
    int32_t width;
    uint16_t **keep;
    uint32_t tested, set_up; /* number of pixels, of triangles */
    const struct zs_tri *drawn;
    int32_t row_last;
};
#define COPIED 11
#define H(field) offsetof(struct hand, field)
_Static_assert(H(instance) == 4 * (COPIED - 1), "these are copied");
_Static_assert(sizeof(struct zs_vertex) == 12 && offsetof(struct zs_vertex, d) == 8 &&
                   sizeof(struct zs_tri) == 12 && offsetof(struct zs_tri, next) == 6 &&
                   offsetof(struct zs_tri, paint) == 8 && offsetof(struct zs_tri, instance) == 10,
               "records of the pools");
_Static_assert(ZS_TINY == 1 << 14 && ZS_TINY_AREA == 1 << 13 && ZS_SUBPX_BITS == 8 &&
                   ZS_TINY_SIDE == 65 && ZS_PLANE_KEY == 5 && ZS_SMALL_SAFE == 1 << 17 &&
                   ZS_NIL == 0xffff,
               "as below");

/* The stack. SIDE: span and step of the left side, of the right one. NEXT: of the one that bends at
 * the middle vertex, its sum, and which it is (TURN). */
#define F_SIDE 0
#define F_NEXT 16
#define F_STEP 20
#define F_SUM 24
#define F_TURN 28
#define F_END 32  /* of the rows: depth pointer */
#define F_TWO 36  /* room for two registers */
#define F_TWO_2 40
#define F_HAND 44
#define F_POOL 48 /* the copy of struct hand: */
#define F_SHIFT 52
#define F_LAST 56
#define F_EDGE 60
#define F_Y0 64
#define F_Y1 68
#define F_BASE 72
#define F_PITCH 76
#define F_BESIDE 80
#define F_ALL 84
#define F_INSTANCE 88
#define F_TESTED 92
#define F_SET_UP 96
#define F_TRI 100
#define F_DRAWN 104
#define F_ROW_LAST 108
#define F_BYTES 112
_Static_assert(F_SHIFT == F_POOL + H(shift) && F_LAST == F_POOL + H(last) && F_EDGE == F_POOL +
                   H(edge) && F_Y0 == F_POOL + H(y0) && F_Y1 == F_POOL + H(y1) && F_BASE == F_POOL
                   + H(base) && F_PITCH == F_POOL + H(pitch) && F_BESIDE == F_POOL + H(beside) &&
                   F_ALL == F_POOL + H(all) && F_INSTANCE == F_POOL + H(instance),
               "a copy");
#define TEXT(n) #n
#define NUMBER(n) TEXT(n)
#define AT(name) "[sp, #" NUMBER(F_##name) "]"

/* The vertices: r6, r7, r8 the top one; r9, r10, r11 and r2, r3, r4 the others, less it; r0: twice
 * the area. 9f: declined. 20f: in the last piece; back at 2. Then r4 is the third key's difference,
 * negative. */
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

/* r1 = zs_recip_inline(area 2^lz); r5 = 22 - lz, of which zs_quotient shifts one more. */
#define RECIPROCAL                                                                                 \
    "clz r5, r0\n\tlsl r12, r0, r5\n\tubfx r1, r12, #23, #8\n\tubfx lr, r12, #7, #16\n\t"          \
    "ldr r0, 30f\n\tadd r0, r0, r1, lsl #1\n\tldrh r1, [r0]\n\tldrh r0, [r0, #2]\n\t"              \
    "subs r0, r1, r0\n\tmul r0, r0, lr\n\tlsls r1, r1, #15\n\torr r1, r1, #0x80000000\n\t"         \
    "sub r1, r1, r0, lsr #1\n\tumull r0, lr, r12, r1\n\trsb lr, lr, #0x80000000\n\t"               \
    "smull r0, r12, r1, lr\n\tlsl r12, r12, #1\n\torr r12, r12, r0, lsr #31\n\t"                   \
    "add r1, r1, r12\n\tadds r1, r1, lr, lsl #1\n\tit pl\n\tmovpl r1, #-1\n\trsb r5, r5, #22\n\t"

/* low = zs_quotient(r11 a - r4' b), with r4 = -r4'. sign, hi: other registers. big: its numerator
 * is beyond 32 bits; back at `back`, low rounded but for its half. */
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

/* r6 = x, r7 = off, of struct zs_small; lr, r4, F_END: depth pointers, of the first row, of the one
 * below the middle vertex, beyond the last; r1: rows from lr to r4. 23f: near the viewport's sides;
 * back at 5. 8f: no row in the strip. */
#define PLACE                                                                                      \
    "asrs r5, r6, #8\n\tsub r4, r5, #65\n\tldr r11, " AT(EDGE) "\n\tcmp r4, r11\n\tbcs 23f\n"     \
    "5:\n\tuxtb r6, r6\n\tadd r6, r6, #0x4080\n\tadds r7, #127\n\t"                                \
    "cmp r10, r3\n\tite lt\n\taddlt r11, r7, r3\n\taddge r11, r7, r10\n\t"                         \
    "ite lt\n\taddlt r1, r7, r10\n\taddge r1, r7, r3\n\t"                                          \
    "asr r11, r11, #8\n\tasrs r1, r1, #8\n\tasr lr, r7, #8\n\tstr r11, " AT(ROW_LAST) "\n\t"      \
    "ldr r5, " AT(Y0) "\n\tcmp lr, r5\n\tit lt\n\tmovlt lr, r5\n\t"                               \
    "ldr r5, " AT(Y1) "\n\tcmp r11, r5\n\tit gt\n\tmovgt r11, r5\n\tcmp lr, r11\n\tbge 8f\n\t"    \
    "cmp r1, r11\n\tit gt\n\tmovgt r1, r11\n\tcmp r1, lr\n\tit lt\n\tmovlt r1, lr\n\t"             \
    "rsb r7, r7, #255\n\tadd r7, r7, lr, lsl #8\n\tsub r1, r1, lr\n\tsub r11, r11, lr\n\t"         \
    "ldr r5, " AT(BASE) "\n\tadd r4, r5, r4, lsl #1\n\tldr r5, " AT(PITCH) "\n\t"                \
    "mla lr, lr, r5, r4\n\tmla r11, r11, r5, lr\n\tmla r4, r1, r5, lr\n\tstr r11, " AT(END) "\n\t"

/* The side below the middle vertex (dx, dy), to (to_dx, to_dy). r5: off of its first row. */
#define LOWER(dx, dy, to_dx, to_dy, turn)                                                          \
    "add r11, r6, " dx "\n\tsub r5, r5, " dy "\n\tsub r1, " to_dy ", " dy "\n\t"                   \
    "mul r11, r11, r1\n\tadd r11, r11, r1, lsl #8\n\tlsls r1, r1, #8\n\tstr r1, " AT(NEXT) "\n\t" \
    "sub r1, " to_dx ", " dx "\n\tmla r11, r5, r1, r11\n\tlsls r1, r1, #8\n\t"                     \
    "str r1, " AT(STEP) "\n\tsub r11, r11, #1\n\tstr r11, " AT(SUM) "\n\t"                   \
    "movs r1, " turn "\n\tstr r1, " AT(TURN) "\n\t"

/* r8: the key at column 0 of the first row; r5, r11: sums of the sides; r12: what a row adds to the
 * key. */
#define SIDES                                                                                      \
    "cmp r4, r11\n\tbeq 6f\n\tadd r5, r7, r1, lsl #8\n\tcmp r10, r3\n\tbge 17f\n\t"                \
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

/* r0: what a pixel adds to the key; r6: the colour; r7: from a key to its colour; r9: pixels. */
#define ROWS                                                                                       \
    "ldr r1, " AT(TRI) "\n\tldr r7, " AT(BESIDE) "\n\tldrh r6, [r1, #8]\n\t"                     \
    "ldr r9, " AT(TESTED) "\n\tldr r1, " AT(SET_UP) "\n\tadds r1, #1\n\tstr r1, " AT(SET_UP) "\n\t"\
    "cmp lr, r4\n\tbeq 12f\n"                                                                      \
    "10:\n\t" /* a row */                                                                          \
    "ldrd r1, r2, [sp]\n\tudiv r1, r5, r1\n\tadd r5, r2\n\tldrd r2, r3, [sp, #8]\n\t"              \
    "udiv r2, r11, r2\n\tadd r11, r3\n\tsubs r3, r2, r1\n\tbls 11f\n\t"                            \
    "add r9, r3\n\tmla r3, r0, r1, r8\n\tadd r1, lr, r1, lsl #1\n\tadd r2, lr, r2, lsl #1\n"       \
    "13:\n\t" /* a pixel */                                                                        \
    "ldrh r10, [r1, #2]!\n\tcmp r10, r3, lsr #16\n\tbls 14f\n\tlsr r10, r3, #16\n\t"               \
    "strh r10, [r1]\n\tstrh r6, [r1, r7]\n"                                                        \
    "14:\n\tadd r3, r0\n\tcmp r1, r2\n\tbne 13b\n"                                                 \
    "11:\n\tldr r1, " AT(PITCH) "\n\tadd lr, r1\n\tadd r8, r12\n\tcmp lr, r4\n\tbne 10b\n"        \
    "12:\n\tldr r4, " AT(END) "\n\tcmp lr, r4\n\tbeq 7f\n\t"                                      \
    "ldrd r1, r2, " AT(NEXT) "\n\tldr r3, " AT(TURN) "\n\tldr r10, " AT(SUM) "\n\t"             \
    "cbz r3, 15f\n\tstrd r1, r2, [sp, #8]\n\tmov r11, r10\n\tb 10b\n"                              \
    "15:\n\tstrd r1, r2, [sp]\n\tmov r5, r10\n\tb 10b\n"                                           \
    "7:\n\tstr r9, " AT(TESTED) "\n"

/* The next triangle to r1, and back to 1; 18f: none. 24f: this one goes on below the strip; back at
 * 16. */
#define NEXT                                                                                       \
    "8:\n\tldr r1, " AT(TRI) "\n\tstr r1, " AT(DRAWN) "\n\tldrh r2, [r1, #6]\n\t"                \
    "movw r4, #0xffff\n\tcmp r2, r4\n\tbeq 18f\n\tldr r3, " AT(ALL) "\n\t"                        \
    "add r2, r2, r2, lsl #1\n\tadd r2, r3, r2, lsl #2\n\tldrh r4, [r2, #10]\n\t"                   \
    "ldr r5, " AT(INSTANCE) "\n\tcmp r4, r5\n\tbne 18f\n\t"                                       \
    "ldr r4, " AT(ROW_LAST) "\n\tldr r5, " AT(Y1) "\n\tcmp r4, r5\n\tbgt 24f\n"                  \
    "16:\n\tmov r1, r2\n\tb 1b\n"

/* Keys near B - 1: as zs_small_look. */
#define LAST_PIECE                                                                                 \
    "20:\n\tldr r5, " AT(HAND) "\n\tldr r5, [r5, %[piece_base]]\n\tsub lr, r5, r8\n\t"            \
    "lsrs lr, lr, r12\n\tbne 2b\n\tmov lr, r8\n\tcmp r11, lr\n\tit hi\n\tmovhi lr, r11\n\t"        \
    "cmp r4, lr\n\tit hi\n\tmovhi lr, r4\n\tsub lr, r5, lr\n\tcmp lr, #0x20000\n\tbcs 2b\n\tb 9b\n"
/* Columns: as zs_small_place. */
#define NEAR_SIDES                                                                                 \
    "23:\n\tmov r5, r9\n\tcmp r2, r5\n\tit lt\n\tmovlt r5, r2\n\tand r5, r5, r5, asr #31\n\t"      \
    "add r5, r6\n\tadds r5, #127\n\tbmi 9b\n\t"                                                    \
    "mov r5, r9\n\tcmp r2, r5\n\tit gt\n\tmovgt r5, r2\n\tbic r5, r5, r5, asr #31\n\t"             \
    "add r5, r6\n\tadds r5, #127\n\tasrs r5, r5, #8\n\tldr r11, " AT(HAND) "\n\t"                 \
    "ldr r11, [r11, %[width]]\n\tcmp r5, r11\n\tbgt 9b\n\tb 5b\n"
/* As zs_small_next. */
#define GOES_ON                                                                                    \
    "24:\n\tldr r4, " AT(HAND) "\n\tldr r4, [r4, %[keep]]\n\tcmp r4, #0\n\tbeq 16b\n\t"           \
    "ldr r5, [r4]\n\tsubs r6, r1, r3\n\tlsrs r6, r6, #2\n\tldr r7, 30f + 4\n\tmuls r6, r7\n\t"     \
    "strh r6, [r5]\n\tadds r5, r1, #6\n\tstr r5, [r4]\n\tb 16b\n"

/* Draw tri, and those after it. Return 0 if one is declined, whose predecessor is h->drawn. */
ZS_NAKED static int list_draw(struct hand *h ZS_TAKEN, const struct zs_tri *tri ZS_TAKEN)
{
    __asm__ volatile(
        ".syntax unified\n\t"
        "push {r3, r4, r5, r6, r7, r8, r9, r10, r11, lr}\n\tsub sp, #" NUMBER(F_BYTES) "\n\t"
        "str r0, " AT(HAND) "\n\tadd r12, sp, #" NUMBER(F_POOL) "\n\t"
        "ldmia r0!, {r2, r3, r4, r5, r6, r7}\n\tstmia r12!, {r2, r3, r4, r5, r6, r7}\n\t"
        "ldmia r0!, {r2, r3, r4, r5, r6}\n\tstmia r12!, {r2, r3, r4, r5, r6}\n\t"
        "movs r2, #0\n\tstr r2, " AT(TESTED) "\n\tstr r2, " AT(SET_UP) "\n\t"
        "str r2, " AT(DRAWN) "\n"
        "1:\n\tstr r1, " AT(TRI) "\n\t"
        LOOK RECIPROCAL
        QUOTIENT("r0", "r12", "lr", "r3", "r10", "21f", "3")
        QUOTIENT("r12", "lr", "r4", "r2", "r9", "22f", "4")
        PLACE SIDES ROWS NEXT
        "9:\n\tmovs r0, #0\n\tb 19f\n"
        "18:\n\tmovs r0, #1\n"
        "19:\n\tldr r1, " AT(HAND) "\n\tldr r2, " AT(TESTED) "\n\tstr r2, [r1, %[h_tested]]\n\t"
        "ldr r2, " AT(SET_UP) "\n\tstr r2, [r1, %[h_set_up]]\n\t"
        "ldr r2, " AT(DRAWN) "\n\tstr r2, [r1, %[h_drawn]]\n\t"
        "ldr r2, " AT(ROW_LAST) "\n\tstr r2, [r1, %[h_row_last]]\n\t"
        "add sp, #" NUMBER(F_BYTES) "\n\tpop {r3, r4, r5, r6, r7, r8, r9, r10, r11, pc}\n"
        LAST_PIECE
        "21:\n\t" BIG("r0", "r12", "3b")
        "22:\n\t" BIG("r12", "lr", "4b")
        NEAR_SIDES GOES_ON
        ".align 2\n30:\n\t.word zs_recip_table, 0xaaaaaaab\n"
        :
        : [piece_base] "i"(H(piece_base)), [width] "i"(H(width)), [keep] "i"(H(keep)),
          [h_tested] "i"(H(tested)), [h_set_up] "i"(H(set_up)), [h_drawn] "i"(H(drawn)),
          [h_row_last] "i"(H(row_last)));
}

int zs_solid_v7m(struct zs_job *job)
{
    struct zs_renderer *const r = job->r;
    const uint32_t shift = r->view.piece_shift, pitch = (uint32_t)job->pitch * 2u;
    struct hand h = { .pool = r->vert,
                      .shift = shift,
                      .last = r->view.piece_base - (1u << shift) + 1u,
                      .edge = (uint32_t)zs_max32(job->width - 2 * ZS_TINY_SIDE + 1, 0),
                      .y0 = job->y0,
                      .y1 = job->y1,
                      .base = (uintptr_t)job->depth - (uint32_t)job->y0 * pitch - 2u,
                      .pitch = pitch,
                      .beside = (uintptr_t)job->color - (uintptr_t)job->depth,
                      .all = r->tri,
                      .instance = job->chain ? job->tri->instance : 0x10000u,
                      .piece_base = r->view.piece_base,
                      .width = job->width,
                      .keep = job->keep };
    const int all = list_draw(&h, job->tri);
    r->stats.pixels_tested += h.tested;
    r->stats.tris_setup += h.set_up;
    if (!all)
        return zs_small_declined(job, h.drawn);
    job->tri = h.drawn;
    job->row_last = h.row_last;
    return 1;
}

#endif
