/* What is culled before it is drawn, as textbooks have it: the view frustum by planes, sphere and box; back faces; and
 * objects behind others.
 *
 * SPDX-License-Identifier: MIT
 */
#include <math.h>
#include <string.h>

#include "cases.h"
#include "fast_lists.h"
#include "picture.h"
#include "zs_method.h"

#define W 160
#define H 120

static struct zs_config config(const struct zs_depth *depth)
{
    struct zs_config c = picture_config(W, H, depth);
    c.max_tris = 400;
    c.max_verts = 400;
    return c;
}

static struct zs_camera view(void)
{
    struct zs_camera camera;
    assert_int_equal(zs_camera_perspective(&camera, ZS_DEGREES(60), H, 100, 20000), ZS_OK);
    return camera;
}

/* ---- Back faces ------------------------------------------------------------------------------- */

/* Corners on the axes, and a face for each octant; its corners turn counter-clockwise as seen from outside. */
struct body {
    int16_t pos[6][3];
    uint16_t tri[8][3], raw[8];
    struct zs_mesh mesh;
    struct zs_material material;
    struct zs_instance instance;
    struct zs_scene scene;
};

/* An octahedron of any size, turned in any way, in front of the camera. */
static void body_make(struct body *b, struct prng *p)
{
    memset(b, 0, sizeof *b);
    for (int v = 0; v < 6; v++)
        b->pos[v][v / 2] = (int16_t)(prng_range(p, 300, 1200) * (v % 2 ? -1 : 1));
    for (uint16_t t = 0; t < 8; t++) {
        const int turned = (t & 1) ^ (t >> 1 & 1) ^ (t >> 2 & 1);
        b->tri[t][0] = t & 1;
        b->tri[t][1 + turned] = (uint16_t)(2 + (t >> 1 & 1));
        b->tri[t][2 - turned] = (uint16_t)(4 + (t >> 2 & 1));
        b->raw[t] = (uint16_t)(0x1111 * (t + 1));
    }
    b->mesh = (struct zs_mesh){ .pos = (const int16_t(*)[3])b->pos, .tri = (const uint16_t(*)[3])b->tri,
                                .face_raw = b->raw, .n_verts = 6, .n_tris = 8, .radius = 1300 };
    b->material = (struct zs_material){ .shader = &zs_shade_raw };
    b->instance = (struct zs_instance){ .mesh = &b->mesh, .material = &b->material };
    zs_pose_turn(&b->instance.pose, (uint16_t)prng_next(p), (uint16_t)prng_next(p), (uint16_t)prng_next(p));
    b->instance.pose.pos[0] = prng_range(p, -600, 600);
    b->instance.pose.pos[1] = prng_range(p, -600, 600);
    b->instance.pose.pos[2] = prng_range(p, -4000, -2000);
    b->scene = (struct zs_scene){ .instance = &b->instance, .n_instances = 1 };
}

/* The pixels at which back-face culling alone, without depth memory, differs from the z-buffer with faces culled so. */
static int wrong_pixels(struct body *b, uint8_t cull, struct zs_stats *stats)
{
    const struct zs_camera camera = view();
    struct zs_config c = config(&zs_depth_none);
    b->material.cull = ZS_CULL_BACK;
    struct picture culled = picture_draw(&c, &b->scene, &camera);
    c = config(&zs_depth_float);
    b->material.cull = cull;
    struct picture full = picture_draw(&c, &b->scene, &camera);
    assert_int_equal(culled.err | full.err, ZS_OK);
    assert_true(full.covered > 100);
    int wrong = 0;
    for (int i = 0; i < W * H; i++)
        wrong += culled.color[i] != full.color[i];
    *stats = culled.stats;
    PICTURES_FREE(&culled, &full);
    return wrong;
}

enum kind { CLOSED, OPEN, CONCAVE };

static unsigned wrong_in(enum kind kind, unsigned n, unsigned *views)
{
    unsigned wrong = 0;
    *views = 0;
    for (uint64_t seed = 1; seed <= n; seed++) {
        struct prng p = { seed };
        static struct body b;
        struct zs_stats stats;
        body_make(&b, &p);
        if (kind == OPEN)
            b.mesh.n_tris = 7;
        if (kind == CONCAVE) /* two opposite corners on one side of the middle: a dent */
            b.pos[5][2] = (int16_t)(b.pos[4][2] / 2);
        const int here = wrong_pixels(&b, kind == OPEN ? ZS_CULL_NONE : ZS_CULL_BACK, &stats);
        wrong += (unsigned)here;
        *views += here != 0;
        assert_true(stats.tris_facing + stats.tris_zero > 0 && stats.tris_drawn < b.mesh.n_tris);
    }
    return wrong;
}

/* Front faces and back faces meet at the outline, where both may have one key: so the z-buffer draws no back faces
 * either, but for the open body, of which they are a part. */
#define VIEWS 400

/* A closed convex body's front faces overlap nowhere and hide the back faces. Where a face is missing, its inside is
 * seen; where there is a dent, front faces hide each other. */
static void back_face_culling_alone_is_right_for_a_closed_convex_body(void **state)
{
    (void)state;
    unsigned views;
    const unsigned closed = wrong_in(CLOSED, VIEWS, &views);
    print_message("closed and convex: %u wrong pixels in %u of 400 views\n", closed, views);
    assert_int_equal(closed, 0);
    const unsigned open = wrong_in(OPEN, VIEWS, &views);
    print_message("open: %u wrong pixels in %u of 400 views\n", open, views);
    assert_true(open > 10000 && views > 50);
    const unsigned dented = wrong_in(CONCAVE, VIEWS, &views);
    print_message("with a dent: %u wrong pixels in %u of 400 views\n", dented, views);
    assert_true(dented > 1000 && views > 20);
}

/* ---- The view frustum ------------------------------------------------------------------------- */

/* Signed distances of a point from the frustum's six planes, inside > 0. Axes: right, up, distance. */
static void distances(double out[6], const double at[3])
{
    const double t = tan(M_PI / 6), along = cos(M_PI / 6); /* of half the angle from top to bottom */
    const double side = t * W / H, length = sqrt(1 + side * side);
    out[0] = at[2] - 100;
    out[1] = 20000 - at[2];
    out[2] = (at[2] * side - at[0]) / length;
    out[3] = (at[2] * side + at[0]) / length;
    out[4] = (at[2] * t - at[1]) * along;
    out[5] = (at[2] * t + at[1]) * along;
}

/* 1: a sphere lies beyond one of the planes. */
static int sphere_outside(const double at[3], double radius)
{
    double d[6];
    distances(d, at);
    for (int k = 0; k < 6; k++)
        if (d[k] < -radius)
            return 1;
    return 0;
}

/* 1: all eight corners of a box lie beyond one of the planes. */
static int box_outside(const double at[3], const int32_t half[3])
{
    int beyond[6] = { 0 };
    for (int corner = 0; corner < 8; corner++) {
        double c[3], d[6];
        for (int k = 0; k < 3; k++)
            c[k] = at[k] + (corner >> k & 1 ? half[k] : -half[k]);
        distances(d, c);
        for (int k = 0; k < 6; k++)
            beyond[k] += d[k] < 0;
    }
    for (int k = 0; k < 6; k++)
        if (beyond[k] == 8)
            return 1;
    return 0;
}

/* Long boxes (octahedra in them) in and about the view: the renderer leaves out those whose sphere is outside; the box
 * would tell more; and nothing that either leaves out has a pixel. */
static void the_frustum_by_sphere_and_by_box(void **state)
{
    (void)state;
    const struct zs_camera camera = view();
    const struct zs_config c = config(&zs_depth_float);
    unsigned culled = 0, by_box = 0, seen = 0, empty = 0;
    for (uint64_t seed = 1; seed <= 600; seed++) {
        struct prng p = { seed };
        static struct body b;
        int32_t half[3];
        body_make(&b, &p);
        memset(b.instance.pose.rot, 0, sizeof b.instance.pose.rot);
        for (int k = 0; k < 3; k++) {
            half[k] = prng_range(&p, 50, prng_pick(&p, 2) ? 3000 : 300);
            b.pos[2 * k][k] = (int16_t)half[k];
            b.pos[2 * k + 1][k] = (int16_t)-half[k];
            b.instance.pose.pos[k] = k == 2 ? -prng_range(&p, -3000, 23000) : prng_range(&p, -12000, 12000);
        }
        const int32_t most = half[0] > half[1] ? half[0] : half[1];
        b.mesh.radius = (uint16_t)(half[2] > most ? half[2] : most);
        const double at[3] = { b.instance.pose.pos[0], b.instance.pose.pos[1], -(double)b.instance.pose.pos[2] };
        b.material.cull = ZS_CULL_NONE;
        struct picture is = picture_draw(&c, &b.scene, &camera);
        assert_int_equal(is.err, ZS_OK);
        const int outside = sphere_outside(at, b.mesh.radius), box = box_outside(at, half);
        if (is.stats.instances_culled != (unsigned)outside) /* its slack is a few units */
            assert_true(outside && !sphere_outside(at, b.mesh.radius + 4.));
        assert_true(!is.covered || (!outside && !box));
        culled += is.stats.instances_culled;
        by_box += (unsigned)(box || outside);
        seen += is.covered != 0;
        empty += is.covered == 0;
        picture_free(&is);
    }
    print_message("of 600, %u without a pixel: %u culled by sphere, %u by sphere or box\n", empty, culled, by_box);
    assert_true(seen > 100 && culled > 200 && by_box > culled && by_box <= empty);
}

/* ---- Objects behind others -------------------------------------------------------------------- */

#define BALLS 20

/* A wall, then bodies behind it, one in front and one beside: `tiles` leaves out those behind; so does zs_method_hiz,
 * once a full pool has had the wall drawn. */
static void objects_behind_a_wall_are_left_out(void **state)
{
    (void)state;
    static const int16_t corner[4][3] = { { -3000, -2000, -2000 }, { 500, -2000, -2000 }, { 500, 2000, -2000 },
                                          { -3000, 2000, -2000 } };
    static const uint16_t halves[2][3] = { { 0, 1, 2 }, { 0, 2, 3 } };
    static const struct zs_mesh quad = { .pos = corner, .tri = halves, .n_verts = 4, .n_tris = 2, .radius = 5000 };
    static const struct zs_material wall = { .shader = &zs_shade_raw, .rgb = { 90, 90, 90 }, .cull = ZS_CULL_NONE };
    static struct zs_instance instance[BALLS + 3] = { { .mesh = &quad, .material = &wall } };
    static struct body b;
    struct prng p = { 7 };
    body_make(&b, &p);
    for (int i = 1; i < BALLS + 3; i++) {
        instance[i] = b.instance;
        instance[i].pose.scale = ZS_Q16_ONE / 8;
        instance[i].pose.pos[0] = i == BALLS + 2 ? 1400 : -i * 30;
        instance[i].pose.pos[1] = i * 20 - 200;
        instance[i].pose.pos[2] = i == BALLS + 1 ? -1500 : -3000 - 100 * i;
    }
    instance[BALLS + 2].pose.pos[2] = -3000;
    const struct zs_scene scene = { .instance = instance, .n_instances = BALLS + 3 };
    const struct zs_camera camera = view();
    struct zs_config c = config(&zs_depth_float);
    c.fast = NULL;
    struct picture plain = picture_draw(&c, &scene, &camera);
    assert_int_equal(plain.stats.instances_hidden, 0);
    c.fast = fast_of(FAST_TILES);
    struct picture by_tiles = picture_draw(&c, &scene, &camera);
    c.fast = NULL;
    c.method = &zs_method_hiz;
    c.max_tris = 3; /* full when the wall and a triangle of the first body are in it */
    struct picture by_hiz = picture_draw(&c, &scene, &camera);
    print_message("left out of %d: %u by tiles, %u by hiz\n", BALLS, by_tiles.stats.instances_hidden,
                  by_hiz.stats.instances_hidden);
    assert_true(picture_same(&plain, &by_tiles, "tiles") && picture_same(&plain, &by_hiz, "hiz"));
    assert_int_equal(by_tiles.stats.instances_hidden, BALLS);
    assert_int_equal(by_hiz.stats.instances_hidden, BALLS - 1);
    PICTURES_FREE(&plain, &by_tiles, &by_hiz);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(back_face_culling_alone_is_right_for_a_closed_convex_body),
    cmocka_unit_test(the_frustum_by_sphere_and_by_box),
    cmocka_unit_test(objects_behind_a_wall_are_left_out)
};

CASES_MAIN(tests)
