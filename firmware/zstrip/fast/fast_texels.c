/* The inner loops of each texel format: gathering of texels by index, and the scanlines of affine
 * and of small triangles, with their depth test.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/fx.h"
#include "core/fast.h"
#include "fast/small.h"
#include "shade/texels.h"
#include "zs_fast.h"

ZS_ALWAYS_INLINE void gather(const struct zs_texture *t, uint16_t *out, int32_t n,
                             const uint32_t *at, zs_read_fn *read)
{
    const void *texel = t->texel;
    const uint16_t *palette = t->palette;
    for (uint16_t *const end = out + n; out != end; out++, at++)
        *out = zs_wire16(read(texel, palette, *at));
}

ZS_ALWAYS_INLINE void rows(struct zs_job *job, zs_read_fn *read)
{
    const struct zs_texture *t = job->sampler.texture;
    const void *texel = t->texel;
    const uint16_t *palette = t->palette;
    const uint32_t right = 32u - t->log2_w, down = 32u - t->log2_h, log2_w = t->log2_w;
    /* bytes from a key to its colour */
    const uintptr_t beside = (uintptr_t)job->color - (uintptr_t)job->depth;
    uint32_t gx = job->key.gx, du = job->c[0].gx, dv = job->c[1].gx, tested = 0;
    int32_t written = 0, y = job->row;
    zs_plane_origin(&job->geom, &job->key);
    uint16_t *row = job->depth + (y - job->y0) * job->pitch;
    for (;;) {
        for (const struct zs_cut *cut = job->cut; y < job->cut_end; cut++, y++, row += job->pitch) {
            const int32_t i0 = zs_max32(cut->x0, 0), n = zs_min32(cut->x1, job->width) - i0;
            if (n <= 0)
                continue;
            uint32_t sum = zs_plane_at(&job->key, i0, y), u = zs_plane_at(&job->c[0], i0, y),
                     v = zs_plane_at(&job->c[1], i0, y);
            uint16_t *depth = row + i0;
            const uint16_t *end = depth + n;
            tested += (uint32_t)n;
            do {
                ZS_HIGH_REGISTER(gx);
                ZS_HIGH_REGISTER(du);
                ZS_HIGH_REGISTER(dv);
                ZS_HIGH_REGISTER(end);
                const uint32_t key = sum >> 16;
                if (key < *depth) {
                    *depth = (uint16_t)key;
                    *(uint16_t *)((uintptr_t)depth + beside) = zs_wire16(
                        read(texel, palette, ((v >> down) << log2_w) + (u >> right)));
                    if (ZS_STATS)
                        written++;
                }
                sum += gx;
                u += du;
                v += dv;
            } while (++depth != end);
        }
        if (y >= job->row_end)
            break;
        zs_edges_cut(job, y);
    }
    zs_rows_counted(job, tested, written);
}

/* Return the address of the first row; rows from there to another one. */
static inline uintptr_t first_of(const struct zs_job *job, const struct zs_sides *w)
{
    const uintptr_t pitch = w->down[0];
    return ZS_V7M ? (uintptr_t)w->row
                  : (uintptr_t)job->depth + (uint32_t)(w->row - job->y0) * pitch + w->left;
}
static inline uint32_t rows_to(const struct zs_sides *w, int32_t row)
{
    return (uint32_t)(ZS_V7M ? row : row - w->row);
}

#if !ZS_64

#define ZS_WORD(field) ((int)(offsetof(struct zs_texel_rows, field) / 4u))

/* Draw the scanlines of a small triangle. The values that step from row to row are kept in *w,
 * because the pixel loop needs all registers. */
ZS_ALWAYS_INLINE void small(struct zs_job *job, const struct zs_texture *t, struct zs_texel_rows *w,
                            zs_read_fn *read, int lit)
{
    /* bytes from a key to its colour */
    const uintptr_t beside = (uintptr_t)job->color - (uintptr_t)job->depth;
    const uint32_t pitch = w->sides.down[0];
    const void *const texel = t->texel;
    const uint16_t *const palette = t->palette;
    uintptr_t row = first_of(job, &w->sides), end = row + rows_to(&w->sides, w->sides.mid) * pitch;
    const uintptr_t last = row + rows_to(&w->sides, w->sides.end) * pitch;
    const uint32_t *const word = (const uint32_t *)(const void *)w;
    int32_t written = 0;
    w->at[3] = 0;
    for (;;) {
        for (; row != end; row += w->sides.down[0]) {
            uint32_t x0, x1, sum, u, v, tested, gx, du, dv, width, down, right, by[2], by_v;
            zs_small_columns(&w->sides, &x0, &x1);
            zs_two(word, ZS_WORD(at), &sum, &u);
            zs_two(word, ZS_WORD(at) + 2, &v, &tested);
            zs_two(word, ZS_WORD(down), &by[0], &by[1]);
            by_v = w->down[2];
            w->at[0] = sum + by[0];
            w->at[1] = u + by[1];
            w->at[2] = v + by_v;
            uint32_t light = lit ? w->light : 0;
            if (lit)
                w->light = light + w->light_down;
            if (x0 >= x1)
                continue;
            w->at[3] = tested + (x1 - x0);
            uint16_t *depth = (uint16_t *)row + x0, *const stop = (uint16_t *)row + x1;
            zs_two(word, ZS_WORD(right), &gx, &du);
            zs_two(word, ZS_WORD(right) + 2, &dv, &width);
            sum += gx * x0;
            u += du * x0;
            v += dv * x0;
            zs_two(word, ZS_WORD(column), &right, &down);
            if (lit)
                light += w->light_right * x0;
            do {
                if (sum >> 16 < *++depth) {
                    *depth = (uint16_t)zs_high(sum);
                    uint32_t color = read(texel, palette, (v >> down) * width + (u >> right));
                    if (lit)
                        color = zs_texture_shine(color, light >> ZS_TEXTURE_LIGHT_SHIFT);
                    *(uint16_t *)((uintptr_t)depth + beside) = zs_wire16((uint16_t)color);
                    if (ZS_STATS)
                        written++;
                }
                sum += gx;
                u += du;
                v += dv;
                if (lit)
                    light += w->light_right;
            } while (depth != stop);
        }
        end = last;
        if (row == end)
            break;
        zs_small_turn(&w->sides);
    }
    zs_rows_counted(job, w->at[3], written);
}

#define SMALL small

#else

/* small() with registers of 64 bits: two words a pixel are stepped in place of three. */
ZS_ALWAYS_INLINE void small64(struct zs_job *job, const struct zs_texture *t,
                              struct zs_texel_rows *w, zs_read_fn *read, int lit)
{
    const uintptr_t beside = (uintptr_t)job->color - (uintptr_t)job->depth,
                    pitch = w->sides.down[0];
    const void *const texel = t->texel;
    const uint16_t *const palette = t->palette;
    const uint64_t mask = w->mask;
    const uint8_t column = (uint8_t)w->column;
    uintptr_t row = first_of(job, &w->sides) + 2u;
    uintptr_t end = row + rows_to(&w->sides, w->sides.mid) * pitch;
    const uintptr_t last = row + rows_to(&w->sides, w->sides.end) * pitch;
    int32_t written = 0;
    w->tested = 0;
    for (;;) {
        for (; row != end; row += pitch) {
            ZS_FORGET;
            const uint32_t left = w->sides.sum[0], right = w->sides.sum[1];
            const uint64_t right0 = w->right[0], right1 = w->right[1];
            uint64_t uk = w->at[0], v = w->at[1];
            uint32_t light = lit ? w->light : 0u;
            const uint32_t x0 = left / w->sides.side[0], x1 = right / w->sides.side[2];
            w->sides.sum[0] = left + w->sides.side[1];
            ZS_FORGET;
            w->sides.sum[1] = right + w->sides.side[3];
            w->at[0] = uk + w->down[0];
            w->at[1] = v + w->down[1];
            if (lit)
                w->light = light + w->light_down;
            if (x0 >= x1)
                continue;
            w->tested += x1 - x0;
            ZS_FORGET;
            uk += right0 * x0;
            v += right1 * x0;
            if (lit)
                light += w->light_right * x0;
            uint16_t *depth = (uint16_t *)row + x0, *const stop = (uint16_t *)row + x1;
            do {
                const uint16_t key = (uint16_t)((uint32_t)uk >> 16);
                if (key < *depth) {
                    *depth = key;
                    uint32_t c = read(texel, palette, (v >> 32 & mask) + (uk >> column));
                    if (lit)
                        c = zs_texture_shine(c, light >> ZS_TEXTURE_LIGHT_SHIFT);
                    *(uint16_t *)((uintptr_t)depth + beside) = zs_wire16((uint16_t)c);
                    if (ZS_STATS)
                        written++;
                }
                uk += right0;
                v += right1;
                if (lit)
                    light += w->light_right;
            } while (++depth != stop);
        }
        end = last;
        if (row == end)
            break;
        zs_small_turn(&w->sides);
    }
    zs_rows_counted(job, w->tested, written);
}
#define SMALL small64

#endif

/* The loops of one format. */
#define TEXEL(name)                                                                                \
    static void gather_##name(const struct zs_texture *t, uint16_t *out, int32_t n,                \
                              const uint32_t *at)                                                  \
    {                                                                                              \
        gather(t, out, n, at, zs_read_##name);                                                     \
    }                                                                                              \
    ZS_IN_ORDER static void rows_##name(struct zs_job *job)                                        \
    {                                                                                              \
        rows(job, zs_read_##name);                                                                 \
    }                                                                                              \
    __attribute__((unused)) static void small_##name(                                              \
        struct zs_job *job, const struct zs_texture *t, struct zs_texel_rows *w)                   \
    {                                                                                              \
        SMALL(job, t, w, zs_read_##name, 0);                                                       \
    }                                                                                              \
    ZS_IN_ORDER static void small_lit_##name(struct zs_job *job, const struct zs_texture *t,       \
                                             struct zs_texel_rows *w)                              \
    {                                                                                              \
        SMALL(job, t, w, zs_read_##name, 1);                                                       \
    }                                                                                              \
    static const struct zs_fast_texel texel_##name = { .gather = gather_##name,                    \
                                                       .rows = rows_##name,                        \
                                                       .small = ZS_DIVIDES && !ZS_V7M              \
                                                                    ? small_##name                 \
                                                                    : 0,                           \
                                                       .small_lit = ZS_DIVIDES ? small_lit_##name  \
                                                                               : 0 };              \
    const struct zs_fast zs_fast_##name = { .format = &zs_texel_##name, .texel = &texel_##name };

TEXEL(565)
TEXEL(pal8)
TEXEL(pal4)
