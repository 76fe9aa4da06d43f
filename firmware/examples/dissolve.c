/* A card that dissolves: the fragment stage leaves pixels alone, and what was drawn before shows through.
 *
 * A pixel that is left alone has passed the depth test, and its key is written: draw what shows through first.
 *
 * SPDX-License-Identifier: MIT
 */
#include "examples.h"
#include "zs_shader.h"

struct dissolving {
    struct zs_material material; /* what the instance names; the rest is for the stages */
    uint32_t gone;               /* parts of 256 that have dissolved */
};

static void dissolve_vertex(const struct zs_shading *s, uint32_t v, uint16_t *out)
{
    out[0] = (uint16_t)(s->instance->mesh->pos[v][0] + 32768);
    out[1] = (uint16_t)(s->instance->mesh->pos[v][1] + 32768);
}

static void dissolve_fragment(const struct zs_instance *instance, struct zs_fragment *f)
{
    const struct dissolving *d = (const struct dissolving *)instance->material;
    uint32_t noise = (f->v[0] / 100u * 0x9e3779b1u) ^ (f->v[1] / 100u * 0x85ebca6bu); /* of squares of the card */
    noise = (noise ^ noise >> 15) * 0x2c1b3c6du;
    const uint32_t at = noise >> 24;
    if (at >= d->gone + 24u)
        *f->color = zs_wire565(d->material.rgb.r, d->material.rgb.g, d->material.rgb.b);
    else if (at >= d->gone)
        *f->color = zs_wire565(255, 220, 60); /* about to go: it glows */
}

static const struct zs_shader dissolve = {
    .vertex = dissolve_vertex, .fragment = dissolve_fragment, ZS_FRAGMENTS, .n_varyings = 2
};
static const int16_t pos[4][3] = { { -1300, -900, 0 }, { 1300, -900, 0 }, { 1300, 900, 0 }, { -1300, 900, 0 } };
static const uint16_t tri[2][3] = { { 0, 1, 2 }, { 0, 2, 3 } };
static const struct zs_mesh card = { .pos = pos, .tri = tri, .n_verts = 4, .n_tris = 2, .radius = 1582 };
static const struct zs_material behind = { .shader = &zs_shade_raw, .rgb = ZS_RGB(0x2060c0) };
ZS_RENDERER(screen, EXAMPLE_W, EXAMPLE_H, 8, 8, 8, 2);

int example_dissolve(uint32_t t, const struct zs_sink *sink)
{
    const struct dissolving front = { { .shader = &dissolve, .rgb = ZS_RGB(0xc02020) }, 100u + t };
    const struct zs_instance instance[2] = { { .mesh = &card, .material = &behind, .pose = { .pos = { 0, 0, -900 } } },
                                             { .mesh = &card, .material = &front.material } };
    const struct zs_scene scene = { .instance = instance, .n_instances = 2 };
    struct zs_camera camera;
    const int32_t at[3] = { 0, 0, 0 };
    screen_config.depth = &zs_depth_float;
    int err = zs_camera_perspective(&camera, ZS_DEGREES(50), EXAMPLE_H, 100, 9000);
    err = err ? err : zs_camera_orbit(&camera, at, 2700, ZS_DEGREES(10), 0);
    err = err ? err : ZS_INIT(screen);
    return err ? err : zs_render(&screen, &scene, &camera, sink);
}
