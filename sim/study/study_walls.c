/* Walls, and two of them drawn.
 *
 * SPDX-License-Identifier: MIT
 */
#include "study_walls.h"

#include <math.h>
#include <string.h>

#include "frame.h"

#define W STUDY_WALLS_W
#define H STUDY_WALLS_H
#define NEAR STUDY_WALLS_NEAR

static const uint16_t wall_tri[2][3] = { { 0, 1, 2 }, { 0, 2, 3 } };

void study_wall(struct study_wall *w, double z, const double slope[2])
{
    static const double corner[4][2] = { { -1, -1 }, { 1, -1 }, { 1, 1 }, { -1, 1 } };
    const double scale = z / 20000.0, unit = floor(scale * 65536.0 + 1.0) / 65536.0;
    memset(w, 0, sizeof *w);
    for (int k = 0; k < 4; k++) {
        const double x = corner[k][0] * z * 0.8, y = corner[k][1] * z * 0.8;
        const double p[3] = { x, y, -(z + x * slope[0] + y * slope[1]) };
        for (int c = 0; c < 3; c++) {
            const double steps = floor(p[c] / unit * 256.0 + 0.5);
            const double whole = floor(steps / 256.0);
            w->pos[k][c] = (int16_t)whole;
            w->lo[k][c] = (uint8_t)(steps - whole * 256.0);
        }
    }
    w->mesh.pos = (const int16_t(*)[3])w->pos;
    w->mesh.pos_lo = (const uint8_t(*)[3])w->lo;
    w->mesh.tri = wall_tri;
    w->mesh.n_verts = 4;
    w->mesh.n_tris = 2;
    w->mesh.scale = (zs_uq16_16)(unit * 65536.0);
    w->mesh.center[2] = -20000;
    w->mesh.radius = 26000;
}

int study_walls_in_order(const struct zs_depth *depth, int bits, double far_over_near, const struct study_wall w[2],
                         int swap)
{
    static const struct zs_material paint[2] = {
        { .shader = &zs_shade_raw, .rgb = { 255, 255, 255 }, .cull = ZS_CULL_NONE },
        { .shader = &zs_shade_raw, .rgb = { 255, 0, 0 }, .cull = ZS_CULL_NONE }
    };
    struct zs_instance in[2];
    struct zs_camera camera;
    struct zs_config config;
    struct sim_frame frame;
    int good = 1;
    for (int k = 0; k < 2; k++) {
        const int which = swap ? 1 - k : k;
        in[k] = (struct zs_instance){ .mesh = &w[which].mesh, .material = &paint[which] };
        zs_pose_identity(&in[k].pose);
    }
    const struct zs_scene scene = { .instance = in, .n_instances = 2 };
    (void)zs_camera_perspective(&camera, 8192, H, NEAR, 2 * NEAR);
    camera.z_far = (zs_q48_16)(far_over_near * NEAR * 65536.0);
    sim_frame_config(&config, W, H, ZS_VARYINGS_FLAT);
    config.depth = depth;
    config.depth_bits = (uint8_t)bits;
    config.max_tris = config.max_verts = 64;
    const int err = sim_frame_render(&frame, &scene, &camera, &config, NULL);
    if (err != ZS_OK)
        return err < 0 ? err : -1;
    for (size_t i = 0; i < (size_t)W * H; i++)
        good &= frame.rgb565[i] == 0xffffu;
    sim_frame_free(&frame);
    return good;
}
