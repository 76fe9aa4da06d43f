/* Lit at the face, or at the vertices and interpolated; textures times that light.
 *
 * SPDX-License-Identifier: MIT
 */
#include "effect/lights.h"
#include "shade/stages.h"

/* The light at a point of a face or vertex. */
ZS_ALWAYS_INLINE void light_at(const struct zs_shading *s, const int32_t p[3],
                               const zs_q1_15 normal[3], struct zs_lit_sum *sum)
{
    const struct zs_instance *const in = s->instance;
    const struct zs_lit_material *const m = zs_lit_material_of(in);
    const int32_t n[3] = { normal[0], normal[1], normal[2] };
    struct zs_lit_at at;
    const int placed = zs_lit_placed(m, s->camera);
    if (placed)
        zs_lit_place(&at, in, p);
    zs_lit_normal(&at, in, n);
    const int near = m->flags & ZS_LIT_NEAR_VIEWER;
    zs_lit_view(&at, s->camera, near || m->flags & ZS_LIT_TWO_SIDED);
    if (m->flags & ZS_LIT_TWO_SIDED) {
        if (zs_lit_dot(at.n, at.view) < 0)
            for (int k = 0; k < 3; k++)
                at.n[k] = -at.n[k];
        if (!near)
            zs_lit_view(&at, s->camera, 0);
    }
    zs_lit_add(m, &at, sum);
}

void zs_lit_sum_at(const struct zs_shading *s, const int32_t p[3], const zs_q1_15 normal[3],
                   struct zs_lit_sum *sum)
{
    light_at(s, p, normal, sum);
}

void zs_lit_color(const struct zs_shading *s, struct zs_rgb rgb, const int32_t p[3],
                  const zs_q1_15 n[3], uint16_t out[3])
{
    struct zs_lit_sum sum;
    light_at(s, p, n, &sum);
    zs_lit_mix(zs_lit_material_of(s->instance), rgb, &sum, out);
}

static void vertex_color(const struct zs_shading *s, uint32_t v, uint16_t out[3])
{
    const struct zs_mesh *const mesh = s->instance->mesh;
    const struct zs_rgb rgb = mesh->vertex_rgb ? mesh->vertex_rgb[v] : s->instance->material->rgb;
    int32_t p[3];
    zs_mesh_place(mesh, v, p);
    zs_lit_color(s, rgb, p, mesh->normal[v], out);
}

/* ---- Face ------------------------------------------------------------------------------------ */

static uint16_t lit_face(const struct zs_shading *s, uint32_t t)
{
    const struct zs_mesh *const mesh = s->instance->mesh;
    const struct zs_rgb rgb = mesh->face_rgb ? mesh->face_rgb[t] : s->instance->material->rgb;
    int32_t p[3] = { 0, 0, 0 }, corner[3];
    zs_q1_15 n[3];
    uint16_t c[3];
    for (int i = 0; i < 3; i++) {
        zs_mesh_place(mesh, mesh->tri[t][i], corner);
        for (int k = 0; k < 3; k++)
            p[k] += corner[k]; /* < 2^25 */
    }
    for (int k = 0; k < 3; k++)
        p[k] /= 3;
    zs_light_face_normal(n, mesh, t);
    zs_lit_color(s, rgb, p, n, c);
    return zs_lit_pack(c);
}

const struct zs_shader zs_shade_lit_face = {
    .face = lit_face, .run = zs_solid_run, .check = zs_lit_check, .opaque = 1
};

/* ---- Vertex ---------------------------------------------------------------------------------- */

static void lit_vertex(const struct zs_shading *s, uint32_t v, uint16_t *out)
{
    vertex_color(s, v, out);
}

static int lit_check(const struct zs_instance *in, const struct zs_config *config)
{
    return in->mesh->normal ? zs_lit_check(in, config) : ZS_ERR_MESH;
}

const struct zs_shader zs_shade_lit = {
    .vertex = lit_vertex, .start = zs_smooth_start, .run = zs_smooth_run, .check = lit_check,
    .n_varyings = ZS_VARYINGS_LIT, .opaque = 1
};
