/* What is wrong with the data of an instance: its mesh.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/cold.h"
#include "core/fx.h"
#include "core/method.h"
#include "support/explain.h"
#include "zs_check.h"
#include "zs_shader.h"

#define EDGES_OF 256u  /* triangles of a mesh that are compared with each other */
#define VERTS_OF 2048u /* vertices that are looked for in the triangles at a time */

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

/* Return 1 if the triangles of a mesh name vertices 1 .. n_verts. */
static int from_1(const struct zs_mesh *m)
{
    uint32_t least = UINT32_MAX, most = 0;
    for (uint32_t k = 0; k < 3u * m->n_tris; k++) {
        least = zs_minu32(least, m->tri[k / 3u][k % 3u]);
        most = zs_maxu32(most, m->tri[k / 3u][k % 3u]);
    }
    return least == 1 && most == m->n_verts;
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
        ZS_SAY(e,
               from_1(m) ? "triangle % of its mesh names vertex %, and none names vertex 0: are "
                           "they counted from 1, as in an OBJ?"
                         : "triangle % of its mesh names a vertex that is not there: n_verts is %.",
               at, m->n_verts);
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

/* Vertices that no triangle names. Other instances may have triangles, lines or points of them. */
static void say_unnamed(struct zs_explainer *e, uint32_t i)
{
    const struct zs_mesh *const m = e->scene->instance[i].mesh;
    uint32_t n = 0;
    for (uint32_t k = 0; k < e->scene->n_instances; k++) {
        const struct zs_instance *const in = &e->scene->instance[k];
        if (in->mesh->pos == m->pos && (in->mesh != m || in->material->primitive))
            return;
    }
    for (uint32_t v = 0; v < m->n_verts; v += VERTS_OF) {
        const uint32_t end = zs_minu32(VERTS_OF, m->n_verts - v);
        uint32_t named[VERTS_OF / 32u] = { 0 };
        for (uint32_t k = 0; k < 3u * m->n_tris; k++) {
            const uint32_t at = m->tri[k / 3u][k % 3u] - v;
            if (at < end)
                named[at / 32u] |= UINT32_C(1) << at % 32u;
        }
        for (uint32_t k = 0; k < end; k++)
            n += ~named[k / 32u] >> k % 32u & 1u;
    }
    if (n > m->n_verts / 16u && m->n_tris)
        ZS_SAY(e, "instance %: % of % vertices are in no triangle: is mesh.n_tris right? It is %.",
               i, n, m->n_verts, m->n_tris);
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

/* Return 1 if no other instance stands in its place: it is not the outline of one. */
static int alone(const struct zs_explainer *e, uint32_t i)
{
    const int32_t *const at = e->scene->instance[i].pose.pos;
    for (uint32_t k = 0; k < e->scene->n_instances; k++) {
        const int32_t *const pos = e->scene->instance[k].pose.pos;
        if (k != i && pos[0] == at[0] && pos[1] == at[1] && pos[2] == at[2])
            return 0;
    }
    return 1;
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
    if (in->material->cull == ZS_CULL_NONE || in->material->primitive)
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
    if (sum[0] | sum[1] | sum[2] || zs_explain_eye_inside(&b))
        volume = 0;
    if (in->material->cull == ZS_CULL_FRONT) {
        if (volume > 0 && alone(e, i))
            ZS_SAY(e,
                   "instance %: material.cull is ZS_CULL_FRONT: its far side is seen from inside; "
                   "ZS_CULL_BACK draws its outside.",
                   i);
    } else if (volume < 0)
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

/* ---- Shapes ---------------------------------------------------------------------------------- */

/* Return 1 if triangles of a mesh may cover each other: some vertex lies clearly before the plane
 * of a triangle, or, if back sides are drawn, behind one. */
static ZS_NOINLINE int covers_itself(const struct zs_mesh *m, int both)
{
    const uint32_t step = m->n_verts / EDGES_OF + 1u;
    for (uint32_t t = 0; t < zs_minu32(m->n_tris, EDGES_OF); t++) {
        int64_t n[3];
        normal_of(m, t, n);
        const int64_t most = (int64_t)(zs_size64(n[0]) + zs_size64(n[1]) + zs_size64(n[2])) *
                             (m->radius + 1) / 32; /* < 2^37 * 2^16 / 2^5 */
        for (uint32_t v = 0; v < m->n_verts; v += step) {
            int64_t off = 0; /* < 2^53 */
            for (int k = 0; k < 3; k++)
                off += n[k] * (m->pos[v][k] - m->pos[m->tri[t][0]][k]);
            if (off > most || (both && off < -most))
                return 1;
        }
    }
    return 0;
}

/* Return 1 if another instance may stand before instance i, or be its cover: both are in one place
 * of the picture. */
static int overlapped(const struct zs_explainer *e, uint32_t i)
{
    const struct zs_renderer *const r = e->r;
    struct zs_bounds b;
    struct zs_box own, box;
    zs_explain_bounds(e, i, &b);
    const int known = zs_cull_box(r, &b, &own);
    for (uint32_t k = 0; k < e->scene->n_instances; k++) {
        zs_explain_bounds(e, k, &b);
        if (k == i || zs_cull_sphere(&b, &r->camera, &r->view))
            continue;
        if (!known || !zs_cull_box(r, &b, &box) ||
            (box.x1 > own.x0 && own.x1 > box.x0 && box.y1 > own.y0 && own.y1 > box.y0))
            return 1;
    }
    return 0;
}

/* A mesh through which its own back is seen, and which no other one overlaps. */
static void say_hole(struct zs_explainer *e, uint32_t i, struct zs_seen *seen)
{
    struct zs_material m = { .shader = &zs_shade_raw, .rgb = ZS_RGB(0xffffff) };
    struct zs_instance one = e->scene->instance[i];
    struct zs_mesh mesh = *one.mesh;
    struct zs_bounds b;
    zs_explain_bounds(e, i, &b);
    if (overlapped(e, i) || zs_explain_eye_inside(&b) || b.c[2] - b.r <= e->r->camera.z_near)
        return;
    mesh.face_raw = 0;
    one.mesh = &mesh;
    one.material = &m;
    zs_explain_draw(e, &one, 0, seen);
    const uint32_t front = seen->colored;
    m.cull = ZS_CULL_NONE;
    zs_explain_draw(e, &one, 0, seen);
    const uint32_t back = seen->colored - front;
    if (back > 8u && back > front / 16u && front)
        ZS_SAY(e,
               "instance %: on % pixels its back is seen, which is not drawn: it has a hole (is "
               "mesh.n_tris right?), or is open; ZS_CULL_NONE draws both sides.",
               i, back);
}

void zs_explain_shape(struct zs_explainer *e, uint32_t i, struct zs_seen *room)
{
    const struct zs_instance *const in = &e->scene->instance[i];
    const uint32_t cull = in->material->cull;
    if (in->material->primitive || in->material->shader->position || in->mesh->n_tris == 0)
        return;
    if (!e->r->depth && e->r->config.method == &zs_method_buffer &&
        covers_itself(in->mesh, cull == ZS_CULL_NONE))
        ZS_SAY(e,
               "instance % is not convex, and there is no depth memory: triangles cover nearer "
               "ones that are listed before them; take ZS_RENDERER and a depth mapping.",
               i);
    if (in->depth_state && in->depth_state->func == ZS_DEPTH_ALWAYS && alone(e, i) &&
        covers_itself(in->mesh, cull == ZS_CULL_NONE))
        ZS_SAY(e,
               "instance % is not convex, and its depth_state.func is ZS_DEPTH_ALWAYS: triangles "
               "cover nearer ones that are listed before them; take ZS_DEPTH_LESS.",
               i);
    if (cull == ZS_CULL_BACK)
        say_hole(e, i, room);
}

/* ---- All of it ------------------------------------------------------------------------------- */

void zs_explain_mesh(struct zs_explainer *e, uint32_t i)
{
    const uint32_t before = e->said;
    say_flaw(e, i);
    say_winding(e, i);
    if (e->said == before)
        say_unnamed(e, i);
}
