/* Shadows on planes: vertices against doubles, every pixel darkened once, none left out; discs; what is refused.
 *
 * SPDX-License-Identifier: MIT
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cases.h"
#include "fast_lists.h"
#include "picture.h"
#include "zs_check.h"
#include "zs_method.h"
#include "zs_shadow.h"

#define VERTS 60
#define TRIS 80

/* ---- Random things, planes and lights ---------------------------------------------------------- */

struct thing {
    struct zs_mesh mesh;
    struct zs_instance instance;
    struct zs_shadow_plane plane;
    struct zs_shadow_light light;
    struct zs_pose ground; /* whose +y side is the plane's front */
    int16_t pos[VERTS][3];
    uint8_t lo[VERTS][3];
    uint16_t tri[TRIS][3];
};

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void spread(struct prng *p, int32_t out[3], int32_t most)
{
    for (int k = 0; k < 3; k++)
        out[k] = prng_range(p, -most, most);
}

/* A vertex in world units. */
static void place(const struct thing *t, uint32_t v, double out[3])
{
    const struct zs_pose *pose = &t->instance.pose;
    const double scale = (t->mesh.scale ? t->mesh.scale / 65536.0 : 1) * (pose->scale ? pose->scale / 65536.0 : 1);
    double at[3];
    for (int k = 0; k < 3; k++)
        at[k] = (t->pos[v][k] + (t->mesh.pos_lo ? t->lo[v][k] / 256.0 : 0)) * scale;
    for (int k = 0; k < 3; k++)
        out[k] = pose->pos[k] +
                 (pose->rot[3 * k] * at[0] + pose->rot[3 * k + 1] * at[1] + pose->rot[3 * k + 2] * at[2]) / ZS_Q30_ONE;
}

/* Triangles within 100 steps, above a plane, under a light that is above them. */
static void thing_make(struct thing *t, struct prng *p, int level)
{
    static const struct thing none;
    *t = none;
    const int32_t extent = prng_pick(p, 3) ? 100 : 30000;
    t->mesh = (struct zs_mesh){
        .pos = (const int16_t(*)[3])t->pos, .tri = (const uint16_t(*)[3])t->tri, .n_verts = VERTS, .n_tris = TRIS
    };
    for (int k = 0; k < 3; k++)
        t->mesh.center[k] = (int16_t)prng_range(p, -extent / 50, extent / 50);
    for (uint32_t v = 0; v < VERTS; v++)
        for (int k = 0; k < 3; k++) {
            t->pos[v][k] = (int16_t)(t->mesh.center[k] + prng_range(p, -extent / 2, extent / 2));
            t->lo[v][k] = (uint8_t)prng_next(p);
        }
    for (uint32_t k = 0; k < TRIS; k++)
        for (int c = 0; c < 3; c++)
            t->tri[k][c] = (uint16_t)prng_pick(p, VERTS);
    t->mesh.pos_lo = prng_pick(p, 2) ? (const uint8_t(*)[3])t->lo : NULL;
    t->mesh.radius = (uint16_t)(extent * 0.87 + 2);
    t->instance.mesh = &t->mesh;
    zs_pose_turn(&t->instance.pose, (zs_turn)prng_next(p), (zs_turn)prng_next(p), (zs_turn)prng_next(p));
    t->instance.pose.scale = (zs_uq16_16)(65536.0 * 400 / extent * (0.5 + prng_pick(p, 1000) / 500.0));
    const double radius = (t->mesh.radius + 1) * t->instance.pose.scale / 65536.0 + 1;
    if (!level)
        zs_pose_turn(&t->ground, (zs_turn)prng_next(p), (zs_turn)prng_next(p), (zs_turn)prng_next(p));
    else
        zs_pose_identity(&t->ground);
    spread(p, t->ground.pos, 100000);
    double n[3], to[3];
    for (int k = 0; k < 3; k++) {
        t->plane.normal[k] = t->ground.rot[3 * k + 1];
        t->plane.at[k] = t->ground.pos[k];
        n[k] = t->plane.normal[k] / (double)ZS_Q30_ONE;
    }
    const double high = radius * (1.1 + prng_pick(p, 100) / 50.0);
    int32_t aside[3];
    spread(p, aside, 300);
    for (int k = 0; k < 3; k++)
        aside[k] -= (int32_t)(n[k] * (n[0] * aside[0] + n[1] * aside[1] + n[2] * aside[2])); /* in the plane */
    for (int k = 0; k < 3; k++)
        t->instance.pose.pos[k] = (int32_t)lround(t->plane.at[k] + n[k] * high + aside[k]);
    t->light.point = (uint8_t)prng_pick(p, 2);
    do { /* a direction that is not too low */
        int32_t dir[3];
        spread(p, dir, 1000);
        if (zs_unit(t->light.dir, dir))
            continue;
        for (int k = 0; k < 3; k++)
            to[k] = t->light.dir[k] / (double)ZS_Q30_ONE;
    } while (dot(n, to) < 0.3);
    const double away = radius * (5 + prng_pick(p, 30));
    for (int k = 0; k < 3; k++)
        t->light.pos[k] = (int32_t)(t->instance.pose.pos[k] + to[k] * away);
}

/* ---- Vertices against doubles ------------------------------------------------------------------ */

static double worst_step, worst_size;

static int vertices_case(uint64_t seed)
{
    struct prng p = { seed };
    static struct thing t;
    static int16_t flat[VERTS][3];
    struct zs_mesh mesh;
    const struct zs_material material = { .shader = &zs_shade_shadow };
    struct zs_instance shadow = { .material = &material };
    const int level = (int)prng_pick(&p, 2);
    thing_make(&t, &p, level);
    const int err = zs_shadow_flatten(&shadow, &mesh, flat, &t.instance, &t.plane, &t.light);
    if (err)
        return case_wrong("error %d: point %d, high %d", err, t.light.point, t.light.pos[1] - t.plane.at[1]);
    CASE_CHECK(shadow.mesh == &mesh && shadow.material == &material && mesh.tri == t.mesh.tri && mesh.n_tris == TRIS);
    const double step = mesh.scale / 65536.0;
    double n[3], to[3], extent = 0;
    for (int k = 0; k < 3; k++) {
        n[k] = t.plane.normal[k] / (double)ZS_Q30_ONE;
        to[k] = t.light.dir[k] / (double)ZS_Q30_ONE;
    }
    for (uint32_t v = 0; v < VERTS; v++) {
        double at[3], from[3], far = 0, out = 0;
        place(&t, v, at);
        for (int k = 0; k < 3; k++) {
            from[k] = at[k] - t.plane.at[k];
            if (t.light.point)
                to[k] = t.light.pos[k] - at[k];
        }
        for (int k = 0; k < 3; k++) {
            const double want = at[k] - to[k] * dot(n, from) / dot(n, to);
            const double is = shadow.pose.pos[k] + flat[v][k] * step;
            if (fabs(is - want) > far)
                far = fabs(is - want);
            if (abs(flat[v][k]) > extent)
                extent = abs(flat[v][k]);
            out += (double)flat[v][k] * flat[v][k];
        }
        if (far / step > worst_step)
            worst_step = far / step;
        if (far > 0.6 * step)
            return case_wrong("vertex %u is %g steps off", v, far / step);
        CASE_CHECK(sqrt(out) <= mesh.radius);
        CASE_CHECK(!level ||
                   shadow.pose.pos[1] * 65536.0 + flat[v][1] * (double)mesh.scale == t.plane.at[1] * 65536.0);
    }
    if (extent < 32700 / 2 && 1 / extent > worst_size)
        worst_size = 1 / extent;
    return 1;
}

static void vertices(void **state)
{
    (void)state;
    CASES(vertices_case, 2000);
    printf("  vertices: at most %.3f steps off; the smallest shadow takes %.0f steps to each side\n", worst_step,
           1 / worst_size);
}

/* Shadows of less than a world unit: a sphere that hides less than its vertices would cull what is in view. */
static int small_case(uint64_t seed)
{
    struct prng p = { seed };
    static struct thing t;
    static int16_t flat[VERTS][3];
    struct zs_mesh mesh;
    struct zs_instance shadow;
    thing_make(&t, &p, 0);
    t.light.point = 0;
    t.instance.pose.scale = 65536u / t.mesh.radius / (1 + prng_pick(&p, 20)) + 1;
    CASE_CHECK(zs_shadow_flatten(&shadow, &mesh, flat, &t.instance, &t.plane, &t.light) == ZS_OK);
    for (uint32_t v = 0; v < VERTS; v++) {
        const double at[3] = { flat[v][0], flat[v][1], flat[v][2] };
        if (dot(at, at) > (double)mesh.radius * mesh.radius)
            return case_wrong("vertex %u is %g steps from the middle of a sphere of %u", v, sqrt(dot(at, at)),
                              mesh.radius);
    }
    return 1;
}

/* ---- Pixels ------------------------------------------------------------------------------------ */

static unsigned dark;

/* A shadow on the bare ground: dark are the pixels of its triangles, all of them, once. */
static int pixels_case(uint64_t seed)
{
    struct prng p = { seed };
    static struct thing t;
    static int16_t flat[VERTS][3];
    static const int16_t square_pos[4][3] = { { -100, 0, 100 }, { 100, 0, 100 }, { 100, 0, -100 }, { -100, 0, -100 } };
    static const uint16_t square_tri[2][3] = { { 0, 1, 2 }, { 0, 2, 3 } };
    static const struct zs_mesh square = {
        .pos = square_pos, .tri = square_tri, .n_verts = 4, .n_tris = 2, .radius = 142
    };
    static const struct zs_depth *const depths[4] = { &zs_depth_recip, &zs_depth_linear, &zs_depth_float,
                                                      &zs_depth_e3m13 };
    const struct zs_material white = { .shader = &zs_shade_raw, .rgb = ZS_RGB(0xffffff) },
                             red = { .shader = &zs_shade_raw, .rgb = ZS_RGB(0xff0000), .cull = ZS_CULL_NONE },
                             dim = { .shader = &zs_shade_shadow, .rgb = ZS_RGB(0x808080), .cull = ZS_CULL_NONE };
    const struct zs_depth_state always = { .func = ZS_DEPTH_ALWAYS }, eleven = { .bias = -11 },
                                most = { .bias = INT16_MIN };
    struct zs_mesh mesh;
    struct zs_instance both[2] = { { .mesh = &square, .material = &white },
                                   { .material = &red, .depth_state = &always } };
    const struct zs_scene scene = { .instance = both, .n_instances = 2, .background = 0x001f };
    struct zs_camera camera;

    thing_make(&t, &p, (int)prng_pick(&p, 2));
    CASE_CHECK(zs_shadow_flatten(&both[1], &mesh, flat, &t.instance, &t.plane, &t.light) == ZS_OK);
    both[0].pose = t.ground;
    both[0].pose.scale = (zs_uq16_16)prng_range(&p, 2, prng_pick(&p, 2) ? 10 : 500) << 16;
    const double size = mesh.radius * (mesh.scale / 65536.0);
    if (size > 40000)
        return 1;
    int32_t eye[3], at[3], above[3];
    const double away = size * (1.5 + prng_pick(&p, 100) / 50.0), lean = size * (1 + prng_pick(&p, 100) / 50.0);
    for (int k = 0; k < 3; k++) {
        at[k] = both[1].pose.pos[k];
        eye[k] = at[k] + (int32_t)((away * t.ground.rot[3 * k + 1] + lean * t.ground.rot[3 * k]) / ZS_Q30_ONE);
        above[k] = t.ground.rot[3 * k + 1];
    }
    const struct zs_depth *depth = depths[prng_pick(&p, 4)];
    if (zs_camera_perspective(&camera, ZS_DEGREES(50), 80, (int32_t)(size / 2) + 1, (int32_t)size * 40 + 100) ||
        zs_camera_look_at(&camera, eye, at, above))
        return case_wrong("camera");
    struct zs_config c = picture_config(100, 80, depth);
    struct picture covered = picture_draw(&c, &scene, &camera);
    const struct zs_scene bare = { .instance = both, .n_instances = 1, .background = 0x001f };
    struct picture empty = picture_draw(&c, &bare, &camera);
    both[1].material = &dim;
    both[1].depth_state = (const struct zs_depth_state *const[3]){ NULL, &eleven, &most }[prng_pick(&p, 3)];
    picture_any_way(&p, &c, 2, 6);
    struct picture shaded = picture_draw(&c, &scene, &camera);
    int right = !covered.err && !shaded.err && !empty.err;
    for (int32_t k = 0; right && k < covered.w * covered.h; k++) {
        const uint16_t is = shaded.color[k];
        const int in = covered.color[k] == 0xf800, on = empty.key[k] != ZS_DEPTH_CLEAR;
        dark += is == 0x8410;
        if (is != (in && on ? 0x8410 : on ? 0xffff : 0x001f))
            right = case_wrong("(%d, %d) is %04x, not %s", k % covered.w, k / covered.w, is,
                               in   ? "dark"
                               : on ? "light"
                                    : "empty");
    }
    PICTURES_FREE(&covered, &empty, &shaded);
    return right;
}

/* ---- Damage ------------------------------------------------------------------------------------ */

#define SHOWN_W 100
#define SHOWN_H 80

static unsigned sent, parts;

static int show(void *ctx, const struct zs_strip *s)
{
    sent += (unsigned)s->dirty_w * s->h;
    uint16_t *to = ctx;
    for (uint32_t y = 0; y < s->h; y++)
        for (uint32_t x = s->dirty_x; x < (uint32_t)s->dirty_x + s->dirty_w; x++) {
            const uint8_t *px = s->px + 2u * (y * s->w + x);
            to[(s->y + y) * SHOWN_W + x] = (uint16_t)(px[0] << 8 | px[1]);
        }
    return 0;
}

/* A shadow and a disc that move over the ground: columns drawn alone are those of the whole picture. */
static int columns_case(uint64_t seed)
{
    struct prng p = { seed };
    static struct thing t;
    static int16_t flat[VERTS][3];
    static uint16_t shown[SHOWN_W * SHOWN_H];
    static uint32_t track[ZS_DAMAGE_WORDS(3, SHOWN_H, 1)];
    const struct zs_material white = { .shader = &zs_shade_raw, .rgb = ZS_RGB(0xffffff) },
                             dim = { .shader = &zs_shade_shadow, .rgb = ZS_RGB(0x808080), .cull = ZS_CULL_NONE },
                             soft = { .shader = &zs_shade_disc };
    const struct zs_depth_state on = { .read_only = 1, .bias = -8 };
    struct zs_mesh mesh, square = zs_shadow_disc;
    struct zs_instance all[3] = { { .mesh = &square, .material = &white },
                                  { .mesh = &zs_shadow_disc, .material = &soft, .depth_state = &on },
                                  { .material = &dim } };
    const struct zs_scene scene = { .instance = all, .n_instances = 3, .background = 0x001f };
    struct zs_camera camera;
    struct zs_renderer r;

    thing_make(&t, &p, 1);
    CASE_CHECK(zs_shadow_flatten(&all[2], &mesh, flat, &t.instance, &t.plane, &t.light) == ZS_OK);
    const int32_t size = (int32_t)(mesh.radius * (mesh.scale / 65536.0)), *const at = all[2].pose.pos;
    const int32_t middle[3] = { at[0], at[1], at[2] };
    for (int k = 0; k < 3; k++)
        all[0].pose.pos[k] = all[1].pose.pos[k] = at[k];
    all[0].pose.scale = (zs_uq16_16)(size * 2048);
    all[1].pose.scale = (zs_uq16_16)(size * 128);
    struct zs_config c = picture_config(SHOWN_W, SHOWN_H, &zs_depth_float);
    struct zs_config way = c;
    picture_any_way(&p, &way, 2, 6);
    void *arena = malloc(zs_arena_bytes(&way));
    int err = arena ? zs_init(&r, &way, arena, zs_arena_bytes(&way)) : -1;
    err = err ? err : zs_damage_track(&r, track, 3);
    err = err ? err : zs_damage_columns(&r, 1);
    err = err ? err : zs_camera_perspective(&camera, ZS_DEGREES(50), SHOWN_H, size / 2, size * 40);
    err = err ? err : zs_camera_orbit(&camera, middle, size * 4, (zs_turn)prng_next(&p), ZS_DEGREES(50));
    const struct zs_sink sink = { .submit = show, .ctx = shown };
    int right = !err;
    for (int frame = 0; right && frame < 6; frame++) {
        sent = 0;
        err = zs_render(&r, &scene, &camera, &sink);
        struct picture whole = picture_draw(&c, &scene, &camera);
        right = !err && !whole.err && (!memcmp(whole.color, shown, sizeof shown) || case_wrong("frame %d", frame));
        parts += sent < SHOWN_W * SHOWN_H;
        picture_free(&whole);
        struct zs_instance *moves = &all[1 + prng_pick(&p, 2)];
        moves->pose.pos[0] += prng_range(&p, -size / 4, size / 4);
        moves->pose.pos[2] += prng_range(&p, -size / 4, size / 4);
    }
    free(arena);
    return right || case_wrong("error %d", err);
}

/* A disc on level ground seen from above, against its formula. */
static void a_disc(void **state)
{
    (void)state;
    const struct zs_material grey = { .shader = &zs_shade_disc, .rgb = ZS_RGB(0x404040) };
    const struct zs_depth_state on = { .read_only = 1, .bias = -4 };
    const struct zs_instance disc = { .mesh = &zs_shadow_disc,
                                      .material = &grey,
                                      .depth_state = &on,
                                      .pose = { .pos = { 300, 0, 100 }, .scale = 5000u * 512u } };
    const struct zs_scene scene = { .instance = &disc, .n_instances = 1, .background = 0xffff };
    struct zs_camera camera;
    const int32_t eye[3] = { 300, 20000, 100 }, down[3] = { 0, -1, 0 }, up[3] = { 0, 0, -1 };
    const int side = 120;
    assert_int_equal(zs_camera_orthographic(&camera, 12000, 10, 30000), ZS_OK);
    assert_int_equal(zs_camera_look_along(&camera, eye, down, up), ZS_OK);
    const struct zs_config c = picture_config(side, side, &zs_depth_linear);
    struct picture is = picture_draw(&c, &scene, &camera);
    assert_int_equal(is.err, ZS_OK);
    assert_int_equal(is.covered, 0); /* it writes no keys */
    for (int y = 0; y < side; y++)
        for (int x = 0; x < side; x++) {
            const double dx = (x + 0.5 - side / 2) * 100 / 5000, dy = (y + 0.5 - side / 2) * 100 / 5000;
            const double r2 = dx * dx + dy * dy, left = 1 - (r2 < 1 ? 0.75 * (1 - r2) * (1 - r2) : 0);
            const uint32_t green = is.color[y * side + x] >> 5 & 63u, red = is.color[y * side + x] >> 11;
            assert_true(fabs(green - 63 * left) < 63.0 / 64 + 0.6); /* levels are 1/32 apart */
            assert_true(fabs(red - 31 * left) < 31.0 / 64 + 0.6);
        }
    picture_free(&is);
}

/* ---- Errors, and lights where there is no shadow ------------------------------------------------ */

static int flattened(struct thing *t)
{
    static int16_t flat[VERTS][3];
    struct zs_mesh mesh;
    struct zs_instance shadow;
    memset(flat, 0x5a, sizeof flat);
    memset(&mesh, 0x5a, sizeof mesh);
    memset(&shadow, 0x5a, sizeof shadow);
    const struct zs_mesh was = mesh;
    const struct zs_instance before = shadow;
    const int err = zs_shadow_flatten(&shadow, &mesh, flat, &t->instance, &t->plane, &t->light);
    if (err) {
        assert_memory_equal(&mesh, &was, sizeof mesh);
        assert_memory_equal(&shadow, &before, sizeof shadow);
        assert_int_equal(flat[VERTS - 1][2], 0x5a5a);
    }
    return err;
}

static void dir_set(struct thing *t, int32_t x, int32_t y, int32_t z)
{
    const int32_t v[3] = { x, y, z };
    assert_int_equal(zs_unit(t->light.dir, v), ZS_OK);
}

static void what_is_refused(void **state)
{
    (void)state;
    static struct thing t;
    struct prng p = { 5 };
    struct zs_mesh mesh;
    struct zs_instance shadow;
    thing_make(&t, &p, 1);
    t.light.point = 0;
    assert_int_equal(flattened(&t), ZS_OK);
    dir_set(&t, 1, 0, 0); /* in the plane */
    assert_int_equal(flattened(&t), ZS_ERR_VECTOR);
    dir_set(&t, 1, -1, 0); /* from below */
    assert_int_equal(flattened(&t), ZS_ERR_VECTOR);
    dir_set(&t, 1000, 3, 0); /* too low */
    assert_int_equal(flattened(&t), ZS_ERR_VECTOR);
    dir_set(&t, 1000, 5, 0);
    assert_int_equal(flattened(&t), ZS_OK);
    t.light.dir[1] /= 2;
    t.light.dir[0] /= 2; /* not of length 1 */
    assert_int_equal(flattened(&t), ZS_ERR_RANGE);
    t.light.point = 1;
    assert_int_equal(flattened(&t), ZS_OK);
    t.light.pos[1] = t.plane.at[1]; /* a light in the plane */
    assert_int_equal(flattened(&t), ZS_ERR_VECTOR);
    t.light.pos[1] -= 100; /* below it */
    assert_int_equal(flattened(&t), ZS_ERR_VECTOR);
    t.light.pos[1] = t.instance.pose.pos[1]; /* inside the thing */
    assert_int_equal(flattened(&t), ZS_ERR_RANGE);
    t.light.pos[1] = t.plane.at[1] + 1; /* below the thing */
    assert_int_equal(flattened(&t), ZS_ERR_RANGE);
    t.light.pos[1] = ZS_WORLD_MAX + 1;
    assert_int_equal(flattened(&t), ZS_ERR_RANGE);
    t.light.point = 0;
    dir_set(&t, 1, 1, 0);
    t.instance.pose.pos[1] = ZS_WORLD_MAX; /* the shadow falls beside the world */
    t.instance.pose.pos[0] = -ZS_WORLD_MAX;
    assert_int_equal(flattened(&t), ZS_ERR_RANGE);
    thing_make(&t, &p, 1);
    t.plane.normal[1] /= 2;
    assert_int_equal(flattened(&t), ZS_ERR_RANGE);
    thing_make(&t, &p, 1);
    t.instance.pose.scale = UINT32_MAX;
    t.mesh.scale = UINT32_MAX;
    assert_int_equal(flattened(&t), ZS_ERR_RANGE);
    thing_make(&t, &p, 1);
    t.light.point = 0;
    dir_set(&t, 0, 1, 0);
    memset(t.pos, 0, sizeof t.pos);
    memset(t.mesh.center, 0, sizeof t.mesh.center);
    t.mesh.radius = 1;
    t.instance.pose.scale = ZS_Q16_ONE;
    t.mesh.scale = 32768u * ZS_Q16_ONE; /* world units a step, the first that is too large */
    assert_int_equal(flattened(&t), ZS_ERR_RANGE);
    t.mesh.scale--;
    assert_int_equal(flattened(&t), ZS_OK);
    thing_make(&t, &p, 1);
    assert_int_equal(zs_shadow_flatten(NULL, &mesh, NULL, &t.instance, &t.plane, &t.light), ZS_ERR_NULL);
    assert_int_equal(zs_shadow_flatten(&shadow, &mesh, NULL, &t.instance, &t.plane, &t.light), ZS_ERR_NULL);
    t.instance.mesh = NULL;
    assert_int_equal(flattened(&t), ZS_ERR_NULL);
}

static void shaders_refuse(void **state)
{
    (void)state;
    static const struct zs_method *const methods[2] = { &zs_method_painter, &zs_method_hiz };
    struct zs_depth_state s = { .bias = -3 };
    const struct zs_material dim = { .shader = &zs_shade_shadow }, disc = { .shader = &zs_shade_disc };
    struct zs_instance in = { .mesh = &zs_shadow_disc, .material = &dim, .depth_state = &s };
    const struct zs_scene scene = { .instance = &in, .n_instances = 1 };
    struct zs_camera camera;
    assert_int_equal(zs_camera_perspective(&camera, ZS_DEGREES(50), 8, 10, 1000), ZS_OK);
    struct zs_config c = {
        .width = 8, .height = 8, .strip_h = 8, .max_tris = 9, .max_verts = 9, .varyings = 2, .depth = &zs_depth_float
    };
#define REFUSED_WITH(error) assert_int_equal(picture_error(&c, &scene, &camera), error)
    REFUSED_WITH(ZS_OK);
    s.bias = 0;
    REFUSED_WITH(ZS_ERR_RANGE);
    s.bias = INT16_MIN; /* saturates */
    REFUSED_WITH(ZS_OK);
    s.slope_bias = 1;
    REFUSED_WITH(ZS_ERR_RANGE);
    s.slope_bias = 0;
    s.read_only = 1;
    REFUSED_WITH(ZS_ERR_RANGE);
    s.read_only = 0;
    s.func = ZS_DEPTH_ALWAYS;
    REFUSED_WITH(ZS_ERR_RANGE);
    in.depth_state = NULL;
    REFUSED_WITH(ZS_OK);
    for (int k = 0; k < 2; k++) {
        c.method = methods[k];
        c.depth = k ? &zs_depth_float : &zs_depth_none;
        REFUSED_WITH(ZS_ERR_DEPTH);
    }
    c.method = NULL;
    c.depth = &zs_depth_none;
    REFUSED_WITH(ZS_ERR_DEPTH);
    c.depth = &zs_depth_float;
    in.material = &disc;
    REFUSED_WITH(ZS_OK);
    c.varyings = 1;
    REFUSED_WITH(ZS_ERR_VARYINGS);
#undef REFUSED_WITH
}

static unsigned below;

/* From a lamp, a thing that lies wholly below the plane as well: the shadow's mesh lies in its sphere. */
static int below_case(uint64_t seed)
{
    static const int16_t corner[4][3] = { { -100, -100, 0 }, { 100, -100, 0 }, { 100, 100, 0 }, { -100, 100, 0 } };
    static const uint16_t tri[2][3] = { { 0, 1, 2 }, { 0, 2, 3 } };
    const struct zs_shadow_plane plane = { .normal = { 0, ZS_Q30_ONE, 0 } };
    struct prng p = { seed };
    for (int k = 0; k < 40; k++) {
        const struct zs_mesh mesh = { .pos = corner, .tri = tri, .n_verts = 4, .n_tris = 2, .radius = 142,
                                      .scale = (uint32_t)prng_next(&p) >> prng_range(&p, 8, 31) };
        struct zs_instance in = { .mesh = &mesh }, out = { .mesh = NULL };
        struct zs_shadow_light lamp = { .point = 1 };
        struct zs_mesh flat;
        int16_t pos[4][3];
        uint32_t index;
        for (int i = 0; i < 3; i++) {
            in.pose.pos[i] = prng_range(&p, -(1 << 28), 1 << 28) >> prng_range(&p, 0, 28);
            lamp.pos[i] = prng_range(&p, -(1 << 28), 1 << 28) >> prng_range(&p, 0, 28);
        }
        zs_pose_turn(&in.pose, (zs_turn)prng_next(&p), (zs_turn)prng_next(&p), (zs_turn)prng_next(&p));
        if (zs_shadow_flatten(&out, &flat, pos, &in, &plane, &lamp))
            continue;
        below += in.pose.pos[1] < 0;
        CASE_CHECK(zs_mesh_check(&flat, &index) != ZS_FLAW_SPHERE);
    }
    return 1;
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(vertices),
    CASES_COUNT(below_the_plane, below_case, 2000, &below, 1000, "things below the plane"),
    CASES_TEST(spheres_hold_small_shadows, small_case, 2000),
    CASES_COUNT(darkened_once, pixels_case, 400, &dark, 50000, "dark pixels"),
    CASES_COUNT(columns_alone, columns_case, 60, &parts, 100, "frames of which parts were left out"),
    cmocka_unit_test(a_disc),
    cmocka_unit_test(what_is_refused),
    cmocka_unit_test(shaders_refuse),
};
CASES_MAIN(tests)
