/* Raw colour: RGB565 values from the mesh, unlit.
 *
 * SPDX-License-Identifier: MIT
 */
#include "zs_shader.h"
#include "shade/stages.h"

uint16_t zs_raw_face(const struct zs_shading *s, uint32_t t)
{
    const struct zs_instance *in = s->instance;
    const struct zs_rgb *c = &in->material->rgb;
    return zs_wire16(in->mesh->face_raw ? in->mesh->face_raw[t] : zs_rgb565(c->r, c->g, c->b));
}

const struct zs_shader zs_shade_raw = { .face = zs_raw_face, .run = zs_solid_run,
                                      .opaque = ZS_RAW };
