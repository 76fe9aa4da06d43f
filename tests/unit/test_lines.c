/* Lines and points: their pixels and keys against the definition in zs_lines.h, in 64 bits and in doubles; the same
 * picture in any pools, strips and with any accelerators; damage tracking; the edges of meshes; what is refused.
 *
 * SPDX-License-Identifier: MIT
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cases.h"
#include "fast_lists.h"
#include "../lab/fuzz/world.h"
#include "picture.h"
#include "zs_damage.h"
#include "zs_lines.h"
#include "zs_method.h"
#include "zs_shader.h"

/* ---- One line --------------------------------------------------------------------------------- */

/* A line between two vertices, or a point at the first one. */
struct stroke {
    int16_t pos[2][3];
    struct zs_mesh mesh;
    struct zs_lines lines;
    struct zs_points points;
    struct zs_material material;
    struct zs_instance instance;
    struct zs_scene scene;
};

static const uint16_t pair[1][2] = { { 0, 1 } };

static void stroke_set(struct stroke *s, uint32_t scale)
{
    s->mesh = (struct zs_mesh){ .pos = (const int16_t (*)[3])s->pos, .n_verts = 2, .radius = 57000,
                                .scale = scale * ZS_Q16_ONE };
    s->lines = (struct zs_lines){ ZS_LINES(pair, 1) };
    s->points = (struct zs_points){ ZS_POINTS(NULL, 1) };
    s->material = (struct zs_material){ .shader = &zs_shade_plain, .rgb = ZS_RGB(0xffffff),
                                        .primitive = &s->lines.primitive };
    s->instance = (struct zs_instance){ .mesh = &s->mesh, .material = &s->material };
    s->scene = (struct zs_scene){ .instance = &s->instance, .n_instances = 1 };
}

/* The definition: the ends moved outwards, 1/256 px, in the order of the longer direction. */
struct exact {
    int64_t m[2], n[2];
    int down, turned;
};

static int64_t nearest(int64_t a, int64_t b) /* a / b, halves away from 0; b > 0 */
{
    return a < 0 ? -((-a * 2 + b) / (2 * b)) : (a * 2 + b) / (2 * b);
}

static struct exact exact_of(const int64_t x[2], const int64_t y[2])
{
    const int down = llabs(y[1] - y[0]) > llabs(x[1] - x[0]);
    const int64_t *m = down ? y : x, *n = down ? x : y;
    const int turned = m[1] < m[0];
    struct exact e = { { m[turned], m[!turned] }, { n[turned], n[!turned] }, down, turned };
    const int64_t dm = e.m[1] - e.m[0], by = dm ? nearest(128 * (e.n[1] - e.n[0]), dm) : 0;
    e.m[0] -= 128;
    e.m[1] += 128;
    e.n[0] -= by;
    e.n[1] += by;
    return e;
}

static int inside(const struct exact *e, int64_t half, int64_t m, int64_t n)
{
    const int64_t dm = e->m[1] - e->m[0], at = (e->n[1] - e->n[0]) * (m - e->m[0]); /* < 2^47 */
    const int64_t above = (n - e->n[0] + half) * dm - at, below = (n - e->n[0] - half) * dm - at;
    /* on a left side is inside, on a right one outside: of a line that runs down to the right, the upper one is
     * right */
    const int upper_is_right = !e->down && e->n[1] > e->n[0];
    return e->m[0] <= m && m < e->m[1] && (upper_is_right ? above > 0 && below <= 0 : above >= 0 && below < 0);
}

/* The dash of the line that holds column m, in `part`; 0: there is none. */
static int dash_of(const struct exact *e, int32_t on, int32_t off, int64_t m, struct exact *part)
{
    const int64_t first = (e->m[0] + 127) >> 8, end = (e->m[1] + 127) >> 8, column = m >> 8;
    const int64_t k = e->turned ? end - 1 - column : column - first, j = k / (on + off);
    if (m < e->m[0] || m >= e->m[1] || k - j * (on + off) >= on)
        return 0;
    int64_t far = j * (on + off) + on;
    if (far > end - first)
        far = end - first;
    const int64_t border[2] = { e->turned ? end - far : first + j * (on + off),
                                e->turned ? end - j * (on + off) : first + far };
    *part = *e;
    for (int i = 0; i < 2; i++) {
        if (border[i] == (i ? end : first))
            continue;
        part->m[i] = border[i] * 256;
        part->n[i] = e->n[0] + (e->n[1] - e->n[0]) * (part->m[i] - e->m[0]) / (e->m[1] - e->m[0]);
    }
    return 1;
}

static struct zs_config stroke_config(struct prng *p, int perspective)
{
    struct zs_config c = picture_config(prng_range(p, 1, 70), prng_range(p, 1, 60),
                                        perspective ? &zs_depth_recip : &zs_depth_linear);
    c.strip_h = (uint16_t)prng_range(p, 1, c.height);
    c.max_tris = (uint16_t)prng_range(p, 1, 4);
    c.max_verts = (uint16_t)prng_range(p, 3, 12);
    c.fast = fast_any(p);
    return c;
}

static unsigned wide, dashes, long_ones, downward;

static int exact_case(uint64_t seed)
{
    struct prng p = { seed };
    struct stroke s;
    const int perspective = (int)prng_pick(&p, 2), is_long = !prng_pick(&p, 3);
    const int32_t scale = is_long ? 60 : 1, most = is_long ? 32767 : (int32_t)(1 + prng_pick(&p, 12000));
    struct zs_config c = stroke_config(&p, perspective);
    const struct zs_camera camera = pixel_camera(c.height, perspective);
    int64_t x[2], y[2];
    stroke_set(&s, (uint32_t)scale);
    s.lines.width = (uint8_t)(prng_pick(&p, 3) ? prng_pick(&p, 4) : prng_pick(&p, 65));
    if (prng_pick(&p, 2)) {
        s.lines.on = (uint8_t)prng_pick(&p, prng_pick(&p, 4) ? 9 : 256);
        s.lines.off = (uint8_t)prng_pick(&p, 9);
    }
    for (int k = 0; k < 2; k++) {
        s.pos[k][0] = (int16_t)prng_range(&p, -most, most);
        s.pos[k][1] = (int16_t)prng_range(&p, -most, most);
        s.pos[k][2] = perspective ? (int16_t)-(PIXEL_Z / scale) : (int16_t)prng_range(&p, -(32767 / scale), -2);
    }
    if (perspective && is_long) /* 60 does not divide PIXEL_Z */
        stroke_set(&s, 32), s.pos[0][2] = s.pos[1][2] = -PIXEL_Z / 32;
    else if (!perspective && !prng_pick(&p, 4))
        memcpy(s.pos[1], s.pos[0], sizeof s.pos[0]);
    if (!prng_pick(&p, 4)) {
        c.subpixel_bits = 4;
        for (int k = 0; k < 4; k++)
            s.pos[k / 2][k % 2] = (int16_t)(s.pos[k / 2][k % 2] / 16 * 16);
    }
    const int32_t by = (int32_t)(s.mesh.scale / ZS_Q16_ONE);
    for (int k = 0; k < 2; k++) {
        x[k] = c.width * 128 + s.pos[k][0] * by;
        y[k] = c.height * 128 - s.pos[k][1] * by;
    }
    const struct exact e = exact_of(x, y);
    const int64_t half = 128 * (s.lines.width ? s.lines.width : 1);
    const int dashed = s.lines.on && s.lines.off;
    const struct picture is = picture_draw(&c, &s.scene, &camera);
    int ok = is.err == ZS_OK && stats_add_up(&is.stats) && is.stats.tris_in == 1 && is.stats.tris_clipped == 0;
    for (int32_t i = 0; ok && i < is.w * is.h; i++) {
        const int64_t at[2] = { i % is.w * 256 + 128, i / is.w * 256 + 128 };
        const int64_t m = at[e.down], n = at[!e.down];
        struct exact part = e;
        const int want = (!dashed || dash_of(&e, s.lines.on, s.lines.off, m, &part)) && inside(&part, half, m, n);
        if ((is.color[i] == 0xffff) != want)
            ok = case_wrong("(%d, %d) is drawn: %d", i % is.w, i / is.w, !want);
        if (!want || perspective || (x[0] == x[1] && y[0] == y[1]))
            continue;
        double key[2]; /* of the ends in the order of m */
        for (int k = 0; k < 2; k++)
            key[k] = (-s.pos[k ^ e.turned][2] * by - 1) * 65535.0 / (2.0 * PIXEL_Z - 1);
        const double span = (double)(e.m[1] - e.m[0]), dk = key[1] - key[0];
        const double lies = key[0] + dk * (double)(m - e.m[0]) / span;
        const double slack = dashed ? fabs(dk) * 129 / fmax(span - 256, 1) : 0; /* half a px of the line */
        if (fabs(is.key[i] - lies) > 0.55 + fmin(slack, fabs(dk)))
            ok = case_wrong("(%d, %d) has key %d, not %f", i % is.w, i / is.w, is.key[i], lies);
    }
    wide += half > 128 && is.stats.tris_drawn;
    dashes += dashed && is.stats.tris_drawn;
    long_ones += is_long && is.stats.tris_drawn;
    downward += e.down && is.stats.tris_drawn;
    struct picture freed = is;
    picture_free(&freed);
    return ok || case_wrong("err %d", is.err);
}

/* ---- Clipped ---------------------------------------------------------------------------------- */

static unsigned cut_lines, cut_dashes;

/* Lines that reach before near, beyond far and far out of the guard band, in doubles. A pixel whose middle is within a
 * sixteenth of a px of the border may be either. */
static int clipped_case(uint64_t seed)
{
    struct prng p = { seed };
    struct stroke s;
    const int perspective = (int)prng_pick(&p, 2);
    struct zs_config c = stroke_config(&p, perspective);
    const struct zs_camera camera = pixel_camera(c.height, perspective);
    const double z_near = perspective ? PIXEL_Z / 2 : 1, z_far = 2 * PIXEL_Z;
    double at[2][3], end[2][2];
    const uint32_t scale = 1u << prng_pick(&p, 11);
    stroke_set(&s, scale);
    s.lines.width = (uint8_t)(prng_pick(&p, 3) ? prng_pick(&p, 4) : prng_pick(&p, 65));
    if (!prng_pick(&p, 4)) {
        s.lines.on = (uint8_t)prng_pick(&p, 30);
        s.lines.off = (uint8_t)prng_pick(&p, 9);
    }
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < 3; i++) {
            const int32_t most = i == 2 ? 80000 / (int32_t)scale : prng_pick(&p, 2) ? 32767 : 32767 / (int32_t)scale;
            s.pos[k][i] = (int16_t)prng_range(&p, most > 32767 ? -32767 : -most, most > 32767 ? 32767 : most / 4);
            at[k][i] = (i == 0 ? 1.0 : -1.0) * s.pos[k][i] * scale;
        }
    if (!prng_pick(&p, 8)) { /* an end at the border of the guard band, as far as lines are wide inside and outside */
        stroke_set(&s, 128);
        s.lines.width = 3;
        for (int k = 0; k < 2; k++) {
            s.pos[k][2] = -PIXEL_Z / 128;
            at[k][2] = PIXEL_Z;
            for (int i = 0; i < 2; i++) {
                s.pos[k][i] = (int16_t)(k ? prng_range(&p, -40, 40) : prng_range(&p, 2 * 8120, 2 * 8210));
                at[k][i] = (i ? -128.0 : 128.0) * s.pos[k][i];
            }
        }
        s.pos[0][seed & 1] = (int16_t)(s.pos[0][seed & 1] * (prng_range(&p, -900, 900) / 1000.0));
        at[0][seed & 1] = (seed & 1 ? -128.0 : 128.0) * s.pos[0][seed & 1];
    }
    const double dz = at[1][2] - at[0][2];
    double t[2] = { 0, 1 };
    for (int k = 0; k < 2; k++) {
        const double bound = at[k][2] < z_near ? z_near : at[k][2] > z_far ? z_far : at[k][2];
        if (bound != at[k][2] && dz != 0)
            t[k] = (bound - at[0][2]) / dz;
    }
    int seen = t[0] >= 0 && t[0] < t[1] && t[1] <= 1 && (dz != 0 || (at[0][2] >= z_near && at[0][2] <= z_far));
    for (int k = 0; k < 2; k++) {
        const double z = at[0][2] + t[k] * dz, to = perspective ? PIXEL_Z / z / 256 : 1.0 / 256;
        for (int i = 0; i < 2; i++)
            end[k][i] = (i ? c.height : c.width) * 0.5 + (at[0][i] + t[k] * (at[1][i] - at[0][i])) * to;
    }
    const double dx = end[1][0] - end[0][0], dy = end[1][1] - end[0][1];
    if (seen && (fabs(fabs(dx) - fabs(dy)) < 0.01 * fabs(dx) || fabs(dx) + fabs(dy) < 4))
        return 1; /* which direction is longer depends on rounding, or the angle does */
    const struct picture is = picture_draw(&c, &s.scene, &camera);
    const int down = fabs(dy) > fabs(dx), turned = end[1][down] < end[0][down];
    const double m0 = end[turned][down], m1 = end[!turned][down], n0 = end[turned][!down], n1 = end[!turned][!down];
    const double half = (s.lines.width ? s.lines.width : 1) * 0.5, near_by = 1.0 / 16;
    const int dashed = s.lines.on && s.lines.off;
    double key[2]; /* linear on the screen */
    for (int k = 0; k < 2; k++) {
        const double z = at[0][2] + t[k ^ turned] * dz;
        key[k] = 65535 * (perspective ? (1 / z_near - 1 / z) / (1 / z_near - 1 / z_far)
                                      : (z - z_near) / (z_far - z_near));
    }
    const double slope = (key[1] - key[0]) / fmax(m1 - m0, 1);
    int ok = is.err == ZS_OK && stats_add_up(&is.stats);
    for (int32_t i = 0; ok && i < is.w * is.h; i++) {
        const double xy[2] = { i % is.w + 0.5, i / is.w + 0.5 }, m = xy[down], n = xy[!down];
        const double lies = n0 + (n1 - n0) * (m - m0) / (m1 - m0);
        const double out = fmax(fabs(n - lies) - half, fmax(m0 - 0.5 - m, m - m1 - 0.5));
        const int drawn = is.color[i] == 0xffff;
        if (drawn ? !seen || out > near_by : seen && !dashed && out < -near_by)
            ok = case_wrong("(%d, %d) is drawn: %d, %f px out", i % is.w, i / is.w, drawn, out);
        const double want = key[0] + slope * (fmin(fmax(m, m0), m1) - m0); /* and half a px along the line */
        if (drawn && ok && m1 - m0 > 1 && fabs(is.key[i] - want) > 1.5 + fabs(slope) * 0.55)
            ok = case_wrong("(%d, %d) has key %d, not %f", i % is.w, i / is.w, is.key[i], want);
    }
    cut_lines += is.stats.tris_clipped && is.stats.tris_drawn;
    cut_dashes += is.stats.tris_clipped && is.stats.tris_drawn && dashed;
    struct picture freed = is;
    picture_free(&freed);
    return ok || case_wrong("err %d", is.err);
}

/* ---- Points ----------------------------------------------------------------------------------- */

static unsigned points_drawn;

static int point_case(uint64_t seed)
{
    struct prng p = { seed };
    struct stroke s;
    struct zs_config c = stroke_config(&p, 0);
    const struct zs_camera camera = pixel_camera(c.height, 0);
    const uint32_t scale = prng_pick(&p, 4) ? 1 : 200;
    stroke_set(&s, scale);
    s.material.primitive = &s.points.primitive;
    s.points.size = (uint8_t)prng_pick(&p, 65);
    for (int i = 0; i < 2; i++)
        s.pos[0][i] = (int16_t)(prng_range(&p, -12000, 12000) & (prng_pick(&p, 2) ? ~127 : ~0));
    s.pos[0][2] = (int16_t)prng_range(&p, -32767 / (int32_t)scale, 100);
    const int64_t x = c.width * 128 + s.pos[0][0] * (int64_t)scale, y = c.height * 128 - s.pos[0][1] * (int64_t)scale;
    const int64_t half = 128 * (s.points.size ? s.points.size : 1), z = -s.pos[0][2] * (int64_t)scale;
    struct picture is = picture_draw(&c, &s.scene, &camera);
    int ok = is.err == ZS_OK && stats_add_up(&is.stats) && is.stats.tris_in == 1;
    for (int32_t i = 0; ok && i < is.w * is.h; i++) {
        const int64_t dx = i % is.w * 256 + 128 - x, dy = i / is.w * 256 + 128 - y;
        const int want = z >= 1 && -half <= dx && dx < half && -half <= dy && dy < half;
        const double key = (double)(z - 1) * 65535.0 / (2.0 * PIXEL_Z - 1);
        if ((is.color[i] == 0xffff) != want || (want && fabs(is.key[i] - key) > 0.51))
            ok = case_wrong("(%d, %d) is drawn: %d, key %d", i % is.w, i / is.w, !want, is.key[i]);
    }
    points_drawn += is.stats.tris_drawn;
    picture_free(&is);
    return ok || case_wrong("err %d", is.err);
}

/* ---- Any way, and damage ---------------------------------------------------------------------- */

#define LINES 40

struct strokes { /* in place of the triangles of a random world's materials */
    uint16_t pair[WORLD_MATERIALS][LINES][2], point[WORLD_MATERIALS][LINES];
    struct zs_lines lines[WORLD_MATERIALS];
    struct zs_points points[WORLD_MATERIALS];
};

static void strokes_make(struct strokes *s, struct world *w, struct prng *p)
{
    for (int k = 0; k < WORLD_MATERIALS; k++) {
        const uint32_t kind = prng_pick(p, 3), least = 1 + prng_pick(p, 12);
        uint32_t n = prng_pick(p, LINES + 1), verts = 1;
        for (uint32_t i = 0; i < w->n_instances; i++)
            if (w->instance[i].material == &w->material[k]) {
                if (w->material[k].shader->face && n > w->instance[i].mesh->n_tris)
                    n = w->instance[i].mesh->n_tris;
                verts = w->instance[i].mesh->n_verts > verts ? w->instance[i].mesh->n_verts : verts;
            }
        for (uint32_t i = 0; i < LINES; i++) {
            s->point[k][i] = (uint16_t)prng_pick(p, verts + 1u > 65535u ? 65535u : verts + 1u);
            s->pair[k][i][0] = (uint16_t)prng_pick(p, least < verts ? least : verts); /* shared vertices */
            s->pair[k][i][1] = (uint16_t)prng_pick(p, verts);
        }
        const uint8_t width = (uint8_t)(prng_pick(p, 4) ? prng_pick(p, 4) : prng_pick(p, 65));
        s->lines[k] = (struct zs_lines){ ZS_LINES((const uint16_t (*)[2])s->pair[k], n), .width = width };
        s->points[k] = (struct zs_points){ ZS_POINTS(prng_pick(p, 2) ? s->point[k] : NULL, n), .size = width };
        if (prng_pick(p, 2)) {
            s->lines[k].on = (uint8_t)prng_pick(p, 9);
            s->lines[k].off = (uint8_t)prng_pick(p, 9);
        }
        if (kind < 2)
            w->material[k].primitive = kind ? &s->lines[k].primitive : &s->points[k].primitive;
    }
}

static const struct zs_depth *const mappings[] = { &zs_depth_float, &zs_depth_recip, &zs_depth_linear, &zs_depth_none };

static struct zs_config world_config(struct prng *p, const struct world *w)
{
    struct zs_config c = { .width = (uint16_t)prng_range(p, 1, 90), .height = (uint16_t)prng_range(p, 1, 70),
                           .max_tris = 40000, .max_verts = 50000, .varyings = ZS_VARYINGS_MAX };
    c.depth = mappings[w->camera.projection == ZS_ORTHOGRAPHIC ? 2 + prng_pick(p, 2) : prng_pick(p, 4)];
    c.strip_h = c.height;
    return c;
}

static unsigned again, strokes_drawn;

/* A world that keeps its spheres, with strokes in it. */
static void world_of_strokes(struct world *w, struct strokes *s, struct prng *p)
{
    for (world_make(w, p, 0); !w->trusted; world_make(w, p, 0))
        world_free(w);
    strokes_make(s, w, p);
}

static int way_case(uint64_t seed)
{
    struct prng p = { seed };
    static struct world w;
    static struct strokes s;
    world_of_strokes(&w, &s, &p);
    struct zs_config c = world_config(&p, &w);
    static const struct zs_method *const sorting[] = { &zs_method_painter, &zs_method_depthsort, &zs_method_coverage };
    const uint32_t sorts = c.depth == &zs_depth_none ? prng_pick(&p, 4) : 0;
    if (sorts) {
        c.method = sorting[sorts - 1];
        c.depth = sorts > 1 ? &zs_depth_order : c.depth;
        c.width = c.width > 24 ? 24 : c.width; /* few pixels: small pools take a walk for each */
        c.height = c.height > 16 ? 16 : c.height;
    }
    struct picture ample = picture_draw(&c, &w.scene, &w.camera);
    if (!sorts && c.depth != &zs_depth_none && prng_pick(&p, 2))
        c.method = &zs_method_hiz; /* the depth buffer's frames */
    picture_any_way(&p, &c, 1, 3);
    if (c.method) {
        c.max_tris += 1;
        c.max_verts += 3;
    }
    struct picture is = picture_draw(&c, &w.scene, &w.camera);
    const int right = ample.err || is.err ||
                      (stats_add_up(&is.stats) && stats_add_up(&ample.stats) &&
                       (c.method || is.stats.instances_hidden || is.stats.clusters_culled ||
                        is.stats.tris_clipped == ample.stats.tris_clipped));
    again += is.stats.passes > is.stats.strips;
    strokes_drawn += is.stats.tris_drawn > 0;
    world_free(&w);
    return picture_alike(&ample, &is, "another way") && (right || case_wrong("statistics that do not add up"));
}

/* In a viewport the picture is that of a frame of its size. */
static int viewport_case(uint64_t seed)
{
    struct prng p = { seed };
    static struct world w;
    static struct strokes s;
    world_of_strokes(&w, &s, &p);
    w.scene.sky = NULL; /* which knows where the viewport is, as the next two do */
    w.scene.n_resolves = 0;
    for (int k = 0; k < WORLD_MATERIALS; k++)
        if (w.material[k].shader->by_fragment)
            w.material[k].shader = &zs_shade_none;
    struct zs_config c = world_config(&p, &w);
    struct picture alone = picture_draw(&c, &w.scene, &w.camera);
    const struct zs_pass pass = { .scene = &w.scene, .camera = &w.camera,
                                  .viewport = { (uint16_t)prng_pick(&p, 20), (uint16_t)prng_pick(&p, 20), c.width,
                                                c.height } };
    c.width = (uint16_t)(c.width + pass.viewport.x + prng_pick(&p, 9));
    c.height = (uint16_t)(c.height + pass.viewport.y + prng_pick(&p, 9));
    picture_any_way(&p, &c, 1, 3);
    struct picture is = picture_passes(&c, &pass, 1);
    int right = is.err == alone.err;
    for (int32_t i = 0; right && !is.err && i < alone.w * alone.h; i++) {
        const int32_t at = (i / alone.w + pass.viewport.y) * is.w + i % alone.w + pass.viewport.x;
        right = is.color[at] == alone.color[i] && is.key[at] == alone.key[i];
    }
    PICTURES_FREE(&alone, &is);
    world_free(&w);
    return right || case_wrong("another picture in a viewport; error %d", is.err);
}

/* A panel that gets what has changed. */
struct glass {
    uint16_t px[70][90];
};

static int glass_take(void *ctx, const struct zs_strip *s)
{
    struct glass *g = ctx;
    for (int y = 0; y < s->h; y++)
        memcpy(&g->px[s->y + y][s->dirty_x], s->px + 2 * (y * s->w + s->dirty_x), 2u * s->dirty_w);
    return 0;
}

static unsigned clean, moved;

static int damage_case(uint64_t seed)
{
    struct prng p = { seed };
    static struct world w;
    static struct strokes s;
    static struct glass glass, full;
    const struct zs_sink to_glass = { .submit = glass_take, .ctx = &glass },
                         to_full = { .submit = glass_take, .ctx = &full };
    struct zs_renderer r, fresh;
    for (world_make(&w, &p, 0); !w.trusted || !w.n_instances || w.scene.n_instances != w.n_instances;
         world_make(&w, &p, 0))
        world_free(&w);
    strokes_make(&s, &w, &p);
    w.scene.n_resolves = 0;
    struct zs_config c = world_config(&p, &w);
    picture_any_way(&p, &c, 1, 3);
    const uint32_t bytes = zs_arena_bytes(&c);
    uint32_t *memory = malloc(4u * ZS_DAMAGE_WORDS(w.n_instances, c.height, c.strip_h));
    uint8_t *arena[2] = { malloc(bytes), malloc(bytes) };
    int err = zs_init(&r, &c, arena[0], bytes);
    err = err ? err : zs_damage_track(&r, memory, w.n_instances);
    err = err ? err : zs_damage_columns(&r, (int)prng_pick(&p, 2));
    int right = 1;
    memset(&glass, 0, sizeof glass);
    memset(&full, 0, sizeof full);
    for (int frame = 0; frame < 6 && !err && right; frame++) {
        struct zs_instance *in = &w.instance[prng_pick(&p, w.n_instances)];
        for (int k = 0; k < 3 && frame; k++)
            in->pose.pos[k] += prng_range(&p, -in->mesh->radius / 4 - 1, in->mesh->radius / 4 + 1);
        err = zs_render(&r, &w.scene, &w.camera, &to_glass);
        int other = zs_init(&fresh, &c, arena[1], bytes);
        other = other ? other : zs_render(&fresh, &w.scene, &w.camera, &to_full);
        right = err == other && (err || !memcmp(&glass, &full, sizeof glass));
        clean += frame && !err && zs_frame_stats(&r)->strips_clean;
        moved += frame && !err;
    }
    free(memory);
    free(arena[0]);
    free(arena[1]);
    world_free(&w);
    return right || case_wrong("the glass is not a full redraw; error %d", err);
}

/* ---- Edges of meshes -------------------------------------------------------------------------- */

/* A cube whose corners are split, three vertices each, and an open square. */
static void edges_of_a_cube_and_a_square(void **state)
{
    static const uint16_t tri[12][3] = { { 0, 1, 2 },    { 2, 1, 3 },    { 4, 6, 5 },    { 6, 7, 5 },
                                         { 8, 12, 9 },   { 12, 13, 9 },  { 10, 11, 14 }, { 14, 11, 15 },
                                         { 16, 18, 20 }, { 20, 18, 22 }, { 17, 21, 19 }, { 21, 23, 19 } };
    static int16_t pos[24][3];
    static struct zs_mesh_edge edge[36];
    static uint16_t line[18][2];
    (void)state;
    for (int v = 0; v < 24; v++) /* bits of v & 7: the corner */
        for (int k = 0; k < 3; k++)
            pos[v][k] = (int16_t)((v & 7) >> k & 1 ? 100 : -100);
    const struct zs_mesh cube = { .pos = pos, .tri = tri, .n_verts = 24, .n_tris = 12, .radius = 180 };
    const struct zs_mesh square = { .pos = pos, .tri = tri, .n_verts = 24, .n_tris = 2, .radius = 180 };
    const struct zs_instance in = { .mesh = &cube, .pose = { .pos = { 50, 0, 0 } } };
    struct zs_camera camera;
    static const int32_t middle[3] = { 50, 0, 0 };
    assert_int_equal(zs_edges_of(edge, &cube), 18);
    assert_int_equal(zs_edges_choose(line, 18, edge, 18, &cube, ZS_EDGE_ALL, 0, NULL, NULL), 18);
    assert_int_equal(zs_edges_choose(line, 5, edge, 18, &cube, ZS_EDGE_ALL, 0, NULL, NULL), 5);
    assert_int_equal(zs_edges_choose(line, 18, edge, 18, &cube, ZS_EDGE_CREASE, ZS_DEGREES(89), NULL, NULL), 12);
    assert_int_equal(zs_edges_choose(line, 18, edge, 18, &cube, ZS_EDGE_CREASE, ZS_DEGREES(91), NULL, NULL), 0);
    assert_int_equal(zs_edges_choose(line, 18, edge, 18, &cube, ZS_EDGE_SMOOTH, ZS_DEGREES(89), NULL, NULL), 6);
    assert_int_equal(zs_edges_choose(line, 18, edge, 18, &cube, ZS_EDGE_BORDER, 0, NULL, NULL), 0);
    for (int ortho = 0; ortho < 2; ortho++) {
        assert_int_equal(ortho ? zs_camera_orthographic(&camera, 500, 1, 3000)
                               : zs_camera_perspective(&camera, ZS_DEGREES(40), 100, 10, 3000), ZS_OK);
        assert_int_equal(zs_camera_orbit(&camera, middle, 1000, ZS_DEGREES(30), ZS_DEGREES(20)), ZS_OK);
        /* a cube from a corner: a hexagon; from the front in perspective: a square */
        assert_int_equal(zs_edges_choose(line, 18, edge, 18, &cube, ZS_EDGE_SILHOUETTE, 0, &in, &camera), 6);
        assert_int_equal(zs_camera_orbit(&camera, middle, 1000, 0, 0), ZS_OK);
        if (!ortho)
            assert_int_equal(zs_edges_choose(line, 18, edge, 18, &cube, ZS_EDGE_SILHOUETTE, 0, &in, &camera), 4);
    }
    assert_int_equal(zs_edges_of(edge, &square), 5);
    assert_int_equal(zs_edges_choose(line, 18, edge, 5, &square, ZS_EDGE_BORDER, 0, NULL, NULL), 4);
    assert_int_equal(zs_edges_choose(line, 18, edge, 5, &square, ZS_EDGE_SMOOTH, ZS_DEGREES(10), NULL, NULL), 1);
}

/* Against counting pairs of corners: random triangles over few places. */
static int edges_case(uint64_t seed)
{
    struct prng p = { seed };
    int16_t pos[12][3];
    uint8_t lo[12][3] = { { 0 } }; /* every other mesh: the column of a place is in the low bytes alone */
    uint16_t tri[20][3];
    struct zs_mesh_edge edge[60];
    unsigned sides[12][12] = { { 0 } }, found = 0;
    uint32_t place[12];
    const uint32_t n = prng_pick(&p, 21);
    for (uint32_t v = 0; v < 12; v++) {
        const uint32_t at = prng_pick(&p, 9);
        place[v] = v;
        pos[v][0] = (int16_t)(seed % 2 ? 0 : at % 3);
        lo[v][0] = (uint8_t)(seed % 2 ? at % 3 : 0);
        pos[v][1] = (int16_t)-(at / 3);
        pos[v][2] = 5;
        for (uint32_t u = v; u > 0; u--)
            if (!memcmp(pos[u - 1], pos[v], sizeof pos[v]) && lo[u - 1][0] == lo[v][0])
                place[v] = u - 1;
    }
    for (uint32_t k = 0; k < 3 * n; k++)
        tri[k / 3][k % 3] = (uint16_t)prng_pick(&p, 13);
    for (uint32_t t = 0; t < n; t++) {
        uint32_t c[3] = { 0, 0, 0 };
        int bad = 0;
        for (int k = 0; k < 3; k++)
            if (tri[t][k] < 12)
                c[k] = place[tri[t][k]];
            else
                bad = 1;
        if (bad || c[0] == c[1] || c[1] == c[2] || c[0] == c[2])
            continue;
        for (int k = 0; k < 3; k++) {
            const uint32_t a = c[k], b = c[(k + 1) % 3];
            sides[a < b ? a : b][a < b ? b : a]++;
        }
    }
    const struct zs_mesh mesh = { .pos = (const int16_t (*)[3])pos, .tri = (const uint16_t (*)[3])tri, .n_verts = 12,
                                  .n_tris = n, .pos_lo = seed % 2 ? (const uint8_t (*)[3])lo : NULL };
    const int32_t got = zs_edges_of(edge, &mesh);
    for (int a = 0; a < 12; a++)
        for (int b = 0; b < 12; b++)
            found += sides[a][b] != 0;
    CASE_CHECK(got == (int32_t)found);
    for (int32_t k = 0; k < got; k++) {
        const uint32_t a = place[edge[k].v[0]], b = place[edge[k].v[1]];
        unsigned *const s = &sides[a < b ? a : b][a < b ? b : a];
        CASE_CHECK(*s && (*s == 2) == (edge[k].tri[1] != ZS_EDGE_NO_TRI));
        *s = 0;
    }
    return 1;
}

/* ---- What is refused -------------------------------------------------------------------------- */

static int error_of(struct stroke *s, const struct zs_camera *camera)
{
    struct zs_config c = picture_config(64, 48, &zs_depth_linear);
    struct picture is = picture_draw(&c, &s->scene, camera);
    picture_free(&is);
    return is.err;
}

static void what_cannot_be_drawn_is_refused(void **state)
{
    struct stroke s;
    struct zs_camera camera = pixel_camera(48, 0);
    (void)state;
    stroke_set(&s, 1);
    assert_int_equal(error_of(&s, &camera), ZS_OK);
    s.lines.width = 64;
    assert_int_equal(error_of(&s, &camera), ZS_OK);
    s.lines.width = 65;
    assert_int_equal(error_of(&s, &camera), ZS_ERR_RANGE);
    stroke_set(&s, 1);
    s.lines.line = NULL;
    assert_int_equal(error_of(&s, &camera), ZS_ERR_NULL);
    s.lines.primitive.n = 0;
    assert_int_equal(error_of(&s, &camera), ZS_OK);
    stroke_set(&s, 1);
    s.lines.primitive.ops = NULL; /* ZS_LINES was forgotten */
    assert_int_equal(error_of(&s, &camera), ZS_ERR_NULL);
    stroke_set(&s, 1);
    s.material.shader = &zs_shade_raw;
    assert_int_equal(error_of(&s, &camera), ZS_OK);
    s.mesh.face_raw = pair[0]; /* of no triangle */
    assert_int_equal(error_of(&s, &camera), ZS_ERR_MESH);
    s.material.shader = &zs_shade_flat;
    assert_int_equal(error_of(&s, &camera), ZS_ERR_MESH);
    s.material.shader = &zs_shade_none;
    assert_int_equal(error_of(&s, &camera), ZS_OK);
    stroke_set(&s, 1);
    s.material.primitive = &s.points.primitive;
    s.points.size = 65;
    assert_int_equal(error_of(&s, &camera), ZS_ERR_RANGE);
    stroke_set(&s, 1);
    s.lines.width = 64;
    s.instance.pose.pos[2] = -ZS_WORLD_MAX;
    camera.projection = ZS_PERSPECTIVE;
    camera.z_far = (int64_t)ZS_WORLD_MAX * 65536;
    camera.z_near = camera.z_far / 16;
    camera.focal = (zs_uq32_32)20 << 32;
    assert_int_equal(error_of(&s, &camera), ZS_ERR_RANGE);
    camera.focal = (zs_uq32_32)300 << 32;
    assert_int_equal(error_of(&s, &camera), ZS_OK);
}

/* A line is drawn whose number is that of a triangle that is not: the face stage is not asked about it. */
static void a_face_without_its_vertices_gives_nothing(void **state)
{
    static const uint16_t tri[1][3] = { { 0, 1, 60000 } };
    struct stroke s;
    const struct zs_camera camera = pixel_camera(48, 0);
    struct zs_config c = picture_config(64, 48, &zs_depth_linear);
    (void)state;
    for (int point = 0; point < 2; point++) {
        stroke_set(&s, 1);
        memset(s.pos, 0, sizeof s.pos);
        s.pos[1][0] = 2000;
        s.instance.pose.pos[2] = -PIXEL_Z;
        s.mesh.tri = tri;
        s.mesh.n_tris = 1;
        s.scene.background = 0x1234;
        s.material.shader = &zs_shade_flat;
        s.material.primitive = point ? &s.points.primitive : &s.lines.primitive;
        struct picture is = picture_draw(&c, &s.scene, &camera);
        assert_int_equal(is.err, ZS_OK);
        assert_true(is.covered > 0);
        for (int32_t i = 0; i < is.w * is.h; i++)
            assert_int_equal(is.color[i], is.key[i] == ZS_DEPTH_CLEAR ? 0x1234 : 0);
        picture_free(&is);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_face_without_its_vertices_gives_nothing),
    CASES_COUNTS(lines_are_exact, exact_case, 6000,
                 { "wide lines", &wide, 1000 }, { "dashes", &dashes, 600 }, { "long lines", &long_ones, 250 },
                 { "lines downward", &downward, 600 }),
    CASES_COUNTS(clipped_lines, clipped_case, 8000,
                 { "lines cut", &cut_lines, 300 }, { "dashes cut", &cut_dashes, 50 }),
    CASES_COUNT(points, point_case, 1000, &points_drawn, 250, "points"),
    CASES_COUNT(any_pools_strips_and_accelerators, way_case, 300, &again, 80, "frames in several walks"),
    CASES_TEST(in_a_viewport, viewport_case, 200),
    CASES_COUNT(damage_tracking, damage_case, 200, &clean, 100, "frames with clean strips"),
    cmocka_unit_test(edges_of_a_cube_and_a_square),
    CASES_TEST(edges_by_counting, edges_case, 500),
    cmocka_unit_test(what_cannot_be_drawn_is_refused),
};
CASES_MAIN(tests)
