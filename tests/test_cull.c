/* Clusters and groups: what is left out changes no pixel, no key and no camera unit.
 *
 * SPDX-License-Identifier: MIT
 */
#include <math.h>
#include <string.h>

#include "cases.h"
#include "clusters.h"
#include "picture.h"
#include "pipeline.h"
#include "shapes.h"

#define OFF (ZS_SKIP_CLUSTER | ZS_SKIP_CONE | ZS_SKIP_GROUP | ZS_SKIP_ROWS | ZS_SKIP_BEHIND) /* what is behind is counted otherwise */
#define SHAPES 3
#define INSTANCES 6

static struct {
    uint64_t frames, pixels, in, out, by_cone, by_sphere, verts, verts_plain, groups, refused;
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
    for (uint32_t z = 0; z < n; z++)
        for (uint32_t x = 0; x < n; x++) {
            const uint32_t a = z * (n + 1u) + x, b = a + n + 1u;
            shape_tri(s, a, b, a + 1u);
            shape_tri(s, a + 1u, b, b + 1u);
        }
    shape_end(s);
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
    case 1: shape_torus(s, 3 + prng_pick(p, 12), 3 + prng_pick(p, 12), 1200 << prng_pick(p, 4), 400 << prng_pick(p, 3)); break;
    case 2: shape_ground(s, 1 + prng_pick(p, 14), 500 << prng_pick(p, 6), 1 + prng_range(p, 0, 300), prng_next(p)); break;
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

static int clusters_of(uint64_t seed)
{
    static struct world w;
    struct prng p = { seed };
    const uint16_t width = (uint16_t)(8 + prng_pick(&p, 90)), height = (uint16_t)(8 + prng_pick(&p, 90));
    world_open(&p, &w, height);
    struct zs_config plain = picture_config(width, height, w.camera.projection ? &zs_depth_linear : persp[prng_pick(&p, 3)]);
    plain.subpixel_bits = prng_pick(&p, 2) ? 8 : 4;
    plain.max_tris = plain.max_verts = 20000;
    plain.skip_off = OFF;
    const struct picture want = picture_draw(&plain, &w.scene, &w.camera);
    int right = want.err || stats_add_up(&want.stats);
    reached.refused += want.err != 0;
    for (int k = 0; k < 4 && right; k++) {
        struct zs_config c = plain;
        c.skip_off = (uint16_t)(k < 2 ? 0 : k == 2 ? prng_pick(&p, ZS_SKIP_ALL + 1) : ZS_SKIP_CLUSTER);
        if (k != 1)
            c.skip_off |= ZS_SKIP_BEHIND;
        if (k) {
            c.strip_h = (uint16_t)(1 + prng_pick(&p, height));
            c.max_tris = (uint16_t)(prng_pick(&p, 2) ? 2000 : 1 + prng_pick(&p, 60));
            c.max_verts = (uint16_t)(prng_pick(&p, 2) ? 2000 : 3 + prng_pick(&p, 150));
        }
        struct picture got = picture_draw(&c, &w.scene, &w.camera);
        right = same(&want, &got) && (got.err || stats_add_up(&got.stats)) &&
                (k == 1 || c.skip_off & ZS_SKIP_EMPTY || want.stats.tris_drawn == got.stats.tris_drawn);
        if (!right)
            case_wrong("%ux%u, %u sub-pixel bits, strips of %u, pools %u %u, skips off %u, projection %u, culls %u", width,
                       height, c.subpixel_bits, c.strip_h, c.max_tris, c.max_verts, c.skip_off, w.camera.projection,
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
        if (!got.err && k == 3)
            reached.by_cone += got.stats.clusters_culled;
        picture_free(&got);
    }
    picture_free((struct picture *)&want);
    return right;
}

static void clusters_change_no_bit(void **state)
{
    (void)state;
    memset(&reached, 0, sizeof reached);
    CASES(clusters_of, 6000);
    printf("%lu frames (%lu refused), %lu pixels: %lu clusters, %lu left out, by cones alone %lu; vertices %lu of %lu\n",
           reached.frames, reached.refused, reached.pixels, reached.in, reached.out, reached.by_cone, reached.verts,
           reached.verts_plain);
    if (reached.frames > 2000)
        assert_true(reached.out > reached.in / 5 && reached.by_cone > reached.in / 20 && reached.frames * 100 < reached.pixels);
}

/* ---- Groups -------------------------------------------------------------------------------------------- */

#define CROWD 300

struct crowd {
    struct shape shape[SHAPES];
    struct zs_material material[3];
    struct zs_instance instance[CROWD];
    struct zs_group group[ZS_GROUPS_MAX(CROWD)];
    struct zs_groups groups;
    struct zs_scene scene;
    struct zs_camera camera;
};

/* Along a line, in heaps on a plane, or in heaps anywhere; some far out, at the world's end, or turned about a point that is far away. */
static void crowd_place(struct prng *p, struct crowd *w, uint32_t i, int32_t far, uint32_t kind)
{
    struct zs_instance *in = &w->instance[i];
    place(p, in, far / 16 + 1);
    for (int k = 0; k < 3; k++) {
        const int64_t along = (int64_t)far * ((int32_t)i - CROWD / 2) / CROWD;
        const int32_t heap = i % 16u ? w->instance[i - 1].pose.pos[k] / 64 * 63 : prng_range(p, -far, far);
        in->pose.pos[k] += (int32_t)(kind == 0 ? along : kind == 1 && k == 1 ? 0 : heap);
        if (!prng_pick(p, 300))
            in->pose.pos[k] = prng_pick(p, 2) ? ZS_WORLD_MAX : -ZS_WORLD_MAX;
        if (in->pose.pos[k] > ZS_WORLD_MAX || in->pose.pos[k] < -ZS_WORLD_MAX)
            in->pose.pos[k] = ZS_WORLD_MAX;
    }
}

/* Groups by hand: runs of any length, spheres somewhat larger than needed, each in a larger one. */
static void groups_by_hand(struct prng *p, struct crowd *w)
{
    uint32_t n = 0;
    for (uint32_t i = 0; i < w->scene.n_instances && n + 2 < ZS_GROUPS_MAX(CROWD);) {
        const uint32_t left = w->scene.n_instances - i, most = 1 + prng_pick(p, 60), count = most < left ? most : left;
        struct zs_group *g = &w->group[n];
        struct zs_group made[ZS_GROUPS_MAX(60)];
        uint32_t got;
        if (prng_pick(p, 6)) { /* the root of what is built, and perhaps what is built within */
            assert_int_equal(zs_groups_build(made, ZS_GROUPS_MAX(60), w->instance + i, count, &got), ZS_OK);
            if (n + got > ZS_GROUPS_MAX(CROWD) || prng_pick(p, 2))
                got = 1;
            for (uint32_t k = 0; k < got; k++) {
                g[k] = made[k];
                g[k].first = (uint16_t)(g[k].first + i);
                g[k].next = (uint16_t)(g[k].next + n);
                g[k].radius += prng_pick(p, 3) ? 0u : g[k].radius / 16u;
            }
            if (got == 1)
                g->next = (uint16_t)(n + 1);
            n += got;
        }
        i += count + (prng_pick(p, 2) ? 0 : prng_pick(p, 5)); /* some are in no group */
    }
    w->groups.n_groups = n;
}

static void crowd_open(struct prng *p, struct crowd *w, uint16_t h)
{
    memset(w, 0, sizeof *w);
    for (int i = 0; i < SHAPES; i++) {
        w->material[i].shader = shaders[prng_pick(p, 2)];
        w->material[i].rgb.r = (uint8_t)prng_next(p);
        shape_soup(&w->shape[i], 2 + prng_pick(p, 8), 20 << prng_pick(p, 8), prng_next(p));
        if (!prng_pick(p, 3)) { /* far from where it turns */
            struct zs_mesh *m = &w->shape[i].mesh;
            const int32_t by = prng_range(p, -20000, 20000);
            for (uint32_t v = 0; v < m->n_verts; v++)
                w->shape[i].pos[v][0] = (int16_t)(w->shape[i].pos[v][0] + by);
            m->center[0] = (int16_t)(m->center[0] + by);
        }
    }
    w->scene.instance = w->instance;
    w->scene.n_instances = 1 + prng_pick(p, CROWD);
    const int32_t far = 1000 << prng_pick(p, 12);
    const uint32_t kind = prng_pick(p, 3);
    for (uint32_t i = 0; i < w->scene.n_instances; i++) {
        const uint32_t k = prng_pick(p, SHAPES);
        w->instance[i].mesh = &w->shape[k].mesh;
        w->instance[i].material = &w->material[k];
        crowd_place(p, w, i, far, kind);
        w->instance[i].pose.scale = ZS_Q16_ONE * (1u + (uint32_t)far / 16384u);
    }
    const struct zs_groups groups = ZS_GROUPS(w->group, 0);
    w->groups = groups;
    w->scene.groups = &w->groups;
    if (prng_pick(p, 2))
        groups_by_hand(p, w);
    else
        assert_int_equal(zs_groups_build(w->group, ZS_GROUPS_MAX(CROWD), w->instance, w->scene.n_instances,
                                         &w->groups.n_groups), ZS_OK);
    const int32_t *pos = w->instance[prng_pick(p, w->scene.n_instances)].pose.pos;
    const int32_t away = 1 + prng_range(p, 0, far) / (1 + prng_range(p, 0, 15));
    const int32_t near = 1 + prng_range(p, 0, away >> prng_pick(p, 10)), end = near + 1 + away * (1 + prng_range(p, 0, 3));
    int32_t at[3];
    for (int k = 0; k < 3; k++)
        at[k] = pos[k] + prng_range(p, -100, 100);
    if (prng_pick(p, 4))
        (void)zs_camera_perspective(&w->camera, (zs_turn)(400 + prng_pick(p, 15000)), h, near, end);
    else
        (void)zs_camera_orthographic(&w->camera, 1 + (far >> prng_pick(p, 4)), prng_pick(p, 2) ? -end : near, end);
    (void)zs_camera_orbit(&w->camera, at, away, (zs_turn)prng_next(p), (int16_t)prng_range(p, -16000, 16000));
}

/* The units that a frame would be drawn in; what begin says. */
static int units(const struct zs_config *c, const struct crowd *w, int32_t *shift)
{
    static uint32_t arena[200000];
    static struct zs_renderer r;
    assert_int_equal(zs_init(&r, c, arena, sizeof arena), ZS_OK);
    const int err = zs_frame_begin(&r, &w->scene, &w->camera);
    *shift = r.view.shift;
    return err;
}

static int groups_of(uint64_t seed)
{
    static struct crowd w;
    struct prng p = { seed };
    const uint16_t width = (uint16_t)(8 + prng_pick(&p, 60)), height = (uint16_t)(8 + prng_pick(&p, 60));
    uint32_t at = 0;
    crowd_open(&p, &w, height);
    CASE_CHECK(zs_groups_check(&w.scene, &at) == ZS_FLAW_NONE);
    struct zs_config plain = picture_config(width, height, w.camera.projection ? &zs_depth_linear : persp[prng_pick(&p, 3)]);
    plain.skip_off = ZS_SKIP_GROUP | ZS_SKIP_BEHIND;
    struct zs_config c = plain;
    c.skip_off = ZS_SKIP_BEHIND;
    int32_t shift[2];
    CASE_CHECK(units(&plain, &w, &shift[0]) == units(&c, &w, &shift[1]) && shift[0] == shift[1]);
    struct picture want = picture_draw(&plain, &w.scene, &w.camera);
    int right = 1;
    reached.refused += want.err != 0;
    for (int k = 0; k < 2 && right; k++) {
        c.strip_h = (uint16_t)(k ? 1 + prng_pick(&p, height) : height);
        c.max_tris = (uint16_t)(k ? 1 + prng_pick(&p, 60) : 4000);
        c.max_verts = (uint16_t)(k ? 3 + prng_pick(&p, 150) : 4000);
        struct picture got = picture_draw(&c, &w.scene, &w.camera);
        const struct zs_stats *a = &got.stats, *b = &want.stats;
        right = same(&want, &got) &&
                (got.err || (stats_add_up(a) && a->instances_in <= b->instances_in && a->tris_drawn == b->tris_drawn &&
                             a->tris_empty == b->tris_empty && a->tris_offscreen == b->tris_offscreen &&
                             a->tris_clipped == b->tris_clipped));
        if (!right)
            case_wrong("%u instances, %u groups", w.scene.n_instances, w.groups.n_groups);
        if (!got.err && k == 0) {
            reached.frames++;
            reached.pixels += got.covered;
            reached.in += want.stats.instances_in;
            reached.out += want.stats.instances_in - got.stats.instances_in;
            reached.verts += want.stats.instances_culled;
        }
        picture_free(&got);
    }
    picture_free(&want);
    return right;
}

static void groups_change_no_bit(void **state)
{
    (void)state;
    memset(&reached, 0, sizeof reached);
    CASES(groups_of, 3000);
    printf("%lu frames (%lu refused), %lu pixels: %lu instances, %lu out of view, %lu never looked at\n", reached.frames,
           reached.refused, reached.pixels, reached.in, reached.verts, reached.out);
    if (reached.frames > 1000)
        assert_true(reached.out > reached.in / 5 && reached.out < reached.verts && reached.pixels > reached.frames * 30);
}

/* Instances of a group that is out of view are not looked at, and no bytes of groups lead anywhere else. */
static void groups_of_any_bytes_are_harmless(void **state)
{
    (void)state;
    static struct crowd w;
    for (uint64_t seed = 1; seed <= 400; seed++) {
        struct prng p = { seed };
        crowd_open(&p, &w, 20);
        for (uint32_t n = 1 + prng_pick(&p, 20); n && w.groups.n_groups; n--)
            ((uint8_t *)w.group)[prng_pick(&p, w.groups.n_groups * (uint32_t)sizeof *w.group)] = (uint8_t)prng_next(&p);
        (void)zs_groups_check(&w.scene, NULL);
        struct zs_config c = picture_config(20, 20, w.camera.projection ? &zs_depth_linear : &zs_depth_float);
        struct picture got = picture_draw(&c, &w.scene, &w.camera);
        picture_free(&got);
    }
    struct prng p = { 5 };
    do
        crowd_open(&p, &w, 20);
    while (w.scene.n_instances < 20 || w.camera.projection);
    struct zs_instance *in = w.instance;
    struct zs_group away[2] = { { .radius = 1, .origins = 1, .first = 0, .n = 1, .next = 1 },
                                { .radius = 1, .origins = 1, .first = 2, .n = 7, .next = 2 } };
    for (int k = 0; k < 3; k++) /* behind the eye */
        away[0].center[k] = away[1].center[k] = w.camera.pos[k] + w.camera.rot[6 + k] / 1000;
    const struct zs_groups groups = ZS_GROUPS(away, 2);
    w.scene.groups = &groups;
    struct zs_config c = picture_config(20, 20, &zs_depth_float);
    in[0].mesh = NULL;
    for (int i = 2; i < 9; i++)
        in[i].material = NULL;
    w.camera.z_near = (zs_q48_16)65536 * 400000; /* instances are allowed to be in view, but not too near */
    w.camera.z_far = (zs_q48_16)65536 * 9000000;
    struct picture got = picture_draw(&c, &w.scene, &w.camera);
    assert_int_equal(got.err, ZS_OK);
    assert_int_equal(got.stats.instances_in, w.scene.n_instances - 8u);
    picture_free(&got);
    c.skip_off = ZS_SKIP_GROUP;
    got = picture_draw(&c, &w.scene, &w.camera);
    assert_int_equal(got.err, ZS_ERR_NULL);
    picture_free(&got);
    const struct zs_groups none = { .group = away, .n_groups = 2 }, no_array = ZS_GROUPS(NULL, 1);
    w.scene.groups = &none;
    got = picture_draw(&c, &w.scene, &w.camera);
    assert_int_equal(got.err, ZS_ERR_NULL);
    picture_free(&got);
    w.scene.groups = &no_array;
    got = picture_draw(&c, &w.scene, &w.camera);
    assert_int_equal(got.err, ZS_ERR_NULL);
    picture_free(&got);
}

/* A group that holds no more than one instance, near where the instance is just seen: it is never left out before that. */
static int edge_of_view(uint64_t seed)
{
    static uint32_t arena[20000];
    static struct zs_renderer r;
    static struct crowd w;
    struct prng p = { seed };
    struct zs_bounds b;
    crowd_open(&p, &w, 50);
    const struct zs_config c = picture_config(40, 50, w.camera.projection ? &zs_depth_linear : &zs_depth_float);
    struct zs_config small = c;
    small.max_tris = small.max_verts = 100;
    assert_int_equal(zs_init(&r, &small, arena, sizeof arena), ZS_OK);
    if (zs_frame_begin(&r, &w.scene, &w.camera))
        return 1;
    struct zs_instance *in = &w.instance[0];
    const int64_t far = 1 + (w.camera.z_far >> 15);
    int32_t seen = 0, gone = 1 << 20;
    int64_t from[3], dir[3];
    for (int k = 0; k < 3; k++) { /* from the middle of the view outwards, or away */
        from[k] = w.camera.pos[k] - ((w.camera.rot[6 + k] * ((w.camera.z_near >> 16) + 1)) >> 30);
        dir[k] = (prng_pick(&p, 3) ? w.camera.rot[k + 3 * prng_pick(&p, 2)] : -w.camera.rot[6 + k]) *
                 (far > 1 << 28 ? 1 << 28 : far) >> 30;
    }
#define MOVE(t)                                                                          \
    do {                                                                                 \
        for (int k = 0; k < 3; k++) {                                                    \
            const int64_t to = from[k] + dir[k] * (t) / (1 << 18);                       \
            in->pose.pos[k] = (int32_t)(to > ZS_WORLD_MAX ? ZS_WORLD_MAX : to < -ZS_WORLD_MAX ? -ZS_WORLD_MAX : to); \
        }                                                                                \
        assert_int_equal(zs_cull_bounds(&b, in, &r.camera), ZS_OK);                      \
    } while (0)
    while (gone - seen > 1) {
        const int32_t t = (seen + gone) / 2;
        MOVE(t);
        *(zs_cull_sphere(&b, &r.camera, &r.view) ? &gone : &seen) = t;
    }
    w.scene.n_instances = 1;
    for (int32_t t = gone - 200; t < gone + 200; t++) {
        MOVE(t);
        assert_int_equal(zs_groups_build(w.group, 1, in, 1, &w.groups.n_groups), ZS_OK);
        r.group = 0;
        r.group_slack = 0;
        const int left_out = zs_cull_next(&r, &w.scene, 0) != 0, culled = zs_cull_sphere(&b, &r.camera, &r.view);
        CASE_CHECK(culled || !left_out);
        reached.in += (uint64_t)culled;
        reached.out += (uint64_t)left_out;
    }
    return 1;
}

static void groups_are_left_out_later_than_instances(void **state)
{
    (void)state;
    memset(&reached, 0, sizeof reached);
    CASES(edge_of_view, 1500);
    printf("%lu instances culled, %lu groups of one\n", reached.in, reached.out);
    if (reached.in > 10000)
        assert_true(reached.out > reached.in / 10);
}

/* ---- Building and checking ------------------------------------------------------------------------------- */

#define MANY 65535u

static void the_builder_takes_any_number(void **state)
{
    (void)state;
    static struct zs_instance in[MANY];
    static struct zs_group group[ZS_GROUPS_MAX(MANY)];
    static const struct zs_mesh mesh = { .scale = ZS_Q16_ONE, .radius = 3, .center = { 5, 0, 0 } };
    struct zs_groups groups = ZS_GROUPS(group, 0);
    struct zs_scene scene = { .instance = in, .groups = &groups };
    static const uint32_t counts[] = { 0, 1, 7, 8, 9, 63, 64, 65, 511, 512, 513, 4096, 4097, 40000, MANY };
    uint32_t at;
    for (uint32_t i = 0; i < MANY; i++) {
        in[i].mesh = &mesh;
        zs_pose_identity(&in[i].pose);
        in[i].pose.pos[0] = (int32_t)i * 8000 - ZS_WORLD_MAX / 2;
    }
    for (size_t k = 0; k < sizeof counts / sizeof counts[0]; k++) {
        scene.n_instances = counts[k];
        assert_int_equal(zs_groups_build(group, ZS_GROUPS_MAX(counts[k]), in, counts[k], &groups.n_groups), ZS_OK);
        assert_int_equal(zs_groups_check(&scene, &at), ZS_FLAW_NONE);
        assert_true(groups.n_groups >= counts[k] / 8u && groups.n_groups <= ZS_GROUPS_MAX(counts[k]));
        if (counts[k] > 8) { /* one holds all, and no more than it has to */
            assert_int_equal(group[0].n, counts[k]);
            assert_int_equal(group[0].next, groups.n_groups);
            assert_true(group[0].radius >= (counts[k] - 1u) * 4000u && group[0].radius <= counts[k] * 4000u + 100u);
        }
    }
    uint32_t n = 9;
    assert_int_equal(zs_groups_build(group, 8, in, 100, &n), ZS_ERR_SIZE);
    assert_int_equal(n, 0);
    assert_int_equal(zs_groups_build(group, 99, in, 65536, &n), ZS_ERR_SIZE);
    assert_int_equal(zs_groups_build(NULL, 99, in, 10, &n), ZS_ERR_NULL);
    assert_int_equal(zs_groups_build(group, 99, NULL, 10, &n), ZS_ERR_NULL);
    assert_int_equal(zs_groups_build(group, 99, in, 10, NULL), ZS_ERR_NULL);
    /* spheres as far apart as worlds are, and beyond what a radius holds */
    static const struct zs_mesh far_off = { .scale = 65535u * 32768u, .radius = 0, .center = { 32767, 0, 0 } };
    const int32_t ends[] = { ZS_WORLD_MAX, ZS_WORLD_MAX / 2, 0, -ZS_WORLD_MAX };
    for (size_t k = 0; k < sizeof ends / sizeof *ends; k++) {
        struct zs_instance two[2] = { { .mesh = &far_off }, { .mesh = &far_off } };
        struct zs_group got[2];
        for (int side = 0; side < 2; side++) {
            zs_pose_identity(&two[side].pose);
            zs_pose_turn(&two[side].pose, side ? 32768u : 0u, 0, 0);
            two[side].pose.pos[0] = side ? -ends[k] : ends[k];
        }
        const int64_t reach = (int64_t)32767 * 32768 + ends[k]; /* of each, from the middle */
        const int err = zs_groups_build(got, 2, two, 2, &n);
        assert_int_equal(err, ZS_OK);
        assert_true((int64_t)got[0].radius >= reach && (int64_t)got[0].radius < reach + (1 << 18));
    }
    static const struct zs_mesh farther = { .scale = 65535u * 32768u, .radius = 0, .center = { 32767, 32767, 32767 } };
    /* its diagonal along x, to the right and to the left */
    static const zs_q2_30 along_x[9] = { 619925131, 619925131, 619925131, 759250125, -759250125, 0, 438353264, 438353264,
                                         -876706528 };
    struct zs_instance two[2] = { { .mesh = &farther }, { .mesh = &farther } };
    struct zs_group got[2];
    for (int side = 0; side < 2; side++) {
        zs_pose_identity(&two[side].pose);
        for (int k = 0; k < 9; k++)
            two[side].pose.rot[k] = side && k < 6 ? -along_x[k] : along_x[k];
    }
    assert_int_equal(zs_groups_build(got, 2, two, 2, &n), ZS_OK); /* 1.86e9 from the middle */
    assert_true(got[0].radius > 1859000000u && got[0].radius < 1862000000u);
    for (int side = 0; side < 2; side++)
        two[side].pose.pos[0] = side ? -ZS_WORLD_MAX : ZS_WORLD_MAX;
    assert_int_equal(zs_groups_build(got, 2, two, 2, &n), ZS_ERR_RANGE);
    struct zs_group held = { .n = 1, .next = 1, .center = { INT32_MAX, 0, 0 }, .radius = INT32_MAX, .origins = INT32_MAX };
    const struct zs_groups one_group = { .kernel = &zs_group_kernel, .group = &held, .n_groups = 1 };
    const struct zs_scene far_scene = { .instance = two, .n_instances = 1, .groups = &one_group };
    zs_pose_identity(&two[0].pose);
    static const struct zs_mesh tiny = { .scale = 1, .radius = 0 };
    two[0].mesh = &tiny;
    two[0].pose.pos[0] = -ZS_WORLD_MAX;
    for (uint32_t more = 0; more < 2; more++) { /* a center that no sphere can have */
        held.radius = held.origins = (uint32_t)INT32_MAX + more;
        assert_int_equal(zs_groups_check(&far_scene, &at), ZS_FLAW_GROUP_SPHERE);
    }
    in[3].pose.pos[1] = ZS_WORLD_MAX + 1;
    assert_int_equal(zs_groups_build(group, 99, in, 10, &n), ZS_ERR_RANGE);
    in[3].pose.pos[1] = 0;
    in[3].mesh = NULL;
    assert_int_equal(zs_groups_build(group, 99, in, 10, &n), ZS_ERR_NULL);
}

#define FLAWED(change, flaw, where)                                   \
    do {                                                              \
        struct zs_group kept[32];                                     \
        memcpy(kept, group, sizeof kept);                             \
        change;                                                       \
        assert_int_equal(zs_groups_check(&scene, &at), flaw);         \
        assert_int_equal(at, where);                                  \
        memcpy(group, kept, sizeof kept);                             \
    } while (0)

static void the_check_names_the_flaw(void **state)
{
    (void)state;
    static struct zs_instance in[70];
    struct zs_group group[32];
    static const struct zs_mesh mesh = { .scale = ZS_Q16_ONE, .radius = 3 };
    struct zs_groups groups = ZS_GROUPS(group, 0);
    struct zs_scene scene = { .instance = in, .n_instances = 70, .groups = &groups };
    uint32_t at;
    for (uint32_t i = 0; i < 70; i++) {
        in[i].mesh = &mesh;
        zs_pose_identity(&in[i].pose);
        in[i].pose.pos[i % 3u] = (int32_t)i * 100;
    }
    assert_int_equal(zs_groups_build(group, 32, in, 70, &groups.n_groups), ZS_OK);
    assert_int_equal(groups.n_groups, 26); /* all; 64 and its 4 of 4 of 4; 6, again 6, 4 and 2 */
    FLAWED(, ZS_FLAW_NONE, 0);
    FLAWED(group[0].n++, ZS_FLAW_GROUPS, 0);
    FLAWED(group[3].n = 0, ZS_FLAW_GROUPS, 3);
    FLAWED(group[2].next = 2, ZS_FLAW_GROUPS, 2);
    FLAWED(group[25].next = 27, ZS_FLAW_GROUPS, 25);
    FLAWED(group[1].n = 63, ZS_FLAW_GROUPS, 17);
    FLAWED(group[4].first--, ZS_FLAW_GROUPS, 3);
    FLAWED(group[1].next = 21, ZS_FLAW_GROUPS, 1);
    for (uint32_t g = 0; g < 26; g++) {
        FLAWED(group[g].radius /= 2, ZS_FLAW_GROUP_SPHERE, g);
        FLAWED(group[g].radius = UINT32_MAX, ZS_FLAW_GROUP_SPHERE, g);
        FLAWED(group[g].origins /= 2, ZS_FLAW_GROUP_ORIGINS, g);
        FLAWED(group[g].radius += 20; group[g].origins += 20, ZS_FLAW_NONE, 0);
    }
    groups.n_groups = 65536; /* neither is read then */
    FLAWED(, ZS_FLAW_COUNT, 65536);
    groups.n_groups = 26;
    scene.n_instances = 65536;
    FLAWED(, ZS_FLAW_COUNT, 26);
    scene.n_instances = 70;
    in[69].mesh = NULL;
    FLAWED(, ZS_FLAW_GROUP_SPHERE, 0);
    scene.n_instances = 69;
    FLAWED(, ZS_FLAW_GROUPS, 0);
    scene.groups = NULL;
    FLAWED(, ZS_FLAW_NULL, 0);
    assert_int_equal(zs_groups_check(NULL, &at), ZS_FLAW_NULL);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(clusters_change_no_bit),
    cmocka_unit_test(groups_change_no_bit),
    cmocka_unit_test(groups_are_left_out_later_than_instances),
    cmocka_unit_test(groups_of_any_bytes_are_harmless),
    cmocka_unit_test(the_builder_takes_any_number),
    cmocka_unit_test(the_check_names_the_flaw),
};

CASES_MAIN(tests)
