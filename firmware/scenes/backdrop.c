/* Backgrounds: a level for four pixels at a time, and a pattern of thresholds.
 *
 * SPDX-License-Identifier: MIT
 */
#include "backdrop.h"

static const uint8_t bayer[4][4] = { { 0, 8, 2, 10 }, { 12, 4, 14, 6 }, { 3, 11, 1, 9 }, { 15, 7, 13, 5 } };

void backdrop_colors(struct backdrop *b, struct zs_rgb from, struct zs_rgb to)
{
    const int32_t most = (int32_t)BACKDROP_SHADES + 3;
    for (int32_t i = 0; i <= most; i++)
        b->shade[i] = zs_wire565((uint8_t)(from.r + (to.r - from.r) * i / most),
                                 (uint8_t)(from.g + (to.g - from.g) * i / most),
                                 (uint8_t)(from.b + (to.b - from.b) * i / most));
}

/* Colour pixels x .. end of one level, in columns of one group of four. */
static inline uint16_t *group(const struct backdrop *b, uint16_t *out, uint32_t x, uint32_t end, int32_t level,
                              const uint8_t *rank)
{
    const uint16_t *const shade = b->shade;
    const uint32_t at = level < 0 ? 0u : level > 255 ? 255u : (uint32_t)level;
    if (end - x == 4u) {
        out[0] = shade[(at + rank[0]) >> 2]; /* <= 270 / 4 = 67 */
        out[1] = shade[(at + rank[1]) >> 2];
        out[2] = shade[(at + rank[2]) >> 2];
        out[3] = shade[(at + rank[3]) >> 2];
        return out + 4;
    }
    for (; x < end; x++)
        *out++ = shade[(at + rank[x & 3u]) >> 2];
    return out;
}

static inline uint32_t group_end(uint32_t x, uint32_t end)
{
    const uint32_t next = (x | 3u) + 1u;
    return next < end ? next : end;
}

/* ---- Skies ------------------------------------------------------------------------------------------------------ */

#define LEVELS 364 /* to a slope of 1: 255 at 35 degrees */

/* The height of a view axis, after the mirror, q30. */
static int64_t rise(const zs_q2_30 v[3], const zs_q2_30 *mirror)
{
    int64_t dot = 0; /* q30 */
    for (int i = 0; mirror && i < 3; i++)
        dot += (int64_t)mirror[i] * v[i] >> 30;
    return v[1] - (mirror ? 2 * (dot * mirror[1] >> 30) : 0);
}

void backdrop_sky(struct backdrop *b, const struct zs_camera *camera, const struct zs_rect *viewport,
                  const zs_q2_30 *mirror)
{
    const int64_t focal = (int64_t)(camera->focal >> 24);               /* q8 px */
    b->dx = (int32_t)(rise(camera->rot, mirror) * LEVELS / 64 / focal); /* q30 / q8 / 2^6: q16 */
    b->dy = (int32_t)(-rise(camera->rot + 3, mirror) * LEVELS / 64 / focal);
    b->level = (int32_t)(-rise(camera->rot + 6, mirror) * LEVELS >> 14) - b->dx * (viewport->x + viewport->w / 2) -
               b->dy * (viewport->y + viewport->h / 2);
}

void backdrop_sky_fill(void *ctx, uint16_t *out, uint16_t x, uint16_t y, uint16_t n)
{
    const struct backdrop *b = ctx;
    const int32_t row = b->level + b->dy * y;
    for (uint32_t at = x, end = x + (uint32_t)n, next; at < end; at = next) {
        next = group_end(at, end);
        out = group(b, out, at, next, (row + b->dx * (int32_t)(at & ~3u)) >> 16, bayer[y & 3u]);
    }
}

/* ---- Glows ------------------------------------------------------------------------------------------------------ */

void backdrop_glow(struct backdrop *b, uint16_t w, uint16_t h, uint8_t x, uint8_t y, uint8_t fall)
{
    b->x = w * x / 16;
    b->y = h * y / 16;
    b->step = 128 * 64 / (w < h ? w : h);
    b->fall = fall;
}

void backdrop_glow_fill(void *ctx, uint16_t *out, uint16_t x, uint16_t y, uint16_t n)
{
    const struct backdrop *b = ctx;
    const int32_t dy = (y - b->y) * b->step >> 6;
    for (uint32_t at = x, end = x + (uint32_t)n, next; at < end; at = next) {
        next = group_end(at, end);
        const int32_t dx = ((int32_t)(at & ~3u) - b->x) * b->step >> 6;
        out = group(b, out, at, next, 255 - ((dx * dx + dy * dy) * b->fall >> 11), bayer[y & 3u]);
    }
}
