/* Flat shading: one normal and one lit colour for each face.
 *
 * SPDX-License-Identifier: MIT
 */
#include "zs_shader.h"
#include "shade/stages.h"

/* Return a lit channel as a code, 0 .. most, rounded to nearest. most <= 63 */
static uint32_t code(uint8_t channel, uint32_t light, uint32_t most)
{
    /* < 2^22; t / 65535 by two shifts */
    const uint32_t t = zs_light_channel(channel, light) * most + 0x8000u;
    return (t + (t >> 16)) >> 16;
}

uint16_t zs_flat_face(const struct zs_shading *s, uint32_t t)
{
    const struct zs_instance *in = s->instance;
    const struct zs_mesh *mesh = in->mesh;
    const struct zs_rgb *c = mesh->face_rgb ? &mesh->face_rgb[t] : &in->material->rgb;
    zs_q1_15 n[3];
    zs_light_face_normal(n, mesh, t);
    const uint32_t light = zs_light_intensity(s, n);
    return zs_wire16((uint16_t)(code(c->r, light, 31) << 11 | code(c->g, light, 63) << 5 |
                                code(c->b, light, 31)));
}

const struct zs_shader zs_shade_flat = { .face = zs_flat_face, .run = zs_solid_run, .opaque = 1 };
