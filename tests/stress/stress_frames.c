/* Random scenes that move, drawn some way - strips, pools, buffers, skips, zs_watch, zs_track, zs_invalidate, two
 * renderers that share the strips - onto a glass that gets changed columns alone, and the plainest way: one strip,
 * large pools, all skips off, a renderer without memory of the frame before. The glass must show the plain picture; keys
 * are its keys.
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdlib.h>
#include <string.h>

#include "kinds.h"
#include "picture.h"
#include "shapes.h"
#include "stress.h"

#define SHAPES 5
#define INSTANCES 7
#define FRAMES 8
#define W_MAX 96
#define H_MAX 96
#define POOL 3000 /* of the plainest way: more than all instances have */
#define PLAIN_BYTES ZS_ARENA_BYTES(W_MAX, H_MAX, H_MAX, POOL, POOL, ZS_ATTRS_MAX, 1)
#define COLUMNS_MAX 6u

static struct {
    struct shape shape[SHAPES];
    int16_t uv[SHAPE_VERTS][2];
    uint16_t texel[1024], palette[256];
    struct zs_texture texture[3];
    struct zs_material material[INSTANCES];
    struct zs_state state[2];
    struct zs_instance instance[INSTANCES];
    struct zs_scene scene;
    struct zs_camera camera;
    uint16_t h; /* px, of the frame */
} world;

/* ---- The world ------------------------------------------------------------------------------------------ */

static void shapes(struct prng *p)
{
    for (int k = 0; k < SHAPES; k++) {
        struct shape *s = &world.shape[k];
        switch (prng_pick(p, 4)) {
        case 0: shape_sphere(s, 3 + prng_pick(p, 6), 4 + prng_pick(p, 7), 1000); break;
        case 1: shape_torus(s, 4 + prng_pick(p, 8), 3 + prng_pick(p, 6), 900, 100 + prng_range(p, 0, 600)); break;
        case 2: shape_soup(s, 20 + prng_pick(p, 60), 900, prng_next(p)); break;
        default: shape_ground(s, 2 + prng_pick(p, 6), 2000, prng_range(p, 0, 300), prng_next(p)); break;
        }
        if (prng_pick(p, 3) == 0)
            s->mesh.pos_lo = (const uint8_t (*)[3])s->pos_lo;
        if (prng_pick(p, 2))
            s->mesh.vertex_rgb = NULL;
        if (prng_pick(p, 2))
            s->mesh.face_rgb = NULL;
        s->mesh.radius = (uint16_t)(s->mesh.radius + 2u); /* holds pos_lo */
        s->mesh.uv = (const int16_t (*)[2])world.uv;
        s->mesh.uv_bits = (uint8_t)prng_range(p, 8, 13);
    }
}

static void texels(struct prng *p)
{
    for (uint32_t i = 0; i < 1024; i++)
        world.texel[i] = (uint16_t)prng_next(p);
    for (uint32_t i = 0; i < 256; i++)
        world.palette[i] = (uint16_t)prng_next(p);
    for (uint32_t v = 0; v < SHAPE_VERTS; v++)
        for (int k = 0; k < 2; k++)
            world.uv[v][k] = (int16_t)prng_next(p);
    for (int k = 0; k < 3; k++) {
        struct zs_texture *t = &world.texture[k];
        memset(t, 0, sizeof *t);
        t->format = kind_texels[k].format;
        t->texel = world.texel;
        t->palette = kind_texels[k].colors_max ? world.palette : NULL;
        t->n_colors = kind_texels[k].colors_max;
        t->log2_w = (uint8_t)(1 + prng_pick(p, 5));
        t->log2_h = (uint8_t)(1 + prng_pick(p, 5));
        t->clamp = (uint8_t)prng_pick(p, 4);
    }
}

static void place(struct prng *p, struct zs_instance *in)
{
    const int32_t far = prng_pick(p, 8) ? 2500 : 9000;
    zs_pose_identity(&in->pose);
    if (prng_pick(p, 6))
        zs_pose_turn(&in->pose, (zs_turn)prng_next(p), (zs_turn)prng_next(p), (zs_turn)prng_next(p));
    for (int k = 0; k < 3; k++)
        in->pose.pos[k] = prng_range(p, -far, far);
    in->pose.scale = ZS_Q16_ONE / 4 + prng_pick(p, ZS_Q16_ONE * 2);
}

static void cover(struct prng *p, struct zs_material *m)
{
    m->shader = kind_shaders[prng_pick(p, KINDS(kind_shaders))].shader;
    m->rgb.r = (uint8_t)prng_next(p);
    m->rgb.g = (uint8_t)prng_next(p);
    m->rgb.b = (uint8_t)prng_next(p);
    m->cull = (uint8_t)(prng_pick(p, 2) ? ZS_CULL_NONE : prng_pick(p, 3));
    m->texture = &world.texture[prng_pick(p, 3)];
}

static void stand(struct prng *p, struct zs_instance *in)
{
    in->mesh = &world.shape[prng_pick(p, SHAPES)].mesh;
    place(p, in);
    in->state = prng_pick(p, 5) ? NULL : &world.state[prng_pick(p, 2)];
}

/* From outside, from among the instances, or from inside of one. */
static void look(struct prng *p)
{
    const int inside = prng_pick(p, 3) == 0;
    const int32_t distance = inside ? prng_range(p, 20, 1200) : prng_range(p, 1500, 9000);
    const int32_t near = inside ? prng_range(p, 1, 300) : prng_range(p, 20, 2000);
    const int32_t far = prng_pick(p, 4) ? 30000 : distance + prng_range(p, 500, 4000);
    if (world.camera.projection == ZS_PERSPECTIVE)
        (void)zs_camera_perspective(&world.camera, (zs_turn)prng_range(p, 2000, 22000), world.h, near, far + near);
    else
        (void)zs_camera_orthographic(&world.camera, prng_range(p, 300, 9000), prng_pick(p, 2) ? near : -far,
                                     far + near);
    const int32_t *of = world.instance[prng_pick(p, INSTANCES)].pose.pos;
    const int32_t at[3] = { of[0] + prng_range(p, -400, 400), of[1] + prng_range(p, -400, 400), of[2] };
    (void)zs_camera_orbit(&world.camera, at, distance, (zs_turn)prng_next(p), (int16_t)prng_range(p, -16000, 16000));
}

static void light(struct prng *p)
{
    const int32_t dir[3] = { prng_range(p, -9, 9), prng_range(p, -9, 9), 3 };
    (void)zs_unit(world.scene.light.dir, dir);
    world.scene.light.ambient = prng_pick(p, ZS_Q16_ONE);
    world.scene.light.diffuse = prng_pick(p, ZS_Q16_ONE);
}

static void world_open(struct prng *p, uint16_t h)
{
    world.h = h;
    shapes(p);
    texels(p);
    for (int k = 0; k < 2; k++) {
        const struct zs_state s = ZS_STATE((uint8_t)prng_pick(p, 2), (uint8_t)prng_pick(p, 2),
                                           (int16_t)prng_range(p, -9, 9), (int16_t)prng_range(p, -400, 400));
        world.state[k] = s;
    }
    for (int k = 0; k < INSTANCES; k++) {
        stand(p, &world.instance[k]);
        world.instance[k].material = &world.material[k];
        cover(p, &world.material[k]);
    }
    world.scene.instance = world.instance;
    world.scene.n_instances = 2 + prng_pick(p, INSTANCES - 1);
    world.scene.background = (uint16_t)prng_next(p);
    world.camera.projection = (uint8_t)(prng_pick(p, 4) ? ZS_PERSPECTIVE : ZS_ORTHOGRAPHIC);
    light(p);
    look(p);
}

/* One change; 1: of bytes behind pointers, which zs_track has to be told. */
static int change(struct prng *p)
{
    struct zs_instance *in = &world.instance[prng_pick(p, INSTANCES)];
    switch (prng_pick(p, 16)) {
    case 0:
    case 1:
    case 2: look(p); return 0;
    case 3: light(p); return 0;
    case 4: cover(p, &world.material[in - world.instance]); return 0;
    case 5: world.scene.n_instances = 2 + prng_pick(p, INSTANCES - 1); return 0;
    case 6: world.scene.background ^= 1; return 0;
    case 7: world.texel[prng_pick(p, 64)] ^= 0x1111; return 1;
    case 8: stand(p, in); return 0;
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
    uint16_t color[W_MAX * H_MAX], key[W_MAX * H_MAX];
    uint8_t given[H_MAX]; /* rows whose keys came in this frame */
};

struct hand { /* one renderer, or two that share the strips */
    struct zs_renderer r[2];
    void *arena[2];
    uint64_t *sum;
    uint32_t *track;
    struct zs_config config;
    int sharing, by_hand;
    struct glass *glass;
};

/* What was given out is put on the glass: pixels of changed columns, all keys that there are. */
static int take(void *ctx, const struct zs_strip *s)
{
    struct hand *hand = ctx;
    struct glass *g = hand->glass;
    for (int j = 0; j < s->h; j++)
        for (int i = s->changed_x; i < s->changed_x + s->changed_w; i++) {
            const int from = j * s->w + i;
            g->color[(s->y + j) * g->w + i] = (uint16_t)(s->px[2 * from] << 8 | s->px[2 * from + 1]);
        }
    if (s->changed_w || !hand->track) {
        memcpy(g->key + s->y * g->w, s->depth, (size_t)(s->w * s->h) * sizeof *g->key);
        memset(g->given + s->y, 1, s->h);
    }
    return 0;
}

static int hand_render(struct prng *p, struct hand *hand)
{
    const struct zs_sink sink = { take, NULL, hand };
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

static int hand_open(struct prng *p, struct hand *hand, struct zs_config c, struct glass *g)
{
    static const uint16_t pools[] = { 1, 2, 5, 20, 60, 200, POOL, POOL };
    static const uint32_t junk[] = { 0, UINT32_MAX, 0x5a5aa5a5, 0x80000001 };
    memset(hand, 0, sizeof *hand);
    hand->glass = g;
    c.strip_h = (uint16_t)(prng_pick(p, 3) ? prng_range(p, 8, c.height) : prng_range(p, 1, 16));
    c.buffers = (uint8_t)(1 + prng_pick(p, 2));
    const uint32_t least = prng_pick(p, 4) ? 3u : 0u; /* one triangle at a time is slow */
    c.max_tris = pools[least + prng_pick(p, 8u - least)];
    c.max_verts = (uint16_t)(2 + pools[least + prng_pick(p, 8u - least)]);
    c.skip_off = (uint8_t)(prng_pick(p, 2) ? 0 : prng_pick(p, 64));
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
    if (!err && !hand->sharing && prng_pick(p, 3) == 0) {
        hand->sum = calloc(n * columns, sizeof *hand->sum);
        err = zs_watch(&hand->r[0], hand->sum, columns);
    }
    if (!err && !hand->sharing && prng_pick(p, 2)) {
        hand->track = words(ZS_TRACK_WORDS(INSTANCES, c.height, c.strip_h), junk[prng_pick(p, 4)]);
        err = zs_track(&hand->r[0], hand->track, INSTANCES);
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

/* ---- Comparing ------------------------------------------------------------------------------------------- */

static int plain_take(void *ctx, const struct zs_strip *s)
{
    struct glass *g = ctx;
    for (int i = 0; i < s->w * s->h; i++) {
        g->color[i] = (uint16_t)(s->px[2 * i] << 8 | s->px[2 * i + 1]);
        g->key[i] = s->depth[i];
    }
    return 0;
}

static int same(const struct glass *a, const struct glass *b, const struct hand *hand, int frame)
{
    const size_t bytes = (size_t)a->w * 2;
    int row = 0; /* zs_watch: keys may change where colours do not */
    while (row < a->h && memcmp(a->color + row * a->w, b->color + row * a->w, bytes) == 0 &&
           ((hand->sum && !a->given[row]) || memcmp(a->key + row * a->w, b->key + row * a->w, bytes) == 0))
        row++;
    if (row == a->h)
        return 1;
    const struct zs_config *c = &hand->config;
    for (int i = row * a->w; i < a->w * a->h; i++)
        if (a->color[i] != b->color[i] || a->key[i] != b->key[i])
            return stress_wrong("frame %d: (%d, %d) of %dx%d is colour %04x key %u, not %04x %u; strips of %u, "
                                "%u triangles, %u vertices, %u buffers, skips off %u, watch %d, track %d, sharing %d",
                                frame, i % a->w, i / a->w, a->w, a->h, a->color[i], a->key[i], b->color[i], b->key[i],
                                c->strip_h, c->max_tris, c->max_verts, c->buffers, c->skip_off, hand->sum != NULL,
                                hand->track != NULL, hand->sharing);
    return 0;
}

static int frame_right(struct prng *p, struct hand *hand, const struct zs_config *plain, int frame,
                       struct stress_counts *c)
{
    static uint32_t arena[PLAIN_BYTES / 4];
    static struct zs_renderer r;
    static struct glass want;
    want.w = plain->width;
    want.h = plain->height;
    const struct zs_sink sink = { plain_take, NULL, &want };
    if (zs_init(&r, plain, arena, sizeof arena))
        return stress_wrong("the plain renderer");
    const int wanted = zs_render(&r, &world.scene, &world.camera, &sink);
    memset(hand->glass->given, 0, sizeof hand->glass->given);
    const int err = hand_render(p, hand);
    if (err != wanted)
        return stress_wrong("frame %d: %s, and plainly: %s", frame, zs_strerror(err), zs_strerror(wanted));
    if (err)
        return 1;
    const struct zs_stats *s = zs_frame_stats(&r);
    c->frames++;
    c->tris += s->tris_drawn;
    c->units += s->tris_drawn >= STRESS_TRIS;
    c->pixels += (uint64_t)want.w * (uint64_t)want.h;
    return same(hand->glass, &want, hand, frame);
}

int stress_frames(uint64_t seed, struct stress_counts *c)
{
    static struct glass glass;
    static struct hand hand;
    struct prng p = { seed };
    glass.w = prng_range(&p, STRESS_PX, W_MAX);
    glass.h = prng_range(&p, STRESS_PX, H_MAX);
    world_open(&p, (uint16_t)glass.h);
    struct zs_config plain = picture_config(glass.w, glass.h, &zs_depth_linear);
    plain.max_tris = plain.max_verts = POOL;
    plain.attrs = ZS_ATTRS_MAX;
    plain.subpixel_bits = prng_pick(&p, 4) ? 8 : 4;
    plain.depth_bits = (uint8_t)(prng_pick(&p, 3) ? 16 : prng_range(&p, 8, 15));
    if (world.camera.projection == ZS_PERSPECTIVE)
        plain.depth = kind_depths[prng_pick(&p, KINDS(kind_depths))].depth;
    plain.skip_off = 63;
    int ok = !hand_open(&p, &hand, plain, &glass) || stress_wrong("a renderer cannot be set up");
    hand.config.attrs = plain.attrs;
    for (int frame = 0; frame < FRAMES && ok; frame++) {
        int told = 0;
        for (uint32_t n = frame ? prng_pick(&p, 4) : 0; n; n--)
            told |= change(&p);
        const struct zs_rect part = { (uint16_t)prng_pick(&p, 90), (uint16_t)prng_pick(&p, 90), 9, 9 };
        if (told || prng_pick(&p, 8) == 0)
            for (int k = 0; k <= hand.sharing; k++)
                ok = ok && zs_invalidate(&hand.r[k], told ? NULL : &part) == ZS_OK;
        ok = ok && frame_right(&p, &hand, &plain, frame, c);
    }
    hand_close(&hand);
    return ok;
}
