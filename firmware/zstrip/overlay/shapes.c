/* Rectangles, lines and bars.
 *
 * SPDX-License-Identifier: MIT
 */
#include "overlay/items.h"

static struct zs_box rect_of(const struct zs_item *item)
{
    const struct zs_box box = { item->x, item->y, item->x + item->w, item->y + item->h };
    return box;
}

static void rect_bounds(const struct zs_item *item, int32_t box[4])
{
    box[0] = item->x;
    box[1] = item->y;
    box[2] = item->x + item->w;
    box[3] = item->y + item->h;
}

/* ---- Rectangles ------------------------------------------------------------------------------ */

static void fill_draw(const struct zs_item *item, const struct zs_target *t)
{
    const struct zs_paint paint = zs_paint_of(item->color, zs_alpha_of(item->clear));
    zs_paint_box(t, rect_of(item), &paint);
}

const struct zs_item_kind zs_item_fill = { .draw = fill_draw, .bounds = rect_bounds };

static void outline_draw(const struct zs_item *item, const struct zs_target *t)
{
    const struct zs_paint paint = zs_paint_of(item->color, zs_alpha_of(item->clear));
    const struct zs_box all = rect_of(item);
    const int32_t size = item->size ? item->size : 1;
    struct zs_box box = all;
    if (2 * size >= item->w || 2 * size >= item->h) {
        zs_paint_box(t, all, &paint);
        return;
    }
    box.y1 = all.y0 + size;
    zs_paint_box(t, box, &paint);
    box.y0 = box.y1;
    box.y1 = all.y1 - size;
    box.x1 = all.x0 + size;
    zs_paint_box(t, box, &paint);
    box.x0 = all.x1 - size;
    box.x1 = all.x1;
    zs_paint_box(t, box, &paint);
    box.x0 = all.x0;
    box.y0 = box.y1;
    box.y1 = all.y1;
    zs_paint_box(t, box, &paint);
}

const struct zs_item_kind zs_item_outline = { .draw = outline_draw, .bounds = rect_bounds };

/* ---- Bars ------------------------------------------------------------------------------------ */

static void bar_draw(const struct zs_item *item, const struct zs_target *t)
{
    const struct zs_paint on = zs_paint_of(item->color, zs_alpha_of(item->clear));
    const struct zs_paint off = zs_paint_of(item->back, zs_alpha_of(item->back_clear));
    const int up = item->flags & ZS_ITEM_UP;
    const uint32_t length = (uint32_t)zs_max32(up ? item->h : item->w, 0);    /* < 2^15 */
    const int32_t full = (int32_t)((length * item->value + 32767u) / 65535u); /* < 2^31 */
    struct zs_box lit = rect_of(item), rest = lit;
    if (up)
        rest.y1 = lit.y0 = lit.y1 - full;
    else
        rest.x0 = lit.x1 = lit.x0 + full;
    zs_paint_box(t, lit, &on);
    zs_paint_box(t, rest, &off);
}

const struct zs_item_kind zs_item_bar = { .draw = bar_draw, .bounds = rect_bounds };

/* ---- Lines ----------------------------------------------------------------------------------- */

static void line_draw(const struct zs_item *item, const struct zs_target *t)
{
    const struct zs_paint paint = zs_paint_of(item->color, zs_alpha_of(item->clear));
    zs_paint_line(t, item->x, item->y, item->x + item->w, item->y + item->h, &paint);
}

static void line_bounds(const struct zs_item *item, int32_t box[4])
{
    box[0] = item->x + zs_min32(item->w, 0);
    box[1] = item->y + zs_min32(item->h, 0);
    box[2] = item->x + zs_max32(item->w, 0) + 1;
    box[3] = item->y + zs_max32(item->h, 0) + 1;
}

const struct zs_item_kind zs_item_line = { .draw = line_draw, .bounds = line_bounds };
