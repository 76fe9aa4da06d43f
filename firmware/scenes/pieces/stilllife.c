/* A still life: fruit in a bowl, a vase, a glass of wine, and an oval mirror that shows all of it from behind. Lit by
 * three lamps; shadows are flattened onto the table; the glass is a shader of its own.
 *
 * SPDX-License-Identifier: MIT
 */
#include "backdrop.h"
#include "meshes.h"
#include "pieces.h"
#include "zs_blend.h"
#include "zs_environment.h"
#include "zs_filter.h"
#include "zs_lights.h"
#include "zs_shadow.h"

#define FRAMES 60u
#define DISTANCE 7400 /* of the eye from the middle, units */

/* ---- Light ---------------------------------------------------------------------------------------------------- */

static struct zs_lamp lamp[3] = { { .rgb = ZS_RGB(0xfff0d4) },
                                  { .rgb = ZS_RGB(0x3c5890) },
                                  { .rgb = ZS_RGB(0x402818) } };
static const struct zs_lighting lights = { .lamp = lamp, .n_lamps = 3, .ambient = ZS_RGB(0x38343c) };
static struct zs_shine gloss, wax;

#define LIT(name, color, table, glint)                                                                                \
    static const struct zs_lit_material name = { .material = { .shader = &zs_shade_lit, .rgb = ZS_RGB(color) },       \
                                                 .lighting = &lights,                                                 \
                                                 .shine = &table,                                                     \
                                                 .specular = ZS_RGB(glint) }
LIT(painted, 0xffffff, gloss, 0xd0d0d0); /* its faces' colours */
LIT(orange, 0xf08418, wax, 0x383028);
LIT(apple, 0xb81c1c, gloss, 0x808080);
LIT(pear, 0xa8b430, wax, 0x404030);
LIT(lemon, 0xf0cc20, wax, 0x484038);
LIT(wine, 0x60081c, gloss, 0x606060);
static const struct zs_lit_material bark = { .material = { .shader = &zs_shade_lit_face, .rgb = ZS_RGB(0x5c3c1c) },
                                             .lighting = &lights };

static const struct zs_material wood = { .shader = &zs_shade_texture, .texture = &texture_still_wood },
                                dark = { .shader = &zs_shade_shadow, .rgb = ZS_RGB(0x606060) },
                                dark_both = { .shader = &zs_shade_shadow,
                                              .rgb = ZS_RGB(0x606060),
                                              .cull = ZS_CULL_NONE },
                                silver = { .shader = &zs_shade_window };

/* ---- Glass: bright where it is seen from the side, and where it mirrors the lamp -------------------------------- */

static int32_t to_eye[3], half_way[3]; /* q14 */

static int32_t dot(const zs_q1_15 n[3], const int32_t v[3])
{
    return (n[0] * v[0] + n[1] * v[1] + n[2] * v[2]) >> 14; /* q15: both are unit vectors */
}

static void glass_vertex(const struct zs_shading *s, uint32_t v, uint16_t *out)
{
    const zs_q1_15 *n = s->instance->mesh->normal[v];
    int32_t facing = dot(n, to_eye), glint = dot(n, half_way);
    facing = facing < 0 ? -facing : facing;
    facing = facing > 32767 ? 32767 : facing;
    glint = glint < 0 ? -glint : glint;
    int32_t edge = 32767 - facing;
    edge = edge * edge >> 15;
    glint = glint > 30400 ? (glint - 30400) * 10 : 0;
    const int32_t all = 2200 + edge * 5 / 4 + glint;
    out[0] = (uint16_t)(all < 0 ? 0 : all > 60000 ? 60000 : all);
}

/* Towards a pale green, by the varying: layers give the same in any order. A pixel's first byte is its high one on any
 * machine. */
static void glass_fragment(const struct zs_instance *instance, struct zs_fragment *f)
{
    (void)instance;
    uint8_t *byte = (uint8_t *)f->color;
    const uint32_t old = (uint32_t)byte[0] << 8 | byte[1], by = f->v[0] >> 10; /* of 64 */
    uint32_t r = old >> 11, g = old >> 5 & 63u, b = old & 31u;
    r += (30u - (r > 30u ? 30u : r)) * by >> 6;
    g += (63u - g) * by >> 6;
    b += (31u - b) * by >> 6;
    const uint32_t now = r << 11 | g << 5 | b;
    byte[0] = (uint8_t)(now >> 8);
    byte[1] = (uint8_t)now;
}

static const struct zs_shader shade_glass = {
    .vertex = glass_vertex, .fragment = glass_fragment, ZS_FRAGMENTS, ZS_LAYER, .n_varyings = 1
};
static const struct zs_material glass = { .shader = &shade_glass, .cull = ZS_CULL_NONE };

/* ---- The wall, and the room that the mirror has in its place ---------------------------------------------------- */

static struct backdrop wall_glow, room_glow;
static const struct zs_background wall = { .fill = backdrop_glow_fill, .ctx = &wall_glow },
                                  dim_room = { .fill = backdrop_glow_fill, .ctx = &room_glow };

static void set_backdrops(uint16_t w, uint16_t h)
{
    backdrop_colors(&wall_glow, (struct zs_rgb)ZS_RGB(0x10201e), (struct zs_rgb)ZS_RGB(0x5c7464));
    backdrop_glow(&wall_glow, w, h, 7, 5, 44);
    backdrop_colors(&room_glow, (struct zs_rgb)ZS_RGB(0x1c1824), (struct zs_rgb)ZS_RGB(0xd8c8a8));
    backdrop_glow(&room_glow, w, h, 14, 0, 34);
}

/* ---- What stands where ------------------------------------------------------------------------------------------ */

/* In order: opaque things, from near to far; the table, shadows on it, the glass, the mirror. */
enum {
    WINE,
    PEAR,
    PEAR_STEM,
    LEMON,
    BOWL,
    ORANGE_1,
    ORANGE_2,
    ORANGE_3,
    APPLE,
    APPLE_STEM,
    VASE,
    STAND,
    FRAME,
    TABLE,
    SHADOW_PEAR,
    SHADOW_LEMON,
    SHADOW_BOWL,
    SHADOW_VASE,
    SHADOW_WINE,
    SHADOW_MIRROR,
    GLASS,
    MIRROR,
    THINGS,
    SHADOWS = GLASS - SHADOW_PEAR
};
static struct zs_instance thing[THINGS], image[THINGS]; /* image: what the mirror shows */

static const struct {
    uint8_t which;
    const struct zs_mesh *mesh, *low; /* low: for the mirror, NULL: it shows none; and to throw a shadow */
    const struct zs_material *material;
    int16_t x, y, z;
    zs_turn yaw, pitch, roll;
} still[] = {
    { WINE, &mesh_still_wine, &mesh_still_wine_low, &wine.material, -1350, 0, 900, 0, 0, 0 },
    { PEAR, &mesh_still_pear, &mesh_still_pear_low, &pear.material, 1500, 0, 700, 0, 0, 0 },
    { PEAR_STEM, &mesh_still_stem, NULL, &bark.material, 1500, 1110, 700, 0, ZS_DEGREES(10), ZS_DEGREES(-14) },
    { LEMON, &mesh_still_lemon, &mesh_still_lemon_low, &lemon.material, -140, 335, 1500, ZS_DEGREES(35), 0,
      ZS_DEGREES(90) },
    { BOWL, &mesh_still_bowl, &mesh_still_bowl_low, &painted.material, 120, 0, 60, 0, 0, 0 },
    { ORANGE_1, &mesh_still_orange, &mesh_still_orange_low, &orange.material, -270, 330, 330, 0, 0, 0 },
    { ORANGE_2, &mesh_still_orange, &mesh_still_orange_low, &orange.material, 590, 330, 190, 0, 0, 0 },
    { ORANGE_3, &mesh_still_orange_low, &mesh_still_orange_low, &orange.material, 40, 330, -420, 0, 0, 0 },
    { APPLE, &mesh_still_apple, &mesh_still_apple_low, &apple.material, 190, 800, 60, 0, ZS_DEGREES(12),
      ZS_DEGREES(10) },
    { APPLE_STEM, &mesh_still_stem, &mesh_still_stem, &bark.material, 190, 1370, 60, 0, ZS_DEGREES(12),
      ZS_DEGREES(10) },
    { VASE, &mesh_still_vase, &mesh_still_vase_low, &painted.material, -1050, 0, -1000, 0, 0, 0 },
    { STAND, &mesh_still_stand, NULL, &painted.material, 1180, 0, -1250, 0, 0, 0 },
    { FRAME, &mesh_still_frame, NULL, &painted.material, 1180, 1620, -1250, ZS_DEGREES(-27), ZS_DEGREES(7), 0 },
    { TABLE, &mesh_still_table, &mesh_still_table, &wood, 0, 0, 0, 0, 0, 0 },
    { GLASS, &mesh_still_glass, &mesh_still_glass_low, &glass, -1350, 0, 900, 0, 0, 0 },
    { MIRROR, &mesh_still_plate, NULL, &silver, 1180, 1620, -1250, ZS_DEGREES(-27), ZS_DEGREES(7), 0 },
};

static const struct {
    uint8_t which, of;
    const struct zs_mesh *mesh;
} cast[SHADOWS] = { { SHADOW_PEAR, PEAR, &mesh_still_pear_low }, { SHADOW_LEMON, LEMON, &mesh_still_lemon_low },
                    { SHADOW_BOWL, BOWL, &mesh_still_bowl_low }, { SHADOW_VASE, VASE, &mesh_still_vase_low },
                    { SHADOW_WINE, WINE, &mesh_still_wine_low }, { SHADOW_MIRROR, FRAME, &mesh_still_plate } };
#define FLAT_VERTS 860u /* of all shadows; one that does not fit is left out */
static struct zs_mesh flat[SHADOWS];
static int16_t flat_pos[FLAT_VERTS][3];

static struct zs_scene room, seen;
static struct zs_mirror mirror;
static struct zs_camera eye;
static const struct zs_pass pass[2] = {
    { .scene = &room, .camera = &eye }, { .scene = &seen, .camera = &eye, .mirror = &mirror, .mask = &zs_mask_window }
};

static const int32_t key_light[3] = { -5, 8, 5 }, cool_light[3] = { 7, 3, -3 }, low_light[3] = { -2, -6, 5 };

static void put_shadows(void)
{
    static const struct zs_shadow_plane table = { .normal = { 0, ZS_Q30_ONE, 0 } };
    struct zs_shadow_light light = { .point = 0 };
    uint32_t n = 0;
    (void)zs_unit(light.dir, key_light);
    for (uint32_t i = 0; i < SHADOWS; i++) {
        struct zs_instance caster = thing[cast[i].of];
        caster.mesh = cast[i].mesh;
        if (n + caster.mesh->n_verts > FLAT_VERTS)
            continue;
        thing[cast[i].which].material = cast[i].which == SHADOW_MIRROR ? &dark_both : &dark;
        (void)zs_shadow_flatten(&thing[cast[i].which], &flat[i], flat_pos + n, &caster, &table, &light);
        n += caster.mesh->n_verts;
    }
}

/* Nothing moves but the eye: once is enough. */
static void set_up(void)
{
    if (seen.n_instances)
        return;
    (void)zs_unit(lamp[0].dir, key_light);
    (void)zs_unit(lamp[1].dir, cool_light);
    (void)zs_unit(lamp[2].dir, low_light);
    (void)zs_shine_set(&gloss, 24);
    (void)zs_shine_set(&wax, 10);
    for (uint32_t i = 0; i < sizeof still / sizeof still[0]; i++) {
        struct zs_instance *in = &thing[still[i].which];
        *in = (struct zs_instance){ .mesh = still[i].mesh,
                                    .material = still[i].material,
                                    .pose.pos = { still[i].x, still[i].y, still[i].z } };
        zs_pose_turn(&in->pose, still[i].yaw, still[i].pitch, still[i].roll);
        if (!still[i].low)
            continue;
        image[seen.n_instances] = *in;
        image[seen.n_instances++].mesh = still[i].low;
    }
    put_shadows();
    (void)zs_mirror_of(&mirror, &thing[MIRROR], 64);
}

static void look(const struct zs_camera *camera)
{
    zs_q2_30 light[3];
    int32_t sum[3];
    (void)zs_unit(light, key_light);
    for (int i = 0; i < 3; i++) {
        to_eye[i] = camera->rot[6 + i] >> 16; /* the camera looks along -z */
        sum[i] = (light[i] >> 2) + (camera->rot[6 + i] >> 2);
    }
    (void)zs_unit(light, sum);
    for (int i = 0; i < 3; i++)
        half_way[i] = light[i] >> 16;
}

static void pose(struct demo_frame *f, uint32_t t, uint16_t w, uint16_t h)
{
    static const struct zs_rgb black = { 0, 0, 0 };
    static const int32_t middle[3] = { 0, 900, 0 };
    const zs_turn turn = stage_turn(t, FRAMES, 1);
    stage_open(f, black);
    set_up();
    set_backdrops(w, h);
    stage_lens(f, ZS_DEGREES(36), w, h, 3000, 16000);
    zs_camera_orbit(&f->camera, middle, DISTANCE, (zs_turn)stage_sin(2600, turn),
                    (int16_t)(ZS_DEGREES(13) + stage_cos(500, turn)));
    stage_orbit(&f->camera, DISTANCE);
    look(&f->camera);
    f->scene.instance = thing;
    f->scene.n_instances = THINGS;
    f->scene.sky = &wall;
    eye = f->camera;
    room = f->scene;
    seen.instance = image;
    seen.light = room.light;
    seen.sky = &dim_room;
}

PIECE(stilllife, "A bowl of fruit, a vase and a glass of wine before a mirror, lit by three lamps, with shadows",
      FRAMES, ZS_VARYINGS_LIT, NULL, pass, 2, pose, ZS_FAST_FRAME, ZS_FAST_SMOOTH, ZS_FAST_TEXTURE, ZS_FAST_565);
