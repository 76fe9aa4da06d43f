/* Calls in every order: all sequences of the calls of a frame up to some length, each answered as zstrip.h says, and
 * the next good frame is right. And two renderers in one program, their calls interleaved: each gives what it gives
 * alone.
 *
 * SPDX-License-Identifier: MIT
 */
#include <string.h>

#include "cases.h"
#include "picture.h"
#include "shapes.h"
#include "zs_damage.h"

/* ---- A small frame ----------------------------------------------------------------------------------- */

#define W 6
#define H 8
#define ROWS 2
#define STRIPS 4u
#define COLUMNS 2u
#define LENGTH 5
#define ARENA_BYTES ZS_ARENA_BYTES(W, H, ROWS, 3, 9, 0, 2)

static struct lone lone;
static struct zs_scene scene[2]; /* triangles in the first and last strip that move, one between that stays */
static struct zs_instance instances[2][3];
static struct zs_camera camera;
static struct zs_config config;
static struct picture want[2];

static void scenes_make(void)
{
    static const int16_t pos[3][3] = { { -150, 130, 0 }, { 140, 130, 0 }, { 0, -180, 0 } };
    static const int32_t places[2][3][2] = { { { -640, 800 }, { 128, 32 }, { -640, -736 } },
                                             { { 640, 800 }, { 128, 32 }, { 640, -736 } } };
    camera = pixel_camera(H, 0);
    config = lone_config(W, H, &zs_depth_linear);
    config.strip_h = ROWS;
    config.max_tris = 3;
    config.max_verts = 9;
    config.varyings = 0;
    config.buffers = 2;
    lone_set(&lone, pos, 3, ZS_Q16_ONE);
    lone.mesh.radius = 200; /* within a strip or two: zs_damage_track leaves others out */
    for (int k = 0; k < 2; k++) {
        for (int i = 0; i < 3; i++) {
            instances[k][i] = lone.instance;
            instances[k][i].pose.pos[0] = places[k][i][0];
            instances[k][i].pose.pos[1] = places[k][i][1];
            instances[k][i].pose.pos[2] = -PIXEL_Z;
        }
        scene[k] = lone.scene;
        scene[k].instance = instances[k];
        scene[k].n_instances = 3;
        want[k] = picture_draw(&config, &scene[k], &camera);
        assert_int_equal(want[k].err, ZS_OK);
        assert_true(want[k].covered > 2);
    }
    assert_false(memcmp(want[0].color, want[1].color, W * H * 2) == 0);
}

/* ---- All orders ------------------------------------------------------------------------------------------ */

enum op { BEGIN_A, BEGIN_B, STRIP, SKIP, END, INVALIDATE, TRACK, WATCH, RENDER_A, OPS };

struct desk { /* a renderer, all of its memory, what has arrived, and what it should be in: copied as a whole */
    struct zs_renderer r;
    uint32_t arena[ARENA_BYTES / 4];
    uint64_t sum[STRIPS * COLUMNS];
    struct zs_strip_hashes sums;
    uint32_t memory[ZS_DAMAGE_WORDS(3, H, ROWS)];
    uint16_t glass[W * H];
    int open; /* the scene, or -1 */
    uint32_t given;
    int tracking, comparing;
};

static uint64_t n_calls;

static int arrive(struct desk *d, const struct zs_strip *s, int k)
{
    CASE_CHECK(s->y == d->given * ROWS && s->dirty_x + s->dirty_w <= W);
    CASE_CHECK(s->h == ROWS);
    CASE_CHECK(d->tracking || d->comparing || s->dirty_w == W);
    for (int j = 0; j < s->h; j++)
        for (int i = s->dirty_x; i < s->dirty_x + s->dirty_w; i++)
            d->glass[(s->y + j) * W + i] = (uint16_t)(s->px[2 * (j * W + i)] << 8 | s->px[2 * (j * W + i) + 1]);
    CASE_CHECK(memcmp(d->glass + s->y * W, want[k].color + s->y * W, s->n_bytes) == 0);
    if (s->dirty_w || !d->tracking)
        CASE_CHECK(memcmp(s->depth, want[k].key + s->y * W, s->n_bytes) == 0);
    return 1;
}

struct onto {
    struct desk *d;
    int scene, ok;
};

static int submit(void *ctx, const struct zs_strip *s)
{
    struct onto *at = ctx;
    at->d->given = (uint32_t)s->y / ROWS;
    at->ok = at->ok && arrive(at->d, s, at->scene);
    return 0;
}

static int render(struct desk *d, int k)
{
    struct onto at = { d, k, 1 };
    const struct zs_sink sink = { .submit = submit, .ctx = &at };
    CASE_CHECK(zs_render(&d->r, &scene[k], &camera, &sink) == ZS_OK && at.ok);
    d->open = -1;
    CASE_CHECK(memcmp(d->glass, want[k].color, sizeof d->glass) == 0);
    return 1;
}

/* One call; 1: answered as it should be. */
static int call(struct desk *d, enum op op)
{
    struct zs_strip s;
    const int open = d->open >= 0, left = open && d->given < STRIPS;
    n_calls++;
    switch (op) {
    case BEGIN_A:
    case BEGIN_B:
        CASE_CHECK(zs_frame_begin(&d->r, &scene[op], &camera) == ZS_OK);
        d->open = (int)op;
        d->given = 0;
        return 1;
    case STRIP:
        CASE_CHECK(zs_frame_strip(&d->r, &s) == (open ? left : ZS_ERR_SEQUENCE));
        if (left && !arrive(d, &s, d->open))
            return 0;
        d->given += (uint32_t)left;
        return 1;
    case SKIP:
        CASE_CHECK(zs_frame_skip(&d->r) == (!open || d->tracking ? ZS_ERR_SEQUENCE : left));
        d->given += left && !d->tracking;
        return 1;
    case END:
        CASE_CHECK(zs_frame_end(&d->r) == (open ? ZS_OK : ZS_ERR_SEQUENCE));
        d->open = -1;
        return 1;
    case INVALIDATE: { /* a part between, which is gone from the glass */
        const struct zs_rect part = { 2, 3, 2, 2 };
        CASE_CHECK(zs_invalidate(&d->r, &part) == ZS_OK);
        for (int i = 0; i < 4; i++)
            d->glass[(3 + i / 2) * W + 2 + i % 2] ^= 0x3333;
        return 1;
    }
    case TRACK:
        CASE_CHECK(zs_damage_track(&d->r, d->tracking ? NULL : d->memory, 3) == (open ? ZS_ERR_SEQUENCE : ZS_OK));
        d->tracking ^= !open;
        return 1;
    case WATCH:
        if (!open && !d->comparing)
            CASE_CHECK(zs_strip_hashes_init(&d->sums, d->sum, W, H, d->r.config.strip_h, COLUMNS) == ZS_OK);
        CASE_CHECK(zs_damage_compare(&d->r, d->comparing ? NULL : &d->sums) == (open ? ZS_ERR_SEQUENCE : ZS_OK));
        d->comparing ^= !open;
        return 1;
    default: return render(d, 0);
    }
}

/* All sequences that begin like this one. Pointers in the renderer stay right: every level works on the same desk. */
static int all_orders(struct desk *d, struct desk *saved, enum op *said, int n)
{
    if (n == LENGTH)
        return 1;
    saved[n] = *d;
    for (enum op op = BEGIN_A; op < OPS; op++) {
        said[n] = op;
        if (!call(d, op) || !all_orders(d, saved, said, n + 1)) {
            fprintf(stderr, "%d ", (int)op);
            return 0;
        }
        for (int k = 0; k < 2; k++) /* whatever was called: the next frame is right */
            if ((n == LENGTH - 1 || k == 0) && !render(d, k))
                return 0;
        *d = saved[n];
    }
    return 1;
}

static void every_order_of_calls(void **state)
{
    static struct desk d, saved[LENGTH];
    enum op said[LENGTH];
    n_calls = 0;
    scenes_make();
    for (int before = 0; before < 2;
         before++) { /* a new renderer, and one that has drawn with zs_damage_track and zs_damage_compare */
        memset(&d, before ? 0xa5 : 0x5a, sizeof d);
        d.open = -1;
        d.tracking = d.comparing = 0;
        assert_int_equal(zs_init(&d.r, &config, d.arena, sizeof d.arena), ZS_OK);
        if (before) {
            assert_true(call(&d, TRACK) && call(&d, WATCH) && render(&d, 1));
            assert_true(call(&d, BEGIN_A) && call(&d, STRIP)); /* and a frame that is open */
        }
        assert_true(all_orders(&d, saved, said, 0));
    }
    PICTURES_FREE(&want[0], &want[1]);
    print_message("every order of %d calls of %d: %llu calls\n", LENGTH, (int)OPS, (unsigned long long)n_calls);
}

/* ---- Two renderers ---------------------------------------------------------------------------------------- */

struct side { /* a renderer of its own profile, and what it draws alone: two scenes */
    struct zs_config config;
    struct zs_renderer r;
    void *arena;
    struct zs_camera camera[2];
    struct picture alone[2];
    struct zs_material material[2];
    struct zs_instance instance[3];
    struct zs_scene scene;
    int open;
    uint32_t given;
};

static struct shape both[2]; /* meshes that the two share */

static void side_open(struct side *s, struct prng *p)
{
    static const struct zs_depth *const depths[] = { &zs_depth_recip, &zs_depth_linear, &zs_depth_float,
                                                     &zs_depth_e4m12 };
    static const struct zs_shader *const shaders[] = { &zs_shade_raw, &zs_shade_flat, &zs_shade_smooth };
    memset(s, 0, sizeof *s);
    s->config = picture_config(prng_range(p, 20, 50), prng_range(p, 20, 50), depths[prng_pick(p, 4)]);
    s->config.strip_h = (uint16_t)prng_range(p, 1, 20);
    s->config.max_tris = (uint16_t)prng_range(p, 3, 200);
    s->config.max_verts = (uint16_t)prng_range(p, 9, 300);
    s->config.buffers = (uint8_t)prng_range(p, 1, 2);
    s->config.subpixel_bits = prng_pick(p, 2) ? 8 : 4;
    for (int k = 0; k < 3; k++) {
        struct zs_instance *in = &s->instance[k];
        s->material[k % 2].shader = shaders[prng_pick(p, 3)];
        s->material[k % 2].rgb.g = (uint8_t)prng_next(p);
        in->mesh = &both[prng_pick(p, 2)].mesh;
        in->material = &s->material[k % 2];
        zs_pose_identity(&in->pose);
        zs_pose_turn(&in->pose, (zs_turn)prng_next(p), (zs_turn)prng_next(p), 0);
        for (int c = 0; c < 3; c++)
            in->pose.pos[c] = prng_range(p, -1500, 1500);
    }
    s->scene.instance = s->instance;
    s->scene.n_instances = 1 + prng_pick(p, 3);
    s->scene.background = (uint16_t)prng_next(p);
    s->scene.light.ambient = s->scene.light.diffuse = ZS_Q16_ONE / 2;
    s->scene.light.dir[2] = ZS_Q30_ONE;
    for (int k = 0; k < 2; k++) {
        static const int32_t origin[3] = { 0, 0, 0 };
        (void)zs_camera_perspective(&s->camera[k], (zs_turn)prng_range(p, 4000, 14000), s->config.height, 50, 20000);
        (void)zs_camera_orbit(&s->camera[k], origin, prng_range(p, 500, 6000), (zs_turn)prng_next(p), 2000);
        s->alone[k] = picture_draw(&s->config, &s->scene, &s->camera[k]);
    }
    s->open = -1;
    s->arena = malloc(zs_arena_bytes(&s->config));
}

static int side_step(struct side *s, struct prng *p)
{
    struct zs_strip strip;
    if (s->open < 0 || prng_pick(p, 60) == 0) { /* sometimes a frame is dropped */
        const int k = (int)prng_pick(p, 2);
        CASE_CHECK(zs_frame_begin(&s->r, &s->scene, &s->camera[k]) == s->alone[k].err);
        s->open = s->alone[k].err ? -1 : k;
        return 1;
    }
    const struct picture *a = &s->alone[s->open];
    const int got = zs_frame_strip(&s->r, &strip);
    if (got == 0) {
        CASE_CHECK(memcmp(zs_frame_stats(&s->r), &a->stats, sizeof a->stats) == 0);
        CASE_CHECK(zs_frame_end(&s->r) == ZS_OK);
        s->open = -1;
        return 1;
    }
    CASE_CHECK(got == 1);
    for (int i = 0; i < strip.w * strip.h; i++) {
        const int at = strip.y * strip.w + i;
        CASE_CHECK((strip.px[2 * i] << 8 | strip.px[2 * i + 1]) == a->color[at] && strip.depth[i] == a->key[at]);
    }
    return 1;
}

static int two_case(uint64_t seed)
{
    static struct side side[2];
    struct prng p = { seed };
    int ok = 1;
    for (int k = 0; k < 2; k++) {
        side_open(&side[k], &p);
        ok = ok && zs_init(&side[k].r, &side[k].config, side[k].arena, zs_arena_bytes(&side[k].config)) == ZS_OK;
    }
    for (int n = 0; n < 120 && ok; n++)
        ok = side_step(&side[prng_pick(&p, 2)], &p);
    for (int k = 0; k < 2; k++) {
        free(side[k].arena);
        PICTURES_FREE(&side[k].alone[0], &side[k].alone[1]);
    }
    return ok;
}

static void two_renderers_are_each_as_alone(void **state)
{
    shape_sphere(&both[0], 6, 8, 1200);
    shape_torus(&both[1], 8, 6, 1200, 400);
    CASES(two_case, 120);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(every_order_of_calls),
    cmocka_unit_test(two_renderers_are_each_as_alone)
};

CASES_MAIN(tests)
