/* What the panel may not show, although it was drawn.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/damage.h"
#include "damage/changed.h"

int zs_invalidate(struct zs_renderer *r, const struct zs_rect *rect)
{
    if (!r)
        return ZS_ERR_NULL;
    if (r->ready != 1)
        return ZS_ERR_SEQUENCE;
    const struct zs_strip_hash_ops *strip_hash = r->strip_hash;
    if (strip_hash)
        strip_hash->forget(r, rect);
    const struct zs_track_ops *track = r->track;
    if (track)
        track->forget(r, rect);
    return ZS_OK;
}

/* The last strip and the one before it may not have reached the panel. */
void zs_unsent(struct zs_renderer *r, const struct zs_strip *last)
{
    struct zs_rect rows = { 0 };
    if (last) {
        rows.y = last->y < r->config.strip_h ? 0u : (uint16_t)(last->y - r->config.strip_h);
        rows.w = last->w;
        rows.h = (uint16_t)(last->y + last->h - rows.y);
    }
    (void)zs_invalidate(r, last ? &rows : 0);
}
