/* Lighting: ambient light and one directional light.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/fx.h"
#include "core/rotation.h"
#include "zs_shader.h"

/* All arithmetic is in 32 bits, and exact up to the rounding at the end. The light's direction is
 * split into upper * 2^16 + lower. */
uint32_t zs_light_intensity(const struct zs_shading *s, const zs_q1_15 n[3])
{
    const struct zs_light *light = s->light;
    int32_t high = 0; /* the product is high * 2^16 + low, q19_45, |.| < 2^46.6 */
    uint32_t low = 0; /* < 3 * 2^16 */
    for (int k = 0; k < 3; k++) {
        /* q2_30, |.| < 2^31: up to sqrt 3 if dir is no unit vector */
        const int32_t l = s->dir[k];
        const int32_t part = (int32_t)((uint32_t)l & 0xffffu) * n[k]; /* |.| < 2^31 */
        high += (l >> 16) * n[k] + (part >> 16);                      /* |.| < 2^30.6 */
        low += (uint32_t)part & 0xffffu;
    }
    high += (int32_t)(low >> 16);
    low &= 0xffffu;
    if (high < 0 || !((uint32_t)high | low))
        return light->ambient;
    /* length 1 is 32767 in normals, so divide by 32767 * 2^15: dot / 2^30 (1 + 2^-15 + ...), which
     * is (dot + (dot >> 15)) >> 15 */
    const uint32_t twice = 2u * (uint32_t)high;                           /* < 2^31.6 */
    const uint32_t lambert = twice + ((low + twice + (low >> 15)) >> 15); /* uq2_30, < 2^31.6 */
    /* diffuse * lambert / 2^30, nearest. diffuse <= 2^16 */
    const uint32_t upper = (lambert >> 16) * light->diffuse; /* < 2^31.6 */
    const uint32_t lower = (lambert & 0xffffu) * light->diffuse >> 16;
    return light->ambient + ((upper + lower + (1u << 13)) >> 14);
}

/* Compute the cross product of two edges, normalised. */
static ZS_RARE ZS_NOINLINE void edges_normal(zs_q1_15 out[3], const struct zs_mesh *mesh,
                                             uint32_t t)
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
    for (int k = 0; k < 3; k++)
        n[k] = zs_cross_at(e[0], e[1], k); /* |.| < 2^49.1 */
    zs_q2_30 unit[3] = { 0, 0, 0 };        /* a face without area gets ambient light only */
    (void)zs_unit64(unit, n);
    for (int k = 0; k < 3; k++) {
        out[k] = (zs_q1_15)zs_held64(zs_round_shift(unit[k], 15), 32767);
    }
}

void zs_light_face_normal(zs_q1_15 out[3], const struct zs_mesh *mesh, uint32_t t)
{
    if (!mesh->face_normal) {
        edges_normal(out, mesh, t);
        return;
    }
    for (int k = 0; k < 3; k++)
        out[k] = mesh->face_normal[t][k];
}
