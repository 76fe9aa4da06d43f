/* Accelerators: hooks that override a stage of the core where a special case is faster. With or
 * without them, every frame is the same, bit for bit.
 *
 * An accelerator is a const struct zs_fast of optional hooks. It is used, and linked, only if
 * zs_config.fast names it (zs_fast.h has the lists). A hook that returns 0 has declined; the core
 * then does the work itself. It has changed nothing that the core does not set anew.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_FAST_HOOKS_H
#define ZS_FAST_HOOKS_H

#include "arch/wide.h"
#include "zstrip.h"

/* A hook, or a value that only accelerators set. It is the constant 0 if the library is compiled
 * without accelerators, so that code that depends on it is removed. */
#define ZS_IF_FAST(hook) (ZS_NO_FAST ? 0 : (hook))

/* What a set-up says. */
enum zs_set_up {
    ZS_SET_UP_NOT = 0,  /* declined */
    ZS_SET_UP_NONE = 1, /* no row in the strip; job->tri_end is set */
    ZS_SET_UP_ROWS = 2  /* keys are linear; all is set but the columns */
};

struct zs_bounds;
struct zs_job;
struct zs_row;
struct zs_texel_rows;
struct zs_texture_hand;

/* First touch: a strip is not cleared before it is drawn. The first triangle at an uncleared pixel
 * is drawn without a depth test. */
struct zs_fast_touch {
    /* Called before anything is drawn into r->strip. Sets r->untouched. */
    void (*begin)(struct zs_renderer *r);
    /* Clear the pixels that are still uncleared. r->untouched is 0 afterwards. */
    void (*end)(struct zs_renderer *r);
    /* Called for each triangle while r->untouched is not 0. Return 1: job->tri is drawn with first
     * touch, and job->split is set. Return 0: no pixel is uncleared any more. */
    int (*takes)(struct zs_job *job);
    /* For a triangle with first touch: called once for each scanline, before its pieces. */
    void (*row)(struct zs_job *job, const struct zs_row *row);
    /* Draw a piece of such a scanline: uncleared pixels directly, the others through job->span.
     * Arguments as zs_piece_fn. */
    void (*piece)(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1,
                  uint32_t sum, uint32_t step);
};

/* Occlusion culling: triangles and instances that what is nearer hides. */
struct zs_fast_tiles {
    /* Called for each triangle of the current instance that core/assemble.c or core/fan.c takes and
     * that is not culled; a, b, c are clockwise. If it is large, record which tiles it covers and
     * how far, and set r->large. */
    void (*cover)(struct zs_renderer *r, const struct zs_vertex *a, const struct zs_vertex *b,
                  const struct zs_vertex *c);
    /* Called for r->strip if r->large is set. Return a depth: `hides` is asked about triangles
     * alone whose vertices all lie beyond it. UINT32_MAX: no triangle of the strip is hidden. */
    uint32_t (*seen)(struct zs_renderer *r);
    /* Return 1 if no pixel of job->tri can pass the depth test in this strip. */
    int (*hides)(struct zs_job *job);
    /* Return 1 if no pixel inside a bounding sphere can pass the depth test in a strip that is
     * still to be drawn. */
    int (*hides_sphere)(struct zs_renderer *r, const struct zs_bounds *b);
    /* After so many triangles in succession that are not hidden, no more are asked about in the
     * strip. */
    int32_t in_vain;
};

/* Fetch n texels; at[k] is row * width + column. */
typedef void zs_gather_fn(const struct zs_texture *texture, uint16_t *out, int32_t n,
                          const uint32_t *at);

/* The inner loops of a texel format. */
struct zs_fast_texel {
    zs_gather_fn *gather;
    /* Test and draw a triangle: unlit, affine, texture repeated, log2_w and log2_h > 0, keys that
     * do not saturate. */
    void (*rows)(struct zs_job *job);
    /* Test and draw a small triangle from its record alone (fast/small.h), unlit and lit. */
    void (*small)(struct zs_job *job, const struct zs_texture *texture, struct zs_texel_rows *rows);
    void (*small_lit)(struct zs_job *job, const struct zs_texture *texture,
                      struct zs_texel_rows *rows);
};

/* Whole meshes at a time. */
struct zs_fast_batch {
    /* Find out which clip tests the instance of r->xform needs; set r->xform.clip_*. */
    void (*needs)(struct zs_renderer *r, const struct zs_bounds *b);
    /* Called before the triangles of an instance are binned: set r->batched if `bin` does it. If
     * the pool has room for all its vertices, transform them and set r->direct. */
    void (*open)(struct zs_renderer *r);
    /* Bin triangles [from, end) if r->batched is set, and count their outcomes in outcome[]. Return
     * the triangle that it reached; less than end if a pool is full. *piece is that triangle's, as
     * in zs_assemble_tri. */
    uint32_t (*bin)(struct zs_renderer *r, uint32_t from, uint32_t end, uint32_t *outcome,
                    uint32_t *piece);
    /* A pool was full at triangle t of the current instance, and the method has made room. */
    void (*full)(struct zs_renderer *r, uint32_t t);
    /* A pool is full at triangle t of the current instance, and r->parts_tris is set. Return 1 if
     * there is room now. */
    int (*spare)(struct zs_renderer *r, uint32_t t);
    /* Called for each instance in a walk, in order, if r->parts_tris is set. Return 1 if it does
     * not reach the band. */
    int (*beside)(struct zs_renderer *r, uint32_t number);
    /* zs_xform_screen for n vertices from v on. */
    void (*screen)(const struct zs_renderer *r, uint32_t v, uint32_t n, struct zs_vertex *out);
};

/* Culling of a mesh's clusters. */
struct zs_fast_clusters {
    /* Set r->edge to the rows and columns in which this walk draws an instance. Return 0 if
     * the instance lies outside of them and need not be drawn. */
    int (*edges)(struct zs_renderer *r, const struct zs_bounds *b, uint32_t number);
    /* Fill r->clusters for the instance of r->xform. Return 0 if none of its clusters can be
     * culled. */
    int (*open)(struct zs_renderer *r, const struct zs_bounds *b);
    /* Called while vertex v is vert[vert_base + v]: transform the vertices that are needed. Return
     * 0 if all are needed; none is transformed then. */
    int (*verts)(struct zs_renderer *r);
    /* Set r->clusters.from and .end to the next run of triangles. Return 0 if there is none. */
    int (*run)(struct zs_renderer *r);
};

struct zs_fast {
    /* Hooks of the frame. For each of them, the first accelerator in the list that has it is used.
     */
    const struct zs_fast_touch *touch;
    const struct zs_fast_tiles *tiles;
    const struct zs_fast_batch *batch;
    const struct zs_fast_clusters *clusters;
    int (*edges)(struct zs_job *job, int32_t row); /* in place of zs_edges_columns */
    zs_divided_fn *divided; /* of all textured shaders */
#if ZS_SET_UP
    /* In place of set-up but for the columns, with the plane of the keys. job->v and job->key need
     * not be kept where it declines. */
    enum zs_set_up (*set_up)(struct zs_job *job);
#endif

    /* Hooks for triangles of one shader: the first accelerator in the list that names it is used.
     * A shader without varyings that none names takes the last one whose shader has its `run`. */
    const struct zs_shader *shader;
    /* In place of set-up and rasterisation: draw job->tri in its strip. Called if the triangle has
     * no depth state (or zs_fast_moves holds), its keys may be linear, and no pixel of the strip is
     * uncleared. Sets job->tri_end if it returns 1. Where job->chain is set (ZS_CHAIN_USED), it may
     * also draw the triangles that follow in the list, while they are of the same instance and end
     * in this strip; it leaves job->tri at the last one that it has drawn. Where ZS_CHAIN_KEEPS is
     * 1, those before the last may go on below the strip: it appends them to job->keep. If it
     * declines one of those that follow, job->tri_end is job->y1: the last one has been appended as
     * well. */
    int (*draw)(struct zs_job *job);
#if ZS_SET_UP
    /* In place of shader->start. */
    int (*start)(struct zs_job *job);
#endif
    /* In place of the walk over scanlines: draw a job that is set up. Called if its keys are linear
     * and job->split is 0. */
    int (*rows)(struct zs_job *job);
    /* In place of zs_rows_test: test pixels [i0, i1) of a scanline and colour those that pass. */
    void (*span)(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1, uint32_t sum,
                 uint32_t step);

    /* Textured shaders: return a copy of the texture with a lit palette, or the texture itself. */
    const struct zs_texture *(*lit)(struct zs_job *job, const struct zs_texture *texture);
    /* Loops of one texel format. */
    const struct zs_texel *format;
    const struct zs_fast_texel *texel;

#if ZS_V7M
    /* Textured shaders with light: light a triangle that zs_texture_v7m has set up. Return 0: it is
     * declined; 1: it has been drawn; 2: it is to be drawn with h->of.palette and without light. */
    int (*shine)(struct zs_job *job, struct zs_texture_hand *h);
#endif
};

#endif
