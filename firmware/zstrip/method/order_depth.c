/* A distance that is linear on the screen, and no depth memory: for methods that sort.
 *
 * Perspective: zs_vertex.d is the key of zs_depth_recip in 16 bits and 16 fraction bits.
 * Orthographic: it is the distance from near, in camera units, below 2^31.6.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/depth.h"
#include "core/fx.h"
#include "zs_method.h"

static ZS_RARE int order_setup(struct zs_view *view, const struct zs_camera *camera, uint32_t bits)
{
    (void)bits; /* precision costs no memory here */
    const int err = view->perspective ? zs_depth_recip.setup(view, camera, 16)
                                      : zs_depth_none.setup(view, camera, 16);
    view->piece_shift = 0; /* no pixel has a key */
    return err;
}

static uint32_t order_vertex(const struct zs_view *view, int32_t z, uint32_t rcp, int32_t lz)
{
    return view->perspective ? zs_depth_recip.vertex(view, z, rcp, lz)
                             : zs_depth_none.vertex(view, z, rcp, lz);
}

static uint64_t order_inverse(const struct zs_view *view, uint32_t d)
{
    return zs_depth_recip.inverse(view, d); /* called for perspective only */
}

static void order_span(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1,
                       uint32_t sum, uint32_t step)
{
    zs_depth_none.span(job, row, i0, i1, sum, step);
}

const struct zs_depth zs_depth_order = {
    .setup = order_setup, .vertex = order_vertex, .inverse = order_inverse, .span = order_span
};
