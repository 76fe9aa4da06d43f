/* Bilinear filtering.
 *
 * A cell is the square between the middles of four texels. In it, a channel is a + b u + c v +
 * d u v, with u and v from 0 to 1. What depends on the texels alone is computed once for each cell
 * that a run crosses: a, b, c, d of red and blue in one word each, of green in another. Fields of a
 * word do not meet: sums are exact modulo 2^32, and the true sum of a field is the mean of four
 * texels, with weights that are not negative, so that it fits.
 *
 * Weights have 11 bits. u, v and u v are truncated, which is at most 2^-11 of a texel for each, and
 * 2^-11 for d: together (63 + 63 + 126) / 2048 = 0.13 codes of green. Rounding adds a half.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/fx.h"
#include "effect/filter.h"
#include "zs_filter.h"

#define WEIGHT_BITS 11u

/* One coordinate of a run. */
struct axis {
    uint32_t at, step;   /* uq0_32 of the texture's size; at 0 is the first texel's middle */
    uint32_t first;      /* what is subtracted to have it so: half a texel, and the bias */
    uint32_t rcp;        /* 2^32 / |step in cells|; 0: each pixel has a cell of its own */
    uint32_t log2, mask; /* of the texels */
    uint8_t back, clamp; /* 1: step < 0; 1: clamped */
};

static void axis_begin(struct axis *a, uint32_t at, uint32_t step, uint32_t log2,
                       uint32_t log2_whole, int clamp, int32_t n)
{
    const uint32_t size = zs_size32((int32_t)step);
    a->first = (1u << (31u - log2)) + (1u << (32u - ZS_TEXTURE_BIAS_LOG2 - log2_whole));
    a->at = at - a->first;
    a->step = step;
    a->log2 = log2;
    a->mask = (1u << log2) - 1u;
    a->back = (int32_t)step < 0;
    a->clamp = (uint8_t)clamp;
    a->rcp = n == 1 || (log2 && size >> (32u - log2)) ? 0u
             : size                                   ? UINT32_MAX / (size << log2)
                                                      : UINT32_MAX;
}

/* Find the two texels of the cell, and return a number of pixels that are in it, at least 1. */
static uint32_t axis_cell(const struct axis *a, uint32_t x[2])
{
    const uint32_t in = a->at << a->log2, left = a->back ? in : ~in;
    x[0] = a->at >> zs_texture_cut(a->log2) & a->mask;
    x[1] = (x[0] + 1u) & a->mask;
    if (a->clamp && x[1] == 0) { /* beyond the last middle, or before the first */
        if (a->at + a->first < a->first)
            x[0] = 0;
        else
            x[1] = x[0];
    }
    return zs_umulh(left, a->rcp) + 1u; /* <= left / |step| + 1 */
}

/* Channels of an RGB565 value, with the room that sums need. */
ZS_ALWAYS_INLINE uint32_t red_blue(uint32_t c)
{
    return (c & 0xf800u) << 5 | (c & 31u);
}

ZS_ALWAYS_INLINE uint32_t green(uint32_t c)
{
    return c >> 5 & 63u;
}

/* a, b, c, d of a cell, from its texels: two of the upper row, two of the lower one. */
struct cell {
    uint32_t rb[4], g[4]; /* [0] has WEIGHT_BITS fraction bits, and a half added */
};

ZS_ALWAYS_INLINE void cell_of(struct cell *cell, uint32_t c00, uint32_t c01, uint32_t c10,
                              uint32_t c11)
{
    const uint32_t rb = red_blue(c00), rb_right = red_blue(c01) - rb;
    const uint32_t g = green(c00), g_right = green(c01) - g;
    cell->rb[0] = (rb << WEIGHT_BITS) + 0x04000400u;
    cell->rb[1] = rb_right;
    cell->rb[2] = red_blue(c10) - rb;
    cell->rb[3] = red_blue(c11) - red_blue(c10) - rb_right;
    cell->g[0] = (g << WEIGHT_BITS) + 0x400u;
    cell->g[1] = g_right;
    cell->g[2] = green(c10) - g;
    cell->g[3] = green(c11) - green(c10) - g_right;
}

/* Colour n pixels of a cell. u and v are uq0_32 in it. */
ZS_IN_ORDER static ZS_NOINLINE void cell_run(const struct cell *cell, uint16_t *out, uint32_t n,
                                             uint32_t u, uint32_t v, uint32_t du, uint32_t dv)
{
    const uint32_t rb0 = cell->rb[0], rb1 = cell->rb[1], rb2 = cell->rb[2], rb3 = cell->rb[3];
    const uint32_t g0 = cell->g[0], g1 = cell->g[1], g2 = cell->g[2], g3 = cell->g[3];
    for (uint16_t *const end = out + n; out != end; out++) {
        const uint32_t fu = u >> (32u - WEIGHT_BITS), fv = v >> (32u - WEIGHT_BITS);
        const uint32_t both = fu * fv >> WEIGHT_BITS;
        uint32_t rb = rb0 + rb1 * fu, g = g0 + g1 * fu; /* 2 x 16 bits, 17 bits */
        ZS_ANEW(rb);                                    /* a product and a sum in one instruction */
        ZS_ANEW(g);
        rb += rb2 * fv;
        g += g2 * fv;
        ZS_ANEW(rb);
        ZS_ANEW(g);
        rb += rb3 * both;
        g += g3 * both;
        u += du;
        v += dv;
        uint32_t c = rb >> 27;
        ZS_ANEW(c);
        c = c << 6 | g >> WEIGHT_BITS;
        *out = zs_wire16((uint16_t)(c << 5 | (rb >> WEIGHT_BITS & 31u)));
    }
}

/* Set the cell from texels in any format. */
static ZS_NOINLINE void cell_fetch(struct cell *cell, const struct zs_texture *t,
                                   const struct zs_texel *format, const uint32_t x[2],
                                   const uint32_t y[2])
{
    const uint32_t right = zs_texture_cut(t->log2_w), down = zs_texture_cut(t->log2_h);
    uint16_t c[4];
    for (int k = 0; k < 2; k++) {
        const struct zs_walk walk = { x[0] << right, y[k] << down, (x[1] - x[0]) << right, 0 };
        format->fetch(t, c + 2 * k, 2, &walk);
    }
    cell_of(cell, zs_wire16(c[0]), zs_wire16(c[1]), zs_wire16(c[2]), zs_wire16(c[3]));
}

static void fetch_bilinear(const struct zs_texture *t, uint16_t *out, int32_t n,
                           const struct zs_walk *walk)
{
    const struct zs_texture *const whole = zs_texture_behind(t);
    const struct zs_texel *const format = whole->format;
    const int plain = format->log2_bits == 4 && !format->both; /* RGB565 */
    struct axis u, v;
    axis_begin(&u, walk->u, walk->du, t->log2_w, whole->log2_w, t->clamp & ZS_CLAMP_U, n);
    axis_begin(&v, walk->v, walk->dv, t->log2_h, whole->log2_h, t->clamp & ZS_CLAMP_V, n);
    while (n > 0) {
        struct cell cell;
        uint32_t x[2], y[2];
        const uint32_t columns = axis_cell(&u, x), rows = axis_cell(&v, y);
        const uint32_t in = zs_minu32(zs_minu32(columns, rows), (uint32_t)n);
        if (plain) {
            const uint16_t *const texel = t->texel;
            const uint16_t *const up = texel + (y[0] << u.log2), *const low = texel +
                                                                              (y[1] << u.log2);
            cell_of(&cell, up[x[0]], up[x[1]], low[x[0]], low[x[1]]);
        } else {
            cell_fetch(&cell, t, format, x, y);
        }
        cell_run(&cell, out, in, u.at << u.log2, v.at << v.log2, u.step << u.log2,
                 v.step << v.log2);
        u.at += u.step * in;
        v.at += v.step * in;
        out += in;
        n -= (int32_t)in;
    }
}

const struct zs_texel zs_filter_bilinear = { .fetch = fetch_bilinear };

static void bilinear_start(struct zs_job *job)
{
    zs_shade_texture.start(job);
    zs_texture_instead(job)->format = &zs_filter_bilinear;
}

ZS_FILTER_SHADERS(bilinear, bilinear_start, zs_texture_run, zs_filter_check, zs_filter_check_lit,
                  .opaque = 1);
