/* What every scene does to fill a struct demo_frame.
 *
 * SPDX-License-Identifier: MIT
 */
#include "stage.h"

const int32_t stage_origin[3] = { 0, 0, 0 };

void stage_open(struct demo_frame *f, struct zs_rgb background)
{
    const struct zs_scene none = { .instance = f->instance };
    f->scene = none;
    f->scene.background = zs_rgb565(background.r, background.g, background.b);
    stage_light(f, 0, 1, 0, 100, 0); /* unlit scenes stop here */
}

void stage_light(struct demo_frame *f, int32_t x, int32_t y, int32_t z, uint32_t ambient_percent,
                 uint32_t diffuse_percent)
{
    const int32_t dir[3] = { x, y, z };
    zs_unit(f->scene.light.dir, dir);
    f->scene.light.ambient = ZS_Q16_ONE * ambient_percent / 100u;
    f->scene.light.diffuse = ZS_Q16_ONE * diffuse_percent / 100u;
}

struct zs_pose *stage_put(struct demo_frame *f, const struct zs_mesh *mesh,
                          const struct zs_material *material, int32_t x, int32_t y, int32_t z,
                          zs_uq16_16 scale)
{
    struct zs_instance *i = &f->instance[f->scene.n_instances++];
    i->mesh = mesh;
    i->material = material;
    zs_pose_identity(&i->pose);
    i->pose.pos[0] = x;
    i->pose.pos[1] = y;
    i->pose.pos[2] = z;
    i->pose.scale = scale;
    i->depth_state = 0;
    return &i->pose;
}

void stage_lens(struct demo_frame *f, zs_turn fov, uint16_t w, uint16_t h, int32_t z_near,
                int32_t z_far)
{
    zs_camera_perspective(&f->camera, fov, w < h ? w : h, z_near, z_far);
}

zs_turn stage_turn(uint32_t t, uint32_t n, uint32_t times)
{
    return (zs_turn)((t % n * times % n * 65536u + n / 2u) / n); /* n <= 65535 */
}

static int32_t times_q30(int32_t radius, zs_q2_30 q)
{
    return (int32_t)(((int64_t)radius * q + ((int64_t)1 << 29)) >> 30);
}

int32_t stage_sin(int32_t radius, zs_turn a)
{
    return times_q30(radius, zs_sin(a));
}

int32_t stage_cos(int32_t radius, zs_turn a)
{
    return times_q30(radius, zs_cos(a));
}
