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
 * Where pixels are divided one by one, the accelerator zs_fast.divided finds the places of up to 16
 * of them, to 1/32 texel, and gathers: 52 a pixel here. A room of such textures takes 48 % less, a
 * ball of 1,012 triangles 27 %, on the M3 as on the M0; 1,100 bytes.
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

/* u and v: 1/32 of the cell. */
ZS_ALWAYS_INLINE uint16_t cell_color(const struct cell *c, uint32_t u, uint32_t v)
{
    const uint32_t up = mixed(c->up, c->up_change, u);
    const uint32_t low = mixed(c->low, c->low_change, u);
    return packed(mixed((up << 5) + HALVES, low - up, v));
}

/* ---- Coordinates ----------------------------------------------------------------------------- */

/* Textures that are clamped are so in coordinates that count from the first middle: what lies
 * between a border and the first or last middle has that texel's colour either way. */

/* One coordinate of a run. */
struct axis {
    uint32_t at, step; /* uq0_32 of the texture's size */
    uint32_t cells;    /* uq0_32: |step| in cells; UINT32_MAX: one or more */
    uint32_t rcp;      /* 2^20 / cells, rounded down */
    uint32_t log2;     /* of the texels */
    uint32_t back;     /* of a step < 0: all ones */
    uint32_t hold;     /* of a texture that is clamped: all ones */
};

ZS_ALWAYS_INLINE void axis_begin(struct axis *a, uint32_t at, uint32_t step, uint32_t fine,
                                 uint32_t clamp, int32_t n)
{
    const uint32_t log2 = fine - ZS_BILINEAR_LOG2;
    a->at = at;
    a->step = step;
    a->log2 = log2;
    a->hold = clamp ? UINT32_MAX : 0u;
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

/* ---- Loops ----------------------------------------------------------------------------------- */

#define STAYS 2u /* pixels in a cell from which on its texels are unpacked once for all of them */

/* A texture that repeats: pixels that leave their cell soon. */
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
        *out = cell_color(&c, u << row >> 27, v << below >> 27);
    }
}

ZS_ALWAYS_INLINE void cell_pixels(const struct cell *cell, uint16_t *out, uint16_t *end, uint32_t u,
                                  uint32_t v, uint32_t du, uint32_t dv)
{
    const struct cell c = *cell;
    do {
        *out = cell_color(&c, u >> 27, v >> 27);
        u += du;
        v += dv;
    } while (++out != end);
}

/* A texture larger than a texel each way. */
struct grid {
    const void *texel;
    const uint16_t *palette;
    uint32_t row, below;    /* log2 of the width and height */
    uint32_t columns, all;  /* texels in a row, and in the texture, less 1 */
    uint32_t hold, hold_up; /* of a texture that is clamped: all ones */
};

ZS_ALWAYS_INLINE struct grid grid_of(const struct zs_texture *t)
{
    const uint32_t row = t->log2_w - ZS_BILINEAR_LOG2, below = t->log2_h - ZS_BILINEAR_LOG2;
    return (struct grid){ .texel = t->texel,
                          .palette = t->palette,
                          .row = row,
                          .below = below,
                          .columns = (1u << row) - 1u,
                          .all = (1u << (row + below)) - 1u,
                          .hold = 0u - (t->clamp & ZS_CLAMP_U),
                          .hold_up = 0u - (uint32_t)(t->clamp >> 1) };
}

/* Find the four texels of a cell, whose upper left one is column x of the row that begins at
 * `up`. */
ZS_ALWAYS_INLINE struct cell grid_cell(const struct grid *g, uint32_t x, uint32_t up,
                                       zs_read_fn *read)
{
    uint32_t x1 = (x + 1u) & g->columns, low = (up + g->columns + 1u) & g->all;
    if (!x1) /* beyond the last middle */
        x1 = x & g->hold;
    if (!low)
        low = up & g->hold_up;
    return cell_of(read(g->texel, g->palette, up + x), read(g->texel, g->palette, up + x1),
                   read(g->texel, g->palette, low + x), read(g->texel, g->palette, low + x1));
}

/* Pixels that stay. */
ZS_KERNEL_INLINE void run_stays(const struct zs_texture *t, uint16_t *out, int32_t n,
                                const struct axis *a, const struct axis *b, zs_read_fn *read)
{
    const struct grid g = grid_of(t);
    const uint32_t right = 32u - g.row, down = 32u - g.below;
    uint32_t u = a->at, v = b->at;
    while (n > 0) {
        const uint32_t columns = axis_stays(a, u), rows = axis_stays(b, v);
        const uint32_t in = zs_minu32(zs_minu32(columns, rows), (uint32_t)n);
        const struct cell c = grid_cell(&g, u >> right, v >> down << g.row, read);
        cell_pixels(&c, out, out + in, u << g.row, v << g.below, a->step << g.row,
                    b->step << g.below);
        u += a->step * in;
        v += b->step * in;
        out += in;
        n -= (int32_t)in;
    }
}

/* Pixels whose places are at[], row * width + column of a texture with 2^ZS_BILINEAR_LOG2 times as
 * many each way. */
ZS_KERNEL_INLINE void run_places(const struct zs_texture *t, uint16_t *out, int32_t n,
                                 const uint32_t *at, zs_read_fn *read)
{
    const struct grid g = grid_of(t);
    const uint32_t v_from = t->log2_w, row_from = v_from + ZS_BILINEAR_LOG2;
    for (const uint32_t *const end = at + n; at != end; at++, out++) {
        const uint32_t place = *at;
        const struct cell c = grid_cell(&g, place >> ZS_BILINEAR_LOG2 & g.columns,
                                        place >> row_from << g.row, read);
        *out = cell_color(&c, place & 31u, place >> v_from & 31u);
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
    }                                                                                              \
    ZS_IN_ORDER static ZS_NOINLINE void places_##name(const struct zs_texture *t, uint16_t *out,   \
                                                      int32_t n, const uint32_t *at)               \
    {                                                                                              \
        run_places(t, out, n, at, zs_read_##name);                                                 \
    }

LOOPS(565)
LOOPS(pal8)
LOOPS(pal4)

/* Find the two texels of a cell. */
static inline void axis_texels(const struct axis *a, uint32_t x[2])
{
    const uint32_t mask = (1u << a->log2) - 1u;
    x[0] = a->at >> zs_texture_cut(a->log2) & mask;
    x[1] = (x[0] + 1u) & mask;
    if (x[1] == 0)
        x[1] = x[0] & a->hold;
}

/* Any format, of any size. */
static ZS_NOINLINE void run_any(const struct zs_texture *t, const struct zs_texel *format,
                                uint16_t *out, int32_t n, struct axis *a, struct axis *b)
{
    struct zs_texture texels = *t;
    texels.log2_w = (uint8_t)a->log2;
    texels.log2_h = (uint8_t)b->log2;
    while (n > 0) {
        uint32_t x[2], y[2];
        uint16_t c[4];
        const uint32_t right = zs_texture_cut(a->log2), down = zs_texture_cut(b->log2);
        const uint32_t columns = axis_stays(a, a->at), rows = axis_stays(b, b->at);
        const uint32_t in = zs_minu32(zs_minu32(columns, rows), (uint32_t)n);
        axis_texels(a, x);
        axis_texels(b, y);
        for (int k = 0; k < 2; k++) {
            const struct zs_walk walk = { x[0] << right, y[k] << down, (x[1] - x[0]) << right, 0 };
            format->own(&texels, c + 2 * k, 2, &walk);
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

/* Return 1 if the loops above read a texture: larger than a texel each way, colours of 16 bits or a
 * palette's. */
static int has_loops(const struct zs_texture *t, const struct zs_texel *format)
{
    return format->log2_bits && !(format->log2_bits == 4 && format->both) &&
           t->log2_w > ZS_BILINEAR_LOG2 && t->log2_h > ZS_BILINEAR_LOG2;
}

static void fetch_bilinear(const struct zs_texture *t, uint16_t *out, int32_t n,
                           const struct zs_walk *walk)
{
    const struct zs_texel *const format = zs_texture_behind(t)->format;
    struct axis a, b;
    axis_begin(&a, walk->u, walk->du, t->log2_w, t->clamp & ZS_CLAMP_U, n);
    axis_begin(&b, walk->v, walk->dv, t->log2_h, t->clamp & ZS_CLAMP_V, n);
    const int soon = !t->clamp && (n == 1 || a.cells > UINT32_MAX / STAYS ||
                                   b.cells > UINT32_MAX / STAYS);
    if (!has_loops(t, format))
        run_any(t, format, out, n, &a, &b);
    else if (format->log2_bits == 4)
        soon ? soon_565(t, out, n, &a, &b) : stays_565(t, out, n, &a, &b);
    else if (format->log2_bits == 3)
        soon ? soon_pal8(t, out, n, &a, &b) : stays_pal8(t, out, n, &a, &b);
    else
        soon ? soon_pal4(t, out, n, &a, &b) : stays_pal4(t, out, n, &a, &b);
}

static void gather_bilinear(const struct zs_texture *t, uint16_t *out, int32_t n,
                            const uint32_t *at)
{
    const struct zs_texel *const format = zs_texture_behind(t)->format;
    if (!has_loops(t, format)) {
        for (const uint32_t *const end = at + n; at != end; at++, out++) {
            const struct zs_walk walk = { *at << (32u - t->log2_w),
                                          *at >> t->log2_w << (32u - t->log2_h), 0, 0 };
            fetch_bilinear(t, out, 1, &walk);
        }
    } else if (format->log2_bits == 4) {
        places_565(t, out, n, at);
    } else if (format->log2_bits == 3) {
        places_pal8(t, out, n, at);
    } else {
        places_pal4(t, out, n, at);
    }
}

const struct zs_texel zs_filter_bilinear = { .fetch = fetch_bilinear,
                                             .gather = ZS_IF_FAST(gather_bilinear) };

/* ---- Shaders --------------------------------------------------------------------------------- */

void zs_bilinear_begin(struct zs_job *job)
{
    struct zs_texture *const t = zs_texture_instead(job);
    const int32_t bias = 1 << (32u - ZS_TEXTURE_BIAS_LOG2);
    zs_coordinate_less(job, 0, zs_bilinear_first(t->log2_w) + (bias >> t->log2_w));
    zs_coordinate_less(job, 1, zs_bilinear_first(t->log2_h) + (bias >> t->log2_h));
    t->log2_w = (uint8_t)(t->log2_w + ZS_BILINEAR_LOG2);
    t->log2_h = (uint8_t)(t->log2_h + ZS_BILINEAR_LOG2);
    t->format = &zs_filter_bilinear;
    job->gather = ZS_IF_FAST(gather_bilinear);
}

static void bilinear_start(struct zs_job *job)
{
    zs_texture_start(job);
    zs_bilinear_begin(job);
}

ZS_FILTER_SHADERS(bilinear, bilinear_start, zs_texture_run, zs_texture_usable,
                  zs_texture_lit_usable, .opaque = 1);
const struct zs_filter_kind zs_filter_linear = { .instead = zs_bilinear_begin,
                                                 .run = zs_filtered_run };
