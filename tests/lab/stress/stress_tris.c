/* Frames of thousands of triangles whose corners lie on sub-pixels, through the whole renderer, against the oracle:
 * every pixel is that of the nearest triangle that covers it, with that triangle's key; and all pixels together are
 * tested as often as triangles cover them, so that hidden ones count too.
 *
 * One world unit is 1/256 px and a bucket of depth; nothing is rounded on the way to the screen.
 *
 * SPDX-License-Identifier: MIT
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fast_lists.h"
#include "oracle.h"
#include "picture.h"
#include "prng.h"
#include "stress.h"

#define TRIS_MAX 6000
#define PARTS 4
#define PX_MAX (240 * 240)
#define GUARD (8188 * 256 - 4)
#define APART 1.0101 /* buckets, from which on the nearer one must win */

enum kind { TINY, SMALL, SLIVER, CENTER, BESIDE, STRAIGHT, ZERO, LARGE, HUGE_ONE, KINDS };

static struct {
    int16_t pos[3 * TRIS_MAX][3];
    uint8_t pos_lo[3 * TRIS_MAX][3];
    uint16_t tri[TRIS_MAX][3], raw[TRIS_MAX];
    struct zs_mesh mesh[PARTS];
    struct zs_material material;
    struct zs_instance instance[PARTS];
    struct zs_scene scene;
    /* what the oracle gets: 1/256 px right and down, buckets */
    struct oracle_tri at[TRIS_MAX];
    uint32_t d[TRIS_MAX][3];
    uint32_t n;
} g;

static struct {
    double nearest, owner;
    uint32_t first; /* of all covering triangles with the nearest key, where keys are flat */
} px[PX_MAX];

/* ---- Triangles ----------------------------------------------------------------------------------------- */

static enum kind any_kind(struct prng *p)
{
    static const uint8_t share[KINDS] = { [TINY] = 20, [SMALL] = 4, [SLIVER] = 11, [CENTER] = 9, [BESIDE] = 9,
                                          [STRAIGHT] = 8, [ZERO] = 3 }; /* of 64 */
    if (prng_pick(p, 256) == 0)
        return LARGE;
    uint32_t n = prng_pick(p, 64), kind = TINY;
    while (n >= share[kind])
        n -= share[kind++];
    return (enum kind)kind;
}

/* A corner's place along one axis of `size` px, from the frame's middle; first: the triangle's first corner's. */
static int32_t place(struct prng *p, enum kind kind, int32_t size, int v, int32_t first, int32_t reach)
{
    const int32_t half = size * 128;
    if (v == 0)
        first = prng_range(p, -half - 600, half + 600);
    switch (kind) {
    case CENTER:
    case BESIDE:
        first = v ? first + prng_range(p, -3, 3) * 256 : (first + half) / 256 * 256 + 128 - half;
        return v || kind == CENTER ? first : first + prng_range(p, -1, 1);
    case LARGE: return prng_range(p, -half * 3, half * 3);
    case HUGE_ONE: return prng_range(p, -GUARD, GUARD);
    default: return v ? first + prng_range(p, -reach, reach) : first;
    }
}

static void corners(struct prng *p, enum kind kind, int32_t w, int32_t h, int32_t c[3][3])
{
    const int32_t reach = kind == TINY ? 64 << prng_pick(p, 5) : kind == SMALL ? 1024 << prng_pick(p, 3) : 1600;
    for (int v = 0; v < 3; v++) {
        c[v][0] = place(p, kind, w, v, c[0][0], reach);
        c[v][1] = place(p, kind, h, v, c[0][1], reach);
    }
    const int axis = (int)prng_pick(p, 2);
    if (kind == BESIDE)
        for (int v = 0; v < 3; v++)
            c[v][axis] += prng_range(p, -1, 1);
    if (kind == SLIVER) {
        const int32_t along = prng_range(p, 0, 256);
        for (int k = 0; k < 2; k++)
            c[2][k] = c[0][k] + (c[1][k] - c[0][k]) * along / 256 + prng_range(p, -1, 1);
    }
    if (kind == STRAIGHT) {
        c[1][axis] = c[0][axis];
        if (prng_pick(p, 2))
            c[2][1 - axis] = c[prng_pick(p, 2)][1 - axis];
    }
    if (kind == ZERO)
        memcpy(c[prng_pick(p, 2) ? 2 : 1], c[0], 2 * sizeof c[0][0]);
}

/* ---- A frame ------------------------------------------------------------------------------------------- */

/* Triangles [from, to) as one mesh in steps of 2^log2 world units. flat: each lies at one of few distances. */
static void part(struct prng *p, int number, uint32_t from, uint32_t to, int log2, int32_t w, int32_t h, int flat)
{
    const int32_t step = 1 << log2, off = log2 ? 128 : 0;
    const int32_t shift[2] = { prng_range(p, -off, off), prng_range(p, -off, off) };
    const int32_t deep = 32000 / step;
    for (uint32_t t = from; t < to; t++) {
        int32_t c[3][3];
        corners(p, log2 ? (prng_pick(p, 2) ? HUGE_ONE : LARGE) : any_kind(p), w, h, c);
        const int32_t level = prng_range(p, -8, 8) * (2000 / step);
        const int32_t middle = prng_range(p, -deep, deep), tilt = 1 << prng_pick(p, 14);
        for (int v = 0; v < 3; v++) {
            int32_t z = flat ? level : middle + prng_range(p, -tilt, tilt);
            z = z < -deep ? -deep : z > deep ? deep : z;
            for (int k = 0; k < 2; k++) {
                int32_t at = c[v][k] / step;
                at = at < -32000 ? -32000 : at > 32000 ? 32000 : at;
                g.pos[3 * t + (uint32_t)v][k] = (int16_t)at;
                c[v][k] = at * step + shift[k];
            }
            g.pos[3 * t + (uint32_t)v][2] = (int16_t)z;
            g.at[t].x[v] = w * 128 + c[v][0];
            g.at[t].y[v] = h * 128 - c[v][1];
            g.d[t][v] = (uint32_t)(PIXEL_Z - z * step - 1) << 16;
            g.tri[t][v] = (uint16_t)(3 * (t - from) + (uint32_t)v);
        }
        g.raw[t] = (uint16_t)(t + 1);
    }
    struct zs_mesh *m = &g.mesh[number];
    memset(m, 0, sizeof *m);
    m->pos = (const int16_t (*)[3])(g.pos + 3 * from);
    m->tri = (const uint16_t (*)[3])(g.tri + from);
    m->face_raw = g.raw + from;
    m->n_verts = 3 * (to - from);
    m->n_tris = to - from;
    m->scale = ZS_Q16_ONE << log2;
    m->radius = 57000;
    struct zs_instance *in = &g.instance[number];
    memset(in, 0, sizeof *in);
    in->mesh = m;
    in->material = &g.material;
    zs_pose_identity(&in->pose);
    in->pose.pos[0] = shift[0];
    in->pose.pos[1] = shift[1];
    in->pose.pos[2] = -PIXEL_Z;
}

static struct zs_config way(struct prng *p, int32_t w, int32_t h, const struct zs_depth *depth, uint32_t fasts)
{
    struct zs_config c = picture_config(w, h, depth);
    const int passes = prng_pick(p, 4) == 0;
    c.varyings = ZS_VARYINGS_FLAT;
    c.strip_h = (uint16_t)(prng_pick(p, 3) ? prng_range(p, 4, h) : prng_range(p, 1, h));
    c.buffers = (uint8_t)(1 + prng_pick(p, 2));
    c.max_tris = (uint16_t)(passes ? prng_range(p, 200, 3000) : TRIS_MAX + 50);
    c.max_verts = (uint16_t)(passes ? prng_range(p, 600, 9000) : 3 * TRIS_MAX + 50);
    c.fast = stress_list(fasts);
    return c;
}

/* Compare. Counts how often triangles cover pixels. */
static int frame_right(const struct picture *f, int flat, uint64_t *hits)
{
    const int n_px = f->w * f->h;
    const uint32_t most = 65534;
    for (int i = 0; i < n_px; i++) {
        px[i].nearest = px[i].owner = INFINITY;
        px[i].first = 0;
    }
    for (uint32_t t = 0; t < g.n; t++) {
        const struct oracle_tri *o = &g.at[t];
        int64_t lo[2] = { INT64_MAX, INT64_MAX }, hi[2] = { INT64_MIN, INT64_MIN };
        for (int v = 0; v < 3; v++) {
            lo[0] = o->x[v] < lo[0] ? o->x[v] : lo[0];
            hi[0] = o->x[v] > hi[0] ? o->x[v] : hi[0];
            lo[1] = o->y[v] < lo[1] ? o->y[v] : lo[1];
            hi[1] = o->y[v] > hi[1] ? o->y[v] : hi[1];
        }
        const int x0 = lo[0] < 0 ? 0 : (int)(lo[0] >> 8), y0 = lo[1] < 0 ? 0 : (int)(lo[1] >> 8);
        const int x1 = hi[0] >> 8 >= f->w ? f->w - 1 : (int)(hi[0] >> 8);
        const int y1 = hi[1] >> 8 >= f->h ? f->h - 1 : (int)(hi[1] >> 8);
        const double area = fabs((double)oracle_area(o)) * 65536;
        for (int j = y0; j <= y1; j++)
            for (int i = x0; i <= x1; i++) {
                if (!oracle_covers(o, i, j))
                    continue;
                ++*hits;
                const int at = j * f->w + i;
                int64_t w[3];
                oracle_weights(o, i, j, w);
                double key = 0;
                for (int v = 0; v < 3; v++)
                    key += (double)w[v] * g.d[t][v] / area;
                if (flat)
                    key = g.d[t][0] / 65536.0;
                if (key < px[at].nearest) {
                    px[at].nearest = key;
                    px[at].first = t + 1;
                }
                if (f->color[at] != t + 1)
                    continue;
                px[at].owner = key;
                const double off = fabs(oracle_key_error(o, g.d[t], i, j, f->key[at], most));
                if (off > 0.505)
                    return stress_wrong("pixel (%d, %d): key %u of triangle %u is off by %.5f", i, j, f->key[at], t,
                                        off);
            }
    }
    for (int i = 0; i < n_px; i++) {
        const int empty = px[i].nearest > 1e9;
        if (empty ? f->color[i] != 0 || f->key[i] != ZS_DEPTH_CLEAR
                  : !(px[i].owner <= px[i].nearest + APART) || (flat && f->color[i] != px[i].first))
            return stress_wrong("pixel (%d, %d): triangle %d, key %u, that should be triangle %d at %.4f", i % f->w,
                                i / f->w, f->color[i] - 1, f->key[i], (int)px[i].first - 1, px[i].nearest);
    }
    return 1;
}

int stress_tris(uint64_t seed, struct stress_counts *c)
{
    static const int16_t sizes[][2] = { { 96, 80 },  { 96, 80 },  { 96, 80 }, { 160, 120 },
                                        { 64, 240 }, { 240, 64 }, { 33, 17 }, { 240, 240 } };
    struct prng p = { seed };
    const int16_t *size = sizes[prng_pick(&p, 8)];
    const int32_t w = size[0], h = size[1];
    const int perspective = prng_pick(&p, 4) == 0, flat = perspective || prng_pick(&p, 3) == 0;
    g.n = 1500 + prng_pick(&p, TRIS_MAX - 1500);
    const int n_parts = 1 + (int)prng_pick(&p, PARTS);
    uint32_t from = 0;
    for (int k = 0; k < n_parts; k++) {
        const int large = k && !perspective && prng_pick(&p, 2); /* in perspective a step is no sub-pixel elsewhere */
        const uint32_t left = g.n - from, n = k == n_parts - 1 ? left : large ? 1 + prng_pick(&p, 12) : left / 2;
        part(&p, k, from, from + n, large && k < n_parts - 1 ? 1 + (int)prng_pick(&p, 6) : 0, w, h, flat);
        if (perspective) /* all at PIXEL_Z: there they are exact */
            for (uint32_t t = from; t < from + n; t++)
                for (int v = 0; v < 3; v++)
                    g.pos[3 * t + (uint32_t)v][2] = 0;
        from += n;
    }
    g.material.shader = &zs_shade_raw;
    g.material.cull = ZS_CULL_NONE;
    g.scene.instance = g.instance;
    g.scene.n_instances = (uint32_t)n_parts;
    const struct zs_camera camera = pixel_camera(h, perspective);
    const uint32_t fasts = stress_fasts(&p);
    const struct zs_config config = way(&p, w, h, perspective ? &zs_depth_recip : &zs_depth_linear, fasts);
    struct picture f = picture_draw(&config, &g.scene, &camera);
    int ok = f.err ? stress_wrong("%s", zs_error_string(f.err)) : stats_add_up(&f.stats);
    if (ok && perspective) /* one key for all: take it from where it is */
        for (int i = 0; i < w * h; i++)
            if (f.key[i] != ZS_DEPTH_CLEAR) {
                for (uint32_t t = 0; t < g.n; t++)
                    g.d[t][0] = g.d[t][1] = g.d[t][2] = (uint32_t)f.key[i] << 16;
                break;
            }
    uint64_t hits = 0;
    ok = ok && frame_right(&f, flat, &hits);
    int tiles = 0; /* then some may be left out */
    for (unsigned k = 0; k < STRESS_FASTS; k++)
        tiles |= strcmp(fast_name(k), "tiles") == 0 && fasts >> k & 1u;
    if (ok && !tiles && hits != f.stats.pixels_tested)
        ok = stress_wrong("%u pixels tested, %llu covered", f.stats.pixels_tested, (unsigned long long)hits);
    if (ok && f.stats.pixels_tested > hits)
        ok = stress_wrong("%u pixels tested, %llu covered", f.stats.pixels_tested, (unsigned long long)hits);
    c->units += g.n;
    c->tris += g.n;
    c->frames++;
    c->pixels += hits;
    stress_saw_fasts(c->seen, fasts, 0);
    picture_free(&f);
    return ok;
}
