/* The interface of a depth mapping. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_DEPTH_H
#define ZS_DEPTH_H

#include "zstrip.h"

struct zs_job;
struct zs_row;
struct zs_screen_of;

struct zs_depth {
    /* Compute the constants of a pass: screen_linear, pixelwise, piece_shift, piece_base, key_top,
     * key_far, key_slow and key_known of the view, each of them, as the pass before may have left
     * others; and what else the mapping reads. Return ZS_OK, or ZS_ERR_DEPTH if the mapping cannot
     * be used with this camera. */
    int (*setup)(struct zs_view *view, const struct zs_camera *camera, uint32_t bits);
    /* Return zs_vertex.d for a distance, near <= z <= far, camera units. Perspective: lz is the
     * number of leading zeros of z, and rcp is 2^(63 - lz) / z. Orthographic: rcp and lz say
     * nothing about z. */
    uint32_t (*vertex)(const struct zs_view *view, int32_t z, uint32_t rcp, int32_t lz);
    /* If not NULL, called in place of vertex for many of them, by fast/screen.c: project vertices
     * from `at` on, which are in camera units, for a perspective camera with all sub-pixel bits.
     * Return `end`, or the first one that is not between near and far, or not near the middle. */
    struct zs_vertex *(*vertices)(const struct zs_screen_of *of, struct zs_vertex *at,
                                  struct zs_vertex *end);
    /* Called if view.screen_linear is 0. Return 1 if keys are linear on this triangle all the same;
     * 0 if they are not: walk then draws the triangle. */
    int (*planes)(struct zs_job *job);
    /* Draw a triangle for which planes returned 0. walk is zs_depth_walk; it calls row for each
     * scanline, which calls job->piece. */
    void (*walk)(struct zs_job *job);
    void (*row)(struct zs_job *job, const struct zs_row *row);
    /* Perspective: return w, proportional to 1/z, of a vertex, for perspective-correct attributes.
     * 1 .. 2^62; the scale is the same for all vertices. */
    uint64_t (*inverse)(const struct zs_view *view, uint32_t d);
    /* If not NULL, called in place of inverse: compute w of a triangle's three vertices, scaled so
     * that the largest is in [2^30, 2^31). */
    void (*inverses)(const struct zs_view *view, const struct zs_vertex *const v[3], uint32_t w[3]);
    /* Return the key of a vertex, uq16_16, if zs_vertex.d is something else. NULL: d is the key. */
    uint32_t (*key)(const struct zs_view *view, uint32_t d);
    /* For a mapping without depth memory: colour pixels without a depth test, in place of
     * zs_rows_test; arguments as zs_piece_fn. NULL: the mapping has depth memory. */
    void (*span)(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1, uint32_t sum,
                 uint32_t step);
};

/* Functions of zs_depth_recip and zs_depth_none that a mapping of a method shares, and of the float
 * mappings for depth/float_v7m.c. */
int zs_recip_setup(struct zs_view *view, const struct zs_camera *camera, uint32_t bits);
uint32_t zs_recip_vertex(const struct zs_view *view, int32_t z, uint32_t rcp, int32_t lz);
uint32_t zs_float_vertex(const struct zs_view *view, int32_t z, uint32_t rcp, int32_t lz);
uint64_t zs_recip_inverse(const struct zs_view *view, uint32_t d);
int zs_none_setup(struct zs_view *view, const struct zs_camera *camera, uint32_t bits);
uint32_t zs_none_vertex(const struct zs_view *view, int32_t z, uint32_t rcp, int32_t lz);
void zs_none_span(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1,
                  uint32_t sum, uint32_t step);

/* Draw all scanlines of a job with the mapping's row function (depth/curved.c). */
void zs_depth_walk(struct zs_job *job);

#endif
