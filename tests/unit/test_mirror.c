/* Mirrors and windows: against rays in double precision that are reflected at the mirror, against a scene that is
 * mirrored by hand, and against themselves with other strips, pools and accelerators.
 *
 * SPDX-License-Identifier: MIT
 */
#include <math.h>
#include <string.h>

#include "cases.h"
#include "doubles.h"
#include "fast_lists.h"
#include "../lab/fuzz/world.h"
#include "picture.h"
#include "zs_environment.h"
#include "zs_method.h"
#include "zs_shader.h"

/* ---- Rays in double precision ------------------------------------------------------------------ */

#define TRIS 16
#define W 64
#define H 48
#define SKY 0x7777      /* of the room */
#define SKY_SEEN 0x5555 /* in the mirror */

static int16_t pos[3 * TRIS][3];
static uint16_t tri[TRIS][3], raw[TRIS];
static const int16_t quad_pos[4][3] = { { -64, -48, 0 }, { 64, -48, 0 }, { 64, 48, 0 }, { -64, 48, 0 } };
static const uint16_t quad_tri[2][3] = { { 0, 1, 2 }, { 0, 2, 3 } };
static const struct zs_material raw_both = { .shader = &zs_shade_raw, .cull = ZS_CULL_NONE };
static const struct zs_material raw_back = { .shader = &zs_shade_raw, .cull = ZS_CULL_BACK };
static const struct zs_material raw_front = { .shader = &zs_shade_raw, .cull = ZS_CULL_FRONT };
static const struct zs_material window = { .shader = &zs_shade_window, .cull = ZS_CULL_NONE };

struct room {
    struct zs_mesh mesh, quad;
    struct zs_instance thing[2]; /* what is seen, and the glass */
    struct zs_scene scene, seen;
    struct zs_mirror mirror;
    struct zs_camera camera;
    double glass[3][3], normal[3]; /* world: corner and sides of the glass */
};

static int room_make(struct room *m, struct prng *p, int32_t scale_bits)
{
    const struct zs_material *const materials[3] = { &raw_both, &raw_back, &raw_front };
    for (int t = 0; t < TRIS; t++) {
        const int32_t spread = prng_pick(p, 2) ? 20 : 90;
        int32_t c[3];
        for (int k = 0; k < 3; k++)
            c[k] = prng_range(p, -90, 90);
        for (int i = 0; i < 3; i++) {
            for (int k = 0; k < 3; k++)
                pos[3 * t + i][k] = (int16_t)((c[k] + prng_range(p, -spread, spread)) * (1 << scale_bits));
            tri[t][i] = (uint16_t)(3 * t + i);
        }
        raw[t] = (uint16_t)(t + 1);
    }
    *m = (struct room){ 0 };
    m->mesh = (struct zs_mesh){
        .pos = pos, .tri = tri, .face_raw = raw, .n_verts = 3 * TRIS, .n_tris = TRIS, .scale = ZS_Q16_ONE >> scale_bits,
        .radius = (uint16_t)(320 << scale_bits)
    };
    m->quad = (struct zs_mesh){ .pos = quad_pos, .tri = quad_tri, .n_verts = 4, .n_tris = 2, .radius = 81 };
    m->thing[0] = (struct zs_instance){ .mesh = &m->mesh, .material = materials[prng_pick(p, 3)] };
    m->thing[1] = (struct zs_instance){ .mesh = &m->quad, .material = &window };
    struct zs_pose *const pose = &m->thing[1].pose;
    zs_pose_identity(pose);
    zs_pose_turn(pose, (zs_turn)prng_next(p), (zs_turn)prng_next(p), (zs_turn)prng_next(p));
    for (int k = 0; k < 3; k++)
        pose->pos[k] = prng_range(p, -60, 60);
    if (prng_pick(p, 3) == 0)
        pose->scale = ZS_Q16_ONE / 3;
    for (int k = 0; k < 3; k++) {
        m->normal[k] = q30(pose->rot[3 * k + 2]);
        m->glass[0][k] = pose->pos[k];
        m->glass[1][k] = q30(pose->rot[3 * k]) * 64 * (double)pose->scale / 65536;
        m->glass[2][k] = q30(pose->rot[3 * k + 1]) * 48 * (double)pose->scale / 65536;
    }
    m->scene = (struct zs_scene){ .instance = m->thing, .n_instances = 2, .background = SKY };
    m->seen = (struct zs_scene){ .instance = m->thing, .n_instances = 1, .background = SKY_SEEN };
    if (zs_mirror_of(&m->mirror, &m->thing[1], 0) || zs_camera_perspective(&m->camera, ZS_DEGREES(60), H, 2, 2000))
        return 0;
    int32_t eye[3], at[3];
    const double far_off = prng_range(p, 3, 150);
    for (int k = 0; k < 3; k++) { /* mostly in front of the mirror */
        at[k] = pose->pos[k] + prng_range(p, -30, 30);
        eye[k] = (int32_t)lrint(at[k] + far_off * m->normal[k]) + prng_range(p, -30, 30);
    }
    const int32_t up[3] = { prng_range(p, -9, 9), 20, prng_range(p, -9, 9) };
    return zs_camera_look_at(&m->camera, eye, at, up) == ZS_OK;
}

/* Where a ray from o along d meets a + u b + v c; 0: nowhere. */
static double meets(const double o[3], const double d[3], const double a[3], const double b[3], const double c[3],
                    double *u, double *v)
{
    const double n[3] = { b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0] };
    double nn = 0, nd = 0, na = 0, e[3];
    for (int k = 0; k < 3; k++) {
        nn += n[k] * n[k];
        nd += n[k] * d[k];
        na += n[k] * (a[k] - o[k]);
    }
    if (nn == 0 || nd == 0)
        return 0;
    const double t = na / nd;
    for (int k = 0; k < 3; k++)
        e[k] = o[k] + t * d[k] - a[k];
    *u = (n[0] * (e[1] * c[2] - e[2] * c[1]) + n[1] * (e[2] * c[0] - e[0] * c[2]) +
          n[2] * (e[0] * c[1] - e[1] * c[0])) /
         nn;
    *v = (n[0] * (b[1] * e[2] - b[2] * e[1]) + n[1] * (b[2] * e[0] - b[0] * e[2]) +
          n[2] * (b[0] * e[1] - b[1] * e[0])) /
         nn;
    return t;
}

struct seen {
    int id;         /* a triangle's number from 1 on; 0: nothing */
    double t, next; /* where, and where the next one lies */
    double slope;   /* |cosine| of ray and surface */
};

/* The nearest triangle on a ray, from t on. side: 1, or -1 where facing is exchanged. */
static struct seen look(const struct room *m, const double o[3], const double d[3], double from)
{
    struct seen s = { 0, INFINITY, INFINITY, 1 };
    const uint32_t cull = m->thing[0].material->cull;
    const double unit = 1.0 / (double)(ZS_Q16_ONE / m->mesh.scale);
    for (int t = 0; t < TRIS; t++) {
        double a[3], b[3], c[3], u, v, facing = 0;
        for (int k = 0; k < 3; k++) {
            a[k] = pos[3 * t][k] * unit;
            b[k] = pos[3 * t + 1][k] * unit - a[k];
            c[k] = pos[3 * t + 2][k] * unit - a[k];
        }
        const double at = meets(o, d, a, b, c, &u, &v);
        const double n[3] = { b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0] };
        for (int k = 0; k < 3; k++)
            facing += n[k] * d[k];
        if (at <= from || u < 0 || v < 0 || u + v > 1 || (cull == ZS_CULL_BACK && facing > 0) ||
            (cull == ZS_CULL_FRONT && facing < 0))
            continue;
        if (at < s.t) {
            s.next = s.t;
            s.t = at;
            s.id = t + 1;
            s.slope = fabs(facing) /
                      sqrt((n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) * (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]));
        } else if (at < s.next) {
            s.next = at;
        }
    }
    return s;
}

/* The colour of a place of the frame, px; *near: what decides it is close. *through: it is in the mirror. */
static uint16_t colour(const struct room *m, double x, double y, int *close, int *through)
{
    double o[3], d[3], u, v, front = 0, along = 0;
    const double f = ldexp((double)m->camera.focal, -32);
    const double c[3] = { (x - W / 2) / f, (H / 2 - y) / f,
                          -1 }; /* right, up, back: t is the distance along the axis */
    for (int k = 0; k < 3; k++) {
        o[k] = m->camera.pos[k];
        d[k] = 0;
        for (int i = 0; i < 3; i++)
            d[k] += c[i] * q30(m->camera.rot[3 * i + k]);
        front += m->normal[k] * (o[k] - m->glass[0][k]);
        along += m->normal[k] * d[k];
    }
    const double glass = meets(o, d, m->glass[0], m->glass[1], m->glass[2], &u, &v);
    const struct seen s = look(m, o, d, 2);
    const int in = glass > 2 && fabs(u) <= 1 && fabs(v) <= 1 && glass < 2000;
#define CLOSE(a, b) (fabs((a) - (b)) < 0.002 * (a) + 0.01)
    *close = s.slope < 0.02 || CLOSE(s.t, s.next) || CLOSE(s.t, 2) || (in && (CLOSE(glass, s.t) || CLOSE(glass, 2)));
    *through = in && glass < s.t;
    if (!*through)
        return s.id ? (uint16_t)s.id : SKY;
    *close |= fabs(along) < 0.05;
    if (front <= 0)
        return SKY_SEEN;
    double hit[3], back[3];
    for (int k = 0; k < 3; k++) {
        hit[k] = o[k] + glass * d[k];
        back[k] = d[k] - 2 * along * m->normal[k];
        hit[k] -= glass * back[k]; /* so that t goes on */
    }
    const struct seen r = look(m, hit, back, glass);
    *close |= r.slope < 0.02 || CLOSE(r.t, r.next) || CLOSE(r.t, glass);
    return r.id ? (uint16_t)r.id : SKY_SEEN;
}

static unsigned pixels_right, pixels_mirrored, pixels_close;

static int rays_case(uint64_t seed)
{
    struct prng p = { seed };
    struct room m;
    const int bits = (int)prng_pick(&p, 3);
    if (!room_make(&m, &p, bits))
        return case_wrong("no room");
    const struct zs_pass pass[2] = {
        { .scene = &m.scene, .camera = &m.camera },
        { .scene = &m.seen, .camera = &m.camera, .mirror = &m.mirror, .mask = &zs_mask_window }
    };
    struct zs_config c = picture_config(W, H, prng_pick(&p, 2) ? &zs_depth_float : &zs_depth_linear);
    picture_any_way(&p, &c, 4, 12);
    struct picture got = picture_passes(&c, pass, 2);
    int ok = got.err == ZS_OK || case_wrong("error %d", got.err);
    for (int i = 0; i < W * H && ok; i++) {
        const double x = i % W + 0.5, y = i / W + 0.5, off = 0.02;
        int close = 0, mirrored = 0, beside, mixed = 0;
        const uint16_t want = colour(&m, x, y, &close, &mirrored);
        for (int k = 0; k < 4 && !mixed && !close; k++)
            mixed = colour(&m, x + (k & 1 ? off : -off), y + (k & 2 ? off : -off), &beside, &beside) != want;
        if (mixed || close) {
            pixels_close++;
            continue;
        }
        pixels_right++;
        pixels_mirrored += mirrored && want != SKY_SEEN;
        ok = got.color[i] == want ||
             case_wrong("pixel %d, %d: %x, not %x, mirrored %d", i % W, i / W, got.color[i], want, mirrored);
    }
    picture_free(&got);
    return ok;
}

/* A window that is seen in a mirror, on another place: the three pictures by themselves, the first two with what can
 * be told apart in place of glass, say which is seen at a pixel. */
static unsigned pixels_beyond;

static int window_in_mirror_case(uint64_t seed)
{
    static const uint16_t mark[2] = { 0x8001, 0x8001 };
    static const struct zs_depth_state or_equal = { .func = ZS_DEPTH_LESS_EQUAL };
    struct prng p = { seed };
    struct room m;
    if (!room_make(&m, &p, (int)prng_pick(&p, 3)))
        return case_wrong("no room");
    struct zs_instance in[2] = { m.thing[0], m.thing[1] }; /* in the mirror: the things, the window */
    in[1].pose.pos[0] += prng_range(&p, -60, 60);
    in[1].pose.pos[2] += prng_range(&p, 0, 90);
    zs_pose_turn(&in[1].pose, (zs_turn)prng_next(&p), 0, (zs_turn)prng_next(&p));
    const struct zs_scene seen = { .instance = in, .n_instances = 2, .background = SKY_SEEN };
    const struct zs_scene beyond = { .instance = m.thing, .n_instances = 1, .background = 0x1111 };
    struct zs_pass pass[3] = { { .scene = &m.scene, .camera = &m.camera },
                               { .scene = &seen, .camera = &m.camera, .mirror = &m.mirror },
                               { .scene = &beyond, .camera = &m.camera } };
    struct zs_config c = picture_config(W, H, prng_pick(&p, 2) ? &zs_depth_float : &zs_depth_linear);
    m.quad.face_raw = mark;
    m.thing[1].material = in[1].material = &raw_both;
    m.thing[1].depth_state = in[1].depth_state = &or_equal; /* as windows are drawn */
    struct picture by[3];
    for (int k = 0; k < 3; k++)
        by[k] = picture_passes(&c, pass + k, 1);
    m.thing[1].material = in[1].material = &window;
    m.thing[1].depth_state = in[1].depth_state = NULL;
    pass[1].mask = pass[2].mask = &zs_mask_window;
    picture_any_way(&p, &c, 4, 12);
    struct picture got = picture_passes(&c, pass, 3);
    int ok = (by[0].err == ZS_OK && by[1].err == ZS_OK && by[2].err == ZS_OK && got.err == ZS_OK) ||
             case_wrong("error %d", got.err);
    for (int i = 0; i < W * H && ok; i++) {
        const int k = by[0].color[i] != mark[0] ? 0 : by[1].color[i] != mark[0] ? 1 : 2;
        pixels_beyond += k == 2;
        ok = got.color[i] == by[k].color[i] || case_wrong("pixel %d, %d: %x, not %x of picture %d", i % W, i / W,
                                                          got.color[i], by[k].color[i], k);
    }
    PICTURES_FREE(&by[0], &by[1], &by[2], &got);
    return ok;
}

static void rays_go_on_at_a_mirror(void **state)
{
    (void)state;
    pixels_right = pixels_mirrored = pixels_close = 0;
    CASES(rays_case, 80);
    print_message("%u right, %u of them in the mirror, %u close\n", pixels_right, pixels_mirrored, pixels_close);
    if (cases_all())
        assert_true(pixels_right > 100000 && pixels_mirrored > 5000 && pixels_close < pixels_right / 5);
}

/* ---- A scene mirrored by hand ------------------------------------------------------------------- */

#define POINTS 40
#define FACES 60

struct model {
    int16_t pos[POINTS][3], normal[POINTS][3], face_normal[FACES][3];
    int16_t uv[POINTS][2];
    uint8_t pos_lo[POINTS][3];
    uint16_t tri[FACES][3], raw[FACES];
    struct zs_rgb rgb[POINTS];
    struct zs_mesh mesh;
};

static uint16_t texels[8 * 8];
static const struct zs_texture texture = { .format = &zs_texel_565, .texel = texels, .log2_w = 3, .log2_h = 3 };

static void unit_q15(struct prng *p, int16_t out[3])
{
    double v[3];
    for (int k = 0; k < 3; k++)
        v[k] = prng_range(p, -99, 99) + 0.5;
    unit3(v);
    for (int k = 0; k < 3; k++)
        out[k] = (int16_t)lrint(32767 * v[k]);
}

static void model_make(struct model *m, struct prng *p)
{
    for (int v = 0; v < POINTS; v++) {
        for (int k = 0; k < 3; k++)
            m->pos[v][k] = (int16_t)prng_range(p, -999, 999);
        unit_q15(p, m->normal[v]);
        m->uv[v][0] = (int16_t)prng_range(p, -3000, 3000);
        m->uv[v][1] = (int16_t)prng_range(p, -3000, 3000);
        m->rgb[v] = (struct zs_rgb){ (uint8_t)prng_next(p), (uint8_t)prng_next(p), (uint8_t)prng_next(p) };
    }
    for (int t = 0; t < FACES; t++) {
        for (int i = 0; i < 3; i++)
            m->tri[t][i] = (uint16_t)prng_pick(p, POINTS);
        m->raw[t] = (uint16_t)prng_next(p);
        unit_q15(p, m->face_normal[t]);
    }
    m->mesh = (struct zs_mesh){ .pos = m->pos,
                                .tri = m->tri,
                                .normal = m->normal,
                                .face_normal = m->face_normal,
                                .vertex_rgb = m->rgb,
                                .face_raw = m->raw,
                                .uv = m->uv,
                                .uv_bits = 10,
                                .n_verts = POINTS,
                                .n_tris = FACES,
                                .radius = 1800,
                                .scale = 8191 /* a power of two would round halves */ };
}

/* The same on the other side of a mirror that faces along axis k: triangles turn the other way. */
static void model_turn(struct model *to, const struct model *from, int k)
{
    *to = *from;
    for (int v = 0; v < POINTS; v++) {
        to->pos[v][k] = (int16_t)-to->pos[v][k];
        to->normal[v][k] = (int16_t)-to->normal[v][k];
    }
    for (int t = 0; t < FACES; t++) {
        to->face_normal[t][k] = (int16_t)-to->face_normal[t][k];
        to->tri[t][1] = from->tri[t][2];
        to->tri[t][2] = from->tri[t][1];
    }
    to->mesh.pos = to->pos;
    to->mesh.normal = to->normal;
    to->mesh.face_normal = to->face_normal;
    to->mesh.tri = to->tri;
    to->mesh.vertex_rgb = to->rgb;
    to->mesh.face_raw = to->raw;
    to->mesh.uv = to->uv;
}

static unsigned hands, hands_covered;

/* A mirror along an axis, and all of the scene in front of it: bit for bit the picture of the scene turned over. */
static int hand_case(uint64_t seed)
{
    static const struct zs_shader *const shaders[] = { &zs_shade_raw,          &zs_shade_flat,
                                                       &zs_shade_smooth,       &zs_shade_texture,
                                                       &zs_shade_texture_flat, &zs_shade_texture_smooth,
                                                       &zs_shade_matcap };
    static struct model is, turned;
    struct prng p = { seed };
    const int axis = (int)prng_pick(&p, 3), side = prng_pick(&p, 2) ? 1 : -1;
    const int32_t plane = prng_range(&p, -500, 500);
    struct zs_material material[3];
    struct zs_instance a[3], b[3];
    struct zs_camera camera;
    struct zs_mirror mirror;
    for (int i = 0; i < 64; i++)
        texels[i] = (uint16_t)prng_next(&p);
    model_make(&is, &p);
    model_turn(&turned, &is, axis);
    for (int i = 0; i < 3; i++) {
        material[i] = (struct zs_material){ .shader = shaders[prng_pick(&p, 7)],
                                            .cull = (uint8_t)prng_pick(&p, 3),
                                            .texture = &texture,
                                            .rgb = { 200, 100, 50 } };
        a[i] = (struct zs_instance){ .mesh = &is.mesh, .material = &material[i] };
        for (int k = 0; k < 3; k++)
            a[i].pose.pos[k] = prng_range(&p, -300, 300);
        a[i].pose.pos[axis] = plane + side * prng_range(&p, 230, 500);
        b[i] = a[i];
        b[i].mesh = &turned.mesh;
        b[i].pose.pos[axis] = 2 * plane - a[i].pose.pos[axis];
    }
    int32_t eye[3], at[3], point[3], normal[3] = { 0, 0, 0 };
    const int32_t up[3] = { prng_range(&p, -5, 5), prng_range(&p, 10, 20), prng_range(&p, -5, 5) };
    for (int k = 0; k < 3; k++) {
        eye[k] = prng_range(&p, -300, 300);
        at[k] = b[0].pose.pos[k] + prng_range(&p, -60, 60);
        point[k] = prng_range(&p, -999, 999);
    }
    point[axis] = plane;
    normal[axis] = side * prng_range(&p, 1, 99);
    eye[axis] = plane + side * prng_range(&p, 1, 600);
    struct zs_scene scene = { .instance = a, .n_instances = 3, .background = 77 }, other = scene;
    const double long_way = 1 / sqrt(3);
    for (int k = 0; k < 3; k++)
        scene.light.dir[k] = (zs_q2_30)ldexp(k == 1 ? -long_way : long_way, 30);
    scene.light.diffuse = scene.light.ambient = ZS_Q16_ONE / 2;
    other.instance = b;
    other.light = scene.light;
    other.light.dir[axis] = -scene.light.dir[axis];
    if (zs_mirror_plane(&mirror, point, normal) || zs_camera_perspective(&camera, ZS_DEGREES(50), 60, 3, 4000) ||
        zs_camera_look_at(&camera, eye, at, up))
        return case_wrong("set-up");
    struct zs_config c = picture_config(80, 60, prng_pick(&p, 2) ? &zs_depth_float : &zs_depth_recip);
    if (prng_pick(&p, 4) == 0) {
        if (zs_camera_orthographic(&camera, 900, -900, 3000) || zs_camera_look_at(&camera, eye, at, up))
            return case_wrong("set-up");
        c.depth = &zs_depth_linear;
    }
    struct picture want = picture_draw(&c, &other, &camera);
    picture_any_way(&p, &c, 4, 20);
    const struct zs_pass pass = { .scene = &scene, .camera = &camera, .mirror = &mirror };
    struct picture got = picture_passes(&c, &pass, 1);
    const int ok = want.err == got.err &&
                   (want.err == ZS_ERR_NEAR || (!want.err && picture_same(&want, &got, "by hand")));
    hands++;
    hands_covered += want.err ? 0u : want.covered;
    if (!ok)
        (void)case_wrong("errors %d, %d; axis %d, side %d, depth %s", want.err, got.err, axis, side,
                         c.depth == &zs_depth_linear ? "linear" : "");
    PICTURES_FREE(&want, &got);
    return ok;
}

static void a_scene_mirrored_by_hand(void **state)
{
    (void)state;
    hands = hands_covered = 0;
    CASES(hand_case, 150);
    if (cases_all())
        assert_true(hands_covered > 100u * hands);
}

/* ---- Any strips, pools and accelerators ------------------------------------------------------------ */

static unsigned ways;

/* Random worlds in a random mirror, behind random windows. */
static int way_case(uint64_t seed)
{
    static struct world w;
    struct prng p = { seed };
    struct zs_mirror mirror;
    world_make(&w, &p, 0);
    for (int k = 0; k < WORLD_STATES; k++)
        w.state[k].func = ZS_DEPTH_LESS;
    int32_t point[3], normal[3];
    for (int k = 0; k < 3; k++) {
        normal[k] = prng_range(&p, -9, 9);
        point[k] = w.camera.pos[k] / 2 + prng_range(&p, -1000, 1000);
    }
    normal[1] |= 1;
    CASE_CHECK(zs_mirror_plane(&mirror, point, normal) == ZS_OK);
    const int64_t s = (int64_t)normal[0] * (w.camera.pos[0] - point[0]) +
                      (int64_t)normal[1] * (w.camera.pos[1] - point[1]) +
                      (int64_t)normal[2] * (w.camera.pos[2] - point[2]);
    for (int k = 0; k < 3 && s < 0; k++)
        normal[k] = -normal[k];
    CASE_CHECK(zs_mirror_plane(&mirror, point, normal) == ZS_OK);
    struct zs_instance *const in = w.instance;
    struct zs_material glass = { .shader = &zs_shade_window, .cull = ZS_CULL_NONE };
    struct zs_instance seen_in[WORLD_INSTANCES];
    struct zs_scene holes = w.scene, seen = w.scene;
    seen.instance = seen_in;
    if (seen.n_instances > w.n_instances)
        seen.n_instances = w.n_instances;
    memcpy(seen_in, in, seen.n_instances * sizeof *in);
    holes.n_resolves = seen.n_resolves = 0;
    for (uint32_t k = 0; k < w.n_instances; k++)
        if (prng_pick(&p, 2))
            in[k].material = &glass;
    struct zs_pass pass[2] = { { .scene = &holes, .camera = &w.camera },
                               { .scene = &seen, .camera = &w.camera, .mirror = &mirror, .mask = &zs_mask_window } };
    struct zs_config c = {
        .width = (uint16_t)prng_range(&p, 1, 90), .height = (uint16_t)prng_range(&p, 1, 70), .max_tris = 4000,
        .max_verts = 8000, .varyings = ZS_VARYINGS_MAX
    };
    c.depth = w.camera.projection == ZS_ORTHOGRAPHIC ? &zs_depth_linear
              : prng_pick(&p, 2)                     ? &zs_depth_float
                                                     : &zs_depth_recip;
    c.depth_bits = (uint8_t)prng_range(&p, 8, 16);
    c.strip_h = c.height;
    if (prng_pick(&p, 3) == 0)
        pass[0].viewport = pass[1].viewport = (struct zs_rect){ (uint16_t)(c.width / 3), (uint16_t)(c.height / 4),
                                                                (uint16_t)(c.width / 2 + 1),
                                                                (uint16_t)(c.height / 2 + 1) };
    struct picture want = picture_passes(&c, pass, 2);
    picture_any_way(&p, &c, 1, 3);
    struct picture got = picture_passes(&c, pass, 2);
    ways += !want.err && want.stats.tris_drawn > 10;
    world_free(&w);
    return picture_alike(&want, &got, "another way");
}

/* ---- Stress ------------------------------------------------------------------------------------------ */

/* A room whose glass fills the frame: it faces the eye, at a distance. */
static void facing(struct room *m, int32_t distance)
{
    *m = (struct room){ 0 };
    static const int32_t eye[3] = { 0, 0, 0 }, along[3] = { 0, 0, -1 }, up[3] = { 0, 1, 0 };
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            pos[i][k] = (int16_t)(k == 2 ? 0 : i == 2 ? (k ? 20 : 0) : (k ? -20 : i ? 20 : -20));
    for (int i = 0; i < 3; i++)
        tri[0][i] = (uint16_t)i;
    raw[0] = 1;
    m->mesh = (struct zs_mesh){ .pos = pos, .tri = tri, .face_raw = raw, .n_verts = 3, .n_tris = 1, .radius = 30 };
    m->quad = (struct zs_mesh){ .pos = quad_pos, .tri = quad_tri, .n_verts = 4, .n_tris = 2, .radius = 81 };
    m->thing[0] = (struct zs_instance){ .mesh = &m->mesh, .material = &raw_both, .pose.pos = { 0, 0, 40 } };
    m->thing[1] = (struct zs_instance){ .mesh = &m->quad, .material = &window, .pose.pos = { 0, 0, -distance } };
    assert_int_equal(zs_camera_perspective(&m->camera, ZS_DEGREES(60), H, 2, 2000), ZS_OK);
    assert_int_equal(zs_camera_look_along(&m->camera, eye, along, up), ZS_OK);
    assert_int_equal(zs_mirror_of(&m->mirror, &m->thing[1], 0), ZS_OK);
}

static struct picture drawn(struct room *m)
{
    m->scene = (struct zs_scene){ .instance = m->thing, .n_instances = 2, .background = SKY };
    m->seen = (struct zs_scene){ .instance = m->thing, .n_instances = 1, .background = SKY_SEEN };
    const struct zs_pass pass[2] = {
        { .scene = &m->scene, .camera = &m->camera },
        { .scene = &m->seen, .camera = &m->camera, .mirror = &m->mirror, .mask = &zs_mask_window }
    };
    struct zs_config c = picture_config(W, H, &zs_depth_linear);
    c.strip_h = 7;
    struct picture p = picture_passes(&c, pass, 2);
    assert_int_equal(p.err, ZS_OK);
    return p;
}

static uint32_t count(const struct picture *p, uint16_t colour_)
{
    uint32_t n = 0;
    for (int i = 0; i < p->w * p->h; i++)
        n += p->color[i] == colour_;
    return n;
}

/* What is behind the eye is seen, once, and what is in the plane of the mirror or behind it is not. */
static void stress_41_the_eye_near_the_plane(void **state)
{
    (void)state;
    for (int32_t distance = 3; distance < 30; distance += 9) {
        struct room m;
        facing(&m, distance);
        struct picture p = drawn(&m);
        assert_in_range(count(&p, 1), 20, W * H / 2);
        assert_int_equal(count(&p, 1) + count(&p, SKY_SEEN) + count(&p, SKY), W * H);
        picture_free(&p);
        m.thing[0].pose.pos[2] = -distance - 1;
        p = drawn(&m);
        assert_int_equal(count(&p, 1), 0);
        picture_free(&p);
    }
    for (int32_t eye = -1; eye <= 1; eye++) { /* 1 in front, in the plane, 1 behind: the glass is before near */
        struct room m;
        facing(&m, 1);
        m.camera.pos[2] = eye - 1;
        struct picture p = drawn(&m);
        assert_int_equal(count(&p, SKY), W * H);
        picture_free(&p);
        const struct zs_pass alone = { .scene = &m.seen, .camera = &m.camera, .mirror = &m.mirror };
        const struct zs_config c = picture_config(W, H, &zs_depth_linear);
        p = picture_passes(&c, &alone, 1); /* no mask: a mirror that fills the frame */
        assert_int_equal(p.err, ZS_OK);
        if (eye > 0)
            assert_in_range(count(&p, 1), 20, W * H / 2);
        else
            assert_int_equal(count(&p, SKY_SEEN), W * H);
        picture_free(&p);
    }
    struct room m;
    facing(&m, 20); /* turned away: its back is a window, in which only the background is */
    for (int k = 0; k < 3; k++)
        m.mirror.normal[k] = -m.mirror.normal[k];
    m.mirror.at = -m.mirror.at;
    struct picture p = drawn(&m);
    assert_int_equal(count(&p, SKY_SEEN), W * H);
    picture_free(&p);
}

/* Keys at both ends of their range, by bias: 0 in the room and in the mirror, and the largest one. */
static void stress_42_a_bias_that_saturates(void **state)
{
    static const struct zs_depth_state nearest = { .bias = -32768, .slope_bias = -32768 },
                                       farthest = { .bias = 32767 }, twice = { .bias = 32767, .slope_bias = 32767 };
    (void)state;
    struct room m;
    facing(&m, 30);
    struct picture plain = drawn(&m);
    m.thing[0].depth_state = &nearest; /* in the mirror alone: the room's is behind the eye */
    struct picture p = drawn(&m);
    assert_int_equal(memcmp(p.color, plain.color, sizeof *p.color * W * H), 0);
    PICTURES_FREE(&p, &plain);
    m.thing[1].depth_state = &farthest; /* a window behind all else, but before the background */
    m.camera.z_far = 100 * 65536;
    p = drawn(&m);
    assert_in_range(count(&p, 1), 20, W * H / 2);
    assert_int_equal(count(&p, SKY), 0);
    picture_free(&p);
    /* at the largest key, over the keys of a pass before it */
    m.camera.z_far = 40 * 65536;
    const struct zs_scene none = { .background = SKY };
    const struct zs_pass pass[3] = {
        { .scene = &none, .camera = &m.camera },
        { .scene = &m.scene, .camera = &m.camera, .keep = ZS_KEEP_COLOR | ZS_KEEP_DEPTH },
        { .scene = &m.seen, .camera = &m.camera, .mirror = &m.mirror, .mask = &zs_mask_window }
    };
    const struct zs_config c = picture_config(W, H, &zs_depth_linear);
    p = picture_passes(&c, pass, 3);
    assert_int_equal(p.err, ZS_OK);
    assert_int_equal(count(&p, SKY), 0);
    picture_free(&p);
    /* something before the glass, at key 0: it stays, and nothing of the mirror is seen there, nor it in the mirror */
    facing(&m, 30);
    m.thing[0].pose.pos[2] = -10;
    m.thing[0].depth_state = &nearest;
    p = drawn(&m);
    const uint32_t in_front = count(&p, 1);
    picture_free(&p);
    m.thing[0].depth_state = NULL;
    plain = drawn(&m);
    assert_int_equal(count(&plain, 1), in_front);
    assert_true(in_front > 1000); /* it covers its picture */
    picture_free(&plain);
    /* and behind the glass, at the largest key, drawn before a window that is moved there as well */
    m.camera.z_far = 40 * 65536;
    m.thing[0].pose.pos[2] = -35;
    m.thing[0].depth_state = &twice;
    m.thing[1].depth_state = &twice;
    p = drawn(&m);
    assert_int_equal(count(&p, SKY_SEEN), W * H); /* equal keys: the window wins */
    picture_free(&p);
    facing(&m, 6); /* at the key 0, too */
    m.thing[0].pose.pos[2] = -8;
    m.thing[0].depth_state = &nearest;
    p = drawn(&m);
    assert_true(count(&p, 1) > 1000);
    picture_free(&p);
    m.thing[1].depth_state = &nearest;
    p = drawn(&m);
    assert_int_equal(count(&p, SKY_SEEN), W * H);
    picture_free(&p);
}

/* The eye's picture in a mirror is not in whole world units. What is close to near or far is there all the same, and
 * what is far beside is culled. */
static void close_to_near_and_far_in_a_mirror(void **state)
{
    static const int16_t corner[3][3] = { { 8, 0, 0 }, { 0, 8, 0 }, { 0, 0, -8 } }; /* 1/256 world unit each */
    static const int32_t eye[3] = { 0, 0, 2 }, along[3] = { 0, 0, -1 }, up[3] = { 0, 1, 0 };
    static const int32_t point[3] = { 0, 0, 0 }, normal[3] = { 1, 1, 3 };
    const double axis = 41.0 / 11; /* of (1, 1, 1) from the eye's picture, (-12, -12, -14) / 11, along the axis */
    (void)state;
    struct room m;
    facing(&m, 20);
    const struct zs_mesh mesh = { .pos = corner, .tri = tri, .face_raw = raw, .n_verts = 3, .n_tris = 1, .radius = 9,
                                  .scale = 256 };
    const struct zs_instance in[2] = { { .mesh = &mesh, .material = &raw_both, .pose.pos = { 1, 1, 1 } },
                                       { .mesh = &mesh, .material = &raw_both, .pose.pos = { 7, -5, 1 } } };
    const struct zs_scene scene = { .instance = in, .n_instances = 2, .background = SKY };
    const struct zs_config c = picture_config(W, H, &zs_depth_linear);
    const struct zs_pass pass = { .scene = &scene, .camera = &m.camera, .mirror = &m.mirror };
    assert_int_equal(zs_mirror_plane(&m.mirror, point, normal), ZS_OK);
    assert_int_equal(zs_camera_perspective(&m.camera, ZS_DEGREES(6), H, 1, 100), ZS_OK);
    assert_int_equal(zs_camera_look_along(&m.camera, eye, along, up), ZS_OK);
    struct picture want = picture_passes(&c, &pass, 1);
    assert_in_range(count(&want, 1), 3, 20);
    m.camera.z_near = (zs_q48_16)((axis - 0.1) * 65536);
    struct picture at_near = picture_passes(&c, &pass, 1);
    assert_int_equal(at_near.stats.instances_culled, 1);
    m.camera.z_near = 65536;
    m.camera.z_far = (zs_q48_16)((axis + 0.1) * 65536);
    struct picture at_far = picture_passes(&c, &pass, 1);
    assert_int_equal(at_near.err, ZS_OK);
    assert_int_equal(at_far.err, ZS_OK);
    assert_memory_equal(at_near.color, want.color, sizeof *want.color * W * H);
    assert_memory_equal(at_far.color, want.color, sizeof *want.color * W * H);
    PICTURES_FREE(&want, &at_near, &at_far);
}

/* A rear-view mirror: a pass in a viewport over the road. What is behind the eye on its left is on the left in it, in a
 * picture that, turned over, is that of a camera which looks back; the rest of the frame is the road. */
static void a_rear_view_mirror(void **state)
{
    static const struct zs_rect at = { 16, 4, 32, 16 };
    static const int32_t eye[3] = { 0, 0, 0 }, ahead[3] = { 0, 0, -1 }, back[3] = { 0, 0, 1 }, up[3] = { 0, 1, 0 };
    static const int32_t nose[3] = { 0, 0, -3 }, beyond[3] = { 0, 0, -6 };
    struct room m;
    struct zs_camera rear, behind;
    uint32_t differ = 0, left = 0;
    (void)state;
    facing(&m, 20);
    m.thing[0].pose.pos[0] = -15; /* on the left, behind the eye: z is 40 */
    m.thing[0].pose.pos[2] = 40;
    m.seen = (struct zs_scene){ .instance = m.thing, .n_instances = 1, .background = SKY_SEEN };
    m.scene = (struct zs_scene){ .background = SKY };
    assert_int_equal(zs_mirror_plane(&m.mirror, nose, back), ZS_OK);
    assert_int_equal(zs_camera_perspective(&rear, ZS_DEGREES(60), at.h, 4, 200), ZS_OK);
    behind = rear;
    assert_int_equal(zs_camera_look_along(&rear, eye, ahead, up), ZS_OK);
    assert_int_equal(zs_camera_look_along(&behind, beyond, back, up), ZS_OK);
    const struct zs_pass pass[2] = { { .scene = &m.scene, .camera = &m.camera },
                                     { .scene = &m.seen, .camera = &rear, .viewport = at, .mirror = &m.mirror } };
    struct zs_config c = picture_config(W, H, &zs_depth_linear);
    struct picture got = picture_passes(&c, pass, 2);
    c.width = at.w;
    c.height = at.h;
    struct picture want = picture_draw(&c, &m.seen, &behind);
    assert_int_equal(got.err, ZS_OK);
    assert_int_equal(want.err, ZS_OK);
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++) {
            const int inside = x >= at.x && x < at.x + at.w && y >= at.y && y < at.y + at.h;
            const uint16_t is = got.color[y * W + x];
            if (!inside)
                assert_int_equal(is, SKY);
            else
                differ += is != want.color[(y - at.y) * at.w + at.w - 1 - (x - at.x)];
            left += is == 1 && x < W / 2;
        }
    assert_in_range(count(&got, 1), 40, 300);
    assert_true(left * 4 > count(&got, 1) * 3);
    assert_true(differ <= 4); /* samples on edges: the left one belongs to the triangle, the right one does not */
    struct zs_camera same;
    assert_int_equal(zs_mirror_camera(&same, &rear, &m.mirror), ZS_OK);
    for (int k = 0; k < 9; k++)
        assert_int_equal(same.rot[k], behind.rot[k]);
    assert_memory_equal(same.pos, behind.pos, sizeof same.pos);
    m.mirror.at += (int64_t)10 << 30;
    assert_int_equal(zs_mirror_camera(&same, &rear, &m.mirror), ZS_ERR_VECTOR);
    assert_int_equal(same.pos[2], -6);
    PICTURES_FREE(&got, &want);
}

/* ---- Wrong mirrors ------------------------------------------------------------------------------------- */

static void wrong_mirrors_are_refused(void **state)
{
    static int16_t bent[4][3];
    static const uint16_t none[1][3] = { { 1, 1, 1 } }, beyond[1][3] = { { 0, 1, 4 } };
    (void)state;
    struct zs_mirror mirror = { 0 };
    struct room m;
    facing(&m, 20);
    int32_t point[3] = { 0, 0, ZS_WORLD_MAX }, normal[3] = { 0, 0, 0 };
    assert_int_equal(zs_mirror_plane(&mirror, point, normal), ZS_ERR_VECTOR);
    normal[2] = 1;
    assert_int_equal(zs_mirror_plane(&mirror, point, normal), ZS_OK);
    point[2]++;
    assert_int_equal(zs_mirror_plane(&mirror, point, normal), ZS_ERR_RANGE);

    memcpy(bent, quad_pos, sizeof bent);
    bent[3][2] = 3;
    struct zs_instance in = m.thing[1];
    m.quad.pos = bent;
    const struct zs_mirror before = mirror;
    assert_int_equal(zs_mirror_of(&mirror, &in, 2 * 256), ZS_ERR_MESH);
    assert_memory_equal(&mirror, &before, sizeof mirror);
    assert_int_equal(zs_mirror_of(&mirror, &in, 3 * 256), ZS_OK);
    m.quad.pos = quad_pos;
    m.quad.n_tris = 1;
    m.quad.tri = none;
    assert_int_equal(zs_mirror_of(&mirror, &in, 0), ZS_ERR_MESH);
    m.quad.tri = beyond;
    assert_int_equal(zs_mirror_of(&mirror, &in, 0), ZS_ERR_MESH);
    m.quad.tri = NULL;
    assert_int_equal(zs_mirror_of(&mirror, &in, 0), ZS_ERR_NULL);
    assert_int_equal(zs_mirror_of(&mirror, NULL, 0), ZS_ERR_NULL);
    m.quad.tri = quad_tri;
    assert_int_equal(zs_mirror_of(NULL, &in, 0), ZS_ERR_NULL);
    const struct zs_pose pose = in.pose;
    in.pose.rot[0] = in.pose.rot[4] = in.pose.rot[8] = ZS_Q30_ONE / 2; /* shrinks */
    assert_int_equal(zs_mirror_of(&mirror, &in, 0), ZS_ERR_RANGE);
    in.pose = pose;
    assert_int_equal(zs_mirror_of(&mirror, &in, 0), ZS_OK);
    in.pose.pos[0] = -ZS_WORLD_MAX - 1;
    assert_int_equal(zs_mirror_of(&mirror, &in, 0), ZS_ERR_RANGE);
    facing(&m, 20);

    static struct zs_renderer r;
    static struct zs_pass_memory memory[2];
    static uint32_t arena[30000];
    struct zs_depth_state state_of = { .func = ZS_DEPTH_LESS };
    m.scene = (struct zs_scene){ .instance = m.thing, .n_instances = 2 };
    m.seen = (struct zs_scene){ .instance = m.thing, .n_instances = 1 };
    m.thing[0].depth_state = &state_of;
    struct zs_config c = picture_config(W, H, &zs_depth_linear);
    c.max_tris = c.max_verts = 100;
    const struct zs_pass good[2] = {
        { .scene = &m.scene, .camera = &m.camera },
        { .scene = &m.seen, .camera = &m.camera, .mirror = &m.mirror, .mask = &zs_mask_window }
    };
    struct zs_pass pass[2] = { good[0], good[1] };
    assert_int_equal(zs_init(&r, &c, arena, sizeof arena), ZS_OK);
#define BEGINS(error)                                                                                                 \
    do {                                                                                                              \
        assert_int_equal(zs_frame_begin_passes(&r, pass, memory, 2), error);                                          \
        pass[0] = good[0];                                                                                            \
        pass[1] = good[1];                                                                                            \
    } while (0)
    BEGINS(ZS_OK);
    state_of.func = ZS_DEPTH_LESS_EQUAL;
    BEGINS(ZS_ERR_PASS);
    state_of.func = ZS_DEPTH_ALWAYS;
    BEGINS(ZS_ERR_PASS);
    pass[1].mask = NULL;
    BEGINS(ZS_OK);
    state_of.func = ZS_DEPTH_LESS;
    pass[0].mask = &zs_mask_window; /* of no pass */
    BEGINS(ZS_ERR_PASS);
    pass[1].keep = ZS_KEEP_COLOR;
    BEGINS(ZS_ERR_PASS);
    pass[0].viewport = (struct zs_rect){ 0, 0, 10, 10 };
    BEGINS(ZS_ERR_PASS);
    pass[1].viewport = (struct zs_rect){ 0, 0, W, H - 1 };
    BEGINS(ZS_ERR_PASS);
    pass[1].mirror = &(const struct zs_mirror){ 0 }; /* not set */
    BEGINS(ZS_ERR_NULL);
    point[2] = -ZS_WORLD_MAX;
    assert_int_equal(zs_mirror_plane(&m.mirror, point, normal), ZS_OK);
    BEGINS(ZS_ERR_RANGE); /* the eye would be at twice that */
    c.depth = &zs_depth_none;
    assert_int_equal(zs_mirror_of(&m.mirror, &m.thing[1], 0), ZS_OK);
    assert_int_equal(zs_init(&r, &c, arena, sizeof arena), ZS_OK);
    BEGINS(ZS_ERR_PASS); /* a mask is made of keys */
}

/* A method that is not the depth buffer draws nothing for a window. */
static void windows_of_other_methods(void **state)
{
    (void)state;
    struct zs_config c = picture_config(W, H, &zs_depth_none);
    struct room m;
    for (uint64_t seed = 1; seed <= 20; seed++) {
        struct prng p = { seed };
        assert_true(room_make(&m, &p, 0));
        c.method = &zs_method_painter;
        struct picture with = picture_draw(&c, &m.scene, &m.camera);
        m.scene.n_instances = 1;
        struct picture without = picture_draw(&c, &m.scene, &m.camera);
        assert_int_equal(with.err, ZS_OK);
        assert_memory_equal(with.color, without.color, sizeof *with.color * W * H);
        PICTURES_FREE(&with, &without);
    }
}

/* A window within a window: where the first one is not, nothing is opened, as near as the second may come. */
static void a_window_opens_no_more_than_its_mask(void **state)
{
    (void)state;
    static const int16_t corner[4][3] = { { -100, -100, 0 }, { 100, -100, 0 }, { 100, 100, 0 }, { -100, 100, 0 } };
    static const uint16_t half[2][3] = { { 0, 1, 2 }, { 0, 2, 3 } };
    const struct zs_mesh pane = { .pos = corner, .tri = half, .n_verts = 4, .n_tris = 2, .radius = 142 };
    const struct zs_material glass = { .shader = &zs_shade_window, .cull = ZS_CULL_NONE };
    for (int32_t bias = 0; bias >= INT16_MIN; bias = bias ? 2 * bias : -8)
        for (uint8_t bits = 8; bits <= 16; bits++) {
            struct zs_camera camera;
            assert_int_equal(zs_camera_perspective(&camera, ZS_DEGREES(60), 64, 100, 10000), ZS_OK);
            const struct zs_depth_state moved = { .bias = (int16_t)bias };
            const struct zs_instance small = { .mesh = &pane, .material = &glass, .pose = { .pos = { 0, 0, -400 },
                                                                                            .scale = 65536 / 4 } },
                                     large = { .mesh = &pane, .material = &glass, .pose = { .pos = { 0, 0, -110 } },
                                               .depth_state = &moved };
            const struct zs_scene scene[3] = { { .instance = &small, .n_instances = 1, .background = 1 },
                                               { .instance = &large, .n_instances = 1, .background = 2 },
                                               { .background = 3 } };
            const struct zs_pass pass[3] = { { .scene = &scene[0], .camera = &camera },
                                             { .scene = &scene[1], .camera = &camera, .mask = &zs_mask_window },
                                             { .scene = &scene[2], .camera = &camera, .mask = &zs_mask_window } };
            struct zs_config c = picture_config(64, 64, bits & 1 ? &zs_depth_linear : &zs_depth_recip);
            c.depth_bits = bits;
            struct picture p = picture_passes(&c, pass, 3);
            assert_int_equal(p.err, ZS_OK);
            uint32_t n[4] = { 0 };
            for (int k = 0; k < p.w * p.h; k++)
                n[p.color[k] & 3u]++;
            assert_int_equal(n[1], 64 * 64 - n[3]);
            assert_in_range(n[3], 36, 64);
            picture_free(&p);
        }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_window_opens_no_more_than_its_mask),
    cmocka_unit_test(windows_of_other_methods),
    cmocka_unit_test(rays_go_on_at_a_mirror),
    CASES_COUNT(a_window_in_a_mirror, window_in_mirror_case, 100, &pixels_beyond, 5000, "pixels seen through both"),
    cmocka_unit_test(a_scene_mirrored_by_hand),
    CASES_COUNTS(any_way_is_the_same, way_case, 200, { "ways", &ways, 60 }),
    cmocka_unit_test(stress_41_the_eye_near_the_plane),
    cmocka_unit_test(stress_42_a_bias_that_saturates),
    cmocka_unit_test(close_to_near_and_far_in_a_mirror),
    cmocka_unit_test(a_rear_view_mirror),
    cmocka_unit_test(wrong_mirrors_are_refused),
};
CASES_MAIN(tests)
