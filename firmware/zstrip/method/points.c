/* Points: squares on the screen, each clipped as a whole by its vertex.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/fx.h"
#include "core/primitive.h"
#include "method/quad.h"
#include "zs_lines.h"
#include "zs_shader.h"

static const struct zs_points *points_of(const struct zs_instance *in)
{
    return (const struct zs_points *)(const void *)in->material->primitive;
}

static enum zs_outcome point_assemble(struct zs_renderer *r, uint32_t t, uint32_t *piece)
{
    const struct zs_instance *in = r->xform.instance;
    const struct zs_points *points = points_of(in);
    const struct zs_shader *shader = in->material->shader;
    const uint32_t v = points->point ? points->point[t] : t;
    const int32_t cx = r->view.cx, cy = r->view.cy;
    const int32_t half = zs_quad_width(points->size) * ZS_SUBPX_HALF;
    struct zs_end end;
    struct zs_quad quad;
    if (v >= in->mesh->n_verts)
        return ZS_OUTCOME_INDEX;
    r->stats.verts_transformed++;
    zs_xform_screen(r, v, &end.v);
    if (end.v.d >= ZS_D_OUT)
        return zs_outcome_outside(end.v.d & ~ZS_D_OUT);
    if (zs_abs32(end.v.x - cx) > ZS_QUAD_GUARD || zs_abs32(end.v.y - cy) > ZS_QUAD_GUARD)
        return ZS_OUTCOME_OFFSCREEN;
    if (shader->vertex)
        shader->vertex(&r->shading, v, end.attr);
    for (int k = 0; k < 4; k++) {
        quad.v[k].x = end.v.x + (k == 1 || k == 2 ? half : -half);
        quad.v[k].y = end.v.y + (k >= 2 ? half : -half);
        quad.v[k].d = end.v.d;
        quad.from[k] = &end;
    }
    const enum zs_outcome outcome = zs_quad_bin(r, &quad, t, 0, piece);
    if (outcome != ZS_OUTCOME_FULL)
        *piece = 0;
    return outcome;
}

static int points_widen(const struct zs_renderer *r, const struct zs_instance *in,
                        struct zs_bounds *b)
{
    return zs_quad_widen(r, in, points_of(in)->size, b);
}

const struct zs_primitive_ops zs_points_ops = { .assemble = point_assemble,
                                                .widen = points_widen };
