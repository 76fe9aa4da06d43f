/* The public interface: every error by its name, buffers one element short, and garbage. Calls out of order and sinks
 * that fail: tests/unit/test_frame.c.
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdlib.h>
#include <string.h>

#include "cases.h"
#include "fast_lists.h"
#include "good.h"
#include "picture.h"
#include "internals.h"
#include "shapes.h"

/* ---- A small scene with one thing wrong ------------------------------------------------------ */

/* What a frame of a changed scene is answered with; zs_render must agree, and submit nothing. */
static int answer(const struct good *g)
{
    struct zs_scene scene = g->scene;
    struct zs_instance in = g->instance;
    in.material = g->instance.material ? &g->material : NULL;
    if (scene.n_instances == 1 && scene.instance)
        scene.instance = &in;
    struct picture p = picture_draw(&g->config, &scene, &g->camera);
    if (p.err)
        assert_int_equal(p.covered, 0);
    picture_free(&p);
    return p.err;
}

/* ---- Set-up ---------------------------------------------------------------------------------- */

static void strerror_has_a_text_for_each(void **state)
{
    for (int err = ZS_ERR_PASS; err <= 0; err++)
        for (int other = ZS_ERR_PASS; other < err; other++)
            assert_string_not_equal(zs_error_string(err), zs_error_string(other));
    assert_string_equal(zs_error_string(ZS_ERR_PASS - 1), zs_error_string(INT32_MIN));
    assert_string_not_equal(zs_error_string(1), zs_error_string(ZS_OK)); /* of a sink */
    assert_string_not_equal(zs_error_string(INT32_MAX), zs_error_string(ZS_OK));
    assert_string_not_equal(zs_error_string(-100), zs_error_string(ZS_OK));
}

static int init_with(struct zs_config c)
{
    static uint32_t arena[200000];
    struct zs_renderer r;
    return zs_init(&r, &c, arena, sizeof arena);
}

static void init_refuses_by_name(void **state)
{
    const struct zs_config ok = good_scene().config;
    struct zs_renderer r;
    static uint32_t arena[200000];
    assert_int_equal(zs_init(NULL, &ok, arena, sizeof arena), ZS_ERR_NULL);
    assert_int_equal(zs_init(&r, NULL, arena, sizeof arena), ZS_ERR_NULL);
    assert_int_equal(zs_init(&r, &ok, NULL, sizeof arena), ZS_ERR_NULL);
    assert_int_equal(init_with(ok), ZS_OK);
#define REFUSED(field, value, err) \
    do { \
        struct zs_config c = ok; \
        c.field = (value); \
        assert_int_equal(init_with(c), err); \
        if (err == ZS_ERR_SIZE) \
            assert_int_equal(zs_arena_bytes(&c), 0); \
    } while (0)
    REFUSED(depth, NULL, ZS_ERR_NULL);
    REFUSED(width, 0, ZS_ERR_SIZE);
    REFUSED(width, ZS_SIZE_MAX + 1, ZS_ERR_SIZE);
    REFUSED(width, 65535, ZS_ERR_SIZE);
    REFUSED(height, 0, ZS_ERR_SIZE);
    REFUSED(height, ZS_SIZE_MAX + 1, ZS_ERR_SIZE);
    REFUSED(strip_h, 0, ZS_ERR_SIZE);
    REFUSED(strip_h, 65535, ZS_OK);
    REFUSED(max_tris, 0, ZS_ERR_SIZE);
    REFUSED(max_tris, ZS_POOL_MAX + 1, ZS_ERR_SIZE);
    REFUSED(max_verts, 0, ZS_ERR_SIZE);
    REFUSED(max_verts, 2, ZS_ERR_SIZE);
    REFUSED(max_verts, 3, ZS_OK);
    REFUSED(max_verts, ZS_POOL_MAX + 1, ZS_ERR_SIZE);
    REFUSED(varyings, ZS_VARYINGS_MAX + 1, ZS_ERR_SIZE);
    REFUSED(buffers, 0, ZS_OK); /* 1 */
    REFUSED(buffers, 3, ZS_ERR_SIZE);
    REFUSED(subpixel_bits, 0, ZS_OK); /* 8 */
    REFUSED(subpixel_bits, 5, ZS_ERR_SIZE);
    REFUSED(subpixel_bits, 4, ZS_OK);
    REFUSED(depth_bits, 0, ZS_OK); /* 16 */
    REFUSED(depth_bits, 1, ZS_ERR_DEPTH);
    REFUSED(depth_bits, 7, ZS_ERR_DEPTH);
    REFUSED(depth_bits, 17, ZS_ERR_DEPTH);
    REFUSED(depth_bits, 8, ZS_OK);
#undef REFUSED
    assert_int_equal(zs_arena_bytes(NULL), 0);
}

static void stress_30_every_buffer_one_element_short(void **state)
{
    const struct good g = good_scene();
    const uint32_t bytes = zs_arena_bytes(&g.config);
    uint8_t *block = malloc(bytes + 8);
    struct zs_renderer r;
    /* the arena: a byte short, one to three bytes off; its contents stay */
    memset(block, 0x77, bytes + 8);
    assert_int_equal(zs_init(&r, &g.config, block, bytes - 1), ZS_ERR_ARENA);
    assert_int_equal(zs_init(&r, &g.config, block, 0), ZS_ERR_ARENA);
    for (uint32_t off = 1; off < 4; off++)
        assert_int_equal(zs_init(&r, &g.config, block + off, bytes), ZS_ERR_ARENA);
    for (uint32_t i = 0; i < bytes + 8; i++)
        assert_int_equal(block[i], 0x77);
    assert_int_equal(zs_init(&r, &g.config, block + 4, bytes), ZS_OK);
    free(block);

    /* pools: for the number that the scene needs, one less gives the same frame in more passes */
    struct zs_config c = g.config;
    c.strip_h = 5;
    struct picture plain = picture_draw(&c, &g.scene, &g.camera);
    c.max_tris = (uint16_t)plain.stats.max_tris_used;
    c.max_verts = (uint16_t)plain.stats.max_verts_used;
    struct picture same = picture_draw(&c, &g.scene, &g.camera);
    assert_true(picture_same(&plain, &same, "pools that just fit"));
    assert_int_equal(same.stats.passes, 1);
    picture_free(&same);
    for (int k = 0; k < 2; k++) {
        struct zs_config less = c;
        less.max_tris = (uint16_t)(less.max_tris - (k == 0));
        less.max_verts = (uint16_t)(less.max_verts - (k == 1));
        same = picture_draw(&less, &g.scene, &g.camera);
        assert_true(picture_same(&plain, &same, "a pool one short"));
        assert_true(same.stats.passes > 1);
        assert_true(zs_arena_bytes(&less) < zs_arena_bytes(&c));
        picture_free(&same);
    }
    picture_free(&plain);

    /* attributes: one word short of what the shader needs */
    struct good smooth = good_scene();
    smooth.material.shader = &zs_shade_smooth;
    assert_int_equal(answer(&smooth), ZS_OK);
    smooth.config.varyings = ZS_VARYINGS_SMOOTH - 1;
    assert_int_equal(answer(&smooth), ZS_ERR_VARYINGS);

    /* the mesh: one vertex short, so that some triangles name one that is not there */
    struct good mesh = good_scene();
    struct zs_mesh shorter = *mesh.instance.mesh;
    shorter.n_verts--;
    mesh.instance.mesh = &shorter;
    struct zs_scene scene = mesh.scene;
    scene.instance = &mesh.instance;
    struct picture p = picture_draw(&mesh.config, &scene, &mesh.camera);
    assert_int_equal(p.err, ZS_OK);
    assert_true(p.stats.tris_index > 0 && p.stats.tris_drawn > 0 && stats_add_up(&p.stats));
    picture_free(&p);
}

/* ---- The arena ------------------------------------------------------------------------------- */

static uint32_t bytes_by_hand(const struct zs_config *c)
{
    const uint32_t rows = c->strip_h < c->height ? c->strip_h : c->height;
    const uint32_t strips = (c->height + rows - 1u) / rows;
    uint32_t pools[8] = { c->width * rows * 2u, c->buffers == 2 ? c->width * rows * 2u : 0u,
                          c->width * rows * 2u, strips * 2u, c->max_tris * 12u, c->max_verts * 12u,
                          c->max_verts * 2u, (uint32_t)c->max_verts * c->varyings * 2u };
    uint32_t sum = (c->max_verts * 2u + 3u) / 4u * 4u; /* vert_map, the ninth */
    sum += ((c->width + 31u) / 32u * strips * 2u + 3u) / 4u * 4u; /* bounds of tiles, the tenth */
    sum += rows * 4u;                                             /* columns drawn, the eleventh */
    for (int k = 0; k < 8; k++)
        sum += (pools[k] + 3u) / 4u * 4u;
    return sum;
}

static int arena_case(uint64_t seed)
{
    struct prng p = { seed };
    const struct zs_config c = {
        .width = (uint16_t)prng_range(&p, 1, 300), .height = (uint16_t)prng_range(&p, 1, 300),
        .strip_h = (uint16_t)prng_range(&p, 1, 400), .max_tris = (uint16_t)prng_range(&p, 1, 999),
        .max_verts = (uint16_t)prng_range(&p, 3, 999), .varyings = (uint8_t)prng_range(&p, 0, ZS_VARYINGS_MAX),
        .buffers = (uint8_t)prng_range(&p, 1, 2), .subpixel_bits = 8, .depth_bits = 16, .depth = &zs_depth_recip
    };
    const uint32_t rows = c.strip_h < c.height ? c.strip_h : c.height;
    const uint32_t bytes = zs_arena_bytes(&c);
    CASE_CHECK(bytes == bytes_by_hand(&c));
    CASE_CHECK(bytes == ZS_ARENA_BYTES(c.width, c.height, rows, c.max_tris, c.max_verts, c.varyings,
                                       c.buffers));
    uint8_t *arena = malloc(bytes);
    struct zs_renderer r;
    CASE_CHECK(zs_init(&r, &c, arena, bytes) == ZS_OK);
    /* the pools lie in it one after another, each aligned, the last one ends with it */
    const uint32_t strip = c.width * rows * 2u;
    const struct {
        const void *at;
        uint32_t bytes;
    } pool[] = { { r.color[0], strip },
                  { r.color[1], strip },
                  { r.depth, strip },
                  { r.drawn, 4u * rows },
                  { r.bound, ZS_BOUND_BYTES(c.width, c.height, rows) },
                  { r.bin, 2u * r.n_strips },
                  { r.tri, 12u * c.max_tris },
                  { r.vert, 12u * c.max_verts },
                  { r.vert_src, 2u * c.max_verts },
                  { r.vert_map, 2u * c.max_verts },
                  { r.attr, 2u * c.max_verts * c.varyings } };
    const uint8_t *end = arena;
    for (size_t k = 0; k < sizeof pool / sizeof pool[0]; k++) {
        const uint8_t *at = pool[k].at;
        if (k == 1 && c.buffers == 1) {
            CASE_CHECK(pool[1].at == pool[0].at);
            continue;
        }
        CASE_CHECK(at == end && ((uintptr_t)at & 3u) == 0);
        end = at + (pool[k].bytes + 3u) / 4u * 4u;
    }
    CASE_CHECK(end == arena + bytes);
    free(arena);
    return 1;
}

ZS_ARENA(static_arena, ZS_ARENA_BYTES(64, 48, 16, 100, 80, 3, 2));

static void arena_macro_function_and_layout_agree(void **state)
{
    CASES(arena_case, 3000);
    const struct zs_config c = {
        .width = 64, .height = 48, .strip_h = 16, .max_tris = 100, .max_verts = 80, .varyings = 3, .buffers = 2,
        .subpixel_bits = 8, .depth_bits = 16, .depth = &zs_depth_recip
    };
    struct zs_renderer r;
    assert_int_equal(sizeof static_arena, zs_arena_bytes(&c));
    assert_int_equal((uintptr_t)static_arena & 31u, 0);
    assert_int_equal(zs_init(&r, &c, static_arena, sizeof static_arena), ZS_OK);
    const struct zs_config most = { .width = ZS_SIZE_MAX, .height = ZS_SIZE_MAX, .strip_h = ZS_SIZE_MAX,
                                    .max_tris = ZS_POOL_MAX, .max_verts = ZS_POOL_MAX, .varyings = ZS_VARYINGS_MAX,
                                    .buffers = 2, .subpixel_bits = 8, .depth_bits = 16, .depth = &zs_depth_recip };
    assert_int_equal(zs_arena_bytes(&most), bytes_by_hand(&most)); /* no wrap at the largest */
    assert_true(zs_arena_bytes(&most) > 3u * ZS_SIZE_MAX * ZS_SIZE_MAX * 2u);
}

/* ---- Frames ---------------------------------------------------------------------------------- */

static void frames_refused_by_name(void **state)
{
    assert_int_equal(({ const struct good g = good_scene(); answer(&g); }), ZS_OK);
#define REFUSED(change, err) \
    do { \
        struct good g = good_scene(); \
        struct zs_mesh mesh = *g.instance.mesh; \
        g.instance.mesh = &mesh; \
        change; \
        assert_int_equal(answer(&g), err); \
    } while (0)
    REFUSED(g.scene.n_instances = 65536, ZS_ERR_SIZE);
    REFUSED(g.scene.instance = NULL, ZS_ERR_NULL);
    REFUSED(g.instance.mesh = NULL, ZS_ERR_NULL);
    REFUSED(g.instance.material = NULL, ZS_ERR_NULL);
    REFUSED(g.material.shader = NULL, ZS_ERR_NULL);

    REFUSED(mesh.pos = NULL, ZS_ERR_MESH);
    REFUSED(mesh.tri = NULL, ZS_ERR_MESH);
    REFUSED(mesh.n_verts = 65536, ZS_ERR_MESH);
    REFUSED(mesh.scale = 0, ZS_OK); /* one world unit a step */
    REFUSED(g.material.cull = 3, ZS_ERR_MESH);
    REFUSED((g.material.shader = &zs_shade_smooth, mesh.normal = NULL), ZS_ERR_MESH);
    REFUSED((mesh.n_verts = mesh.n_tris = 0, mesh.pos = NULL, mesh.tri = NULL), ZS_OK);

    REFUSED(g.instance.pose.pos[0] = ZS_WORLD_MAX + 1, ZS_ERR_RANGE);
    REFUSED(g.instance.pose.pos[1] = INT32_MIN, ZS_ERR_RANGE);
    REFUSED(g.instance.pose.scale = 0, ZS_OK); /* 1 */
    REFUSED((g.instance.pose.scale = 0, mesh.scale = (1u << 31) + 1u, mesh.radius = 0, mesh.n_verts = mesh.n_tris = 0),
            ZS_ERR_RANGE); /* 1, not 0 */
    REFUSED((g.instance.pose.scale = UINT32_MAX, mesh.scale = UINT32_MAX), ZS_ERR_RANGE);
    /* the largest scale, 2^15 units a step, and one more; without vertices and extent, so that nothing else refuses
     * it */
    REFUSED((mesh.scale = 1u << 31, g.instance.pose.scale = 65536, mesh.radius = 0, mesh.n_verts = mesh.n_tris = 0),
            ZS_OK);
    REFUSED((mesh.scale = (1u << 31) + 1u, g.instance.pose.scale = 65536, mesh.radius = 0,
             mesh.n_verts = mesh.n_tris = 0), ZS_ERR_RANGE);
    REFUSED(g.instance.pose.rot[0] = ZS_Q30_ONE / 2, ZS_ERR_RANGE);
    REFUSED(g.instance.pose.rot[4] = INT32_MIN, ZS_ERR_RANGE);
    REFUSED(g.instance.pose.rot[8] = -ZS_Q30_ONE, ZS_ERR_RANGE); /* a mirror */
    REFUSED(memset(g.instance.pose.rot, 0, sizeof g.instance.pose.rot), ZS_OK); /* none */
    REFUSED(memset(g.instance.pose.rot, 0, 3 * sizeof g.instance.pose.rot[0]), ZS_ERR_RANGE);
    REFUSED(g.scene.light.ambient = ZS_Q16_ONE + 1, ZS_ERR_RANGE);
    REFUSED(g.scene.light.diffuse = UINT32_MAX, ZS_ERR_RANGE);
    REFUSED(g.scene.light.dir[0] = INT32_MIN, ZS_ERR_RANGE);
    REFUSED(g.camera.z_near = 1, ZS_ERR_NEAR); /* 2^-16 with things 10^4 away */

    REFUSED(g.camera.z_near = 0, ZS_ERR_CAMERA);
    REFUSED(g.camera.z_near = -65536, ZS_ERR_CAMERA);
    REFUSED(g.camera.z_near = INT64_MIN, ZS_ERR_CAMERA);
    REFUSED(g.camera.z_near = INT64_MAX, ZS_ERR_CAMERA);
    REFUSED(g.camera.z_near = g.camera.z_far, ZS_ERR_CAMERA);
    REFUSED(g.camera.z_near = g.camera.z_far - 1, ZS_ERR_CAMERA);
    REFUSED(g.camera.z_far = (zs_q48_16)ZS_FAR_MAX * 65536, ZS_OK);
    REFUSED(g.camera.z_far = (zs_q48_16)ZS_FAR_MAX * 65536 + 1, ZS_ERR_CAMERA);
    REFUSED((g.camera.projection = ZS_ORTHOGRAPHIC, g.camera.height = 65536,
             g.config.depth = &zs_depth_linear,
             g.camera.z_near = -(zs_q48_16)ZS_WORLD_MAX * 65536 - 1), ZS_ERR_CAMERA);
    REFUSED(g.camera.z_far = INT64_MAX, ZS_ERR_CAMERA);
    REFUSED(g.camera.focal = 0, ZS_ERR_CAMERA);
    REFUSED(g.camera.focal = UINT64_MAX, ZS_ERR_CAMERA);
    REFUSED(g.camera.projection = 2, ZS_ERR_CAMERA);
    REFUSED(g.camera.rot[0] = 0, ZS_ERR_CAMERA);
    REFUSED(memset(g.camera.rot, 0, sizeof g.camera.rot), ZS_OK); /* none */
    REFUSED(memset(g.camera.rot, 0, 8 * sizeof g.camera.rot[0]), ZS_ERR_CAMERA);
    REFUSED(g.camera.rot[8] = -ZS_Q30_ONE, ZS_ERR_CAMERA);
    REFUSED(g.camera.pos[2] = -ZS_WORLD_MAX - 1, ZS_ERR_RANGE);
    REFUSED((g.camera.projection = ZS_ORTHOGRAPHIC, g.camera.height = 65536), ZS_ERR_DEPTH);
    REFUSED((g.camera.projection = ZS_ORTHOGRAPHIC, g.camera.height = 0,
             g.config.depth = &zs_depth_linear), ZS_ERR_CAMERA);
    REFUSED((g.camera.projection = ZS_ORTHOGRAPHIC, g.camera.height = INT64_MAX,
             g.config.depth = &zs_depth_linear), ZS_ERR_CAMERA);
#undef REFUSED
}

static void an_empty_scene_is_background(void **state)
{
    struct good g = good_scene();
    g.scene.n_instances = 0;
    g.scene.instance = NULL;
    g.scene.background = 0xbeef;
    struct picture p = picture_draw(&g.config, &g.scene, &g.camera);
    assert_int_equal(p.err, ZS_OK);
    for (int i = 0; i < p.w * p.h; i++)
        assert_true(p.color[i] == 0xbeef && p.key[i] == ZS_DEPTH_CLEAR);
    assert_int_equal(p.stats.tris_in, 0);
    assert_int_equal(p.stats.strips, 5);
    picture_free(&p);
}

static void bad_indices_are_not_drawn_and_counted(void **state)
{
    struct good g = good_scene();
    static struct shape s;
    shape_sphere(&s, 6, 8, 3000);
    for (uint32_t t = 0; t < s.mesh.n_tris; t += 3)
        s.tri[t][t / 3 % 3] = (uint16_t)(t % 2 ? 65535u : s.mesh.n_verts);
    g.instance.mesh = &s.mesh;
    g.scene.instance = &g.instance;
    struct picture p = picture_draw(&g.config, &g.scene, &g.camera);
    assert_int_equal(p.err, ZS_OK);
    assert_int_equal(p.stats.tris_index, (s.mesh.n_tris + 2) / 3);
    assert_true(stats_add_up(&p.stats) && p.covered > 0);
    /* the same as without those triangles */
    uint32_t n = 0;
    for (uint32_t t = 0; t < s.mesh.n_tris; t++)
        if (t % 3) {
            memcpy(s.tri[n], s.tri[t], sizeof s.tri[n]);
            s.face_rgb[n++] = s.face_rgb[t];
        }
    s.mesh.n_tris = n;
    struct picture q = picture_draw(&g.config, &g.scene, &g.camera);
    assert_true(picture_same(&p, &q, "without the bad triangles"));
    PICTURES_FREE(&p, &q);
}

/* Counter-clockwise on the screen is the front, whole or cut at near. */
static void faces_are_culled_by_their_turn(void **state)
{
    static const int16_t pos[2][3][3] = {
        { { -9000, -9000, 0 }, { 9000, -9000, 0 }, { 0, 9000, 0 } },
        { { -9000, -9000, 0 },
          { 9000, -9000, 0 },
          { 0, 9000, 30000 } } /* its top is behind the eye */
    };
    for (int cut = 0; cut < 2; cut++)
        for (int turned = 0; turned < 2; turned++)
            for (uint8_t cull = ZS_CULL_BACK; cull <= ZS_CULL_NONE; cull++)
                for (int perspective = 0; perspective < 2; perspective++) {
                    struct lone l;
                    lone_set(&l, pos[cut], 3, ZS_Q16_ONE);
                    l.tri[0][1] = turned ? 2 : 1; /* clockwise */
                    l.tri[0][2] = turned ? 1 : 2;
                    l.material.cull = cull;
                    l.instance.pose.pos[2] = -20000;
                    struct zs_camera camera = pixel_camera(40, perspective);
                    camera.z_near = 5000 * 65536;
                    const struct zs_config config = lone_config(40, 40, &zs_depth_linear);
                    struct picture p = picture_draw(&config, &l.scene, &camera);
                    const int seen = cull == ZS_CULL_NONE || turned == (cull == ZS_CULL_FRONT);
                    assert_int_equal(p.err, ZS_OK);
                    assert_int_equal(p.stats.tris_clipped, cut);
                    assert_int_equal(p.stats.tris_drawn, seen);
                    assert_int_equal(p.stats.tris_facing, !seen);
                    assert_int_equal(p.covered > 0, seen);
                    picture_free(&p);
                }
}

/* 65535 vertices, all indices used; vertex 65534 is the last one, 65535 never one. */
static void the_largest_mesh(void **state)
{
    static int16_t pos[65535][3];
    static uint16_t tri[21846][3];
    for (uint32_t v = 0; v < 65535; v++) {
        pos[v][0] = (int16_t)((v * 2654435761u >> 16) % 6000u - 3000);
        pos[v][1] = (int16_t)((v * 40503u >> 3) % 6000u - 3000);
        pos[v][2] = (int16_t)(v % 1000u);
    }
    for (uint32_t t = 0; t < 21846; t++)
        for (uint32_t k = 0; k < 3; k++)
            tri[t][k] = (uint16_t)(3 * t + k); /* the last one names 65535, 0, 1 */
    struct good g = good_scene();
    struct zs_mesh mesh = *g.instance.mesh;
    mesh.pos = (const int16_t (*)[3])pos;
    mesh.tri = (const uint16_t (*)[3])tri;
    mesh.normal = NULL;
    mesh.vertex_rgb = NULL;
    mesh.face_rgb = NULL;
    mesh.face_raw = NULL;
    mesh.n_verts = 65535;
    mesh.n_tris = 21846;
    mesh.radius = 9000;
    g.instance.mesh = &mesh;
    g.scene.instance = &g.instance;
    struct picture p[2];
    for (int k = 0; k < 2; k++) {
        g.config.max_tris = g.config.max_verts = k ? 500 : 65534;
        p[k] = picture_draw(&g.config, &g.scene, &g.camera);
        assert_int_equal(p[k].err, ZS_OK);
        assert_int_equal(p[k].stats.tris_index, 1);
        assert_true(stats_add_up(&p[k].stats));
    }
    assert_true(picture_same(&p[0], &p[1], "pools of 500 and of 65534"));
    PICTURES_FREE(&p[0], &p[1]);
}

/* ---- Garbage --------------------------------------------------------------------------------- */

static void spoil(struct prng *p, void *at, size_t n)
{
    uint8_t *b = at;
    switch (prng_pick(p, 4)) {
    case 0: /* a bit */
        b[prng_pick(p, (uint32_t)n)] ^= (uint8_t)(1u << prng_pick(p, 8));
        break;
    case 1: /* a byte */
        b[prng_pick(p, (uint32_t)n)] = (uint8_t)prng_next(p);
        break;
    case 2: /* a word at an end of its range */
        if (n >= 8) {
            const int64_t ends[] = { INT64_MIN, INT64_MAX, INT32_MIN, INT32_MAX, 0, -1 };
            const int64_t v = ends[prng_pick(p, 6)];
            const size_t size = prng_pick(p, 2) ? 8 : 4;
            memcpy(b + prng_pick(p, (uint32_t)(n / size)) * size, &v, size);
        }
        break;
    default: /* all of it */
        for (size_t i = 0; i < n; i++)
            b[i] = (uint8_t)prng_next(p);
        break;
    }
}

static uint32_t garbage_drawn, garbage_refused;

static int known_error(int err)
{
    return err <= 0 && err >= ZS_ERR_NEAR;
}

static int garbage_case(uint64_t seed)
{
    static struct lone l;
    struct prng p = { seed };
    int16_t pos[9][3];
    for (int k = 0; k < 27; k++)
        pos[k / 3][k % 3] = (int16_t)(prng_next(&p) >> 48) >> prng_pick(&p, 8);
    lone_set(&l, (const int16_t (*)[3])pos, 9, ZS_Q16_ONE);
    l.instance.pose.pos[2] = -prng_range(&p, 0, 30000);
    l.scene.light.dir[1] = ZS_Q30_ONE;
    struct zs_config config = lone_config(prng_range(&p, 1, 30), prng_range(&p, 1, 30),
                                          prng_pick(&p, 2) ? &zs_depth_recip : &zs_depth_linear);
    struct zs_camera camera;
    if (prng_pick(&p, 4))
        (void)zs_camera_perspective(&camera, (zs_turn)prng_range(&p, 1, 32767), config.height,
                                    prng_range(&p, 1, 5000), prng_range(&p, 5001, 1 << 20));
    else
        (void)zs_camera_orthographic(&camera, prng_range(&p, 1, 100000), prng_range(&p, -50000, 0),
                                     prng_range(&p, 1, 50000));
    /* Garbage in everything but pointers, counts that give the length of arrays, and the sphere. */
    const uint32_t where = prng_pick(&p, 8);
    if (where == 0)
        spoil(&p, &config, offsetof(struct zs_config, depth));
    if (where == 1 || where == 5)
        spoil(&p, &camera, sizeof camera);
    if (where == 2 || where == 5)
        spoil(&p, &l.instance.pose, sizeof l.instance.pose);
    if (where == 3)
        spoil(&p, &l.scene.light, sizeof l.scene.light);
    if (where == 4)
        spoil(&p, l.tri, sizeof l.tri);
    if (where == 6)
        l.mesh.scale = (zs_uq16_16)prng_next(&p);
    config.width = config.width > 60 ? (uint16_t)(config.width % 60) : config.width;
    config.height = config.height > 60 ? (uint16_t)(config.height % 60) : config.height;
    config.max_tris %= 500;
    config.max_verts %= 500;
    static const struct zs_shader *const shaders[] = { &zs_shade_raw, &zs_shade_flat,
                                                       &zs_shade_smooth };
    static const zs_q1_15 normals[9][3] = { { 0, 0, 32767 }, { -32768, -32768, -32768 },
                                            { 32767, 32767, 32767 } };
    l.mesh.normal = normals;
    l.material.shader = shaders[prng_pick(&p, 3)];
    struct picture f = picture_draw(&config, &l.scene, &camera);
    const int ok = known_error(f.err) && (f.err || stats_add_up(&f.stats));
    garbage_drawn += !f.err && f.covered > 0;
    garbage_refused += f.err != 0;
    if (!ok)
        (void)case_wrong("error %d", f.err);
    picture_free(&f);
    return ok;
}

/* A sphere that does not hold its mesh loses parts, as the header says; nothing worse. */
static int sphere_case(uint64_t seed)
{
    static struct lone l;
    struct prng p = { seed };
    int16_t pos[9][3];
    for (int k = 0; k < 27; k++)
        pos[k / 3][k % 3] = (int16_t)(prng_next(&p) >> 48);
    const int32_t power = prng_pick(&p, 3) ? prng_range(&p, 0, 12) : 0;
    lone_set(&l, (const int16_t (*)[3])pos, 9, ZS_Q16_ONE << power);
    l.mesh.radius = (uint16_t)(prng_pick(&p, 3) ? prng_pick(&p, 100) : prng_next(&p));
    for (int k = 0; k < 3; k++)
        l.mesh.center[k] = (int16_t)(prng_pick(&p, 3) ? 0 : prng_next(&p) >> 48);
    l.instance.pose.pos[2] = -prng_range(&p, 1, 40000);
    static const zs_q1_15 normals[9][3] = { { 0, 0, 32767 } };
    l.mesh.normal = normals;
    l.material.shader = seed % 2 ? &zs_shade_smooth : &zs_shade_raw;
    struct zs_camera camera;
    if (prng_pick(&p, 3))
        (void)zs_camera_perspective(&camera, (zs_turn)prng_range(&p, 1, 32767), 20,
                                    prng_range(&p, 1, 900), prng_range(&p, 1000, 100000));
    else
        (void)zs_camera_orthographic(&camera, prng_range(&p, 1, 100000), prng_range(&p, -50000, 0),
                                     prng_range(&p, 1, 50000));
    const int linear = camera.projection == ZS_ORTHOGRAPHIC || prng_pick(&p, 2);
    struct zs_config config = lone_config(25, 20, linear ? &zs_depth_linear : &zs_depth_recip);
    config.fast = fast_any(&p);
    struct picture f = picture_draw(&config, &l.scene, &camera);
    const int ok = known_error(f.err);
    picture_free(&f);
    return ok ? 1 : case_wrong("error %d", f.err);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(strerror_has_a_text_for_each),
    cmocka_unit_test(init_refuses_by_name),
    cmocka_unit_test(stress_30_every_buffer_one_element_short),
    cmocka_unit_test(arena_macro_function_and_layout_agree),
    cmocka_unit_test(frames_refused_by_name),
    cmocka_unit_test(an_empty_scene_is_background),
    cmocka_unit_test(bad_indices_are_not_drawn_and_counted),
    cmocka_unit_test(faces_are_culled_by_their_turn),
    cmocka_unit_test(the_largest_mesh),
    CASES_COUNTS(garbage_gets_a_defined_answer, garbage_case, 100000,
                 { "frames with pixels", &garbage_drawn, 20000 },
                 { "refused by name", &garbage_refused, 40000 }),
    CASES_TEST(a_wrong_sphere_loses_parts_at_worst, sphere_case, 20000)
};

CASES_MAIN(tests)
