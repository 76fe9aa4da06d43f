/* Ray casting: what its three files share. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_METHOD_RAYCAST_H
#define ZS_METHOD_RAYCAST_H

#include "core/job.h"

struct zs_fast_clusters;

#define ZS_RAY_CHILDREN_LOG2 2
#define ZS_RAY_CHILDREN (1u << ZS_RAY_CHILDREN_LOG2)
#define ZS_RAY_LEVELS 8 /* 4^8 boxes */

struct zs_ray_box {
    int16_t x0, x1, y0, y1; /* columns [x0, x1), rows [y0, y1) of the frame: |.| <= 2^14 + 1 */
    uint16_t near;          /* the least key in it plus 1; 0: not known */
    uint16_t tri;           /* level 0: number of the triangle in the pool */
};
_Static_assert(sizeof(struct zs_ray_box) == sizeof(struct zs_tri),
               "boxes and triangles share a pool");

/* A ray's state: what a depth buffer and the pixel's colour would say of the triangles so far. */
struct zs_ray_seen {
    uint32_t key; /* ZS_DEPTH_CLEAR: none was written */
    uint32_t box; /* of the triangle, at level 0; ZS_NIL: the background */
};

struct zs_rays {
    int32_t x, x_end, y, y_end; /* the region: columns and rows of the frame */
    struct zs_ray_seen first;   /* what rays begin with. Not empty only in a region of a pixel */
    uint16_t list;              /* visible triangles */
    uint8_t levels;
    uint8_t states;                /* 1: some triangle has a depth state */
    uint16_t count[ZS_RAY_LEVELS]; /* number of boxes of a level */
    struct zs_ray_box *level[ZS_RAY_LEVELS];
    struct zs_plane *plane; /* [n_planes]: keys of the first triangles, at pixel 0, 0 ... */
    uint32_t n_planes;
    uint32_t node;  /* the current instance's next node */
    int32_t column; /* for keys that are not linear: a pixel's column, and its key */
    uint32_t sum;
#if ZS_STATS
    /* counted, and cleared by who reads them: */
    struct zs_ray_counts {
        uint32_t boxes; /* that rays were tested against */
        uint32_t boxed; /* triangles in whose box a ray is */
        uint32_t sides; /* edges that it was tested against */
        uint32_t aims, wide, pieces; /* set-ups for a key, those of wide triangles, and pieces of
                                        rows for keys that are not linear */
    } counted;
#endif
};

/* zs_tri.next while rays are cast: flags. */
#define ZS_RAY_HIT 1u   /* a ray has hit the triangle */
#define ZS_RAY_KNOWN 2u /* its plane is known */

/* rays.c: set the box of triangle t of the pool. */
void zs_rays_box(struct zs_ray_box *b, const struct zs_renderer *r, uint32_t t);
/* Build the boxes of a list of triangles from `at` on, and clear the triangles' flags. */
void zs_rays_build(struct zs_renderer *r, struct zs_rays *s, struct zs_ray_box *at, uint16_t list);
/* Cast the rays of the region, and keep what they hit in the depth memory: numbers of triangles,
 * which get ZS_RAY_HIT; or keys. Return what the last ray has seen. */
struct zs_ray_seen zs_rays_cast(struct zs_renderer *r, const struct zs_rays *s, int keys);
/* r->span: colour the pixels of the region whose rays have hit this triangle. */
zs_piece_fn zs_rays_span;

/* ray_nodes.c: leave out triangles by the meshes' hierarchies. */
extern const struct zs_fast_clusters zs_ray_nodes;

#endif
