/* Shaders with a position stage: vertices are where the shader says.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/xform.h"
#include "zs_shader.h"

/* The rows of a mesh with pos_lo are for 1/256 steps (core/xform.c). */
void zs_positions_place(const struct zs_xform *xf, uint32_t v, struct zs_point *out)
{
    static const uint8_t whole[3] = { 0, 0, 0 };
    const struct zs_renderer *const r =
        (const struct zs_renderer *)(const void *)((const uint8_t *)xf -
                                                   offsetof(struct zs_renderer, xform));
    const int32_t *row = xf->row;
    int16_t p[3];
    xf->instance->material->shader->position(&r->shading, v, p);
    for (int k = 0; k < 3; k++, row += ZS_ROW_WORDS)
        out->c[k] = zs_xform_fine(row, p, xf->instance->mesh->pos_lo ? whole : 0);
}
