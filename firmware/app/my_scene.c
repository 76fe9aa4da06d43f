/* A scene of your own: change this file, or copy it and build yours with APP_SCENE=path/to/it.c.
 *
 *   make firmware BOARD=pico SCENE=mine
 *
 * A pyramid turns above a floor. Lengths are in world units, here 1000 to the metre; +y is up, counter-clockwise is the
 * front of a triangle (firmware/zstrip/zstrip.h has all conventions). A model from a file: `build/zsim convert` writes
 * C to put in place of the arrays.
 *
 * SPDX-License-Identifier: MIT
 */
#include "show.h"

#define FRAMES 90u /* of the animation, which then repeats */
#define RATE 30    /* of them a second; a board that is too slow leaves some out */

/* ---- Meshes: const, so that they stay in flash ----------------------------------------------------------- */

static const int16_t pyramid_at[5][3] = { { -1, 0, 1 }, { 1, 0, 1 }, { 1, 0, -1 }, { -1, 0, -1 }, { 0, 2, 0 } };
static const uint16_t pyramid_tri[6][3] = { { 0, 1, 4 }, { 1, 2, 4 }, { 2, 3, 4 }, { 3, 0, 4 },
                                            { 0, 3, 2 }, { 0, 2, 1 } };
static const struct zs_rgb pyramid_rgb[6] = { ZS_RGB(0xe64632), ZS_RGB(0xf0be3c), ZS_RGB(0x46aa5a),
                                              ZS_RGB(0x466edc), ZS_RGB(0x808080), ZS_RGB(0x808080) };
static const struct zs_mesh pyramid = {
    .pos = pyramid_at, .tri = pyramid_tri, .face_rgb = pyramid_rgb, .n_verts = 5, .n_tris = 6,
    .scale = 1000 * ZS_Q16_ONE, /* a step of the mesh is a metre */
    .center = { 0, 1, 0 }, .radius = 2,
};

static const int16_t floor_at[4][3] = { { -3, 0, 3 }, { 3, 0, 3 }, { 3, 0, -3 }, { -3, 0, -3 } };
static const uint16_t floor_tri[2][3] = { { 0, 1, 2 }, { 0, 2, 3 } };
static const struct zs_mesh ground = {
    .pos = floor_at, .tri = floor_tri, .n_verts = 4, .n_tris = 2, .scale = 1000 * ZS_Q16_ONE, .radius = 5,
};

static const struct zs_material painted = { .shader = &zs_shade_flat };
static const struct zs_material grey = { .shader = &zs_shade_flat, .rgb = ZS_RGB(0x5a606e) };

/* ---- Frame t: what stands where, the light, the camera ----------------------------------------------------- */

static void pose(struct demo_frame *f, uint32_t t, uint16_t w, uint16_t h)
{
    static const int32_t middle[3] = { 0, 800, 0 }, sun[3] = { 2, 4, 3 };
    const zs_turn angle = (zs_turn)(t % FRAMES * 65536u / FRAMES); /* 65536 is a full turn */

    f->instance[0] = (struct zs_instance){ .mesh = &ground, .material = &grey };
    f->instance[1] = (struct zs_instance){ .mesh = &pyramid, .material = &painted };
    zs_pose_turn(&f->instance[1].pose, angle, 0, 0);
    f->instance[1].pose.pos[1] = 300; /* above the floor */

    f->scene.instance = f->instance;
    f->scene.n_instances = 2; /* at most DEMO_INSTANCES_MAX */
    f->scene.background = ZS_RGB565(0x141c34);
    zs_unit(f->scene.light.dir, sun);
    f->scene.light.ambient = ZS_Q16_ONE / 4;
    f->scene.light.diffuse = ZS_Q16_ONE * 3 / 4;

    zs_camera_perspective(&f->camera, ZS_DEGREES(45), w < h ? w : h, 1000, 30000); /* from 1 to 30 metres */
    zs_camera_orbit(&f->camera, middle, 7000, 0, ZS_PITCH(22));
}

/* Accelerators: what is named here is linked and makes frames quicker; the picture stays the same. Other shaders and
 * textures have others (firmware/zstrip/zs_fast.h), ZS_FAST_CLUSTERS is for large models from `zsim convert`. With
 * .fast = 0 it takes least flash. */
static const struct zs_fast *const fast[] = { ZS_FAST_FRAME, ZS_FAST_FLAT, ZS_FAST_END };

static const struct demo mine = {
    .name = "mine", .what = "A pyramid turns above a floor", .width = SHOW_WIDTH, .height = SHOW_HEIGHT,
    .frames = FRAMES, .varyings = ZS_VARYINGS_FLAT, .depth = &zs_depth_float, .fast = fast, .pose = pose,
};

/* 60 rows to a strip, 100 triangles and 100 vertices at a time: more of each is quicker, until RAM ends. */
SHOW(mine, RATE, 60, 100, 100, ZS_VARYINGS_FLAT);
