/* What fast/solid_v7m.c and fast/sweep_v7m.c have in assembler against the same in C, on an emulated board: lists of
 * random triangles in a strip, and random meshes. Ends with status 0 where all is right.
 *
 * SPDX-License-Identifier: MIT
 */
#include <string.h>

#include "core/assemble.h"
#include "core/job.h"
#include "fast/sweep.h"
#include "hal.h"
#include "triangles.h"
#include "zs_fast.h"
#include "zs_renderer.h"
#include "zs_shader.h"

#define LISTS 30000u
#define MESHES 6000u
#define W 200
#define H 24
#define LIST 8u
#define VERTS 24u
#define STRIPS 12u

extern const struct zs_fast solid_in_c; /* v7m_c.c */

static struct zs_renderer r;
static struct zs_vertex pool[VERTS];

/* ---- Triangles ----------------------------------------------------------------------------------------------- */

struct drawn {
    uint16_t depth[W * H], color[W * H], list[1 + LIST];
    uint32_t tested, set_up, end; /* end: number of the last triangle that was drawn; LIST: none */
    int32_t row_last;
};
static struct zs_tri tri[LIST];

/* Draw a list by one of them, and keep the list of those that go on below the strip. */
static void draw(struct drawn *d, const struct zs_fast *by, int by_hand)
{
    struct zs_job job;
    uint16_t active = ZS_NIL, *keep = &active;
    struct zs_tri before[LIST];
    memcpy(before, tri, sizeof(tri));
    memset(&job, 0, sizeof(job));
    r.stats.pixels_tested = r.stats.tris_setup = 0;
    job.r = &r;
    job.y0 = 0;
    job.y1 = H;
    job.width = job.pitch = W;
    job.depth = d->depth;
    job.color = d->color;
    d->end = LIST;
    for (uint32_t i = 0; i != ZS_NIL; i = tri[i].next) {
        job.tri = &tri[i];
        if (by_hand) {
            job.chain = tri;
            job.keep = &keep;
        }
        if (!by->draw(&job))
            break;
        i = (uint32_t)(job.tri - tri);
        d->end = i;
        d->row_last = job.row_last;
        if (job.row_last > job.y1) {
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
}

/* Return not 0 where they differ. *n: triangles drawn, declined. */
static int lists(uint32_t n[2])
{
    static struct drawn c, hand;
    static const uint8_t shifts[] = { 19, 24, 29, 31 };
    r.vert = pool;
    r.tri = tri;
    for (uint32_t l = 0; l < LISTS; l++) {
        const uint32_t shift = shifts[next() % 4u];
        const uint32_t key = next() % 4u ? next() : 0u - (next() >> (8u + next() % 12u));
        r.view.piece_shift = (uint8_t)shift;
        r.view.piece_base = next() % 2u ? 0xffffffffu : 0x7fffffffu;
        for (uint32_t i = 0; i < LIST; i++) {
            random_triangle(&pool[3u * i], (int32_t)(next() % (W * 256u + 4000u)) - 2000, within(6000),
                            256 << next() % 7u, key & r.view.piece_base, 1u + next() % (next() % 8u ? 16u : shift));
            tri[i] = (struct zs_tri){ .v = { (uint16_t)(3u * i), (uint16_t)(3u * i + 1u), (uint16_t)(3u * i + 2u) },
                                      .next = (uint16_t)(i + 1u < LIST ? i + 1u : ZS_NIL), .paint = (uint16_t)next(),
                                      .instance = (uint16_t)(next() % 9u == 0) };
        }
        const uint32_t far = next() % 3u;
        for (uint32_t i = 0; i < W * H; i++) {
            c.depth[i] = hand.depth[i] = far ? (uint16_t)(0xffffu - (far == 1 ? next() : 0)) : (uint16_t)(key >> 16);
            c.color[i] = hand.color[i] = 0;
        }
        c.row_last = hand.row_last = 0;
        draw(&c, &solid_in_c, 0);
        draw(&hand, &zs_fast_raw, 1);
        /* beyond a triangle that was declined, row_last is not that of the one before */
        if (c.end + 1u < LIST && c.end != LIST)
            c.row_last = hand.row_last = 0;
        if (memcmp(&c, &hand, sizeof(c)))
            return 1;
        n[0] += c.set_up;
        n[1] += c.end + 1u < LIST || c.end == LIST;
    }
    return 0;
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
    if (!by_hand)
        b->reached = zs_sweep_each(&s, from, TRIS, mesh + from);
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
    static uint16_t src[VERTS];
    r.xform.instance = &instance;
    r.vert_src = src;
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
                                    .face = next() % 2u ? face : 0, .by_batches = 1 };
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

int main(void)
{
    uint32_t n[2] = { 0, 0 }, outcome[ZS_OUTCOMES] = { 0 };
    if (hal_init())
        hal_exit(2);
    if (lists(n)) {
        hal_write("lists of triangles differ\n");
        hal_exit(1);
    }
    if (meshes(outcome)) {
        hal_write("meshes differ\n");
        hal_exit(3);
    }
    /* each way is one that was looked at */
    if (n[0] < 2u * LISTS || n[1] < LISTS / 10u || outcome[ZS_OUTCOME_DRAWN] < MESHES ||
        outcome[ZS_OUTCOME_OFFSCREEN] < MESHES / 10u || outcome[ZS_OUTCOME_EMPTY] < MESHES / 50u ||
        outcome[ZS_OUTCOME_INDEX] < MESHES / 10u) {
        hal_write("outcomes are seldom\n");
        hal_exit(4);
    }
    hal_exit(0);
}
