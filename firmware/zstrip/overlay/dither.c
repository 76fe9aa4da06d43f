/* Dithering of finished strips.
 *
 * The blue noise is made by Ulichney's void and cluster: a Gaussian of sigma 1.5 px around each
 * pixel on a torus of 16 x 16. From 26 pixels, of which the one in the tightest cluster is moved to
 * the largest void until that is where it came from, ranks go down by taking the tightest cluster
 * away, and up by filling the largest void.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/fx.h"
#include "zs_dither.h"

/* clang-format off */
static const uint8_t ordered[64] = {
     0, 32,  8, 40,  2, 34, 10, 42,
    48, 16, 56, 24, 50, 18, 58, 26,
    12, 44,  4, 36, 14, 46,  6, 38,
    60, 28, 52, 20, 62, 30, 54, 22,
     3, 35, 11, 43,  1, 33,  9, 41,
    51, 19, 59, 27, 49, 17, 57, 25,
    15, 47,  7, 39, 13, 45,  5, 37,
    63, 31, 55, 23, 61, 29, 53, 21
};

static const uint8_t blue[256] = {
     92,  42,  19, 120,  96, 205,  62, 216, 116,  74, 149,  28, 180, 140,  36,   3,
    132, 246, 202,  59, 176, 142,  27, 162, 237,  41, 208,  60, 244,  95, 230, 175,
     71, 106, 152,  82, 238,  46, 194, 103,  12,  93, 189, 130,   7, 163,  48, 214,
     13, 195,  31, 218,   0, 125,  78, 251, 178, 144, 227,  75, 112, 204,  87, 148,
    236,  52, 168, 137,  97, 228, 153,  58, 122,  23,  49, 169,  35, 250,  24, 123,
    181, 113, 253,  68, 165,  20, 207,  32, 221,  91, 239, 198, 131, 156, 192,  66,
     33,  88,  11, 200,  43, 183, 111,  73, 186, 159, 107,  10,  81,  51,  99, 222,
    157, 220, 124, 147, 233,  84, 135, 242,  15, 126,  61, 182, 231, 211,   5, 133,
     53, 177,  30, 100,  57,   6, 213, 150,  44, 203, 255,  29, 141, 115, 174, 247,
    109,  79, 210, 241, 167, 190, 104,  65, 172,  83, 101, 158,  69,  40,  90,  22,
    226, 188,   2,  67, 127,  34, 248,  18, 224, 138,   1, 209, 179, 240, 197, 154,
     37, 139, 117, 160, 206,  86, 146, 119, 185,  38, 235,  54, 118,  14, 129,  63,
    170,  89, 254,  47,  16, 232,  55, 219,  70, 164, 110, 151,  76, 215,  98, 234,
    199,  26, 217, 102, 196, 171, 108,  21,  94, 201,  25, 243, 187,  45, 145,  17,
    114,  56, 143,  72, 134,  39, 155, 191, 252,  50, 136,  85,   9, 166, 249,  77,
    223, 161, 184, 229,   8, 245,  80, 128,   4, 173, 225, 105, 212,  64, 121, 193
};
/* clang-format on */

const struct zs_dither_pattern zs_dither_ordered = { ordered, 3 };
const struct zs_dither_pattern zs_dither_blue = { blue, 4 };

void zs_dither_draw(void *ctx, const struct zs_target *t)
{
    const struct zs_dither *d = (const struct zs_dither *)ctx;
    if (!d->format || !d->pattern)
        return;
    const uint32_t log2 = d->pattern->log2, mask = (1u << log2) - 1u;
    const uint32_t n = (uint32_t)t->x1 - t->x0;
    for (uint32_t y = t->y0; n && y < t->y1; y++)
        d->format->run(t->color + (y - t->y0) * t->pitch + t->x0, n, t->x0,
                       d->pattern->rank + ((y & mask) << log2), mask, 15u - 2u * log2);
}

/* ---- Formats --------------------------------------------------------------------------------- */

/* A code times FACTOR(levels, most) is its level in 16 fraction bits, up to 2^-16 * most too high;
 * so full colour never falls below the highest level. With a threshold of at most 65408 / 65536 (a
 * pattern of 16 x 16), nothing reaches the level above that. */
#define FACTOR(parts, whole) (((parts)*65536u + (whole)-1u) / (whole))

typedef uint16_t pixel_fn(uint32_t color, uint32_t threshold);

ZS_KERNEL_INLINE void run(uint16_t *out, uint32_t n, uint32_t x, const uint8_t *rank, uint32_t mask,
                          uint32_t shift, pixel_fn *pixel)
{
    for (uint16_t *const end = out + n; out != end; out++, x++)
        *out = zs_wire16(pixel(zs_wire16(*out), (2u * rank[x & mask] + 1u) << shift));
}

ZS_ALWAYS_INLINE uint16_t rgb332(uint32_t c, uint32_t threshold)
{
    const uint32_t r = ((c >> 11) * FACTOR(7u, 31u) + threshold) >> 16; /* sums < 2^19 */
    const uint32_t g = ((c >> 5 & 63u) * FACTOR(7u, 63u) + threshold) >> 16;
    const uint32_t b = ((c & 31u) * FACTOR(3u, 31u) + threshold) >> 16;
    return (uint16_t)((r << 2 | r >> 1) << 11 | (g << 3 | g) << 5 | (b << 3 | b << 1 | b >> 1));
}

/* The grey of a colour in 16 fraction bits, `levels` at white and at most 77 / 65536 more. */
#define GREY(c, levels)                                                                            \
    (((c) >> 11) * FACTOR((levels)*77u, 256u * 31u) +                                              \
     ((c) >> 5 & 63u) * FACTOR((levels)*150u, 256u * 63u) +                                        \
     ((c)&31u) * FACTOR((levels)*29u, 256u * 31u))

ZS_ALWAYS_INLINE uint16_t grey4(uint32_t c, uint32_t threshold)
{
    const uint32_t level = (GREY(c, 15u) + threshold) >> 16; /* < 2^20; 0 .. 15 */
    const uint32_t code = level << 1 | level >> 3;
    return (uint16_t)(code << 11 | (level << 2 | level >> 2) << 5 | code);
}

ZS_ALWAYS_INLINE uint16_t mono(uint32_t c, uint32_t threshold)
{
    return (uint16_t)(0u - ((GREY(c, 1u) + threshold) >> 16));
}

#define FORMAT(name)                                                                               \
    static void name##_run(uint16_t *out, uint32_t n, uint32_t x, const uint8_t *rank,             \
                           uint32_t mask, uint32_t shift)                                          \
    {                                                                                              \
        run(out, n, x, rank, mask, shift, name);                                                   \
    }                                                                                              \
    const struct zs_dither_format zs_dither_##name = { name##_run };

FORMAT(rgb332)
FORMAT(grey4)
FORMAT(mono)
