/* Bilinear filtering.
 *
 * A cell is the square between the middles of four texels. In it, the two upper texels are mixed by
 * u, the two lower ones too, and these two by v. The channels of a texel lie in one word, with room
 * above each for weights of 5 bits: green in bits 21 .. 26, red in 11 .. 15, blue in 0 .. 4. Fields
 * do not meet: a difference of words times a weight is exact modulo 2^32, and the true sum of a
 * field is a mean, weights 0 .. 32, plus a half: below 2^11 for green, 2^10 for red and blue.
 *
 * u and v are rounded to 1/32 texel, which moves a coordinate by at most 1/64 texel. There, each of
 * two roundings is a half of a code: at most one code of RGB565 is lost.
 *
 * Texels are unpacked once for each cell that a run crosses, if it stays there for some pixels.
 * All ways compute the same. In a cell a pixel takes 17 instructions on a Cortex-M3, of which 15
 * are the least: two weights, three products and three masks, a difference and a shift with a sum,
 * three to pack and store, two steps. To unpack a cell takes 85 more; where each pixel has its own,
 * 54 in all. Of these 45 are the least: 10 for two rows and two columns, 4 loads, 12 to unpack, 17
 * as above, 2 of the loop. 7 more load what 13 registers do not hold beside texels and sums: both
 * steps, three shifts or sizes each way, the end. The other 2 are sums that a pointer for each row
 * would save, which is slower on a Cortex-M0.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/fx.h"
#include "effect/filter.h"
#include "shade/texels.h"
#include "zs_filter.h"

#define FIELDS 0x07e0f81fu                     /* green, red, blue */
#define HALVES (1u << 25 | 1u << 15 | 1u << 4) /* a half, where fields have 5 fraction bits */

/* ---- Colours --------------------------------------------------------------------------------- */

/* Move the channels of an RGB565 value into their fields. */
ZS_ALWAYS_INLINE uint32_t spread(uint32_t c)
{
    return (c | c << 16) & FIELDS;
}

/* Mix two colours, a + (b - a) f / 32, rounded, where start is 32 a + HALVES. */
ZS_ALWAYS_INLINE uint32_t mixed(uint32_t start, uint32_t change, uint32_t f)
{
    return (start + change * f) >> 5 & FIELDS;
}

ZS_ALWAYS_INLINE uint16_t packed(uint32_t c)
{
    c |= c >> 16;
    ZS_ANEW(c); /* one instruction swaps the bytes */
    return zs_wire16((uint16_t)c);
}

/* Four texels of a cell as the loop takes them: of two rows, where to start and the change. */
struct cell {
    uint32_t up, up_change, low, low_change;
};

ZS_ALWAYS_INLINE struct cell cell_of(uint32_t up0, uint32_t up1, uint32_t low0, uint32_t low1)
{
    const uint32_t up = spread(up0), low = spread(low0);
    return (struct cell){ (up << 5) + HALVES, spread(up1) - up, (low << 5) + HALVES,
                          spread(low1) - low };
}

/* u and v: uq0_32 of the cell. */
ZS_ALWAYS_INLINE uint16_t cell_color(const struct cell *c, uint32_t u, uint32_t v)
{
    const uint32_t up = mixed(c->up, c->up_change, u >> 27);
    const uint32_t low = mixed(c->low, c->low_change, u >> 27);
    return packed(mixed((up << 5) + HALVES, low - up, v >> 27));
}

/* ---- Coordinates ----------------------------------------------------------------------------- */

/* One coordinate of a run. */
struct axis {
    uint32_t at, step; /* uq0_32 of the texture's size; at 0 is the first texel's middle, rounded */
    uint32_t first;    /* what is subtracted to have it so */
    uint32_t cells;    /* uq0_32: |step| in cells; UINT32_MAX: one or more */
    uint32_t rcp;      /* 2^20 / cells, rounded down */
    uint32_t log2;     /* of the texels */
    uint32_t back;     /* of a step < 0: all ones */
};

ZS_ALWAYS_INLINE void axis_begin(struct axis *a, uint32_t at, uint32_t step, uint32_t log2,
                                 uint32_t log2_whole, int32_t n)
{
    /* half a texel and the bias, less 1/64 texel to round */
    a->first = (1u << (31u - log2)) - (1u << (26u - log2)) +
               (1u << (32u - ZS_TEXTURE_BIAS_LOG2 - log2_whole));
    a->at = at - a->first;
    a->step = step;
    a->log2 = log2;
    a->rcp = a->back = 0;
    if (n == 1) /* the pixel is in its cell, whatever the step */
        return;
    const uint32_t size = zs_size32((int32_t)step);
    a->back = (uint32_t)((int32_t)step >> 31);
    a->cells = log2 && size >> (32u - log2) ? UINT32_MAX : size << log2;
    a->rcp = UINT32_MAX / ((a->cells >> 12) + 1u);
}

/* Return a number of pixels that are in the cell of `at`, at least 1. */
ZS_ALWAYS_INLINE uint32_t axis_stays(const struct axis *a, uint32_t at)
{
    const uint32_t left = ~(at << a->log2 ^ a->back);
    return zs_umulh(left >> 12, a->rcp) + 1u; /* <= left / cells + 1 */
}

/* Return 1 if n pixels from `at` on, in one cell, lie at both borders of a texture that is clamped:
 * a step that is nearly the whole of it goes from one border to the other. */
static ZS_NOINLINE int axis_jumps(const struct axis *a, int clamp, uint32_t n)
{
    const uint32_t at = a->at + a->first;
    return clamp && (at < a->first) != (at + a->step * (n - 1u) < a->first);
}

/* Find the two texels of a cell. */
static inline void axis_texels(const struct axis *a, int clamp, uint32_t x[2])
{
    const uint32_t mask = (1u << a->log2) - 1u;
    x[0] = a->at >> zs_texture_cut(a->log2) & mask;
    x[1] = (x[0] + 1u) & mask;
    if (clamp && x[1] == 0) { /* beyond the last middle, or before the first */
        if (a->at + a->first < a->first)
            x[0] = 0;
        else
            x[1] = x[0];
    }
}

/* ---- Loops ----------------------------------------------------------------------------------- */

#define STAYS 2u /* pixels in a cell from which on its texels are unpacked once for all of them */

/* A texture that repeats, larger than a texel each way: pixels that leave their cell soon. */
ZS_KERNEL_INLINE void run_soon(const struct zs_texture *t, uint16_t *out, int32_t n,
                               const struct axis *a, const struct axis *b, zs_read_fn *read)
{
    const void *const texel = t->texel;
    const uint16_t *const palette = t->palette;
    const uint32_t right = 32u - a->log2, down = 32u - b->log2, row = a->log2, below = b->log2;
    const uint32_t one = 1u << right, one_down = 1u << down, du = a->step, dv = b->step;
    uint32_t u = a->at, v = b->at;
    for (uint16_t *const end = out + n; out != end; out++, u += du, v += dv) {
        const uint32_t up = v >> down << row, low = (v + one_down) >> down << row;
        const uint32_t x0 = u >> right, x1 = (u + one) >> right;
        const struct cell c = cell_of(read(texel, palette, up + x0), read(texel, palette, up + x1),
                                      read(texel, palette, low + x0),
                                      read(texel, palette, low + x1));
        *out = cell_color(&c, u << row, v << below);
    }
}

ZS_ALWAYS_INLINE void cell_pixels(const struct cell *cell, uint16_t *out, uint16_t *end, uint32_t u,
                                  uint32_t v, uint32_t du, uint32_t dv)
{
    const struct cell c = *cell;
    do {
        *out = cell_color(&c, u, v);
        u += du;
        v += dv;
    } while (++out != end);
}

/* The same for pixels that stay. */
ZS_KERNEL_INLINE void run_stays(const struct zs_texture *t, uint16_t *out, int32_t n,
                                const struct axis *a, const struct axis *b, zs_read_fn *read)
{
    const void *const texel = t->texel;
    const uint16_t *const palette = t->palette;
    const uint32_t right = 32u - a->log2, down = 32u - b->log2, row = a->log2, below = b->log2;
    uint32_t u = a->at, v = b->at;
    while (n > 0) {
        const uint32_t columns = axis_stays(a, u), rows = axis_stays(b, v);
        const uint32_t in = zs_minu32(zs_minu32(columns, rows), (uint32_t)n);
        const uint32_t up = v >> down << row, low = (v + (1u << down)) >> down << row;
        const uint32_t x0 = u >> right, x1 = (u + (1u << right)) >> right;
        const struct cell c = cell_of(read(texel, palette, up + x0), read(texel, palette, up + x1),
                                      read(texel, palette, low + x0),
                                      read(texel, palette, low + x1));
        cell_pixels(&c, out, out + in, u << row, v << below, a->step << row, b->step << below);
        u += a->step * in;
        v += b->step * in;
        out += in;
        n -= (int32_t)in;
    }
}

#define LOOPS(name)                                                                                \
    ZS_IN_ORDER static ZS_NOINLINE void soon_##name(const struct zs_texture *t, uint16_t *out,     \
                                                    int32_t n, const struct axis *a,               \
                                                    const struct axis *b)                          \
    {                                                                                              \
        run_soon(t, out, n, a, b, zs_read_##name);                                                 \
    }                                                                                              \
    ZS_IN_ORDER static ZS_NOINLINE void stays_##name(const struct zs_texture *t, uint16_t *out,    \
                                                     int32_t n, const struct axis *a,              \
                                                     const struct axis *b)                         \
    {                                                                                              \
        run_stays(t, out, n, a, b, zs_read_##name);                                                \
    }

LOOPS(565)
LOOPS(pal8)
LOOPS(pal4)

/* Any format, clamped or not, of any size. */
static ZS_NOINLINE void run_any(const struct zs_texture *t, const struct zs_texel *format,
                                uint16_t *out, int32_t n, struct axis *a, struct axis *b)
{
    while (n > 0) {
        uint32_t x[2], y[2];
        uint16_t c[4];
        const uint32_t right = zs_texture_cut(a->log2), down = zs_texture_cut(b->log2);
        const uint32_t columns = axis_stays(a, a->at), rows = axis_stays(b, b->at);
        uint32_t in = zs_minu32(zs_minu32(columns, rows), (uint32_t)n);
        if (axis_jumps(a, t->clamp & ZS_CLAMP_U, in) || axis_jumps(b, t->clamp & ZS_CLAMP_V, in))
            in = 1;
        axis_texels(a, t->clamp & ZS_CLAMP_U, x);
        axis_texels(b, t->clamp & ZS_CLAMP_V, y);
        for (int k = 0; k < 2; k++) {
            const struct zs_walk walk = { x[0] << right, y[k] << down, (x[1] - x[0]) << right, 0 };
            format->own(t, c + 2 * k, 2, &walk);
        }
        const struct cell cell = cell_of(zs_wire16(c[0]), zs_wire16(c[1]), zs_wire16(c[2]),
                                         zs_wire16(c[3]));
        cell_pixels(&cell, out, out + in, a->at << a->log2, b->at << b->log2, a->step << a->log2,
                    b->step << b->log2);
        a->at += a->step * in;
        b->at += b->step * in;
        out += in;
        n -= (int32_t)in;
    }
}

static void fetch_bilinear(const struct zs_texture *t, uint16_t *out, int32_t n,
                           const struct zs_walk *walk)
{
    const struct zs_texture *const whole = zs_texture_behind(t);
    const struct zs_texel *const format = whole->format;
    struct axis a, b;
    axis_begin(&a, walk->u, walk->du, t->log2_w, whole->log2_w, n);
    axis_begin(&b, walk->v, walk->dv, t->log2_h, whole->log2_h, n);
    const int soon = n == 1 || a.cells > UINT32_MAX / STAYS || b.cells > UINT32_MAX / STAYS;
    if (!format->log2_bits || (format->log2_bits == 4 && format->both) || t->clamp || !t->log2_w ||
        !t->log2_h)
        run_any(t, format, out, n, &a, &b);
    else if (format->log2_bits == 4)
        soon ? soon_565(t, out, n, &a, &b) : stays_565(t, out, n, &a, &b);
    else if (format->log2_bits == 3)
        soon ? soon_pal8(t, out, n, &a, &b) : stays_pal8(t, out, n, &a, &b);
    else
        soon ? soon_pal4(t, out, n, &a, &b) : stays_pal4(t, out, n, &a, &b);
}

const struct zs_texel zs_filter_bilinear = { .fetch = fetch_bilinear };

static void instead(struct zs_job *job)
{
    zs_texture_instead(job)->format = &zs_filter_bilinear;
}

static void bilinear_start(struct zs_job *job)
{
    zs_texture_start(job);
    instead(job);
}

ZS_FILTER_SHADERS(bilinear, bilinear_start, zs_texture_run, zs_texture_usable,
                  zs_texture_lit_usable, .opaque = 1);
const struct zs_filter_kind zs_filter_linear = { .instead = instead, .run = zs_filtered_run };
