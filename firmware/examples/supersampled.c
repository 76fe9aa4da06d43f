/* Four samples a pixel: a wheel with smooth edges, and a line over it that is drawn after the average.
 *
 * SPDX-License-Identifier: MIT
 */
#include "examples.h"
#include "zs_supersample.h"

ZS_RENDERER_2X2(screen, EXAMPLE_W, EXAMPLE_H, 8, 16, 16, ZS_VARYINGS_FLAT);

#define SPOKES 4

static void line_draw(void *ctx, const struct zs_target *t)
{
    (void)ctx;
    if (t->y0 <= 2 && 2 < t->y1)
        for (uint32_t x = t->x0; x < t->x1; x++)
            t->color[(2u - t->y0) * t->pitch + x] = zs_wire565(255, 255, 255);
}

/* ---- A frame ---------------------------------------------------------------------------------------------------- */

static const int16_t pos[3 * SPOKES][3] = { { 0, 0, 0 },      { 120, 0, 0 },   { 110, 40, 0 }, { 0, 0, 0 },
                                            { 0, 120, 0 },    { -40, 110, 0 }, { 0, 0, 0 },    { -120, 0, 0 },
                                            { -110, -40, 0 }, { 0, 0, 0 },     { 0, -120, 0 }, { 40, -110, 0 } };
static const uint16_t tri[SPOKES][3] = { { 0, 1, 2 }, { 3, 4, 5 }, { 6, 7, 8 }, { 9, 10, 11 } };
static const struct zs_mesh wheel = { .pos = pos, .tri = tri, .n_verts = 3 * SPOKES, .n_tris = SPOKES, .radius = 120 };
static const struct zs_material green = { .shader = &zs_shade_raw, .rgb = ZS_RGB(0x00ff00) };

int example_supersampled(uint32_t t, const struct zs_sink *sink)
{
    static const struct zs_resolve line = { .draw = line_draw };
    struct zs_instance instance = { .mesh = &wheel, .material = &green };
    const struct zs_scene scene = { .instance = &instance, .n_instances = 1 };
    struct zs_camera camera;
    const int32_t at[3] = { 0, 0, 0 };
    screen_config.depth = &zs_depth_float;
    zs_pose_turn(&instance.pose, 0, 0, (zs_turn)(t * 1000u + 2000u));
    int err = zs_camera_perspective(&camera, ZS_DEGREES(45), 2 * EXAMPLE_H, 50, 2000); /* the height in samples */
    err = err ? err : zs_camera_orbit(&camera, at, 350, 0, 0);
    err = err ? err : ZS_INIT(screen);
    err = err ? err : zs_supersample_init(&screen_2x2, &screen, sink);
    if (err)
        return err;
    screen_2x2.resolve = &line;
    screen_2x2.n_resolves = 1;
    return zs_render(&screen, &scene, &camera, &screen_2x2.sink);
}
