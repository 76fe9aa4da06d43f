/* Strip hashes: one hash of the panel's pixels for each strip and column of cells, so that only
 * changed cells are sent. The frame is drawn as usual; only sending is saved.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/damage.h"
#include "core/fx.h"
#include "damage/changed.h"

/* Hash w x h pixels from px on; two at a time if rows and columns are even. */
static uint64_t cell_sum(const uint16_t *px, uint32_t w, uint32_t h, uint32_t stride, int even)
{
    uint32_t lane[2] = ZS_LANES;
    for (; h; h--, px += stride) {
        const uint16_t *at = px, *const end = px + w;
        if (even && ZS_PAIR == 2u)
            for (; end - at >= 2; at += 2)
                zs_mix(lane, *(const zs_pair *)(const void *)at);
        for (; at < end; at++)
            zs_mix(lane, *at);
    }
    const uint64_t sum = (uint64_t)lane[0] << 32 | lane[1];
    return sum ? sum : 1u; /* 0: not known */
}

static void strip_hash_look(struct zs_renderer *r, struct zs_strip *out)
{
    const uint32_t step = zs_strip_hash_step(r), row = out->y / (uint32_t)r->config.strip_h;
    uint64_t *sum = r->sums->sum + row * r->sums->columns;
    uint32_t first = out->w, end = 0;
    for (uint32_t x = 0; x < out->w; x += step, sum++) {
        const uint32_t w = out->w - x < step ? out->w - x : step;
        if (x < r->window[0] || x + w > r->window[1])
            continue; /* not drawn as a whole: not changed (make_due(), damage/track.c) */
        const uint64_t now = cell_sum((const uint16_t *)(const void *)out->px + x, w, out->h,
                                      out->w, !(out->w & 1u));
        if (now == *sum)
            continue;
        *sum = now;
        first = first < x ? first : x;
        end = x + w;
    }
    out->dirty_x = (uint16_t)(end ? first : 0u);
    out->dirty_w = (uint16_t)(end ? end - first : 0u);
    r->stats.strips_clean += !end;
}

static void strip_hash_forget(struct zs_renderer *r, const struct zs_rect *rect)
{
    const uint32_t step = zs_strip_hash_step(r);
    for (uint32_t s = 0; s < r->n_strips; s++) {
        if (!zs_strip_in(r, s, rect))
            continue;
        for (uint32_t c = 0; c < r->sums->columns; c++)
            if (!rect || (c * step < (uint32_t)rect->x + rect->w && (c + 1u) * step > rect->x))
                r->sums->sum[s * r->sums->columns + c] = 0;
    }
}

static const struct zs_strip_hash_ops kernel = { .look = strip_hash_look,
                                                    .forget = strip_hash_forget };

int zs_strip_hashes_init(struct zs_strip_hashes *sums, uint64_t *memory, uint32_t width,
                         uint32_t height, uint32_t strip_h, uint32_t columns)
{
    if (!sums || !memory)
        return ZS_ERR_NULL;
    if (width < 1u || width > ZS_SIZE_MAX || height < 1u || height > ZS_SIZE_MAX || strip_h < 1u ||
        columns < 1u || columns > width)
        return ZS_ERR_SIZE;
    sums->sum = memory;
    sums->width = (uint16_t)width;
    sums->height = (uint16_t)height;
    sums->strip_h = (uint16_t)zs_minu32(strip_h, height);
    sums->columns = (uint16_t)columns;
    for (uint32_t k = 0; k < ZS_STRIPS(height, sums->strip_h) * columns; k++)
        memory[k] = 0;
    return ZS_OK;
}

int zs_damage_compare(struct zs_renderer *r, struct zs_strip_hashes *sums)
{
    if (!r)
        return ZS_ERR_NULL;
    if (r->ready != 1 || r->scene)
        return ZS_ERR_SEQUENCE;
    if (sums && (sums->width != r->config.width || sums->height != r->config.height ||
                 sums->strip_h != r->config.strip_h))
        return ZS_ERR_SIZE;
    r->strip_hash = sums ? &kernel : 0;
    r->unsent = zs_unsent;
    r->sums = sums;
    const struct zs_track_ops *track = r->track;
    if (track)
        track->forget(r, 0);
    return ZS_OK;
}
