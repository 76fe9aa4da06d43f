/* Raw colour: RGB565 values from the mesh, unlit.
 *
 * SPDX-License-Identifier: MIT
 */
#include "shade/solid.h"

static uint16_t raw_face(const struct zs_renderer *r, uint32_t t)
{
    const struct zs_instance *in = r->xform.instance;
    const struct zs_rgb *c = &in->material->rgb;
    return zs_wire16(in->mesh->face_raw ? in->mesh->face_raw[t] : zs_rgb565(c->r, c->g, c->b));
}

#if ZS_LEAN
const struct zs_shader zs_shade_raw = { 0, raw_face, 0, zs_solid_run, 0, 0, 0 };
#else
const struct zs_shader zs_shade_raw = { 0, raw_face, zs_solid_rows, 0, zs_solid_span, zs_solid_run, 0, 0,
                                         zs_small_draw, 0 };
#endif
