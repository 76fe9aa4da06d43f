/* What is wrong with the data of an instance: its mesh and its texture.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/cold.h"
#include "core/fx.h"
#include "support/explain.h"
#include "zs_check.h"
#include "zs_shader.h"

#define REPEATS 1024  /* of a texture over a mesh, above which it is noise */
#define EDGES_OF 256u /* triangles of a mesh whose edges are compared with each other */

/* ---- Meshes ---------------------------------------------------------------------------------- */

/* The least radius that holds all vertices. */
static uint32_t least_radius(const struct zs_mesh *m)
{
    uint64_t most = 0; /* < 3 * 2^32 */
    for (uint32_t v = 0; v < m->n_verts; v++) {
        uint64_t square = 0;
        for (int k = 0; k < 3; k++) {
            const int64_t d = m->pos[v][k] - m->center[k];
            const int64_t end = d + (d >= 0 && m->pos_lo && m->pos_lo[v][k]); /* pos_lo adds */
            square += (uint64_t)(end * end);
        }
        most = square > most ? square : most;
    }
    const uint32_t root = zs_isqrt64(most);
    return root + ((uint64_t)root * root < most);
}

/* Return 1 if n bytes are 0. */
static int all_0(const void *p, size_t n)
{
    const uint8_t *const byte = p;
    size_t k = 0;
    while (k < n && byte[k] == 0)
        k++;
    return k == n && n;
}

/* What is no flaw, and hardly meant: a sphere far too large, normals that are not set. */
static void say_unset(struct zs_explainer *e, uint32_t i)
{
    const struct zs_mesh *const m = e->scene->instance[i].mesh;
    const uint32_t least = least_radius(m);
    if (m->radius > 64u && m->radius / 8u > least && m->n_verts &&
        !e->scene->instance[i].material->shader->position)
        ZS_SAY(e,
               "instance %: mesh.radius is % steps of the mesh, and % holds all of its vertices: "
               "it is drawn where it is out of view.",
               i, m->radius, least);
    if ((m->normal && all_0(m->normal, m->n_verts * sizeof m->normal[0])) ||
        (m->face_normal && all_0(m->face_normal, m->n_tris * sizeof m->face_normal[0])))
        ZS_SAY(e, "instance %: all normals of its mesh are 0: it gets ambient light alone.", i);
}

static void say_flaw(struct zs_explainer *e, uint32_t i)
{
    const struct zs_mesh *const m = e->scene->instance[i].mesh;
    uint32_t at;
    const enum zs_flaw flaw = zs_mesh_check(m, &at);
    if (flaw == ZS_FLAW_NONE) {
        say_unset(e, i);
        return;
    }
    ZS_PIECE(e, "instance %: ", i);
    if (flaw == ZS_FLAW_INDEX)
        ZS_SAY(e, "triangle % of its mesh names a vertex that is not there: n_verts is %.", at,
               m->n_verts);
    else if (flaw == ZS_FLAW_SPHERE)
        ZS_SAY(e, "vertex % lies outside the mesh's sphere: radius is %, and % holds all of them.",
               at, m->radius, least_radius(m));
    else {
        ZS_PIECE(e, "its mesh has ");
        ZS_PIECE(e, zs_flaw_string(flaw));
        ZS_SAY(e, " (number %).", at);
    }
}

/* Triangles that are never drawn, as they have a corner twice. Return how many. */
static uint32_t say_flat(struct zs_explainer *e, uint32_t i)
{
    const struct zs_mesh *const m = e->scene->instance[i].mesh;
    uint32_t n = 0;
    for (uint32_t t = 0; t < m->n_tris; t++)
        n += m->tri[t][0] == m->tri[t][1] || m->tri[t][1] == m->tri[t][2] ||
             m->tri[t][2] == m->tri[t][0];
    if (n > m->n_tris / 4u)
        ZS_SAY(e,
               "instance %: % of % triangles name a vertex twice, and are never drawn: is "
               "mesh.n_tris right?",
               i, n, m->n_tris);
    return n;
}

/* Return 1 if two triangles go along an edge in the same direction. */
static int same_edge(const uint16_t a[3], const uint16_t b[3])
{
    for (int k = 0; k < 9; k++)
        if (a[k / 3] == b[k % 3] && a[(k / 3 + 1) % 3] == b[(k % 3 + 1) % 3])
            return 1;
    return 0;
}

/* A triangle that is wound against two neighbours or more: one of them is seen from behind. (One
 * alone may be a fin, which shares an edge with two others.) */
static void say_neighbours(struct zs_explainer *e, uint32_t i)
{
    const struct zs_mesh *const m = e->scene->instance[i].mesh;
    const uint32_t n = zs_minu32(m->n_tris, EDGES_OF);
    for (uint32_t a = 0; a < n; a++)
        for (uint32_t b = 0, against = 0; b < n; b++) {
            against += b != a && same_edge(m->tri[a], m->tri[b]);
            if (against < 2)
                continue;
            ZS_SAY(e,
                   "instance %: triangles % and % of its mesh are neighbours, and wound against "
                   "each other: exchange two corners of one.",
                   i, a, b);
            return;
        }
}

/* The normal of triangle t by its winding, times twice its area. |component| < 2^35 */
static void normal_of(const struct zs_mesh *m, uint32_t t, int64_t n[3])
{
    int64_t a[3], b[3]; /* |.| < 2^16.1 */
    for (int k = 0; k < 3; k++) {
        const int32_t p = m->pos[m->tri[t][0]][k];
        a[k] = m->pos[m->tri[t][1]][k] - p;
        b[k] = m->pos[m->tri[t][2]][k] - p;
    }
    for (int k = 0; k < 3; k++)
        n[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

/* A closed mesh has a volume: the sum over its triangles of p . n / 6, below 0 if it is wound
 * inwards. It is closed only if its normals, by area, add up to 0. And normals that are given
 * should point to the side from which a triangle is seen. */
static void say_winding(struct zs_explainer *e, uint32_t i)
{
    const struct zs_instance *const in = &e->scene->instance[i];
    const struct zs_mesh *const m = in->mesh;
    const int shift = m->n_tris > 16384u ? 16 : 0; /* |p . n| < 2^51, so sums stay below 2^63 */
    int64_t sum[3] = { 0, 0, 0 }, volume = 0;
    uint32_t against = 0, against_face = 0;
    struct zs_bounds b;
    if (in->material->cull != ZS_CULL_BACK || in->material->primitive)
        return;
    for (uint32_t t = 0; t < m->n_tris; t++) {
        int64_t n[3], flux = 0, lit = 0, face = 0; /* < 3 * 2^50, < 3 * 2^52 */
        for (int k = 0; k < 3; k++)
            if (m->tri[t][k] >= m->n_verts)
                return; /* it has been said */
        normal_of(m, t, n);
        for (int k = 0; k < 3; k++) {
            flux += m->pos[m->tri[t][0]][k] * n[k];
            sum[k] += n[k];
            for (int j = 0; j < 3 && m->normal; j++)
                lit += m->normal[m->tri[t][j]][k] * n[k];
            if (m->face_normal)
                face += m->face_normal[t][k] * n[k];
        }
        volume += flux >> shift;
        against += lit < 0;
        against_face += face < 0;
    }
    zs_explain_bounds(e, i, &b);
    if (!(sum[0] | sum[1] | sum[2]) && volume < 0 && !zs_explain_eye_inside(&b))
        ZS_SAY(e,
               "instance % is wound inwards: its far side is seen from inside; exchange two "
               "corners of each triangle, or set material.cull to ZS_CULL_FRONT.",
               i);
    else if (zs_maxu32(against, against_face) > m->n_tris - m->n_tris / 8u)
        ZS_SAY(e,
               against ? "instance %: mesh.normal points away from the side that is seen, on % of "
                         "% triangles."
                       : "instance %: mesh.face_normal points away from the side that is seen, on "
                         "% of % triangles.",
               i, zs_maxu32(against, against_face), m->n_tris);
    else if (say_flat(e, i) == 0)
        say_neighbours(e, i);
}

/* ---- Textures -------------------------------------------------------------------------------- */

/* Texture coordinates that span less than a texel, or far more than a texture. */
static void say_uv(struct zs_explainer *e, uint32_t i)
{
    const struct zs_mesh *const m = e->scene->instance[i].mesh;
    const struct zs_texture *const x = e->scene->instance[i].material->texture;
    int32_t span[2] = { 0, 0 };
    if (!m->uv || m->uv_bits > 15u || x->log2_w > ZS_TEXTURE_LOG2_MAX ||
        x->log2_h > ZS_TEXTURE_LOG2_MAX)
        return; /* say_texture says it */
    for (int k = 0; k < 2; k++) {
        int32_t least = 32767, most = -32768;
        for (uint32_t v = 0; v < m->n_verts; v++) {
            least = zs_min32(least, m->uv[v][k]);
            most = zs_max32(most, m->uv[v][k]);
        }
        span[k] = most - least; /* < 2^16; below 0 without vertices */
    }
    const int32_t most = zs_max32(span[0], span[1]);
    if (all_0(m->uv, m->n_verts * sizeof m->uv[0]))
        ZS_SAY(e, "instance %: all of mesh.uv is 0: one texel is all that is seen.", i);
    if (most <= 0)
        return;
    if ((span[0] << x->log2_w) >> m->uv_bits == 0 && (span[1] << x->log2_h) >> m->uv_bits == 0)
        ZS_SAY(e,
               "instance %: mesh.uv spans less than a texel: % is all of the texture with "
               "uv_bits %.",
               i, 1 << m->uv_bits, m->uv_bits);
    else if (most >> m->uv_bits >= REPEATS)
        ZS_SAY(e, "instance %: mesh.uv repeats the texture % times: uv_bits is %.", i,
               most >> m->uv_bits, m->uv_bits);
}

/* A texture that the shader does not need: the library's shaders check that it is there. */
static void say_unread(struct zs_explainer *e, uint32_t i)
{
    const struct zs_material *const m = e->scene->instance[i].material;
    const struct {
        struct zs_material material;
        uint32_t rest[16]; /* for shaders that read more of their material: it is not set */
    } plain = { { .shader = m->shader, .cull = m->cull }, { 0 } };
    struct zs_instance in = e->scene->instance[i];
    in.material = &plain.material;
    if (!m->shader->by_fragment &&
        (!m->shader->check || m->shader->check(&in, &e->r->config) == ZS_OK))
        ZS_SAY(e,
               "instance % has a texture, and its shader reads none: zs_shade_texture does, and "
               "those whose names hold _texture.",
               i);
}

static void say_texture(struct zs_explainer *e, uint32_t i)
{
    const struct zs_texture *const x = e->scene->instance[i].material->texture;
    uint32_t at;
    if (x->format != &zs_texel_565 && x->format != &zs_texel_pal8 && x->format != &zs_texel_pal4)
        return; /* one with alpha (zs_filter.h) */
    const enum zs_flaw flaw = zs_texture_check(x, &at);
    if (flaw == ZS_FLAW_NONE)
        return;
    ZS_PIECE(e, "instance %: its texture has ", i);
    ZS_PIECE(e, zs_flaw_string(flaw));
    ZS_SAY(e, " (number %).", at);
}

void zs_explain_mesh(struct zs_explainer *e, uint32_t i, int mesh, int texture)
{
    const struct zs_texture *const x = e->scene->instance[i].material->texture;
    if (mesh) {
        say_flaw(e, i);
        say_winding(e, i);
    }
    if (x && texture) {
        say_texture(e, i);
        say_unread(e, i);
    }
    if (x && (mesh || texture))
        say_uv(e, i);
}
