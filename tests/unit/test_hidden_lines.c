/* Hidden lines: faces by zs_shade_none pushed back, then edges, against the visible parts of the edges in doubles.
 *
 * Bar: the pixels that are drawn and the points of edges that are visible are nowhere more than a pixel apart. A
 * visible point has a drawn pixel, where it is or among the eight around that one: none is missing. A drawn pixel has a
 * visible point in the same reach: none is drawn that is hidden by more than a pixel. Lines have colours of their own,
 * so that pixels are counted, too, whose own line is hidden where another one is visible.
 *
 * ZS_VIEWS=n in the environment draws n views of four models instead of 40.
 *
 * SPDX-License-Identifier: MIT
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cases.h"
#include "meshes.h"
#include "picture.h"
#include "zs_lines.h"
#include "zs_shader.h"

#define SIDE 240
#define VERTS_MAX 2000
#define EDGES_MAX 10000
#define SPANS_MAX 4000 /* triangles that hide one edge */
#define SEEN_MAX 24    /* lines in one pixel */

/* ---- A view in doubles ------------------------------------------------------------------------ */

struct point {
    double x, y, w; /* px; 1 / distance, which is linear on the screen */
};

struct span {
    double from, to;
};

static struct point vertex[VERTS_MAX];

static void project(const struct zs_mesh *mesh, const struct zs_camera *camera)
{
    const double focal = ldexp((double)camera->focal, -32);
    for (uint32_t v = 0; v < mesh->n_verts; v++) {
        double at[3] = { 0, 0, 0 };
        for (int k = 0; k < 3; k++)
            for (int i = 0; i < 3; i++) {
                const double lo = mesh->pos_lo ? mesh->pos_lo[v][i] / 256.0 : 0;
                const double scale = mesh->scale ? mesh->scale / 65536.0 : 1;
                at[k] += ldexp(camera->rot[3 * k + i], -30) * ((mesh->pos[v][i] + lo) * scale - camera->pos[i]);
            }
        vertex[v] = (struct point){ SIDE * 0.5 + at[0] * focal / -at[2], SIDE * 0.5 + at[1] * focal / at[2],
                                    -1 / at[2] };
    }
}

/* Narrow a span to where a linear function with the values f and g at 0 and 1 is above 0. */
static void narrow(struct span *s, double f, double g)
{
    if (f <= 0 && g <= 0)
        s->to = s->from;
    else if (f <= 0)
        s->from = fmax(s->from, f / (f - g));
    else if (g <= 0)
        s->to = fmin(s->to, f / (f - g));
}

static double side_of(const struct point *a, const struct point *b, const struct point *c)
{
    return (b->x - a->x) * (c->y - a->y) - (b->y - a->y) * (c->x - a->x);
}

/* The part of the edge a b that a triangle hides. */
static struct span hidden_by(const struct point *a, const struct point *b, const uint16_t tri[3])
{
    static const struct span none = { 0, 0 };
    const struct point *v[3] = { &vertex[tri[0]], &vertex[tri[1]], &vertex[tri[2]] };
    struct span s = { 0, 1 };
    const double area = side_of(v[0], v[1], v[2]);
    if (area >= 0) /* turned away: y is down */
        return none;
    double f[2] = { -a->w, -b->w };
    for (int k = 0; k < 3; k++) {
        const struct point *p = v[(k + 1) % 3], *q = v[(k + 2) % 3];
        const double fa = side_of(p, q, a) / area, fb = side_of(p, q, b) / area; /* barycentric */
        narrow(&s, fa, fb);
        if (s.from >= s.to)
            return none;
        f[0] += fa * v[k]->w;
        f[1] += fb * v[k]->w;
    }
    narrow(&s, f[0] - 1e-9 * a->w, f[1] - 1e-9 * b->w);
    return s.from < s.to ? s : none;
}

static int by_from(const void *a, const void *b)
{
    const struct span *s = a, *t = b;
    return (s->from > t->from) - (s->from < t->from);
}

/* The visible parts of an edge, in order. */
static int visible_parts(const struct zs_mesh *mesh, const struct zs_mesh_edge *e, struct span *out)
{
    static struct span hid[SPANS_MAX];
    const struct point *a = &vertex[e->v[0]], *b = &vertex[e->v[1]];
    const double x0 = fmin(a->x, b->x), x1 = fmax(a->x, b->x), y0 = fmin(a->y, b->y), y1 = fmax(a->y, b->y);
    int n = 0, parts = 0;
    for (uint32_t t = 0; t < mesh->n_tris; t++) {
        const uint16_t *v = mesh->tri[t];
        const struct point *p = &vertex[v[0]], *q = &vertex[v[1]], *r = &vertex[v[2]];
        if (t == e->tri[0] || t == e->tri[1] || (p->x < x0 && q->x < x0 && r->x < x0) ||
            (p->x > x1 && q->x > x1 && r->x > x1) || (p->y < y0 && q->y < y0 && r->y < y0) ||
            (p->y > y1 && q->y > y1 && r->y > y1))
            continue;
        const struct span s = hidden_by(a, b, v);
        if (s.from < s.to && n < SPANS_MAX)
            hid[n++] = s;
    }
    qsort(hid, (size_t)n, sizeof hid[0], by_from);
    double at = 0;
    for (int k = 0; k < n; k++) {
        if (hid[k].from > at)
            out[parts++] = (struct span){ at, hid[k].from };
        at = fmax(at, hid[k].to);
    }
    if (at < 1)
        out[parts++] = (struct span){ at, 1 };
    return parts;
}

/* ---- Against the picture ---------------------------------------------------------------------- */

static uint16_t number_of(const struct zs_shading *s, uint32_t t)
{
    (void)s;
    return (uint16_t)(t + 1);
}

static void number_in(const struct zs_instance *in, struct zs_fragment *f)
{
    (void)in;
    uint8_t *const px = (uint8_t *)f->color;
    px[0] = (uint8_t)(f->paint >> 8);
    px[1] = (uint8_t)f->paint;
}

static const struct zs_shader numbers = { .face = number_of, .fragment = number_in, ZS_FRAGMENTS, .opaque = 1 };

static struct zs_mesh_edge edge[3 * EDGES_MAX];
static uint16_t pair[EDGES_MAX][2];

/* The lines of which a point is visible in a pixel. */
static uint16_t seen[SIDE][SIDE][SEEN_MAX];
static uint8_t n_seen[SIDE][SIDE];

struct tally {
    unsigned views, points, missing, pixels, hidden, own;
};

static void see(int x, int y, uint16_t line)
{
    for (int j = 0; j < n_seen[y][x]; j++)
        if (seen[y][x][j] == line)
            return;
    if (n_seen[y][x] < SEEN_MAX)
        seen[y][x][n_seen[y][x]++] = line;
}

/* A pixel or one of the eight beside it is drawn. */
static int drawn_near(const struct picture *is, int x, int y)
{
    for (int d = 0; d < 9; d++) {
        const int nx = x + d % 3 - 1, ny = y + d / 3 - 1;
        if (nx >= 0 && nx < SIDE && ny >= 0 && ny < SIDE && is->color[ny * SIDE + nx])
            return 1;
    }
    return 0;
}

/* Find the visible points of line k, the edge e, and whether they are drawn. */
static void points_of(const struct picture *is, const struct zs_mesh *mesh, const struct zs_mesh_edge *e, uint16_t k,
                      struct tally *tally)
{
    static struct span part[SPANS_MAX + 1];
    const struct point *a = &vertex[e->v[0]], *b = &vertex[e->v[1]];
    const double length = hypot(b->x - a->x, b->y - a->y);
    const int parts = visible_parts(mesh, e, part);
    for (int i = 0; i < parts; i++) {
        const double size = (part[i].to - part[i].from) * length;
        const int steps = 1 + (int)(size * 8);
        if (size < 1e-6) /* between two triangles that hide the line, by rounding of doubles */
            continue;
        for (int s = 0; s <= steps; s++) {
            const double t = part[i].from + (part[i].to - part[i].from) * s / steps;
            const int x = (int)floor(a->x + (b->x - a->x) * t), y = (int)floor(a->y + (b->y - a->y) * t);
            if (x < 0 || x >= SIDE || y < 0 || y >= SIDE)
                continue;
            see(x, y, k);
            tally->points++;
            tally->missing += !drawn_near(is, x, y);
        }
    }
}

static void pixels_of(const struct picture *is, struct tally *tally)
{
    for (int32_t i = 0; i < SIDE * SIDE; i++) {
        int own = 0, any = 0;
        if (!is->color[i])
            continue;
        for (int d = 0; d < 9; d++) {
            const int x = i % SIDE + d % 3 - 1, y = i / SIDE + d / 3 - 1;
            if (x < 0 || x >= SIDE || y < 0 || y >= SIDE)
                continue;
            for (int j = 0; j < n_seen[y][x]; j++) {
                any = 1;
                own |= seen[y][x][j] == is->color[i];
            }
        }
        tally->pixels++;
        tally->hidden += !any;
        tally->own += !own;
    }
}

static int view_case(const struct zs_mesh *mesh, struct prng *p, uint32_t kinds, struct tally *tally)
{
    static const struct zs_depth_state back = ZS_HIDDEN_LINE_STATE;
    static const struct zs_material hides = { .shader = &zs_shade_none };
    static const uint16_t any[3 * EDGES_MAX][3]; /* triangles of the lines' numbers, which `numbers` does not look at */
    struct zs_mesh numbered = *mesh;
    struct zs_lines lines = { ZS_LINES((const uint16_t (*)[2])pair, 0), .width = 1 };
    const struct zs_material ink = { .shader = &numbers, .primitive = &lines.primitive };
    const struct zs_instance instance[2] = { { .mesh = mesh, .material = &hides, .depth_state = &back },
                                             { .mesh = &numbered, .material = &ink } };
    const struct zs_scene scene = { .instance = instance, .n_instances = 2 };
    const double scale = mesh->scale ? mesh->scale / 65536.0 : 1;
    const int32_t size = (int32_t)(mesh->radius * scale) + 1, away = prng_range(p, 2 * size, 5 * size);
    const int32_t middle[3] = { (int32_t)(mesh->center[0] * scale), (int32_t)(mesh->center[1] * scale),
                                (int32_t)(mesh->center[2] * scale) };
    const zs_turn angle = (zs_turn)(2.2 * 10430 * size / away);
    struct zs_camera camera;
    uint32_t at = 0;
    int err = zs_camera_perspective(&camera, angle, SIDE, away - size - 1, away + size + 1);
    const zs_turn yaw = (zs_turn)prng_next(p);
    err = err ? err : zs_camera_orbit(&camera, middle, away, yaw, (int16_t)prng_range(p, -16000, 16000));
    CASE_CHECK(err == ZS_OK && mesh->n_verts <= VERTS_MAX && 3 * mesh->n_tris <= 3 * EDGES_MAX);
    const uint32_t n = (uint32_t)zs_edges_of(edge, mesh);
    lines.primitive.n = zs_edges_choose(pair, EDGES_MAX, edge, n, mesh, kinds, ZS_DEGREES(30), &instance[1], &camera);
    numbered.tri = any;
    numbered.n_tris = lines.primitive.n;
    struct zs_config c = picture_config(SIDE, SIDE, &zs_depth_recip);
    c.max_tris = 20000;
    c.max_verts = 30000;
    struct picture is = picture_draw(&c, &scene, &camera);
    if (!is.err) {
        project(mesh, &camera);
        memset(n_seen, 0, sizeof n_seen);
        for (uint32_t k = 0; k < n && at < lines.primitive.n; k++)
            if (edge[k].v[0] == pair[at][0] && edge[k].v[1] == pair[at][1])
                points_of(&is, mesh, &edge[k], (uint16_t)++at, tally);
        pixels_of(&is, tally);
        tally->views++;
    }
    picture_free(&is);
    return is.err == ZS_OK && at == lines.primitive.n;
}

static struct tally views_of(const char *name, const struct zs_mesh *mesh, uint32_t kinds, uint32_t share)
{
    const char *const more = getenv("ZS_VIEWS");
    const uint32_t views = (more ? (uint32_t)atoi(more) : 40u) / share;
    struct tally tally = { 0 };
    for (uint32_t v = 0; v < views; v++) {
        struct prng p = { v * 16u + kinds };
        assert_true(view_case(mesh, &p, kinds, &tally));
    }
    printf("%-7s %4u views: %u of %u visible points missing; %u of %u pixels hidden, %u behind others\n", name,
           tally.views, tally.missing, tally.points, tally.hidden, tally.pixels, tally.own - tally.hidden);
    assert_true(!views || (tally.points > 1000 * views && tally.pixels > 200 * views));
    return tally;
}

/* All edges of four models; creases and silhouettes of the two that have flat faces. */
static void within_a_pixel(void **state)
{
    static const struct {
        const char *name;
        const struct zs_mesh *mesh;
        uint32_t kinds, share;
    } models[] = { { "cube", &mesh_cube, ZS_EDGE_ALL, 4 }, { "city", &mesh_city, ZS_EDGE_ALL, 8 },
                   { "knot", &mesh_knot, ZS_EDGE_ALL, 4 }, { "bumpy", &mesh_bumpy, ZS_EDGE_ALL, 4 },
                   { "city", &mesh_city, ZS_EDGE_ALL & ~(uint32_t)ZS_EDGE_SMOOTH, 8 } };
    (void)state;
    for (unsigned m = 0; m < sizeof models / sizeof models[0]; m++) {
        const struct tally t = views_of(models[m].name, models[m].mesh, models[m].kinds, models[m].share);
        assert_int_equal(t.missing, 0);
        assert_int_equal(t.hidden, 0);
    }
}

/* Spout, handle and lid of the teapot are sunk into its body: an edge in there is hidden by less than the faces are
 * pushed back, in a few places: 1 pixel of 2,000 at most. */
static void parts_that_pierce_each_other(void **state)
{
    (void)state;
    const struct tally t = views_of("teapot", &mesh_teapot, ZS_EDGE_ALL, 8);
    assert_int_equal(t.missing, 0);
    assert_true(t.hidden * 2000.0 <= t.pixels);
}

static const struct CMUnitTest tests[] = { cmocka_unit_test(within_a_pixel),
                                           cmocka_unit_test(parts_that_pierce_each_other) };
CASES_MAIN(tests)
