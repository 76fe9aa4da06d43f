/* What a depth mapping is. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_DEPTH_H
#define ZS_DEPTH_H

#include "zstrip.h"

struct zs_job;
struct zs_row;

struct zs_depth {
    /* Constants of a frame into view->key_*. ZS_OK; ZS_ERR_DEPTH: not with this camera. */
    int (*setup)(struct zs_view *view, const struct zs_camera *camera, uint32_t bits);
    /* zs_vertex.d of a distance, near <= z <= far, camera units. Under perspective rcp is
     * 2^(63 - lz) / z with lz the leading zeros of z; orthographic: of no use. */
    uint32_t (*vertex)(const struct zs_view *view, int32_t z, uint32_t rcp, int32_t lz);
    /* Where view.screen_linear is 0. 1: keys are linear on this triangle all the same. 0: they are
     * not; row draws it then. */
    int (*planes)(struct zs_job *job);
    /* Where planes has returned 0: zs_depth_walk, and a row of it, by job->piece. */
    void (*walk)(struct zs_job *job);
    void (*row)(struct zs_job *job, const struct zs_row *row);
    /* Under perspective, w ~ 1/z of a vertex for perspective-correct attributes, 1 .. 2^62, same
     * scale for all. */
    uint64_t (*inverse)(const struct zs_view *view, uint32_t d);
    /* Or, where this is not NULL, of a triangle's vertices: the largest brought to [2^30, 2^31). */
    void (*inverses)(const struct zs_view *view, const struct zs_vertex *const v[3], uint32_t w[3]);
    /* The key of a vertex, uq16_16, where zs_vertex.d is something else; NULL: d is the key. */
    uint32_t (*key)(const struct zs_view *view, uint32_t d);
    /* Where there is no depth memory: colours pixels in place of zs_rows_test, as zs_piece_fn.
     * NULL: there is. */
    void (*span)(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1, uint32_t sum,
                 uint32_t step);
};

/* All rows of a job, each by the mapping's row: depth/curved.c. */
void zs_depth_walk(struct zs_job *job);

#endif
