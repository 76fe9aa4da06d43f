/* Ambient and one directional light.
 *
 * SPDX-License-Identifier: MIT
 */
#include "pipeline.h"
#include "rotation.h"

uint32_t zs_light_intensity(const struct zs_renderer *r, const zs_q1_15 n[3])
{
    const struct zs_light *light = &r->scene->light;
    const int32_t *l = r->xform.light; /* q2_30 */
    const int64_t dot = (int64_t)n[0] * l[0] + (int64_t)n[1] * l[1] + (int64_t)n[2] * l[2];
    if (dot <= 0) /* q19_45, |.| < 2^46.6 */
        return light->ambient;
    /* normals end at 32767: dot / (32767 * 2^15) is dot / 2^30 (1 + 2^-15 + ...) */
    const uint32_t lambert = (uint32_t)((dot + (dot >> 15)) >> 15);       /* uq2_30, < 2^31.6 */
    return light->ambient + (uint32_t)(((uint64_t)light->diffuse * lambert + (1u << 29)) >> 30);
}

/* The product of two edges, brought to length 1. */
static ZS_NOINLINE void edges_normal(zs_q1_15 out[3], const struct zs_mesh *mesh, uint32_t t)
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

void zs_light_face_normal(zs_q1_15 out[3], const struct zs_mesh *mesh, uint32_t t)
{
    if (!mesh->face_normal) {
        edges_normal(out, mesh, t);
        return;
    }
    for (int k = 0; k < 3; k++)
        out[k] = mesh->face_normal[t][k];
}
