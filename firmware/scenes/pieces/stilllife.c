/* A still life: fruit in a bowl, a vase, a glass of wine, and an oval mirror that shows all of it from behind. Lit at each
 * pixel by a warm lamp and a cool one; shadows are flattened onto the table; the glass is a shader of its own.
 *
 * SPDX-License-Identifier: MIT
 */
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

static struct zs_lamp lamp[2] = { { .rgb = ZS_RGB(0xfff0d4) }, { .rgb = ZS_RGB(0x34507c) } };
static const struct zs_lighting lights = { .lamp = lamp, .n_lamps = 2, .ambient = ZS_RGB(0x3c343c) };
static struct zs_shine gloss, wax;

#define LIT(name, color, table, glint) \
    static const struct zs_lit_material name = { .material = { .shader = &zs_shade_phong, .rgb = ZS_RGB(color) }, \
                                                 .lighting = &lights, .shine = &table, .specular = ZS_RGB(glint) }
LIT(painted, 0xffffff, gloss, 0xd0d0d0); /* its faces' colours */
LIT(orange, 0xf08418, wax, 0x383028);
LIT(apple, 0xb81c1c, gloss, 0x808080);
LIT(pear, 0xa8b430, wax, 0x404030);
LIT(lemon, 0xf0cc20, wax, 0x484038);
LIT(wine, 0x60081c, gloss, 0x606060);
static const struct zs_lit_material bark = { .material = { .shader = &zs_shade_lit_face, .rgb = ZS_RGB(0x5c3c1c) },
                                             .lighting = &lights };

static const struct zs_material wood = { .shader = &zs_shade_texture, .texture = &texture_still_wood },
                                dark = { .shader = &zs_shade_shadow, .rgb = ZS_RGB(0x606060), .cull = ZS_CULL_NONE },
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

/* Towards a pale green, by the varying. A pixel's first byte is its high one on any machine. */
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
static const struct zs_material glass_back = { .shader = &shade_glass, .cull = ZS_CULL_FRONT },
                                glass_front = { .shader = &shade_glass, .cull = ZS_CULL_BACK };

/* ---- The wall, and what the mirror has in its place: a glow that fades, dithered ------------------------------------ */

struct glow {
    uint16_t w, h;   /* px, of the frame */
    uint8_t x, y;    /* its middle, 1/16 of the frame */
    uint8_t reach;   /* the greater, the wider */
    struct zs_rgb far, near;
};

static uint8_t between(uint8_t a, uint8_t b, int32_t t)
{
    return (uint8_t)(a + ((b - a) * t >> 8));
}

static void glow_fill(void *ctx, uint16_t *out, uint16_t x, uint16_t y, uint16_t n)
{
    static const uint8_t bayer[16] = { 0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5 };
    const struct glow *g = ctx;
    const int32_t span = g->w < g->h ? g->w : g->h, dy = (y - g->h * g->y / 16) * 128 / span;
    const int32_t step = 128 * 64 / span; /* q6 */
    int32_t dx = (x - g->w * g->x / 16) * step;
    for (uint32_t i = 0; i < n; i++, dx += step) {
        const int32_t level = 255 - (((dx >> 6) * (dx >> 6) + dy * dy) / g->reach) + bayer[(y & 3u) * 4u + ((x + i) & 3u)];
        const int32_t t = level < 0 ? 0 : level > 255 ? 255 : level;
        out[i] = zs_wire565(between(g->far.r, g->near.r, t), between(g->far.g, g->near.g, t),
                            between(g->far.b, g->near.b, t));
    }
}

static struct glow wall_glow = { .x = 7, .y = 5, .reach = 46, .far = ZS_RGB(0x10201e), .near = ZS_RGB(0x5c7464) },
                   room_glow = { .x = 14, .y = 0, .reach = 60, .far = ZS_RGB(0x1c1824), .near = ZS_RGB(0xd8c8a8) };
static const struct zs_background wall = { .fill = glow_fill, .ctx = &wall_glow },
                                  dim_room = { .fill = glow_fill, .ctx = &room_glow };

/* ---- What stands where --------------------------------------------------------------------------------------------- */

/* In order: what the mirror does not show, opaque things from near to far, the table, shadows, glass, the mirror. */
enum { STAND, FRAME, WINE, PEAR, PEAR_STEM, LEMON, BOWL, ORANGE_1, ORANGE_2, ORANGE_3, APPLE, APPLE_STEM, VASE, TABLE,
       SHADOW_PEAR, SHADOW_LEMON, SHADOW_BOWL, SHADOW_VASE, SHADOW_GLASS, SHADOW_MIRROR, GLASS_BACK, GLASS_FRONT,
       MIRROR, THINGS, REFLECTED = WINE, SHADOWS = GLASS_BACK - SHADOW_PEAR };
static struct zs_instance thing[THINGS];
static struct zs_mesh flat[SHADOWS];
#define CASTER_VERTS 400u
static int16_t flat_pos[SHADOWS][CASTER_VERTS][3];

static struct zs_scene room, seen;
static struct zs_mirror mirror;
static struct zs_camera eye;
static const struct zs_pass pass[2] = { { .scene = &room, .camera = &eye },
                                        { .scene = &seen, .camera = &eye, .mirror = &mirror, .mask = &zs_mask_window } };

static void put(uint32_t i, const struct zs_mesh *mesh, const struct zs_material *material, int32_t x, int32_t y, int32_t z)
{
    thing[i] = (struct zs_instance){ .mesh = mesh, .material = material, .pose.pos = { x, y, z } };
}

static void put_things(void)
{
    put(STAND, &mesh_still_stand, &painted.material, 1180, 0, -1250);
    put(FRAME, &mesh_still_frame, &painted.material, 1180, 1620, -1250);
    put(WINE, &mesh_still_wine, &wine.material, -1350, 0, 900);
    put(PEAR, &mesh_still_pear, &pear.material, 1500, 0, 700);
    put(PEAR_STEM, &mesh_still_stem, &bark.material, 1500, 1110, 700);
    put(LEMON, &mesh_still_lemon, &lemon.material, -140, 335, 1500);
    put(BOWL, &mesh_still_bowl, &painted.material, 120, 0, 60);
    put(ORANGE_1, &mesh_still_orange, &orange.material, -270, 330, 330);
    put(ORANGE_2, &mesh_still_orange, &orange.material, 590, 330, 190);
    put(ORANGE_3, &mesh_still_orange, &orange.material, 40, 330, -420);
    put(APPLE, &mesh_still_apple, &apple.material, 190, 800, 60);
    put(APPLE_STEM, &mesh_still_stem, &bark.material, 190, 1370, 60);
    put(VASE, &mesh_still_vase, &painted.material, -1050, 0, -1000);
    put(TABLE, &mesh_still_table, &wood, 0, 0, 0);
    put(GLASS_BACK, &mesh_still_glass, &glass_back, -1350, 0, 900);
    put(GLASS_FRONT, &mesh_still_glass, &glass_front, -1350, 0, 900);
    put(MIRROR, &mesh_still_plate, &silver, 1180, 1620, -1250);
    zs_pose_turn(&thing[LEMON].pose, ZS_DEGREES(35), 0, ZS_DEGREES(90));
    zs_pose_turn(&thing[PEAR_STEM].pose, 0, ZS_DEGREES(10), ZS_DEGREES(-14));
    zs_pose_turn(&thing[APPLE_STEM].pose, 0, ZS_DEGREES(12), ZS_DEGREES(10));
    zs_pose_turn(&thing[APPLE].pose, 0, ZS_DEGREES(12), ZS_DEGREES(10));
    zs_pose_turn(&thing[FRAME].pose, ZS_DEGREES(-27), ZS_DEGREES(7), 0);
    zs_pose_turn(&thing[MIRROR].pose, ZS_DEGREES(-27), ZS_DEGREES(7), 0);
}

static void put_shadow(uint32_t i, const struct zs_mesh *low, uint32_t of, const int32_t from[3])
{
    static const struct zs_shadow_plane table = { .normal = { 0, ZS_Q30_ONE, 0 } };
    struct zs_shadow_light light = { .point = 0 };
    struct zs_instance caster = thing[of];
    caster.mesh = low;
    (void)zs_unit(light.dir, from);
    thing[i] = (struct zs_instance){ .material = &dark };
    (void)zs_shadow_flatten(&thing[i], &flat[i - SHADOW_PEAR], flat_pos[i - SHADOW_PEAR], &caster, &table, &light);
}

/* Nothing moves but the eye: once is enough. */
static void set_up(void)
{
    static const int32_t key[3] = { -5, 8, 5 }, fill[3] = { 7, 3, -3 };
    if (thing[0].mesh)
        return;
    (void)zs_unit(lamp[0].dir, key);
    (void)zs_unit(lamp[1].dir, fill);
    (void)zs_shine_set(&gloss, 60);
    (void)zs_shine_set(&wax, 14);
    put_things();
    put_shadow(SHADOW_PEAR, &mesh_still_pear_low, PEAR, key);
    put_shadow(SHADOW_LEMON, &mesh_still_lemon_low, LEMON, key);
    put_shadow(SHADOW_BOWL, &mesh_still_bowl_low, BOWL, key);
    put_shadow(SHADOW_VASE, &mesh_still_vase_low, VASE, key);
    put_shadow(SHADOW_GLASS, &mesh_still_wine, WINE, key);
    put_shadow(SHADOW_MIRROR, &mesh_still_plate, FRAME, key);
    (void)zs_mirror_of(&mirror, &thing[MIRROR], 64);
}

static void look(const struct zs_camera *camera)
{
    static const int32_t key[3] = { -5, 8, 5 };
    zs_q2_30 light[3];
    int32_t sum[3];
    (void)zs_unit(light, key);
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
    wall_glow.w = room_glow.w = w;
    wall_glow.h = room_glow.h = h;
    stage_lens(f, ZS_DEGREES(36), w, h, 3000, 16000);
    zs_camera_orbit(&f->camera, middle, DISTANCE, (zs_turn)stage_sin(2600, turn),
                    (int16_t)(ZS_DEGREES(13) + stage_cos(500, turn)));
    look(&f->camera);
    f->scene.instance = thing;
    f->scene.n_instances = THINGS;
    f->scene.sky = &wall;
    eye = f->camera;
    room = seen = f->scene;
    seen.sky = &dim_room;
    seen.instance = thing + REFLECTED;
    seen.n_instances = MIRROR - REFLECTED;
}

PIECE(stilllife, "A bowl of fruit, a vase and a glass of wine before a mirror, lit at each pixel, with shadows", FRAMES,
      ZS_VARYINGS_LIT, NULL, pass, 2, pose, ZS_FAST_FRAME, ZS_FAST_TEXTURE, ZS_FAST_565);
