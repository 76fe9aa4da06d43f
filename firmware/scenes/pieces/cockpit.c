/* A flight along a river, seen from a cockpit: dials follow what the aircraft does, a mirror shows its tail and the
 * land behind it, and hills fade into haze.
 *
 * SPDX-License-Identifier: MIT
 */
#include "backdrop.h"
#include "land.h"
#include "meshes.h"
#include "pieces.h"
#include "view.h"
#include "zs_blend.h"
#include "zs_environment.h"
#include "zs_fog.h"
#include "zs_overlay.h"

#define FRAMES 96u
#define CLOUDS 5
#define SKY_NEAR ZS_RGB(0xc4d4dc) /* at the horizon, and the haze */
#define NEAR 300
#define FAR (LAND_PERIOD * 5 / 4)

/* ---- Land and sky ----------------------------------------------------------------------------------------------- */

static const struct zs_material ground = { .shader = &zs_shade_flat, .rgb = { 255, 255, 255 } },
                                metal = { .shader = &zs_shade_smooth, .rgb = { 255, 255, 255 } },
                                tail = { .shader = &zs_shade_flat, .rgb = { 255, 255, 255 }, .cull = ZS_CULL_NONE };
static const struct zs_blend vapour = {
    .material = { .shader = &zs_blend_texture, .texture = &texture_cloud, .cull = ZS_CULL_NONE }, .alpha = 255
};

static struct backdrop sky_ahead, sky_behind;
static const struct zs_background ahead_sky = { .fill = backdrop_sky_fill, .ctx = &sky_ahead },
                                  behind_sky = { .fill = backdrop_sky_fill, .ctx = &sky_behind };
static struct zs_fog haze = { .color = ZS_RGB565(0xc4d4dc), .start = LAND_PERIOD / 5, .end = LAND_PERIOD * 23 / 20 };

/* What the aircraft does in frame t. */
struct flight {
    int32_t pos[3];
    int32_t slip, climb;   /* the way ahead: x and y to 4096 of -z */
    zs_turn heading, bank; /* clockwise; bank: of the right wing down */
};

/* Along the river, which the mesh has at x = LAND_RIVER * sin(turn); cut short in its bends. */
static void fly(struct flight *a, uint32_t t)
{
    const int32_t z = -(int32_t)(t % FRAMES * LAND_PERIOD / FRAMES);
    const zs_turn bend = (zs_turn)((z + LAND_PERIOD / 2) * 65536 / LAND_PERIOD);
    const zs_turn wave = stage_turn(t, FRAMES, 2);
    a->pos[0] = stage_sin(LAND_RIVER * 3 / 4, bend);
    a->pos[1] = 1750 + stage_sin(330, wave);
    a->pos[2] = z;
    a->slip = -stage_cos(1880, bend); /* 3/4 * LAND_RIVER * 2 pi / LAND_PERIOD * 4096 */
    a->climb = -330 + stage_cos(240, wave);
    a->heading = (zs_turn)(a->slip * 5 / 2);   /* a turn is 65536: 4096 is some 45 degrees, 8192 */
    a->bank = (zs_turn)-stage_sin(4200, bend); /* into the bend */
}

/* ---- Gauges ----------------------------------------------------------------------------------------------------- */

/* The ball of the attitude indicator: sky and ground in a disc of radius w around pixel (x, y), turned left by `from`,
 * the horizon (short)value px below the middle. */
static void ball_draw(const struct zs_item *item, const struct zs_target *target)
{
    const int32_t r2 = item->w * item->w + item->w, s = zs_sin(item->from) >> 16, c = zs_cos(item->from) >> 16;
    const uint16_t sky = zs_wire565(58, 128, 196), earth = zs_wire565(140, 88, 44), line = zs_wire565(250, 250, 250);
    for (int32_t dy = -item->w; dy <= item->w; dy++) {
        const int32_t y = item->y + dy;
        if (y < target->y0 || y >= target->y1)
            continue;
        for (int32_t dx = -item->w; dx <= item->w; dx++) {
            const int32_t x = item->x + dx;
            if (dx * dx + dy * dy > r2 || x < target->x0 || x >= target->x1)
                continue;
            const int32_t off = c * dy + s * dx - (int16_t)item->value * 16384; /* q14: below the horizon */
            target->color[(uint32_t)(y - target->y0) * target->pitch + (uint32_t)x] = off > 9000    ? earth
                                                                                      : off < -9000 ? sky
                                                                                                    : line;
        }
    }
}

/* Those of a disc that is drawn as an arc. */
static void ball_bounds(const struct zs_item *item, int32_t box[4])
{
    zs_item_arc.bounds(item, box);
}

static const struct zs_item_kind ball = { .draw = ball_draw, .bounds = ball_bounds };

#define ITEMS 28u
static struct zs_item item[ITEMS];
static struct zs_overlay gauges = { .item = item };
static char number[3][6];

static struct zs_item *add(const struct zs_item_kind *kind, int32_t x, int32_t y, int32_t w, int32_t h, uint16_t color)
{
    struct zs_item *i = &item[gauges.n < ITEMS ? gauges.n++ : ITEMS - 1u];
    *i = (struct zs_item){
        .kind = kind, .x = (int16_t)x, .y = (int16_t)y, .w = (int16_t)w, .h = (int16_t)h, .color = color
    };
    return i;
}

#define IVORY ZS_RGB565(0xf0e8d0)
#define AMBER ZS_RGB565(0xffa828)

static void add_text(int32_t x, int32_t y, uint16_t color, const char *text)
{
    struct zs_item *i = add(&zs_item_text, x, y, 0, 0, color);
    i->text = text;
    i->flags = ZS_ITEM_CENTER;
}

static const char *digits(char out[6], uint32_t v, uint32_t n)
{
    for (uint32_t i = n; i > 0; v /= 10u)
        out[--i] = (char)('0' + v % 10u);
    out[n] = '\0';
    return out;
}

/* A dial from lower left to lower right: value 0 .. 65535; its upper end is amber. */
static void add_dial(int32_t x, int32_t y, int32_t r, uint32_t value, const char *name, const char *text)
{
    const zs_turn from = ZS_DEGREES(-130), sweep = ZS_DEGREES(260);
    add(&zs_item_arc, x, y, r, 0, ZS_RGB565(0x9a948c))->value = 65535;
    add(&zs_item_arc, x, y, r - 2, 0, ZS_RGB565(0x0c0e12))->value = 65535;
    struct zs_item *i = add(&zs_item_arc, x, y, r - 4, 2, ZS_RGB565(0x58c878));
    i->back = AMBER;
    i->value = 46000;
    i->from = from;
    i->sweep = sweep;
    i = add(&zs_item_ticks, x, y, r - 4, r / 6 + 1, IVORY);
    i->value = 8;
    i->from = from;
    i->sweep = sweep;
    if (r > 20)
        add_text(x, y + r * 2 / 3, ZS_RGB565(0x98a0a8), name);
    if (r > 20)
        add_text(x, y + r / 3, IVORY, text);
    i = add(&zs_item_needle, x, y, r - 6, r / 5, ZS_RGB565(0xff5838));
    i->size = (uint8_t)(r / 7 + 2);
    i->value = (uint16_t)value;
    i->from = from;
    i->sweep = sweep;
    add(&zs_item_arc, x, y, r / 10 + 1, 0, IVORY)->value = 65535;
}

static void add_attitude(int32_t x, int32_t y, int32_t r, const struct flight *a)
{
    add(&zs_item_arc, x, y, r, 0, ZS_RGB565(0x9a948c))->value = 65535;
    add(&zs_item_arc, x, y, r - 2, 0, ZS_RGB565(0x0c0e12))->value = 65535;
    struct zs_item *i = add(&ball, x, y, r - 4, 0, 0);
    i->from = a->bank;
    i->value = (uint16_t)(a->climb * r / 1600);
    add(&zs_item_fill, x - r * 5 / 8, y - 1, r * 3 / 8, 2, AMBER);
    add(&zs_item_fill, x + r / 4 + 1, y - 1, r * 3 / 8, 2, AMBER);
    add(&zs_item_fill, x - 1, y - 1, 2, 2, AMBER);
    i = add(&zs_item_ticks, x, y, r - 3, r / 6 + 1, IVORY);
    i->value = 6;
    i->from = ZS_DEGREES(-60);
    i->sweep = ZS_DEGREES(120);
}

/* The mirror's frame: nine parts of a small picture, its corners round. */
#define o 0x0000
#define D ZS_RGB565(0x2a2622)
#define G ZS_RGB565(0x8c8880)
#define L ZS_RGB565(0xc8c4bc)
static const uint16_t rim_pixel[9 * 9] = {
    o, o, D, D, D, D, D, o, o, /**/ o, D, L, L, L, L, L, D, o, /**/ D, L, G, G, G, G, G, L, D,
    D, L, G, o, o, o, G, L, D, /**/ D, L, G, o, o, o, G, L, D, /**/ D, L, G, o, o, o, G, L, D,
    D, L, G, G, G, G, G, G, D, /**/ o, D, G, G, G, G, G, D, o, /**/ o, o, D, D, D, D, D, o, o,
};
#undef o
#undef D
#undef G
#undef L
static const struct zs_sprite rim = {
    .pixel = rim_pixel, .w = 9, .h = 9, .format = ZS_SPRITE_565, .key = 0, .alpha_kind = ZS_ALPHA_KEY, .left = 4,
    .top = 4, .right = 4, .bottom = 4
};

static void add_gauges(const struct flight *a, const struct zs_rect *mirror, uint16_t w, uint16_t h)
{
    const int32_t s = w < h ? w : h, x = w / 2, y = h / 2 + s * 82 / 240, r = s * 30 / 240;
    const int32_t speed = 128 - a->climb / 12, height = a->pos[1];
    gauges.n = 0;
    add(&zs_item_sprite, mirror->x - 3, mirror->y - 3, mirror->w + 6, mirror->h + 6, 0)->sprite = &rim;
    add_dial(x - s * 74 / 240, y, r, (uint32_t)(speed - 60) * 500u, "KT", digits(number[0], (uint32_t)speed, 3));
    add_dial(x + s * 74 / 240, y, r, (uint32_t)(height - 1200) * 56u, "ALT", digits(number[1], (uint32_t)height, 4));
    add_attitude(x, y, s * 35 / 240, a);
    if (s < 180)
        return;
    const uint32_t degrees = ((uint32_t)a->heading * 360u + 32768u) >> 16;
    add(&zs_item_fill, x - 16, y - s * 50 / 240, 32, 11, ZS_RGB565(0x0c0e12));
    add_text(x + 1, y - s * 50 / 240 + 2, ZS_RGB565(0x58e090), digits(number[2], degrees % 360u, 3));
    for (int32_t k = 0; k < 2; k++) {
        struct zs_item *i = add(&zs_item_bar, x + (k ? 1 : -1) * (s * 111 / 240) - 3, y - r + 4, 6, 2 * r - 8,
                                k ? AMBER : ZS_RGB565(0x58c878));
        i->back = ZS_RGB565(0x0c0e12);
        i->flags = ZS_ITEM_UP;
        i->value = (uint16_t)(k ? 40000 + a->climb * 20 : 47000);
    }
}

/* ---- A frame ---------------------------------------------------------------------------------------------------- */

static struct zs_instance behind[7];
static struct zs_scene ahead_scene, behind_scene;
static struct zs_camera ahead, mirrored;
static struct zs_mirror glass;
static struct zs_pass pass[2] = { { .scene = &ahead_scene, .camera = &ahead },
                                  { .scene = &behind_scene, .camera = &mirrored, .mirror = &glass } };
static const struct zs_resolve hooks[2] = {
    { .draw = zs_fog_draw, .changes = zs_fog_changes, .ctx = &haze },
    { .draw = zs_overlay_draw, .changes = zs_overlay_changes, .ctx = &gauges }
};

/* A direction in view space (right, up, back, q14) in world axes, at this length. */
static void of_view(int32_t out[3], int32_t right, int32_t up, int32_t back)
{
    for (int i = 0; i < 3; i++)
        out[i] = (int32_t)(((int64_t)ahead.rot[i] * right + (int64_t)ahead.rot[3 + i] * up +
                            (int64_t)ahead.rot[6 + i] * back) >>
                           30);
}

static void put_attached(struct demo_frame *f, const struct zs_mesh *mesh)
{
    zs_pose_face(stage_put(f, mesh, &metal, ahead.pos[0], ahead.pos[1], ahead.pos[2], 0), &ahead);
}

static void put_ahead(struct demo_frame *f)
{
    static const int16_t place[CLOUDS][3] = { { -9000, 7300, 0 },
                                              { 6400, 8800, -3000 },
                                              { -2400, 9900, -9000 },
                                              { 13500, 7600, -6000 },
                                              { -15800, 9000, -7000 } };
    const int32_t up[3] = { 0, 1, 0 }, along[3] = { -(ahead.rot[6] >> 1), -(ahead.rot[7] >> 1), -(ahead.rot[8] >> 1) };
    struct zs_camera level = ahead; /* not banked: clouds are upright, and parallel to the screen */
    (void)zs_camera_look_along(&level, ahead.pos, along, up);
    put_attached(f, &mesh_cockpit_panel);
    put_attached(f, &mesh_cockpit_bow);
    for (int32_t row = 0; row >= -2; row--)
        for (int32_t column = -1; column <= 1; column++)
            stage_put(f, &mesh_terrain, &ground, column * LAND_PERIOD, 0, row * LAND_PERIOD, 0);
    for (int k = 0; k < CLOUDS; k++) /* they keep their distance */
        zs_pose_face(stage_put(f, &mesh_cloud, &vapour.material, place[k][0], place[k][1],
                               ahead.pos[2] - 22000 + place[k][2], 0),
                     &level);
}

/* What the mirror shows: coarser land, and the tail. */
static void put_behind(void)
{
    uint32_t n = 0;
    int32_t at[3];
    of_view(at, 0, -260, 500);
    behind[n] = (struct zs_instance){ .mesh = &mesh_cockpit_fin, .material = &tail };
    zs_pose_face(&behind[n].pose, &ahead);
    behind[n].pose.scale = ZS_Q16_ONE * 3u;
    for (int i = 0; i < 3; i++)
        behind[n].pose.pos[i] = ahead.pos[i] + at[i];
    n++;
    const int32_t here = ahead.pos[2] < -LAND_PERIOD / 2 ? -1 : 0;
    for (int32_t row = here; row <= here + 1; row++)
        for (int32_t column = -1; column <= 1; column++)
            behind[n++] = (struct zs_instance){ .mesh = &mesh_terrain_low,
                                                .material = &ground,
                                                .pose.pos = { column * LAND_PERIOD, 0, row * LAND_PERIOD } };
    behind_scene.instance = behind;
    behind_scene.n_instances = n;
}

static void place_mirror(uint16_t w, uint16_t h)
{
    const int32_t s = w < h ? w : h;
    int32_t ahead_of_eye[3], back[3], point[3];
    pass[1].viewport = (struct zs_rect){ (uint16_t)(w / 2 - s * 50 / 240), (uint16_t)(h / 2 - s * 110 / 240),
                                         (uint16_t)(s * 100 / 240), (uint16_t)(s * 30 / 240) };
    of_view(ahead_of_eye, 0, 0, -400);
    of_view(back, 0, -600, 16384); /* a little downwards */
    for (int i = 0; i < 3; i++)
        point[i] = ahead.pos[i] + ahead_of_eye[i];
    (void)zs_mirror_plane(&glass, point, back);
    (void)zs_camera_perspective(&mirrored, ZS_DEGREES(24), pass[1].viewport.h, NEAR, FAR);
    for (int i = 0; i < 3; i++)
        mirrored.pos[i] = ahead.pos[i];
    for (int i = 0; i < 9; i++)
        mirrored.rot[i] = ahead.rot[i];
}

static void pose(struct demo_frame *f, uint32_t t, uint16_t w, uint16_t h)
{
    const struct zs_config config = { .width = w, .height = h, .depth_bits = 16, .depth = &zs_depth_float };
    const struct zs_rect whole = { 0, 0, w, h };
    struct flight a;
    fly(&a, t);
    stage_open(f, (struct zs_rgb)SKY_NEAR);
    stage_light(f, -6, 5, 2, 42, 76);
    stage_lens(f, COCKPIT_FOV, w, h, NEAR, FAR);
    const int32_t dir[3] = { a.slip, a.climb, -4096 };
    const int32_t up[3] = { stage_sin(4096, a.bank), stage_cos(4096, a.bank), 0 };
    (void)zs_camera_look_along(&f->camera, a.pos, dir, up);
    stage_orbit(&f->camera, 0);
    ahead = f->camera;
    put_ahead(f);
    put_behind();
    place_mirror(w, h);
    backdrop_colors(&sky_ahead, (struct zs_rgb)SKY_NEAR, (struct zs_rgb)ZS_RGB(0x6a9cdc));
    sky_behind = sky_ahead;
    backdrop_sky(&sky_ahead, &ahead, &whole, NULL);
    backdrop_sky(&sky_behind, &mirrored, &pass[1].viewport, glass.normal);
    (void)zs_fog_set(&haze, &config, &ahead);
    add_gauges(&a, &pass[1].viewport, w, h);
    f->scene.sky = &ahead_sky;
    f->scene.resolve = hooks;
    f->scene.n_resolves = 2;
    ahead_scene = f->scene;
    behind_scene.light = f->scene.light;
    behind_scene.sky = &behind_sky;
}

PIECE(cockpit, "A flight along a river in haze, from a cockpit with gauges and a mirror", FRAMES, ZS_VARYINGS_SMOOTH,
      NULL, pass, 2, pose, ZS_FAST_FRAME, ZS_FAST_CLUSTERS, ZS_FAST_FLAT, ZS_FAST_SMOOTH);
