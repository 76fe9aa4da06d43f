/* Accelerators: what overrides a stage of the core where that is quicker. Without any, every frame
 * is the same, bit for bit.
 *
 * Each is a const struct zs_fast of optional hooks, named in zs_config.fast and linked only then
 * (zs_fast.h has the lists). A hook that returns 0 has declined and changed nothing: the core goes
 * on.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_FAST_HOOKS_H
#define ZS_FAST_HOOKS_H

#include "zstrip.h"

/* What an accelerator has set or given; 0 where the library is compiled without them, so that what
 * depends on it is not linked. */
#define ZS_IF_FAST(hook) (ZS_NO_FAST ? 0 : (hook))

struct zs_bounds;
struct zs_job;
struct zs_row;
struct zs_texel_rows;

/* Pixels of a strip that nothing was drawn on yet: not cleared before they are drawn, and not
 * tested. */
struct zs_fast_touch {
    void (*begin)(
        struct zs_renderer *r); /* before anything is drawn into r->strip; sets r->untouched */
    void (*end)(struct zs_renderer *r); /* clears what nothing was drawn on; r->untouched is 0 */
    /* While r->untouched: 1: job->tri is drawn on such pixels, job->split says so. 0: none are
     * left. */
    int (*takes)(struct zs_job *job);
    void (*row)(
        struct zs_job *job,
        const struct zs_row *row); /* of a triangle that it takes: once, before the row's pieces */
    /* Draw a piece of such a row; what was drawn on before goes to job->span. As zs_piece_fn. */
    void (*piece)(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1,
                  uint32_t sum, uint32_t step);
};

/* What large triangles hide. */
struct zs_fast_tiles {
    /* A triangle of the current instance that is drawn, clockwise: what it hides, if it is large.
     * Sets r->large. */
    void (*cover)(struct zs_renderer *r, const struct zs_vertex *a, const struct zs_vertex *b,
                  const struct zs_vertex *c);
    /* Of r->strip, where r->large: a depth up to which a vertex shows that its triangle is not
     * hidden; UINT32_MAX: none is. */
    uint32_t (*seen)(struct zs_renderer *r);
    int (*hides)(struct zs_job *job); /* 1: no pixel of job->tri can win in this strip */
    int (*hides_sphere)(
        struct zs_renderer *r,
        const struct zs_bounds *b); /* 1: nothing in it can win in a strip to come */
};

/* A texel format's loops. */
struct zs_fast_texel {
    void (*gather)(const struct zs_texture *texture, uint16_t *out, int32_t n,
                   const uint32_t *at); /* by row * width + column */
    /* Test and draw a triangle, unlit, affine, repeated, log2_w and log2_h > 0, keys that do not
     * saturate. */
    void (*rows)(struct zs_job *job);
    /* Test and draw a small triangle from its record alone (fast/small.h), unlit and lit. */
    void (*small)(struct zs_job *job, const struct zs_texture *texture, struct zs_texel_rows *rows);
    void (*small_lit)(struct zs_job *job, const struct zs_texture *texture,
                      struct zs_texel_rows *rows);
};

/* Meshes in batches. */
struct zs_fast_batch {
    void (*needs)(struct zs_renderer *r,
                  const struct zs_bounds
                      *b); /* of the instance that r->xform is for: clip tests, to r->xform */
    /* Before an instance's triangles are binned: its vertices, where all have room; then sets
     * r->direct. */
    void (*open)(struct zs_renderer *r);
    /* Bin triangles [from, end), where r->direct; fate as walk.c counts. Return how far it came:
     * less than end, where a pool is full, or it declined. *piece: of the triangle that it came to,
     * as zs_assemble_tri. */
    uint32_t (*bin)(struct zs_renderer *r, uint32_t from, uint32_t end, uint32_t *fate,
                    uint32_t *piece);
    void (*screen)(const struct zs_renderer *r, uint32_t v, uint32_t n,
                   struct zs_vertex *out); /* zs_xform_screen of several */
};

/* Clusters of a mesh that need not be drawn. */
struct zs_fast_clusters {
    /* Find the rows and columns that the walk draws of an instance, to r->edge. Return 0: it need
     * not be drawn, as it is in none of them. */
    int (*edges)(struct zs_renderer *r, const struct zs_bounds *b, uint32_t number);
    /* Fill r->clusters for the instance that r->xform is for. Return 0: there is nothing that could
     * be left out. */
    int (*open)(struct zs_renderer *r, const struct zs_bounds *b);
    /* Where vertex v has place vert_base + v: transform those that are needed. Return 0: all are,
     * none is done. */
    int (*verts)(struct zs_renderer *r);
    /* The next run of triangles to r->clusters.from and .end. Return 0: there is none. */
    int (*run)(struct zs_renderer *r);
};

struct zs_fast {
    /* Of the frame. The first of a list that has a hook serves it. */
    const struct zs_fast_touch *touch;
    const struct zs_fast_tiles *tiles;
    const struct zs_fast_batch *batch;
    const struct zs_fast_clusters *clusters;
    int (*edges)(struct zs_job *job, int32_t row); /* zs_edges_cut */

    /* Of triangles of one shader. */
    const struct zs_shader *shader;
    /* In place of set-up and rows: draw job->tri in its strip. Called where it has no depth state,
     * keys may be linear on it and no pixel of the strip is untouched. Sets job->row_last where it
     * returns 1. */
    int (*draw)(struct zs_job *job);
    /* In place of walking rows: draw job, which is set up. Called where keys are linear, and rows
     * are not split. */
    int (*rows)(struct zs_job *job);
    /* In place of zs_rows_test: test pixels [i0, i1) of a row and colour those that are nearest. */
    void (*span)(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1, uint32_t sum,
                 uint32_t step);

    /* Textured: a texture with its palette lit, or the same one. */
    const struct zs_texture *(*lit)(struct zs_job *job, const struct zs_texture *texture);
    /* Pixels [i, end) of a row, each as zs_texture_pixel draws it. Called where job->texel is
     * known, the texture is repeated and 15 bits place its texels. */
    void (*divided)(struct zs_job *job, const struct zs_row *row, int32_t i, int32_t end);

    /* Of one texel format. */
    const struct zs_texel *format;
    const struct zs_fast_texel *texel;
};

#endif
