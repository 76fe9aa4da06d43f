/* A libFuzzer target: bytes from a card become a mesh and a texture in blocks of exactly their size, are
 * checked, and drawn by every shader.
 *
 *   what passes the checks is drawn, or refused by a name, without a read out of bounds; and is the same picture
 *   with other strips and pools
 *   what does not pass is refused by zs_frame_begin or drawn without a read out of bounds, but for a palette that
 *   is shorter than its texels say: there the check is the only guard (zstrip.h)
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "card.h"
#include "fast_lists.h"
#include "kinds.h"
#include "picture.h"
#include "target.h"

struct card {
    struct card_header header;
    struct zs_mesh mesh;
    struct zs_texture texture;
    enum zs_flaw mesh_flaw, texture_flaw;
    const uint8_t *at, *end;
    void *block[16];
    int n_blocks;
};

/* The next bytes of the file; what is missing is zero. */
static void *take(struct card *c, size_t bytes)
{
    uint8_t *p = calloc(bytes ? bytes : 1, 1);
    const size_t left = (size_t)(c->end - c->at), n = left < bytes ? left : bytes;
    if (!p)
        abort();
    if (n)
        memcpy(p, c->at, n);
    c->at += n;
    c->block[c->n_blocks++] = p;
    return p;
}

static void read_mesh(struct card *c)
{
    const struct card_header *h = &c->header;
    struct zs_mesh *m = &c->mesh;
    m->n_verts = h->n_verts > 65535u ? h->n_verts : h->n_verts % CARD_VERTS;
    m->n_tris = h->n_tris % CARD_TRIS;
    m->n_clusters = h->n_clusters % CARD_CLUSTERS;
    m->scale = h->scale;
    m->radius = h->radius;
    m->uv_bits = h->uv_bits;
    memcpy(m->center, h->center, sizeof m->center);
    struct { size_t n_verts, n_tris, n_clusters; } n = { m->n_verts > 65535u ? 0 : m->n_verts, m->n_tris,
                                                        m->n_clusters };
    m->pos = take(c, n.n_verts * sizeof *m->pos);
    m->tri = take(c, n.n_tris * sizeof *m->tri);
#define TAKE(bit, field, count) \
    if (h->arrays & (bit)) \
        m->field = take(c, n.count * sizeof *m->field);
    CARD_ARRAYS(TAKE)
#undef TAKE
}

static void read_texture(struct card *c)
{
    const struct card_header *h = &c->header;
    struct zs_texture *t = &c->texture;
    if (h->texel >= KINDS(kind_texels))
        return;
    const struct kind_texel *kind = &kind_texels[h->texel];
    t->format = kind->format;
    t->log2_w = h->log2_w;
    t->log2_h = h->log2_h;
    t->clamp = h->clamp;
    t->n_colors = h->n_colors;
    size_t bytes = 0;
    if (t->log2_w <= ZS_TEXTURE_LOG2_MAX && t->log2_h <= ZS_TEXTURE_LOG2_MAX) {
        if (t->log2_w + t->log2_h > CARD_TEXELS_LOG2)
            t->log2_h = (uint8_t)(CARD_TEXELS_LOG2 - t->log2_w);
        bytes = ((size_t)kind->bits << (t->log2_w + t->log2_h)) / 8u;
    }
    if (kind->colors_max)
        t->palette = take(c, t->n_colors * sizeof *t->palette);
    t->texel = take(c, bytes);
}

/* ---- Drawing ---------------------------------------------------------------------------------- */

/* About 1000 world units large, around the origin. */
static struct zs_pose pose_of(const struct zs_mesh *m)
{
    struct zs_pose pose;
    zs_pose_identity(&pose);
    const uint64_t size = (uint64_t)m->scale * (m->radius ? m->radius : 1u); /* < 2^48 */
    const uint64_t scale = size ? ((uint64_t)1000 << 32) / size : 1u;
    pose.scale = (uint32_t)(scale < 1 ? 1 : scale > UINT32_MAX ? UINT32_MAX : scale);
    for (int k = 0; k < 3; k++) {
        const double at = -(double)m->center[k] * m->scale * pose.scale / 4294967296.0;
        pose.pos[k] = (int32_t)(at > 1e9 ? 1e9 : at < -1e9 ? -1e9 : at);
    }
    return pose;
}

static struct zs_camera camera_of(const struct card_header *h)
{
    struct zs_camera c;
    const int32_t at[3] = { 0, 0, 0 }, d = (h->distance + 1) * 16;
    const int32_t near = h->look & CARD_NEAR ? 1 : d / 4;
    const int err = h->look & CARD_ORTHOGRAPHIC ? zs_camera_orthographic(&c, 1500, near - d, 2 * d)
                                                : zs_camera_perspective(&c, 9000, 16, near, 4000 + d);
    if (err)
        abort();
    if (zs_camera_orbit(&c, at, d, h->yaw, (int16_t)(h->pitch / 2 | 1))) /* -16383 .. 16383 */
        abort();
    return c;
}

/* 1: a frame of it cannot be begun. */
static int must_be_refused(const struct card *c, const struct kind_shader *k)
{
    const enum zs_flaw m = c->mesh_flaw, t = c->texture_flaw;
    return m == ZS_FLAW_COUNT ||
           (k->texture && (m == ZS_FLAW_UV_BITS || t == ZS_FLAW_NULL || t == ZS_FLAW_SIZE || t == ZS_FLAW_CLAMP));
}

/* Whether the mesh's sphere holds it; zs_mesh_check may have found another flaw first. */
static int sphere_holds(const struct zs_mesh *m)
{
    for (uint32_t v = 0; v < m->n_verts; v++) {
        int64_t square = 0;
        for (int k = 0; k < 3; k++) {
            const int64_t d = m->pos[v][k] - m->center[k];
            square += d * d;
        }
        if (square > (int64_t)m->radius * m->radius)
            return 0;
    }
    return 1;
}

/* All accelerators or some; clusters only where they are sound. */
static const struct zs_fast *const *lists(const struct card_header *h, int clusters)
{
    uint32_t bits = h->distance & 1u ? h->distance * 0x9e3779b1u >> 7 : ~0u;
    for (unsigned k = 0; k < fast_count(); k++)
        if (!clusters && strcmp(fast_name(k), "clusters") == 0)
            bits &= ~(1u << k);
    return fast_of(bits);
}

static void draw(struct card *c, const struct kind_shader *shader)
{
    const struct card_header *h = &c->header;
    if (shader->texture && (c->texture_flaw == ZS_FLAW_TEXEL || c->texture_flaw == ZS_FLAW_COLORS))
        return; /* only the check guards a palette */
    const struct zs_material material = { .shader = shader->shader, .rgb = { 200, 150, 100 },
                                          .cull = (uint8_t)((h->look & CARD_CULL) >> 1), .texture = &c->texture };
    const struct zs_depth_state state = { .func = h->state & 1,
                                          .read_only = h->state >> 1 & 1,
                                          .bias = (int16_t)(h->state * 77),
                                          .slope_bias = (int16_t)(h->state * 300) };
    const struct zs_instance instance[2] = {
        { .mesh = &c->mesh, .material = &material, .pose = pose_of(&c->mesh) },
        { .mesh = &c->mesh, .material = &material, .pose = pose_of(&c->mesh), .depth_state = h->state ? &state : NULL }
    };
    const struct zs_scene scene = { .instance = instance, .n_instances = h->state ? 2u : 1u,
                                    .light = { .dir = { 0, ZS_Q30_ONE, 0 }, .ambient = ZS_Q16_ONE / 4,
                                               .diffuse = ZS_Q16_ONE },
                                    .background = 0x1234 };
    const struct zs_camera camera = camera_of(h);
    struct zs_config config = picture_config(24, 16, kind_depths[h->depth % KINDS(kind_depths)].depth);
    config.varyings = ZS_VARYINGS_MAX;
    config.max_tris = config.max_verts = 400;
    config.fast = NULL;
    struct picture a = picture_draw(&config, &scene, &camera);
    EXPECT(a.err <= 0);
    EXPECT(a.err != ZS_ERR_SIZE && a.err != ZS_ERR_ARENA && a.err != ZS_ERR_SEQUENCE && a.err != ZS_ERR_VARYINGS);
    EXPECT(!must_be_refused(c, shader) || a.err);
    if (!c->mesh_flaw)
        EXPECT(a.err != ZS_ERR_MESH || material.cull > ZS_CULL_NONE || !c->mesh.normal || !c->mesh.uv);
    if (!c->texture_flaw)
        EXPECT(a.err != ZS_ERR_NULL && a.err != ZS_ERR_TEXTURE);
    if (!a.err)
        EXPECT(stats_add_up(&a.stats) && (c->mesh_flaw || a.stats.tris_index == 0));
    if (h->look & CARD_SMALL) {
        config.max_tris = (uint16_t)(1 + h->distance % 16);
        config.max_verts = 9;
    }
    config.strip_h = (uint16_t)(3 + (h->look & CARD_STRIPS) / 16);
    config.fast = lists(h, !c->mesh_flaw); /* with spheres that hold nothing is lost */
    struct picture b = picture_draw(&config, &scene, &camera);
    EXPECT(a.err == b.err);
    if (!a.err && sphere_holds(&c->mesh)) /* else parts are lost: others in other walks */
        EXPECT(picture_same(&a, &b, shader->name));
    PICTURES_FREE(&a, &b);
    if (c->mesh_flaw) { /* clusters that are anything: whatever it shows */
        config.fast = fast_all;
        struct picture any = picture_draw(&config, &scene, &camera);
        picture_free(&any);
    }
}

/* Read a card, check it, draw it. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct card c;
    memset(&c, 0, sizeof c);
    if (size < sizeof c.header)
        return 0;
    memcpy(&c.header, data, sizeof c.header);
    c.at = data + sizeof c.header;
    c.end = data + size;
    read_mesh(&c);
    read_texture(&c);
    uint32_t at = 0;
    c.mesh_flaw = zs_mesh_check(&c.mesh, &at);
    c.texture_flaw = zs_texture_check(&c.texture, &at);
    EXPECT(zs_flaw_string(c.mesh_flaw)[0] && zs_flaw_string(c.texture_flaw)[0]);
    for (size_t k = 0; k < KINDS(kind_shaders); k++)
        draw(&c, &kind_shaders[k]);
    for (int i = 0; i < c.n_blocks; i++)
        free(c.block[i]);
    return 0;
}
