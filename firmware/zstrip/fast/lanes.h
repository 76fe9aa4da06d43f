/* Rows of a triangle by arch/lanes.h. Internal.
 *
 * ZS_LANES_ROWS is the walk over a triangle's rows, around the loop of pixels of an accelerator: in
 * assembler, as a compiler spends 40 cycles a row more on a core with eight registers.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_FAST_LANES_H
#define ZS_FAST_LANES_H

#include "arch/lanes.h"
#include "core/rows.h"
#include "shade/persp.h"

/* 1: accelerators draw with the lanes. The assembler counts no written pixels. */
#define ZS_LANES_USED (ZS_RP2040 && !ZS_STATS)

/* A walk over rows. The lanes stand at `column` of the row above the first. */
struct zs_lanes_walk {
    uint32_t down[4]; /* added to lanes 0, 1 of the first interpolator, 0, 1 of the second, a row */
    const struct zs_cut *stop; /* of the first row that is not drawn */
    const uint16_t *palette;
    uint16_t *row;    /* depth keys of the row */
    uintptr_t beside; /* bytes from a key to its colour */
    uintptr_t pitch;  /* bytes from row to row */
    int32_t width;
    const struct zs_cut *cut; /* of the row */
    int32_t tested;           /* pixels, negative */
    int32_t column;
    const void *texel; /* for the twin, whose bases are no addresses */
};

#if ZS_RP2040

/* Pop the second (first) interpolator's result to a register. */
#define ZS_LANES_POP_1(to) "ldr " #to ", [r0, #0x5c]\n\t"
#define ZS_LANES_POP_0(to) "ldr " #to ", [r0, #0x1c]\n\t"

#define ZS_LANES_MOVE(accum, base, down)                                                           \
    "ldr r2, [r0, #" #base "]\n\tmuls r2, r1\n\tldr r3, [r0, #" #accum "]\n\tadds r2, r3\n\t"      \
    "ldr r3, [sp, #" #down "]\n\tadds r2, r3\n\tstr r2, [r0, #" #accum "]\n\t"

/* Define a function (lanes, walk): each row of the walk. pixel: what is done for a pixel, in
 * assembler. r0: lanes; r4, r6: ends of the row's keys and colours; r5: the pixel from there,
 * bytes, negative; r2, r3, r7: free. [sp, #20]: the palette. 4f leads to the next pixel. rest: more
 * of it, behind the loop. */
#define ZS_LANES_ROWS(name, pixel, rest)                                                           \
    static __attribute__((naked, noinline)) int32_t name(                                          \
        struct zs_lanes *lanes __attribute__((unused)),                                            \
        struct zs_lanes_walk *walk __attribute__((unused)))                                        \
    {                                                                                              \
        __asm__(                                                                                   \
            ".syntax unified\n\t"                                                                  \
            "push {r4, r5, r6, r7, lr}\n\t"                                                        \
            "mov r4, r8\n\tmov r5, r9\n\tmov r6, r10\n\tmov r7, r11\n\t"                           \
            "push {r1, r4, r5, r6, r7}\n\t"                                                        \
            "ldm r1!, {r2, r3, r4, r5, r6, r7}\n\t" /* down, stop, palette */                      \
            "push {r2, r3, r4, r5, r6, r7}\n\t"                                                    \
            "ldm r1!, {r2, r3, r4, r5, r6, r7}\n\t"                                                \
            "mov r8, r2\n\tmov r9, r3\n\tmov r10, r4\n\tmov r11, r5\n\tmov r12, r6\n\t"            \
            "mov lr, r7\n\tldr r1, [r1]\n"                                                         \
            "1:\n\t"                                                                               \
            "mov r7, r12\n\t"                                                                      \
            "movs r2, #0\n\tldrsh r5, [r7, r2]\n\t"                                                \
            "movs r2, #2\n\tldrsh r4, [r7, r2]\n\t"                                                \
            "adds r7, #4\n\tmov r12, r7\n\t"                                                       \
            "asrs r2, r5, #31\n\tbics r5, r2\n\t" /* at least 0 */                                 \
            "cmp r4, r11\n\tble 2f\n\tmov r4, r11\n"                                               \
            "2:\n\t"                                                                               \
            "subs r1, r5, r1\n\t" ZS_LANES_MOVE(0, 8, 0) ZS_LANES_MOVE(4, 12, 4)                   \
                ZS_LANES_MOVE(0x40, 0x48, 8) ZS_LANES_MOVE(                                        \
                    0x44, 0x4c,                                                                    \
                    12) "movs r1, r5\n\t"                                                          \
                        "subs r5, r4\n\tbge 5f\n\t"                                                \
                        "movs r1, r4\n\t"                                                          \
                        "add lr, r5\n\t"                                                           \
                        "lsls r5, #1\n\tlsls r4, #1\n\tadd r4, r8\n\t"                             \
                        "mov r6, r9\n\tadds r6, r4\n"                                              \
                        "3:\n\t" pixel "4:\n\t"                                                    \
                        "adds r5, #2\n\tbmi 3b\n"                                                  \
                        "5:\n\t"                                                                   \
                        "add r8, r10\n\t"                                                          \
                        "ldr r2, [sp, #16]\n\tcmp r2, r12\n\tbne 1b\n\t"                           \
                        "ldr r7, [sp, #24]\n\tadd sp, #24\n\t" /* the walk */                      \
                        "mov r2, r8\n\tstr r2, [r7, #24]\n\t"                                      \
                        "mov r2, lr\n\tstr r2, [r7, #44]\n\tstr r1, [r7, #48]\n\tmovs r0, #0\n\t"  \
                        "pop {r1, r4, r5, r6, r7}\n\t"                                             \
                        "mov r8, r4\n\tmov r9, r5\n\tmov r10, r6\n\tmov r11, r7\n\t"               \
                        "pop {r4, r5, r6, r7, pc}\n" rest);                                        \
    }
_Static_assert(sizeof(struct zs_lanes_walk) == 56, "offsets");

#else

/* The same walk. pixel: a function (lanes, walk, depth, color) that returns 1 if it has written.
 * Returns the pixels written. */
#define ZS_LANES_ROWS(name, pixel, rest)                                                           \
    static int32_t name(struct zs_lanes *lanes, struct zs_lanes_walk *w)                           \
    {                                                                                              \
        int32_t written = 0;                                                                       \
        for (; w->cut != w->stop; w->cut++, w->row = zs_lanes_at(w->row, w->pitch)) {              \
            const int32_t i0 = zs_max32(w->cut->x0, 0), i1 = zs_min32(w->cut->x1, w->width);       \
            for (int k = 0; k < 4; k++)                                                            \
                lanes[k >> 1].accum[k & 1] +=                                                      \
                    zs_wrap_mul(lanes[k >> 1].base[k & 1], i0 - w->column) + w->down[k];           \
            w->column = i0;                                                                        \
            for (; w->column < i1; w->column++, w->tested--)                                       \
                written += pixel(lanes, w, w->row + w->column,                                     \
                                 zs_lanes_at(w->row + w->column, w->beside));                      \
        }                                                                                          \
        return written;                                                                            \
    }

static inline uint16_t *zs_lanes_at(uint16_t *from, uintptr_t bytes)
{
    return (uint16_t *)((uintptr_t)from + bytes);
}

#endif

/* Set a lane: its result is the accumulator shifted right, bits [least, most]. It stands at column
 * 0 of a row, and each pop adds the plane's gx. */
ZS_ALWAYS_INLINE void zs_lanes_set(struct zs_lanes *lanes, int k, uint32_t shift, uint32_t least,
                                   uint32_t most, const struct zs_plane *p, int32_t row)
{
    lanes->ctrl[k] = shift | least << 5 | most << 10 | 1u << 18;
    lanes->base[k] = p->gx;
    lanes->accum[k] = zs_plane_at(p, 0, row);
}

typedef int32_t zs_lanes_fn(struct zs_lanes *lanes, struct zs_lanes_walk *w);

/* Draw the rows of a job. The lanes stand in the row above the first. t: NULL, or the texture. */
ZS_ALWAYS_INLINE void zs_lanes_draw(struct zs_job *job, struct zs_lanes *lanes,
                                    const struct zs_plane *const p[4], const struct zs_texture *t,
                                    zs_lanes_fn *rows)
{
    int32_t y = job->row, written = 0;
    struct zs_lanes_walk w; /* one by one: a compiler clears the whole of it else */
    for (int k = 0; k < 4; k++)
        w.down[k] = p[k]->gy;
    w.row = job->depth + (y - job->y0) * job->pitch;
    w.beside = (uintptr_t)job->color - (uintptr_t)job->depth;
    w.pitch = (uintptr_t)(uint32_t)job->pitch * 2u;
    w.width = job->width;
    w.tested = w.column = 0;
    w.palette = t ? t->palette : 0;
    w.texel = t ? t->texel : 0;
    for (;;) {
        if (y < job->cut_end) {
            w.cut = job->cut;
            w.stop = job->cut + (job->cut_end - y);
            written += rows(lanes, &w);
            y = job->cut_end;
        }
        if (y >= job->row_end)
            break;
        zs_edges_cut(job, y);
    }
    job->r->stats.pixels_tested += (uint32_t)-w.tested;
    zs_rows_written(job, written);
}

/* zs_fast.rows of an affine triangle whose keys do not saturate. Textures repeat; 0: declined. */
void zs_lanes_smooth_rows(struct zs_job *job);
int zs_lanes_texture_rows(struct zs_job *job);

#endif
