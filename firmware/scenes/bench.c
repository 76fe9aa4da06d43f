/* The bench scenes: one still picture each, seen from the origin along -z through a pinhole with a
 * focal length of the picture's width, near 128 and far 16384 bench units.
 *
 * SPDX-License-Identifier: MIT
 */
#include "bench.h"
#include "meshes.h"
#include "stage.h"

#define LAYERS 8u

STAGE_PAINT(raw, zs_shade_raw);
STAGE_PAINT(flat, zs_shade_flat);

static void open_bench(struct demo_frame *f, uint16_t w)
{
    static const struct zs_rgb black = { 0, 0, 0 };
    stage_open(f, black);
    struct zs_camera *c = &f->camera;
    stage_unturned(c);
    c->projection = ZS_PERSPECTIVE;
    c->focal = (zs_uq32_32)w << 32;
    c->height = 0; /* not read */
    c->z_near = (zs_q48_16)BENCH_NEAR * BENCH_UNIT * 65536;
    c->z_far = (zs_q48_16)BENCH_FAR * BENCH_UNIT * 65536;
}

/* pose_NAME: what `put` puts there, whatever the time and the picture's height. */
#define STILL(name, put)                                                                                              \
    static void pose_##name(struct demo_frame *f, uint32_t t, uint16_t w, uint16_t h)                                 \
    {                                                                                                                 \
        (void)t;                                                                                                      \
        (void)h;                                                                                                      \
        put;                                                                                                          \
    }

/* ---- mesh: 2,520 triangles, half of them turned away, about 26,000 samples ------------------- */

static void put_bumpy(struct demo_frame *f, uint16_t w, const struct zs_mesh *mesh,
                      const struct zs_material *material)
{
    open_bench(f, w);
    zs_pose_turn(stage_put(f, mesh, material, 0, 0, -BENCH_BUMPY_Z * BENCH_UNIT, ZS_Q16_ONE),
                 5000, 3500, 0);
}

static void put_bumpy_lit(struct demo_frame *f, uint16_t w, const struct zs_mesh *mesh,
                          const struct zs_material *material)
{
    put_bumpy(f, w, mesh, material);
    stage_light(f, -3, 4, 5, 22, 78);
}

STILL(mesh, put_bumpy(f, w, &mesh_bumpy, &raw))
STILL(mesh_lit, put_bumpy_lit(f, w, &mesh_bumpy, &flat))

/* ---- mesh_tex: the same triangles, textured; a seam and the poles take 105 vertices more ----- */

STAGE_COVER(tex, zs_shade_texture, texture_map);
STAGE_COVER(tex_lit, zs_shade_texture_flat, texture_earth);
STAGE_COVER(tex_smooth, zs_shade_texture_smooth, texture_earth);

STILL(mesh_tex, put_bumpy(f, w, &mesh_bumpy_uv, &tex))
STILL(mesh_tex_lit, put_bumpy_lit(f, w, &mesh_bumpy_uv, &tex_lit))
STILL(mesh_tex_smooth, put_bumpy_lit(f, w, &mesh_bumpy_uv, &tex_smooth))

/* ---- relief: 2,520 triangles like a scanned head, three in five of which face the eye -------- */

static void put_relief(struct demo_frame *f, uint16_t w, const struct zs_material *material)
{
    open_bench(f, w);
    zs_pose_turn(stage_put(f, &mesh_relief, material, 0, 0, -BENCH_RELIEF_Z * BENCH_UNIT, ZS_Q16_ONE), 2400, 800, 0);
}

STILL(relief, put_relief(f, w, &raw))
STILL(relief_tex, put_relief(f, w, &tex))

/* ---- crowd: five such balls, each half behind those before it ---------------------------------------- */

#define CROWD 5

static void put_crowd(struct demo_frame *f, uint16_t w, int back_to_front)
{
    open_bench(f, w);
    stage_light(f, -3, 4, 5, 22, 78);
    for (int i = 0; i < CROWD; i++) {
        const int32_t k = back_to_front ? CROWD - 1 - i : i;
        const int32_t px = (BENCH_BUMPY_Z + 1300 * k) * BENCH_UNIT / 320; /* a pixel there */
        zs_pose_turn(stage_put(f, &mesh_bumpy_uv, &tex_smooth, (k & 1 ? 40 : -40) * px, (12 * k - 20) * px, -320 * px,
                               ZS_Q16_ONE),
                     (zs_turn)(5000 + 3000 * k), 3500, 0);
    }
}

STILL(crowd_ftb, put_crowd(f, w, 0))
STILL(crowd_btf, put_crowd(f, w, 1))

/* ---- floor_tex: two triangles through the near plane to the horizon, 36,160 samples ---------- */

static void pose_floor_tex(struct demo_frame *f, uint32_t t, uint16_t w, uint16_t h)
{
    (void)t;
    (void)h;
    open_bench(f, w);
    zs_pose_turn(stage_put(f, &mesh_plain, &tex, 0, 0, 0, ZS_Q16_ONE), 1500, 0, 0);
}

/* ---- layers: 8 full-screen trapezoids, 614,400 samples of the same picture ------------------- */

static void put_layers(struct demo_frame *f, uint16_t w, const uint8_t order[LAYERS])
{
    static const struct zs_material colors[LAYERS] = {
        { .shader = &zs_shade_raw, .rgb = { 230, 60, 60 }, .cull = ZS_CULL_BACK },
        { .shader = &zs_shade_raw, .rgb = { 230, 140, 40 }, .cull = ZS_CULL_BACK },
        { .shader = &zs_shade_raw, .rgb = { 220, 210, 50 }, .cull = ZS_CULL_BACK },
        { .shader = &zs_shade_raw, .rgb = { 70, 190, 80 }, .cull = ZS_CULL_BACK },
        { .shader = &zs_shade_raw, .rgb = { 50, 180, 190 }, .cull = ZS_CULL_BACK },
        { .shader = &zs_shade_raw, .rgb = { 60, 110, 220 }, .cull = ZS_CULL_BACK },
        { .shader = &zs_shade_raw, .rgb = { 130, 80, 210 }, .cull = ZS_CULL_BACK },
        { .shader = &zs_shade_raw, .rgb = { 200, 90, 180 }, .cull = ZS_CULL_BACK },
    };
    /* 1500 * 1.2^k bench units in uq16_16 of BENCH_LAYER_Z steps */
    static const uint32_t power[LAYERS] = { /* 1.2^k * 5^7 */
        78125u, 93750u, 112500u, 135000u, 162000u, 194400u, 233280u, 279936u,
    };
    open_bench(f, w);
    for (uint32_t i = 0; i < LAYERS; i++) {
        const uint32_t k = order[i];
        const uint64_t z = (uint64_t)1500u * BENCH_UNIT * 65536u * power[k];
        stage_put(f, &mesh_layer, &colors[k], 0, 0, 0,
                  (zs_uq16_16)(z / ((uint64_t)BENCH_LAYER_Z * 78125u)));
    }
}

static const uint8_t near_to_far[LAYERS] = { 0, 1, 2, 3, 4, 5, 6, 7 };
static const uint8_t far_to_near[LAYERS] = { 7, 6, 5, 4, 3, 2, 1, 0 };
static const uint8_t mixed[LAYERS] = { 3, 6, 0, 5, 7, 1, 4, 2 };

STILL(layers_ftb, put_layers(f, w, near_to_far))
STILL(layers_btf, put_layers(f, w, far_to_near))
STILL(layers_mixed, put_layers(f, w, mixed))

/* ---- sheet: 20,000 tiny triangles, 71,920 samples -------------------------------------------- */

static void pose_sheet(struct demo_frame *f, uint32_t t, uint16_t w, uint16_t h)
{
    (void)t;
    (void)h;
    open_bench(f, w);
    stage_put(f, &mesh_sheet, &raw, 0, 0, -6000 * BENCH_UNIT, ZS_Q16_ONE);
}

/* ---- corridor: its open end is behind the eye; five boxes run through each other ------------- */

static void pose_corridor(struct demo_frame *f, uint32_t t, uint16_t w, uint16_t h)
{
    static const struct {
        int16_t x, y, z, half; /* bench units */
        zs_turn yaw, pitch, roll;
    } boxes[5] = {
        { -420, -330, -3000, 420, 5000, 2500, 1200 },
        { -40, -80, -3250, 380, 9000, 6000, 3000 },
        { 380, 160, -3500, 400, 2000, 12000, 7000 },
        { 160, -420, -2850, 300, 14000, 4000, 9000 },
        { 900, -500, -3900, 560, 6000, 1000, 500 },
    };
    (void)t;
    (void)h;
    open_bench(f, w);
    stage_light(f, -2, 5, 6, 55, 50);
    stage_put(f, &mesh_corridor, &flat, 0, 0, 0, ZS_Q16_ONE);
    for (uint32_t i = 0; i < 5; i++) {
        struct zs_pose *p = /* the cube's half edge is 8192 steps of one world unit */
            stage_put(f, &mesh_cube, &flat, boxes[i].x * BENCH_UNIT, boxes[i].y * BENCH_UNIT,
                      boxes[i].z * BENCH_UNIT,
                      (zs_uq16_16)boxes[i].half * (BENCH_UNIT / 64u) * (65536u / 128u));
        zs_pose_turn(p, boxes[i].yaw, boxes[i].pitch, boxes[i].roll);
    }
}

/* ---- slivers: columns and rows from 0.05 to 2.5 px ------------------------------------------- */

static void pose_slivers(struct demo_frame *f, uint32_t t, uint16_t w, uint16_t h)
{
    (void)t;
    (void)h;
    open_bench(f, w);
    stage_put(f, &mesh_slivers, &raw, 0, 0, -BENCH_SLIVER_Z * BENCH_UNIT, ZS_Q16_ONE);
}

#define BENCH_VARYINGS(id, what_, varyings_, fast_, pose_)                                                             \
    const struct demo demo_##id = { .name = #id, .what = what_, .width = 320, .height = 240, .frames = 1,           \
                                    .varyings = varyings_, .bench = 1, .depth = &zs_depth_float, .fast = fast_,        \
                                    .pose = pose_ }
#define BENCH(id, what, pose) BENCH_VARYINGS(id, what, ZS_VARYINGS_FLAT, raw_fast, pose)

static const struct zs_fast *const raw_fast[] = { ZS_FAST_FRAME, ZS_FAST_RAW, ZS_FAST_END };
static const struct zs_fast *const flat_fast[] = { ZS_FAST_FRAME, ZS_FAST_FLAT, ZS_FAST_END };
static const struct zs_fast *const tex_fast[] = { ZS_FAST_FRAME, ZS_FAST_TEXTURE, ZS_FAST_565, ZS_FAST_END };
static const struct zs_fast *const lit_fast[] = { ZS_FAST_FRAME, ZS_FAST_TEXTURE_FLAT, ZS_FAST_PAL8, ZS_FAST_END };
static const struct zs_fast *const smooth_fast[] = { ZS_FAST_FRAME, ZS_FAST_TEXTURE_SMOOTH, ZS_FAST_PAL8, ZS_FAST_END };

BENCH(mesh, "A bumpy ball of 2,520 triangles over a third of the picture, unlit", pose_mesh);
BENCH_VARYINGS(mesh_lit, "The same ball, flat-shaded by its face normals", ZS_VARYINGS_FLAT, flat_fast, pose_mesh_lit);
BENCH_VARYINGS(mesh_tex, "The same ball, textured in RGB565, unlit", ZS_VARYINGS_TEXTURE, tex_fast, pose_mesh_tex);
BENCH_VARYINGS(mesh_tex_lit, "The same ball, textured by palette, flat-shaded", ZS_VARYINGS_TEXTURE, lit_fast,
          pose_mesh_tex_lit);
BENCH_VARYINGS(mesh_tex_smooth, "The same ball, textured by palette, smooth-shaded",
          ZS_VARYINGS_TEXTURE_SMOOTH, smooth_fast, pose_mesh_tex_smooth);
BENCH(relief, "A head of 2,520 triangles, open behind, with folds and thin parts, unlit", pose_relief);
BENCH_VARYINGS(relief_tex, "The same head, textured in RGB565, unlit", ZS_VARYINGS_TEXTURE, tex_fast, pose_relief_tex);
BENCH_VARYINGS(crowd_ftb, "Five such balls half behind one another, from front to back", ZS_VARYINGS_TEXTURE_SMOOTH,
               smooth_fast, pose_crowd_ftb);
BENCH_VARYINGS(crowd_btf, "The same from back to front", ZS_VARYINGS_TEXTURE_SMOOTH, smooth_fast, pose_crowd_btf);
BENCH_VARYINGS(floor_tex, "A textured plain to the horizon, cut at the near plane", ZS_VARYINGS_TEXTURE, tex_fast,
          pose_floor_tex);
BENCH(layers_ftb, "Eight full-screen layers from front to back", pose_layers_ftb);
BENCH(layers_btf, "Eight full-screen layers from back to front", pose_layers_btf);
BENCH(layers_mixed, "Eight full-screen layers in mixed order", pose_layers_mixed);
BENCH(sheet, "A jittered sheet of 20,000 tiny triangles", pose_sheet);
BENCH_VARYINGS(corridor, "A corridor through the near plane with five boxes that cross each other", ZS_VARYINGS_FLAT,
            flat_fast, pose_corridor);
BENCH(slivers, "A grid of slivers from a twentieth of a pixel to two and a half", pose_slivers);
