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
    const int err = view->perspective ? zs_recip_setup(view, camera, 16)
                                      : zs_none_setup(view, camera, 16);
    view->piece_shift = 0; /* no pixel has a key */
    return err;
}

static uint32_t order_vertex(const struct zs_view *view, int32_t z, uint32_t rcp, int32_t lz)
{
    return view->perspective ? zs_recip_vertex(view, z, rcp, lz)
                             : zs_none_vertex(view, z, rcp, lz);
}

/* inverse is called for perspective only */
const struct zs_depth zs_depth_order = { .setup = order_setup,
                                         .vertex = order_vertex,
                                         .inverse = zs_recip_inverse,
                                         .span = zs_none_span };
