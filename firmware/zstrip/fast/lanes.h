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

/* A lane's result is its accumulator shifted right, bits [least, most]. */
#define ZS_LANES_FIELD(shift, least, most) ((shift) | (least) << 5 | (most) << 10 | 1u << 18)

#if ZS_RP2040

/* Pop the second (first) interpolator's result to a register. */
#define ZS_LANES_POP_1(to) "ldr " #to ", [r0, #0x5c]\n\t"
#define ZS_LANES_POP_0(to) "ldr " #to ", [r0, #0x1c]\n\t"

#define ZS_LANES_MOVE(accum, base, down)                                                           \
    "ldr r2, [r0, #" #base "]\n\tmuls r2, r1\n\tldr r3, [r0, #" #accum "]\n\tadds r2, r3\n\t"      \
    "ldr r3, [sp, #" #down "]\n\tadds r2, r3\n\tstr r2, [r0, #" #accum "]\n\t"

/* A row without a pixel: the lanes go down. */
#define ZS_LANES_DOWN(accum, down)                                                                 \
    "ldr r2, [r0, #" #accum "]\n\tldr r3, [sp, #" #down "]\n\tadds r2, r3\n\t"                     \
    "str r2, [r0, #" #accum "]\n\t"

/* The rows of a triangle. pixel: what is done for a pixel, in assembler. r0: lanes, which stand at
 * column r1 of the row above the first; r8: keys of the row; r9: bytes from a key to its colour;
 * r10: bytes from row to row; r11: width; r12: cuts; lr: pixels tested, negative; [sp]: what is
 * added to the four lanes a row, the end of the cuts, the palette. For a pixel, r4, r6: ends of the
 * row's keys and colours; r5: the pixel from there, bytes, negative; r2, r3, r7: free. 4f leads to
 * the next pixel. 1: a row that is beside the frame, or has no pixel. */
#define ZS_LANES_LOOP(pixel)                                                                       \
    "b 2f\n"                                                                                       \
    "1:\n\tsubs r7, #4\n\tmovs r2, #0\n\tldrsh r5, [r7, r2]\n\tmovs r2, #2\n\t"                    \
    "ldrsh r4, [r7, r2]\n\t"                                                                       \
    "asrs r2, r5, #31\n\tbics r5, r2\n\t" /* at least 0 */                                         \
    "cmp r4, r11\n\tble 3f\n\tmov r4, r11\n"                                                       \
    "3:\n\tcmp r5, r4\n\tblt 3f\n\t" ZS_LANES_DOWN(0, 0) ZS_LANES_DOWN(4, 4)                       \
        ZS_LANES_DOWN(0x40, 8) ZS_LANES_DOWN(0x44, 12) "b 5f\n"                                    \
    "2:\n\t"                                                                                       \
    "mov r7, r12\n\tldmia r7!, {r4}\n\tmov r12, r7\n\tuxth r5, r4\n\tlsrs r4, #16\n\t"             \
    "cmp r4, r11\n\tbhi 1b\n\tcmp r5, r4\n\tbcs 1b\n"                                              \
    "3:\n\t"                                                                                       \
    "subs r1, r5, r1\n\t" ZS_LANES_MOVE(0, 8, 0) ZS_LANES_MOVE(4, 12, 4)                           \
        ZS_LANES_MOVE(0x40, 0x48, 8) ZS_LANES_MOVE(0x44, 0x4c, 12)                                 \
    "movs r1, r4\n\tsubs r5, r4\n\tadd lr, r5\n\tlsls r5, #1\n\tlsls r4, #1\n\tadd r4, r8\n\t"     \
    "mov r6, r9\n\tadds r6, r4\n"                                                                  \
    "3:\n\t" pixel                                                                                 \
    "4:\n\tadds r5, #2\n\tbmi 3b\n"                                                                \
    "5:\n\tadd r8, r10\n\tldr r2, [sp, #16]\n\tcmp r2, r12\n\tbne 2b\n\t"

/* A plane from r7: lane to row r6 of column 0. r1: lanes. */
#define ZS_LANES_STAND(accum, base, down)                                                          \
    "ldmia r7!, {r2, r3, r4}\n\tstr r3, [r1, #" #base "]\n\tstr r4, [sp, #" #down "]\n\t"          \
    "muls r4, r6\n\tadds r2, r4\n\tstr r2, [r1, #" #accum "]\n\t"

#define ZS_LANES_AT(name, field) [name] "i"(offsetof(struct zs_job, field))

/* Define a function (job, set, third): draw the rows of job->cut from r3 to r4, and return how many
 * pixels are tested. third: the third lane's plane, at column 0 of row 0, as job->c[0] and c[1] of
 * the first two. rest: more of `pixel`, behind the loop. zs_lanes_call calls it: all registers
 * change. */
#define ZS_LANES_ROWS(name, pixel, rest)                                                           \
    static ZS_NAKED uint32_t name(struct zs_job *job __attribute__((unused)),                      \
                                  const struct zs_lanes_set *set __attribute__((unused)),          \
                                  const struct zs_plane *third __attribute__((unused)))            \
    {                                                                                              \
        __asm__ volatile(                                                                          \
            ".syntax unified\n\t"                                                                  \
            "push {lr}\n\tmov r8, r2\n\tmov r12, r3\n\tmov r9, r4\n\t"                             \
            "ldmia r1!, {r2, r3, r4, r5, r6, r7}\n\tpush {r7}\n\tsub sp, #20\n\t"                  \
            "movs r1, #0xd0\n\tlsls r1, #24\n\tadds r1, #0x80\n\t"                                 \
            "str r2, [r1, #0x2c]\n\tstr r3, [r1, #0x30]\n\tstr r4, [r1, #0x6c]\n\t"                \
            "str r5, [r1, #0x70]\n\tstr r6, [r1, #0x10]\n\tmovs r2, #0\n\tstr r2, [r1, #0x50]\n\t" \
            /* the row above the first: r6 */                                                      \
            "mov r2, r9\n\tstr r2, [sp, #16]\n\tmovs r5, %[cut]\n\tadds r5, #200\n\t"              \
            "adds r5, r0\n\t"                                                                      \
            "mov r6, r12\n\tsubs r6, r5\n\tasrs r6, #2\n\tldr r5, [r0, %[row]]\n\tadds r6, r5\n\t" \
            "mov r9, r6\n\tsubs r6, #1\n\tmovs r7, r0\n\tadds r7, %[c]\n\t"                        \
            ZS_LANES_STAND(0, 8, 0) ZS_LANES_STAND(4, 12, 4)                                       \
            "mov r7, r8\n\t" ZS_LANES_STAND(0x40, 0x48, 8)                                         \
            /* the key, whose plane is at its anchor */                                            \
            "movs r7, %[ia]\n\tadds r7, #100\n\tadds r7, r0\n\tldr r5, [r7]\n\t"                   \
            "ldr r7, [r7, #4]\n\tsubs r6, r7\n\t"                                                  \
            "movs r7, r0\n\tadds r7, %[key]\n\t" ZS_LANES_STAND(0x44, 0x4c, 12)                    \
            "muls r5, r3\n\tsubs r2, r5\n\tstr r2, [r1, #0x44]\n\t"                                \
            /* where rows are */                                                                   \
            "mov r2, r9\n\tldr r3, [r0, %[y0]]\n\tsubs r2, r3\n\tldr r3, [r0, %[pitch]]\n\t"       \
            "lsls r3, #1\n\tmuls r2, r3\n\t"                                                       \
            "ldr r5, [r0, %[depth]]\n\tadds r2, r5\n\tldr r6, [r0, %[color]]\n\tsubs r6, r5\n\t"   \
            "ldr r7, [r0, %[width]]\n\t"                                                           \
            "mov r8, r2\n\tmov r9, r6\n\tmov r10, r3\n\tmov r11, r7\n\t"                           \
            "movs r0, r1\n\tmovs r1, #0\n\tmov lr, r1\n\t" ZS_LANES_LOOP(pixel)                    \
            "mov r0, lr\n\trsbs r0, r0, #0\n\tadd sp, #24\n\tpop {pc}\n" rest                      \
            :                                                                                      \
            : ZS_LANES_AT(row, row), ZS_LANES_AT(c, c),                                            \
              [ia] "i"(offsetof(struct zs_job, geom.ia) - 100u),                                   \
              ZS_LANES_AT(key, key), ZS_LANES_AT(y0, y0),                                          \
              ZS_LANES_AT(pitch, pitch), ZS_LANES_AT(depth, depth), ZS_LANES_AT(color, color),     \
              ZS_LANES_AT(width, width), [cut] "i"(offsetof(struct zs_job, cut) - 200u));          \
    }
_Static_assert(offsetof(struct zs_lanes, ctrl) == 0x2c && offsetof(struct zs_lanes, base) == 8 &&
                   sizeof(struct zs_plane) == 12,
               "as above");

#else

static inline uint16_t *zs_lanes_at(uint16_t *from, uintptr_t bytes)
{
    return (uint16_t *)((uintptr_t)from + bytes);
}

/* Set the lanes to column 0 of the row above the job's. */
static inline void zs_lanes_stand(struct zs_lanes lanes[2], const struct zs_lanes_set *set,
                                  const struct zs_plane *const p[4], int32_t above)
{
    for (int k = 0; k < 4; k++) {
        struct zs_lanes *const at = &lanes[k >> 1];
        at->ctrl[k & 1] = set->ctrl[k];
        at->base[k & 1] = p[k]->gx;
        at->accum[k & 1] = zs_plane_at(p[k], 0, above);
    }
    lanes[0].base[2] = set->base;
    lanes[1].base[2] = 0;
}

/* The same. pixel: a function (lanes, set, depth, color) that returns 1 if it has written. */
#define ZS_LANES_ROWS(name, pixel, rest)                                                           \
    static uint32_t name(struct zs_job *job, const struct zs_lanes_set *set,                       \
                         const struct zs_plane *third)                                             \
    {                                                                                              \
        struct zs_lanes lanes[2];                                                                  \
        struct zs_plane key = job->key;                                                            \
        const struct zs_plane *const p[4] = { &job->c[0], &job->c[1], third, &key };               \
        const uintptr_t beside = (uintptr_t)job->color - (uintptr_t)job->depth;                    \
        uint16_t *row = job->depth + (job->row - job->y0) * job->pitch;                            \
        int32_t column = 0, tested = 0, written = 0;                                               \
        const struct zs_cut *cut = job->cut, *const stop = cut + (job->cut_end - job->row);        \
        zs_plane_origin(&job->geom, &key);                                                         \
        zs_lanes_stand(lanes, set, p, job->row - 1);                                               \
        for (; cut != stop; cut++, row += job->pitch) {                                            \
            const int32_t i0 = zs_max32(cut->x0, 0), i1 = zs_min32(cut->x1, job->width);           \
            for (int k = 0; k < 4; k++)                                                            \
                lanes[k >> 1].accum[k & 1] +=                                                      \
                    zs_wrap_mul(lanes[k >> 1].base[k & 1], i0 - column) + p[k]->gy;                \
            column = i0;                                                                           \
            for (; column < i1; column++, tested++)                                                \
                written += pixel(lanes, set, row + column, zs_lanes_at(row + column, beside));     \
        }                                                                                          \
        zs_rows_written(job, written);                                                             \
        return (uint32_t)tested;                                                                   \
    }

#endif

typedef uint32_t zs_lanes_fn(struct zs_job *job, const struct zs_lanes_set *set,
                             const struct zs_plane *third);

/* rows(job, set, third), whose registers are saved on an RP2040. */
#if ZS_RP2040
uint32_t zs_lanes_call(struct zs_job *job, const struct zs_lanes_set *set,
                       const struct zs_plane *third, zs_lanes_fn *rows);
#else
static inline uint32_t zs_lanes_call(struct zs_job *job, const struct zs_lanes_set *set,
                                     const struct zs_plane *third, zs_lanes_fn *rows)
{
    return rows(job, set, third);
}
#endif

/* Draw the rows of a job that job->cut does not hold. */
static ZS_NOINLINE void zs_lanes_go_on(struct zs_job *job, const struct zs_lanes_set *set,
                                       const struct zs_plane *third, zs_lanes_fn *rows)
{
    do {
        zs_edges_cut(job, job->cut_end);
        job->r->stats.pixels_tested += zs_lanes_call(job, set, third, rows);
    } while (job->cut_end < job->row_end);
}

/* Draw the rows of a job. */
ZS_ALWAYS_INLINE void zs_lanes_draw(struct zs_job *job, const struct zs_lanes_set *set,
                                    const struct zs_plane *third, zs_lanes_fn *rows)
{
    job->r->stats.pixels_tested += zs_lanes_call(job, set, third, rows);
    if (ZS_SELDOM(job->cut_end < job->row_end))
        zs_lanes_go_on(job, set, third, rows);
}

/* zs_fast.rows of an affine triangle whose keys do not saturate. Textures repeat; 0: declined. */
void zs_lanes_smooth_rows(struct zs_job *job);
int zs_lanes_texture_rows(struct zs_job *job);
/* zs_fast.draw of small triangles with smooth colours, and of textured ones, on an RP2040. */
int zs_lanes_smooth_draw(struct zs_job *job);
int zs_lanes_texture_draw(struct zs_job *job);
/* zs_fast.span of smooth colours, on an RP2040. */
void zs_lanes_smooth_span(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1,
                          uint32_t sum, uint32_t step);

#endif
