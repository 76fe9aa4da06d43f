/* Vertices and light: the 32-bit kernels against the same sums in 64 and 128 bits, bit for bit.
 *
 * SPDX-License-Identifier: MIT
 */
#include <string.h>

#include "cases.h"
#include "internals.h"

#define N_VERTS 40

struct setting { /* a renderer brought to where bin.c walks an instance */
    struct zs_renderer r;
    struct zs_mesh mesh;
    struct zs_material material;
    struct zs_instance in;
    struct zs_scene scene;
    struct zs_camera camera;
    struct zs_config config;
    int16_t pos[N_VERTS][3];
    uint32_t arena[4096];
};

static int16_t coordinate(struct prng *p)
{
    static const int16_t edge[4] = { -32768, 32767, -1, 0 };
    return prng_pick(p, 3) ? (int16_t)prng_log(p) : edge[prng_pick(p, 4)];
}

/* Return 0 where the renderer refuses the scene, or sees nothing of it. */
static int set_up(struct setting *s, struct prng *p)
{
    static const struct zs_depth *const depth[3] = { &zs_depth_linear, &zs_depth_recip, &zs_depth_float };
    memset(s, 0, sizeof *s);
    for (int v = 0; v < N_VERTS; v++)
        for (int k = 0; k < 3; k++)
            s->pos[v][k] = coordinate(p);
    s->mesh.pos = s->pos;
    s->mesh.n_verts = N_VERTS;
    s->mesh.radius = 56756; /* 32768 sqrt 3 */
    s->mesh.scale = 1u + prng_pick(p, 1u << prng_pick(p, 30));
    s->material.shader = &zs_shade_flat;
    s->in.mesh = &s->mesh;
    s->in.material = &s->material;
    zs_pose_identity(&s->in.pose);
    if (prng_pick(p, 4))
        zs_pose_turn(&s->in.pose, (zs_turn)prng_next(p), (zs_turn)prng_next(p), (zs_turn)prng_next(p));
    for (int k = 0; k < 3; k++)
        s->in.pose.pos[k] = (int32_t)(prng_log(p) >> 34);
    s->scene.instance = &s->in;
    s->scene.n_instances = 1;
    const int32_t z_near = 1 + (int32_t)prng_pick(p, 1000), z_far = z_near + 1 + (int32_t)prng_pick(p, 1u << 29);
    const int ortho = prng_pick(p, 3) == 0;
    const int32_t deep = prng_pick(p, 2) ? z_far : 1 + (int32_t)prng_pick(p, 1000); /* few units: fine ones */
    if (ortho
            ? zs_camera_orthographic(&s->camera, 1 + (int32_t)prng_pick(p, 1u << (20 + prng_pick(p, 11))), -deep, deep)
            : zs_camera_perspective(&s->camera, (zs_turn)(1000 + prng_pick(p, 20000)), 240, z_near, z_far))
        return 0;
    const struct zs_config config = { .width = 240, .height = 240, .strip_h = 8, .max_tris = 8, .max_verts = 8,
                                      .buffers = 1, .subpixel_bits = (uint8_t)(prng_pick(p, 2) ? 8 : 4),
                                      .depth_bits = 16, .depth = depth[ortho ? 0 : prng_pick(p, 3)] };
    s->config = config;
    struct zs_bounds b;
    return !zs_init(&s->r, &config, s->arena, sizeof s->arena) && !zs_frame_begin(&s->r, &s->scene, &s->camera) &&
           !zs_cull_bounds(&b, &s->r, &s->in) && zs_xform_instance(&s->r, 0, &b);
}

static uint32_t looked_at[30]; /* vertices by shift */
static uint32_t tiny;          /* orthographic scenes that are smaller than a sub-pixel */

/* m . p + t of a row, and its shift; -1: a part of it is not in its range. */
static __int128 row_sum(const int32_t *row, const int16_t pos[3], int32_t *shift)
{
#if ZS_ROW_WIDE
    __int128 sum = (int64_t)((uint64_t)(uint32_t)row[4] << 32 | (uint32_t)row[3]);
    *shift = row[6] == 32 - row[5] ? row[5] : -1;
    for (int j = 0; j < 3; j++)
        sum += (int64_t)row[j] * pos[j];
    return sum;
#else
    const int32_t low_s = row[ZS_ROW_S];
    *shift = low_s + row[ZS_ROW_S2];
    if (low_s < 0 || low_s > 15 || *shift < low_s || (low_s != 15 && *shift != low_s) ||
        abs(row[ZS_ROW_T_LOW]) > 1 << 28)
        *shift = -1;
    __int128 sum = (__int128)row[ZS_ROW_T_HIGH] * (1 << *shift) + row[ZS_ROW_T_LOW];
    for (int j = 0; j < 3; j++) {
        if (abs(row[ZS_ROW_LOW + j]) > 1 << 14)
            *shift = -1;
        sum += ((int64_t)row[ZS_ROW_HIGH + j] * (1 << low_s) + row[ZS_ROW_LOW + j]) * (int64_t)pos[j];
    }
    return sum;
#endif
}

static int transform_case(uint64_t seed)
{
    struct prng p = { seed };
    static struct setting s;
    if (!set_up(&s, &p))
        return 1;
    for (int k = 0; k < 3; k++)
        for (uint32_t v = 0; v < N_VERTS; v++) {
            int32_t shift;
            const __int128 sum = row_sum(s.r.xform.row + k * ZS_ROW_WORDS, s.pos[v], &shift);
            CASE_CHECK(shift >= 0 && shift <= 29);
            struct zs_point point;
            zs_xform_vertex(&s.r.xform, v, &point);
            if ((__int128)point.c[k] != sum >> shift)
                return case_wrong("vertex %u, row %d, shift %d: %d", v, k, shift, point.c[k]);
            looked_at[shift]++;
        }
    return 1;
}

static void vertices_are_the_exact_sum_rounded_once(void **state)
{
    CASES(transform_case, 30000);
    uint32_t below = 0, above = 0;
    for (int k = 0; k < 30; k++)
        *(k <= 15 ? &below : &above) += looked_at[k];
    assert_true(!cases_all() || (below > 10000 && above > 10000 && looked_at[15] && looked_at[29]));
}

/* The screen position as the header of xform.c has it, with 128-bit products; 0 outside. */
static int exact_place(const struct zs_view *view, const struct zs_point *p, int32_t out[2])
{
    const int32_t most = (int32_t)ZS_GUARD_SUBPX, z = p->c[2], middle[2] = { view->cx, view->cy };
    int inside = 1;
    if (z < view->z_near || z > view->z_far)
        return 0;
    for (int k = 0; k < 2; k++) {
        const uint64_t mag = (uint64_t)(p->c[k] < 0 ? -(int64_t)p->c[k] : p->c[k]);
        const int lz = view->perspective ? __builtin_clz((unsigned)z) : 0;
        const int shift = view->snap + (view->perspective ? 63 - lz - view->scale_bits : view->scale_bits + 1);
        const __int128 product = (__int128)mag * (view->perspective ? zs_recip((uint32_t)z << lz) : 2u);
        __int128 v = (product + ((__int128)1 << (shift - 1))) >> shift << view->snap;
        if (v > most) {
            v = most + 1;
            inside = 0;
        }
        out[k] = middle[k] + (int32_t)(p->c[k] < 0 ? -v : v);
    }
    return inside;
}

static int project_case(uint64_t seed)
{
    struct prng p = { seed };
    static struct setting s;
    if (!set_up(&s, &p))
        return 1;
    const struct zs_view *view = &s.r.view;
    tiny += !view->perspective && view->scale_bits > 33;
    for (int n = 0; n < 200; n++) {
        struct zs_point point;
        for (int k = 0; k < 3; k++)
            point.c[k] = (int32_t)(prng_log(&p) >> 33);
        if (n % 4)
            point.c[2] = prng_range(&p, view->z_near, view->z_far);
        struct zs_vertex got;
        int32_t want[2] = { 0, 0 };
        const int inside = exact_place(view, &point, want);
        if (zs_xform_project(&s.r, &point, &got) != inside || (inside && (got.x != want[0] || got.y != want[1])))
            return case_wrong("(%d, %d, %d): (%d, %d), not (%d, %d), %d", point.c[0], point.c[1], point.c[2], got.x,
                              got.y, want[0], want[1], inside);
    }
    return 1;
}

/* ---- In one go (fast/screen.c) -------------------------------------------------------------------- */

static uint32_t inside, outside, untested; /* vertices; settings in which none needs a test */

static int far_apart(const struct zs_vertex *a, const struct zs_vertex *b)
{
    return llabs((int64_t)a->x - b->x) >= 65536 || llabs((int64_t)a->y - b->y) >= 65536;
}

/* Any run of them, and any of them: each as it is alone; those outside are far from all others. */
static int screen_case(uint64_t seed)
{
    struct prng p = { seed };
    static struct setting s;
    static uint8_t lo[N_VERTS][3];
    struct zs_vertex got[N_VERTS], want;
    struct zs_bounds b;
    if (!set_up(&s, &p))
        return 1;
    const int small = prng_pick(&p, 3) != 0; /* near its middle, so that it may be in view as a whole */
    for (int v = 0; v < N_VERTS; v++)
        for (int k = 0; k < 3; k++) {
            s.pos[v][k] = small ? (int16_t)prng_range(&p, -99, 99) : s.pos[v][k];
            lo[v][k] = (uint8_t)prng_next(&p);
        }
    s.mesh.radius = small ? 175 : 56758;
    if (prng_pick(&p, 2))
        s.mesh.pos_lo = (const uint8_t (*)[3])lo;
    if (zs_frame_begin(&s.r, &s.scene, &s.camera) || zs_cull_walk(&b, &s.r, 0) || !zs_xform_instance(&s.r, 0, &b))
        return 1;
    zs_screen_needs(&s.r, &b);
    untested += !s.r.xform.clip_depth && !s.r.xform.clip_guard;
    const uint32_t from = prng_pick(&p, N_VERTS), n = 1 + prng_pick(&p, N_VERTS - from);
    struct zs_point point;
    zs_xform_vertex(&s.r.xform, from, &point);
    if (prng_pick(&p, 3) == 0 && point.c[2] > s.r.view.z_near + 1) { /* far is where one of them is, or beside it */
        s.r.view.z_far = point.c[2] + prng_range(&p, -1, 1);
        s.r.xform.clip_depth = 1;
    }
    const int any = prng_pick(&p, 2) != 0;
    uint16_t number[N_VERTS]; /* runs of them, and some twice */
    for (uint32_t v = 0; v < n; v++)
        number[v] = (uint16_t)(!any ? from + v : v && prng_pick(&p, 2) ? (number[v - 1] + 1u) % N_VERTS
                                                                       : prng_pick(&p, N_VERTS));
    s.r.vert = got;
    s.r.vert_src = number;
    if (any)
        zs_screen_known(&s.r, 0, n);
    else
        zs_screen(&s.r, from, n, got);
    for (uint32_t v = 0; v < n; v++) {
        zs_xform_screen(&s.r, number[v], &want);
        const int out = want.d >= ZS_D_OUT;
        if (got[v].d != want.d || (!out && (got[v].x != want.x || got[v].y != want.y)))
            return case_wrong("vertex %u: (%d, %d, %u), not (%d, %d, %u)", number[v], got[v].x, got[v].y, got[v].d,
                              want.x, want.y, want.d);
        for (uint32_t k = 0; k < n && out; k++)
            CASE_CHECK(number[k] == number[v] || far_apart(&got[v], &got[k]));
        *(out ? &outside : &inside) += 1;
    }
    return 1;
}

/* ---- Light --------------------------------------------------------------------------------------- */

static uint32_t intensity(const struct zs_shading *s, const zs_q1_15 n[3])
{
    const struct zs_light *light = s->light;
    int64_t dot = 0;
    for (int k = 0; k < 3; k++)
        dot += (int64_t)n[k] * s->dir[k];
    if (dot <= 0)
        return light->ambient;
    const uint64_t lambert = (uint64_t)((dot + (dot >> 15)) >> 15);
    return light->ambient + (uint32_t)((light->diffuse * lambert + (1u << 29)) >> 30);
}

static int light_case(uint64_t seed)
{
    struct prng p = { seed };
    static const int32_t edge[4] = { ZS_Q30_ONE, -ZS_Q30_ONE, ZS_Q30_ONE + (1 << 10), -ZS_Q30_ONE - (1 << 10) };
    struct zs_light light;
    struct zs_shading s = { .light = &light };
    for (int n = 0; n < 100; n++) {
        zs_q1_15 normal[3];
        for (int k = 0; k < 3; k++) { /* as the frame's checks let them through: components, not lengths */
            s.dir[k] = prng_pick(&p, 3) ? prng_range(&p, edge[3], edge[2]) : edge[prng_pick(&p, 4)];
            normal[k] = coordinate(&p);
        }
        light.ambient = prng_pick(&p, ZS_Q16_ONE + 1);
        light.diffuse = prng_pick(&p, 2) ? ZS_Q16_ONE : prng_pick(&p, ZS_Q16_ONE + 1);
        const uint32_t want = intensity(&s, normal), got = zs_light_intensity(&s, normal);
        if (got != want)
            return case_wrong("intensity %u, not %u", got, want);
        for (uint32_t c = 0; c < 256; c++) {
            const uint64_t lit = ((uint64_t)(c * 257u) * want + 0x8000u) >> 16;
            CASE_CHECK(zs_light_channel((uint8_t)c, want) == (lit > 65535u ? 65535u : lit));
        }
    }
    return 1;
}

/* The focal length as a power of two and a factor of 1/2 to 1: the least bits, also where it is a power of two
 * itself. */
static void focal_lengths_keep_their_bits(void **state)
{
    static const struct zs_config config = { .width = 16, .height = 16, .strip_h = 16, .max_tris = 4, .max_verts = 4,
                                             .buffers = 1, .subpixel_bits = 8, .depth_bits = 16,
                                             .depth = &zs_depth_recip };
    struct prng p = { 1 };
    for (int k = 0; k < 2000; k++) {
        struct zs_view view;
        struct zs_camera camera;
        assert_int_equal(zs_camera_perspective(&camera, 8192, 16, 256, 1 << 14), ZS_OK);
        const uint64_t power = (uint64_t)1 << prng_range(&p, 36, 54); /* 16 px and more */
        camera.focal = k % 3 == 0 ? power : k % 3 == 1 ? power + 1u + prng_pick(&p, 3) : power + prng_next(&p) % power;
        zs_view_frame(&view, &config);
        assert_int_equal(zs_view_camera(&view, &config, &camera), ZS_OK);
        assert_int_equal(zs_view_units(&view, &camera, (int64_t)1 << 30), ZS_OK);
        assert_true(view.ratio >= 1 << 29 && view.ratio <= 1 << 30);
        assert_true(k % 3 || view.ratio == 1 << 30);
        const long double focal = (long double)camera.focal * 256 / 4294967296.0L; /* sub-pixels */
        const long double got = (long double)view.ratio / (1 << 30) * ((uint64_t)1 << view.scale_bits);
        assert_true(got > focal * (1 - 0x1p-29L) && got < focal * (1 + 0x1p-29L));
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(focal_lengths_keep_their_bits),
    cmocka_unit_test(vertices_are_the_exact_sum_rounded_once),
    CASES_COUNTS(projection_is_the_exact_product_rounded_once, project_case, 10000,
                 { "orthographic scenes smaller than a sub-pixel", &tiny, 4 }),
    CASES_COUNTS(in_one_go_as_one_by_one, screen_case, 20000,
                 { "vertices inside", &inside, 10000 }, { "vertices outside", &outside, 10000 },
                 { "meshes without a test", &untested, 1000 }),
    CASES_TEST(light_is_the_exact_product_rounded_once, light_case, 3000)
};

CASES_MAIN(tests)
