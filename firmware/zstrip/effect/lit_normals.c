/* Phong shading: the stages of vertices and faces, and the checks. lit_phong.c has the pixels.
 *
 * SPDX-License-Identifier: MIT
 */
#include "effect/lights.h"

#define NORMAL_ONE 32760 /* length of a normal as a varying, below 2^15 */

void zs_phong_vertex(const struct zs_shading *s, uint32_t v, uint16_t *out)
{
    const zs_q1_15 *const normal = s->instance->mesh->normal[v];
    const int32_t n[3] = { normal[0], normal[1], normal[2] };
    struct zs_lit_at at;
    zs_lit_normal(&at, s->instance, n);
    for (int k = 0; k < 3; k++)
        out[k] = (uint16_t)(32768 + ((at.n[k] * NORMAL_ONE + (1 << 14)) >> 15));
}

void zs_phong_near_vertex(const struct zs_shading *s, uint32_t v, uint16_t *out)
{
    zs_phong_vertex(s, v, out);
    for (int k = 0; k < 3; k++)
        out[3 + k] = (uint16_t)(s->instance->mesh->pos[v][k] + 32768);
}

struct zs_rgb zs_phong_color(const struct zs_instance *in, uint32_t paint)
{
    const uint32_t red = paint >> 11, green = paint >> 6 & 31u, blue = paint >> 1 & 31u;
    const struct zs_rgb rgb = { (uint8_t)(red << 3 | red >> 2), (uint8_t)(green << 3 | green >> 2),
                                (uint8_t)(blue << 3 | blue >> 2) };
    return in->mesh->face_rgb ? rgb : in->material->rgb;
}

/* A channel in five bits, nearest. */
static uint32_t five_bits(uint32_t channel)
{
    return (channel * 31u + 127u) / 255u;
}

/* ZS_PHONG_TURNED: the face turns away from the eye, and its normals are turned round. */
static uint16_t turned(const struct zs_shading *s, uint32_t t)
{
    const struct zs_instance *const in = s->instance;
    const struct zs_mesh *const mesh = in->mesh;
    struct zs_lit_at at;
    zs_q1_15 normal[3];
    int32_t p[3], n[3];
    if (!(zs_lit_material_of(in)->flags & ZS_LIT_TWO_SIDED))
        return 0;
    zs_light_face_normal(normal, mesh, t);
    for (int k = 0; k < 3; k++) {
        p[k] = mesh->pos[mesh->tri[t][0]][k] * 256;
        n[k] = normal[k];
    }
    zs_lit_place(&at, in, p);
    zs_lit_normal(&at, in, n);
    zs_lit_view(&at, s->camera, 1);
    return zs_lit_dot(at.n, at.view) < 0;
}

uint16_t zs_phong_face(const struct zs_shading *s, uint32_t t)
{
    const struct zs_rgb *const rgb = s->instance->mesh->face_rgb;
    const uint32_t color =
        rgb ? five_bits(rgb[t].r) << 11 | five_bits(rgb[t].g) << 6 | five_bits(rgb[t].b) << 1 : 0u;
    return (uint16_t)(color | turned(s, t));
}

int zs_phong_near_check(const struct zs_instance *in, const struct zs_config *config)
{
    return in->mesh->normal ? zs_lit_check(in, config) : ZS_ERR_MESH;
}

int zs_phong_check(const struct zs_instance *in, const struct zs_config *config)
{
    const struct zs_lit_material *const m = zs_lit_material_of(in);
    const int err = zs_phong_near_check(in, config);
    if (err)
        return err;
    for (uint32_t k = 0; k < m->lighting->n_lamps; k++)
        if (m->lighting->lamp[k].kind != ZS_LAMP_DIRECTIONAL)
            return ZS_ERR_RANGE;
    return m->flags & ZS_LIT_NEAR_VIEWER ? ZS_ERR_RANGE : ZS_OK;
}
