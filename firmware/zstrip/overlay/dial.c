/* Dials: arcs, needles and ticks.
 *
 * Directions are unit vectors of 14 fraction bits, radii at most 2047 px: what is computed is off
 * by less than 1/8 px from the exact shape.
 *
 * SPDX-License-Identifier: MIT
 */
#include "overlay/items.h"
#include "zs_math.h"

/* The direction of an angle, clockwise from upwards: x to the right, y down, q18_14. */
struct direction {
    int32_t x, y;
};

static struct direction direction_of(zs_turn angle)
{
    const struct direction d = { (zs_sin(angle) + 0x8000) >> 16, (0x8000 - zs_cos(angle)) >> 16 };
    return d;
}

static uint32_t sweep_of(const struct zs_item *item)
{
    return item->sweep ? item->sweep : 65536u;
}

/* Return the part of the sweep that value says, nearest. */
static uint32_t part_of(const struct zs_item *item)
{
    return (sweep_of(item) * item->value + 32767u) / 65535u; /* < 2^32 */
}

static int dial_check(const struct zs_item *item)
{
    return item->w < 0 || item->w > ZS_RADIUS_MAX || item->h < 0 || item->h > ZS_RADIUS_MAX
               ? ZS_ERR_RANGE
               : ZS_OK;
}

static void dial_bounds(const struct zs_item *item, int32_t box[4])
{
    box[0] = item->x - item->w;
    box[1] = item->y - item->w;
    box[2] = item->x + item->w + 1;
    box[3] = item->y + item->w + 1;
}

/* ---- Arcs ------------------------------------------------------------------------------------ */

/* An arc in two parts: from d[0] on over sweep[0], and from d[1] on over sweep[1] to d[2]. */
struct arc {
    struct direction d[3];
    uint32_t sweep[2]; /* 0 .. 65536 */
    struct zs_paint paint[2];
    int32_t x, y; /* the centre */
};

/* Return 1 if (x, y) is at a direction, or less than half a turn clockwise of it. centre: 0: so is
 * the centre; 1: it is not. |x|, |y| <= 2047: sums < 2^27. */
static inline int clockwise(const struct direction *d, int32_t x, int32_t y, int32_t centre)
{
    const int32_t side = d->x * y - d->y * x;
    return side > 0 || (side == 0 && d->x * x + d->y * y >= centre);
}

/* Return 1 if (x, y) is at direction d[0], or clockwise of it up to before d[1]. */
static inline int in_sweep(const struct direction d[2], uint32_t sweep, int32_t x, int32_t y)
{
    if (sweep == 0 || sweep == 65536u)
        return sweep != 0;
    const int from = clockwise(&d[0], x, y, 0);
    return sweep <= 32768u ? from && !clockwise(&d[1], x, y, 1)
                           : from || !clockwise(&d[1], x, y, 1);
}

/* Return the part that a pixel is in; 2: none. */
static int part_at(const struct arc *arc, int32_t x, int32_t y)
{
    return in_sweep(arc->d, arc->sweep[0], x, y)       ? 0
           : in_sweep(arc->d + 1, arc->sweep[1], x, y) ? 1
                                                       : 2;
}

/* Paint what belongs to the arc of columns [x0, x1), relative to the centre, of row y. */
static void arc_run(const struct arc *arc, const struct zs_target *t, int32_t x0, int32_t x1,
                    int32_t y)
{
    x0 = zs_max32(x0, t->x0 - arc->x);
    x1 = zs_min32(x1, t->x1 - arc->x);
    if (x0 >= x1)
        return;
    int part = part_at(arc, x0, y);
    for (int32_t x = x0 + 1; x <= x1; x++) {
        const int next = x < x1 ? part_at(arc, x, y) : 3;
        if (next == part)
            continue;
        if (part < 2 && arc->paint[part].rest < 64u)
            zs_paint_run(zs_pixel(t, arc->x + x0, arc->y + y), x - x0, &arc->paint[part]);
        part = next;
        x0 = x;
    }
}

/* Return the largest x with x^2 <= square, from one that is near it; -1: square < 0. */
static int32_t root(int32_t square, int32_t x)
{
    while (x >= 0 && x * x > square)
        x--;
    while ((x + 1) * (x + 1) <= square)
        x++;
    return x;
}

/* A pixel is in the ring if its distance d has inner + 1/2 < d < outer + 1/2: inner^2 + inner <
 * d^2 <= outer^2 + outer in whole numbers. */
static void arc_draw(const struct zs_item *item, const struct zs_target *t)
{
    const int32_t outer = item->w, inner = item->h && item->h <= outer ? outer - item->h : -1;
    const uint32_t part = part_of(item), sweep = sweep_of(item);
    const int32_t y0 = zs_max32(-outer, t->y0 - item->y);
    const int32_t y1 = zs_min32(outer + 1, t->y1 - item->y);
    int32_t far = 0, hole = 0; /* columns up to which the ring and its hole reach */
    if (y0 >= y1 || item->x + outer < t->x0 || item->x - outer >= t->x1)
        return;
    const struct arc arc = { { direction_of(item->from), direction_of((zs_turn)(item->from + part)),
                               direction_of((zs_turn)(item->from + sweep)) },
                             { part, sweep - part },
                             { zs_paint_of(item->color, zs_alpha_of(item->clear)),
                               zs_paint_of(item->back, zs_alpha_of(item->back_clear)) },
                             item->x,
                             item->y };
    for (int32_t y = y0; y < y1; y++) {
        far = root(outer * outer + outer - y * y, far); /* 0 .. 2^22 */
        hole = inner < 0 ? -1 : root(inner * inner + inner - y * y, hole);
        if (hole < 0) {
            arc_run(&arc, t, -far, far + 1, y);
            continue;
        }
        arc_run(&arc, t, -far, -hole, y);
        arc_run(&arc, t, hole + 1, far + 1, y);
    }
}

const struct zs_item_kind zs_item_arc = { .draw = arc_draw,
                                          .bounds = dial_bounds,
                                          .check = dial_check };

/* ---- Needles --------------------------------------------------------------------------------- */

static struct direction needle_direction(const struct zs_item *item)
{
    return direction_of((zs_turn)(item->from + part_of(item)));
}

static void needle_bounds(const struct zs_item *item, int32_t box[4])
{
    const struct direction d = needle_direction(item);
    const int32_t x0 = item->w * d.x >> 14, y0 = item->w * d.y >> 14; /* the point */
    const int32_t x1 = -item->h * d.x >> 14, y1 = -item->h * d.y >> 14;
    const int32_t wide = item->size / 2 + 2;
    box[0] = item->x + zs_min32(x0, x1) - wide;
    box[1] = item->y + zs_min32(y0, y1) - wide;
    box[2] = item->x + zs_max32(x0, x1) + wide + 1;
    box[3] = item->y + zs_max32(y0, y1) + wide + 1;
}

/* Return 1 if pixel (x, y), relative to the pivot, is in the needle: not farther from its axis than
 * half its width there, and at least half a pixel. |x|, |y| < 2^12. */
static int in_needle(const struct zs_item *item, const struct direction *d, int32_t x, int32_t y)
{
    const int32_t along = (d->x * x + d->y * y) >> 10; /* q_4, |.| < 2^17 */
    const int32_t aside = zs_abs32(d->x * y - d->y * x) >> 10;
    const int32_t ahead = item->w * 16 - along, length = item->w + item->h; /* < 2^12 */
    if (ahead < 0 || along < -item->h * 16)
        return 0;
    return aside <= 8 || (length && 2 * aside * length <= item->size * ahead); /* < 2^30, 2^26 */
}

static void needle_draw(const struct zs_item *item, const struct zs_target *t)
{
    const struct zs_paint paint = zs_paint_of(item->color, zs_alpha_of(item->clear));
    const struct direction d = needle_direction(item);
    int32_t at[4];
    needle_bounds(item, at);
    struct zs_box box = { at[0], at[1], at[2], at[3] };
    if (paint.rest == 64u || !zs_box_clip(&box, t))
        return;
    for (int32_t y = box.y0; y < box.y1; y++) {
        uint16_t *out = zs_pixel(t, box.x0, y);
        for (int32_t x = box.x0; x < box.x1; x++, out++)
            if (in_needle(item, &d, x - item->x, y - item->y))
                *out = zs_paint_over(&paint, *out);
    }
}

const struct zs_item_kind zs_item_needle = { .draw = needle_draw,
                                             .bounds = needle_bounds,
                                             .check = dial_check };

/* ---- Ticks ----------------------------------------------------------------------------------- */

static int ticks_check(const struct zs_item *item)
{
    return item->value > 1000u ? ZS_ERR_RANGE : dial_check(item);
}

/* Return the larger of the two radii: ticks longer than their radius go on behind the centre. */
static int32_t ticks_radius(const struct zs_item *item)
{
    return zs_max32(item->w, item->h - item->w);
}

static int32_t reach(int32_t radius, int32_t part)
{
    return (radius * part + 0x2000) >> 14; /* nearest; < 2^26 */
}

static void ticks_draw(const struct zs_item *item, const struct zs_target *t)
{
    const struct zs_paint paint = zs_paint_of(item->color, zs_alpha_of(item->clear));
    const uint32_t sweep = sweep_of(item), n = item->value;
    const int32_t inner = item->w - item->h, outer = ticks_radius(item);
    if (item->y + outer < t->y0 || item->y - outer >= t->y1)
        return;
    for (uint32_t k = 0; k < n + (item->sweep ? 1u : 0u); k++) {
        const zs_turn angle = (zs_turn)(item->from + (n ? sweep * k / n : 0u)); /* < 2^26 */
        const struct direction d = direction_of(angle);
        zs_paint_line(t, item->x + reach(item->w, d.x), item->y + reach(item->w, d.y),
                      item->x + reach(inner, d.x), item->y + reach(inner, d.y), &paint);
    }
}

static void ticks_bounds(const struct zs_item *item, int32_t box[4])
{
    struct zs_item all = *item;
    all.w = (int16_t)ticks_radius(item);
    dial_bounds(&all, box);
}

const struct zs_item_kind zs_item_ticks = { .draw = ticks_draw,
                                            .bounds = ticks_bounds,
                                            .check = ticks_check };
