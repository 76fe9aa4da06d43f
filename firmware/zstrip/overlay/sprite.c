/* Sprites, whole or as nine-slice frames.
 *
 * A row of an item is cut into runs of consecutive sprite pixels; of these, up to RUN are read at a
 * time, and then mixed.
 *
 * SPDX-License-Identifier: MIT
 */
#include "overlay/items.h"

#define RUN 16

struct source {
    const struct zs_sprite *sprite;
    uint32_t scale; /* alpha 0 .. 64 of the item, times 2^16 / 255: < 2^15 */
    uint32_t whole; /* that alpha */
};

static int sprite_check(const struct zs_item *item)
{
    const struct zs_sprite *s = item->sprite;
    if (!s || !s->pixel || (s->format != ZS_SPRITE_565 && !s->palette) ||
        (s->alpha_kind > ZS_ALPHA_KEY && !s->alpha))
        return ZS_ERR_NULL;
    return s->w < 1u || s->w > ZS_SIZE_MAX || s->h < 1u || s->h > ZS_SIZE_MAX ||
                   s->format > ZS_SPRITE_PAL4 || s->alpha_kind > ZS_ALPHA_8 ||
                   (uint32_t)s->left + s->right > s->w || (uint32_t)s->top + s->bottom > s->h
               ? ZS_ERR_TEXTURE
               : ZS_OK;
}

static void sprite_bounds(const struct zs_item *item, int32_t box[4])
{
    box[0] = item->x;
    box[1] = item->y;
    box[2] = item->x + (item->w ? item->w : item->sprite->w);
    box[3] = item->y + (item->h ? item->h : item->sprite->h);
}

/* ---- Reading --------------------------------------------------------------------------------- */

/* Read n palette numbers from column u of row v on. */
static void read_numbers(uint16_t *out, const struct zs_sprite *s, uint32_t u, uint32_t v,
                         int32_t n)
{
    if (s->format == ZS_SPRITE_PAL8) {
        const uint8_t *at = (const uint8_t *)s->pixel + v * s->w + u;
        for (int32_t k = 0; k < n; k++)
            out[k] = at[k];
    } else {
        const uint8_t *row = (const uint8_t *)s->pixel + v * ((s->w + 1u) >> 1);
        for (int32_t k = 0; k < n; k++, u++)
            out[k] = row[u >> 1] >> (u & 1u) * 4u & 15u;
    }
}

/* Read n alphas, 0 .. 64, times that of the item: nearest, to 1/128 and a little. */
static void read_alphas(uint8_t *out, const struct source *from, const uint16_t *value, uint32_t u,
                        uint32_t v, int32_t n)
{
    const struct zs_sprite *s = from->sprite;
    for (int32_t k = 0; k < n; k++, u++) {
        uint32_t a = 255u;
        if (s->alpha_kind == ZS_ALPHA_8)
            a = s->alpha[v * s->w + u];
        else if (s->alpha_kind == ZS_ALPHA_4)
            a = (s->alpha[v * ((s->w + 1u) >> 1) + (u >> 1)] >> (u & 1u) * 4u & 15u) * 17u;
        else if (s->alpha_kind == ZS_ALPHA_MASK)
            a = s->alpha[v * ((s->w + 7u) >> 3) + (u >> 3)] << (u & 7u) & 128u ? 255u : 0u;
        else if (value[k] == s->key)
            a = 0;
        out[k] = (uint8_t)((a * from->scale + 0x8000u) >> 16); /* < 2^23 */
    }
}

/* ---- Drawing --------------------------------------------------------------------------------- */

/* Draw n <= RUN pixels. */
static void draw_run(uint16_t *out, const struct source *from, uint32_t u, uint32_t v, int32_t n)
{
    const struct zs_sprite *s = from->sprite;
    uint16_t number[RUN];
    uint8_t alpha[RUN];
    const uint16_t *color = number;
    if (s->format == ZS_SPRITE_565)
        color = (const uint16_t *)s->pixel + v * s->w + u;
    else
        read_numbers(number, s, u, v, n);
    if (s->alpha_kind != ZS_ALPHA_NONE)
        read_alphas(alpha, from, color, u, v, n);
    if (s->format != ZS_SPRITE_565)
        for (int32_t k = 0; k < n; k++)
            number[k] = s->palette[number[k]];
    if (s->alpha_kind == ZS_ALPHA_NONE && from->whole == 64u) {
        for (int32_t k = 0; k < n; k++)
            out[k] = zs_wire16(color[k]);
        return;
    }
    for (int32_t k = 0; k < n; k++) {
        const uint32_t a = s->alpha_kind == ZS_ALPHA_NONE ? from->whole : alpha[k];
        const struct zs_paint paint = zs_paint_of(color[k], a);
        if (a)
            out[k] = zs_paint_over(&paint, out[k]); /* 64: the colour itself */
    }
}

/* A sprite's size along an axis, its borders there, and the size that it is drawn in. */
struct axis {
    int32_t size, near, far, drawn;
};

/* Return the sprite's column (or row) at i, and in *n how many follow one another from there on. 0:
 * none is drawn there. */
static int32_t axis_at(const struct axis *axis, int32_t i, int32_t *n)
{
    const int32_t middle = axis->size - axis->near - axis->far;
    const int32_t far = axis->drawn - axis->far; /* where the far border begins */
    *n = axis->near - i;
    if (*n > 0)
        return i;
    *n = axis->drawn - i;
    if (i >= far)
        return axis->size - *n;
    *n = far - i;
    if (middle <= 0)
        return -1;
    const int32_t at = (i - axis->near) % middle;
    *n = zs_min32(*n, middle - at);
    return axis->near + at;
}

static void sprite_draw(const struct zs_item *item, const struct zs_target *t)
{
    const struct zs_sprite *s = item->sprite;
    const uint32_t opaque = 255u - item->clear;
    const struct source from = { s, (opaque * 64u * 65536u / 255u + 127u) / 255u,
                                 zs_alpha_of(item->clear) };
    int32_t at[4];
    sprite_bounds(item, at);
    struct zs_box box = { at[0], at[1], at[2], at[3] };
    const struct axis across = { s->w, s->left, s->right, at[2] - at[0] };
    const struct axis down = { s->h, s->top, s->bottom, at[3] - at[1] };
    if (from.whole == 0 || !zs_box_clip(&box, t))
        return;
    for (int32_t y = box.y0; y < box.y1; y++) {
        int32_t n;
        const int32_t v = axis_at(&down, y - at[1], &n);
        for (int32_t x = box.x0; v >= 0 && x < box.x1; x += n) {
            const int32_t u = axis_at(&across, x - at[0], &n);
            n = zs_min32(n, box.x1 - x);
            if (u < 0)
                continue;
            n = zs_min32(n, RUN);
            draw_run(zs_pixel(t, x, y), &from, (uint32_t)u, (uint32_t)v, n);
        }
    }
}

const struct zs_item_kind zs_item_sprite = { .draw = sprite_draw,
                                             .bounds = sprite_bounds,
                                             .check = sprite_check };
