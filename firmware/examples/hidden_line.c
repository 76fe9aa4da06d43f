/* Hidden lines: a wedge on a plate, drawn by the edges that can be seen. Faces write depth only, and are pushed back.
 *
 * SPDX-License-Identifier: MIT
 */
#include "examples.h"
#include "zs_lines.h"

ZS_RENDERER(screen, EXAMPLE_W, EXAMPLE_H, 8, 64, 64, ZS_VARYINGS_FLAT);

static const int16_t pos[10][3] = { { -9, -4, 9 }, { 9, -4, 9 }, { -9, -4, -9 }, { 9, -4, -9 }, { -5, -4, 6 },
                                    { 5, -4, 6 },  { 5, -4, -6 }, { -5, -4, -6 }, { -5, 5, 0 }, { 5, 5, 0 } };
static const uint16_t tri[8][3] = { { 0, 1, 3 }, { 0, 3, 2 }, { 4, 5, 9 }, { 4, 9, 8 },
                                    { 6, 7, 8 }, { 6, 8, 9 }, { 5, 6, 9 }, { 7, 4, 8 } };
static const struct zs_mesh mesh = { .pos = pos, .tri = tri, .n_verts = 10, .n_tris = 8, .radius = 14 };

int example_hidden_line(uint32_t t, const struct zs_sink *sink)
{
    static struct zs_mesh_edge edge[3 * 8];
    static uint16_t pair[3 * 8][2];
    static const int32_t middle[3] = { 0, -1, 0 };
    static const struct zs_depth_state pushed_back = ZS_HIDDEN_LINE_STATE;
    static const struct zs_material hides = { .shader = &zs_shade_none, .cull = ZS_CULL_NONE };
    struct zs_lines lines = { ZS_LINES(pair, 0), .width = 1 };
    const struct zs_material ink = { .shader = &zs_shade_plain,
                                     .rgb = ZS_RGB(0xffffff),
                                     .primitive = &lines.primitive };
    const struct zs_instance instance[2] = { { .mesh = &mesh, .material = &hides, .depth_state = &pushed_back },
                                             { .mesh = &mesh, .material = &ink } };
    const struct zs_scene scene = { .instance = instance, .n_instances = 2 };
    struct zs_camera camera;
    /* once, when the mesh is known; with silhouettes, anew in each frame */
    const int32_t n = zs_edges_of(edge, &mesh);
    if (n < 0)
        return n;
    lines.primitive.n = zs_edges_choose(pair, 3 * 8, edge, (uint32_t)n, &mesh, ZS_EDGE_BORDER | ZS_EDGE_CREASE,
                                        ZS_DEGREES(20), NULL, NULL);
    screen_config.depth = &zs_depth_recip;
    int err = zs_camera_perspective(&camera, ZS_DEGREES(45), EXAMPLE_H, 8, 100);
    err = err ? err : zs_camera_orbit(&camera, middle, 28, (zs_turn)(ZS_DEGREES(25) + t), ZS_DEGREES(30));
    err = err ? err : ZS_INIT(screen);
    return err ? err : zs_render(&screen, &scene, &camera, sink);
}
