/* No depth memory: a triangle is drawn over the earlier ones.
 *
 * zs_vertex.d is the distance, which perspective-correct attributes need.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/depth.h"
#include "core/fx.h"
#include "core/rows.h"
#include "zs_shader.h"

ZS_RARE int zs_none_setup(struct zs_view *view, const struct zs_camera *camera, uint32_t bits)
{
    (void)camera;
    view->screen_linear = 1;
    view->pixelwise = 0;
    view->piece_shift = 0;
    view->key_top = ((1u << bits) - 1u) << 16;
    view->piece_base = view->key_top + 0xffffu;
    view->key_far = 0;
    view->key_slow = view->key_known = 0;
    return ZS_OK;
}

uint32_t zs_none_vertex(const struct zs_view *view, int32_t z, uint32_t rcp, int32_t lz)
{
    (void)rcp;
    (void)lz;
    return (uint32_t)z - (view->perspective ? 0u : (uint32_t)view->z_near); /* < 2^31.6 */
}

/* z >= 2^8: at most 2^54 */
static uint64_t none_inverse(const struct zs_view *view, uint32_t d)
{
    (void)view;
    return ((uint64_t)1 << 62) / d;
}

void zs_none_span(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1,
                  uint32_t sum, uint32_t step)
{
    (void)sum;
    (void)step;
    zs_rows_written(job, i1 - i0);
    job->shader->run(job, row, i0, i1);
}

const struct zs_depth zs_depth_none = {
    .setup = zs_none_setup, .vertex = zs_none_vertex, .inverse = none_inverse, .span = zs_none_span
};
