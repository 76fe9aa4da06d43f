/* What fast/solid_v7m.c, texture_v7m.c and sweep_v7m.c, and depth/float_v7m.c, have in assembler against the same in C,
 * on an emulated board: lists of random triangles in a strip, random vertices, and random meshes. Ends with status 0
 * where all is right.
 *
 * SPDX-License-Identifier: MIT
 */
#include <string.h>

#include "core/assemble.h"
#include "core/depth.h"
#include "core/job.h"
#include "core/xform.h"
#include "fast/screen.h"
#include "fast/small.h"
#include "fast/sweep.h"
#include "hal.h"
#include "shade/texture.h"
#include "triangles.h"
#include "zs_fast.h"
#include "zs_renderer.h"
#include "zs_shader.h"

#define LISTS 30000u
#define MESHES 6000u
#define VIEWS 6000u
#define W 200
#define H 24
#define LIST 8u
#define VERTS 24u
#define STRIPS 12u

/* v7m_c.c */
uint32_t sweep_in_c(struct zs_sweep *s, uint32_t t, uint32_t end, const uint16_t (*tri)[3]);
extern const struct zs_fast solid_in_c;
extern const struct zs_fast *const textured_in_c[3], *const texels_in_c[3];

static struct zs_renderer r;
static struct zs_vertex pool[VERTS];

/* ---- Triangles ----------------------------------------------------------------------------------------------- */

struct drawn {
    uint16_t depth[W * H], color[W * H], list[1 + LIST];
    uint32_t tested, set_up, declined; /* declined: triangles, a bit each */
    uint32_t steps; /* sum of what lit triangles are stepped by */
    int32_t tri_end;
};
static struct zs_tri tri[LIST];
static const struct zs_depth_state *state; /* of all instances */

/* The viewport's part of the strip. */
static struct {
    int32_t x, width, y0, y1;
} part;

/* What draws them: an accelerator, and loops of the texture's format. */
struct by {
    const struct zs_fast *fast;
    const struct zs_fast_texel *texel;
};

/* The last bit of a coordinate is not seen in a list's pixels: sum up the words themselves. */
static uint32_t steps;
static void step(const struct zs_texel_rows *w)
{
    const uint32_t word[] = { w->at[0], w->at[1], w->at[2], w->down[0], w->down[1], w->down[2], w->right[0],
                              w->right[1], w->right[2], w->light, w->light_right, w->light_down, w->width, w->column,
                              w->row, w->sides.sum[0], w->sides.sum[1] };
    for (uint32_t i = 0; i < sizeof(word) / sizeof(word[0]); i++)
        steps = steps * 16777619u + word[i];
}
static const struct zs_fast_texel *of_hand, *of_c; /* of the format */
static void lit_by_hand(struct zs_job *job, const struct zs_texture *t, struct zs_texel_rows *w)
{
    step(w);
    of_hand->small_lit(job, t, w);
}
static void lit_in_c(struct zs_job *job, const struct zs_texture *t, struct zs_texel_rows *w)
{
    step(w);
    of_c->small_lit(job, t, w);
}

/* Return 1 if job->tri has no row in the strip, which the core then finds; tri_end is set. */
static int no_row(struct zs_job *job)
{
    const uint16_t *v = job->tri->v;
    const int32_t y = pool[v[0]].y;
    job->tri_end = zs_first_sample(zs_max32(pool[v[1]].y, pool[v[2]].y));
    return zs_min32(job->tri_end, job->y1) <= zs_max32(zs_first_sample(y), job->y0);
}

/* Draw a list, and keep the list of those that go on below the strip. In C if in_c is NULL; else by hand, and what is
 * declined then in C. Return how many of those C does not decline. */
static uint32_t draw(struct drawn *d, struct by by, const struct by *in_c, const struct zs_texture *texture)
{
    struct zs_job job;
    uint16_t active = ZS_NIL, *keep = &active;
    struct zs_tri before[LIST];
    uint32_t more = 0;
    memcpy(before, tri, sizeof(tri));
    memset(&job, 0, sizeof(job));
    r.stats.pixels_tested = r.stats.tris_setup = 0;
    r.lit.of = 0;
    job.r = &r;
    job.y0 = part.y0;
    job.y1 = part.y1;
    job.width = part.width;
    job.pitch = W;
    job.depth = d->depth + part.x;
    job.color = d->color + part.x;
    job.shader = by.fast->shader;
    job.fast = by.fast;
    job.texture = texture;
    job.texel = by.texel;
    job.depth_state = state;
    steps = 0;
    job.kept.of = ZS_NIL;
    d->declined = 0;
    for (uint32_t i = 0; i != ZS_NIL; i = tri[i].next) {
        job.tri = &tri[i];
        job.chain = in_c ? tri : 0;
        job.keep = in_c ? &keep : 0;
        int done = by.fast->draw(&job);
        if (!done && in_c) {
            struct zs_job other = job;
            other.fast = in_c->fast;
            other.texel = in_c->texel;
            done = in_c->fast->draw(&other);
            job.tri_end = other.tri_end;
            more += done != 0;
        }
        if (!done && !no_row(&job)) {
            d->declined |= 1u << i;
            continue;
        }
        i = (uint32_t)(job.tri - tri);
        d->tri_end = job.tri_end;
        if (job.tri_end > job.y1) {
            *keep = (uint16_t)i;
            keep = &tri[i].next;
        }
    }
    *keep = ZS_NIL;
    memset(d->list, 0, sizeof(d->list));
    d->list[0] = active;
    for (uint32_t i = 0; i < LIST; i++)
        d->list[1 + i] = tri[i].next;
    memcpy(tri, before, sizeof(tri));
    d->tested = r.stats.pixels_tested;
    d->set_up = r.stats.tris_setup;
    d->steps = steps;
    if (d->declined >> (LIST - 1u)) /* then it is not known of the one before */
        d->tri_end = 0;
    return more;
}

/* A list of random triangles, and a random part of the strip. */
static void random_list(uint32_t key, uint32_t steep)
{
    part.x = next() % 3u ? 0 : (int32_t)(next() % 40u);
    part.width = W - part.x - (next() % 3u ? 0 : (int32_t)(next() % 40u));
    part.y0 = next() % 3u ? 0 : within(300);
    part.y1 = part.y0 + (next() % 3u ? H : 1 + (int32_t)(next() % H));
    for (uint32_t i = 0; i < LIST; i++) {
        random_triangle(&pool[3u * i], (int32_t)(next() % (W * 256u + 4000u)) - 2000, part.y0 * 256 + within(6000),
                        256 << next() % 7u, key & r.view.piece_base,
                        1u + next() % (next() % 8u ? steep : r.view.piece_shift));
        tri[i] = (struct zs_tri){ .v = { (uint16_t)(3u * i), (uint16_t)(3u * i + 1u), (uint16_t)(3u * i + 2u) },
                                  .next = (uint16_t)(i + 1u < LIST ? i + 1u : ZS_NIL), .paint = (uint16_t)next(),
                                  .instance = (uint16_t)(next() % 9u == 0) };
    }
}

/* Draw it by hand and in C over the same random strip. Return not 0 where they differ. n: set up, lists with a triangle
 * that was declined, triangles that C does not decline. */
static int same(struct by hand, struct by in_c, const struct zs_texture *texture, uint32_t key, uint32_t n[3])
{
    static struct drawn a, b;
    const uint32_t far = next() % 3u;
    for (uint32_t i = 0; i < W * H; i++) {
        a.depth[i] = b.depth[i] = far ? (uint16_t)(0xffffu - (far == 1 ? next() : 0)) : (uint16_t)(key >> 16);
        a.color[i] = b.color[i] = 0;
    }
    a.tri_end = b.tri_end = 0;
    draw(&a, in_c, 0, texture);
    n[2] += draw(&b, hand, &in_c, texture);
    n[0] += a.set_up;
    n[1] += a.declined != 0;
    return memcmp(&a, &b, sizeof(a));
}

/* Of one colour. */
static int lists(uint32_t n[3])
{
    static const uint8_t shifts[] = { 19, 24, 29, 31 };
    const struct by hand = { &zs_fast_raw, 0 }, in_c = { &solid_in_c, 0 };
    for (uint32_t l = 0; l < LISTS; l++) {
        const uint32_t key = next() % 4u ? next() : 0u - (next() >> (8u + next() % 12u));
        r.view.piece_shift = shifts[next() % 4u];
        r.view.piece_base = next() % 2u ? 0xffffffffu : 0x7fffffffu;
        random_list(key, 16u);
        if (same(hand, in_c, 0, key, n))
            return 1;
    }
    return n[2] != 0; /* what C draws is drawn by hand */
}

/* Keys that a depth state moves by hand, against vertices that are so much farther in C. What one of them declines
 * alone, as its keys are in two pieces or go beyond the ends, is not compared; n[2] counts such lists. */
static int moved(uint32_t n[3])
{
    const struct by hand = { &zs_fast_raw, 0 }, in_c = { &solid_in_c, 0 };
    static struct drawn a, b;
    for (uint32_t l = 0; l < LISTS; l++) {
        const struct zs_depth_state bias = { .bias = (int16_t)(next() % 8u ? within(40) - 20 : within(32767)) };
        const uint32_t key = next() % 4u ? next() : next() % 2u ? next() >> 10 : 0u - (next() >> 10);
        r.view.piece_shift = (uint8_t)(30u + next() % 2u);
        r.view.piece_base = next() % 2u ? 0xffffffffu : 0x7fffffffu;
        random_list(key, 16u);
        memset(&a, 0, sizeof(a));
        for (uint32_t i = 0; i < W * H; i++)
            a.depth[i] = (uint16_t)((key >> 16) + next() % 64u - 32u);
        b = a;
        state = &bias;
        (void)draw(&b, hand, 0, 0);
        state = 0;
        int wraps = 0;
        for (uint32_t v = 0; v < 3u * LIST; v++) {
            const int64_t d = (int64_t)pool[v].d + bias.bias * 65536;
            wraps |= d < 0 || d > r.view.piece_base;
            pool[v].d = (uint32_t)d;
        }
        (void)draw(&a, in_c, 0, 0);
        n[0] += b.set_up;
        n[1] += b.declined != 0;
        n[2] += wraps || a.declined != b.declined;
        if (!wraps && a.declined == b.declined && memcmp(&a, &b, sizeof(a)))
            return 1;
    }
    return n[2] > LISTS / 4u || n[0] < LISTS;
}

/* Textured ones. */
static int textured(uint32_t n[3])
{
    static const struct zs_fast *const texels[] = { &zs_fast_565, &zs_fast_pal8, &zs_fast_pal4 },
                                *const shaders[] = { &zs_fast_texture, &zs_fast_texture_flat, &zs_fast_texture_smooth };
    static uint16_t texel[4096], few[4096], palette[256], attr[3u * VERTS];
    static struct zs_mesh mesh;
    static const struct zs_instance instance[2] = { { .mesh = &mesh }, { .mesh = &mesh } };
    static const struct zs_scene scene = { .instance = instance };
    r.scene = &scene;
    r.attr = attr;
    for (uint32_t i = 0; i < 4096u; i++) {
        texel[i] = (uint16_t)next();
        few[i] = (uint16_t)(next() % 40u << 8 | next() % 40u);
    }
    for (uint32_t i = 0; i < 256u; i++)
        palette[i] = (uint16_t)next();
    for (uint32_t l = 0; l < LISTS; l++) {
        const uint32_t format = next() % 3u, shader = next() % 3u, log2_w = next() % 11u, shift = 20u + next() % 10u;
        of_hand = texels[format]->texel;
        of_c = texels_in_c[format]->texel;
        const struct zs_fast_texel by_hand = { .small_lit = lit_by_hand },
                                   by_c = { .small = of_c->small, .small_lit = lit_in_c };
        const struct by hand = { shaders[shader], &by_hand }, in_c = { textured_in_c[shader], &by_c };
        const uint32_t is_few = next() % 2u; /* colours of a palette, which is lit as a whole then */
        const struct zs_texture t = { .format = texels[format]->format, .texel = is_few ? few : texel,
                                      .palette = palette,
                                      .n_colors = (uint16_t)(format == 2 ? 16 : is_few ? 40 : 256),
                                      .log2_w = (uint8_t)log2_w,
                                      .log2_h = (uint8_t)(next() % (12u - log2_w < 11u ? 13u - log2_w : 11u)),
                                      .clamp = next() % 50u == 0 };
        mesh.uv_bits = (uint8_t)(next() % 16u);
        r.config.varyings = (uint8_t)(shader == 2 || next() % 2u ? 3 : 2);
        r.view.piece_shift = (uint8_t)shift;
        r.view.piece_base = next() % 2u ? 0xffffffffu : 0x7fffffffu;
        r.view.key_slow = (1u << shift) - 1u;
        r.view.key_known = r.view.piece_base - (2u << shift);
        const uint32_t key = next() % 8u ? next() : 0u - (next() >> (8u + next() % 12u));
        /* of coordinates: to a repeat, or as far as they go */
        const uint32_t far = next() % 4u && mesh.uv_bits < 13 ? mesh.uv_bits + 1u : 16u;
        random_list(key, shift - 4u);
        for (uint32_t v = 0; v < VERTS; v++)
            for (uint32_t k = 0; k < 3u; k++) {
                const uint32_t before = v % 3u ? attr[(v - 1u) * r.config.varyings + k] : next();
                attr[v * r.config.varyings + k] = (uint16_t)(before + (uint32_t)within(1 << next() % far));
            }
        for (uint32_t i = 0; i < LIST; i++)
            if (next() % 4u == 0)
                tri[i].paint = ZS_TEXTURE_FULL_LIGHT;
        if (same(hand, in_c, &t, key, n))
            return 1;
    }
    return n[2] > n[0] / 10u; /* few are declined by hand alone */
}

/* ---- Meshes -------------------------------------------------------------------------------------------------- */

#define TRIS 40u
struct binned {
    struct zs_tri tri[TRIS + 4u];
    uint16_t bin[STRIPS], attr[3u * VERTS];
    uint32_t outcome[ZS_OUTCOMES], n, reached;
    int32_t y0, y1;
};

static uint16_t face(const struct zs_shading *s, uint32_t t)
{
    (void)s;
    return (uint16_t)(t * 40503u);
}
static uint16_t color[TRIS];
static uint16_t raw_face(const struct zs_shading *s, uint32_t t)
{
    (void)s;
    return zs_wire16(color[t]);
}
static void vertex(const struct zs_shading *s, uint32_t v, uint16_t *attr)
{
    (void)s;
    attr[0] = (uint16_t)(v + 7u);
}

static void bin(struct binned *b, const struct zs_sweep *of, const uint16_t (*mesh)[3], uint32_t from, int by_hand)
{
    struct zs_sweep s = *of;
    memset(b, 0xa5, sizeof(*b));
    memset(b->outcome, 0, sizeof(b->outcome));
    for (uint32_t i = 0; i < 3u * VERTS; i++)
        b->attr[i] = i % 5u ? ZS_ATTR_UNKNOWN : (uint16_t)i;
    for (uint32_t i = 0; i < STRIPS; i++)
        b->bin[i] = (uint16_t)(i * 3u + 900u);
    s.outcome = b->outcome;
    s.out = b->tri;
    s.full = b->tri + TRIS;
    s.bin = b->bin;
    s.y0 = INT32_MAX;
    s.y1 = INT32_MIN;
    r.attr = b->attr;
    r.bin = b->bin;
    b->reached = from;
    if (by_hand && s.face == raw_face) { /* as begin() of fast/batch.c */
        s.face = 0;
        s.raw = color;
    }
    if (!by_hand)
        b->reached = sweep_in_c(&s, from, TRIS, mesh + from);
    else /* as sweep() of fast/batch.c */
        while (b->reached < TRIS) {
            const uint32_t at = s.keep < 0 ? zs_sweep_turned(&s, b->reached, TRIS, mesh + b->reached)
                                           : zs_sweep_by_hand(&s, b->reached, TRIS, mesh + b->reached);
            b->reached = at;
            if (at == TRIS || zs_sweep_each(&s, at, at + 1u, mesh + at) == at)
                break;
            b->reached = at + 1u;
        }
    b->n = s.n;
    b->y0 = s.y0;
    b->y1 = s.y1;
}

static int meshes(uint32_t n[ZS_OUTCOMES])
{
    static struct binned c, hand;
    static const struct zs_shader shader = { .vertex = vertex };
    static const struct zs_material material = { .shader = &shader };
    static const struct zs_instance instance = { .material = &material };
    static uint16_t mesh[TRIS + 1u][3];
    static uint16_t (*const faces[3])(const struct zs_shading *s, uint32_t t) = { 0, face, raw_face };
    static uint16_t src[VERTS];
    r.xform.instance = &instance;
    r.vert_src = src;
    for (uint32_t i = 0; i < TRIS; i++)
        color[i] = (uint16_t)next();
    for (uint32_t m = 0; m < MESHES; m++) {
        const int32_t extent = 20 << next() % 14u, rows = 1 + (int32_t)(next() % 40u);
        for (uint32_t v = 0; v < VERTS; v++) {
            pool[v].x = (int32_t)(next() % (W * 256u)) / 8 * (int32_t)(next() % 9u) + within(extent);
            pool[v].y = (int32_t)(next() % (W * 256u)) / 8 * (int32_t)(next() % 9u) + within(extent);
            pool[v].d = next() % 16u ? next() >> 4 : ZS_D_OUT + (1u << next() % 6u);
            src[v] = (uint16_t)v;
            if (next() % 3u == 0 && v) { /* beside another */
                pool[v].x = pool[v - 1u].x + within(300);
                pool[v].y = pool[v - 1u].y + within(300);
            }
        }
        for (uint32_t t = 0; t < TRIS; t++)
            for (int k = 0; k < 3; k++)
                mesh[t][k] = (uint16_t)(next() % 200u ? ((uint32_t)k + next() % 2u) % 4u + t % 20u : next() % 40u);
        const uint32_t base = next() % 3u ? 0u : 4u, strip_h = (uint32_t)rows;
        r.walk_y = (uint16_t)(next() % 40u);
        r.walk_y_end = (uint16_t)(r.walk_y + next() % 200u);
        r.strip_mul = 0x10000u / strip_h + 1u;
        r.strip_shift = 16;
        r.config.strip_h = (uint16_t)strip_h;
        r.config.varyings = 3;
        r.strip = (uint16_t)(next() % 3u);
        r.band_end = (uint16_t)(r.strip + 1u + next() % (STRIPS - 3u));
        r.band_begun = r.band_end;
        r.walk_x = (uint16_t)(next() % 30u * (next() % 2u));
        r.walk_end = (uint16_t)(W - next() % 60u);
        const int32_t row = zs_max32(r.walk_y, (int32_t)(r.strip * strip_h)),
                      end = zs_min32(r.walk_y_end, (int32_t)(r.band_end * strip_h));
        const struct zs_sweep s = { .r = &r, .pool = pool + base, .n_verts = VERTS - base,
                                    .keep = (int32_t)(next() % 3u) - 1, .x = r.walk_x, .x_end = r.walk_end,
                                    .row = (uint32_t)row,
                                    .rows = (uint32_t)zs_max32(end - row, 0), .strip_mul = r.strip_mul,
                                    .strip_shift = r.strip_shift, .n = next() % 1000u, .base = (uint16_t)base,
                                    .instance = (uint16_t)next(), .varyings = next() % 2u ? 3u : 0u,
                                    .face = faces[next() % 3u], .by_batches = 1 };
        const uint32_t from = next() % 3u;
        bin(&c, &s, (const uint16_t(*)[3])mesh, from, 0);
        bin(&hand, &s, (const uint16_t(*)[3])mesh, from, 1);
        if (memcmp(&c, &hand, sizeof(c)))
            return 1;
        for (uint32_t k = 0; k < ZS_OUTCOMES; k++)
            n[k] += c.outcome[k];
        n[ZS_OUTCOME_DRAWN] += c.n - s.n;
        n[ZS_OUTCOME_INDEX] += c.reached < TRIS;
    }
    return 0;
}

/* ---- Vertices ------------------------------------------------------------------------------------------------ */

/* Return not 0 where a vertex that is projected by hand is not where the core has it, or is left to C without need. n:
 * projected, left, in octaves that are rare. */
static int vertices(uint32_t n[3])
{
    static const struct zs_depth *const depths[] = { &zs_depth_e3m13, &zs_depth_e4m12, &zs_depth_e5m11 };
    struct zs_view *const view = &r.view;
    memset(view, 0, sizeof(*view));
    view->perspective = 1;
    view->shift = 16;
    for (uint32_t l = 0; l < VIEWS; l++) {
        struct zs_vertex hand[VERTS], core;
        view->z_near = 256 << next() % 12u;
        view->z_near += (int32_t)(next() % 256u);
        view->z_far = (int32_t)zs_minu32((uint32_t)view->z_near << (1u + next() % 16u), 1u << 30);
        const struct zs_camera camera = { .z_near = (int64_t)view->z_near << 16, .z_far = (int64_t)view->z_far << 16 };
        view->depth = depths[next() % 3u];
        if (view->z_far <= view->z_near || view->depth->setup(view, &camera, 16u - next() % 3u))
            continue;
        view->cx = (int32_t)(next() % 65536u);
        view->cy = (int32_t)(next() % 65536u);
        view->scale_bits = (int8_t)(next() % 24u);
        const struct zs_screen_of of = zs_screen_of(view);
        for (uint32_t v = 0; v < VERTS; v++) {
            const uint32_t range = (uint32_t)(view->z_far - view->z_near);
            pool[v].d = (uint32_t)view->z_near + (next() % 8u ? next() % range >> next() % 16u : next() % (2u * range));
            pool[v].x = within(1 << next() % 31u);
            pool[v].y = within(1 << next() % 31u);
        }
        memcpy(hand, pool, sizeof(hand));
        struct zs_vertex *const end = hand + VERTS, *at = hand;
        for (uint32_t left = 0; left < VERTS; left++, at++) {
            struct zs_vertex *const from = at;
            at = zs_screen_v7m(&of, at, end);
            for (const struct zs_vertex *v = from; v != at; v++) {
                core = pool[v - hand];
                n[0]++;
                n[2] += (uint32_t)(view->key_lz + zs_clz32(core.d) - 1) >= view->key_common;
                if (!zs_xform_project_at(&r, &core) || memcmp(v, &core, sizeof(core)))
                    return 1;
            }
            if (at == end)
                break;
            core = pool[at - hand];
            n[1]++;
            const int32_t down = 30 - view->scale_bits - zs_clz32(core.d);
            if (down >= 0 && down < 32 && zs_xform_project_at(&r, &core) && zs_abs32(core.x - view->cx) < 1 << 20 &&
                zs_abs32(core.y - view->cy) < 1 << 20)
                return 1;
        }
    }
    return 0;
}

static void end_if(int wrong, int status, const char *text)
{
    if (wrong) {
        hal_write(text);
        hal_exit(status);
    }
}

int main(void)
{
    uint32_t n[3] = { 0, 0, 0 }, m[3] = { 0, 0, 0 }, t[3] = { 0, 0, 0 }, v[3] = { 0, 0, 0 },
             outcome[ZS_OUTCOMES] = { 0 };
    if (hal_init())
        hal_exit(2);
    r.vert = pool;
    r.tri = tri;
    end_if(lists(n), 1, "lists of triangles differ\n");
    end_if(moved(m), 7, "lists of moved triangles differ\n");
    end_if(textured(t), 5, "lists of textured triangles differ\n");
    end_if(vertices(v), 6, "vertices differ\n");
    end_if(meshes(outcome), 3, "meshes differ\n");
    /* each way is one that was looked at */
    if (n[0] < 2u * LISTS || n[1] < LISTS / 10u || t[0] < LISTS || t[1] < LISTS / 10u ||
        v[0] < 4u * VIEWS || v[1] < VIEWS || v[2] < VIEWS / 2u ||
        outcome[ZS_OUTCOME_DRAWN] < MESHES || outcome[ZS_OUTCOME_OFFSCREEN] < MESHES / 10u ||
        outcome[ZS_OUTCOME_EMPTY] < MESHES / 50u || outcome[ZS_OUTCOME_INDEX] < MESHES / 10u)
        end_if(1, 4, "outcomes are seldom\n");
    hal_exit(0);
}
