/* Light on textures with highlights on top (effect/lit_gloss.c, lit_gloss_pixel.c) against sim/reference, pixel by
 * pixel, under lamps of all kinds.
 *
 * SPDX-License-Identifier: MIT
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cases.h"
#include "doubles.h"
#include "picture.h"
#include "reference.h"
#include "zs_lights.h"

#define W 96
#define H 72
#define SIDE 8 /* texels */

struct kind {
    const char *name;
    const struct zs_shader *shader;
    int pixel, white; /* flags: lit at each pixel; lamps have no colour */
};
static const struct kind kinds[] = { { "gloss", &zs_shade_texture_gloss, 0, 1 },
                                     { "gloss_tinted", &zs_shade_texture_gloss_tinted, 0, 0 },
                                     { "phong", &zs_shade_texture_phong, 1, 0 } };

struct setting {
    struct zs_lamp lamp[ZS_LIGHTS_MAX];
    struct zs_lighting lighting;
    struct zs_shine shine;
    struct zs_lit_material material;
    struct zs_texture texture;
    uint16_t texel[SIDE * SIDE];
    int16_t pos[3][3], uv[3][2];
    zs_q1_15 normal[3][3];
    struct ref_lamp ref_lamp[ZS_LIGHTS_MAX];
    struct ref_light ref_light;
    struct ref_texture ref_texture;
    struct ref_triangle ref;
};

static struct zs_rgb any_rgb(struct prng *p)
{
    const uint32_t c = prng_pick(p, 4) ? prng_next(p) & 0xffffffu : 0xffffffu;
    return (struct zs_rgb)ZS_RGB(c);
}

static void to_doubles(double out[3], struct zs_rgb c)
{
    out[0] = c.r / 255.0;
    out[1] = c.g / 255.0;
    out[2] = c.b / 255.0;
}

static void any_lamps(struct setting *s, struct prng *p, const struct kind *kind)
{
    const uint8_t grey = (uint8_t)prng_pick(p, 64);
    s->lighting = (struct zs_lighting){ .lamp = s->lamp,
                                        .n_lamps = (uint32_t)prng_range(p, 1, 3),
                                        .ambient = { grey, grey, grey } };
    s->ref_light = (struct ref_light){ .ambient = grey / 255.0,
                                       .lamp = s->ref_lamp,
                                       .n_lamps = (int)s->lighting.n_lamps,
                                       .per_pixel = kind->pixel };
    for (uint32_t i = 0; i < s->lighting.n_lamps; i++) {
        struct zs_lamp *l = &s->lamp[i];
        struct ref_lamp *r = &s->ref_lamp[i];
        int32_t d[3];
        l->kind = (uint8_t)prng_pick(p, 3);
        if (!kind->white)
            l->rgb = any_rgb(p);
        if (!(l->rgb.r | l->rgb.g | l->rgb.b))
            l->rgb = (struct zs_rgb)ZS_RGB(0xffffff);
        l->strength = prng_pick(p, ZS_Q16_ONE) + ZS_Q16_ONE / 4;
        do
            for (int k = 0; k < 3; k++)
                d[k] = prng_range(p, -999, 999);
        while (zs_unit(l->dir, d));
        for (int k = 0; k < 3; k++)
            l->pos[k] = prng_range(p, -2500, 2500) - (k == 2 ? 600 : 0);
        l->range = prng_pick(p, 2) ? (uint32_t)prng_range(p, 1000, 9000) : 0;
        l->inner = prng_range(p, 0, ZS_Q30_ONE);
        l->outer = l->inner - prng_range(p, ZS_Q30_ONE / 8, ZS_Q30_ONE / 2);
        r->kind = l->kind;
        to_doubles(r->rgb, l->rgb);
        for (int k = 0; k < 3; k++) {
            r->at[k] = l->kind == ZS_LAMP_DIRECTIONAL ? q30(l->dir[k]) : l->pos[k];
            r->aim[k] = q30(l->dir[k]);
            r->rgb[k] *= l->strength / 65536.0;
        }
        r->range = l->range;
        r->inner = q30(l->inner);
        r->outer = q30(l->outer);
    }
}

static void any_surface(struct setting *s, struct prng *p, const struct kind *kind)
{
    const unsigned power = prng_pick(p, 3) ? (unsigned)prng_range(p, 1, 128) : 1u << prng_pick(p, 8);
    struct zs_lit_material *m = &s->material;
    m->lighting = &s->lighting;
    m->specular = any_rgb(p);
    m->emission = prng_pick(p, 3) ? (struct zs_rgb){ 0 } : (struct zs_rgb)ZS_RGB(prng_next(p) & 0x1f1f1fu);
    m->flags = prng_pick(p, 2) ? ZS_LIT_TWO_SIDED : 0;
    m->material = (struct zs_material){ .shader = kind->shader, .texture = &s->texture, .cull = ZS_CULL_NONE };
    if (prng_pick(p, 5) && zs_shine_set(&s->shine, power) == ZS_OK) {
        m->shine = &s->shine;
        s->ref.power = power;
        to_doubles(s->ref.specular, m->specular);
    }
    to_doubles(s->ref.emission, m->emission);
    s->ref.two_sided = m->flags != 0;
    for (int i = 0; i < SIDE * SIDE; i++)
        s->texel[i] = (uint16_t)prng_next(p);
    s->texture = (struct zs_texture){ .format = &zs_texel_565, .texel = s->texel, .log2_w = 3, .log2_h = 3 };
    s->ref_texture = (struct ref_texture){ .width = SIDE, .height = SIDE, .rgb565 = s->texel };
}

/* A triangle before the eye, whose normals are up to 60 degrees apart. */
static void any_triangle(struct setting *s, struct prng *p)
{
    const int deep = prng_pick(p, 2);
    const int32_t middle[3] = { prng_range(p, -500, 500), prng_range(p, -500, 500), 500 };
    s->ref.id = 1;
    s->ref.shade = REF_SHADE_TEXTURE_SMOOTH;
    s->ref.cull = REF_CULL_NONE;
    s->ref.texture = &s->ref_texture;
    for (int v = 0; v < 3; v++) {
        const int32_t z = deep ? prng_range(p, 300, 6000) : 1500 + prng_range(p, -300, 300);
        double n[3];
        for (int k = 0; k < 2; k++) {
            s->pos[v][k] = (int16_t)(prng_range(p, -900, 900) * z / 1000);
            s->uv[v][k] = (int16_t)prng_range(p, 0, 4095); /* an eighth of a repeat: one or two texels */
            s->ref.uv[v][k] = s->uv[v][k] / 32768.0;
        }
        s->pos[v][2] = (int16_t)-z;
        for (int k = 0; k < 3; k++)
            n[k] = middle[k] + prng_range(p, -300, 300);
        unit3(n);
        for (int k = 0; k < 3; k++) {
            s->normal[v][k] = (zs_q1_15)lrint(n[k] * 32767);
            s->ref.n[v][k] = s->normal[v][k];
            s->ref.p[v][k] = s->pos[v][k];
        }
    }
}

static double dot3(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* How near the light at a point is to where a highlight begins or a side is turned: least |cosine|. */
static double edge_at(const struct setting *s, const double at[3], const double normal[3])
{
    double n[3] = { normal[0], normal[1], normal[2] }, eye[3] = { -at[0], -at[1], -at[2] }, least = 1;
    unit3(n);
    unit3(eye);
    if (s->material.flags)
        least = fabs(dot3(n, eye));
    for (uint32_t i = 0; i < s->lighting.n_lamps; i++) {
        const struct ref_lamp *r = &s->ref_lamp[i];
        double l[3];
        for (int k = 0; k < 3; k++)
            l[k] = r->kind == REF_LAMP_DIR ? r->at[k] : r->at[k] - at[k];
        unit3(l);
        least = fmin(least, fabs(dot3(n, l)));
    }
    return least;
}

static struct {
    unsigned long n, beyond_two, pixels;
    double worst;
} tally;

static int counted(uint32_t is, double want, int most)
{
    const double off = fabs(is - want * most);
    tally.n++;
    tally.beyond_two += off > 2;
    tally.worst = fmax(tally.worst, off);
    return off <= 3;
}

/* Which side of the texture's lattice a point is on must be sure. */
static int on_border(double c)
{
    const double t = c * SIDE - floor(c * SIDE);
    return t < 0.13 || t > 0.87;
}

static int frame_case(uint64_t seed, const struct kind *kind)
{
    static const uint16_t tri[1][3] = { { 0, 1, 2 } };
    static uint16_t key[W * H];
    static double rgb[W * H * 3], z[W * H], u[W * H], v[W * H];
    struct prng p = { seed };
    struct setting s;
    struct zs_camera camera;
    memset(&s, 0, sizeof s);
    any_lamps(&s, &p, kind);
    any_surface(&s, &p, kind);
    any_triangle(&s, &p);
    const struct zs_mesh mesh = { .pos = (const int16_t(*)[3])s.pos,
                                  .tri = tri,
                                  .normal = (const zs_q1_15(*)[3])s.normal,
                                  .uv = (const int16_t(*)[2])s.uv,
                                  .uv_bits = 15,
                                  .n_verts = 3,
                                  .n_tris = 1,
                                  .radius = 65535 };
    const struct zs_instance in = { .mesh = &mesh, .material = &s.material.material };
    const struct zs_scene scene = { .instance = &in, .n_instances = 1 };
    if (zs_camera_perspective(&camera, ZS_DEGREES(60), H, 100, 40000))
        return case_wrong("camera");
    struct zs_config c = picture_config(W, H, &zs_depth_float);
    c.varyings = kind->shader->n_varyings;
    struct picture is = picture_draw(&c, &scene, &camera);
    if (is.err)
        return case_wrong("error %d", is.err);
    const double focal = ldexp((double)camera.focal, -32);
    const struct ref_camera eye = { .right = { 1, 0, 0 }, .up = { 0, 1, 0 }, .back = { 0, 0, 1 },
                                    .focal = focal, .near_z = 100, .far_z = 40000 };
    const struct ref_depth depth = { REF_DEPTH_E4M12, 16 };
    struct ref_image want = { .key = key, .rgb = rgb, .z = z, .u = u, .v = v };
    if (ref_render(&s.ref, 1, &eye, &s.ref_light, &depth, 0, W, H, &want, NULL, NULL) != REF_OK)
        return case_wrong("the reference refuses it");
    int right = 1, sure = 1;
    for (int k = 0; k < 3 && !kind->pixel; k++) /* where a vertex is in doubt, all is */
        sure &= edge_at(&s, s.ref.p[k], s.ref.n[k]) > 0x1p-11;
    for (int32_t i = 0; i < W * H && right && sure; i++) {
        if (is.key[i] == ZS_DEPTH_CLEAR || key[i] == REF_KEY_NOTHING || on_border(u[i]) || on_border(v[i]))
            continue;
        if (kind->pixel) {
            const double x = (i % W + 0.5 - W / 2.0) / focal, y = -((double)(i / W) + 0.5 - H / 2.0) / focal;
            const double at[3] = { x * z[i], y * z[i], -z[i] };
            double e[2][3], d[3], n[3] = { 0 };
            for (int k = 0; k < 3; k++) {
                e[0][k] = s.ref.p[1][k] - s.ref.p[0][k];
                e[1][k] = s.ref.p[2][k] - s.ref.p[0][k];
                d[k] = at[k] - s.ref.p[0][k];
            }
            const double aa = dot3(e[0], e[0]), ab = dot3(e[0], e[1]), bb = dot3(e[1], e[1]), det = aa * bb - ab * ab;
            const double b = (bb * dot3(e[0], d) - ab * dot3(e[1], d)) / det,
                         g = (aa * dot3(e[1], d) - ab * dot3(e[0], d)) / det;
            for (int k = 0; k < 3; k++)
                n[k] = s.ref.n[0][k] + b * (s.ref.n[1][k] - s.ref.n[0][k]) + g * (s.ref.n[2][k] - s.ref.n[0][k]);
            if (edge_at(&s, at, n) < 0x1p-9)
                continue;
        }
        const uint32_t px = is.color[i];
        const double *to = &rgb[3 * i];
        tally.pixels++;
        if (!(counted(px >> 11, to[0], 31) & counted(px >> 5 & 63, to[1], 63) & counted(px & 31, to[2], 31)))
            right = case_wrong("%s, pixel %d,%d: %u %u %u in place of %.2f %.2f %.2f (power %g, %u lamps)", kind->name,
                               i % W, i / W, px >> 11, px >> 5 & 63, px & 31, to[0] * 31, to[1] * 63, to[2] * 31,
                               s.ref.power, (unsigned)s.lighting.n_lamps);
    }
    picture_free(&is);
    return right;
}

static int gloss_case(uint64_t seed) { return frame_case(seed, &kinds[0]); }
static int tinted_case(uint64_t seed) { return frame_case(seed, &kinds[1]); }
static int phong_case(uint64_t seed) { return frame_case(seed, &kinds[2]); }

static void judge(case_fn *fn, const char *test, const char *name)
{
    memset(&tally, 0, sizeof tally);
    cases_run(test, fn, 300);
    if (!cases_all())
        return;
    print_message("%s: %lu values, %lu beyond two codes, worst %.2f\n", name, tally.n, tally.beyond_two, tally.worst);
    assert_true(tally.pixels > 60000);
    assert_true(tally.beyond_two * 1000 <= tally.n);
}

static void gloss_is_the_references(void **state) { (void)state; judge(gloss_case, __func__, "gloss"); }
static void gloss_tinted_is_the_references(void **state) { (void)state; judge(tinted_case, __func__, "tinted"); }
static void phong_is_the_references(void **state) { (void)state; judge(phong_case, __func__, "phong"); }

static const struct CMUnitTest tests[] = { cmocka_unit_test(gloss_is_the_references),
                                           cmocka_unit_test(gloss_tinted_is_the_references),
                                           cmocka_unit_test(phong_is_the_references) };

CASES_MAIN(tests)
