/* The loop over a mesh's triangles (fast/batch.c). Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_FAST_SWEEP_H
#define ZS_FAST_SWEEP_H

#include "zstrip.h"
#include "core/fx.h"

/* What the loop over a mesh's triangles needs, in memory: registers are for the
 * triangle in hand. Some are loaded two at a time. */
struct zs_sweep {
    struct zs_renderer *r;
    const struct zs_vertex *pool; /* what triangles' numbers count from, ... */
    uint32_t n_verts;             /* ... and are below */
    int32_t keep;                 /* 1, -1 or 0: area * keep < 0 means culled by its facing */
    int32_t x, x_end;             /* columns that are drawn: r->walk_x, r->walk_end */
    uint32_t row, rows; /* of the frame: the first that is drawn in the band, and how many */
    uint32_t strip_mul, strip_shift;
    uint16_t *bin;
    uint32_t n;    /* number of the next record */
    uint16_t base; /* number of `pool` in the vertex pool */
    uint16_t instance;
    uint32_t varyings; /* of a vertex; 0: they are not computed */
    uint16_t (*face)(const struct zs_shading *s, uint32_t tri);
    struct zs_tri *out, *full; /* the next record; one beyond the pool's last */
    uint32_t placed;    /* modulo 2^32: placed + n is how many triangles place() has binned */
    uint32_t before;    /* at first: the sum of outcomes less the number of the first triangle */
    uint32_t *outcome;     /* [ZS_OUTCOMES]: counts of outcomes */
    uint8_t by_batches; /* flags: the loop leaves slow cases to zs_batch_bin(); ... */
    uint8_t full_verts; /* ... a batch has no room for a vertex of its first triangle */
    uint32_t *piece;    /* of a clipped triangle, as in zs_assemble_tri */
    int32_t y0, y1;     /* rows of the triangles that are in no strip of the band */
#if ZS_V7M
    const uint16_t *raw; /* mesh.face_raw in place of `face`; NULL: that */
#endif
};

/* A core with a loop by hand takes the one in C for what is rare. */
#if ZS_SET_UP || ZS_V7M
#define SWEEP_PART ZS_NOINLINE
#define SWEEP_EACH ZS_RARE ZS_NOINLINE
int zs_sweep_outside(struct zs_sweep *s, const uint16_t index[3]);
uint32_t zs_sweep_aside(struct zs_sweep *s, int32_t empty, int32_t y0, int32_t y1);
uint32_t zs_sweep_each(struct zs_sweep *s, uint32_t t, uint32_t end, const uint16_t (*tri)[3]);
uint32_t zs_sweep_by_hand(struct zs_sweep *s, uint32_t t, uint32_t end, const uint16_t (*tri)[3]);
void zs_sweep_attributes(const struct zs_sweep *s, const struct zs_tri *of);
uint32_t zs_sweep_turned(struct zs_sweep *s, uint32_t t, uint32_t end, const uint16_t (*tri)[3]);
#else
#define SWEEP_PART static ZS_NOINLINE
#define SWEEP_EACH ZS_ALWAYS_INLINE
#endif

/* zs_fast_batch.open without the transform: set r->batched; if the pool has room for all vertices
 * of the current mesh, r->direct, and take the room. Return r->direct. */
int zs_batch_room(struct zs_renderer *r);
/* zs_fast_batch.bin. */
uint32_t zs_batch_bin(struct zs_renderer *r, uint32_t from, uint32_t end, uint32_t *outcome,
                      uint32_t *piece);

#endif
