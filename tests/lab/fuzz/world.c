/* Random scenes: see world.h.
 *
 * SPDX-License-Identifier: MIT
 */
#include "world.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fnv1a.h"
#include "kinds.h"
#include "zs_check.h"

static void *block(struct world *w, size_t bytes)
{
    if (w->n_blocks == WORLD_BLOCKS)
        abort();
    void *p = calloc(bytes ? bytes : 1, 1);
    if (!p)
        abort();
    w->block[w->n_blocks] = p;
    w->bytes[w->n_blocks++] = bytes;
    return p;
}

static int odd_one(struct prng *p, uint32_t odd)
{
    return odd && one_in(p, odd);
}

/* ---- Numbers --------------------------------------------------------------------------------- */

static int16_t any16(struct prng *p)
{
    static const int16_t ends[] = { -32768, -32767, -1, 0, 1, 32766, 32767 };
    return one_in(p, 3) ? ends[prng_pick(p, 7)] : (int16_t)(prng_log(p) >> 48);
}

static int32_t any32(struct prng *p)
{
    static const int32_t ends[] = { INT32_MIN, INT32_MIN + 1, -ZS_WORLD_MAX - 1, -ZS_WORLD_MAX,
                                    ZS_WORLD_MAX, ZS_WORLD_MAX + 1, INT32_MAX, 0, 1, -1 };
    return one_in(p, 3) ? ends[prng_pick(p, 10)] : (int32_t)(prng_log(p) >> 32);
}

static int64_t any64(struct prng *p)
{
    static const int64_t ends[] = { INT64_MIN, INT64_MIN + 1, -1, 0, 1, INT64_MAX, (int64_t)1 << 60,
                                    (int64_t)1 << 45, -((int64_t)1 << 45) };
    return one_in(p, 4) ? ends[prng_pick(p, 9)] : prng_log(p);
}

/* 1 .. 2^bits, all magnitudes alike. */
static int32_t magnitude(struct prng *p, uint32_t bits)
{
    const int32_t top = (int32_t)1 << prng_pick(p, bits);
    return prng_range(p, top, 2 * top);
}

/* ---- Meshes ---------------------------------------------------------------------------------- */

/* Triangles over vertices: loose, a lattice, a fan, or any vertices at all. */
static void indices(struct zs_mesh *m, struct prng *p, uint32_t kind, uint32_t across, uint32_t odd,
                    uint16_t (*tri)[3])
{
    for (uint32_t t = 0; t < m->n_tris; t++) {
        const uint32_t cell = t / 2, x = cell % across, at = cell / across * (across + 1u) + x;
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t v = prng_pick(p, m->n_verts ? m->n_verts : 1u);
            if (kind == 0)
                v = 3 * t + k;
            else if (kind == 1)
                v = t % 2 ? (k == 0 ? at + 1u : k == 1 ? at + across + 1u : at + across + 2u)
                          : (k == 0 ? at : k == 1 ? at + across + 1u : at + 1u);
            else if (kind == 2)
                v = k == 0 ? 0u : t + k;
            tri[t][k] = (uint16_t)(v % (m->n_verts ? m->n_verts : 1u));
        }
        if (odd_one(p, odd * 8u))
            tri[t][prng_pick(p, 3)] = (uint16_t)(m->n_verts + prng_pick(p, 3) * prng_pick(p, 30000));
        if (t > 0 && one_in(p, 20)) /* the same again, or the other way round */
            for (int k = 0; k < 3; k++)
                tri[t][k] = tri[t - 1][one_in(p, 2) ? k : 2 - k];
    }
}

static void positions(struct zs_mesh *m, struct prng *p, uint32_t kind, uint32_t across, int32_t half,
                      uint32_t odd, int16_t (*pos)[3])
{
    const int32_t down = m->n_verts / (across + 1u) ? (int32_t)(m->n_verts / (across + 1u)) : 1;
    for (uint32_t v = 0; v < m->n_verts; v++) {
        int32_t at[3];
        const uint32_t first = v / 3 * 3;
        for (int k = 0; k < 3; k++) {
            at[k] = prng_range(p, -half, half);
            if (kind == 0 && v != first && one_in(p, 2)) /* small ones too */
                at[k] = pos[first][k] + prng_range(p, -half, half) / 16;
        }
        if (kind == 1) {
            at[0] = -half + (int32_t)(2 * (int64_t)half * (int32_t)(v % (across + 1u)) / (int32_t)across);
            at[2] = -half + (int32_t)(2 * (int64_t)half * (int32_t)(v / (across + 1u)) / down);
            at[1] /= 8;
        }
        for (int k = 0; k < 3; k++)
            pos[v][k] = (int16_t)(at[k] < -32768 ? -32768 : at[k] > 32767 ? 32767 : at[k]);
        if (odd_one(p, odd * 4u))
            pos[v][prng_pick(p, 3)] = any16(p);
    }
}

static void normals(struct prng *p, uint32_t n, uint32_t odd, zs_q1_15 (*out)[3])
{
    for (uint32_t i = 0; i < n; i++) {
        int32_t v[3] = { prng_range(p, -99, 99), prng_range(p, -99, 99), prng_range(p, -99, 99) };
        zs_q2_30 unit[3] = { 0, 0, 0 };
        (void)zs_unit(unit, v);
        for (int k = 0; k < 3; k++)
            out[i][k] = odd_one(p, odd * 2u) ? any16(p)
                                             : (zs_q1_15)(unit[k] / 32768 - (unit[k] == ZS_Q30_ONE));
    }
}

static void noise(struct prng *p, void *out, size_t bytes)
{
    uint8_t *to = out;
    for (size_t i = 0; i < bytes; i++)
        to[i] = (uint8_t)(prng_next(p) >> 32);
}

/* The sphere around vertices of the box's middle, as small as steps allow. */
static void sphere(const struct zs_mesh *m, const uint32_t *vert, uint32_t n, int16_t center[3],
                   uint16_t *radius)
{
    int32_t lo[3] = { 32767, 32767, 32767 }, hi[3] = { -32768, -32768, -32768 };
    for (uint32_t i = 0; i < n; i++)
        for (int k = 0; k < 3; k++) {
            const int32_t c = m->pos[vert ? vert[i] : i][k];
            lo[k] = c < lo[k] ? c : lo[k];
            hi[k] = c > hi[k] ? c : hi[k];
        }
    int64_t most = 0;
    for (int k = 0; k < 3; k++)
        center[k] = (int16_t)(n ? (lo[k] + hi[k]) / 2 : 0);
    for (uint32_t i = 0; i < n; i++) {
        int64_t square = 0;
        for (int k = 0; k < 3; k++) {
            const uint32_t v = vert ? vert[i] : i;
            const int64_t d = (m->pos[v][k] - center[k]) * 256 + (m->pos_lo ? m->pos_lo[v][k] : 0);
            square += d * d;
        }
        most = square > most ? square : most;
    }
    int64_t r = 0; /* least r with (256 r)^2 >= most */
    for (int64_t bit = 1 << 16; bit; bit >>= 1)
        if ((r + bit - 1) * (r + bit - 1) * 65536 < most)
            r += bit;
    *radius = (uint16_t)(r > 65535 ? 65535 : r);
}

/* What is wrong with spheres, indices and clusters: what other flaws would hide. */
static enum zs_flaw flaw_of(const struct zs_mesh *m, uint32_t *at)
{
    struct zs_mesh bare = *m;
    bare.normal = bare.face_normal = NULL;
    bare.uv = NULL;
    return zs_mesh_check(&bare, at);
}

/* Clusters with exact spheres and with cones found by trying; none where a triangle is out of range. */
static void clusters(struct world *w, struct zs_mesh *m, struct prng *p)
{
    const uint32_t size = 1u + prng_pick(p, 12);
    const uint32_t n = (m->n_tris + size - 1u) / size;
    struct zs_cluster *c = block(w, n * sizeof *c);
    for (uint32_t i = 0; i < n; i++) {
        uint32_t vert[36], n_vert = 0;
        c[i].first = i * size;
        c[i].n_tris = (uint16_t)(m->n_tris - i * size < size ? m->n_tris - i * size : size);
        for (uint32_t t = 0; t < c[i].n_tris; t++)
            for (int k = 0; k < 3; k++) {
                vert[n_vert] = m->tri[c[i].first + t][k];
                if (vert[n_vert++] >= m->n_verts)
                    return;
            }
        sphere(m, vert, n_vert, c[i].center, &c[i].radius);
        for (int k = 0; k < 3; k++)
            c[i].axis[k] = (int8_t)prng_range(p, -80, 80);
        c[i].axis[prng_pick(p, 3)] = (int8_t)(one_in(p, 2) ? 127 : -127);
        c[i].cutoff = (int8_t)prng_range(p, 0, 127);
        c[i].height = (uint16_t)prng_next(p);
    }
    m->cluster = c;
    m->n_clusters = n;
    uint32_t at; /* give up on the cones that do not hold; find a height that does */
    enum zs_flaw flaw;
    while ((flaw = flaw_of(m, &at)) == ZS_FLAW_CLUSTER_HEIGHT ||
           (flaw == ZS_FLAW_CLUSTER_CONE && c[at].cutoff != 127)) {
        c[at].cutoff = flaw == ZS_FLAW_CLUSTER_CONE ? 127 : c[at].cutoff;
        c[at].height = (uint16_t)(flaw == ZS_FLAW_CLUSTER_HEIGHT ? c[at].height / 2 : c[at].height);
    }
}

static void mesh_make(struct world *w, struct zs_mesh *m, struct prng *p, uint32_t odd)
{
    const uint32_t kind = prng_pick(p, 4), across = 1u + prng_pick(p, 9);
    const int32_t half = one_in(p, 12) ? 32767 : magnitude(p, 15);
    memset(m, 0, sizeof *m);
    m->n_tris = one_in(p, 20) ? prng_pick(p, 600) : prng_pick(p, 60);
    m->n_verts = kind == 0   ? 3 * m->n_tris
                 : kind == 1 ? (across + 1u) * (m->n_tris / 2 / across + 2u)
                 : kind == 2 ? m->n_tris + 2u
                             : (uint32_t)magnitude(p, 9);
    if (odd_one(p, odd))
        m->n_verts = prng_pick(p, 4);
    int16_t (*pos)[3] = block(w, m->n_verts * sizeof *pos);
    uint16_t (*tri)[3] = block(w, m->n_tris * sizeof *tri);
    positions(m, p, kind, across, half, odd, pos);
    indices(m, p, kind, across, odd, tri);
    m->pos = (const int16_t (*)[3])pos;
    m->tri = (const uint16_t (*)[3])tri;
    void *a;
#define ARRAY(field, n) (m->field = a = block(w, (n) * sizeof *m->field), noise(p, a, (n) * sizeof *m->field))
    if (one_in(p, 3))
        ARRAY(pos_lo, m->n_verts);
    if (one_in(p, 2))
        ARRAY(vertex_rgb, m->n_verts);
    if (one_in(p, 2))
        ARRAY(face_rgb, m->n_tris);
    if (one_in(p, 2))
        ARRAY(face_raw, m->n_tris);
    if (!odd_one(p, odd)) {
        ARRAY(uv, m->n_verts);
        int16_t (*uv)[2] = a;
        const uint32_t less = prng_pick(p, 16); /* small and large spans */
        for (uint32_t v = 0; v < m->n_verts; v++)
            for (int k = 0; k < 2; k++)
                uv[v][k] = one_in(p, 16) ? any16(p) : (int16_t)(uv[v][k] >> less);
    }
#undef ARRAY
    m->uv_bits = (uint8_t)prng_pick(p, 16);
    if (odd_one(p, odd * 2u))
        m->uv_bits = (uint8_t)prng_next(p);
    if (!odd_one(p, odd)) {
        zs_q1_15 (*n)[3] = block(w, m->n_verts * sizeof *n);
        normals(p, m->n_verts, odd, n);
        m->normal = (const zs_q1_15 (*)[3])n;
    }
    if (one_in(p, 2)) {
        zs_q1_15 (*n)[3] = block(w, m->n_tris * sizeof *n);
        normals(p, m->n_tris, odd, n);
        m->face_normal = (const zs_q1_15 (*)[3])n;
    }
    sphere(m, NULL, m->n_verts, m->center, &m->radius);
    if (odd_one(p, odd)) {
        m->radius = (uint16_t)prng_next(p);
        if (one_in(p, 2))
            m->center[prng_pick(p, 3)] = any16(p);
    }
    m->scale = one_in(p, 3) ? ZS_Q16_ONE : (uint32_t)(one_in(p, 2) ? 1 << prng_pick(p, 28) : magnitude(p, 24));
    if (one_in(p, 3))
        clusters(w, m, p);
}

/* ---- The rest of a scene ------------------------------------------------------------------------ */

static void texture_make(struct world *w, struct zs_texture *x, struct prng *p, uint32_t odd)
{
    memset(x, 0, sizeof *x);
    const struct kind_texel *kind = &kind_texels[prng_pick(p, KINDS(kind_texels))];
    x->format = kind->format;
    x->log2_w = (uint8_t)(one_in(p, 6) ? prng_pick(p, 11) : prng_pick(p, 7));
    x->log2_h = (uint8_t)(one_in(p, 6) ? prng_pick(p, x->log2_w > 6 ? 5 : 11) : prng_pick(p, 7));
    if (kind->bits == 4 && x->log2_w == 0)
        x->log2_w = 1;
    const uint32_t n = 1u << (x->log2_w + x->log2_h);
    const size_t bytes = (size_t)n * kind->bits / 8u;
    uint8_t *texel = block(w, bytes);
    noise(p, texel, bytes);
    if (kind->colors_max) {
        x->n_colors = (uint16_t)(one_in(p, 3) ? kind->colors_max : 1 + prng_pick(p, kind->colors_max));
        for (size_t i = 0; i < bytes; i++)
            texel[i] = (uint8_t)(kind->bits == 8 ? texel[i] % x->n_colors
                                                 : (texel[i] & 15) % x->n_colors |
                                                       (texel[i] >> 4) % x->n_colors << 4);
        uint16_t *palette = block(w, x->n_colors * 2u);
        noise(p, palette, x->n_colors * 2u);
        x->palette = palette;
    }
    x->texel = texel;
    x->clamp = (uint8_t)(one_in(p, 2) ? 0 : prng_pick(p, 4));
    if (odd_one(p, odd))
        switch (prng_pick(p, 6)) {
        case 0: x->log2_w = (uint8_t)(11 + prng_pick(p, 245)); break;
        case 1: x->log2_h = (uint8_t)(11 + prng_pick(p, 245)); break;
        case 2: x->clamp = (uint8_t)(4 + prng_pick(p, 252)); break;
        case 3: x->texel = NULL; break;
        case 4: x->format = NULL; break;
        default: x->palette = NULL; break;
        }
}

static void materials(struct world *w, struct prng *p, uint32_t odd)
{
    for (int i = 0; i < WORLD_MATERIALS; i++) {
        struct zs_material *m = &w->material[i];
        m->shader = kind_shaders[prng_pick(p, KINDS(kind_shaders))].shader;
        noise(p, &m->rgb, sizeof m->rgb);
        m->cull = (uint8_t)(one_in(p, 3) ? prng_pick(p, 3) : ZS_CULL_NONE);
        m->texture = &w->texture[prng_pick(p, WORLD_TEXTURES)];
        if (odd_one(p, odd * 2u))
            m->texture = NULL;
        if (odd_one(p, odd * 4u))
            m->shader = NULL;
        if (odd_one(p, odd * 4u))
            m->cull = (uint8_t)prng_next(p);
    }
    for (int i = 0; i < WORLD_STATES; i++) {
        struct zs_depth_state *s = &w->state[i];
        s->func = (uint8_t)prng_pick(p, 3);
        s->read_only = (uint8_t)prng_pick(p, 2);
        s->bias = one_in(p, 2) ? any16(p) : (int16_t)prng_range(p, -3, 3);
        s->slope_bias = one_in(p, 2) ? any16(p) : (int16_t)(prng_range(p, -1, 1) * 256);
        if (odd_one(p, odd)) {
            s->func = (uint8_t)prng_next(p);
            s->read_only = (uint8_t)prng_next(p);
        }
    }
}

static void rotation(struct zs_pose *pose, struct prng *p, uint32_t odd)
{
    zs_pose_identity(pose);
    if (one_in(p, 4))
        return;
    const uint32_t quarter = one_in(p, 4) ? 0x4000u : 1u; /* axis-aligned too */
    zs_pose_turn(pose, (zs_turn)(prng_next(p) * quarter), (zs_turn)(prng_next(p) * quarter),
                 (zs_turn)(prng_next(p) * quarter));
    if (one_in(p, 4)) {
        const int32_t axis[3] = { any32(p), any32(p), any32(p) };
        (void)zs_pose_rotate(pose, axis, (zs_turn)prng_next(p));
    }
    if (odd_one(p, odd * 2u)) /* nearly orthonormal */
        pose->rot[prng_pick(p, 9)] += prng_range(p, -2000, 2000);
    if (odd_one(p, odd * 4u))
        pose->rot[prng_pick(p, 9)] = any32(p);
}

/* Meshes of about `size` world units, within `reach` of the origin. */
static void instances(struct world *w, struct prng *p, int64_t size, uint32_t odd)
{
    for (uint32_t i = 0; i < w->scene.n_instances; i++) {
        struct zs_instance *in = &w->instance[i];
        in->mesh = &w->mesh[prng_pick(p, WORLD_MESHES)];
        in->material = &w->material[prng_pick(p, WORLD_MATERIALS)];
        in->depth_state = one_in(p, 3) ? &w->state[prng_pick(p, WORLD_STATES)] : NULL;
        rotation(&in->pose, p, odd);
        const uint64_t steps = in->mesh->radius ? in->mesh->radius : 1u;
        const uint32_t larger = one_in(p, 6) ? prng_pick(p, 4) : 0u;
        const uint64_t want = ((uint64_t)size << 32) / steps << larger >> prng_pick(p, 4);
        const uint64_t most = (uint64_t)1 << 47; /* of both scales */
        const uint64_t scale = (want > most ? most : want) / in->mesh->scale;
        in->pose.scale = (uint32_t)(scale < 1 ? 1 : scale > UINT32_MAX ? UINT32_MAX : scale);
        for (int k = 0; k < 3; k++)
            in->pose.pos[k] = one_in(p, 3) ? 0 : prng_range(p, (int32_t)-size, (int32_t)size) / 2;
        if (i && one_in(p, 5)) { /* ties */
            in->mesh = w->instance[i - 1].mesh;
            in->pose = w->instance[i - 1].pose;
        }
        if (odd_one(p, odd * 2u))
            in->pose.pos[prng_pick(p, 3)] = any32(p);
        if (odd_one(p, odd * 2u))
            in->pose.scale = (uint32_t)any32(p);
        if (odd_one(p, odd * 8u))
            in->mesh = NULL;
        if (odd_one(p, odd * 8u))
            in->material = NULL;
    }
}

static void light(struct zs_light *l, struct prng *p, uint32_t odd)
{
    const int32_t v[3] = { prng_range(p, -9, 9), prng_range(p, -9, 9), prng_range(p, 1, 9) };
    (void)zs_unit(l->dir, v);
    l->ambient = prng_pick(p, ZS_Q16_ONE + 1u);
    l->diffuse = prng_pick(p, ZS_Q16_ONE + 1u);
    if (odd_one(p, odd))
        l->ambient = l->diffuse = ZS_Q16_ONE;
    if (odd_one(p, odd * 2u))
        l->dir[prng_pick(p, 3)] = any32(p);
    if (odd_one(p, odd * 8u))
        l->ambient = (uint32_t)any32(p);
}

/* A sky, and what is drawn over strips. */
static void around(struct world *w, struct prng *p, uint32_t odd)
{
    w->sky_seed = (uint16_t)prng_next(p);
    w->sky.fill = own_fill;
    w->sky.ctx = &w->sky_seed;
    for (int k = 0; k < 2; k++) {
        struct zs_rect *const r = &w->overlay[k];
        r->x = (uint16_t)prng_pick(p, 40);
        r->y = (uint16_t)prng_pick(p, 40);
        r->w = (uint16_t)prng_pick(p, 80);
        r->h = (uint16_t)prng_pick(p, 80);
        w->resolve[k].draw = own_draw;
        w->resolve[k].ctx = r;
    }
    w->scene.sky = one_in(p, 3) ? &w->sky : NULL;
    w->scene.resolve = w->resolve;
    w->scene.n_resolves = one_in(p, 4) ? 1u + prng_pick(p, 2) : 0u;
    if (odd_one(p, odd * 8u))
        w->sky.fill = NULL;
    if (odd_one(p, odd * 8u))
        w->resolve[1].draw = NULL;
    if (odd_one(p, odd * 8u))
        w->scene.resolve = NULL;
}

/* ---- Cameras ----------------------------------------------------------------------------------- */

static void wild_camera(struct zs_camera *c, struct prng *p)
{
    switch (prng_pick(p, 8)) {
    case 0: c->focal = (uint64_t)any64(p); break;
    case 1: c->height = any64(p); break;
    case 2: c->z_near = any64(p); break;
    case 3: c->z_far = any64(p); break;
    case 4: c->pos[prng_pick(p, 3)] = any32(p); break;
    case 5: c->rot[prng_pick(p, 9)] = any32(p); break;
    case 6: c->projection = (uint8_t)prng_next(p); break;
    default:
        c->z_near = (zs_q48_16)1 << prng_pick(p, 46);
        c->z_far = c->z_near + 1 + ((zs_q48_16)1 << prng_pick(p, 46));
        break;
    }
}

static void camera_make(struct world *w, struct prng *p, int64_t size, uint32_t odd)
{
    struct zs_camera *c = &w->camera; /* mostly of the kind that it was */
    const int64_t unit = size > 4 ? size / 4 : 1;
    const int64_t distance = unit << prng_pick(p, 6);
    const int32_t d = (int32_t)(distance > ZS_WORLD_MAX ? ZS_WORLD_MAX : distance);
    const int32_t near = (d >> (one_in(p, 6) ? prng_pick(p, 20) : 2u + prng_pick(p, 10))) + 1;
    const int64_t far = (int64_t)near + 1 + ((int64_t)d << prng_pick(p, 5));
    const int32_t n = near < ZS_WORLD_MAX ? near : ZS_WORLD_MAX - 1;
    const int32_t f = far > ZS_WORLD_MAX ? ZS_WORLD_MAX : (int32_t)far;
    if (c->projection == ZS_ORTHOGRAPHIC ? !one_in(p, 8) : one_in(p, 4))
        (void)zs_camera_orthographic(c, magnitude(p, 1) * (d >> prng_pick(p, 6) | 1), one_in(p, 2) ? n : -f, f);
    else
        (void)zs_camera_perspective(c, (zs_turn)(one_in(p, 4) ? 1 + prng_pick(p, 32767)
                                                              : 1024u << prng_pick(p, 5)),
                                    64, n, f);
    const int32_t at[3] = { prng_range(p, -d, d) / 4, prng_range(p, -d, d) / 4, prng_range(p, -d, d) / 4 };
    const int16_t pitch = (int16_t)prng_range(p, -16383, 16383);
    if (zs_camera_orbit(c, at, d, (zs_turn)prng_next(p), one_in(p, 3) ? 0 : pitch))
        for (int k = 0; k < 9; k++)
            c->rot[k] = k % 4 == 0 ? ZS_Q30_ONE : 0;
    if (one_in(p, 8)) /* in the middle of it all */
        c->pos[0] = c->pos[1] = c->pos[2] = 0;
    if (odd_one(p, odd))
        wild_camera(c, p);
}

/* ---- All of it --------------------------------------------------------------------------------- */

static int64_t size_of(const struct world *w)
{
    return w->scene.background ? (int64_t)1 << (w->scene.background % 29u) : 1000;
}

void world_camera(struct world *w, struct prng *p, uint32_t odd)
{
    camera_make(w, p, size_of(w), odd);
}

void world_make(struct world *w, struct prng *p, uint32_t odd)
{
    memset(w, 0, sizeof *w);
    w->scene.background = (uint16_t)prng_next(p);
    for (int i = 0; i < WORLD_MESHES; i++)
        mesh_make(w, &w->mesh[i], p, odd);
    for (int i = 0; i < WORLD_TEXTURES; i++) {
        texture_make(w, &w->texture[i], p, odd * 2u);
        (void)zs_texture_check(&w->texture[i], NULL);
    }
    materials(w, p, odd);
    const int64_t size = size_of(w);
    w->scene.n_instances = w->n_instances = prng_pick(p, WORLD_INSTANCES);
    w->scene.instance = w->instance = block(w, w->n_instances * sizeof *w->instance);
    instances(w, p, size, odd);
    light(&w->scene.light, p, odd);
    around(w, p, odd);
    camera_make(w, p, size, odd);
    w->trusted = 1;
    for (int i = 0; i < WORLD_MESHES; i++) {
        struct zs_mesh *m = &w->mesh[i];
        if (flaw_of(m, NULL) != ZS_FLAW_NONE)
            w->trusted = 0;
        (void)zs_mesh_check(m, NULL);
        if (odd_one(p, odd * 8u))
            m->scale = (uint32_t)any32(p);
    }
    if (odd_one(p, odd * 8u)) {
        w->scene.n_instances = 65536u + prng_pick(p, 9);
    } else if (odd_one(p, odd * 8u)) {
        w->scene.instance = NULL;
    }
}

/* ---- Effects ------------------------------------------------------------------------------------ */

/* Texels with alpha, or as many levels as there may be. */
static void texture_effects(struct world *w, struct zs_texture *x, struct prng *p)
{
    const struct kind_texel *kind = one_in(p, 2) ? &kind_alpha_texels[prng_pick(p, EFFECT_TEXELS)]
                                                 : &kind_texels[prng_pick(p, KINDS(kind_texels))];
    memset(x, 0, sizeof *x);
    x->format = kind->format;
    x->log2_w = (uint8_t)(1 + prng_pick(p, 7));
    x->log2_h = (uint8_t)(1 + prng_pick(p, 7));
    const uint32_t w_most = x->log2_w + (kind->bits != 4), h_most = x->log2_h + 1u;
    x->n_levels = (uint8_t)(one_in(p, 2) ? 0 : prng_pick(p, (w_most < h_most ? w_most : h_most) + 1u));
    x->alpha_least = (uint8_t)(one_in(p, 2) ? 0 : prng_next(p));
    x->clamp = (uint8_t)prng_pick(p, 4);
    size_t bytes = 0;
    for (uint32_t level = 0; level < (x->n_levels ? x->n_levels : 1u); level++)
        bytes += ((size_t)kind->bits << (x->log2_w + x->log2_h - 2 * level)) / 8u;
    uint8_t *texel = block(w, bytes);
    noise(p, texel, bytes);
    if (kind->colors_max) { /* any number is one of the palette's */
        const size_t colors = (size_t)kind->colors_max *
                              (kind >= kind_alpha_texels && kind < kind_alpha_texels + EFFECT_TEXELS ? 2u : 1u);
        uint16_t *palette = block(w, colors * 2u);
        noise(p, palette, colors * 2u);
        for (size_t i = kind->colors_max; i < colors; i++)
            palette[i] &= 255u;
        x->n_colors = kind->colors_max;
        x->palette = palette;
    }
    x->texel = texel;
}

/* What an instance with an effect needs of its mesh and its state; mostly it gets that. */
static void instance_effects(struct world *w, struct effects *e, struct prng *p, struct zs_instance *in)
{
    const struct zs_material *m = in->material;
    if (m->shader == &zs_shade_shadow) {
        in->depth_state = one_in(p, 2) ? NULL : &e->lift;
        const struct zs_instance *caster = &w->instance[prng_pick(p, w->n_instances)];
        struct zs_mesh *flat = block(w, sizeof *flat);
        struct zs_shadow_plane plane = { .at = { 0, 0, 0 } };
        struct zs_shadow_light light = { .point = 0 };
        const int32_t up[3] = { prng_range(p, -3, 3), 9, prng_range(p, -3, 3) };
        (void)zs_unit(plane.normal, up);
        (void)zs_unit(light.dir, up);
        if (caster->mesh && caster->mesh->n_verts < 65536u && one_in(p, 2)) {
            int16_t(*pos)[3] = block(w, caster->mesh->n_verts * sizeof *pos);
            (void)zs_shadow_flatten(in, flat, pos, caster, &plane, &light);
        }
    }
    if (m->shader == &zs_shade_matcap && in->mesh && in->mesh->uv_bits < 15 && !one_in(p, 20))
        w->mesh[in->mesh - w->mesh].uv_bits = 15;
}

int world_effects(struct world *w, struct effects *e, struct prng *p, const struct zs_config *config, uint32_t odd)
{
    const uint32_t without = odd && one_in(p, odd)                  ? 0
                             : !config->method || config->method == &zs_method_transparent ? 0
                             : config->method == &zs_method_painter ? EFFECT_PLAIN
                                                                    : EFFECT_PLAIN | EFFECT_BUFFER;
    effects_make(e, p, size_of(w));
    for (int i = 0; i < WORLD_TEXTURES; i++)
        if (one_in(p, 2))
            texture_effects(w, &w->texture[i], p);
    const int same = effects_map(e, p, w->instance, w->n_instances, size_of(w));
    for (int i = 0; i < WORLD_MATERIALS; i++)
        effects_cover(e, p, &w->effect[i], &w->texture[prng_pick(p, WORLD_TEXTURES)], without);
    for (uint32_t i = 0; i < w->n_instances; i++) {
        struct zs_instance *in = &w->instance[i];
        if (!in->material || !in->mesh || one_in(p, 3))
            continue;
        const struct zs_material *m = &w->effect[prng_pick(p, WORLD_MATERIALS)].material;
        if (m->primitive && m->primitive->n > in->mesh->n_tris && m->shader != &zs_shade_plain && !one_in(p, 20))
            continue;
        in->material = m;
        instance_effects(w, e, p, in);
    }
    if (one_in(p, 6)) {
        const struct zs_rect all = { 0, 0, ZS_SIZE_MAX, ZS_SIZE_MAX };
        zs_sky_look(&e->sky.sky, &w->camera, &all, NULL);
        w->scene.sky = &e->sky.sky.background;
    }
    if (one_in(p, 3) && w->scene.resolve)
        (void)effects_hook(e, p, (enum effect_hook)prng_pick(p, EFFECT_HOOKS), config, &w->camera, &w->resolve[0]);
    return same;
}

void world_big(struct world *w, struct prng *p)
{
    struct zs_mesh *m = &w->mesh[0];
    if (one_in(p, 2) && w->n_instances) {
        const uint32_t n = 65535u - prng_pick(p, 2);
        struct zs_instance *in = block(w, n * sizeof *in);
        for (uint32_t i = 0; i < n; i++)
            in[i] = w->instance[i % w->n_instances];
        for (int i = 0; i < WORLD_MESHES; i++)
            w->mesh[i].n_tris %= 3u, w->mesh[i].cluster = NULL, w->mesh[i].n_clusters = 0;
        w->scene.instance = w->instance = in;
        w->scene.n_instances = w->n_instances = n;
        return;
    }
    memset(m, 0, sizeof *m);
    m->n_verts = 65535u - prng_pick(p, 3);
    m->n_tris = 60000u + prng_pick(p, 20000);
    int16_t (*pos)[3] = block(w, m->n_verts * sizeof *pos);
    uint16_t (*tri)[3] = block(w, m->n_tris * sizeof *tri);
    zs_q1_15 (*normal)[3] = block(w, m->n_verts * sizeof *normal);
    int16_t (*uv)[2] = block(w, m->n_verts * sizeof *uv);
    noise(p, pos, m->n_verts * sizeof *pos);
    noise(p, uv, m->n_verts * sizeof *uv);
    const uint32_t step = 1u + prng_pick(p, 400);
    for (uint32_t t = 0; t < m->n_tris; t++)
        for (uint32_t k = 0; k < 3; k++)
            tri[t][k] = (uint16_t)((t * 17u + k * step) % m->n_verts);
    m->pos = (const int16_t (*)[3])pos;
    m->tri = (const uint16_t (*)[3])tri;
    m->normal = (const zs_q1_15 (*)[3])normal;
    m->uv = (const int16_t (*)[2])uv;
    m->scale = ZS_Q16_ONE;
    sphere(m, NULL, m->n_verts, m->center, &m->radius);
    w->scene.n_instances = w->n_instances = w->n_instances ? 1 : 0;
    if (w->n_instances) {
        w->instance[0].mesh = m;
        w->instance[0].pose.scale = (uint32_t)((size_of(w) << 16) / 20000 + 1); /* < 2^47 / 2^16 */
    }
}

void world_free(struct world *w)
{
    for (int i = 0; i < w->n_blocks; i++)
        free(w->block[i]);
    w->n_blocks = 0;
}

uint64_t world_sum(const struct world *w)
{
    uint64_t h = fnv1a(14695981039346656037u, w, sizeof *w);
    for (int i = 0; i < w->n_blocks; i++)
        h = fnv1a(h, w->block[i], w->bytes[i]);
    return h;
}

void world_print(const struct world *w)
{
    const struct zs_camera *c = &w->camera;
    fprintf(stderr, "camera: projection %u, focal %.6g px, height %.6g, near %.6g, far %.6g, eye %d %d %d\n",
            c->projection, (double)c->focal / 4294967296.0, (double)c->height / 65536.0,
            (double)c->z_near / 65536.0, (double)c->z_far / 65536.0, c->pos[0], c->pos[1], c->pos[2]);
    for (uint32_t i = 0; i < w->n_instances; i++) {
        const struct zs_instance *in = &w->instance[i];
        const char *shader = "no";
        for (size_t k = 0; in->material && k < KINDS(kind_shaders); k++)
            if (kind_shaders[k].shader == in->material->shader)
                shader = kind_shaders[k].name;
        if (in->material && effects_of(in->material->shader) >= 0)
            shader = kind_effects[effects_of(in->material->shader)].name;
        fprintf(stderr,
                "instance %u: mesh %d (%u vertices, %u triangles%s), %s shader%s, cull %u, at %d "
                "%d %d, "
                "scale %.6g",
                i, in->mesh ? (int)(in->mesh - w->mesh) : -1, in->mesh ? in->mesh->n_verts : 0,
                in->mesh ? in->mesh->n_tris : 0, in->mesh && in->mesh->pos_lo ? ", 24 bits" : "", shader,
                in->material && in->material->primitive ? " on lines or points" : "",
                in->material ? in->material->cull : 0u, in->pose.pos[0], in->pose.pos[1], in->pose.pos[2],
                in->pose.scale / 65536.0);
        if (in->depth_state)
            fprintf(stderr, ", depth_state func %u read_only %u offset %d slope %d", in->depth_state->func,
                    in->depth_state->read_only, in->depth_state->bias, in->depth_state->slope_bias);
        fputc('\n', stderr);
    }
}
