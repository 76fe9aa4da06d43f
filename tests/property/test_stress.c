/* The stress cases of clipping, coverage and depth, each by its number, through the public
 * interface. 17 is in test_rotation.c, 21 to 26 in test_invariance.c, 28 in checksum.c, 30 in
 * test_api.c.
 *
 * SPDX-License-Identifier: MIT
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cases.h"
#include "fast_lists.h"
#include "oracle.h"
#include "picture.h"
#include "internals.h"
#include "shapes.h"
#include "easel.h"

/* ---- Exact: one world unit is 1/256 px ------------------------------------------------------- */

struct exact_size {
    int32_t w, h;
};

static const struct exact_size exact_sizes[] = { { 96, 80 }, { 240, 240 }, { 33, 17 }, { 1, 1 } };

/* Draw a fan of n corners, x and y in sub-pixels from the frame's middle, y up, and compare its
 * pixels with the oracle's, piece by piece. */
static int exact_fan(const int16_t (*pos)[3], int n, int32_t w, int32_t h, int perspective)
{
    static struct lone l;
    lone_set(&l, pos, n, ZS_Q16_ONE);
    l.instance.pose.pos[2] = -PIXEL_Z;
    const struct zs_camera camera = pixel_camera(h, perspective);
    struct zs_config config = lone_config(w, h, perspective ? &zs_depth_recip : &zs_depth_linear);
    config.strip_h = (uint16_t)(1 + n % 7);
    struct picture p = picture_draw(&config, &l.scene, &camera);
    int ok = p.err ? case_wrong("%s", zs_error_string(p.err)) : stats_add_up(&p.stats);
    uint32_t hits = 0;
    for (int j = 0; j < h && ok; j++)
        for (int i = 0; i < w && ok; i++) {
            int want = 0;
            for (int t = n - 3; t >= 0; t--) {
                const int c[3] = { 0, t + 1, t + 2 };
                struct oracle_tri o;
                for (int k = 0; k < 3; k++) {
                    o.x[k] = w * 128 + pos[c[k]][0];
                    o.y[k] = h * 128 - pos[c[k]][1];
                }
                if (oracle_covers(&o, i, j)) {
                    want = t + 1;
                    hits++;
                }
            }
            if (p.color[j * w + i] != want)
                ok = case_wrong("pixel (%d, %d) is %u, not %d: (%d %d) (%d %d) (%d %d)", i, j,
                                p.color[j * w + i], want, pos[0][0], pos[0][1], pos[1][0],
                                pos[1][1], pos[2][0], pos[2][1]);
        }
    if (ok && hits != p.stats.pixels_tested)
        ok = case_wrong("%u pixels tested, %u covered", p.stats.pixels_tested, hits);
    picture_free(&p);
    return ok;
}

typedef void corner_fn(struct prng *p, int32_t w, int32_t h, int16_t pos[3][3]);

static int exact_case(uint64_t seed, corner_fn *corners)
{
    struct prng p = { seed };
    const struct exact_size *s = &exact_sizes[seed % 16 ? 0 : 1 + seed / 16 % 3];
    int16_t pos[3][3] = { { 0 } };
    corners(&p, s->w, s->h, pos);
    return exact_fan((const int16_t (*)[3])pos, 3, s->w, s->h, (int)(seed / 2 & 1));
}

static int32_t sample_at(struct prng *p, int32_t size)
{
    return prng_range(p, -2, size + 1) * 256 + 128 - size * 128;
}

static void sliver_corners(struct prng *p, int32_t w, int32_t h, int16_t pos[3][3])
{
    for (int v = 0; v < 2; v++) {
        pos[v][0] = (int16_t)prng_range(p, -w * 140, w * 140);
        pos[v][1] = (int16_t)prng_range(p, -h * 140, h * 140);
    }
    if (prng_pick(p, 3) == 0)
        pos[1][prng_pick(p, 2)] = (int16_t)(pos[0][0] + prng_range(p, -1, 1));
    const int32_t along = prng_range(p, 0, 256);
    for (int k = 0; k < 2; k++)
        pos[2][k] = (int16_t)(pos[0][k] + (pos[1][k] - pos[0][k]) * along / 256 +
                              prng_range(p, -1, 1));
}

static void center_corners(struct prng *p, int32_t w, int32_t h, int16_t pos[3][3])
{
    for (int v = 0; v < 3; v++) {
        pos[v][0] = (int16_t)sample_at(p, w);
        pos[v][1] = (int16_t)sample_at(p, h);
    }
}

static void beside_corners(struct prng *p, int32_t w, int32_t h, int16_t pos[3][3])
{
    center_corners(p, w, h, pos);
    for (int v = 0; v < 3; v++)
        for (int k = 0; k < 2; k++)
            pos[v][k] = (int16_t)(pos[v][k] + prng_range(p, -1, 1));
}

static void straight_corners(struct prng *p, int32_t w, int32_t h, int16_t pos[3][3])
{
    if (prng_pick(p, 2))
        center_corners(p, w, h, pos);
    else
        for (int v = 0; v < 3; v++) {
            pos[v][0] = (int16_t)prng_range(p, -w * 140, w * 140);
            pos[v][1] = (int16_t)prng_range(p, -h * 140, h * 140);
        }
    pos[1][0] = pos[0][0];
    if (prng_pick(p, 2))
        pos[2][1] = pos[0][1];
    if (prng_pick(p, 4) == 0)
        pos[1][1] = pos[2][1];
}

static int sliver_case(uint64_t seed)
{
    return exact_case(seed, sliver_corners);
}

static int center_case(uint64_t seed)
{
    return exact_case(seed, center_corners);
}

static int beside_case(uint64_t seed)
{
    return exact_case(seed, beside_corners);
}

static int straight_case(uint64_t seed)
{
    return exact_case(seed, straight_corners);
}

static void stress_04_zero_area_and_duplicate_vertices(void **state)
{
    struct prng p = { 4 };
    for (int n = 0; n < 200; n++) {
        int16_t pos[3][3] = { { 0 } };
        const int32_t dx = prng_range(&p, -60, 60), dy = prng_range(&p, -60, 60);
        for (int v = 0; v < 3; v++) { /* on a line: exactly no area */
            const int32_t s = n % 4 == 0 ? 0 : n % 4 == 1 ? v / 2 * 100 : prng_range(&p, -90, 90);
            pos[v][0] = (int16_t)(500 + dx * s);
            pos[v][1] = (int16_t)(-300 + dy * s);
        }
        struct lone l;
        lone_set(&l, (const int16_t (*)[3])pos, 3, ZS_Q16_ONE);
        if (n % 2)
            l.tri[0][2] = l.tri[0][n / 2 % 2]; /* a vertex named twice */
        l.instance.pose.pos[2] = -PIXEL_Z;
        const struct zs_camera camera = pixel_camera(80, n / 4 % 2);
        const struct zs_config config = lone_config(96, 80, n / 4 % 2 ? &zs_depth_recip
                                                                      : &zs_depth_linear);
        struct picture f = picture_draw(&config, &l.scene, &camera);
        assert_int_equal(f.err, ZS_OK);
        assert_int_equal(f.covered, 0);
        assert_int_equal(f.stats.pixels_tested, 0);
        assert_int_equal(f.stats.tris_zero, 1);
        assert_int_equal(f.stats.tris_drawn, 0);
        picture_free(&f);
    }
}

/* ---- Unsnapped: compared where the sample is further from an edge than rounding reaches ------ */

static struct oracle_view view_of(const struct zs_camera *c, int32_t w, int32_t h)
{
    const struct oracle_view v = {
        .focal = c->projection == ZS_PERSPECTIVE ? ldexp((double)c->focal, -32) : 0,
        .scale = c->projection == ZS_PERSPECTIVE ? 0 : h * 65536.0 / (double)c->height,
        .width = w, .height = h,
        .z_near = (double)c->z_near / 65536, .z_far = (double)c->z_far / 65536
    };
    return v;
}

/* Camera units are at least 2^28 to the reach; corners are off by 3 of them at most (xform.c). */
static double unit_of(double reach)
{
    return reach * 1.05 / 0x1p28;
}

static double pixel_slack(const struct oracle_view *v, double unit)
{
    return 0.006 + 3 * unit * (v->focal > 0 ? v->focal / v->z_near : v->scale);
}

static double key_slack(const struct oracle_view *v, double unit, int linear, int bits)
{
    const double top = ldexp(1, bits) - 1, n = v->z_near, f = v->z_far;
    return 3 * unit * top * (linear ? 1 / (f - n) : f / (n * (f - n))) + 0.001;
}

struct looked {       /* what a comparison met */
    uint64_t compared, doubtful;
    double worst_key; /* beyond what snapping explains, buckets */
};

static struct looked looked;

/* Compare a picture of one convex flat polygon with the oracle: color is drawn, 0 is nothing. */
static int polygon_right(const struct picture *f, const struct oracle_view *v,
                         const struct oracle_point *corner, int n, double unit, int linear,
                         int bits)
{
    struct oracle_polygon o;
    oracle_project(v, corner, n, &o);
    const double px = pixel_slack(v, unit), z_slack = key_slack(v, unit, linear, bits);
    const double top = ldexp(1, bits) - 2;
    for (int j = 0; j < f->h; j++)
        for (int i = 0; i < f->w; i++) {
            const double inside = oracle_inside(&o, i, j);
            const int drawn = f->key[j * f->w + i] != ZS_DEPTH_CLEAR;
            if (fabs(inside) <= px) {
                looked.doubtful++;
                continue;
            }
            looked.compared++;
            if (drawn != (inside > 0))
                return case_wrong("pixel (%d, %d) is %s, %.4f px %s", i, j,
                                  drawn ? "drawn" : "empty", fabs(inside),
                                  inside > 0 ? "inside" : "outside");
            if (!drawn)
                continue;
            const double want = fmin(oracle_key(v, oracle_z(v, &o, i, j), linear, bits), top);
            const double off = fabs(f->key[j * f->w + i] - want) - z_slack -
                               oracle_key_slack(v, &o, i, j, linear, bits, px);
            looked.worst_key = off > looked.worst_key ? off : looked.worst_key;
            if (off > 0.505)
                return case_wrong("key at (%d, %d) is %u, not %.3f", i, j, f->key[j * f->w + i],
                                  want);
        }
    return 1;
}

/* Draw one triangle, corners in world units, y up, z the distance; compare. */
static int clipped_tri(const int16_t pos[3][3], const struct zs_camera *camera, int32_t w,
                       int32_t h, const struct zs_depth *depth, struct zs_stats *stats)
{
    static struct lone l;
    int16_t away[3][3];
    struct oracle_point corner[3];
    for (int k = 0; k < 3; k++) {
        const int16_t p[3] = { pos[k][0], pos[k][1], (int16_t)-pos[k][2] };
        memcpy(away[k], p, sizeof p);
        corner[k].x = pos[k][0];
        corner[k].y = pos[k][1];
        corner[k].z = pos[k][2];
    }
    lone_set(&l, (const int16_t (*)[3])away, 3, ZS_Q16_ONE);
    struct zs_config config = lone_config(w, h, depth);
    config.strip_h = (uint16_t)(1 + (pos[0][0] & 15));
    struct picture f = picture_draw(&config, &l.scene, camera);
    const struct oracle_view v = view_of(camera, w, h);
    int ok = f.err ? case_wrong("%s", zs_error_string(f.err)) : 1;
    ok = ok && polygon_right(&f, &v, corner, 3, unit_of(57000), depth == &zs_depth_linear, 16);
    if (ok && (!stats_add_up(&f.stats) || f.stats.max_tris_used > 7 ||
               f.stats.pixels_tested != f.covered))
        ok = case_wrong("%u pieces, %u pixels tested, %u covered", f.stats.max_tris_used,
                        f.stats.pixels_tested, f.covered);
    if (!ok)
        (void)case_wrong("(%d %d %d) (%d %d %d) (%d %d %d), near %.6f far %.6f", pos[0][0],
                         pos[0][1], pos[0][2], pos[1][0], pos[1][1], pos[1][2], pos[2][0],
                         pos[2][1], pos[2][2], v.z_near, v.z_far);
    if (stats)
        *stats = f.stats;
    picture_free(&f);
    return ok;
}

#define CLIP_W 64
#define CLIP_H 48
#define CLIP_NEAR 100
#define CLIP_FAR 20000

static struct zs_camera clip_camera(int perspective)
{
    struct zs_camera c;
    if (perspective) {
        (void)zs_camera_perspective(&c, 8192, CLIP_H, CLIP_NEAR, CLIP_FAR);
        c.focal = (zs_uq32_32)200 << 32; /* 200 px: the guard band ends at x / z = 41 */
    } else {
        (void)zs_camera_orthographic(&c, 96, CLIP_NEAR,
                                     CLIP_FAR); /* 1/2 px a unit: it ends at 16376 */
    }
    return c;
}

static int16_t in_frame(struct prng *p, int32_t z, int perspective)
{
    const int32_t reach = perspective ? z * 24 / 200 : 48;
    return (int16_t)prng_range(p, -reach, reach);
}

/* ---- 14: 26 directions ----------------------------------------------------------------------- */

static void outside_corner(struct prng *p, const int dir[3], int16_t c[3])
{
    c[2] = (int16_t)(dir[2] < 0   ? prng_range(p, -30000, CLIP_NEAR - 1)
                     : dir[2] > 0 ? prng_range(p, CLIP_FAR + 1, 32767)
                                  : prng_range(p, CLIP_NEAR, 100 << prng_pick(p, 8)));
    for (int k = 0; k < 2; k++)
        c[k] = (int16_t)(dir[k] ? dir[k] * prng_range(p, 1 << prng_range(p, 0, 14), 32767)
                                : prng_range(p, -40, 40));
}

static uint32_t most_pieces;

static int direction_case(uint64_t seed)
{
    struct prng p = { seed };
    const int at = (int)(seed % 26), n = at < 13 ? at : at + 1; /* 13 is the middle */
    const int dir[3] = { n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1 };
    const uint32_t which = 1u + (uint32_t)(seed / 26 % 7); /* bits: corners outside */
    const int perspective = seed / 182 % 4 != 0;
    const struct zs_camera camera = clip_camera(perspective);
    int16_t pos[3][3];
    for (uint32_t k = 0; k < 3; k++) {
        if (which >> k & 1u) {
            /* in the same direction, or for the case of more than one also in another */
            const int turned[3] = { dir[1], dir[2], dir[0] };
            outside_corner(&p, k && prng_pick(&p, 2) ? turned : dir, pos[k]);
            continue;
        }
        pos[k][2] = (int16_t)prng_range(&p, CLIP_NEAR, 9000);
        pos[k][0] = in_frame(&p, pos[k][2], perspective);
        pos[k][1] = in_frame(&p, pos[k][2], perspective);
    }
    struct zs_stats stats;
    const struct zs_depth *depth = perspective && seed / 364 % 2 ? &zs_depth_recip
                                                                 : &zs_depth_linear;
    const int ok = clipped_tri((const int16_t (*)[3])pos, &camera, CLIP_W, CLIP_H, depth, &stats);
    most_pieces = stats.max_tris_used > most_pieces ? stats.max_tris_used : most_pieces;
    return ok;
}

static int most_corners;

/* How many corners the library's own stages leave of a triangle; 1: at most nine. */
static int corners_left(const int16_t away[3][3], const struct zs_camera *camera)
{
    static struct lone l;
    static uint32_t arena[16000];
    struct zs_renderer r;
    struct zs_bounds b;
    struct zs_clip_vertex cv[ZS_CLIP_MAX];
    lone_set(&l, away, 3, ZS_Q16_ONE);
    const struct zs_config config = lone_config(CLIP_W, CLIP_H, &zs_depth_linear);
    CASE_CHECK(!zs_init(&r, &config, arena, sizeof arena) && !zs_frame_begin(&r, &l.scene, camera));
    CASE_CHECK(!zs_cull_bounds(&b, &r, &l.instance) && zs_xform_instance(&r, 0, &b));
    for (uint32_t k = 0; k < 3; k++)
        zs_xform_vertex(&r.xform, k, &cv[k].p);
    const int n = zs_clip_polygon(&r.view, cv, 3, ZS_OUT_NEAR | ZS_OUT_FAR | ZS_OUT_SIDES, 0);
    most_corners = n > most_corners ? n : most_corners;
    return n <= 9 ? 1 : case_wrong("%d corners", n);
}

/* A triangle whose sides cut the corners off the hexagon in which its plane meets near, far and
 * guard: nine corners where it fits best. */
static int nonagon_case(uint64_t seed)
{
    struct prng p = { seed };
    struct zs_camera camera;
    /* 4 px a world unit: the guard band ends at 2047; near and far make a cube of it */
    (void)zs_camera_orthographic(&camera, CLIP_H / 4, CLIP_NEAR, CLIP_NEAR + 4094);
    const double half = 2047, size = half * prng_range(&p, 2449, 2828) / 1000;
    const double turn = prng_range(&p, 0, 6283) / 1000.0;
    int16_t pos[3][3];
    for (int k = 0; k < 3; k++) {
        const double u = size * cos(turn + k * 2.0943951), v = size * sin(turn + k * 2.0943951);
        pos[k][0] = (int16_t)(u * 0.70710678 + v * 0.40824829);
        pos[k][1] = (int16_t)(-u * 0.70710678 + v * 0.40824829);
        pos[k][2] = (int16_t)(CLIP_NEAR + half - v * 0.81649658);
    }
    struct zs_stats stats;
    const int ok = clipped_tri((const int16_t (*)[3])pos, &camera, CLIP_W, CLIP_H, &zs_depth_linear,
                               &stats);
    most_pieces = stats.max_tris_used > most_pieces ? stats.max_tris_used : most_pieces;
    for (int k = 0; k < 3; k++)
        pos[k][2] = (int16_t)-pos[k][2];
    return ok && corners_left((const int16_t (*)[3])pos, &camera);
}

static void stress_14_26_directions_by_1_2_3_vertices(void **state)
{
    looked = (struct looked){ 0, 0, 0 };
    CASES(direction_case, 26 * 7 * 24);
    CASES(nonagon_case, 300);
    assert_true(most_corners == 9 || !cases_all());
    print_message("clipped: %llu pixels compared, %llu too close to an edge to tell, keys within "
                  "%.4f bucket, at most a %d-gon, of which %u pieces met the frame\n",
                  (unsigned long long)looked.compared, (unsigned long long)looked.doubtful, looked.worst_key,
                  most_corners, most_pieces);
}

/* ---- 9 to 13 --------------------------------------------------------------------------------- */

static int guard_case(uint64_t seed)
{
    struct prng p = { seed };
    const int perspective = seed % 3 != 0;
    const struct zs_camera camera = clip_camera(perspective);
    int16_t pos[3][3];
    for (int k = 0; k < 3; k++) {
        pos[k][2] = (int16_t)prng_range(&p, CLIP_NEAR, 300 << prng_pick(&p, 6));
        pos[k][0] = (int16_t)prng_range(&p, -32767, 32767);
        pos[k][1] = (int16_t)prng_range(&p, -32767, 32767);
    }
    return clipped_tri((const int16_t (*)[3])pos, &camera, CLIP_W, CLIP_H,
                       perspective ? &zs_depth_recip : &zs_depth_linear, NULL);
}

static int on_plane_case(uint64_t seed)
{
    struct prng p = { seed };
    const int perspective = (int)(seed % 2), at_far = (int)(seed / 2 % 2);
    const uint32_t on = 1u + (uint32_t)(seed / 4 % 7); /* bits: corners exactly on the plane */
    const struct zs_camera camera = clip_camera(perspective);
    const int rest_outside = (int)(seed / 28 % 2);
    int16_t pos[3][3];
    for (uint32_t k = 0; k < 3; k++) {
        const int inside = prng_range(&p, CLIP_NEAR + 1, CLIP_FAR - 1);
        const int outside = at_far ? prng_range(&p, CLIP_FAR + 1, 30000)
                                   : prng_range(&p, -3000, CLIP_NEAR - 1);
        pos[k][2] = (int16_t)(on >> k & 1u ? (at_far ? CLIP_FAR : CLIP_NEAR)
                                           : rest_outside ? outside : inside);
        pos[k][0] = in_frame(&p, pos[k][2], perspective);
        pos[k][1] = in_frame(&p, pos[k][2], perspective);
    }
    struct zs_stats stats;
    const struct zs_depth *depth = perspective && seed / 56 % 2 ? &zs_depth_recip
                                                                : &zs_depth_linear;
    if (!clipped_tri((const int16_t (*)[3])pos, &camera, CLIP_W, CLIP_H, depth, &stats))
        return 0;
    /* nothing is cut from a triangle that only touches the plane, and nothing is left of one that
     * only touches it from outside */
    if (!rest_outside || on == 7u)
        CASE_CHECK(stats.tris_clipped == 0);
    else
        CASE_CHECK(stats.tris_drawn == 0 && stats.pixels_tested == 0);
    return 1;
}

static int behind_case(uint64_t seed)
{
    struct prng p = { seed };
    const int perspective = (int)(seed % 2);
    const struct zs_camera camera = clip_camera(perspective);
    int16_t pos[3][3];
    for (int k = 0; k < 3; k++) {
        pos[k][2] = (int16_t)prng_range(&p, -32767, CLIP_NEAR - 1);
        pos[k][0] = (int16_t)prng_range(&p, -32767 >> prng_pick(&p, 12), 100);
        pos[k][1] = (int16_t)prng_range(&p, -32767 >> prng_pick(&p, 12), 100);
    }
    struct zs_stats s;
    CASE_CHECK(
        clipped_tri((const int16_t(*)[3])pos, &camera, CLIP_W, CLIP_H, &zs_depth_linear, &s));
    CASE_CHECK(s.pixels_tested == 0 && s.tris_drawn == 0 && s.tris_near + s.tris_frustum == 1);
    return 1;
}

static int through_zero_case(uint64_t seed)
{
    struct prng p = { seed };
    const struct zs_camera camera = clip_camera(1);
    int16_t pos[3][3];
    for (uint32_t k = 0; k < 3; k++) {
        const uint32_t how = k == seed % 3 ? 0 : prng_pick(&p, 4);
        pos[k][2] = (int16_t)(how == 0   ? 0 /* w exactly 0 */
                              : how == 1 ? prng_range(&p, -300, 300)
                                         : prng_range(&p, 100, 9000));
        for (int c = 0; c < 2; c++)
            pos[k][c] = (int16_t)(prng_pick(&p, 5) == 0 ? 0 : prng_range(&p, -600, 600));
    }
    return clipped_tri((const int16_t (*)[3])pos, &camera, CLIP_W, CLIP_H, &zs_depth_recip, NULL);
}

/* A plane that crosses near: with near moved by an ulp of 2^-16 the pictures differ at most where
 * the sample is within rounding of one of the cuts. */
static int near_ulp_case(uint64_t seed)
{
    struct prng p = { seed };
    static struct lone l;
    int16_t pos[3][3];
    struct oracle_point corner[3];
    for (int k = 0; k < 3; k++) {
        pos[k][0] = (int16_t)prng_range(&p, -400, 400);
        pos[k][1] = (int16_t)prng_range(&p, -400, 400);
        pos[k][2] = (int16_t)-prng_range(&p, CLIP_NEAR - 90, CLIP_NEAR + 300);
        corner[k].x = pos[k][0];
        corner[k].y = pos[k][1];
        corner[k].z = -pos[k][2];
    }
    lone_set(&l, (const int16_t (*)[3])pos, 3, ZS_Q16_ONE);
    l.mesh.radius = 900;
    const struct zs_config config = lone_config(CLIP_W, CLIP_H, &zs_depth_recip);
    struct zs_camera camera = clip_camera(1);
    camera.focal = (zs_uq32_32)60 << 32;
    struct picture f[3];
    for (int k = 0; k < 3; k++) {
        camera.z_near = CLIP_NEAR * 65536 + (k - 1);
        f[k] = picture_draw(&config, &l.scene, &camera);
    }
    struct oracle_view v = view_of(&camera, CLIP_W, CLIP_H);
    v.z_near = 1;
    struct oracle_polygon o;
    oracle_project(&v, corner, 3, &o);
    const double unit = unit_of(1000);
    int ok = !f[0].err && !f[1].err && !f[2].err;
    for (int j = 0; j < CLIP_H && ok; j++)
        for (int i = 0; i < CLIP_W && ok; i++) {
            const int at = j * CLIP_W + i;
            const int clear = ZS_DEPTH_CLEAR;
            const int drawn[3] = { f[0].key[at] != clear, f[1].key[at] != clear,
                                   f[2].key[at] != clear };
            if (drawn[0] == drawn[1] && drawn[1] == drawn[2])
                continue;
            const double z = oracle_z(&v, &o, i, j);
            const double slope = z * z * hypot(o.qx, o.qy); /* of z, a px */
            const double off = fabs(z - CLIP_NEAR) - 0x1p-16 - 3 * unit;
            if (off > slope * (0.012 + 6 * unit * v.focal / CLIP_NEAR))
                ok = case_wrong("pixel (%d, %d) at z %.6f changed, %.6f a px", i, j, z, slope);
        }
    for (int k = 0; k < 3; k++)
        picture_free(&f[k]);
    return ok;
}

/* ---- 1, 2, 15: meshes on a plane, seen at any angle ------------------------------------------ */

struct plane_mesh {
    struct shape s;
    int32_t corner[8][2]; /* of its convex outline */
    int n_corners;
};

static void plane_vertex(struct shape *s, int32_t x, int32_t y)
{
    const int32_t at[3] = { x, y, 0 }, up[3] = { 0, 0, 1 };
    (void)shape_vertex(s, at, up);
}

static void plane_grid(struct plane_mesh *m, struct prng *p, int n, int32_t half, int jitter)
{
    shape_begin(&m->s);
    const int32_t cell = 2 * half / n, most = cell * 49 / 100;
    for (int y = 0; y <= n; y++)
        for (int x = 0; x <= n; x++) {
            const int inner_x = jitter && x > 0 && x < n, inner_y = jitter && y > 0 && y < n;
            plane_vertex(&m->s, -half + x * cell + (inner_x ? prng_range(p, -most, most) : 0),
                         -half + y * cell + (inner_y ? prng_range(p, -most, most) : 0));
        }
    for (int y = 0; y < n; y++)
        for (int x = 0; x < n; x++) {
            const uint32_t a = (uint32_t)(y * (n + 1) + x), b = a + 1, c = a + (uint32_t)n + 1,
                           d = c + 1;
            const int16_t (*q)[3] = (const int16_t (*)[3])m->s.pos;
            const int64_t sb = (int64_t)(q[d][0] - q[a][0]) * (q[b][1] - q[a][1]) -
                               (int64_t)(q[d][1] - q[a][1]) * (q[b][0] - q[a][0]);
            const int64_t sc = (int64_t)(q[d][0] - q[a][0]) * (q[c][1] - q[a][1]) -
                               (int64_t)(q[d][1] - q[a][1]) * (q[c][0] - q[a][0]);
            if ((sb < 0) != (sc < 0)) { /* the diagonal that lies inside */
                shape_tri(&m->s, a, b, d);
                shape_tri(&m->s, a, d, c);
            } else {
                shape_tri(&m->s, a, b, c);
                shape_tri(&m->s, b, d, c);
            }
        }
    const int32_t end = -half + n * cell;
    const int32_t corner[4][2] = { { -half, -half }, { end, -half }, { end, end }, { -half, end } };
    memcpy(m->corner, corner, sizeof corner);
    m->n_corners = 4;
    shape_end(&m->s);
}

static void plane_fan(struct plane_mesh *m, struct prng *p, int n, int32_t half)
{
    shape_begin(&m->s);
    plane_vertex(&m->s, prng_range(p, -half * 9 / 10, half * 9 / 10),
                 prng_range(p, -half * 9 / 10, half * 9 / 10));
    const int32_t corner[4][2] = {
        { -half, -half }, { half, -half }, { half, half }, { -half, half }
    };
    for (int s = 0; s < 4; s++)
        for (int k = 0; k < n; k++)
            plane_vertex(&m->s,
                         corner[s][0] + (corner[(s + 1) % 4][0] - corner[s][0]) * k / n,
                         corner[s][1] + (corner[(s + 1) % 4][1] - corner[s][1]) * k / n);
    const uint32_t rim = 4 * (uint32_t)n;
    for (uint32_t k = 0; k < rim; k++)
        shape_tri(&m->s, 0, 1 + k, 1 + (k + 1) % rim);
    memcpy(m->corner, corner, sizeof corner);
    m->n_corners = 4;
    shape_end(&m->s);
}

static uint64_t plane_pixels;
static uint32_t triangles_cut;

/* Every pixel of the mesh hit exactly once, and its outline where the oracle says. */
static int plane_right(const struct plane_mesh *m, const struct zs_pose *pose,
                       const struct zs_camera *camera, const struct zs_config *config,
                       struct zs_stats *stats)
{
    const struct zs_material material = { .shader = &zs_shade_raw, .cull = ZS_CULL_NONE };
    const struct zs_instance instance = { .mesh = &m->s.mesh, .material = &material, .pose = *pose };
    const struct zs_scene scene = { .instance = &instance, .n_instances = 1 };
    struct picture f = picture_draw(config, &scene, camera);
    const int32_t w = config->width, h = config->height;
    const struct oracle_view v = view_of(camera, w, h);
    struct oracle_point corner[8];
    double reach = 1;
    for (int k = 0; k < m->n_corners; k++) {
        double at[3];
        for (int c = 0; c < 3; c++) {
            at[c] = pose->pos[c] + (ldexp(pose->rot[3 * c], -30) * m->corner[k][0] +
                                    ldexp(pose->rot[3 * c + 1], -30) * m->corner[k][1]) *
                                       m->s.mesh.scale / 65536.0;
            reach = fmax(reach, fabs(at[c]));
            reach =
                fmax(reach, abs(pose->pos[c]) + 2.0 * m->s.mesh.radius * m->s.mesh.scale / 65536.0);
        }
        const struct oracle_point eye = { at[0], at[1], -at[2] };
        corner[k] = eye;
    }
    struct oracle_polygon o;
    oracle_project(&v, corner, m->n_corners, &o);
    const double slack = pixel_slack(&v, unit_of(reach)) +
                         (config->subpixel_bits == 4 ? 0.05 : 0); /* sqrt(2) / 32 px and more */
    int ok = f.err ? case_wrong("%s", zs_error_string(f.err)) : stats_add_up(&f.stats);
    for (int j = 0; j < h && ok; j++)
        for (int i = 0; i < w && ok; i++) {
            const double inside = oracle_inside(&o, i, j);
            const int drawn = f.key[j * w + i] != ZS_DEPTH_CLEAR;
            if (fabs(inside) > slack && drawn != (inside > 0))
                ok = case_wrong("%s at (%d, %d), %.4f px %s", drawn ? "a pixel" : "a crack", i, j,
                                fabs(inside), inside > 0 ? "inside" : "outside");
        }
    if (ok && (f.stats.pixels_tested != f.covered))
        ok = case_wrong("%u pixels covered, %u hits", f.covered, f.stats.pixels_tested);
    plane_pixels += f.covered;
    if (stats)
        *stats = f.stats;
    picture_free(&f);
    return ok;
}

static int mesh_case(uint64_t seed)
{
    static struct plane_mesh m;
    struct prng p = { seed };
    plane_grid(&m, &p, prng_range(&p, 1, 30), 20000, 1);
    struct zs_pose pose;
    zs_pose_identity(&pose);
    zs_pose_turn(&pose, (zs_turn)prng_range(&p, -8000, 8000), (zs_turn)prng_range(&p, -8000, 8000),
                 (zs_turn)prng_next(&p));
    pose.pos[2] = -PIXEL_Z;
    const int perspective = (int)(seed % 2);
    const struct zs_camera camera = pixel_camera(160, perspective);
    struct zs_config config = picture_config(200, 160, perspective && seed % 4 == 1
                                                           ? &zs_depth_recip : &zs_depth_linear);
    config.subpixel_bits = seed % 7 == 0 ? 4 : 8;
    config.strip_h = (uint16_t)prng_range(&p, 1, 160);
    return plane_right(&m, &pose, &camera, &config, NULL);
}

static void stress_01_shared_edge_mesh(void **state)
{
    plane_pixels = 0;
    CASES(mesh_case, 120);
    print_message("shared-edge meshes: %llu pixels, each hit once\n",
                  (unsigned long long)plane_pixels);
}

/* A plane through the eye's neighbourhood: crosses near, often far and the guard band too. */
static int plane_clipped(uint64_t seed, int is_fan)
{
    static struct plane_mesh m;
    struct prng p = { seed };
    const int perspective = seed % 4 != 0;
    if (is_fan)
        plane_fan(&m, &p, prng_range(&p, 1, 60), 30000);
    else
        plane_grid(&m, &p, prng_range(&p, 1, 24), 30000, 1);
    struct zs_pose pose;
    zs_pose_identity(&pose);
    zs_pose_turn(&pose, (zs_turn)prng_range(&p, -9000, 9000),
                 (zs_turn)(prng_range(&p, 0, 16000) * (seed % 2 ? 1 : -1)), (zs_turn)prng_next(&p));
    pose.pos[1] = prng_range(&p, -3000, 3000);
    pose.pos[2] = -prng_range(&p, -2000, 20000);
    struct zs_camera camera;
    if (perspective)
        (void)zs_camera_perspective(&camera, (zs_turn)prng_range(&p, 3000, 20000), 120, 50,
                                    prng_pick(&p, 2) ? 30000 : 100000);
    else
        (void)zs_camera_orthographic(&camera, prng_range(&p, 200, 30000), -1000, 20000);
    struct zs_config config = picture_config(160, 120, perspective ? &zs_depth_recip
                                                                   : &zs_depth_linear);
    config.strip_h = (uint16_t)prng_range(&p, 1, 120);
    struct zs_stats stats;
    const int ok = plane_right(&m, &pose, &camera, &config, &stats);
    triangles_cut += stats.tris_clipped;
    return ok;
}

static int fan_case(uint64_t seed)
{
    static struct plane_mesh m;
    struct prng p = { seed };
    if (seed % 2)
        return plane_clipped(seed / 2, 1);
    plane_fan(&m, &p, prng_range(&p, 1, 200), 20000);
    struct zs_pose pose;
    zs_pose_identity(&pose);
    pose.pos[2] = -PIXEL_Z;
    const struct zs_camera camera = pixel_camera(160, seed / 2 % 2);
    const struct zs_config config = picture_config(200, 160, &zs_depth_linear);
    return plane_right(&m, &pose, &camera, &config, NULL);
}

static void stress_02_fans_clipped_or_not(void **state)
{
    plane_pixels = 0;
    CASES(fan_case, 200);
    print_message("fans: %llu pixels, each hit once\n", (unsigned long long)plane_pixels);
}

static int seam_case(uint64_t seed)
{
    return plane_clipped(seed, 0);
}

/* Whether and which way round (1 or -1) a snapped polygon whose sides do not cross winds around a
 * sample: a sum over any fan, for what two pieces of opposite sense share cancels. */
static int winding(const struct zs_vertex *v, int n, int i, int j)
{
    int sum = 0;
    for (int k = 1; k + 1 < n; k++) {
        const struct oracle_tri o = { { v[0].x, v[k].x, v[k + 1].x },
                                      { v[0].y, v[k].y, v[k + 1].y } };
        if (oracle_covers(&o, i, j))
            sum += oracle_area(&o) > 0 ? 1 : -1;
    }
    return sum;
}

/* A snapped polygon of 3 or 4 corners whose sides do not cross: at most one corner turns the other
 * way. */
static int is_simple(const struct zs_vertex *v, int n)
{
    int turns[2] = { 0, 0 };
    for (int k = 0; k < n; k++) {
        const struct zs_vertex *a = &v[k], *b = &v[(k + 1) % n], *c = &v[(k + 2) % n];
        const struct oracle_tri o = { { a->x, b->x, c->x }, { a->y, b->y, c->y } };
        turns[0] += oracle_area(&o) > 0;
        turns[1] += oracle_area(&o) < 0;
    }
    return turns[0] <= 1 || turns[1] <= 1;
}

/* The pixels of triangle t, cut and snapped by the library's own stages, are those of its polygon.
 */
static int polygon_drawn(const struct zs_renderer *r, const struct picture *f, uint32_t t)
{
    const struct zs_mesh *mesh = r->xform.instance->mesh;
    struct zs_clip_vertex cv[ZS_CLIP_MAX];
    struct zs_vertex v[ZS_CLIP_MAX];
    uint32_t planes = 0;
    for (int k = 0; k < 3; k++) {
        zs_xform_vertex(&r->xform, mesh->tri[t][k], &cv[k].p);
        planes |= zs_xform_outcode(&r->view, &cv[k].p);
    }
    const int n = zs_clip_polygon(&r->view, cv, 3, planes, 0);
    for (int k = 0; k < n; k++)
        (void)zs_xform_project(r, &cv[k].p, &v[k]);
    if (!is_simple(v, n))
        return 1; /* a strip of less than a sub-pixel that snapping folded over */
    const int x = v[0].x / 256, y = v[0].y / 256; /* none is 8 px wide */
    for (int j = y > 8 ? y - 8 : 0; j < f->h && j < y + 8; j++)
        for (int i = x > 8 ? x - 8 : 0; i < f->w && i < x + 8; i++) {
            const int drawn = f->color[j * f->w + i] == t + 1u;
            if (drawn != (winding(v, n, i, j) != 0))
                return case_wrong("triangle %u, a %d-gon after the clip: pixel (%d, %d)", t, n, i,
                                  j);
        }
    return 1;
}

/* Loose triangles of a pixel or two, each in its own place, cut by far and snapped coarsely: their
 * corners turn inwards, and still they are drawn exactly. */
static int tiny_polygon_case(uint64_t seed)
{
    static struct shape s;
    struct prng p = { seed };
    shape_begin(&s);
    for (int n = 0; n < 13 * 10; n++) {
        const uint32_t first = s.mesh.n_verts;
        for (int v = 0; v < 3; v++) {
            const int32_t at[3] = { (n % 13 - 6) * 1536 + prng_range(&p, -700, 700),
                                    (n / 13 - 5) * 1536 + prng_range(&p, -700, 700),
                                    prng_range(&p, -100, 100) };
            (void)shape_vertex(&s, at, at);
        }
        shape_tri(&s, first, first + 1, first + 2);
    }
    shape_end(&s);
    const struct zs_material material = { .shader = &zs_shade_raw, .cull = ZS_CULL_NONE };
    struct zs_instance in = { .mesh = &s.mesh, .material = &material };
    zs_pose_identity(&in.pose);
    in.pose.pos[2] = -PIXEL_Z;
    const struct zs_scene scene = { .instance = &in, .n_instances = 1 };
    struct zs_camera camera = pixel_camera(60, 0);
    camera.z_far = (zs_q48_16)PIXEL_Z * 65536;
    struct zs_config config = picture_config(80, 60, &zs_depth_linear);
    config.subpixel_bits = seed % 4 ? 4 : 8;
    struct picture f = picture_draw(&config, &scene, &camera);
    triangles_cut += f.stats.tris_clipped;
    int ok = !f.err && f.stats.pixels_tested == f.covered;
    if (!ok)
        (void)case_wrong("%u covered, %u hits", f.covered, f.stats.pixels_tested);
    struct zs_renderer r; /* brought to where bin.c walks the instance */
    struct zs_bounds b;
    const uint32_t bytes = zs_arena_bytes(&config);
    void *arena = malloc(bytes);
    ok = ok && !zs_init(&r, &config, arena, bytes) && !zs_frame_begin(&r, &scene, &camera) &&
         !zs_cull_bounds(&b, &r, &in) && zs_xform_instance(&r, 0, &b);
    for (uint32_t t = 0; t < s.mesh.n_tris && ok; t++)
        ok = polygon_drawn(&r, &f, t);
    free(arena);
    picture_free(&f);
    return ok;
}

static int64_t turn_of(int64_t ax, int64_t ay, int64_t bx, int64_t by, int64_t cx, int64_t cy)
{
    return (bx - ax) * (cy - ay) - (cx - ax) * (by - ay);
}

/* 1: from every corner, the pieces of a snapped polygon's fan have both senses: its sides cross. */
static int is_folded(const struct zs_vertex *v, int n)
{
    for (int first = 0; first < n; first++) {
        int senses = 0;
        for (int k = 1; k + 1 < n; k++) {
            const struct zs_vertex *a = &v[first], *b = &v[(first + k) % n], *c = &v[(first + k + 1) % n];
            const int64_t turn = turn_of(a->x, a->y, b->x, b->y, c->x, c->y);
            senses |= turn > 0 ? 1 : turn < 0 ? 2 : 0;
        }
        if (senses != 3)
            return 0;
    }
    return n > 3;
}

/* Thin triangles of an orthographic view, cut by far and snapped coarsely so that their sides cross: whether they face
 * the eye is what it was before they were cut. */
static uint64_t folded;

static int folded_case(uint64_t seed)
{
    static struct lone l;
    static uint32_t arena[16000];
    struct prng p = { seed };
    struct zs_camera camera = pixel_camera(60, 0);
    struct zs_config config = lone_config(80, 60, &zs_depth_linear);
    struct zs_clip_vertex cv[ZS_CLIP_MAX];
    struct zs_vertex v[ZS_CLIP_MAX];
    struct zs_renderer r;
    struct zs_bounds b;
    int16_t pos[3][3];
    config.subpixel_bits = 4;
    camera.z_far = (zs_q48_16)PIXEL_Z * 65536;
    const int32_t run[2] = { prng_range(&p, -6000, 6000), prng_range(&p, -6000, 6000) };
    const int32_t middle[2] = { prng_range(&p, -1000, 1000), prng_range(&p, -1000, 1000) };
    for (int k = 0; k < 3; k++) {
        const int32_t along = prng_range(&p, -256, 256);
        for (int c = 0; c < 2; c++)
            pos[k][c] = (int16_t)(middle[c] + run[c] * along / 256 + prng_range(&p, -14, 14));
        pos[k][2] = (int16_t)prng_range(&p, -100, 100);
    }
    lone_set(&l, (const int16_t (*)[3])pos, 3, ZS_Q16_ONE);
    l.material.cull = ZS_CULL_BACK;
    l.instance.pose.pos[2] = -PIXEL_Z;
    CASE_CHECK(!zs_init(&r, &config, arena, sizeof arena) && !zs_frame_begin(&r, &l.scene, &camera));
    CASE_CHECK(!zs_cull_bounds(&b, &r, &l.instance) && zs_xform_instance(&r, 0, &b));
    uint32_t planes = 0;
    for (uint32_t k = 0; k < 3; k++) {
        zs_xform_vertex(&r.xform, l.tri[0][k], &cv[k].p);
        planes |= zs_xform_outcode(&r.view, &cv[k].p);
    }
    const int64_t turn = turn_of(cv[0].p.c[0], cv[0].p.c[1], cv[1].p.c[0], cv[1].p.c[1], cv[2].p.c[0], cv[2].p.c[1]);
    const int n = zs_clip_polygon(&r.view, cv, 3, planes, 0);
    for (int k = 0; k < n; k++)
        (void)zs_xform_project(&r, &cv[k].p, &v[k]);
    if (!planes || turn == 0 || !is_folded(v, n))
        return 1;
    folded++;
    struct picture f = picture_draw(&config, &l.scene, &camera);
    const uint32_t away = f.stats.tris_facing;
    const int err = f.err;
    picture_free(&f);
    CASE_CHECK(!err && away == (turn > 0)); /* y runs down: front faces turn counter-clockwise there */
    return 1;
}

static void folded_polygons_face_as_they_did(void **state)
{
    folded = 0;
    CASES(folded_case, 20000);
    print_message("%llu polygons whose sides cross\n", (unsigned long long)folded);
    assert_true(folded > 100);
}

static int same_vertex(const struct zs_clip_vertex *a, const struct zs_clip_vertex *b)
{
    return memcmp(a->p.c, b->p.c, sizeof a->p.c) == 0 &&
           memcmp(a->attr, b->attr, 3 * sizeof a->attr[0]) == 0;
}

/* > 0 inside the plane, 0 on it. */
static int64_t inside_of(const struct zs_view *view, const struct zs_point *p, uint32_t plane)
{
    const int64_t z = p->c[2], up = view->perspective ? z : 1;
    const int64_t limit = (int64_t)view->guard * up, one = (int64_t)1 << view->scale_bits;
    switch (plane) {
    case ZS_OUT_NEAR: return z - view->z_near;
    case ZS_OUT_FAR: return view->z_far - z;
    case ZS_OUT_LEFT: return limit + p->c[0] * one;
    case ZS_OUT_RIGHT: return limit - p->c[0] * one;
    case ZS_OUT_TOP: return limit + p->c[1] * one;
    default: return limit - p->c[1] * one;
    }
}

/* A new vertex is the same bit for bit from both sides of its edge. Small numbers, so that it often
 * falls exactly between two. */
static int seam_vertex_case(uint64_t seed)
{
    struct prng p = { seed };
    const struct zs_view view = {
        .z_near = 64, .z_far = 300, .perspective = (uint8_t)(seed % 2), .scale_bits = seed % 2 ? 9 : 0,
        .guard = 120 << (seed % 2 ? 0 : 1)
    };
    for (int n = 0; n < 100; n++) {
        struct zs_clip_vertex v[5]; /* corners a, b and one on either side */
        memset(v, 0, sizeof v);
        for (int k = 0; k < 4; k++)
            for (int c = 0; c < 3; c++) {
                v[k].p.c[c] = prng_range(&p, c == 2 ? 0 : -400, 400);
                v[k].attr[c] = (uint16_t)prng_pick(&p, 100);
            }
        const uint32_t plane =
            1u << prng_pick(&p, 6); /* beyond near and far: only in front of near */
        for (int k = 0; k < 4; k++)
            if (plane & ~(uint32_t)(ZS_OUT_NEAR | ZS_OUT_FAR))
                v[k].p.c[2] = 64 + v[k].p.c[2] / 2;
        struct zs_clip_vertex left[ZS_CLIP_MAX] = { v[0], v[1], v[2] };
        struct zs_clip_vertex right[ZS_CLIP_MAX] = { v[1], v[0], v[3] };
        const int64_t at_a = inside_of(&view, &v[0].p, plane),
                      at_b = inside_of(&view, &v[1].p, plane);
        const int n_left = zs_clip_polygon(&view, left, 3, plane, 3);
        const int n_right = zs_clip_polygon(&view, right, 3, plane, 3);
        if ((at_a > 0 ? at_b >= 0 : at_b <= 0) || at_a == 0 || n_left == 0 || n_right == 0)
            continue;
        int found = 0; /* what is left of the edge: its inner end and the new vertex */
        for (int i = 0; i < n_left; i++)
            for (int j = 0; j < n_right; j++)
                found += same_vertex(&left[i], &right[j]);
        if (found < 2) /* more where corners fall together */
            return case_wrong("plane %u: the edge (%d %d %d) (%d %d %d) is cut in two ways", plane,
                              v[0].p.c[0], v[0].p.c[1], v[0].p.c[2], v[1].p.c[0], v[1].p.c[1],
                              v[1].p.c[2]);
    }
    return 1;
}

static void stress_15_seam_cut_by_the_clip(void **state)
{
    plane_pixels = triangles_cut = 0;
    CASES(seam_case, 200);
    CASES(tiny_polygon_case, 400);
    CASES(seam_vertex_case, 500);
    print_message("seams: %llu pixels, each hit once; %u triangles cut\n",
                  (unsigned long long)plane_pixels, triangles_cut);
}

/* ---- 8, 16: ends of the ranges --------------------------------------------------------------- */

static int32_t end32(struct prng *p)
{
    static const int32_t ends[] = {
        INT32_MIN, INT32_MIN + 1, -ZS_WORLD_MAX - 1, -ZS_WORLD_MAX, -1,       0,
        1,         ZS_WORLD_MAX,  ZS_WORLD_MAX + 1,  INT32_MAX - 1, INT32_MAX
    };
    return prng_pick(p, 2) ? ends[prng_pick(p, 11)]
                           : (int32_t)(prng_next(p) & 0xffffffffu) >> prng_pick(p, 32);
}

static uint32_t ends_drawn, ends_refused;

static int ends_case(uint64_t seed)
{
    static const int16_t ends[] = { -32768, -32767, -1, 0, 1, 32766, 32767 };
    static struct lone l;
    struct prng p = { seed };
    int16_t pos[3][3];
    for (int k = 0; k < 9; k++)
        pos[k / 3][k % 3] = ends[prng_pick(&p, 7)];
    lone_set(&l, (const int16_t (*)[3])pos, 3, ZS_Q16_ONE);
    static const uint8_t lo[3][3] = { { 255, 255, 255 }, { 0, 255, 1 }, { 255, 0, 128 } };
    if (prng_pick(&p, 2))
        l.mesh.pos_lo = lo;
    if (prng_pick(&p, 3) == 0)
        l.mesh.scale = 1u + (zs_uq16_16)(uint32_t)prng_log(&p) / 2u;
    if (prng_pick(&p, 3) == 0)
        l.instance.pose.scale = 1u + (zs_uq16_16)(uint32_t)prng_log(&p) / 2u;
    for (int k = 0; k < 3; k++)
        l.instance.pose.pos[k] = prng_pick(&p, 8) ? prng_range(&p, -20000, 20000) : end32(&p);
    zs_pose_turn(&l.instance.pose, (zs_turn)prng_next(&p), (zs_turn)prng_next(&p), 0);
    const int perspective = (int)prng_pick(&p, 2);
    struct zs_camera camera = clip_camera(perspective);
    const int32_t from = prng_pick(&p, 8) ? 0 : end32(&p);
    camera.pos[prng_pick(&p, 3)] = from;
    if (prng_pick(&p, 4) == 0)
        camera.z_near = prng_pick(&p, 2) ? 1 << prng_pick(&p, 24) : prng_log(&p);
    if (prng_pick(&p, 4) == 0)
        camera.z_far = prng_pick(&p, 2) ? (zs_q48_16)ZS_FAR_MAX * 65536 >> prng_pick(&p, 40)
                                        : prng_log(&p);
    if (prng_pick(&p, 4) == 0)
        camera.focal = (uint64_t)1 << prng_pick(&p, 64);
    if (prng_pick(&p, 4) == 0)
        camera.height = (zs_q48_16)1 << prng_pick(&p, 63);
    struct zs_config config = lone_config(24, 16, perspective && prng_pick(&p, 2)
                                                      ? &zs_depth_recip : &zs_depth_linear);
    config.strip_h = 5;
    config.fast = fast_any(&p);
    if (prng_pick(&p, 2)) {
        config.max_tris = 2;
        config.max_verts = 3;
    }
    struct picture f = picture_draw(&config, &l.scene, &camera);
    const int known = f.err == ZS_OK || f.err == ZS_ERR_CAMERA || f.err == ZS_ERR_RANGE ||
                      f.err == ZS_ERR_NEAR ||
                      f.err == ZS_ERR_MESH;
    const int ok = known && (f.err || stats_add_up(&f.stats));
    ends_drawn += !f.err && f.covered;
    ends_refused += f.err != 0;
    if (!ok)
        (void)case_wrong("error %d", f.err);
    picture_free(&f);
    return ok;
}

static void stress_08_coordinates_at_the_ends(void **state)
{
    ends_drawn = ends_refused = 0;
    CASES(ends_case, 40000);
    print_message("ends of the ranges: %u frames with pixels, %u refused by name\n", ends_drawn,
                  ends_refused);
}

static uint32_t scales_drawn, scales_refused;

static int scale_case(uint64_t seed)
{
    struct prng p = { seed };
    const int power = (int)(seed % 31) - 15; /* world units are 2^power of the plain case */
    static struct plane_mesh m;
    plane_grid(&m, &p, 6, 20000, 1);
    struct zs_pose pose;
    zs_pose_identity(&pose);
    zs_pose_turn(&pose, (zs_turn)prng_range(&p, -6000, 6000), (zs_turn)prng_range(&p, -6000, 6000),
                 0);
    struct zs_config config = picture_config(100, 80, &zs_depth_recip);
    struct zs_camera camera;
    (void)zs_camera_perspective(&camera, 8192, 80, 1, 2);
    /* near 1024, far 2^18, object at 2^16, all times 2^power; split between mesh and pose */
    const int half = power / 2;
    m.s.mesh.scale = half >= 0 ? ZS_Q16_ONE << half : ZS_Q16_ONE >> -half;
    pose.scale = power - half >= 0 ? ZS_Q16_ONE << (power - half) : ZS_Q16_ONE >> (half - power);
    camera.z_near = (zs_q48_16)1 << (26 + power);
    camera.z_far = (zs_q48_16)1 << (34 + power);
    const int64_t distance = (int64_t)1 << (16 + power);
    pose.pos[2] = (int32_t)(distance > INT32_MAX ? INT32_MIN : -distance);
    const struct zs_material plain = { .shader = &zs_shade_raw, .cull = ZS_CULL_NONE };
    const struct zs_instance there = { .mesh = &m.s.mesh, .material = &plain, .pose = pose };
    const struct zs_scene first = { .instance = &there, .n_instances = 1 };
    struct picture f = picture_draw(&config, &first, &camera);
    const int err = f.err;
    picture_free(&f);
    if (err) { /* by its name, and not where it need not be */
        scales_refused++;
        return (err == ZS_ERR_CAMERA || err == ZS_ERR_RANGE || err == ZS_ERR_NEAR) && power > 10
                   ? 1 : case_wrong("error %d at 2^%d", err, power);
    }
    CASE_CHECK(distance <= ZS_WORLD_MAX); /* else the position was not the one that was meant */
    scales_drawn++;
    struct plane_mesh *const scaled = &m;
    const zs_uq16_16 keep = scaled->s.mesh.scale;
    /* plane_right reads mesh.scale as the whole scale: hand it the product, and the mesh the parts
     */
    if (seed / 31 % 2) {
        scaled->s.mesh.scale = power >= 0 ? ZS_Q16_ONE << power : ZS_Q16_ONE >> -power;
        pose.scale = ZS_Q16_ONE;
        return plane_right(scaled, &pose, &camera, &config, NULL);
    }
    const struct zs_material material = { .shader = &zs_shade_raw, .cull = ZS_CULL_NONE };
    const struct zs_instance parts = { .mesh = &scaled->s.mesh, .material = &material, .pose = pose };
    const struct zs_scene scene = { .instance = &parts, .n_instances = 1 };
    struct picture a = picture_draw(&config, &scene, &camera);
    scaled->s.mesh.scale = power >= 0 ? ZS_Q16_ONE << power : ZS_Q16_ONE >> -power;
    struct zs_instance whole = parts;
    whole.pose.scale = ZS_Q16_ONE;
    const struct zs_scene other = { .instance = &whole, .n_instances = 1 };
    struct picture b = picture_draw(&config, &other, &camera);
    const int ok = picture_same(&a, &b, "mesh.scale times pose.scale") && a.covered > 100;
    scaled->s.mesh.scale = keep;
    PICTURES_FREE(&a, &b);
    return ok;
}

static void stress_16_matrix_scale_2_to_15(void **state)
{
    CASES(scale_case, 31 * 8);
    print_message("scales 2^-15 to 2^15: %u drawn and compared, %u refused by name\n", scales_drawn, scales_refused);
}

/* ---- 18, 19, 20: who wins -------------------------------------------------------------------- */

static const struct zs_shader *const all_shaders[] = { &zs_shade_raw, &zs_shade_flat,
                                                       &zs_shade_smooth };

/* The same triangle nine times: three corners to begin from, three instances of other colours. It
 * looks like the first of them alone. */
static int twice_case(uint64_t seed)
{
    static struct shape s;
    struct prng p = { seed };
    shape_begin(&s);
    for (int v = 0; v < 3; v++) {
        const int32_t at[3] = { prng_range(&p, -9000, 9000), prng_range(&p, -9000, 9000),
                                prng_range(&p, -3000, 3000) };
        (void)shape_vertex(&s, at, at);
    }
    for (uint32_t k = 0; k < 3; k++)
        shape_tri(&s, k, (k + 1) % 3, (k + 2) % 3);
    shape_end(&s);
    struct zs_mesh plain = s.mesh; /* the later ones take the material's colour */
    plain.vertex_rgb = NULL;
    plain.face_rgb = NULL;
    plain.face_raw = NULL;
    const uint32_t shader = prng_pick(&p, 3);
    struct zs_material material[2] = { { .shader = all_shaders[shader], .cull = ZS_CULL_NONE },
                                       { .shader = all_shaders[shader], .rgb = { 255, 255, 255 },
                                         .cull = ZS_CULL_NONE } };
    if (seed % 5 == 0)
        material[1].shader = all_shaders[(shader + 1) % 3];
    struct zs_instance in[3] = { { .mesh = &s.mesh, .material = &material[0] } };
    zs_pose_identity(&in[0].pose);
    in[0].pose.pos[2] = -PIXEL_Z;
    in[1] = in[2] = in[0];
    in[1].mesh = in[2].mesh = &plain;
    in[1].material = in[2].material = &material[1];
    struct zs_scene scene = { .instance = in, .n_instances = 3 };
    scene.light.dir[2] = ZS_Q30_ONE;
    scene.light.ambient = ZS_Q16_ONE * 3 / 4;
    const int mode = (int)(seed % 3); /* ortho, recip, linear */
    const struct zs_camera camera = pixel_camera(60, mode != 0);
    struct zs_config config =
        picture_config(80, 60, mode == 1 ? &zs_depth_recip : &zs_depth_linear);
    config.depth_bits = seed % 2 ? 16 : 8;
    scene.n_instances = 1;
    s.mesh.n_tris = 1;
    struct picture alone = picture_draw(&config, &scene, &camera);
    scene.n_instances = 3;
    s.mesh.n_tris = 3;
    config.strip_h = (uint16_t)prng_range(&p, 1, 60);
    const uint32_t pools = prng_pick(&p, 3);
    if (pools < 2) {
        config.max_tris = (uint16_t)(1 + pools);
        config.max_verts = (uint16_t)(3 + pools);
    }
    struct picture f = picture_draw(&config, &scene, &camera);
    int ok = picture_same(&alone, &f, "the first of nine") && f.stats.tris_drawn % 9 == 0;
    if (ok && (f.stats.pixels_written != f.covered || f.stats.pixels_tested != 9 * f.covered))
        ok = case_wrong("%u covered, %u tested, %u written", f.covered, f.stats.pixels_tested,
                        f.stats.pixels_written);
    PICTURES_FREE(&alone, &f);
    return ok;
}

/* A key plane that is exact at every sub-pixel: d = base + gx x + gy y, uq16_16 a sub-pixel. */
struct key_plane {
    int64_t base, gx, gy;
};

/* A quad over the frame and beyond, cut anyhow into two triangles. */
static void plane_quad(struct prng *p, const struct key_plane *k, int32_t w, int32_t h,
                       struct easel_tri t[2])
{
    const int32_t x0 = -prng_range(p, 1, 2000), x1 = w * 256 + prng_range(p, 1, 2000);
    const int32_t y0 = -prng_range(p, 1, 2000), y1 = h * 256 + prng_range(p, 1, 2000);
    const int32_t q[4][2] = { { x0, y0 }, { x1, y0 }, { x1, y1 }, { x0, y1 } };
    const uint32_t first = prng_pick(p, 2);
    for (uint32_t n = 0; n < 2; n++)
        for (uint32_t v = 0; v < 3; v++) {
            const int32_t *c = q[(first + 2 * n + v) % 4];
            t[n].x[v] = c[0];
            t[n].y[v] = c[1];
            t[n].d[v] = (uint32_t)(k->base + k->gx * c[0] + k->gy * c[1]);
            memset(t[n].rgb, 0, sizeof t[n].rgb);
        }
}

static struct key_plane random_plane(struct prng *p, int32_t w, int32_t h)
{
    /* |gx| (w 256 + 4000) + |gy| ... stays below 2^31 around 2^31 */
    const int32_t most_x = (int32_t)(0x3f000000 / (w * 256 + 4000)), shift = prng_range(p, 0, 8);
    const int32_t most_y = (int32_t)(0x3f000000 / (h * 256 + 4000));
    const struct key_plane k = { (int64_t)0x80000000u, prng_range(p, -most_x, most_x) >> shift,
                                 prng_range(p, -most_y, most_y) >> shift };
    return k;
}

static int pair_case(uint64_t seed)
{
    struct prng p = { seed };
    struct easel s = easel_default(320, 240);
    s.strip_h = prng_range(&p, 1, 240);
    const struct key_plane near_plane = random_plane(&p, 320, 240);
    const int close = (int)(seed % 2);
    struct key_plane far_plane = near_plane;
    far_plane.base += close ? 32768 : 66192; /* 0.5 and 1.0101 buckets */
    struct easel_tri t[4], alone[2];
    plane_quad(&p, &far_plane, 320, 240, t); /* the farther one comes first and would win a tie */
    plane_quad(&p, &near_plane, 320, 240, t + 2);
    memcpy(alone, t + 2, sizeof alone);
    struct easel_frame f, g;
    easel_draw(&s, t, 4, &f);
    easel_draw(&s, alone, 2, &g);
    int ok = 1;
    for (int i = 0; i < 320 * 240 && ok; i++) {
        const int right = f.color[i] >= 3;
        if (!right && (!close || f.key[i] != g.key[i]))
            ok = case_wrong("pixel (%d, %d): colour %u, keys %u and %u", i % 320, i / 320,
                            f.color[i], f.key[i], g.key[i]);
    }
    easel_free(&f);
    easel_free(&g);
    return ok;
}

static int crossing_case(uint64_t seed)
{
    struct prng p = { seed };
    struct easel s = easel_default(320, 240);
    s.strip_h = prng_range(&p, 1, 240);
    struct key_plane k[2] = { random_plane(&p, 320, 240), random_plane(&p, 320, 240) };
    struct easel_tri t[4];
    for (int n = 0; n < 2; n++) /* cross somewhere near the middle of the frame */
        k[n].base -= k[n].gx * (320 * 128) + k[n].gy * (240 * 128);
    plane_quad(&p, &k[0], 320, 240, t);
    plane_quad(&p, &k[1], 320, 240, t + 2);
    struct easel_frame f;
    easel_draw(&s, t, 4, &f);
    int ok = 1;
    for (int j = 0; j < 240 && ok; j++)
        for (int i = 0; i < 320 && ok; i++) {
            const int64_t x = i * 256 + 128, y = j * 256 + 128;
            const int64_t apart = k[1].base + k[1].gx * x + k[1].gy * y - k[0].base -
                                  k[0].gx * x - k[0].gy * y; /* uq16_16 */
            const int first = f.color[j * 320 + i] <= 2;
            if (llabs(apart) >= 66192 && first != (apart > 0))
                ok = case_wrong("pixel (%d, %d): colour %u, %.3f buckets apart", i, j,
                                f.color[j * 320 + i], (double)apart / 65536);
        }
    easel_free(&f);
    return ok;
}

/* ---- Failures that other renderers shipped --------------------------------------------------------- */

/* A projected triangle so huge that its coordinates leave 32 bits, and a loop over its rows or columns never ends:
 * corners at the ends of int16 beside a near plane at 1, up to 2^33 sub-pixels from the frame. */
static int huge_case(uint64_t seed)
{
    struct prng p = { seed };
    struct zs_camera camera = clip_camera(1);
    camera.focal = (zs_uq32_32)(500 << prng_pick(&p, 3)) << 32;
    camera.z_near = 65536;
    int16_t pos[3][3];
    for (int k = 0; k < 3; k++) {
        pos[k][0] = (int16_t)prng_range(&p, -32767, 32767);
        pos[k][1] = (int16_t)prng_range(&p, -32767, 32767);
        pos[k][2] = (int16_t)(k == 0 ? 1 : prng_range(&p, 1, 1 << prng_pick(&p, 15)));
        if (prng_pick(&p, 3) == 0)
            pos[k][prng_pick(&p, 2)] = (int16_t)prng_range(&p, -3, 3);
    }
    struct zs_stats stats;
    if (!clipped_tri((const int16_t (*)[3])pos, &camera, CLIP_W, CLIP_H, &zs_depth_recip, &stats))
        return 0;
    CASE_CHECK(stats.pixels_tested <= CLIP_W * CLIP_H && stats.verts_transformed <= 200);
    return 1;
}

static void others_overflow_that_loops_for_ever(void **state)
{
    looked = (struct looked){ 0, 0, 0 };
    CASES(huge_case, 1500);
    print_message("huge triangles: %llu pixels compared, %llu too close to an edge to tell\n",
                  (unsigned long long)looked.compared, (unsigned long long)looked.doubtful);
}

/* A triangle that has an area until its corners are snapped: nothing is drawn, whatever divides by it. Steps of 1/16
 * sub-pixel, all corners nearest to one sub-pixel or to two; with 4 sub-pixel bits steps of one. */
static int snapped_away_case(uint64_t seed)
{
    static struct shape s;
    struct prng p = { seed };
    const int coarse = (int)(seed % 2), perspective = (int)(seed / 2 % 2);
    const int32_t there[2] = { prng_range(&p, -300, 300) * 16, prng_range(&p, -300, 300) * 16 };
    const int32_t beside = prng_pick(&p, 2) ? 16 : 0; /* of one corner, to the right */
    int64_t c[3][2];
    shape_begin(&s);
    for (int v = 0; v < 3; v++) {
        for (int k = 0; k < 2; k++)
            c[v][k] = there[k] + prng_range(&p, -6, 6) + (v == 2 && k == 0 ? beside : 0);
        const int32_t at[3] = { (int32_t)c[v][0], (int32_t)c[v][1], perspective ? 0 : prng_range(&p, -30000, 30000) };
        (void)shape_vertex(&s, at, at);
    }
    if ((c[1][0] - c[0][0]) * (c[2][1] - c[0][1]) == (c[1][1] - c[0][1]) * (c[2][0] - c[0][0]))
        return 1; /* no area to begin with */
    shape_tri(&s, 0, 1, 2);
    shape_end(&s);
    s.mesh.scale = coarse ? ZS_Q16_ONE : ZS_Q16_ONE / 16;
    const struct zs_material material = { .shader = all_shaders[seed / 4 % 3], .rgb = { 9, 9, 9 },
                                          .cull = ZS_CULL_NONE };
    struct zs_instance in = { .mesh = &s.mesh, .material = &material };
    zs_pose_identity(&in.pose);
    in.pose.pos[2] = -PIXEL_Z;
    const struct zs_scene scene = { .instance = &in, .n_instances = 1 };
    const struct zs_camera camera = pixel_camera(80, perspective);
    struct zs_config config = picture_config(96, 80, perspective ? &zs_depth_float : &zs_depth_linear);
    config.subpixel_bits = coarse ? 4 : 8;
    for (int plain = 0; plain < 2; plain++) {
        config.fast = plain ? NULL : fast_all;
        struct picture f = picture_draw(&config, &scene, &camera);
        picture_free(&f);
        if (f.err || f.covered || f.stats.tris_zero != 1 || f.stats.tris_drawn)
            return case_wrong("error %d, %u pixels, zero %u, drawn %u", f.err, f.covered, f.stats.tris_zero,
                              f.stats.tris_drawn);
    }
    return 1;
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(stress_01_shared_edge_mesh),
    cmocka_unit_test(stress_02_fans_clipped_or_not),
    CASES_TEST(stress_03_slivers_of_one_sub_pixel, sliver_case, 600),
    cmocka_unit_test(stress_04_zero_area_and_duplicate_vertices),
    CASES_TEST(stress_05_vertices_on_pixel_centres, center_case, 600),
    CASES_TEST(stress_06_one_sub_pixel_beside_centres, beside_case, 600),
    CASES_TEST(stress_07_horizontal_and_vertical_edges, straight_case, 600),
    cmocka_unit_test(stress_08_coordinates_at_the_ends),
    CASES_TEST(stress_09_beyond_the_guard_band, guard_case, 1500),
    CASES_TEST(stress_10_vertex_on_near_plane, on_plane_case, 1120),
    CASES_TEST(stress_11_all_behind, behind_case, 400),
    CASES_TEST(stress_12_w_through_zero, through_zero_case, 1000),
    CASES_TEST(stress_13_near_by_one_ulp, near_ulp_case, 500),
    cmocka_unit_test(stress_14_26_directions_by_1_2_3_vertices),
    cmocka_unit_test(folded_polygons_face_as_they_did), cmocka_unit_test(stress_15_seam_cut_by_the_clip),
    cmocka_unit_test(stress_16_matrix_scale_2_to_15),
    CASES_TEST(stress_18_the_first_of_equals_stays, twice_case, 300),
    CASES_TEST(stress_19_parallel_pair_at_1_01_buckets, pair_case, 120),
    CASES_TEST(stress_20_interpenetration, crossing_case, 120),
    cmocka_unit_test(others_overflow_that_loops_for_ever),
    CASES_TEST(others_no_area_after_snapping, snapped_away_case, 800)
};

CASES_MAIN(tests)
