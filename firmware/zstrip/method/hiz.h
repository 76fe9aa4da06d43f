/* The hierarchical depth buffer: upper bounds of the keys in tiles of a strip, in blocks of 4x4
 * tiles, of 4x4 blocks, up to the strip. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_HIZ_H
#define ZS_HIZ_H

#include "core/cull.h"
#include "core/fx.h"

#define ZS_HIZ_ROWS_LOG2 3
#define ZS_HIZ_ROWS (1 << ZS_HIZ_ROWS_LOG2)
#define ZS_HIZ_LEVELS 6 /* 512 columns of tiles at most, four times fewer in each level */

/* State of a tile: the pixels drawn in it since its keys were looked at, up to MANY, or one of the
 * other two. State of a block: 1: the bound of one of its parts became lower. */
enum zs_hiz_state {
    ZS_HIZ_MANY = 253,
    ZS_HIZ_COVERED = 254, /* drawn by zs_hiz.cover, without a depth test */
    ZS_HIZ_FRESH = 255    /* nothing is drawn there, and it is not cleared */
};

struct zs_hiz {
    uint16_t *far;  /* [cells], level by level: upper bounds of the keys */
    uint8_t *state; /* [cells] */
    uint16_t columns[ZS_HIZ_LEVELS], first[ZS_HIZ_LEVELS]; /* cells in a row; the first cell */
    int32_t levels;
    uint32_t tiles, cells;      /* of a strip: cells of level 0, and of all */
    int32_t log2;               /* columns of a tile */
    int32_t y0, rows;           /* of the strip: the frame's row, and how many */
    uint32_t due;               /* look at a tile's keys after so many pixels */
    const struct zs_tri *cover; /* the triangle that COVERED tiles are of */
    const struct zs_tri *of;    /* `nearest` is of this triangle */
    uint32_t nearest;           /* uq16_16: no key of it is below */
};

/* The columns and rows of a tile in its strip. */
struct zs_hiz_place {
    int32_t x, y, columns, rows;
};

static inline struct zs_hiz_place zs_hiz_place_of(const struct zs_renderer *r,
                                                  const struct zs_hiz *h, int32_t tx, int32_t ty)
{
    struct zs_hiz_place at = { tx << h->log2, ty << ZS_HIZ_ROWS_LOG2, 0, 0 };
    at.columns = zs_min32(r->config.width - at.x, 1 << h->log2);
    at.rows = zs_min32(h->rows - at.y, ZS_HIZ_ROWS);
    return at;
}

/* The cell of a level that tile (tx, ty) belongs to. */
static inline uint32_t zs_hiz_cell_of(const struct zs_hiz *h, int32_t level, int32_t tx, int32_t ty)
{
    return h->first[level] + (uint32_t)(ty >> 2 * level) * h->columns[level] +
           (uint32_t)(tx >> 2 * level);
}

/* The state of a tile that was looked at, or cleared. A tile at an edge of the frame or the strip
 * has less pixels, and begins with those that it lacks. */
static inline uint8_t zs_hiz_seen(const struct zs_renderer *r, const struct zs_hiz *h, int32_t tx,
                                  int32_t ty)
{
    const struct zs_hiz_place at = zs_hiz_place_of(r, h, tx, ty);
    return (uint8_t)zs_max32((int32_t)h->due - at.columns * at.rows, 0);
}

/* Find the memory of the bounds, and how wide tiles are. Bounds and states are not set. */
void zs_hiz_divide(const struct zs_renderer *r, struct zs_hiz *h);
/* The keys of a tile may have grown. */
void zs_hiz_loosen(struct zs_hiz *h, int32_t tx, int32_t ty);
/* Look at a tile's keys. Return 1 if none is above `key`; the bound is then exact. */
int zs_hiz_look(const struct zs_renderer *r, struct zs_hiz *h, int32_t tx, int32_t ty, int32_t key);
/* Return a key that no pixel's key is below, in uq16_16, for a triangle with a nearest depth. */
uint32_t zs_hiz_nearest(const struct zs_renderer *r, uint32_t d);
/* Return 1 if nothing in a box of the frame can win a pixel of the strip. */
int zs_hiz_hides_box(const struct zs_renderer *r, struct zs_hiz *h, const struct zs_box *box);

/* Return 1 if all keys in a tile are at most `key`; < 0: nothing is. */
static inline int zs_hiz_hides(const struct zs_renderer *r, struct zs_hiz *h, int32_t tx,
                               int32_t ty, int32_t key)
{
    const uint32_t tile = zs_hiz_cell_of(h, 0, tx, ty);
    if (key >= h->far[tile])
        return 1;
    if (h->state[tile] < h->due || h->state[tile] == ZS_HIZ_FRESH || key < 0)
        return 0;
    h->state[tile] = zs_hiz_seen(r, h, tx, ty);
    return zs_hiz_look(r, h, tx, ty, key);
}

#endif
