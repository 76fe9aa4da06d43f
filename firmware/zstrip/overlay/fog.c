/* Fog by keys.
 *
 * Fog is rounded to 64 levels. It grows with the distance, and so with the key: level L begins at
 * the key of the distance where it is (L - 1/2) / 64. These keys are computed by the mapping's own
 * functions, from distances, so that no mapping has to be inverted and none is interpolated. A
 * pixel keeps the level of the one before it while its key lies between the same two.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/depth.h"
#include "core/view.h"
#include "overlay/items.h"
#include "zs_blend.h"
#include "zs_fog.h"

#define LN2 2977044472u /* ln 2, uq0_32 */

/* Return log2(m), q8_24, floor to 2^-24. 1 <= m < 2^7 */
static uint32_t log2_of(uint32_t m)
{
    const int32_t lz = zs_clz32(m);
    uint32_t x = m << lz, sum = (uint32_t)(31 - lz) << 24; /* x: uq1_31 in [1, 2) */
    for (uint32_t bit = 1u << 23; bit; bit >>= 1) {
        const uint64_t square = zs_mul_uu(x, x) >> 31; /* < 2^33 */
        const uint32_t two = (uint32_t)(square >> 32);
        sum |= two ? bit : 0u;
        x = (uint32_t)(square >> two);
    }
    return sum;
}

/* Return the distance at which fog is (2 level - 1) / 128, q48_16 world units. 1 <= level <= 64.
 * |.| < 2^52 */
static int64_t distance_of(const struct zs_fog *fog, uint32_t level)
{
    const int64_t start = (int64_t)fog->start * 65536;
    const uint32_t odd = 2u * level - 1u;
    if (fog->curve == ZS_FOG_LINEAR)
        return start + ((int64_t)fog->end - fog->start) * odd * 512; /* < 2^48 + 2^32 * 2^7 * 2^9 */
    /* 1 - exp(-t) = odd / 128: t = ln(128 / (128 - odd)), q8_24, < 2^26.3 */
    const uint32_t t = zs_umulh((7u << 24) - log2_of(128u - odd), LN2);
    const uint64_t span = (uint64_t)((int64_t)fog->end - fog->start); /* <= 2^32 */
    return start + (int64_t)((t * span + 128u) >> 8);                 /* < 2^50.4 */
}

/* Return the least key of pixels at or beyond a distance. */
static uint16_t key_from(const struct zs_view *view, const struct zs_camera *camera, int64_t z)
{
    if (z <= camera->z_near)
        return 0;
    if (z > camera->z_far)
        return ZS_DEPTH_CLEAR; /* beyond all keys */
    const int32_t units = zs_max32(zs_min32(zs_view_length(view, z), view->z_far), view->z_near);
    const int32_t lz = view->perspective ? zs_clz32((uint32_t)units) : 0;
    const uint32_t rcp = view->perspective ? zs_recip((uint32_t)units << lz) : 0u;
    const uint32_t d = view->depth->vertex(view, units, rcp, lz);
    const uint32_t key = view->depth->key ? view->depth->key(view, d) : d;            /* uq16_16 */
    return (uint16_t)zs_minu32((key >> 16) + ((key & 0xffffu) != 0), ZS_DEPTH_CLEAR); /* ceiling */
}

int zs_fog_set(struct zs_fog *fog, const struct zs_config *config, const struct zs_camera *camera)
{
    if (!fog || !config || !camera || !config->depth)
        return ZS_ERR_NULL;
    if (fog->curve > ZS_FOG_EXPONENTIAL || fog->start >= fog->end)
        return ZS_ERR_RANGE;
    const uint32_t bits = config->depth_bits ? config->depth_bits : 16u;
    if (config->depth->span || bits < 8u || bits > 16u)
        return ZS_ERR_DEPTH;
    struct zs_view view = { .depth = config->depth };
    struct zs_camera seen = *camera; /* looking down -z from the origin: keys do not mind */
    for (int k = 0; k < 9; k++)
        seen.rot[k] = k % 4 ? 0 : ZS_Q30_ONE;
    seen.pos[0] = seen.pos[1] = seen.pos[2] = 0;
    const int64_t most = distance_of(fog, ZS_FOG_LEVELS);
    zs_view_frame(&view, config);
    int err = zs_view_camera(&view, config, &seen);
    err = err ? err : zs_view_units(&view, &seen, most < seen.z_far ? most : seen.z_far);
    err = err ? err : view.depth->setup(&view, &seen, bits);
    if (err)
        return err;
    fog->from[0] = 0;
    for (uint32_t level = 1; level <= ZS_FOG_LEVELS; level++)
        fog->from[level] = key_from(&view, &seen, distance_of(fog, level));
    fog->from[ZS_FOG_LEVELS + 1u] = ZS_DEPTH_CLEAR;
    return ZS_OK;
}

/* Return the level of a key below ZS_DEPTH_CLEAR, searched for from another level on. */
static uint32_t level_of(const struct zs_fog *fog, uint32_t key, uint32_t level)
{
    while (level < ZS_FOG_LEVELS && key >= fog->from[level + 1u])
        level++;
    while (level && key < fog->from[level])
        level--;
    return level;
}

/* Set the keys of a level, [*from, *from + *span), without those that mean no surface. */
static void level_keys(const struct zs_fog *fog, uint32_t level, uint32_t *from, uint32_t *span)
{
    uint32_t end = fog->from[level + 1u];
    *from = fog->from[level];
    if (fog->sky & ZS_FOG_MASKED && *from == 0 && end)
        *from = 1;
    if (fog->sky & ZS_FOG_WINDOWS && end == ZS_DEPTH_CLEAR && *from < end)
        end--;
    *span = end - *from;
}

/* Is there no surface? */
static int is_sky(const struct zs_fog *fog, uint32_t key)
{
    return key == ZS_DEPTH_CLEAR || (key == ZS_DEPTH_CLEAR - 1u && fog->sky & ZS_FOG_WINDOWS);
}

void zs_fog_draw(void *ctx, const struct zs_target *t)
{
    const struct zs_fog *fog = ctx;
    struct zs_paint paint = zs_paint_of(fog->color, 0);
    uint32_t level = 0, from = 0, span = 0; /* the level's keys: [from, from + span) */
    for (int32_t y = t->y0; t->depth && y < t->y1; y++) {
        uint16_t *out = zs_pixel(t, t->x0, y), *const end = out + (t->x1 - t->x0);
        const uint16_t *at = t->depth + (out - t->color);
        for (; out != end; out++) {
            const uint32_t key = *at++;
            if (key - from >= span) {
                if (is_sky(fog, key)) {
                    *out = fog->sky & ZS_FOG_SKY ? paint.wire : *out;
                    continue;
                }
                if (key == 0 && fog->sky & ZS_FOG_MASKED)
                    continue;
                level = level_of(fog, key, level);
                paint = zs_paint_of(fog->color, level);
                level_keys(fog, level, &from, &span);
            }
            if (level)
                *out = zs_paint_over(&paint, *out);
        }
    }
}

/* zs_layered.fogged: put fog on n pixels, whose keys are sum / 65536, sum + step, ... dark: it is
 * black, for light that is added. */
static void layer_run(const struct zs_fog *fog, uint16_t *px, int32_t n, uint32_t sum,
                      uint32_t step, int dark)
{
    const uint32_t color = dark ? 0u : fog->color;
    struct zs_paint paint = zs_paint_of(color, 0);
    uint32_t level = 0, from = 0, span = fog->from[1]; /* the level's keys: [from, from + span) */
    for (uint16_t *const end = px + n; px != end; px++, sum += step) {
        const uint32_t key = zs_minu32(sum >> 16, ZS_DEPTH_CLEAR - 1u);
        if (key - from >= span) {
            level = level_of(fog, key, level);
            paint = zs_paint_of(color, level);
            from = fog->from[level];
            span = fog->from[level + 1u] - from;
        }
        if (level)
            *px = zs_paint_over(&paint, *px);
    }
}

void zs_layered_fog(struct zs_layered *layer, const struct zs_fog *fog)
{
    layer->fog = fog;
    layer->fogged = fog ? layer_run : 0;
}

int zs_fog_changes(void *ctx, struct zs_rect *rect)
{
    struct zs_fog *fog = ctx;
    const struct zs_rect all = { 0, 0, 65535, 65535 };
    uint32_t lane[2] = { 0x243f6a88u, 0x85a308d3u };
    zs_item_mix(lane, fog->color | (uint32_t)fog->sky << 16);
    for (uint32_t k = 0; k < ZS_FOG_LEVELS + 2u; k++)
        zs_item_mix(lane, fog->from[k]);
    const int changed = ((lane[0] ^ fog->before[0]) | (lane[1] ^ fog->before[1])) != 0;
    fog->before[0] = lane[0];
    fog->before[1] = lane[1];
    *rect = all;
    return changed;
}
