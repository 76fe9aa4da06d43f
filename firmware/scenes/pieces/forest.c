/* A walk through a forest in the mist: trunks, firs and ferns that are cut out of cards which turn to the eye, a path
 * whose texture is filtered, and fog.
 *
 * SPDX-License-Identifier: MIT
 */
#include "backdrop.h"
#include "meshes.h"
#include "pieces.h"
#include "wood.h"
#include "zs_environment.h"
#include "zs_filter.h"
#include "zs_fog.h"

#define FRAMES 96u
#define MIST 0xccd2c4
#define NEAR 500
#define FAR 24000
#define ROW 2000 /* from row to row of trees */
#define ROWS (WOOD_PERIOD / ROW)
#define EYE 1550

static const struct zs_material bark = { .shader = &zs_shade_smooth, .rgb = { 255, 255, 255 } },
                                path = { .shader = &zs_shade_mipmap_bilinear, .texture = &texture_forest_floor },
                                fir = { .shader = &zs_shade_cutout,
                                        .texture = &texture_forest_fir,
                                        .cull = ZS_CULL_NONE },
                                fern = { .shader = &zs_shade_cutout,
                                         .texture = &texture_forest_fern,
                                         .cull = ZS_CULL_NONE };

/* A larch in autumn is the fir in other colours. */
#define COLORS_MAX 256u
static uint16_t gold_palette[2u * COLORS_MAX];
static struct zs_texture larch_texture;
static const struct zs_material larch = { .shader = &zs_shade_cutout,
                                          .texture = &larch_texture,
                                          .cull = ZS_CULL_NONE };

static uint16_t to_gold(uint16_t color)
{
    const uint32_t r = color >> 11, g = color >> 5 & 63u, b = color & 31u, red = r * 11u / 8u + 5u;
    if (2u * r >= g) /* the trunk */
        return color;
    return (uint16_t)((red > 31u ? 31u : red) << 11 | g << 5 | b / 2u);
}

static void set_larch(void)
{
    const uint32_t n = texture_forest_fir.n_colors;
    larch_texture = texture_forest_fir;
    if (n > COLORS_MAX)
        return;
    for (uint32_t i = 0; i < n; i++) {
        gold_palette[i] = to_gold(texture_forest_fir.palette[i]);
        gold_palette[n + i] = texture_forest_fir.palette[n + i]; /* alphas */
    }
    larch_texture.palette = gold_palette;
}

static struct zs_fog mist = { .color = ZS_RGB565(MIST), .start = 2500, .end = 22000 };
static const struct zs_resolve hook = { .draw = zs_fog_draw, .changes = zs_fog_changes, .ctx = &mist };
static struct backdrop air;
static const struct zs_background sky = { .fill = backdrop_sky_fill, .ctx = &air };

/* ---- Trees ------------------------------------------------------------------------------------------------------ */

#define THINGS 176u
static struct zs_instance thing[THINGS];
static uint32_t things;

/* The same for every period. */
static uint32_t dice(int32_t row, uint32_t of)
{
    uint32_t h = (uint32_t)((row % ROWS + ROWS) % ROWS) * 0x9e3779b9u ^ of * 0x85ebca6bu;
    h = (h ^ h >> 15) * 0x2c1b3c6du;
    h = (h ^ h >> 12) * 0x297a2d39u;
    return h ^ h >> 15;
}

/* The path's middle at z. */
static int32_t middle(int32_t z)
{
    return stage_sin(WOOD_BEND, (zs_turn)((z + WOOD_PERIOD / 2) * 1024 / (WOOD_PERIOD / 64)));
}

static struct zs_instance *put(const struct zs_mesh *mesh, const struct zs_material *material, int32_t x, int32_t z,
                               zs_uq16_16 scale)
{
    struct zs_instance *i = &thing[things < THINGS ? things++ : THINGS - 1u];
    *i = (struct zs_instance){ .mesh = mesh, .material = material, .pose = { .pos = { x, 0, z }, .scale = scale } };
    return i;
}

/* Parallel to the screen: its texture is affine, at a third of the cost. (Crossed cards would show where they meet.) */
static void put_facing(const struct zs_camera *camera, const struct zs_mesh *mesh, const struct zs_material *material,
                       int32_t x, int32_t y, int32_t z, zs_uq16_16 scale)
{
    struct zs_pose *pose = &put(mesh, material, x, z, scale)->pose;
    pose->pos[1] = y;
    zs_pose_face(pose, camera);
}

/* A tree of row `row`, to a side, `rank` 0 .. 2 away from the path. */
static void put_tree(const struct zs_camera *camera, int32_t row, int32_t side, int32_t rank)
{
    const uint32_t d = dice(row, (uint32_t)(rank * 2 + (side > 0)));
    const int32_t z = -row * ROW - (int32_t)(d % 1000u),
                  away = 2900 + rank * 2700 + (int32_t)(d >> 10 & 1023u) * 3 / 2;
    const int32_t x = middle(z) + side * away;
    const struct zs_material *const kind = d % 8u == 5u ? &larch : &fir;
    const zs_uq16_16 scale = ZS_Q16_ONE * 3u / 4u + (d >> 20 & 255u) * 128u;
    if (rank == 0 && d % 3u == 0)
        zs_pose_turn(&put(&mesh_forest_trunk, &bark, x, z, scale + ZS_Q16_ONE / 4u)->pose, (zs_turn)d,
                     (zs_turn)(d % 600u - 300u), 0);
    else
        put_facing(camera, &mesh_forest_fir, kind, x, -330, z, scale); /* boughs lie on the ground */
    if (rank == 0 && d % 5u < 3u)
        put_facing(camera, &mesh_forest_fern, &fern, x - side * (900 + (int32_t)(d % 500u)), 0, z + 500, scale);
}

/* From near to far: what is hidden is not coloured. */
static void put_trees(const struct zs_camera *camera)
{
    const int32_t first = -camera->pos[2] / ROW - 1;
    for (int32_t row = first; row < first + FAR / ROW; row++)
        for (int32_t rank = 0; rank < (row > first + 4 ? 3 : 2); rank++) /* near ones hide the third */
            for (int32_t side = -1; side <= 1; side += 2)
                put_tree(camera, row, side, rank);
    for (int32_t k = 1; k >= -2; k--)
        put(&mesh_forest_ground, &path, 0, k * WOOD_PERIOD, 0);
}

/* ---- A frame ---------------------------------------------------------------------------------------------------- */

static void pose(struct demo_frame *f, uint32_t t, uint16_t w, uint16_t h)
{
    static const struct zs_rgb mist_rgb = ZS_RGB(MIST);
    const struct zs_config config = { .width = w, .height = h, .depth_bits = 16, .depth = &zs_depth_float };
    const struct zs_rect whole = { 0, 0, w, h };
    const int32_t up[3] = { 0, 1, 0 }, z = -(int32_t)(t % FRAMES * WOOD_PERIOD / FRAMES), ahead = z - 5000;
    const int32_t eye[3] = { middle(z), EYE + stage_sin(28, stage_turn(t, FRAMES, 12)), z };
    const int32_t at[3] = { middle(ahead), EYE + 260, ahead };
    stage_open(f, mist_rgb);
    stage_light(f, 5, 6, -3, 52, 60);
    stage_lens(f, ZS_DEGREES(54), w, h, NEAR, FAR);
    (void)zs_camera_look_at(&f->camera, eye, at, up);
    stage_orbit(&f->camera, 0);
    things = 0;
    put_trees(&f->camera);
    if (!larch_texture.format)
        set_larch();
    backdrop_colors(&air, mist_rgb, (struct zs_rgb)ZS_RGB(0xa4bcbc));
    backdrop_sky(&air, &f->camera, &whole, NULL);
    (void)zs_fog_set(&mist, &config, &f->camera);
    f->scene.instance = thing;
    f->scene.n_instances = things;
    f->scene.sky = &sky;
    f->scene.resolve = &hook;
    f->scene.n_resolves = 1;
}

PIECE(forest, "A walk through a forest in the mist: firs and ferns cut out of cards, and a path", FRAMES,
      ZS_VARYINGS_SMOOTH, NULL, NULL, 0, pose, ZS_FAST_FRAME, ZS_FAST_SMOOTH);
