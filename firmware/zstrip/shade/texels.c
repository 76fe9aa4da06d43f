/* Texel formats: the innermost loops of textured shading, three each: a run of texels, texels by their
 * numbers, and the rows of a triangle that is affine, unlit and repeated, with their depth test.
 *
 * u and v are fractions of the texture in 32 bits: their top log2 bits are column and row, and repeating is
 * what unsigned sums do.
 *
 * SPDX-License-Identifier: MIT
 */
#include "shade/texture.h"
#include "fast/small.h"

/* A texel's value from its number, row * width + column. */
typedef uint16_t read_fn(const void *texel, const uint16_t *palette, uint32_t at);

ZS_ALWAYS_INLINE uint16_t read_565(const void *texel, const uint16_t *palette, uint32_t at)
{
    (void)palette;
    return ((const uint16_t *)texel)[at];
}

ZS_ALWAYS_INLINE uint16_t read_pal8(const void *texel, const uint16_t *palette, uint32_t at)
{
    return palette[((const uint8_t *)texel)[at]];
}

ZS_ALWAYS_INLINE uint16_t read_pal4(const void *texel, const uint16_t *palette, uint32_t at)
{
    const uint32_t two = ((const uint8_t *)texel)[at >> 1];
    return palette[two >> ((at & 1u) << 2) & 15u];
}

ZS_KERNEL_INLINE void fetch(const struct zs_texture *t, uint16_t *out, int32_t n, const struct zs_walk *walk,
                            read_fn *read)
{
    const void *texel = t->texel;
    const uint16_t *palette = t->palette;
    const uint32_t right = zs_texture_cut(t->log2_w), down = zs_texture_cut(t->log2_h), row = t->log2_w;
    uint32_t du = walk->du, dv = walk->dv, u = walk->u, v = walk->v;
    for (uint16_t *end = out + n; out != end; out++, u += du, v += dv) {
        ZS_HIGH_REGISTER(du);
        ZS_HIGH_REGISTER(dv);
        ZS_HIGH_REGISTER(end);
        *out = zs_wire16(read(texel, palette, ((v >> down) << row) + (u >> right)));
    }
}

#if !ZS_LEAN

ZS_ALWAYS_INLINE void gather(const struct zs_texture *t, uint16_t *out, int32_t n, const uint32_t *at, read_fn *read)
{
    const void *texel = t->texel;
    const uint16_t *palette = t->palette;
    for (uint16_t *const end = out + n; out != end; out++, at++)
        *out = zs_wire16(read(texel, palette, *at));
}

ZS_ALWAYS_INLINE void rows(struct zs_job *job, read_fn *read)
{
    const struct zs_texture *t = job->sampler.texture;
    const void *texel = t->texel;
    const uint16_t *palette = t->palette;
    const uint32_t right = 32u - t->log2_w, down = 32u - t->log2_h, log2_w = t->log2_w;
    const uintptr_t beside = (uintptr_t)job->color - (uintptr_t)job->depth; /* from a depth to its colour */
    uint32_t gx = job->key.gx, du = job->c[0].gx, dv = job->c[1].gx, tested = 0;
    int32_t written = 0, y = job->row;
    zs_plane_origin(&job->geom, &job->key);
    uint16_t *row = job->depth + (y - job->y0) * job->width;
    for (;;) {
        for (const struct zs_cut *cut = job->cut; y < job->cut_end; cut++, y++, row += job->width) {
            const int32_t i0 = zs_max32(cut->x0, 0), n = zs_min32(cut->x1, job->width) - i0;
            if (n <= 0)
                continue;
            uint32_t sum = zs_plane_at(&job->key, i0, y), u = zs_plane_at(&job->c[0], i0, y), v = zs_plane_at(&job->c[1], i0, y);
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
                    *(uint16_t *)((uintptr_t)depth + beside) = zs_wire16(read(texel, palette, ((v >> down) << log2_w) + (u >> right)));
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
        zs_raster_cuts(job, y);
    }
    job->r->stats.pixels_tested += tested;
    zs_rows_written(job, written);
}

#if ZS_DIVIDES

#define ZS_WORD(field) ((int)(offsetof(struct zs_texel_rows, field) / 4u))

/* Rows of a small triangle. What goes from row to row lies in its record: pixels take all registers. */
ZS_ALWAYS_INLINE void small(struct zs_job *job, const struct zs_texture *t, struct zs_texel_rows *w, read_fn *read, int lit)
{
    const uintptr_t beside = (uintptr_t)job->color - (uintptr_t)job->depth; /* from a depth to its colour */
    const uint32_t pitch = w->sides.down[0];
    const void *const texel = t->texel;
    const uint16_t *const palette = t->palette;
    uintptr_t row = (uintptr_t)job->depth + (uint32_t)(w->sides.row - job->y0) * pitch + w->sides.left;
    uintptr_t end = row + (uint32_t)(w->sides.mid - w->sides.row) * pitch;
    const uintptr_t last = row + (uint32_t)(w->sides.end - w->sides.row) * pitch;
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
    job->r->stats.pixels_tested += w->at[3];
    zs_rows_written(job, written);
}

#endif
#endif

static void fetch_565(const struct zs_texture *t, uint16_t *out, int32_t n, const struct zs_walk *walk)
{
    fetch(t, out, n, walk, read_565);
}

static void fetch_pal8(const struct zs_texture *t, uint16_t *out, int32_t n, const struct zs_walk *walk)
{
    fetch(t, out, n, walk, read_pal8);
}

static void fetch_pal4(const struct zs_texture *t, uint16_t *out, int32_t n, const struct zs_walk *walk)
{
    fetch(t, out, n, walk, read_pal4);
}

#if ZS_LEAN

const struct zs_texel zs_texel_565 = { fetch_565, 0, 0 };
const struct zs_texel zs_texel_pal8 = { fetch_pal8, 256, 0 };
const struct zs_texel zs_texel_pal4 = { fetch_pal4, 16, 1 };

#else

#if ZS_DIVIDES
#define SMALL(name, read, lit)                                                                                   \
    static void name(struct zs_job *job, const struct zs_texture *t, struct zs_texel_rows *rows)                 \
    {                                                                                                            \
        small(job, t, rows, read, lit);                                                                          \
    }
#else
#define SMALL(name, read, lit) enum { name = 0 };
#endif

static void gather_565(const struct zs_texture *t, uint16_t *out, int32_t n, const uint32_t *at)
{
    gather(t, out, n, at, read_565);
}

ZS_IN_ORDER static void rows_565(struct zs_job *job)
{
    rows(job, read_565);
}

SMALL(small_565, read_565, 0)
SMALL(small_lit_565, read_565, 1)

static void gather_pal8(const struct zs_texture *t, uint16_t *out, int32_t n, const uint32_t *at)
{
    gather(t, out, n, at, read_pal8);
}

ZS_IN_ORDER static void rows_pal8(struct zs_job *job)
{
    rows(job, read_pal8);
}

SMALL(small_pal8, read_pal8, 0)
SMALL(small_lit_pal8, read_pal8, 1)

static void gather_pal4(const struct zs_texture *t, uint16_t *out, int32_t n, const uint32_t *at)
{
    gather(t, out, n, at, read_pal4);
}

ZS_IN_ORDER static void rows_pal4(struct zs_job *job)
{
    rows(job, read_pal4);
}

SMALL(small_pal4, read_pal4, 0)
SMALL(small_lit_pal4, read_pal4, 1)

const struct zs_texel zs_texel_565 = { fetch_565, gather_565, rows_565, small_565, small_lit_565, 0, 0 };
const struct zs_texel zs_texel_pal8 = { fetch_pal8, gather_pal8, rows_pal8, small_pal8, small_lit_pal8, 256, 0 };
const struct zs_texel zs_texel_pal4 = { fetch_pal4, gather_pal4, rows_pal4, small_pal4, small_lit_pal4, 16, 1 };

#endif
