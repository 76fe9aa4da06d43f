/* Small triangles of one colour on Armv7-M, in assembler, one triangle of the list after the
 * other: set-up, rows and pixels without a call, where a compiler has 13 registers for 18 values
 * of a row and spills. On a Cortex-M3 it saves 13 % of scene relief (0.21 of 1.65 million
 * instructions), 17 % of sheet (2.2 of 12.7), 9 % of mesh: set-up and list take some 190
 * instructions a triangle in place of 320, a row 17 in place of 19. 1,360 bytes, the functions in
 * C 1,150. 80 of them are for keys with a bias: a ball of 1,012 triangles then
 * takes 0.57 in place of 0.78 million instructions.
 *
 * Exact: it is fast/small.h and small_draw of fast/fast_solid.c, bit for bit. tests/checks/v7m.c
 * compares them on an emulated M3 and M7; every frame of one colour on M3, M4 and M7 is drawn by it
 * (tests/property/scene_sums.sh).
 *
 * SPDX-License-Identifier: MIT
 */
#include "fast/solid_v7m.h"

#if ZS_V7M

#include "fast/small_v7m.h"

/* What is the same for all triangles of the list, and what the loop found. The first words are
 * copied to the stack. */
struct hand {
    const struct zs_vertex *pool;
    uint32_t shift, last; /* log2 of a linear piece; the least depth of the last piece. last: 0 if
                             keys are moved */
    uint32_t edge;        /* columns less both margins and one; 0: all triangles are looked at */
    int32_t y0, y1;
    uintptr_t base; /* of depth: row 0 of the frame, a pixel left of the viewport */
    uintptr_t pitch, beside; /* bytes from row to row; from a key to its colour */
    const struct zs_tri *all;
    uint32_t instance; /* whose triangles it goes on to; 65536: one triangle */
    /* not copied */
    uint32_t beyond, least, moved; /* the greatest and the least depth that is drawn, if it is the
                                      last piece or if keys are moved; by how much they are */
    int32_t width;
    uint16_t **keep;
    uint32_t tested, set_up; /* number of pixels, of triangles */
    const struct zs_tri *drawn;
    int32_t tri_end;
};
#define COPIED 11
#define H(field) offsetof(struct hand, field)
_Static_assert(H(instance) == 4 * (COPIED - 1) && H(moved) == H(least) + 4, "these are copied");
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
#define F_TRI_END 108
#define F_BYTES 112
_Static_assert(F_SHIFT == F_POOL + H(shift) && F_LAST == F_POOL + H(last) && F_EDGE == F_POOL +
                   H(edge) && F_Y0 == F_POOL + H(y0) && F_Y1 == F_POOL + H(y1) && F_BASE == F_POOL
                   + H(base) && F_PITCH == F_POOL + H(pitch) && F_BESIDE == F_POOL + H(beside) &&
                   F_ALL == F_POOL + H(all) && F_INSTANCE == F_POOL + H(instance),
               "a copy");
/* lr, r4, F_END: depth pointers, of the first row, of the one below the middle vertex, beyond the
 * last. */
#define POINTERS                                                                                   \
    "ldr r5, " AT(BASE) "\n\tadd r4, r5, r4, lsl #1\n\tldr r5, " AT(PITCH) "\n\t"                \
    "mla lr, lr, r5, r4\n\tmla r11, r11, r5, lr\n\tmla r4, r1, r5, lr\n\tstr r11, " AT(END) "\n\t"

/* r0: what a pixel adds to the key; r6: the colour, above it the number of
 * pixels; r7: from a key to its colour; r9: pitch. */
#define ROWS                                                                                       \
    "ldr r1, " AT(TRI) "\n\tldr r7, " AT(BESIDE) "\n\tldrh r6, [r1, #8]\n\t"                     \
    "ldr r9, " AT(PITCH) "\n\tldr r1, " AT(SET_UP) "\n\tadds r1, #1\n\tstr r1, " AT(SET_UP) "\n\t"\
    "cmp lr, r4\n\tbeq 12f\n"                                                                      \
    "10:\n\t" /* a row */                                                                          \
    "ldrd r1, r2, [sp]\n\tudiv r1, r5, r1\n\tadd r5, r2\n\tldrd r2, r3, [sp, #8]\n\t"              \
    "udiv r2, r11, r2\n\tadd r11, r3\n\tsubs r3, r2, r1\n\tbls 11f\n\tadd r6, r6, r3, lsl #16\n\t" \
    "mla r3, r0, r1, r8\n\tadd r1, lr, r1, lsl #1\n\tadd r2, lr, r2, lsl #1\n"                    \
    "13:\n\t" /* a pixel */                                                                        \
    "ldrh r10, [r1, #2]!\n\tcmp r10, r3, lsr #16\n\tbls 14f\n\tlsr r10, r3, #16\n\t"               \
    "strh r10, [r1]\n\tstrh r6, [r1, r7]\n"                                                        \
    "14:\n\tadd r3, r0\n\tcmp r1, r2\n\tbne 13b\n"                                                 \
    "11:\n\tadd lr, r9\n\tadd r8, r12\n\tcmp lr, r4\n\tbne 10b\n"                                 \
    "12:\n\tldr r4, " AT(END) "\n\tcmp lr, r4\n\tbeq 7f\n\t"                                      \
    "ldrd r1, r2, " AT(NEXT) "\n\tldr r3, " AT(TURN) "\n\tldr r10, " AT(SUM) "\n\t"             \
    "cbz r3, 15f\n\tstrd r1, r2, [sp, #8]\n\tmov r11, r10\n\tb 10b\n"                              \
    "15:\n\tstrd r1, r2, [sp]\n\tmov r5, r10\n\tb 10b\n"                                           \
    "7:\n\tldr r1, " AT(TESTED) "\n\tadd r1, r1, r6, lsr #16\n\tstr r1, " AT(TESTED) "\n"

/* Depths of the last piece, held to what zs_small_look takes; or moved by a depth state's bias. */
#define LAST_PIECE                                                                                 \
    "20:\n\tldr r5, " AT(HAND) "\n\tldr r12, [r5, %[beyond]]\n\t"                                 \
    "cmp r8, r12\n\titt ls\n\tcmpls r11, r12\n\tcmpls r4, r12\n\tbhi 9b\n\t"                    \
    "ldrd r12, r5, [r5, %[least]]\n\tcmp r5, #0\n\tbeq 2b\n\t"                                   \
    "cmp r8, r12\n\titt cs\n\tcmpcs r11, r12\n\tcmpcs r4, r12\n\tbcc 9b\n\t"                    \
    "add r8, r5\n\tadd r11, r5\n\tadd r4, r5\n\tb 2b\n"
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
        PLACE POINTERS SIDES("r4", "r11") ROWS NEXT
        "9:\n\tmovs r0, #0\n\tb 19f\n"
        "18:\n\tmovs r0, #1\n"
        "19:\n\tldr r1, " AT(HAND) "\n\tldr r2, " AT(TESTED) "\n\tstr r2, [r1, %[h_tested]]\n\t"
        "ldr r2, " AT(SET_UP) "\n\tstr r2, [r1, %[h_set_up]]\n\t"
        "ldr r2, " AT(DRAWN) "\n\tstr r2, [r1, %[h_drawn]]\n\t"
        "ldr r2, " AT(TRI_END) "\n\tstr r2, [r1, %[h_tri_end]]\n\t"
        "add sp, #" NUMBER(F_BYTES) "\n\tpop {r3, r4, r5, r6, r7, r8, r9, r10, r11, pc}\n"
        LAST_PIECE
        "21:\n\t" BIG("r0", "r12", "3b")
        "22:\n\t" BIG("r12", "lr", "4b")
        NEAR_SIDES("ldr r11, " AT(HAND) "\n\tldr r11, [r11, %[width]]")
        GOES_ON("ldr r4, " AT(HAND) "\n\tldr r4, [r4, %[keep]]")
        ".align 2\n30:\n\t.word zs_recip_table, 0xaaaaaaab\n"
        :
        : [beyond] "i"(H(beyond)), [least] "i"(H(least)), [width] "i"(H(width)),
          [keep] "i"(H(keep)), [h_tested] "i"(H(tested)), [h_set_up] "i"(H(set_up)),
          [h_drawn] "i"(H(drawn)), [h_tri_end] "i"(H(tri_end)));
}

/* Move all keys by a bias. Return 0 if they all would saturate. */
static ZS_RARE int moved(struct hand *h, int32_t bias)
{
    const uint32_t more = (uint32_t)zs_max32(bias, 0) << 16;
    if (more > h->beyond)
        return 0;
    h->last = 0;
    h->beyond -= more;
    h->least = (uint32_t)-zs_min32(bias, 0) << 16;
    h->moved = (uint32_t)bias << 16;
    return 1;
}

int zs_solid_v7m(struct zs_job *job)
{
    struct zs_renderer *const r = job->r;
    const uint32_t shift = r->view.piece_shift, pitch = (uint32_t)job->pitch * 2u;
    struct hand h; /* what list_draw sets is left as it is */
    h.pool = r->vert;
    h.shift = shift;
    h.last = r->view.piece_base - (1u << shift) + 1u;
    h.edge = (uint32_t)zs_max32(job->width - 2 * ZS_TINY_SIDE + 1, 0);
    h.y0 = job->y0;
    h.y1 = job->y1;
    h.base = (uintptr_t)job->depth - (uint32_t)job->y0 * pitch - 2u;
    h.pitch = pitch;
    h.beside = (uintptr_t)job->color - (uintptr_t)job->depth;
    h.all = r->tri;
    h.instance = job->chain ? job->tri->instance : 0x10000u;
    h.beyond = r->view.piece_base - ZS_SMALL_SAFE;
    h.moved = 0;
    h.width = job->width;
    h.keep = job->keep;
    if (job->depth_state && !moved(&h, job->depth_state->bias))
        return 0;
    const int all = list_draw(&h, job->tri);
    r->stats.pixels_tested += h.tested;
    r->stats.tris_setup += h.set_up;
    if (!all)
        return zs_small_declined(job, h.drawn);
    job->tri = h.drawn;
    job->tri_end = h.tri_end;
    return 1;
}

#endif
