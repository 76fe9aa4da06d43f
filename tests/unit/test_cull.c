/* Clusters: what is left out changes no pixel, no key and no camera unit.
 *
 * SPDX-License-Identifier: MIT
 */
#include <math.h>
#include <string.h>

#include "cases.h"
#include "clusters.h"
#include "fast_lists.h"
#include "picture.h"
#include "internals.h"
#include "shapes.h"

#define SHAPES 3
#define INSTANCES 6

static struct {
    uint64_t frames, pixels, in, out, by_cone, verts, verts_plain, refused;
} reached;

/* ---- Worlds ------------------------------------------------------------------------------------------- */

struct world {
    struct shape shape[SHAPES];
    struct zs_cluster cluster[SHAPES][SHAPE_TRIS];
    struct zs_material material[INSTANCES];
    struct zs_instance instance[INSTANCES];
    struct zs_scene scene;
    struct zs_camera camera;
};

static const struct zs_shader *const shaders[] = { &zs_shade_raw, &zs_shade_flat, &zs_shade_smooth };
static const struct zs_depth *const persp[] = { &zs_depth_float, &zs_depth_recip, &zs_depth_linear };

/* A flat grid of cells that are not square, all facing +y: one cone without width. */
static void shape_flat(struct shape *s, struct prng *p, int32_t half, int32_t step)
{
    shape_begin(s);
    const uint32_t n = 1 + prng_pick(p, 9);
    const int32_t x0 = prng_range(p, -half, half), z0 = prng_range(p, -half, half);
    const int32_t across = 1 + prng_range(p, 0, step), down = 1 + prng_range(p, 0, step);
    for (uint32_t z = 0; z <= n; z++)
        for (uint32_t x = 0; x <= n; x++) {
            const int32_t at[3] = { x0 + (int32_t)x * across + prng_range(p, 0, across / 2), 0,
                                    z0 + (int32_t)z * down + prng_range(p, 0, down / 2) };
            const int32_t up[3] = { 0, 1, 0 };
            (void)shape_vertex(s, at, up);
        }
    shape_cells(s, n);
}

/* Away from where it turns, by up to its radius along each axis. */
static void shape_aside(struct shape *s, struct prng *p)
{
    struct zs_mesh *m = &s->mesh;
    for (int k = 0; k < 3; k++) {
        int32_t lo = 0, hi = 0;
        for (uint32_t v = 0; v < m->n_verts; v++) {
            lo = s->pos[v][k] < lo ? s->pos[v][k] : lo;
            hi = s->pos[v][k] > hi ? s->pos[v][k] : hi;
        }
        int32_t by = prng_range(p, -(int32_t)m->radius, m->radius);
        by = by < -32768 - lo ? -32768 - lo : by > 32767 - hi ? 32767 - hi : by;
        for (uint32_t v = 0; v < m->n_verts; v++)
            s->pos[v][k] = (int16_t)(s->pos[v][k] + by);
        m->center[k] = (int16_t)(m->center[k] + by);
    }
}

static void shape_any(struct shape *s, struct prng *p)
{
    switch (prng_pick(p, 6)) {
    case 0: shape_sphere(s, 3 + prng_pick(p, 12), 4 + prng_pick(p, 12), 20 << prng_pick(p, 10)); break;
    case 1:
        shape_torus(s, 3 + prng_pick(p, 12), 3 + prng_pick(p, 12), 1200 << prng_pick(p, 4), 400 << prng_pick(p, 3));
        break;
    case 2:
        shape_ground(s, 1 + prng_pick(p, 14), 500 << prng_pick(p, 6), 1 + prng_range(p, 0, 300), prng_next(p));
        break;
    case 3: shape_soup(s, 2 + prng_pick(p, 80), 50 << prng_pick(p, 9), prng_next(p)); break;
    default: shape_flat(s, p, 1 + prng_range(p, 0, 6000), 1 + prng_range(p, 0, 1 << prng_pick(p, 11))); break;
    }
    if (!prng_pick(p, 4)) {
        s->mesh.pos_lo = (const uint8_t (*)[3])s->pos_lo;
        s->mesh.radius = (uint16_t)(s->mesh.radius < 65530 ? s->mesh.radius + 2 : 65535);
    }
    s->mesh.scale = prng_pick(p, 2) ? ZS_Q16_ONE : (zs_uq16_16)(ZS_Q16_ONE / 64u + prng_pick(p, ZS_Q16_ONE * 4u));
    struct prng own = { p->state + 1 };
    if (prng_pick(&own, 3) == 0)
        shape_aside(s, &own);
}

static void place(struct prng *p, struct zs_instance *in, int32_t far)
{
    zs_pose_identity(&in->pose);
    zs_pose_turn(&in->pose, (zs_turn)prng_next(p), (zs_turn)prng_next(p), (zs_turn)prng_next(p));
    for (int k = 0; k < 3; k++)
        in->pose.pos[k] = prng_range(p, -far, far);
    in->pose.scale = prng_pick(p, 2) ? ZS_Q16_ONE : ZS_Q16_ONE / 8u + prng_pick(p, 2 * ZS_Q16_ONE);
}

static int64_t reach_of(const struct zs_instance *in)
{
    return ((int64_t)in->mesh->radius * in->mesh->scale >> 16) * in->pose.scale >> 16;
}

/* Outside, inside the spheres, or on the plane of an instance's xz or so: edge on. */
static void look(struct prng *p, struct world *w, uint16_t h)
{
    struct zs_camera *c = &w->camera;
    const struct zs_instance *in = &w->instance[prng_pick(p, w->scene.n_instances)];
    const int64_t size = reach_of(in) + 2;
    const int32_t away = (int32_t)(size << prng_pick(p, 9)) / (1 + prng_range(p, 0, 7)) + 1;
    const int32_t near = prng_pick(p, 3) ? away / (2 + prng_range(p, 0, 200)) + 1 : 1 + prng_range(p, 0, away);
    const int32_t far = near + 1 + away * (1 + prng_range(p, 0, 3));
    int32_t at[3], eye[3];
    if (prng_pick(p, 4))
        (void)zs_camera_perspective(c, (zs_turn)(400 + prng_pick(p, 15000)), h, near, far);
    else
        (void)zs_camera_orthographic(c, 1 + (int32_t)(size << prng_pick(p, 3)), prng_pick(p, 2) ? -far : near, far);
    for (int k = 0; k < 3; k++)
        at[k] = in->pose.pos[k] + (prng_pick(p, 2) ? (int32_t)(prng_range(p, -100, 100) * size / 100) : 0);
    (void)zs_camera_orbit(c, at, away, (zs_turn)prng_next(p), (int16_t)prng_range(p, -16000, 16000));
    if (prng_pick(p, 2))
        return;
    /* the eye in the plane y = 0 of the instance, and a little beside it */
    const int64_t x = prng_range(p, -away, away), z = prng_range(p, -away, away);
    const int64_t y = prng_pick(p, 8) ? prng_range(p, -away, away) >> (3 + prng_pick(p, 12)) : 0;
    for (int k = 0; k < 3; k++)
        eye[k] = in->pose.pos[k] + (int32_t)((in->pose.rot[3 * k] * x + in->pose.rot[3 * k + 1] * y +
                                             in->pose.rot[3 * k + 2] * z) / ZS_Q30_ONE);
    const int32_t up[3] = { prng_range(p, -9, 9), prng_range(p, -9, 9), prng_range(p, -9, 9) };
    (void)zs_camera_look_at(c, eye, at, up);
}

static void world_open(struct prng *p, struct world *w, uint16_t h)
{
    memset(w, 0, sizeof *w);
    for (int i = 0; i < SHAPES; i++) {
        shape_any(&w->shape[i], p);
        clusters_make(&w->shape[i].mesh, w->cluster[i], p, prng_pick(p, 3) ? 1 + prng_pick(p, 40) : 2, 9);
    }
    w->scene.instance = w->instance;
    w->scene.n_instances = 1 + prng_pick(p, INSTANCES);
    for (uint32_t i = 0; i < w->scene.n_instances; i++) {
        w->instance[i].mesh = &w->shape[prng_pick(p, SHAPES)].mesh;
        w->instance[i].material = &w->material[i];
        w->material[i].shader = shaders[prng_pick(p, 3)];
        w->material[i].rgb.r = (uint8_t)prng_next(p);
        w->material[i].rgb.g = 200;
        w->material[i].cull = (uint8_t)(prng_pick(p, 6) ? prng_pick(p, 2) : ZS_CULL_NONE);
        place(p, &w->instance[i], prng_pick(p, 3) ? 500 : 20000);
    }
    look(p, w, h);
}

/* ---- Clusters ------------------------------------------------------------------------------------------ */

static int same(const struct picture *a, const struct picture *b)
{
    return a->err || b->err ? a->err == b->err : picture_same(a, b, "test_cull");
}

/* Clusters that are left out where both sides of a triangle are drawn. */
static uint32_t out_without_cones(const struct zs_config *config, struct world *w)
{
    struct zs_material keep[INSTANCES];
    struct zs_config c = *config;
    c.max_tris = c.max_verts = 2000; /* counts are those of the first walk */
    memcpy(keep, w->material, sizeof keep);
    for (uint32_t i = 0; i < INSTANCES; i++)
        w->material[i].cull = ZS_CULL_NONE;
    struct picture p = picture_draw(&c, &w->scene, &w->camera);
    memcpy(w->material, keep, sizeof keep);
    picture_free(&p);
    return p.stats.clusters_culled;
}

static int clusters_of(uint64_t seed)
{
    static struct world w;
    struct prng p = { seed };
    const uint16_t width = (uint16_t)(8 + prng_pick(&p, 90)), height = (uint16_t)(8 + prng_pick(&p, 90));
    world_open(&p, &w, height);
    struct zs_config plain = picture_config(width, height,
                                            w.camera.projection ? &zs_depth_linear : persp[prng_pick(&p, 3)]);
    plain.subpixel_bits = prng_pick(&p, 2) ? 8 : 4;
    plain.max_tris = plain.max_verts = 20000;
    plain.fast = NULL;
    const struct picture want = picture_draw(&plain, &w.scene, &w.camera);
    int right = want.err || stats_add_up(&want.stats);
    reached.refused += want.err != 0;
    for (int k = 0; k < 4 && right; k++) {
        struct zs_config c = plain;
        const uint32_t of[4] = { FAST_ALL, FAST_ALL, prng_pick(&p, FAST_ALL + 1), FAST_CLUSTERS };
        const uint32_t list = k == 1 ? of[k] : of[k] & ~(uint32_t)FAST_TILES; /* what is behind is counted otherwise */
        c.fast = fast_of(list);
        if (k) {
            c.strip_h = (uint16_t)(1 + prng_pick(&p, height));
            c.max_tris = (uint16_t)(prng_pick(&p, 2) ? 2000 : 1 + prng_pick(&p, 60));
            c.max_verts = (uint16_t)(prng_pick(&p, 2) ? 2000 : 3 + prng_pick(&p, 150));
        }
        struct picture got = picture_draw(&c, &w.scene, &w.camera);
        right = same(&want, &got) && (got.err || stats_add_up(&got.stats)) &&
                (k == 1 || want.stats.tris_drawn == got.stats.tris_drawn);
        if (!right)
            case_wrong("%ux%u, %u sub-pixel bits, strips of %u, pools %u %u, list %x, projection %u, culls %u", width,
                       height, c.subpixel_bits, c.strip_h, c.max_tris, c.max_verts, list, w.camera.projection,
                       w.material[0].cull);
        if (!got.err && k == 0) {
            reached.frames++;
            reached.pixels += got.covered;
            reached.in += got.stats.clusters_in;
            reached.out += got.stats.clusters_culled;
            reached.verts += got.stats.verts_transformed;
            reached.verts_plain += want.stats.verts_transformed;
            CASE_CHECK(got.stats.verts_transformed <= want.stats.verts_transformed);
        }
        if (!got.err && k == 0)
            reached.by_cone += got.stats.clusters_culled - out_without_cones(&c, &w);
        picture_free(&got);
    }
    picture_free((struct picture *)&want);
    return right;
}

static void clusters_change_no_bit(void **state)
{
    memset(&reached, 0, sizeof reached);
    CASES(clusters_of, 6000);
    printf(
        "%lu frames (%lu refused), %lu pixels: %lu clusters, %lu left out, by cones alone %lu; vertices %lu of %lu\n",
        reached.frames, reached.refused, reached.pixels, reached.in, reached.out, reached.by_cone, reached.verts,
        reached.verts_plain);
    if (reached.frames > 2000)
        assert_true(reached.out > reached.in / 5 && reached.by_cone > reached.in / 20 &&
                    reached.frames * 100 < reached.pixels);
}

/* ---- Slivers ---------------------------------------------------------------------------------------- */

static uint32_t slivers_seen; /* frames in which a back face is drawn, as snapping has turned it round */

/* Clusters of height 1, a 16th of a step, in a mesh of few pixels: what may be off for a height is as much as a word
 * holds. */
static int sliver_case(uint64_t seed)
{
    enum { N = 12, HALF = 30000, BY = 2 * HALF / N };
    static int16_t pos[(N + 1) * (N + 1) + 3 * N][3];
    static uint16_t tri[(2 * N + 1) * N][3];
    static struct zs_cluster cluster[N];
    struct prng p = { seed };
    uint32_t n_verts = 0, n_tris = 0;
    for (int v = 0; v < (N + 1) * (N + 1); v++, n_verts++) {
        const int at[2] = { v % (N + 1), v / (N + 1) };
        for (int k = 0; k < 2; k++)
            pos[v][2 * k] = (int16_t)(at[k] == 0   ? -HALF
                                      : at[k] == N ? HALF
                                                   : at[k] * BY - HALF + prng_range(&p, -BY / 4, BY / 4));
    }
    for (int y = 0; y < N; y++) {
        struct zs_cluster *c = &cluster[y];
        *c = (struct zs_cluster){ .first = n_tris, .n_tris = 2 * N + 1, .axis = { 0, 127, 0 }, .cutoff = 1,
                                  .height = 1, .center = { 0, 0, (int16_t)(y * BY - HALF + BY / 2) },
                                  .radius = HALF + 2 * BY };
        for (int x = 0; x < N; x++, n_tris += 2) {
            const uint16_t a = (uint16_t)(y * (N + 1) + x), b = (uint16_t)(a + N + 1);
            const uint16_t two[2][3] = { { a, b, (uint16_t)(a + 1) }, { (uint16_t)(a + 1), b, (uint16_t)(b + 1) } };
            memcpy(tri[n_tris], two, sizeof two);
        }
        const int16_t z = c->center[2];
        const int16_t thin[3][3] = { { 0, 0, z }, { 1, 0, z }, { 9, 0, (int16_t)(z - 1) } };
        for (int k = 0; k < 3; k++) {
            memcpy(pos[n_verts], thin[k], sizeof thin[k]);
            tri[n_tris][k] = (uint16_t)n_verts++;
        }
        n_tris++;
    }
    struct zs_mesh mesh = { .pos = (const int16_t (*)[3])pos, .tri = (const uint16_t (*)[3])tri, .n_verts = n_verts,
                            .n_tris = n_tris, .scale = ZS_Q16_ONE, .radius = HALF + HALF / 2, .cluster = cluster,
                            .n_clusters = N };
    const struct zs_material white = { .shader = &zs_shade_flat, .rgb = { 255, 255, 255 } };
    const struct zs_instance in = { .mesh = &mesh, .material = &white };
    const struct zs_scene scene = { .instance = &in, .n_instances = 1 };
    struct zs_config c = picture_config(4, 4, &zs_depth_linear);
    c.subpixel_bits = 4;
    struct zs_camera camera;
    const int32_t per = 200000; /* units a pixel */
    CASE_CHECK(zs_mesh_check(&mesh, NULL) == ZS_FLAW_NONE);
    for (int k = 0; k < 20; k++) {
        const int32_t at[3] = { prng_range(&p, -per, per), 0, prng_range(&p, -per, per) };
        CASE_CHECK(!zs_camera_orthographic(&camera, 4 * per, 1000, 1000000) && /* from below: faces turn away */
                   !zs_camera_orbit(&camera, at, 500000, (zs_turn)prng_next(&p),
                                    (int16_t)prng_range(&p, -16383, -2000)));
        c.fast = NULL;
        struct picture want = picture_draw(&c, &scene, &camera);
        slivers_seen += want.covered > 0;
        c.fast = fast_all;
        struct picture is = picture_draw(&c, &scene, &camera);
        CASE_CHECK(picture_drawn_alike(&want, &is, "slivers"));
    }
    return 1;
}

/* ---- Instances --------------------------------------------------------------------------------------- */

static uint32_t beside; /* spheres outside the view whose triangles cover pixels */

/* Something far away makes camera units as long as world units. A small thing close to the eye is just outside the
 * frame, and its vertices, rounded to such units, may come to lie inside. It is drawn as it is with a sphere so large
 * that it is never culled. */
static int slack_case(uint64_t seed)
{
    static struct lone near;
    static struct zs_instance in[2];
    struct prng p = { seed };
    const int32_t focal = 3000, half = 45; /* px */
    const int axis = (int)(seed % 2u), sign = seed / 2u % 2u ? 1 : -1;
    const int32_t reach = 5120 + prng_range(&p, 0, 255); /* steps of 1/256: about 20 world units */
    int16_t pos[9][3];
    for (int k = 0; k < 9; k++) {
        int64_t square;
        do {
            square = 0;
            for (int j = 0; j < 3; j++) {
                pos[k][j] = (int16_t)prng_range(&p, -reach, reach);
                square += pos[k][j] * pos[k][j];
            }
        } while (square > reach * reach);
    }
    for (int k = 0; k < 2; k++) { /* towards the frame, 0.1 from the sphere's edge */
        pos[k][axis] = (int16_t)(-sign * (reach - 26));
        pos[k][!axis] = (int16_t)(k ? 512 : -512);
        pos[k][2] = 0;
    }
    lone_set(&near, (const int16_t (*)[3])pos, 9, ZS_Q16_ONE / 256);
    const int32_t z = 310 + prng_range(&p, 0, 400);
    const int32_t away = (256 * half * z / focal + reach) / 256 + 1;
    near.mesh.radius = (uint16_t)reach;
    for (int k = 0; k < 2; k++) {
        in[k] = near.instance;
        zs_pose_identity(&in[k].pose);
    }
    in[0].pose.pos[2] = 4096 - ZS_WORLD_MAX; /* in view, and far away */
    in[1].pose.pos[2] = -z;
    in[1].pose.pos[axis] = sign * away;
    near.scene.instance = in;
    near.scene.n_instances = 2;
    struct zs_camera camera;
    (void)zs_camera_perspective(&camera, 8000, 90, 280, ZS_WORLD_MAX);
    camera.focal = (zs_uq32_32)focal << 32;
    struct zs_config c = lone_config(90, 90, &zs_depth_float);
    c.fast = seed % 3 ? NULL : fast_all;
    struct picture got = picture_draw(&c, &near.scene, &camera);
    near.mesh.radius = 32767;
    c.fast = NULL;
    struct picture want = picture_draw(&c, &near.scene, &camera);
    const int right = same(&want, &got);
    const double gap = (away * focal - half * z) / sqrt(focal * focal + half * half) - (reach + 1) / 256.0;
    beside += want.covered > 20 && gap > 0;
    CASE_CHECK(want.err == ZS_OK);
    PICTURES_FREE(&want, &got);
    return right;
}

static uint64_t most_off; /* 1/65536 of its slack */

/* A sphere's centre is no farther from the exact one than its slack. */
static int bounds_case(uint64_t seed)
{
    struct prng p = { seed };
    const int32_t far = 2 << prng_pick(&p, 27), away = 2 << prng_pick(&p, 27);
    const int32_t at[3] = { prng_range(&p, -far, far), prng_range(&p, -far, far), prng_range(&p, -far, far) };
    struct zs_mesh mesh = { .scale = 1u + (prng_next(&p) >> (34 + prng_pick(&p, 28))), .radius = 100 };
    const struct zs_material material = { 0 };
    struct zs_instance in = { .mesh = &mesh, .material = &material };
    static struct zs_renderer r;
    struct zs_camera camera;
    struct zs_bounds b;
    zs_pose_identity(&in.pose);
    zs_pose_turn(&in.pose, (zs_turn)prng_next(&p), (zs_turn)prng_next(&p), (zs_turn)prng_next(&p));
    for (int k = 0; k < 3; k++) {
        mesh.center[k] = (int16_t)prng_next(&p);
        in.pose.pos[k] = prng_range(&p, -far, far);
    }
    CASE_CHECK(zs_camera_perspective(&camera, 8000, 90, 1, 1000) == ZS_OK);
    CASE_CHECK(zs_camera_orbit(&camera, at, away, (zs_turn)prng_next(&p), (int16_t)prng_range(&p, -16000, 16000)) ==
               ZS_OK);
    r.camera = camera;
    CASE_CHECK(zs_cull_bounds(&b, &r, &in) == ZS_OK);
    const long double one = ZS_Q30_ONE, scale = (long double)mesh.scale * in.pose.scale / 4294967296.0L;
    long double world[3];
    for (int k = 0; k < 3; k++) {
        world[k] = in.pose.pos[k] - camera.pos[k];
        for (int j = 0; j < 3; j++)
            world[k] += in.pose.rot[3 * k + j] / one * mesh.center[j] * scale;
    }
    for (int k = 0; k < 3; k++) {
        long double c = 0;
        for (int j = 0; j < 3; j++)
            c += (k ? -1 : 1) * camera.rot[3 * k + j] / one * world[j];
        const long double off = fabsl(c * 65536 - b.c[k]);
        if (off > b.slack)
            return case_wrong("axis %d is off by %.3Lf, the slack is %ld", k, off, (long)b.slack);
        most_off = off * 65536 / b.slack > most_off ? (uint64_t)(off * 65536 / b.slack) : most_off;
    }
    return 1;
}

static void a_center_is_as_exact_as_its_slack(void **state)
{
    most_off = 0;
    CASES(bounds_case, 4000);
    printf("off by up to %lu / 65536 of the slack\n", (unsigned long)most_off);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(clusters_change_no_bit),
    CASES_COUNT(slivers_that_snapping_turns_round, sliver_case, 1000, &slivers_seen, 1, "frames with slivers"),
    CASES_COUNT(what_rounding_moves_into_the_frame_is_drawn, slack_case, 1000,
                &beside, 20, "spheres beside the frame are drawn"),
    cmocka_unit_test(a_center_is_as_exact_as_its_slack),
};

CASES_MAIN(tests)
