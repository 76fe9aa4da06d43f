/* A shader of your own: rings around a point of each face, over what is there already.
 *
 * SPDX-License-Identifier: MIT
 */
#include "examples.h"
#include "zs_shader.h"

/* ---- The shader ------------------------------------------------------------------------------------------------ */

static void rings_vertex(const struct zs_shading *s, uint32_t v, uint16_t *out)
{
    out[0] = (uint16_t)(s->instance->mesh->pos[v][0] * 1024 + 32768);
    out[1] = (uint16_t)(s->instance->mesh->pos[v][1] * 1024 + 32768);
}

static void rings_fragment(const struct zs_instance *instance, struct zs_fragment *f)
{
    const int32_t x = (f->v[0] - 32768) >> 6, y = (f->v[1] - 32768) >> 6;
    const struct zs_rgb *c = &instance->material->rgb;
    if (((x * x + y * y) >> 12) & 4) /* every other ring; between them the picture stays */
        *f->color = zs_wire565(c->r, c->g, c->b);
}

static const struct zs_shader rings = {
    .vertex = rings_vertex, .fragment = rings_fragment, ZS_FRAGMENTS, .n_varyings = 2
};

/* ---- A frame ---------------------------------------------------------------------------------------------------- */

ZS_RENDERER(screen, EXAMPLE_W, EXAMPLE_H, 8, 8, 8, 2);

static const int16_t pos[4][3] = { { -16, -12, 0 }, { 16, -12, 0 }, { 16, 12, 0 }, { -16, 12, 0 } };
static const uint16_t tri[2][3] = { { 0, 1, 2 }, { 0, 2, 3 } };
static const struct zs_mesh card = { .pos = pos, .tri = tri, .n_verts = 4, .n_tris = 2, .radius = 21 };
static const struct zs_material yellow = { .shader = &rings, .rgb = ZS_RGB(0xffdc00), .cull = ZS_CULL_NONE };

int example_user_shader(uint32_t t, const struct zs_sink *sink)
{
    struct zs_instance instance = { .mesh = &card, .material = &yellow };
    const struct zs_scene scene = { .instance = &instance, .n_instances = 1, .background = ZS_RGB565(0x000050) };
    struct zs_camera camera;
    const int32_t at[3] = { 0, 0, 0 };
    screen_config.depth = &zs_depth_float;
    zs_pose_turn(&instance.pose, (zs_turn)(t * 1000u), 0, 0);
    int err = zs_camera_perspective(&camera, ZS_DEGREES(55), EXAMPLE_H, 5, 200);
    err = err ? err : zs_camera_orbit(&camera, at, 30, 0, 0);
    err = err ? err : ZS_INIT(screen);
    return err ? err : zs_render(&screen, &scene, &camera, sink);
}
