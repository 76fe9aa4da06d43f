/* SPDX-License-Identifier: MIT */
#include "good.h"

#include <string.h>

#include "picture.h"
#include "shapes.h"

static struct shape ball;

struct good good_scene(void)
{
    static struct zs_material material;
    static struct zs_instance instance;
    if (!ball.mesh.n_tris)
        shape_sphere(&ball, 6, 8, 3000);
    struct good g;
    memset(&g, 0, sizeof g);
    g.config = picture_config(40, 30, &zs_depth_recip);
    g.config.strip_h = 7;
    g.config.max_tris = g.config.max_verts = 200;
    const struct zs_material m = { .shader = &zs_shade_flat, .rgb = { 255, 200, 100 }, .cull = ZS_CULL_BACK };
    material = m;
    instance.mesh = &ball.mesh;
    instance.material = &material;
    zs_pose_identity(&instance.pose);
    instance.pose.pos[2] = -9000;
    g.instance = instance;
    g.material = material;
    g.scene.instance = &instance;
    g.scene.n_instances = 1;
    g.scene.light.dir[2] = ZS_Q30_ONE;
    g.scene.light.diffuse = ZS_Q16_ONE;
    (void)zs_camera_perspective(&g.camera, 8192, 30, 100, 20000);
    return g;
}
