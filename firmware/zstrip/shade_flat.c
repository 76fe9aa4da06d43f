/* Flat shading: one normal and one lit colour a face.
 *
 * SPDX-License-Identifier: MIT
 */
#include "rotation.h"
#include "shade_solid.h"

/* The normal of a face that the mesh gives none for: the product of two edges, brought to length 1. */
static void face_normal(zs_q1_15 out[3], const struct zs_mesh *mesh, uint32_t t)
{
    int32_t e[2][3];
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 3; k++) {
            const uint32_t a = mesh->tri[t][0], b = mesh->tri[t][i + 1];
            e[i][k] = (mesh->pos[b][k] - mesh->pos[a][k]) * 256; /* |.| < 2^24 */
            if (mesh->pos_lo)
                e[i][k] += mesh->pos_lo[b][k] - mesh->pos_lo[a][k];
        }
    int64_t n[3];
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        n[k] = (int64_t)e[0][i] * e[1][j] - (int64_t)e[0][j] * e[1][i]; /* |.| < 2^49.1 */
    }
    zs_q2_30 unit[3] = { 0, 0, 0 }; /* no area: no light falls on it */
    (void)zs_unit64(unit, n);
    for (int k = 0; k < 3; k++) {
        const int32_t q15 = (int32_t)zs_round_shift(unit[k], 15);
        out[k] = (zs_q1_15)zs_min32(zs_max32(q15, -32767), 32767);
    }
}

/* 0 .. 65535 to 0 .. most, nearest. most <= 63 */
static uint32_t code(uint32_t channel, uint32_t most)
{
    const uint32_t t = channel * most + 0x8000u; /* < 2^22; t / 65535 by two shifts */
    return (t + (t >> 16)) >> 16;
}

static uint16_t flat_face(const struct zs_renderer *r, uint32_t t)
{
    const struct zs_instance *in = r->xform.instance;
    const struct zs_mesh *mesh = in->mesh;
    const struct zs_rgb *c = mesh->face_rgb ? &mesh->face_rgb[t] : &in->material->rgb;
    zs_q1_15 own[3];
    const zs_q1_15 *n = own;
    if (mesh->face_normal)
        n = mesh->face_normal[t];
    else
        face_normal(own, mesh, t);
    const uint32_t light = zs_light_intensity(r, n);
    return zs_wire16((uint16_t)(code(zs_light_channel(c->r, light), 31) << 11 |
                                code(zs_light_channel(c->g, light), 63) << 5 |
                                code(zs_light_channel(c->b, light), 31)));
}

const struct zs_shader zs_shade_flat = { 0, flat_face, zs_solid_rows, 0, zs_solid_run, 0, 0 };
