/* Random scenes that move, drawn by several hands, each some way of its own - strips, pools, buffers, accelerators,
 * zs_damage_compare, zs_damage_track, zs_damage_columns, zs_invalidate, two renderers that share the strips - onto a
 * glass of its own that gets changed columns alone, and the plainest way: one strip, large pools, no accelerators, a
 * renderer without memory of the frame before. Each glass must show the plain picture; keys are its keys.
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdlib.h>
#include <string.h>

#include "clusters.h"
#include "effects.h"
#include "fast_lists.h"
#include "kinds.h"
#include "picture.h"
#include "shapes.h"
#include "stress.h"
#include "zs_damage.h"

#define SHAPES 6
#define WALL 0      /* the shape that is one: two large triangles */
#define INSTANCES 12
#define CROWD 6     /* instances of most scenes, at most */
#define FRAMES 8
#define HANDS 8
#define W_MAX 160
#define H_MAX 96
#define POOL 4000   /* of the plainest way: more than all instances have */
#define POOLS_MOST 4   /* a method's scene fills so many pools at most */
/* triangles of a scene that may be walked as often as it has triangles and strips; of most methods' a quarter */
#define MODEST 400
#define PLAIN_BYTES ZS_ARENA_BYTES(W_MAX, H_MAX, H_MAX, POOL, POOL, ZS_VARYINGS_MAX, 1)
#define COLUMNS_MAX 6u
#define LOG2_MAX 8  /* of a texture's sides */
#define TEXELS (1u << 2 * LOG2_MAX)

static struct {
    struct shape shape[SHAPES];
    struct zs_cluster cluster[SHAPES][SHAPE_TRIS];
    int crowd, inside, wall; /* instances at most; the camera was put into one; the first stands before the others */
    int walls;               /* all are few, large triangles that cross, with few texels of large textures a pixel */
    int16_t uv[SHAPE_VERTS][2];
    uint16_t texel[TEXELS + TEXELS / 2], palette[512]; /* with their mipmaps; with their alphas */
    struct zs_texture texture[3 + EFFECT_TEXELS];
    union effect_material material[INSTANCES];
    struct effects effects;
    int with_effects;
    uint32_t without; /* enum effect_needs, of the method */
    struct zs_depth_state state[2];
    struct zs_instance instance[INSTANCES];
    struct zs_scene scene;
    struct zs_camera camera;
    struct zs_background sky;
    uint16_t sky_seed;
    struct zs_resolve resolve[2];  /* the first draws in `overlay`, which moves; of effects */
    struct zs_rect overlay, moved; /* moved: what of the frame before and this one it is in */
    uint16_t h; /* px, of the frame */
} world;

/* ---- The world ------------------------------------------------------------------------------------------ */

static void shapes(struct prng *p)
{
    const uint32_t more = prng_pick(p, 8) ? 1 : 3; /* triangles: a scene has some 100, every eighth some 400 */
    for (int k = 0; k < SHAPES; k++) {
        struct shape *s = &world.shape[k];
        switch (k == WALL ? 4 : world.walls ? 5 : prng_pick(p, 4)) {
        case 0: shape_sphere(s, 3 + prng_pick(p, 2 * more), 4 + prng_pick(p, 2 * more), 1000); break;
        case 1:
            shape_torus(s, 4 + prng_pick(p, 2 * more), 3 + prng_pick(p, 2 * more), 900, prng_range(p, 100, 700));
            break;
        case 2: shape_soup(s, 12 + prng_pick(p, 24 * more), 900, prng_next(p)); break;
        case 3: shape_ground(s, 1 + prng_pick(p, 3 * more), 2000, prng_range(p, 0, 3) * 100, prng_next(p)); break;
        case 5: shape_ground(s, 1 + prng_pick(p, 2), 2000, 0, 0); break;
        default: shape_ground(s, 1, 2000, 0, 0); break;
        }
        if (prng_pick(p, 3) == 0)
            s->mesh.pos_lo = (const uint8_t (*)[3])s->pos_lo;
        if (prng_pick(p, 2))
            s->mesh.vertex_rgb = NULL;
        if (prng_pick(p, 2))
            s->mesh.face_rgb = NULL;
        s->mesh.radius = (uint16_t)(s->mesh.radius + 2u); /* holds pos_lo */
        s->mesh.uv = (const int16_t (*)[2])world.uv;
        s->mesh.uv_bits = (uint8_t)(world.walls ? 12 : prng_range(p, 8, 15));
        if (prng_pick(p, 3))
            clusters_make(&s->mesh, world.cluster[k], p, 2 + prng_pick(p, 9), prng_pick(p, 2) * 3);
    }
}

/* Many repeats in a triangle of a small texture, or a large one of which it has a texel or two a pixel, and all
 * between. */
static void texels(struct prng *p)
{
    static int filled;
    struct prng once = { 1 };
    for (uint32_t i = 0; !filled && i < KINDS(world.texel); i++) /* the same in every world */
        world.texel[i] = (uint16_t)prng_next(&once);
    filled = 1;
    for (uint32_t i = 0; i < KINDS(world.palette); i++)
        world.palette[i] = (uint16_t)prng_next(p);
    const uint32_t apart = world.walls ? 511u : 0xffffu >> prng_pick(p, 12), base = prng_next(p);
    for (uint32_t v = 0; v < SHAPE_VERTS; v++)
        for (int k = 0; k < 2; k++)
            world.uv[v][k] = (int16_t)(base + (prng_next(p) & apart));
    for (int k = 0; k < 3 + EFFECT_TEXELS; k++) {
        const struct kind_texel *kind = k < 3 ? &kind_texels[k] : &kind_alpha_texels[k - 3];
        struct zs_texture *t = &world.texture[k];
        memset(t, 0, sizeof *t);
        t->format = kind->format;
        t->texel = world.texel;
        t->palette = !kind->colors_max ? NULL : world.palette + (k < 3 ? 0 : 256 - kind->colors_max);
        t->n_colors = kind->colors_max;
        t->log2_w = (uint8_t)(world.walls ? LOG2_MAX : 1 + prng_pick(p, LOG2_MAX));
        t->log2_h = (uint8_t)(world.walls ? LOG2_MAX : 1 + prng_pick(p, LOG2_MAX));
        t->clamp = (uint8_t)prng_pick(p, 4);
        t->alpha_least = (uint8_t)prng_pick(p, 256);
        if (world.with_effects && prng_pick(p, 2)) /* up to a level of one texel, of two where they have 4 bits */
            t->n_levels = (uint8_t)(1u + prng_pick(p, t->log2_w < t->log2_h ? t->log2_w : t->log2_h));
    }
    for (int k = 256; k < 512; k++) /* alphas */
        world.palette[k] &= 255;
}

static void place(struct prng *p, struct zs_instance *in)
{
    const int32_t far = prng_pick(p, 8) ? 1800 : 9000;
    zs_pose_identity(&in->pose);
    if (prng_pick(p, 6))
        zs_pose_turn(&in->pose, (zs_turn)prng_next(p), (zs_turn)prng_next(p), (zs_turn)prng_next(p));
    for (int k = 0; k < 3; k++)
        in->pose.pos[k] = prng_range(p, -far, far);
    in->pose.scale = ZS_Q16_ONE / 4 + prng_pick(p, ZS_Q16_ONE * 2);
}

static void cover(struct prng *p, union effect_material *to)
{
    struct zs_material *m = &to->material;
    if (world.with_effects && prng_pick(p, 3)) {
        effects_cover(&world.effects, p, to, &world.texture[prng_pick(p, 3 + EFFECT_TEXELS)], world.without);
        return;
    }
    memset(to, 0, sizeof *to);
    m->shader = kind_shaders[world.walls ? prng_range(p, 3, 6) : (int32_t)prng_pick(p, KINDS(kind_shaders))].shader;
    m->rgb.r = (uint8_t)prng_next(p);
    m->rgb.g = (uint8_t)prng_next(p);
    m->rgb.b = (uint8_t)prng_next(p);
    m->cull = (uint8_t)prng_pick(p, 3);
    m->texture = &world.texture[prng_pick(p, 3)];
}

static void stand(struct prng *p, struct zs_instance *in)
{
    in->mesh = &world.shape[prng_pick(p, SHAPES)].mesh;
    place(p, in);
    in->depth_state = prng_pick(p, 5) ? NULL : &world.state[prng_pick(p, 2)];
}

/* Give instances what their effects need of meshes and states. 1: bytes behind pointers changed. */
static int mend(struct prng *p)
{
    int told = 0;
    for (int k = 0; k < INSTANCES; k++) {
        struct zs_instance *in = &world.instance[k];
        struct zs_material *m = &world.material[k].material;
        if (m->shader == &zs_shade_shadow && in->depth_state != &world.effects.lift)
            in->depth_state = prng_pick(p, 2) ? NULL : &world.effects.lift;
        if (m->shader == &zs_shade_matcap && in->mesh->uv_bits != 15) {
            world.shape[(const struct shape *)(const void *)in->mesh - world.shape].mesh.uv_bits = 15;
            told = 1;
        }
        if (m->primitive && m->primitive->n > in->mesh->n_tris)
            m->shader = &zs_shade_plain;
    }
    return told;
}

/* The first instance becomes a wall at a distance from the eye, square to it. */
static void wall(struct prng *p, int32_t distance)
{
    struct zs_instance *in = &world.instance[0];
    const struct zs_camera *c = &world.camera;
    in->mesh = &world.shape[WALL].mesh;
    in->depth_state = NULL;
    in->pose.scale = ZS_Q16_ONE / 4 + prng_pick(p, ZS_Q16_ONE * 2);
    for (int k = 0; k < 3; k++) { /* its x, up and z go right, back and down */
        in->pose.rot[3 * k] = c->rot[k];
        in->pose.rot[3 * k + 1] = c->rot[6 + k];
        in->pose.rot[3 * k + 2] = -c->rot[3 + k];
        in->pose.pos[k] = c->pos[k] - (int32_t)((int64_t)c->rot[6 + k] * distance / ZS_Q30_ONE);
    }
}

/* From outside, from among the instances, or from inside of one. */
static void look(struct prng *p)
{
    const int inside = world.inside = prng_pick(p, 3) == 0;
    const int32_t distance = inside ? prng_range(p, 20, 1200) : prng_range(p, 1500, 9000);
    const int32_t near = inside ? prng_range(p, 1, 300) : prng_range(p, 20, 2000);
    const int32_t far = prng_pick(p, 4) ? 30000 : distance + prng_range(p, 500, 4000);
    if (world.camera.projection == ZS_PERSPECTIVE)
        (void)zs_camera_perspective(&world.camera, (zs_turn)prng_range(p, 2000, 22000), world.h, near, far + near);
    else
        (void)zs_camera_orthographic(&world.camera, prng_range(p, 300, 9000), prng_pick(p, 2) ? near : -far,
                                     far + near);
    const int32_t *of = world.instance[prng_pick(p, world.scene.n_instances)].pose.pos;
    const int32_t at[3] = { of[0] + prng_range(p, -400, 400), of[1] + prng_range(p, -400, 400), of[2] };
    (void)zs_camera_orbit(&world.camera, at, distance, (zs_turn)prng_next(p), (int16_t)prng_range(p, -16000, 16000));
    if (world.wall)
        wall(p, prng_range(p, near + 1, near + 1 + distance / 2));
    if (world.with_effects) {
        const struct zs_rect all = { 0, 0, W_MAX, H_MAX };
        zs_sky_look(&world.effects.sky.sky, &world.camera, &all, NULL);
    }
}

static void light(struct prng *p)
{
    const int32_t dir[3] = { prng_range(p, -9, 9), prng_range(p, -9, 9), 3 };
    (void)zs_unit(world.scene.light.dir, dir);
    world.scene.light.ambient = prng_pick(p, ZS_Q16_ONE);
    world.scene.light.diffuse = prng_pick(p, ZS_Q16_ONE);
}

static int overlay_changes(void *ctx, struct zs_rect *rect)
{
    (void)ctx;
    *rect = world.moved;
    return world.moved.w != 0;
}

/* All of both. */
static struct zs_rect both(const struct zs_rect *a, const struct zs_rect *b)
{
    const int32_t x = a->x < b->x ? a->x : b->x, y = a->y < b->y ? a->y : b->y;
    const int32_t right = a->x + a->w > b->x + b->w ? a->x + a->w : b->x + b->w;
    const int32_t down = a->y + a->h > b->y + b->h ? a->y + a->h : b->y + b->h;
    const struct zs_rect r = {
        .x = (uint16_t)x, .y = (uint16_t)y, .w = (uint16_t)(right - x), .h = (uint16_t)(down - y)
    };
    return r;
}

/* Where it is in the next frame. */
static void overlay_move(struct prng *p, int moves)
{
    struct zs_rect to = world.overlay;
    if (moves) {
        to.x = (uint16_t)prng_pick(p, W_MAX);
        to.y = (uint16_t)prng_pick(p, H_MAX);
        to.w = (uint16_t)(1 + prng_pick(p, 40));
        to.h = (uint16_t)(1 + prng_pick(p, 40));
    }
    world.moved = both(&world.overlay, &to);
    world.moved.w = (uint16_t)(moves ? world.moved.w : 0);
    world.overlay = to;
}

static void around(struct prng *p)
{
    world.sky.fill = own_fill;
    world.sky.ctx = &world.sky_seed;
    if (world.with_effects && prng_pick(p, 2))
        world.sky = world.effects.sky.sky.background;
    world.sky_seed = (uint16_t)prng_next(p);
    world.resolve[0].draw = own_draw;
    world.resolve[0].changes = overlay_changes;
    world.resolve[0].ctx = &world.overlay;
    world.scene.sky = prng_pick(p, 4) ? NULL : &world.sky;
    world.scene.resolve = world.resolve;
    world.scene.n_resolves = prng_pick(p, 4) == 0;
    overlay_move(p, 1);
}

static void count(struct prng *p)
{
    world.scene.n_instances = 3 + prng_pick(p, (uint32_t)world.crowd - 2);
}

static void world_open(struct prng *p, uint16_t h, int walls)
{
    world.h = h;
    world.wall = prng_pick(p, 6) == 0;
    world.walls = walls;
    world.crowd = prng_pick(p, 8) ? CROWD : INSTANCES;
    world.with_effects = !walls && prng_pick(p, 2);
    if (world.with_effects)
        effects_make(&world.effects, p, 2000);
    shapes(p);
    texels(p);
    for (int k = 0; k < 2; k++) {
        const struct zs_depth_state s = { .func = (uint8_t)prng_pick(p, 3),
                                          .read_only = (uint8_t)prng_pick(p, 2),
                                          .bias = (int16_t)prng_range(p, -9, 9),
                                          .slope_bias = (int16_t)prng_range(p, -400, 400) };
        world.state[k] = s;
    }
    for (int k = 0; k < INSTANCES; k++) {
        stand(p, &world.instance[k]);
        world.instance[k].material = &world.material[k].material;
        cover(p, &world.material[k]);
    }
    (void)mend(p);
    if (world.with_effects && !effects_map(&world.effects, p, world.instance, INSTANCES, 3000))
        abort(); /* the map depends on how it is drawn */
    world.scene.instance = world.instance;
    count(p);
    world.scene.background = (uint16_t)prng_next(p);
    around(p);
    world.camera.projection = (uint8_t)(prng_pick(p, 4) ? ZS_PERSPECTIVE : ZS_ORTHOGRAPHIC);
    light(p);
    look(p);
}

/* One change; 1: of bytes behind pointers, which zs_damage_track has to be told. */
static int change(struct prng *p)
{
    struct zs_instance *in = &world.instance[prng_pick(p, world.scene.n_instances)];
    switch (prng_pick(p, 18)) {
    case 0:
    case 1:
    case 2: look(p); return 0;
    case 3: light(p); return 0;
    case 4: cover(p, &world.material[in - world.instance]); return world.with_effects;
    case 5: count(p); return 0;
    case 6: world.scene.background ^= 1; return 0;
    case 7: world.texel[prng_pick(p, 64)] ^= 0x1111; return 1;
    case 8: stand(p, in); return 0;
    case 16: /* not while it is away: it may be back in the same frame, and nobody would be told */
        world.sky_seed ^= world.scene.sky != NULL;
        return world.scene.sky != NULL;
    case 17: world.scene.sky = world.scene.sky ? NULL : &world.sky; return 0;
    case 9:
    case 10: in->pose.pos[prng_pick(p, 3)] += prng_range(p, -300, 300); return 0;
    default:
        zs_pose_turn(&in->pose, (zs_turn)prng_next(p), (zs_turn)prng_next(p), (zs_turn)prng_next(p));
        return 0;
    }
}

/* ---- Some way -------------------------------------------------------------------------------------------- */

struct glass {
    int32_t w, h;
    uint16_t color[W_MAX * H_MAX], key[W_MAX * H_MAX]; /* colours as they are sent */
    uint8_t given[H_MAX]; /* rows whose keys came in this frame; by columns ... */
    uint16_t from[H_MAX], end[H_MAX]; /* ... these of them */
};

struct hand { /* one renderer, or two that share the strips */
    struct zs_renderer r[2];
    void *arena[2];
    uint64_t *sum;
    struct zs_strip_hashes sums;
    uint32_t *track;
    struct zs_config config;
    uint32_t fasts;
    int sharing, by_hand, columns, told; /* told: zs_invalidate was called for this frame */
    struct glass glass;
};

/* What was given out is put on the glass: pixels of changed columns, all keys that there are. */
static int take(void *ctx, const struct zs_strip *s)
{
    struct hand *hand = ctx;
    struct glass *g = &hand->glass;
    for (int j = 0; j < s->h; j++)
        memcpy(g->color + (s->y + j) * g->w + s->dirty_x, s->px + 2 * (j * s->w + s->dirty_x), 2u * s->dirty_w);
    const int from = hand->columns ? s->dirty_x : 0, n = hand->columns ? s->dirty_w : s->w;
    if (!s->dirty_w && hand->track)
        return 0;
    for (int j = 0; j < s->h; j++) {
        if (s->depth)
            memcpy(g->key + (s->y + j) * g->w + from, s->depth + j * s->w + from, (size_t)n * sizeof *g->key);
        g->given[s->y + j] = 1;
        g->from[s->y + j] = (uint16_t)from;
        g->end[s->y + j] = (uint16_t)(from + n);
    }
    return 0;
}

static int hand_render(struct prng *p, struct hand *hand)
{
    const struct zs_sink sink = { .submit = take, .ctx = hand };
    if (!hand->sharing && !hand->by_hand)
        return zs_render(&hand->r[0], &world.scene, &world.camera, &sink);
    int err = ZS_OK;
    for (int k = 0; k <= hand->sharing && !err; k++)
        err = zs_frame_begin(&hand->r[k], &world.scene, &world.camera);
    for (int more = !err; more;) {
        const int whose = hand->sharing ? (int)prng_pick(p, 2) : 0;
        struct zs_strip s;
        more = zs_frame_strip(&hand->r[whose], &s) == 1;
        if (more)
            (void)take(hand, &s);
        if (hand->sharing && zs_frame_skip(&hand->r[1 - whose]) != more)
            return -1000;
    }
    for (int k = 0; k <= hand->sharing && !err; k++)
        err = zs_frame_end(&hand->r[k]);
    return err;
}

static uint32_t *words(uint32_t n, uint32_t junk)
{
    uint32_t *w = malloc((n ? n : 1) * sizeof *w);
    for (uint32_t i = 0; w && i < n; i++)
        w[i] = junk;
    if (!w)
        abort();
    return w;
}

/* Triangles of all instances that there may be. */
static uint32_t tris(void)
{
    uint32_t n = 0;
    for (int k = 0; k < world.crowd; k++)
        n += world.instance[k].mesh->n_tris;
    return n;
}

static int hand_open(struct prng *p, struct hand *hand, struct zs_config c)
{
    static const uint16_t pools[] = { 1, 2, 5, 20, 60, 60, 200, 200, POOL, POOL, POOL };
    enum { TINY = 0, SMALL = 3, LARGE = 6, N_POOLS = KINDS(pools) }; /* the first of such */
    static const uint32_t junk[] = { 0, UINT32_MAX, 0x5a5aa5a5, 0x80000001 };
    memset(hand, 0, sizeof *hand);
    hand->glass.w = c.width;
    hand->glass.h = c.height;
    /* a few triangles, or rows, at a time are slow: for small scenes, and seldom both */
    const int eased = c.method && prng_pick(p, 16); /* the least pools are for every sixteenth */
    const int modest = tris() <= (eased ? MODEST / 4 : MODEST), rows = modest && prng_pick(p, 8) == 0;
    const uint32_t least = prng_pick(p, rows || !modest ? 32 : 12) == 0 ? TINY
                           : rows || prng_pick(p, 3) == 0               ? LARGE
                                                                        : SMALL;
    c.strip_h = (uint16_t)(rows ? prng_range(p, 1, 7) : prng_range(p, 8, prng_pick(p, 2) ? 24 : c.height));
    c.buffers = (uint8_t)(1 + prng_pick(p, 2));
    c.max_tris = pools[least + prng_pick(p, N_POOLS - least)];
    c.max_verts = (uint16_t)(2 + pools[least + prng_pick(p, N_POOLS - least)]);
    if (eased) { /* a pool of two halves rectangles 4,800 times: nine of 230 seeds took half of all time */
        const uint16_t least_pool = (uint16_t)(tris() / POOLS_MOST);
        c.max_tris = c.max_tris < least_pool ? least_pool : c.max_tris;
        c.max_verts = c.max_verts < least_pool ? least_pool : c.max_verts;
    }
    const struct kind_method *method = method_of(&c);
    c.max_tris = c.max_tris < method->least_tris ? method->least_tris : c.max_tris;
    c.max_verts = c.max_verts < method->least_verts ? method->least_verts : c.max_verts;
    hand->fasts = stress_fasts(p);
    c.fast = stress_list(hand->fasts); /* as many hands as fast_of keeps lists */
    hand->config = c;
    hand->sharing = prng_pick(p, 6) == 0;
    hand->by_hand = prng_pick(p, 3) == 0;
    int err = ZS_OK;
    for (int k = 0; k <= hand->sharing && !err; k++) {
        const uint32_t bytes = zs_arena_bytes(&c), fill = junk[prng_pick(p, 4)];
        hand->arena[k] = words(bytes / 4u, fill);
        memset(&hand->r[k], (int)fill & 255, sizeof hand->r[k]);
        err = zs_init(&hand->r[k], &c, hand->arena[k], bytes);
    }
    const uint32_t n = ZS_STRIPS(c.height, c.strip_h), columns = 1 + prng_pick(p, COLUMNS_MAX);
    if (!err && prng_pick(p, 3) == 0) { /* one panel, whoever draws its strips */
        hand->sum = calloc(n * columns, sizeof *hand->sum);
        err = zs_strip_hashes_init(&hand->sums, hand->sum, c.width, c.height, c.strip_h, columns);
        for (int k = 0; k <= hand->sharing && !err; k++)
            err = zs_damage_compare(&hand->r[k], &hand->sums);
    }
    if (!err && !hand->sharing && prng_pick(p, 2)) {
        hand->track = words(ZS_DAMAGE_WORDS(INSTANCES, c.height, c.strip_h), junk[prng_pick(p, 4)]);
        err = zs_damage_track(&hand->r[0], hand->track, INSTANCES);
        hand->columns = (int)prng_pick(p, 2);
        if (!err)
            err = zs_damage_columns(&hand->r[0], hand->columns);
    }
    return err;
}

static void hand_close(struct hand *hand)
{
    free(hand->arena[0]);
    free(hand->arena[1]);
    free(hand->sum);
    free(hand->track);
}

/* What the glass shows of a part is gone, and the renderer is told; part NULL: told only. */
static int hand_invalidate(struct hand *hand, const struct zs_rect *part)
{
    struct glass *g = &hand->glass;
    hand->told = 1;
    for (int j = part ? part->y : g->h; j < g->h && j < part->y + part->h; j++)
        for (int i = part->x; i < g->w && i < part->x + part->w; i++)
            g->color[j * g->w + i] ^= 0x5555;
    int err = ZS_OK;
    for (int k = 0; k <= hand->sharing && !err; k++)
        err = zs_invalidate(&hand->r[k], part);
    return err;
}

/* ---- Comparing ------------------------------------------------------------------------------------------- */

static int plain_take(void *ctx, const struct zs_strip *s)
{
    struct glass *g = ctx;
    memcpy(g->color, s->px, s->n_bytes);
    if (s->depth)
        memcpy(g->key, s->depth, s->n_bytes);
    else
        memset(g->key, 0, s->n_bytes);
    return 0;
}

/* Keys of a row. zs_damage_compare: they may change where colours do not. */
static int keys_same(const struct glass *a, const struct glass *b, const struct hand *hand, int row)
{
    const int from = hand->sum ? (a->given[row] ? a->from[row] : a->w) : 0,
              end = hand->sum && a->given[row] ? a->end[row] : a->w;
    return memcmp(a->key + row * a->w + from, b->key + row * a->w + from, (size_t)(end - from) * 2) == 0;
}

static int same(const struct glass *b, const struct hand *hand, int frame)
{
    const struct glass *a = &hand->glass;
    const size_t bytes = (size_t)a->w * 2;
    int row = 0;
    while (row < a->h && memcmp(a->color + row * a->w, b->color + row * a->w, bytes) == 0 && keys_same(a, b, hand, row))
        row++;
    if (row == a->h)
        return 1;
    const struct zs_config *c = &hand->config;
    for (int i = row * a->w; i < a->w * a->h; i++)
        if (a->color[i] != b->color[i] || a->key[i] != b->key[i])
            return stress_wrong(
                "frame %d: (%d, %d) of %dx%d is colour %04x key %u, not %04x %u; strips of %u, "
                "%u triangles, %u vertices, %u buffers, accelerators %#x, compare %d, track %d %d, sharing %d",
                frame, i % a->w, i / a->w, a->w, a->h, a->color[i], a->key[i], b->color[i], b->key[i], c->strip_h,
                c->max_tris, c->max_verts, c->buffers, hand->fasts, hand->sum != NULL, hand->track != NULL,
                hand->columns, hand->sharing);
    return 0;
}

/* The accelerators that did something, as far as counts say; of the others: had something to do. */
static uint32_t did(const struct hand *hand, const struct zs_stats *s, uint32_t shaders, uint32_t texels)
{
    uint32_t out = 0;
    for (unsigned k = 0; k < STRESS_FASTS; k++) {
        const char *name = fast_name(k);
        int is = strcmp(name, "batch") == 0 || strcmp(name, "edges") == 0;
        is |= strcmp(name, "touch") == 0 && s->pixels_untested;
        is |= strcmp(name, "tiles") == 0 && (s->instances_hidden || (s->tris_hidden && !hand->columns));
        is |= strcmp(name, "clusters") == 0 && s->clusters_culled;
        if (hand->config.method) /* no others work with it */
            shaders = texels = 0;
        for (uint32_t i = 0; i < KINDS(kind_shaders); i++)
            is |= strcmp(name, kind_shaders[i].name) == 0 && shaders >> i & 1u;
        for (uint32_t i = 0; i < KINDS(kind_texels); i++)
            is |= strcmp(name, kind_texels[i].name) == 0 && texels >> i & 1u;
        out |= (uint32_t)is << k;
    }
    return out & hand->fasts;
}

/* What the way of a frame was, and which accelerators did something. */
static void see(const struct hand *hand, uint64_t *seen)
{
    const struct zs_config *c = &hand->config;
    const struct zs_stats *s = zs_frame_stats(&hand->r[0]);
    seen[SEEN_PASSES] += s->passes > 1;
    seen[SEEN_CLIPPED] += s->tris_clipped != 0;
    seen[SEEN_CLUSTERS] += s->clusters_in != 0;
    seen[SEEN_INSIDE] += (uint64_t)world.inside;
    seen[SEEN_ORTHOGRAPHIC] += world.camera.projection == ZS_ORTHOGRAPHIC;
    seen[SEEN_WATCH] += hand->sum != NULL;
    seen[SEEN_TRACK] += hand->track != NULL;
    seen[SEEN_BOTH] += hand->sum && hand->track;
    seen[SEEN_UNCHANGED] += s->strips_clean != 0;
    seen[SEEN_UNDRAWN] += s->strips_skipped != 0;
    seen[SEEN_INVALIDATED] += (uint64_t)hand->told;
    seen[SEEN_SHARED] += (uint64_t)hand->sharing;
    seen[SEEN_BUFFERS] += c->buffers == 2;
    seen[SEEN_KEYS] += c->depth_bits < 16;
    seen[SEEN_SUBPIXELS] += c->subpixel_bits == 4;
    for (size_t k = 0; k < KINDS(kind_depths); k++)
        seen[SEEN_DEPTH + k] += c->depth == kind_depths[k].depth;
    for (size_t k = 0; k < KINDS(kind_methods); k++)
        seen[SEEN_METHOD + k] += c->method == kind_methods[k].method;
    uint32_t shaders = 0, texels = 0, states = 0;
    for (uint32_t i = 0; i < world.scene.n_instances; i++) {
        const struct zs_material *m = world.instance[i].material;
        for (uint32_t k = 0; k < KINDS(kind_shaders); k++)
            shaders |= (uint32_t)(m->shader == kind_shaders[k].shader) << k;
        const int effect = effects_of(m->shader);
        if (effect >= 0)
            seen[SEEN_EFFECT + effect]++;
        if (m->primitive)
            seen[m->primitive->ops == &zs_lines_ops ? SEEN_LINES : SEEN_POINTS]++;
        texels |= 1u << (m->texture - world.texture);
        states |= world.instance[i].depth_state != NULL;
    }
    for (uint32_t k = 0; k < KINDS(kind_shaders); k++)
        seen[SEEN_SHADER + k] += shaders >> k & 1u;
    for (uint32_t k = 0; k < KINDS(world.texture); k++)
        seen[SEEN_TEXEL + k] += texels >> k & 1u;
    for (uint32_t k = 0; k < world.scene.n_resolves; k++) {
        seen[SEEN_HOOK + EFFECT_FOG] += world.resolve[k].draw == zs_fog_draw;
        seen[SEEN_HOOK + EFFECT_DITHER] += world.resolve[k].draw == zs_dither_draw;
        seen[SEEN_HOOK + EFFECT_OVERLAY] += world.resolve[k].draw == zs_overlay_draw;
    }
    seen[SEEN_STATE] += states;
    seen[SEEN_SKY] += world.scene.sky != NULL;
    seen[SEEN_RESOLVE] += world.scene.n_resolves != 0;
    uint32_t textured = 0;
    for (uint32_t k = 0; k < KINDS(kind_shaders); k++)
        textured |= kind_shaders[k].texture && shaders >> k & 1u;
    stress_saw_fasts(seen, hand->fasts, did(hand, s, shaders, textured ? texels : 0));
}

static int hand_right(struct prng *p, struct hand *hand, const struct glass *want, int wanted,
                      const struct zs_stats *plain, int frame, struct stress_counts *c)
{
    memset(hand->glass.given, 0, sizeof hand->glass.given);
    const int err = hand_render(p, hand);
    if (err != wanted)
        return stress_wrong("frame %d: %s, and plainly: %s", frame, zs_error_string(err), zs_error_string(wanted));
    if (err)
        return 1;
    if (!same(want, hand, frame))
        return 0;
    c->frames++;
    c->tris += plain->tris_drawn;
    c->pixels += (uint64_t)want->w * (uint64_t)want->h;
    if (plain->tris_drawn >= STRESS_TRIS) {
        c->units++;
        see(hand, c->seen);
    }
    hand->told = 0;
    return 1;
}

static int frame_right(struct prng *p, struct hand *hand, const struct zs_config *plain, int frame,
                       struct stress_counts *c)
{
    static uint32_t arena[PLAIN_BYTES / 4];
    static struct zs_renderer r;
    static struct glass want;
    want.w = plain->width;
    want.h = plain->height;
    const struct zs_sink sink = { .submit = plain_take, .ctx = &want };
    const struct zs_stats *s = zs_frame_stats(&r);
    struct zs_config quick = *plain;
    struct zs_strip first; /* with it all triangles have been looked at */
    quick.fast = fast_all;
    quick.strip_h = 8;
    for (int tries = 0; tries < 16; tries++) { /* views of next to nothing are not counted: most are passed over */
        if (zs_init(&r, &quick, arena, sizeof arena))
            return stress_wrong("the plain renderer");
        if (zs_frame_begin(&r, &world.scene, &world.camera) || zs_frame_strip(&r, &first) != 1 ||
            s->tris_drawn >= STRESS_TRIS || prng_pick(p, 32) == 0)
            break;
        look(p);
    }
    if (zs_init(&r, plain, arena, sizeof arena))
        return stress_wrong("the plain renderer");
    const int wanted = zs_render(&r, &world.scene, &world.camera, &sink);
    int ok = 1;
    for (int k = 0; k < HANDS && ok; k++)
        ok = hand_right(p, &hand[k], &want, wanted, s, frame, c);
    return ok;
}

static int32_t side(struct prng *p, int32_t most)
{
    if (prng_pick(p, 3))
        return STRESS_PX;
    return prng_range(p, STRESS_PX, prng_pick(p, 2) ? 96 : most);
}

int stress_frames(uint64_t seed, struct stress_counts *c)
{
    static struct hand hand[HANDS];
    struct prng p = { seed };
    const int walls = prng_pick(&p, 6) == 0;
    const int32_t w = walls ? W_MAX : side(&p, W_MAX), h = side(&p, H_MAX);
    const struct kind_method *method = &kind_methods[prng_pick(&p, 3) ? 0 : prng_pick(&p, KINDS(kind_methods))];
    world.without = !method->method                         ? 0
                    : method->method == &zs_method_transparent ? 0
                    : method->method == &zs_method_painter ? EFFECT_PLAIN
                                                            : EFFECT_PLAIN | EFFECT_BUFFER;
    world_open(&p, (uint16_t)h, walls);
    struct zs_config plain = picture_config(w, h, &zs_depth_linear);
    plain.max_tris = plain.max_verts = POOL;
    plain.varyings = ZS_VARYINGS_MAX;
    plain.subpixel_bits = prng_pick(&p, 4) ? 8 : 4;
    plain.depth_bits = (uint8_t)(prng_pick(&p, 3) ? 16 : prng_range(&p, 8, 15));
    if (world.camera.projection == ZS_PERSPECTIVE)
        plain.depth = kind_depths[prng_pick(&p, KINDS(kind_depths))].depth;
    plain.fast = NULL;
    plain.method = method->method;
    plain.depth = method->depth ? method->depth : plain.depth;
    if (world.with_effects && prng_pick(&p, 3) == 0 &&
        effects_hook(&world.effects, &p, (enum effect_hook)prng_pick(&p, EFFECT_HOOKS), &plain, &world.camera,
                     &world.resolve[world.scene.n_resolves]))
        world.scene.n_resolves++;
    int ok = 1;
    for (int k = 0; k < HANDS; k++)
        ok &= !hand_open(&p, &hand[k], plain) || stress_wrong("a renderer cannot be set up");
    for (int frame = 0; frame < FRAMES && ok; frame++) {
        int told = 0;
        for (uint32_t n = frame ? prng_pick(&p, 4) : 0; n; n--)
            told |= change(&p);
        told |= mend(&p);
        if (frame)
            overlay_move(&p, prng_pick(&p, 3) != 0);
        for (int k = 0; k < HANDS && ok; k++) {
            const struct zs_rect part = { (uint16_t)prng_pick(&p, 90), (uint16_t)prng_pick(&p, 90), 9, 9 };
            if (told || (frame && prng_pick(&p, 8) == 0))
                ok = hand_invalidate(&hand[k], told ? NULL : &part) == ZS_OK || stress_wrong("zs_invalidate");
        }
        ok = ok && frame_right(&p, hand, &plain, frame, c);
    }
    for (int k = 0; k < HANDS; k++)
        hand_close(&hand[k]);
    return ok;
}
