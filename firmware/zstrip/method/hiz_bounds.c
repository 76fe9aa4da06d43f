/* The hierarchical depth buffer: bounds. method/hiz.c says when they are looked at.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/depth.h"
#include "core/job.h"
#include "method/hiz.h"

#define TILE_LOG2_LEAST 3 /* columns */
#define CELL_BYTES 3u     /* of `far` and `state` */
#define MARGIN 0x2200u    /* of a bucket, in 2^-16: the error of a drawn key (fast/tiles.c) */
_Static_assert(ZS_SIZE_MAX >> TILE_LOG2_LEAST <= 1 << 2 * (ZS_HIZ_LEVELS - 1), "ZS_HIZ_LEVELS");

/* Tiles have the least width for which all levels have room. There is always room for one
 * column of tiles: 4 bytes a row are more than 3 bytes a tile and a third more. */
void zs_hiz_divide(const struct zs_renderer *r, struct zs_hiz *h)
{
    const uint32_t room = (uint32_t)((const uint8_t *)r->bin - (const uint8_t *)r->drawn);
    for (h->log2 = TILE_LOG2_LEAST;; h->log2++) {
        uint32_t columns = (uint32_t)((r->config.width - 1) >> h->log2) + 1u;
        uint32_t rows = (uint32_t)((r->config.strip_h - 1) >> ZS_HIZ_ROWS_LOG2) + 1u;
        h->tiles = columns * rows;
        h->cells = 0;
        for (h->levels = 0;; columns = (columns + 3u) / 4u, rows = (rows + 3u) / 4u) {
            h->first[h->levels] = (uint16_t)h->cells;
            h->columns[h->levels++] = (uint16_t)columns;
            h->cells += columns * rows; /* < 2^18.5 */
            if (columns * rows == 1u)
                break;
        }
        if (h->cells * CELL_BYTES <= room)
            break;
    }
    h->far = (uint16_t *)(void *)r->drawn; /* the first of two pools in succession (core/frame.c) */
    h->state = (uint8_t *)(h->far + h->cells);
    h->due = zs_minu32(1u << (h->log2 + ZS_HIZ_ROWS_LOG2), ZS_HIZ_MANY);
}

void zs_hiz_loosen(struct zs_hiz *h, int32_t tx, int32_t ty)
{
    for (int32_t level = 0; level < h->levels; level++)
        h->far[zs_hiz_cell_of(h, level, tx, ty)] = ZS_DEPTH_CLEAR;
}

/* Lower the bound of a cell that tile (tx, ty) belongs to. */
static void lower(struct zs_hiz *h, int32_t level, int32_t tx, int32_t ty, uint32_t bound)
{
    uint16_t *far = &h->far[zs_hiz_cell_of(h, level, tx, ty)];
    if (bound >= *far)
        return;
    *far = (uint16_t)bound;
    if (level + 1 < h->levels)
        h->state[zs_hiz_cell_of(h, level + 1, tx, ty)] = 1;
}

int zs_hiz_look(const struct zs_renderer *r, struct zs_hiz *h, int32_t tx, int32_t ty, int32_t key)
{
    const struct zs_hiz_place at = zs_hiz_place_of(r, h, tx, ty);
    const uint16_t *row = r->depth + at.y * r->config.width + at.x;
    int32_t most = 0;
    for (int32_t rows = at.rows; rows > 0; rows--, row += r->config.width)
        for (int32_t k = 0; k < at.columns; k++)
            if (row[k] > most) {
                most = row[k];
                if (most > key)
                    return 0;
            }
    lower(h, 0, tx, ty, (uint32_t)most);
    return 1;
}

/* Return the highest bound among the parts of a block. */
static uint32_t highest(const struct zs_hiz *h, int32_t level, int32_t x, int32_t y)
{
    const int32_t below = level - 1, columns = h->columns[below];
    const int32_t n = (h->first[level] - h->first[below]) / columns;
    uint32_t most = 0;
    for (int32_t j = 4 * y; j < zs_min32(4 * y + 4, n); j++)
        for (int32_t i = 4 * x; i < zs_min32(4 * x + 4, columns); i++)
            most = zs_maxu32(most, h->far[h->first[below] + j * columns + i]);
    return most;
}

/* Return 1 if all keys in the cell of tile (tx, ty) are at most `key`. */
static int hides(const struct zs_renderer *r, struct zs_hiz *h, int32_t level, int32_t tx,
                 int32_t ty, int32_t key)
{
    const uint32_t cell = zs_hiz_cell_of(h, level, tx, ty);
    if (level == 0)
        return zs_hiz_hides(r, h, tx, ty, key);
    if (key < h->far[cell] && h->state[cell]) {
        h->state[cell] = 0;
        lower(h, level, tx, ty, highest(h, level, tx >> 2 * level, ty >> 2 * level));
    }
    return key >= h->far[cell];
}

uint32_t zs_hiz_nearest(const struct zs_renderer *r, uint32_t d)
{
    const struct zs_depth *depth = r->view.depth;
    if (r->view.pixelwise > 1)
        return 0; /* no margin holds: nothing is hidden */
    const uint32_t key = depth->key ? depth->key(&r->view, d) : d; /* uq16_16, <= key_top */
    const uint32_t sum = key < MARGIN ? 0x8000u - MARGIN : key + (0x8000u - MARGIN);
    return zs_minu32(sum, r->view.key_top - 0x10000u); /* keys saturate here */
}

int zs_hiz_hides_box(const struct zs_renderer *r, struct zs_hiz *h, const struct zs_box *box)
{
    const int32_t key = (int32_t)(zs_hiz_nearest(r, box->nearest) >> 16);
    const int32_t x0 = zs_max32(box->x0, r->window[0]) >> h->log2,
                  x1 = (zs_min32(box->x1, r->window[1]) - 1) >> h->log2;
    const int32_t y0 = zs_max32(box->y0 - h->y0, 0) >> ZS_HIZ_ROWS_LOG2,
                  y1 = (zs_min32(box->y1 - h->y0, h->rows) - 1) >> ZS_HIZ_ROWS_LOG2;
    if (x0 > x1 || y0 > y1)
        return 0;
    for (int32_t level = h->levels - 1; level >= 0; level--) {
        const int32_t step = 1 << 2 * level;
        int all = 1;
        for (int32_t y = y0 & -step; y <= y1 && all; y += step)
            for (int32_t x = x0 & -step; x <= x1 && all; x += step)
                all = hides(r, h, level, x, y, key);
        if (all)
            return 1;
    }
    return 0;
}
