/* What must not change a picture: strips, pools, buffers, accelerators, junk in memory, and moves of the
 * scene that the conventions say are moves of the picture.
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdlib.h>
#include <string.h>

#include "cases.h"
#include "clusters.h"
#include "fast_lists.h"
#include "oracle.h"
#include "own.h"
#include "picture.h"
#include "shapes.h"

/* ok, when both pictures are no longer needed. */
static int freed(struct picture *a, struct picture *b, int ok)
{
    picture_free(a);
    picture_free(b);
    return ok;
}

/* ---- Scenes ---------------------------------------------------------------------------------- */

#define INSTANCES 6

struct set { /* a scene and all that it points at */
    const char *name;
    struct shape shape[4];
    struct zs_material material[INSTANCES];
    struct zs_instance instance[INSTANCES];
    struct zs_scene scene;
    struct zs_camera camera;
    struct zs_config config;
};

static struct set set;

static void add(const struct shape *s, const struct zs_shader *shader, int32_t x, int32_t y,
                int32_t z, uint32_t cull)
{
    const uint32_t n = set.scene.n_instances++;
    struct zs_instance *in = &set.instance[n];
    const struct zs_material m = { .shader = shader, .rgb = { 200, 120, 250 }, .cull = (uint8_t)cull };
    set.material[n] = m;
    in->mesh = &s->mesh;
    in->material = &set.material[n];
    zs_pose_identity(&in->pose);
    zs_pose_turn(&in->pose, (zs_turn)(n * 7001u), (zs_turn)(n * 3003u), (zs_turn)(n * 911u));
    in->pose.pos[0] = x;
    in->pose.pos[1] = y;
    in->pose.pos[2] = z;
    set.scene.instance = set.instance;
}

static void look(int32_t x, int32_t y, int32_t z)
{
    const int32_t eye[3] = { x, y, z }, at[3] = { 0, 0, 0 }, up[3] = { 0, 1, 0 };
    if (zs_camera_look_at(&set.camera, eye, at, up))
        abort();
}

static void common(const char *name, const struct zs_depth *depth)
{
    memset(&set, 0, sizeof set);
    set.name = name;
    set.config = picture_config(90, 70, depth);
    const int32_t l[3] = { 3, 5, 4 };
    (void)zs_unit(set.scene.light.dir, l);
    set.scene.light.ambient = ZS_Q16_ONE / 5;
    set.scene.light.diffuse = ZS_Q16_ONE;
    set.scene.background = 0x1234;
    (void)zs_camera_perspective(&set.camera, 9000, 70, 60, 60000);
}

static void lit_set(void)
{
    common("flat, lit", &zs_depth_recip);
    shape_sphere(&set.shape[0], 10, 14, 3000);
    shape_torus(&set.shape[1], 14, 8, 4200, 1200);
    add(&set.shape[0], &zs_shade_flat, 0, 0, 0, ZS_CULL_BACK);
    add(&set.shape[1], &zs_shade_flat, 500, 0, 0, ZS_CULL_BACK);
    add(&set.shape[0], &zs_shade_raw, 3500, 900, -2000, ZS_CULL_NONE);
    look(2000, 3000, 11000);
}

static void smooth_set(void)
{
    common("smooth", &zs_depth_recip);
    shape_sphere(&set.shape[0], 8, 10, 3000);
    shape_torus(&set.shape[1], 12, 8, 4200, 1200);
    add(&set.shape[1], &zs_shade_smooth, 0, 0, 0, ZS_CULL_BACK);
    add(&set.shape[0], &zs_shade_smooth, 800, -200, 300, ZS_CULL_BACK);
    add(&set.shape[0], &zs_shade_flat, -3500, 900, -2000, ZS_CULL_BACK);
    look(-2000, 4000, 9000);
}

static void clipped_scene(const char *name, const struct zs_depth *depth)
{
    common(name, depth);
    shape_ground(&set.shape[0], 12, 20000, 400, 7);
    shape_sphere(&set.shape[1], 6, 8, 2500);
    shape_soup(&set.shape[2], 60, 9000, 11);
    add(&set.shape[0], &zs_shade_smooth, 0, -900, 0, ZS_CULL_NONE);
    set.shape[1].mesh.pos_lo = (const uint8_t (*)[3])set.shape[1].pos_lo;
    add(&set.shape[1], &zs_shade_smooth, 0, 0, 0, ZS_CULL_NONE);
    add(&set.shape[2], &zs_shade_raw, 0, 0, 0, ZS_CULL_NONE);
    add(&set.shape[0], &zs_shade_flat, 0, 9000, 0, ZS_CULL_NONE);
    zs_pose_turn(&set.instance[0].pose, 0, 0, 0);
    look(300, 100, 2400); /* inside the sphere, on the ground */
    set.camera.z_far = (zs_q48_16)20000 * 65536;
}

static void clipped_set(void)
{
    clipped_scene("smooth, clipped", &zs_depth_recip);
}

static void linear_set(void)
{
    clipped_scene("linear keys, clipped", &zs_depth_linear);
    set.config.depth_bits = 12;
}

static void ortho_set(void)
{
    common("orthographic", &zs_depth_linear);
    shape_soup(&set.shape[0], 200, 5000, 3);
    shape_torus(&set.shape[1], 10, 8, 4200, 1200);
    (void)zs_camera_orthographic(&set.camera, 11000, 7000, 13000); /* near and far cut the soup */
    look(4000, 5000, 8000);
    add(&set.shape[0], &zs_shade_raw, 0, 0, 0, ZS_CULL_NONE);
    add(&set.shape[1], &zs_shade_smooth, 0, 0, 0, ZS_CULL_FRONT);
    add(&set.shape[1], &zs_shade_flat, 0, 0, 0, ZS_CULL_NONE); /* ties with the one before */
    set.instance[2].pose = set.instance[1].pose;
}

static void coarse_set(void)
{
    common("4 sub-pixel bits, 8 bits of depth", &zs_depth_recip);
    shape_soup(&set.shape[0], 250, 6000, 5);
    add(&set.shape[0], &zs_shade_raw, 0, 0, 0, ZS_CULL_NONE);
    add(&set.shape[0], &zs_shade_smooth, 0, 0, 0, ZS_CULL_BACK);
    set.config.subpixel_bits = 4;
    set.config.depth_bits = 8;
    look(1000, 2000, 9000);
}

typedef void set_fn(void);
static set_fn *const sets[] = {
    lit_set, smooth_set, clipped_set, linear_set, ortho_set, coarse_set
};
#define N_SETS (sizeof sets / sizeof sets[0])

/* ---- Comparing with the plainest way --------------------------------------------------------- */

static struct picture drawn(const struct zs_config *config)
{
    struct picture p = picture_draw(config, &set.scene, &set.camera);
    if (p.err)
        fprintf(stderr, "wrong: %s: %s\n", set.name, zs_error_string(p.err));
    else if (!stats_add_up(&p.stats))
        fprintf(stderr, "wrong: %s: statistics do not add up\n", set.name);
    return p;
}

/* The current set drawn by another configuration is the same picture. */
static void same_with(const struct picture *plain, const struct zs_config *config, const char *what)
{
    char name[160];
    snprintf(name, sizeof name,
             "%s, %s: strips of %u, %u triangles, %u vertices, %u buffers", set.name,
             what, config->strip_h, config->max_tris, config->max_verts, config->buffers);
    struct picture p = drawn(config);
    assert_true(picture_same(plain, &p, name));
    assert_true(stats_add_up(&p.stats));
    assert_int_equal(p.stats.tris_in, plain->stats.tris_in);
    assert_int_equal(p.stats.strips,
                     (config->height + config->strip_h - 1) / config->strip_h);
    picture_free(&p);
}

static const uint16_t heights[] = { 1, 2, 3, 5, 8, 16, 70 };
#define N_HEIGHTS (sizeof heights / sizeof heights[0])

static void stress_21_any_strip_height(void **state)
{
    for (size_t s = 0; s < N_SETS; s++) {
        sets[s]();
        struct picture plain = drawn(&set.config);
        assert_int_equal(plain.err, ZS_OK);
        assert_true(plain.covered > 1000 && plain.stats.passes == 1);
        print_message("%-36s %u triangles in, %u drawn, %u cut, %u of %d pixels\n", set.name,
                      plain.stats.tris_in, plain.stats.tris_drawn, plain.stats.tris_clipped,
                      plain.covered, plain.w * plain.h);
        for (size_t k = 0; k < N_HEIGHTS; k++)
            for (uint8_t buffers = 1; buffers <= 2; buffers++) {
                struct zs_config c = set.config;
                c.strip_h = heights[k];
                c.buffers = buffers;
                same_with(&plain, &c, "strip height");
            }
        struct zs_config tall = set.config;
        tall.strip_h = 60000; /* means the frame's height */
        struct picture p = drawn(&tall);
        assert_true(picture_same(&plain, &p, "a strip taller than the frame"));
        PICTURES_FREE(&p, &plain);
    }
}

struct pools {
    uint16_t tris, verts;
};

static const struct pools pools[] = {
    { 1, 3 }, { 1, 4000 }, { 4000, 3 }, { 2, 5 },    { 3, 4 },
    { 7, 9 }, { 20, 30 },  { 64, 64 },  { 150, 90 }, { 90, 400 }
};
#define N_POOLS (sizeof pools / sizeof pools[0])

static void any_pool_down_to_one_triangle(void **state)
{
    uint32_t most_passes = 0;
    for (size_t s = 0; s < N_SETS; s++) {
        sets[s]();
        struct picture plain = drawn(&set.config);
        for (size_t k = 0; k < N_POOLS; k++)
            for (size_t h = k % 2; h < N_HEIGHTS; h += 2) {
                struct zs_config c = set.config;
                c.max_tris = pools[k].tris;
                c.max_verts = pools[k].verts;
                c.strip_h = heights[h];
                c.buffers = (uint8_t)(1 + h / 2 % 2);
                same_with(&plain, &c, "pools");
                struct picture p = drawn(&c);
                most_passes = p.stats.passes > most_passes ? p.stats.passes : most_passes;
                assert_true(p.stats.max_tris_used <= c.max_tris);
                assert_true(p.stats.max_verts_used <= c.max_verts);
                picture_free(&p);
            }
        picture_free(&plain);
    }
    print_message("pools: up to %u passes\n", most_passes);
}

/* None, all, all but one, one alone. */
#define LISTS (2u + 2u * fast_count())

static const struct zs_fast *const *list_of(uint32_t k, char name[40])
{
    const uint32_t n = fast_count(), one = (k - 2u) % n;
    snprintf(name, 40, "%s%s", k < 2 ? k ? "all" : "no" : k < 2 + n ? "without " : "",
             k < 2 ? " accelerators" : fast_name(one));
    return k == 0 ? NULL : k == 1 ? fast_all : k < 2 + n ? fast_without(one) : fast_of(1u << one);
}

static void stress_26_each_accelerator_on_or_off(void **state)
{
    for (size_t s = 0; s < N_SETS; s++) {
        sets[s]();
        struct zs_config core = set.config;
        core.fast = NULL;
        struct picture plain = drawn(&core);
        for (uint32_t k = 1; k < LISTS; k++)
            for (size_t h = 1; h < N_HEIGHTS; h += 2) {
                char name[40];
                struct zs_config c = set.config;
                c.fast = list_of(k, name);
                c.strip_h = heights[h];
                same_with(&plain, &c, name);
                c.max_tris = 9;
                c.max_verts = 12;
                same_with(&plain, &c, name);
            }
        picture_free(&plain);
    }
}

/* ---- Random scenes, each accelerator on or off ----------------------------------------------- */

static uint16_t texels[64 * 32], palette[256];
static int16_t uv[4][SHAPE_VERTS][2];
static struct zs_cluster clusters[4][SHAPE_TRIS];

static const struct zs_texture textures[] = {
    { .format = &zs_texel_565, .texel = texels, .log2_w = 6, .log2_h = 5 },
    { .format = &zs_texel_pal8, .texel = texels, .palette = palette, .n_colors = 256, .log2_w = 5, .log2_h = 6 },
    { .format = &zs_texel_pal4, .texel = texels, .palette = palette, .n_colors = 16, .log2_w = 5, .log2_h = 5 },
    { .format = &zs_texel_565, .texel = texels, .log2_w = 6, .log2_h = 5, .clamp = ZS_CLAMP_U }
};

/* A square that faces +z, of 2 n^2 triangles. */
static void shape_wall(struct shape *s, int32_t half, int32_t n)
{
    const int32_t forward[3] = { 0, 0, 1 };
    shape_begin(s);
    for (int32_t y = 0; y <= n; y++)
        for (int32_t x = 0; x <= n; x++) {
            const int32_t at[3] = { half * (2 * x - n) / n, half * (2 * y - n) / n, 0 };
            (void)shape_vertex(s, at, forward);
        }
    for (int32_t y = 0; y < n; y++)
        for (int32_t x = 0; x < n; x++) {
            const uint32_t a = (uint32_t)(y * (n + 1) + x), b = a + (uint32_t)n + 1u;
            shape_tri(s, a, a + 1u, b);
            shape_tri(s, a + 1u, b + 1u, b);
        }
    shape_end(s);
}

static void shapes_random(struct prng *p)
{
    shape_wall(&set.shape[0], prng_range(p, 500, 20000), prng_range(p, 1, 4));
    shape_sphere(&set.shape[1], (uint32_t)prng_range(p, 6, 12), (uint32_t)prng_range(p, 8, 14), 3000);
    shape_torus(&set.shape[2], (uint32_t)prng_range(p, 8, 20), 10, 4200, 1200);
    shape_soup(&set.shape[3], (uint32_t)prng_range(p, 5, 90), 6000, prng_next(p));
    for (int n = 0; n < 4; n++) {
        struct zs_mesh *mesh = &set.shape[n].mesh;
        const int32_t most = prng_pick(p, 3) ? 200 << prng_pick(p, 6) : 32767;
        for (uint32_t v = 0; v < mesh->n_verts; v++)
            for (int axis = 0; axis < 2; axis++)
                uv[n][v][axis] = (int16_t)prng_range(p, -most, most);
        mesh->uv = (const int16_t (*)[2])uv[n];
        mesh->uv_bits = (uint8_t)prng_range(p, 9, 13);
        if (!prng_pick(p, 4))
            mesh->pos_lo = (const uint8_t (*)[3])set.shape[n].pos_lo;
        mesh->radius = (uint16_t)(mesh->radius + 2u);
        clusters_make(mesh, clusters[n], p, 1 + prng_pick(p, 20), 9);
    }
}

static void random_set(struct prng *p)
{
    static const struct zs_depth *const depths[] = { &zs_depth_recip, &zs_depth_linear, &zs_depth_e3m13,
                                                     &zs_depth_e5m11, &zs_depth_float, &zs_depth_float };
    static const struct zs_shader *const shaders[] = { &zs_shade_raw, &zs_shade_flat, &zs_shade_smooth,
                                                       &zs_shade_texture, &zs_shade_texture_flat,
                                                       &zs_shade_texture_smooth, &own_shader, &glass_shader };
    static const struct zs_depth_state states[] = { { .func = ZS_DEPTH_LESS_EQUAL }, { .read_only = 1, .bias = -20 },
                                                   { .bias = 30, .slope_bias = 200 }, { .func = ZS_DEPTH_ALWAYS } };
    const int orthographic = !prng_pick(p, 5);
    common("random", orthographic ? &zs_depth_linear : depths[prng_pick(p, 6)]);
    set.config.width = (uint16_t)prng_range(p, 130, 300);
    set.config.height = (uint16_t)prng_range(p, 20, 90);
    set.config.strip_h = (uint16_t)prng_range(p, 1, 90);
    set.config.depth_bits = (uint8_t)(prng_pick(p, 2) ? 16 : prng_range(p, 8, 16));
    set.config.subpixel_bits = prng_pick(p, 4) ? 8 : 4;
    for (size_t i = 0; i < sizeof texels / 2; i++)
        texels[i] = (uint16_t)prng_next(p);
    for (int i = 0; i < 256; i++)
        palette[i] = (uint16_t)prng_next(p);
    shapes_random(p);
    if (orthographic)
        (void)zs_camera_orthographic(&set.camera, prng_range(p, 4000, 20000), 100, 40000);
    else
        (void)zs_camera_perspective(&set.camera, (zs_turn)prng_range(p, 4000, 14000), set.config.height,
                                    prng_range(p, 60, 2000), 60000);
    for (int n = 0; n < INSTANCES; n++) {
        const uint32_t of = n ? prng_pick(p, 4) : prng_pick(p, 2); /* a wall comes first in every other */
        const int32_t z = n || of ? prng_range(p, 2000, 30000) : prng_range(p, 300, 5000);
        add(&set.shape[of], shaders[prng_pick(p, 6) ? prng_pick(p, 6) : 6 + prng_pick(p, 2)], prng_range(p, -z, z),
            prng_range(p, -z / 3, z / 3), -z, prng_pick(p, 3));
        if (of == 0 && prng_pick(p, 3)) /* to the eye */
            zs_pose_turn(&set.instance[n].pose, (zs_turn)prng_range(p, -2000, 2000), 0, 0);
        if (!prng_pick(p, 8))
            set.instance[n].depth_state = &states[prng_pick(p, sizeof states / sizeof states[0])];
        set.material[n].texture = &textures[prng_pick(p, 4)];
    }
}

static uint32_t used[FAST_COUNT]; /* of all scenes: fast_used */

static int random_case(uint64_t seed)
{
    struct prng p = { seed };
    random_set(&p);
    struct zs_config core = set.config;
    core.strip_h = core.height;
    core.fast = NULL;
    struct picture plain = drawn(&core);
    int ok = plain.err == ZS_OK;
    for (uint32_t k = 1; k < LISTS && ok; k++) {
        char name[40];
        struct zs_config c = set.config;
        c.fast = list_of(k, name);
        if (k % 3 == seed % 3) {
            c.max_tris = (uint16_t)prng_range(&p, 1, 300);
            c.max_verts = (uint16_t)prng_range(&p, 3, 300);
        }
        struct picture f = drawn(&c);
        ok = picture_same(&plain, &f, name) && stats_add_up(&f.stats);
        picture_free(&f);
    }
    struct zs_config c = set.config;
    c.fast = fast_counting(fast_all);
    struct picture f = drawn(&c);
    ok = ok && picture_same(&plain, &f, "counted");
    for (int k = 0; k < FAST_COUNT; k++)
        used[k] += fast_used[k];
    PICTURES_FREE(&f, &plain);
    return ok ? 1 : case_wrong("random scene");
}

static void stress_26_random_scenes_by_any_accelerators(void **state)
{
    memset(used, 0, sizeof used);
    CASES(random_case, 150);
    for (unsigned k = 0; k < FAST_COUNT; k++)
        print_message("%s: %u\n", fast_name(k), used[k]);
    for (unsigned k = 0; k < FAST_COUNT; k++)
        assert_true(!cases_all() || used[k] > 100);
}

/* ---- What is left out ------------------------------------------------------------------------ */

/* A part of the scene out of view, wholly or partly, in every direction: what is culled was empty, and tests that are
 * left out would have found nothing. So it is where each sphere is said to be so large that nothing can be known by it;
 * an empty mesh that is larger keeps camera units as they are. */
static uint32_t instances_out;

static int frustum_case(uint64_t seed)
{
    struct prng p = { seed };
    common("around the frustum", seed % 2 ? &zs_depth_recip : &zs_depth_linear);
    shape_sphere(&set.shape[0], 4, 6, 2000);
    shape_sphere(&set.shape[1], 3, 5, 7000);
    if (seed % 4 == 0) /* tall, or so flat that the spheres reach beyond the guard band */
        (void)zs_camera_orthographic(&set.camera, seed % 8 ? 8000 : prng_range(&p, 20, 2000), 500,
                                     12000);
    else
        (void)zs_camera_perspective(&set.camera, (zs_turn)(120 << prng_range(&p, 0, 7)), 70, 500,
                                    60000);
    for (int n = 0; n + 1 < INSTANCES; n++)
        add(&set.shape[n % 2], &zs_shade_raw, prng_range(&p, -9000, 9000),
            prng_range(&p, -9000, 9000), prng_range(&p, -16000, 6000), ZS_CULL_NONE);
    shape_begin(&set.shape[2]);
    set.shape[2].mesh.radius = 65535;
    set.shape[2].mesh.scale = 4 * ZS_Q16_ONE;
    add(&set.shape[2], &zs_shade_raw, 0, 0, 0, ZS_CULL_NONE);
    struct zs_config c = set.config;
    struct picture a = drawn(&c);
    set.shape[0].mesh.radius = set.shape[1].mesh.radius = 40000;
    c.fast = NULL;
    struct picture b = drawn(&c);
    int ok = picture_same(&a, &b, "frustum");
    if (b.stats.instances_culled)
        ok = case_wrong("%u culled that nothing is known of", b.stats.instances_culled);
    instances_out += a.stats.instances_culled;
    return freed(&a, &b, ok);
}

/* ---- Memory ---------------------------------------------------------------------------------- */

struct catch {
    uint64_t sum;
};

static int catch_submit(void *ctx, const struct zs_strip *s)
{
    struct catch *c = ctx;
    for (uint32_t i = 0; i < s->n_bytes; i++)
        c->sum = (c->sum ^ s->px[i]) * 1099511628211u;
    for (uint32_t i = 0; i < (uint32_t)s->w * s->h; i++)
        c->sum = (c->sum ^ s->depth[i]) * 1099511628211u;
    return 0;
}

/* Junk in the arena and the renderer, canaries on both sides, three frames one after another. */
static void junk_in_memory(void **state)
{
    for (size_t s = 0; s < N_SETS; s++) {
        uint64_t sums[6];
        for (int n = 0; n < 6; n++) {
            sets[s]();
            struct zs_config c = set.config;
            c.strip_h = 11;
            c.max_tris = 40;
            c.max_verts = 50;
            c.buffers = 2;
            const uint32_t bytes = zs_arena_bytes(&c);
            uint8_t *block = malloc(bytes + 128);
            struct zs_renderer *r = malloc(sizeof *r);
            assert_true(block && r);
            struct prng p = { (uint64_t)n };
            for (uint32_t i = 0; i < bytes + 128; i++)
                block[i] = (uint8_t)(n == 0 ? 0 : n == 1 ? 255 : (int)prng_next(&p));
            memset(r, n * 51, sizeof *r);
            memset(block, 0xc5, 64);
            memset(block + 64 + bytes, 0xc5, 64);
            assert_int_equal(zs_init(r, &c, block + 64, bytes), ZS_OK);
            for (int frame = 0; frame < 3; frame++) {
                struct catch sum = { 14695981039346656037u };
                const struct zs_sink sink = { .submit = catch_submit, .ctx = &sum };
                assert_int_equal(zs_render(r, &set.scene, &set.camera, &sink), ZS_OK);
                if (n == 0 && frame == 0)
                    sums[0] = sum.sum;
                assert_true(sum.sum == sums[0]);
            }
            for (int i = 0; i < 64; i++)
                assert_true(block[i] == 0xc5 && block[64 + bytes + (uint32_t)i] == 0xc5);
            free(block);
            free(r);
        }
    }
}

/* Two renderers, their strips interleaved. */
static void two_renderers_side_by_side(void **state)
{
    lit_set();
    struct zs_config c[2] = { set.config, set.config };
    c[0].strip_h = 7;
    c[1].strip_h = 9;
    c[1].max_tris = 30;
    c[1].max_verts = 40;
    struct picture plain = drawn(&set.config);
    struct zs_renderer r[2];
    void *arena[2];
    for (int k = 0; k < 2; k++) {
        const uint32_t bytes = zs_arena_bytes(&c[k]);
        arena[k] = malloc(bytes);
        assert_int_equal(zs_init(&r[k], &c[k], arena[k], bytes), ZS_OK);
        assert_int_equal(zs_frame_begin(&r[k], &set.scene, &set.camera), ZS_OK);
    }
    int open = 3;
    while (open)
        for (int k = 0; k < 2; k++) {
            struct zs_strip s;
            const int got = open >> k & 1 ? zs_frame_strip(&r[k], &s) : 0;
            if (got == 0) {
                open &= ~(1 << k);
                continue;
            }
            assert_int_equal(got, 1);
            for (int i = 0; i < s.w * s.h; i++) {
                const int at = s.y * s.w + i;
                assert_int_equal(s.px[2 * i] << 8 | s.px[2 * i + 1], plain.color[at]);
                assert_int_equal(s.depth[i], plain.key[at]);
            }
        }
    for (int k = 0; k < 2; k++) {
        assert_int_equal(zs_frame_end(&r[k]), ZS_OK);
        free(arena[k]);
    }
    picture_free(&plain);
}

/* ---- Moves ----------------------------------------------------------------------------------- */

/* Loose triangles, each at its own distance, at least 1.01 buckets from every other; corners in
 * sub-pixels from the frame's middle. */
#define LOOSE 24

struct loose {
    int16_t pos[3 * LOOSE][3];
    uint16_t tri[LOOSE][3];
    uint16_t raw[LOOSE];
    struct zs_rgb rgb[3 * LOOSE];
    zs_q1_15 normal[3 * LOOSE][3];
    struct zs_mesh mesh;
    struct zs_material material;
    struct zs_instance instance;
    struct zs_scene scene;
};

/* layered 0: all at PIXEL_Z, where a world unit is a sub-pixel under perspective too. */
static void loose_set(struct loose *l, uint64_t seed, int32_t reach, int layered)
{
    struct prng p = { seed };
    memset(l, 0, sizeof *l);
    for (int t = 0; t < LOOSE; t++) {
        const int32_t size = reach >> prng_pick(&p, 5);
        const int32_t at[2] = { prng_range(&p, -reach, reach), prng_range(&p, -reach, reach) };
        for (int k = 0; k < 3; k++) {
            int16_t *c = l->pos[3 * t + k];
            for (int a = 0; a < 2; a++)
                c[a] = (int16_t)((at[a] + prng_range(&p, -size, size)) / 2);
            if (prng_pick(&p, 4) == 0)
                c[0] = (int16_t)(c[0] / 256 * 256 + 128); /* on a column of samples */
            c[2] = (int16_t)(layered ? t * 64 : 0); /* tens of buckets each */
            l->tri[t][k] = (uint16_t)(3 * t + k);
            const struct zs_rgb rgb = { (uint8_t)prng_next(&p), (uint8_t)prng_next(&p),
                                        (uint8_t)prng_next(&p) };
            l->rgb[3 * t + k] = rgb;
        }
        l->raw[t] = (uint16_t)(t + 1);
    }
    l->mesh.pos = (const int16_t (*)[3])l->pos;
    l->mesh.tri = (const uint16_t (*)[3])l->tri;
    l->mesh.face_raw = l->raw;
    l->mesh.vertex_rgb = l->rgb;
    l->mesh.normal = (const zs_q1_15 (*)[3])l->normal;
    l->scene.light.ambient = ZS_Q16_ONE;
    l->mesh.n_verts = 3 * LOOSE;
    l->mesh.n_tris = LOOSE;
    l->mesh.scale = ZS_Q16_ONE;
    l->mesh.radius = 57000;
    l->material.shader = &zs_shade_raw;
    l->material.cull = ZS_CULL_NONE;
    l->instance.mesh = &l->mesh;
    l->instance.material = &l->material;
    zs_pose_identity(&l->instance.pose);
    l->instance.pose.pos[2] = -PIXEL_Z;
    l->scene.instance = &l->instance;
    l->scene.n_instances = 1;
}

#define MOVE_W 120
#define MOVE_H 100

static struct picture loose_draw(const struct loose *l, int perspective)
{
    const struct zs_camera camera = pixel_camera(MOVE_H, perspective);
    struct zs_config c = picture_config(MOVE_W, MOVE_H, perspective ? &zs_depth_recip
                                                                    : &zs_depth_linear);
    c.strip_h = 13;
    return picture_draw(&c, &l->scene, &camera);
}

static int turned_case(uint64_t seed)
{
    struct prng p = { seed };
    static struct loose l;
    loose_set(&l, seed, 20000, 1);
    for (int v = 0; v < 3 * LOOSE; v++) /* tilt: planes of keys, not only coverage */
        l.pos[v][2] = (int16_t)prng_range(&p, -3000, 3000);
    struct picture a = loose_draw(&l, seed & 1);
    for (int t = 0; t < LOOSE; t++) {
        const uint16_t first = l.tri[t][0];
        if (prng_pick(&p, 2)) { /* turned on, the same side in front */
            l.tri[t][0] = l.tri[t][1];
            l.tri[t][1] = l.tri[t][2];
            l.tri[t][2] = first;
        } else { /* the other way round: the other side */
            l.tri[t][0] = l.tri[t][1];
            l.tri[t][1] = first;
        }
    }
    struct picture b = loose_draw(&l, seed & 1);
    const int ok = picture_same(&a, &b, "vertices rotated in a triangle");
    return freed(&a, &b, ok);
}

static int mirrored_case(uint64_t seed)
{
    static struct loose l;
    const int perspective = seed & 1, vertical = seed >> 1 & 1;
    loose_set(&l, seed, 20000, !perspective);
    struct picture a = loose_draw(&l, perspective);
    struct oracle_tri o[LOOSE];
    for (int t = 0; t < LOOSE; t++)
        for (int k = 0; k < 3; k++) {
            int16_t *c = l.pos[3 * t + k];
            o[t].x[k] = MOVE_W * 128 + c[0];
            o[t].y[k] = MOVE_H * 128 - c[1];
            c[vertical] = (int16_t)-c[vertical];
        }
    struct picture b = loose_draw(&l, perspective);
    int ok = !a.err && !b.err;
    for (int j = 0; j < MOVE_H && ok; j++)
        for (int i = 0; i < MOVE_W && ok; i++) {
            const int mi = vertical ? i : MOVE_W - 1 - i, mj = vertical ? MOVE_H - 1 - j : j;
            const int at = j * MOVE_W + i, to = mj * MOVE_W + mi;
            if (a.color[at] == b.color[to] && a.key[at] == b.key[to])
                continue;
            int on_edge = 0;
            for (int t = 0; t < LOOSE; t++)
                on_edge |= oracle_on_edge(&o[t], i, j);
            if (!on_edge)
                ok = case_wrong("pixel (%d, %d) is %u, its mirror image %u", i, j, a.color[at],
                                b.color[to]);
        }
    return freed(&a, &b, ok);
}

/* The picture moved by whole pixels, colours and keys. Triangles with width + height <= 256 px keep
 * their planes bit for bit; of larger ones the keys' last rounding may differ, and only coverage is
 * claimed. */
static int moved_case(uint64_t seed)
{
    struct prng p = { seed };
    static struct loose l;
    const int small = seed % 3 != 0;
    const int perspective = !small && seed % 2;
    loose_set(&l, seed, small ? 14000 : 30000, !perspective);
    if (small)
        for (int v = 0; v < 3 * LOOSE; v++)
            l.pos[v][2] = (int16_t)prng_range(&p, -3000, 3000);
    struct picture a = loose_draw(&l, perspective);
    const int dx = prng_range(&p, -30, 30), dy = prng_range(&p, -30, 30);
    l.instance.pose.pos[0] += dx * 256;
    l.instance.pose.pos[1] -= dy * 256;
    struct picture b = loose_draw(&l, perspective);
    int ok = !a.err && !b.err;
    for (int j = 0; j < MOVE_H && ok; j++)
        for (int i = 0; i < MOVE_W && ok; i++) {
            const int ti = i + dx, tj = j + dy;
            if (ti < 0 || ti >= MOVE_W || tj < 0 || tj >= MOVE_H)
                continue;
            const int at = j * MOVE_W + i, to = tj * MOVE_W + ti;
            if (a.color[at] != b.color[to] || a.key[at] != b.key[to])
                ok = case_wrong("pixel (%d, %d) is %u %u, moved by (%d, %d) %u %u", i, j,
                                a.color[at], a.key[at], dx, dy, b.color[to], b.key[to]);
        }
    return freed(&a, &b, ok);
}

static int order_case(uint64_t seed)
{
    struct prng p = { seed };
    static struct loose l;
    loose_set(&l, seed, 30000, 1);
    if (seed & 2) { /* layers thick enough for colours to take sub-spans, and still apart */
        l.material.shader = &zs_shade_smooth;
        for (int v = 0; v < 3 * LOOSE; v++)
            l.pos[v][2] = (int16_t)((v / 3 - LOOSE / 2) * 600 + prng_range(&p, 0, 560));
    }
    struct picture a = loose_draw(&l, seed & 1);
    for (uint32_t t = LOOSE - 1; t > 0; t--) { /* any order */
        const uint32_t u = prng_pick(&p, t + 1);
        uint16_t keep[3];
        memcpy(keep, l.tri[t], sizeof keep);
        memcpy(l.tri[t], l.tri[u], sizeof keep);
        memcpy(l.tri[u], keep, sizeof keep);
        const uint16_t raw = l.raw[t];
        l.raw[t] = l.raw[u];
        l.raw[u] = raw;
    }
    struct picture b = loose_draw(&l, seed & 1);
    const int ok = picture_same(&a, &b, "another scene order");
    return freed(&a, &b, ok);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(stress_21_any_strip_height),
    cmocka_unit_test(any_pool_down_to_one_triangle),
    cmocka_unit_test(stress_26_each_accelerator_on_or_off),
    cmocka_unit_test(stress_26_random_scenes_by_any_accelerators),
    CASES_COUNT(culled_instances_were_empty, frustum_case, 600, &instances_out, 600, "instances culled"),
    cmocka_unit_test(junk_in_memory),
    cmocka_unit_test(two_renderers_side_by_side),
    CASES_TEST(stress_22_vertices_rotated_in_a_triangle, turned_case, 100),
    CASES_TEST(stress_23_mirrored_scene, mirrored_case, 200),
    CASES_TEST(stress_24_moved_by_whole_pixels, moved_case, 150),
    CASES_TEST(stress_25_opaque_order_permuted, order_case, 100)
};

CASES_MAIN(tests)
