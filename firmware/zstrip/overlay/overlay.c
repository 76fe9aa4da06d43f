/* The list of items: drawing it, and finding what changed since the frame before.
 *
 * SPDX-License-Identifier: MIT
 */
#include "overlay/items.h"

static int right(const struct zs_item *item)
{
    return item->kind && item->kind->check ? item->kind->check(item) : ZS_OK;
}

int zs_overlay_check(const struct zs_overlay *overlay)
{
    if (!overlay || (overlay->n && !overlay->item))
        return ZS_ERR_NULL;
    if (overlay->memory && overlay->n > overlay->room)
        return ZS_ERR_SIZE;
    for (uint32_t k = 0; k < overlay->n; k++) {
        const int err = right(&overlay->item[k]);
        if (err)
            return err;
    }
    return ZS_OK;
}

void zs_overlay_draw(void *ctx, const struct zs_target *target)
{
    const struct zs_overlay *overlay = ctx;
    const struct zs_item *item = overlay->item;
    for (uint32_t n = item ? overlay->n : 0; n; n--, item++)
        if (item->kind && !right(item))
            item->kind->draw(item, target);
}

/* ---- What changed ---------------------------------------------------------------------------- */

static void mix_pointer(uint32_t lane[2], const void *at)
{
    const uint64_t bits = (uintptr_t)at;
    zs_item_mix(lane, (uint32_t)bits);
    zs_item_mix(lane, (uint32_t)(bits >> 32));
}

/* Compute the hash of all that an item is drawn from, but for what a sprite points at. */
static void item_sum(uint32_t lane[2], const struct zs_item *item)
{
    const struct zs_sprite *s = item->sprite;
    lane[0] = 0x243f6a88u;
    lane[1] = 0x85a308d3u;
    mix_pointer(lane, (const void *)item->kind);
    zs_item_mix(lane, (uint16_t)item->x | (uint32_t)(uint16_t)item->y << 16);
    zs_item_mix(lane, (uint16_t)item->w | (uint32_t)(uint16_t)item->h << 16);
    zs_item_mix(lane, item->color | (uint32_t)item->back << 16);
    zs_item_mix(lane, item->clear | (uint32_t)item->back_clear << 8 | (uint32_t)item->size << 16 |
                          (uint32_t)item->flags << 24);
    zs_item_mix(lane, item->value);
    zs_item_mix(lane, item->from | (uint32_t)item->sweep << 16);
    mix_pointer(lane, s);
    if (s) {
        mix_pointer(lane, s->pixel);
        mix_pointer(lane, s->palette);
        mix_pointer(lane, s->alpha);
        zs_item_mix(lane, s->w | (uint32_t)s->h << 16);
        zs_item_mix(lane, s->key | (uint32_t)s->format << 16 | (uint32_t)s->alpha_kind << 24);
        zs_item_mix(lane, s->left | (uint32_t)s->top << 8 | (uint32_t)s->right << 16 |
                              (uint32_t)s->bottom << 24);
    }
    for (const char *at = item->text; at && *at; at++)
        zs_item_mix(lane, (uint8_t)*at);
}

/* What memory holds of an item: its hash, and its box in 16 bits, x | y << 16. */
struct seen {
    uint32_t sum[2], from, to;
};
_Static_assert(sizeof(struct seen) == ZS_OVERLAY_WORDS(1) * 4u, "ZS_OVERLAY_WORDS");

static uint32_t held16(int32_t v)
{
    return (uint32_t)zs_max32(zs_min32(v, 65535), 0);
}

static void item_seen(struct seen *seen, const struct zs_item *item)
{
    int32_t box[4] = { 0, 0, 0, 0 };
    item_sum(seen->sum, item);
    if (item->kind && !right(item))
        item->kind->bounds(item, box);
    seen->from = held16(box[0]) | held16(box[1]) << 16;
    seen->to = held16(box[2]) | held16(box[3]) << 16;
}

/* Extend a box by that of an item, unless that is empty. */
static void extend(struct zs_box *box, const struct seen *seen)
{
    const int32_t x0 = (int32_t)(seen->from & 65535u), y0 = (int32_t)(seen->from >> 16);
    const int32_t x1 = (int32_t)(seen->to & 65535u), y1 = (int32_t)(seen->to >> 16);
    if (x0 >= x1 || y0 >= y1)
        return;
    box->x0 = zs_min32(box->x0, x0);
    box->y0 = zs_min32(box->y0, y0);
    box->x1 = zs_max32(box->x1, x1);
    box->y1 = zs_max32(box->y1, y1);
}

int zs_overlay_changes(void *ctx, struct zs_rect *rect)
{
    struct zs_overlay *overlay = ctx;
    struct seen *seen = (struct seen *)(void *)overlay->memory;
    struct zs_box box = { 65535, 65535, 0, 0 };
    if (!seen || !overlay->item || overlay->n > overlay->room) {
        const struct zs_rect all = { 0, 0, 65535, 65535 };
        overlay->before = 0;
        *rect = all;
        return 1;
    }
    const uint32_t most = zs_maxu32(overlay->n, overlay->before);
    for (uint32_t k = 0; k < most; k++) {
        struct seen now = { { 0, 0 }, 0, 0 };
        if (k < overlay->n)
            item_seen(&now, &overlay->item[k]);
        if (k < overlay->before && k < overlay->n && now.sum[0] == seen[k].sum[0] &&
            now.sum[1] == seen[k].sum[1])
            continue;
        if (k < overlay->before)
            extend(&box, &seen[k]);
        extend(&box, &now);
        if (k < overlay->n)
            seen[k] = now;
    }
    overlay->before = overlay->n;
    rect->x = (uint16_t)box.x0;
    rect->y = (uint16_t)box.y0;
    rect->w = (uint16_t)zs_max32(box.x1 - box.x0, 0);
    rect->h = (uint16_t)zs_max32(box.y1 - box.y0, 0);
    return box.x0 < box.x1;
}
