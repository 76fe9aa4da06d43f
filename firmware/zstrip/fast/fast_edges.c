/* Spans of tiny triangles, both sides in one loop, with a division for each side and row, for cores
 * with a divide instruction, and for an RP2040, whose divider takes eight cycles: there a row takes
 * 22 cycles in place of 100, scene teapot 0.4 million cycles less. On other cores stepping by
 * remainders is faster (core/edges.c), and there is no hook. Triangles that are not tiny are
 * declined. What it is worth on a Cortex-M3: zs_fast.h.
 *
 * SPDX-License-Identifier: MIT
 */
#include "arch/lanes.h"
#include "core/fast.h"
#include "core/fx.h"
#include "core/job.h"
#include "fast/set_up_parts.h"
#include "zs_fast.h"

#if ZS_RP2040

_Static_assert(AT(geom.dx2) == AT(geom) + 4 && AT(geom.dy1) == AT(geom) + 8 &&
                   AT(geom.dy2) == AT(geom) + 12 && AT(geom) >= 100 && AT(geom.tiny) < 356 &&
                   AT(cut_end) < 128 && AT(v) < 128,
               "loaded at once");
_Static_assert(ZS_TINY_SIDE == 65 && offsetof(struct zs_vertex, y) == 4, "as below");

/* Start a division. Eight cycles later the quotient is at 0x70. */
#define DIVIDE(sum, span, step)                                                                    \
    "str " #sum ", [r5, #0x60]\n\tstr " #span ", [r5, #0x64]\n\tadd " #sum ", " #step "\n\t"

/* One of the sides below the middle vertex, along an edge from a to b. r4: geom, r1: x, r5: down.
 * Uses both. */
#define SIDE(a_dx, a_dy, b_dx, b_dy, sum, span, step)                                              \
    "adds r4, %[geom]\n\tadds r4, #100\n\tldr " #sum ", [r4, #" #a_dy "]\n\t"                      \
    "subs r5, " #sum "\n\t"                                                                        \
    "ldr " #span ", [r4, #" #b_dy "]\n\tsubs " #span ", " #sum "\n\t"                              \
    "ldr " #sum ", [r4, #" #a_dx "]\n\tadds r1, " #sum "\n\t"                                      \
    "ldr r4, [r4, #" #b_dx "]\n\tsubs r4, " #sum "\n\t"                                            \
    "muls r1, " #span "\n\tmuls r5, r4\n\tadds r1, r5\n\tlsls " #span ", #8\n\t"                   \
    "adds " #sum ", r1, " #span "\n\tsubs " #sum ", #1\n\tlsls r4, #8\n\tmov " #step ", r4\n\t"

/* zs_fast.edges of tiny triangles, as below. Sum, span, step of the left side: r3, r7, r9; of the
 * right one: r0, r6, r8; r2: the row's cut, lr: the last one's end; r12: what columns count from.
 * [sp]: job, row, off, x. While a division runs, the column before it is stored. */
ZS_NAKED void zs_set_up_cuts_part(void)
{
    __asm__ volatile(
        ".syntax unified\n\tpush {lr}\n\t"
        "ldr r2, [r0, %[v]]\n\tldr r3, [r2]\n\tldr r4, [r2, #4]\n\t"
        "asrs r2, r3, #8\n\tsubs r2, #65\n\tmov r12, r2\n\t"
        "uxtb r3, r3\n\tmovs r2, #129\n\tlsls r2, #7\n\tadds r3, r2\n\t" /* x */
        "lsls r2, r1, #8\n\tadds r2, #128\n\tsubs r2, r4\n\t"           /* off */
        "push {r0, r1, r2, r3}\n\t"
        "movs r7, r0\n\tadds r7, %[geom]\n\tadds r7, #100\n\tldmia r7, {r4, r5, r6, r7}\n\t"
        /* the right side, then the left one */
        "movs r0, r3\n\tmuls r0, r6\n\tmovs r1, r2\n\tmuls r1, r4\n\tadds r0, r1\n\t"
        "lsls r6, #8\n\tadds r0, r6\n\tsubs r0, #1\n\tlsls r4, #8\n\tmov r8, r4\n\t"
        "muls r3, r7\n\tmuls r2, r5\n\tadds r3, r2\n\t"
        "lsls r7, #8\n\tadds r3, r7\n\tsubs r3, #1\n\tlsls r5, #8\n\tmov r9, r5\n\t"
        /* rows above the middle vertex */
        "ldr r1, [sp]\n\tldr r2, 9f\n\tadds r2, r1\n\tldr r4, [r1, %[mid]]\n\t"
        "ldr r5, [r1, %[end]]\n\tcmp r4, r5\n\tble 1f\n\tmovs r4, r5\n"
        "1:\n\tldr r1, [sp, #4]\n\tsubs r4, r1\n\tble 5f\n\t"
        "lsls r4, #2\n\tadds r4, r2\n\tmov lr, r4\n"
        /* rows */
        "2:\n\tmovs r5, #0xd0\n\tlsls r5, #24\n\t" DIVIDE(r3, r7, r9)
        "b 1f\n1:\tb 1f\n1:\tb 1f\n1:\tnop\n"
        "3:\n\tldr r1, [r5, #0x70]\n\t" DIVIDE(r0, r6, r8)
        "add r1, r12\n\tstrh r1, [r2]\n\tb 1f\n1:\tb 1f\n1:\t"
        "ldr r1, [r5, #0x70]\n\t" DIVIDE(r3, r7, r9)
        "add r1, r12\n\tstrh r1, [r2, #2]\n\tadds r2, #4\n\tcmp r2, lr\n\tbne 3b\n\t"
        "mov r1, r9\n\tsubs r3, r1\n" /* it has gone a row too far */
        /* rows below it */
        "5:\n\tldr r4, [sp]\n\tldr r5, 9f\n\tadds r5, r4\n\tldr r1, [r4, %[end]]\n\t"
        "ldr r4, [sp, #4]\n\tsubs r1, r4\n\tlsls r1, #2\n\tadds r1, r5\n\tmov lr, r1\n\t"
        "cmp r1, r2\n\tbls 7f\n\t"
        "subs r5, r2, r5\n\tlsls r5, #6\n\tldr r1, [sp, #8]\n\tadds r5, r1\n\tldr r1, [sp, #12]\n\t"
        "ldr r4, [sp]\n\tldrb r4, [r4, %[right]]\n\tcmp r4, #0\n\tldr r4, [sp]\n\tbne 6f\n\t"
        SIDE(4, 12, 0, 8, r3, r7, r9) "b 2b\n"
        "6:\n\t" SIDE(0, 8, 4, 12, r0, r6, r8) "b 2b\n"
        "7:\n\tadd sp, #16\n\tpop {pc}\n\t"
        ".align 2\n9:\n\t.word %c[cut]\n"
        :
        : [v] "i"(AT(v)), [geom] "i"(AT(geom) - 100u),
          [mid] "i"(AT(row_mid)), [end] "i"(AT(cut_end)), [right] "i"(AT(mid_right)),
          [cut] "i"(AT(cut)));
}

static ZS_NAKED int tiny_cuts(struct zs_job *job __attribute__((unused)),
                              int32_t row __attribute__((unused)))
{
    __asm__ volatile(
        ".syntax unified\n\tmovs r2, %[tiny]\n\tadds r2, #100\n\tldr r2, [r0, r2]\n\t"
        "cmp r2, #0\n\tbne 1f\n\tmovs r0, r2\n\tbx lr\n"
        "1:\n\tpush {r4, r5, r6, r7, lr}\n\tmov r4, r8\n\tmov r5, r9\n\tpush {r4, r5}\n\t"
        "bl zs_set_up_cuts_part\n\tpop {r4, r5}\n\tmov r8, r4\n\tmov r9, r5\n\tmovs r0, #1\n\t"
        "pop {r4, r5, r6, r7, pc}\n\t"
        :
        : [tiny] "i"(AT(geom.tiny) - 100u));
}

#else

/* A side of a tiny triangle. Its column is sum / span, counted from ZS_TINY_SIDE left of the top
 * vertex, so that sum is positive. Each product is below 2^29.1. */
struct side {
    uint32_t sum, span, step;
};

/* Set up a side along an edge (dx, dy) whose upper end is x right of the sample in column 0 and off
 * above the samples of the first row. */
static inline struct side side_of(int32_t x, int32_t off, int32_t dx, int32_t dy)
{
    const uint32_t span = (uint32_t)dy * ZS_SUBPX_ONE;
    const struct side s = { (uint32_t)(x * dy + off * dx) + span - 1u, span,
                            (uint32_t)dx * ZS_SUBPX_ONE };
    return s;
}

/* Find the spans of the next n rows. */
static inline struct zs_cut *sides_cut(struct zs_cut *cut, int32_t n, int32_t from,
                                       struct side *left, struct side *right)
{
    for (struct zs_cut *const end = cut + n; cut != end; cut++) {
        /* a horizontal edge has no rows */
        ZS_FACT(left->span >= ZS_SUBPX_ONE && right->span >= ZS_SUBPX_ONE);
        cut->x0 = (int16_t)(from + (int32_t)(left->sum / left->span));
        cut->x1 = (int16_t)(from + (int32_t)(right->sum / right->span));
        left->sum += left->step;
        right->sum += right->step;
    }
    return cut;
}

ZS_IN_ORDER static ZS_NOINLINE int tiny_cuts(struct zs_job *job, int32_t row)
{
    const struct zs_geom *g = &job->geom;
    const int32_t end = job->cut_end;
    if (!g->tiny)
        return 0;
    const int32_t ax = job->v[0]->x, ay = job->v[0]->y, from = (ax >> ZS_SUBPX_BITS) - ZS_TINY_SIDE;
    const int32_t x = ax - ZS_SUBPX_HALF - from * ZS_SUBPX_ONE,
                  off = row * ZS_SUBPX_ONE + ZS_SUBPX_HALF - ay;
    const int32_t upper = zs_max32(zs_min32(job->row_mid, end) - row,
                                   0); /* rows above the middle vertex */
    struct side left = side_of(x, off, g->dx2, g->dy2), right = side_of(x, off, g->dx1, g->dy1);
    struct zs_cut *const cut = sides_cut(job->cut, upper, from, &left, &right);
    const int32_t lower = end - row - upper, down = off + upper * ZS_SUBPX_ONE;
    if (lower <= 0)
        return 1;
    if (job->mid_right)
        right = side_of(x + g->dx1, down - g->dy1, g->dx2 - g->dx1, g->dy2 - g->dy1);
    else
        left = side_of(x + g->dx2, down - g->dy2, g->dx1 - g->dx2, g->dy1 - g->dy2);
    (void)sides_cut(cut, lower, from, &left, &right);
    return 1;
}

#endif

const struct zs_fast zs_fast_edges = { ZS_SET_UP_HOOK .edges = ZS_DIVIDES || ZS_RP2040 ? tiny_cuts
                                                                                      : 0 };
