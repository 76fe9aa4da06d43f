/* Phong shading: normals are interpolated and given length 1 at each pixel.
 *
 * Interpolated perspective-correctly, a normal is N w / w, and N w is linear on the screen. Its
 * direction is that of N w, so that nothing is divided. Planes hold N w / 2 + 2^30 with 31 bits:
 * their error is 2^-21 (core/plane.c).
 *
 * With one directional lamp and a distant viewer, a run is drawn in blocks of 32 pixels that begin
 * at the scanline's first pixel, so that a pixel does not depend on what else is visible. With u
 * and v the vectors N w at both ends of a block, N w . L and N w . H are linear in it, and |N w|^2
 * is (1 - t)^2 u.u + 2 t (1 - t) u.v + t^2 v.v: both are stepped, and multiplied by 1 / |N w| from
 * a table. |N w|^2 is at least the least of u.u, u.v and v.v. Where that is below a half to a
 * quarter of the larger of u.u and v.v (normals 60 degrees apart in a block, w 1.4 times as large
 * at one end), and with other lamps, each pixel is lit by itself, as a vertex is.
 *
 * Error of a cosine in a block: normals of 15 bits, 2^-15; table, 2^-14.4; of its power p, p times
 * that, and 0.011 for the table of powers. Colours: light has 7 bits, red and blue of what it
 * multiplies 1/8 code off, of highlights 1/4: 0.6 code in all.
 *
 * SPDX-License-Identifier: MIT
 */
#include "arch/held.h"
#include "core/pass.h"
#include "effect/lights.h"
#include "shade/persp.h"

#define BLOCK 32
#define BIAS (1u << 30) /* of planes of normals */
#define GENERAL 0u      /* job->sub_log2: each pixel by itself, ... */
#define FAST 1u         /* ... by blocks, ... */
#define BRIGHT 2u       /* ... whose sums, with highlights, come to twice to four times full */

/* A triangle with one directional lamp, in job->own. Colours: red and blue in a word, green in a
 * word. */
struct gloss {
    int32_t light[3], half[3]; /* unit, q1_15 */
    uint32_t base[2], diffuse[2], shine[2];
};

_Static_assert(sizeof(struct gloss) <= sizeof((struct zs_job *)0)->own, "it is kept there");
static inline struct gloss *gloss_of(struct zs_job *job)
{
    return (struct gloss *)(void *)job->own; /* words in place of words */
}

_Static_assert(BLOCK <= 1 << ZS_SUB_LOG2_MAX, "zs_one_over");

/* ---- Set-up ---------------------------------------------------------------------------------- */

/* Convert a channel, up to 4 * 65535, to codes, uq16_16. */
static uint32_t codes(uint32_t channel, uint32_t most)
{
    return channel * most + (channel * most >> 16); /* < 2^24 */
}

/* Red and blue in 16 bits each, with `bits` of fraction; codes in uq16_16. */
static uint32_t both(const uint32_t c[3], int bits)
{
    const int down = 16 - bits;
    return ((c[0] + (1u << (down - 1))) >> down) << 16 | (c[2] + (1u << (down - 1))) >> down;
}

/* Set g. Return how the triangle is drawn. */
static uint32_t gloss_start(struct zs_job *job, const struct zs_instance *in)
{
    const struct zs_lit_material *const m = zs_lit_material_of(in);
    const struct zs_lamp *const lamp = m->lighting->lamp;
    struct gloss *const g = gloss_of(job);
    struct zs_lit_at at = { { 0 }, { 0 }, { 0 } };
    struct zs_lit_sum full, dark;
    uint16_t base[3];
    uint32_t c[3][3], square, sum = 0;
    int32_t exp;
    if (m->lighting->n_lamps != 1 || m->flags & ZS_LIT_REFLECT)
        return GENERAL;
    zs_lit_view(&at, &job->r->camera, 0);
    for (int k = 0; k < 3; k++) {
        g->light[k] = (lamp->dir[k] + (1 << 14)) >> 15;
        g->half[k] = g->light[k] + at.view[k];
    }
    (void)zs_lit_unit(g->half, g->half, &square, &exp);
    zs_lit_add(m, &at, &dark); /* the normal is 0: ambient light alone */
    zs_lit_lamp(m, &full);
    const struct zs_rgb own = zs_phong_color(in, job->tri->paint);
    const uint8_t rgb[3] = { own.r, own.g, own.b };
    zs_lit_mix(m, own, &dark, base);
    const uint8_t specular[3] = { m->specular.r, m->specular.g, m->specular.b };
    for (int k = 0; k < 3; k++) {
        const uint32_t most = k == 1 ? 63u : 31u;
        const uint32_t d = zs_lit_part(rgb[k], full.diffuse[k]);
        const uint32_t s = m->shine ? zs_lit_part(specular[k], full.shine[k]) : 0u;
        sum = zs_maxu32(sum, base[k] + d + s);
        c[0][k] = codes(base[k], most);
        c[1][k] = codes(d, most);
        c[2][k] = codes(s, most);
    }
    const uint32_t way = sum <= 129000u ? FAST : BRIGHT; /* twice full, and room for rounding */
    if (sum > 258000u || (way == BRIGHT && !m->shine))
        return GENERAL;
    /* at the end: red from bit 25, blue from bit 9, green from bit 24, each with half a code */
    g->base[0] = both(c[0], 9) + (1u << 24) + (1u << 8);
    g->base[1] = (c[0][1] << 8) + (1u << 23);
    g->diffuse[0] = both(c[1], 2); /* times 2^7 */
    g->diffuse[1] = c[1][1] << 1;
    for (int k = 0; k < 3; k++)
        c[2][k] += c[2][k] >> 8; /* times 255 instead of 256 */
    g->shine[0] = both(c[2], 1);
    g->shine[1] = c[2][1];
    return way;
}

/* The longest N w / 2 is scaled to 2^29.5 .. 2^30. */
static void normal_planes(struct zs_job *job, const uint16_t *const a[3], const uint32_t w[3])
{
    const uint32_t most = zs_maxu32(zs_maxu32(w[0], w[1]), w[2]);
    const int32_t size = most < 1518500249u ? 46340 : 32768; /* sqrt 2, if most < 2^30.5 */
    const int32_t by = job->tri->paint & ZS_PHONG_TURNED ? -size : size;
    for (int c = 0; c < 3; c++) {
        uint32_t v[3];
        for (int k = 0; k < 3; k++)
            v[k] = (uint32_t)(zs_mul_su((a[k][c] - 32768) * by >> 15, w[k]) >> 16) + BIAS;
        zs_persp_plane(&job->geom, v, ZS_PLANE_WIDE, &job->c[c]);
    }
}

static void phong_start(struct zs_job *job)
{
    const uint16_t *a[3];
    uint32_t w[3];
    zs_persp_attrs(job, a);
    zs_persp_w(job, w);
    normal_planes(job, a, w);
    job->sub_log2 = gloss_start(job, zs_instance_of(job->r, job->tri->instance));
}

static void near_start(struct zs_job *job)
{
    zs_fragments_start(job);
#if ZS_VARYINGS_MAX >= 6
    const uint16_t *a[3];
    uint32_t w[3];
    zs_persp_attrs(job, a);
    zs_persp_w(job, w);
    normal_planes(job, a, w);
#endif
}

/* ---- One pixel ------------------------------------------------------------------------------- */

/* N w / 2 at a covered pixel, |.| <= 2^30. */
static void normal_at(const struct zs_job *job, int32_t i, int32_t row, int32_t n[3])
{
    for (int k = 0; k < 3; k++)
        n[k] = (int32_t)(zs_plane_at(&job->c[k], i, row) - BIAS);
}

/* Set at->pos at a covered pixel of a job with six varyings. */
static void place_at(const struct zs_job *job, const struct zs_instance *in, int32_t i, int32_t row,
                     struct zs_lit_at *at)
{
#if ZS_VARYINGS_MAX >= 6
    uint32_t w;
    int32_t lz, p[3];
    const uint32_t rcp = zs_persp_rcp(job, i, row, &w, &lz);
    for (int k = 0; k < 3; k++)
        p[k] = (int32_t)(zs_persp_over(zs_plane_at(&job->c[3 + k], i, row), w, rcp, lz) >> 7) -
               32768 * 256; /* uq1_31 of 65536 steps */
    zs_lit_place(at, in, p);
#else
    (void)job;
    (void)in;
    (void)i;
    (void)row;
    (void)at;
#endif
}

/* Light pixels [from, to) one by one. */
static ZS_NOINLINE void each(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to,
                             int placed)
{
    const struct zs_instance *const in = zs_instance_of(job->r, job->tri->instance);
    const struct zs_lit_material *const m = zs_lit_material_of(in);
    const struct zs_camera *const camera = &job->r->camera;
    const struct zs_rgb rgb = zs_phong_color(in, job->tri->paint);
    const int near = m->flags & ZS_LIT_NEAR_VIEWER;
    struct zs_lit_at at;
    zs_lit_view(&at, camera, 0);
    for (int32_t i = from; i < to; i++) {
        struct zs_lit_sum sum;
        uint16_t c[3];
        int32_t n[3], exp;
        uint32_t square;
        normal_at(job, i, row->y, n);
        (void)zs_lit_unit(at.n, n, &square, &exp);
        if (placed)
            place_at(job, in, i, row->y, &at);
        if (near)
            zs_lit_view(&at, camera, 1);
        zs_lit_add(m, &at, &sum);
        zs_lit_mix(m, rgb, &sum, c);
        job->color[row->at + i] = zs_lit_pack(c);
    }
}

/* ---- Blocks ---------------------------------------------------------------------------------- */

/* Values that are stepped along a block. */
struct block {
    uint32_t q, by_q, by_by;  /* |N w|^2, [2^30, 2^32), and its differences */
    int32_t l, h, by_l, by_h; /* N w . L and N w . H, q1_30 of the same length */
};

/* v . v, for components up to 2^15. */
static inline uint32_t square_of(const int32_t v[3])
{
    return (uint32_t)(v[0] * v[0]) + (uint32_t)(v[1] * v[1]) + (uint32_t)(v[2] * v[2]);
}

/* One end of a block. */
struct end {
    int32_t v[3]; /* N w, |v|^2 < 2^30 - 256 */
    uint32_t vv;  /* v . v */
    int32_t l, h; /* v . L, and v . H in entries of the table / 2^14 */
};

static void end_set(struct end *e, const struct gloss *g, uint32_t scale)
{
    e->vv = square_of(e->v);
    e->l = zs_lit_dot(e->v, g->light);
    /* c / 2^16 * scale / 2^15 / 2^8 entries */
    e->h = (int32_t)(zs_mul_su(zs_lit_dot(e->v, g->half), scale) >> 21);
}

static void end_at(struct end *e, const struct zs_job *job, const struct gloss *g, uint32_t scale,
                   int32_t i, int32_t row)
{
    for (int k = 0; k < 3; k++)
        e->v[k] = ((int32_t)(zs_plane_at(&job->c[k], i, row) - BIAS) + (1 << 14)) >> 15;
    end_set(e, g, scale);
}

/* Set up the steps of a block of `length` pixels from a to e, at its skip-th pixel. Return 0 if the
 * table does not reach. */
static int block_start(struct block *b, const struct end *a, const struct end *e, int32_t length,
                       int32_t skip)
{
    const int32_t ae = zs_lit_dot(a->v, e->v);
    const uint32_t least = (1u << 28) + 256u;
    if (ae < (int32_t)least || a->vv < least || e->vv < least)
        return 0;
    const uint32_t over = zs_one_over(length);
    b->by_l = (int32_t)(zs_mul_su(e->l - a->l, over) >> 32);
    b->by_h = (int32_t)(zs_mul_su(e->h - a->h, over) >> 32);
    b->l = a->l + b->by_l * skip;
    b->h = a->h + b->by_h * skip;
    const uint32_t bend = zs_umulh(a->vv + e->vv - 2u * (uint32_t)ae, over);
    const uint32_t half = (uint32_t)(zs_mul_uu(bend, over) >> 30); /* 4 |u - v|^2 / length^2 */
    const uint32_t first = (uint32_t)(zs_mul_su(ae - (int32_t)a->vv, over) >> 29) + half;
    b->by_by = 2u * half;
    b->q = (a->vv << 2) - (1u << 30) + zs_wrap_mul(first, skip) +
           zs_wrap_mul(half, skip * (skip - 1));
    b->by_q = first + zs_wrap_mul(b->by_by, skip);
    return 1;
}

/* Set both ends of a block that is far away: N w is scaled up. */
static ZS_RARE ZS_NOINLINE void far_ends(struct end both[2], struct zs_job *job,
                                         const struct gloss *g, uint32_t scale, int32_t from,
                                         int32_t to, int32_t row)
{
    int32_t n[2][3];
    uint32_t most = 1, longest;
    normal_at(job, from, row, n[0]);
    normal_at(job, to, row, n[1]);
    for (int k = 0; k < 3; k++)
        most |= zs_size32(n[0][k]) | zs_size32(n[1][k]);
    int32_t down = zs_max32(17 - zs_clz32(most), 1); /* below 2^15 */
    do {
        for (int i = 0; i < 2; i++) {
            for (int k = 0; k < 3; k++)
                both[i].v[k] = (n[i][k] + (1 << down >> 1)) >> down;
            end_set(&both[i], g, scale);
        }
        longest = zs_maxu32(both[0].vv, both[1].vv);
        down++;
    } while (longest >= (1u << 30) - 256u);
    if (longest >= (1u << 29) - 512u)
        return;
    for (int i = 0; i < 2; i++) { /* times sqrt 2 */
        for (int k = 0; k < 3; k++)
            both[i].v[k] = (both[i].v[k] * 46340 + (1 << 14)) >> 15; /* < 2^30.5 */
        end_set(&both[i], g, scale);
    }
}

/* Pack a colour: red from bit 25, green from 24, blue from 9; each may be up to twice full, where
 * bright, a constant, is 1 up to four times. */
ZS_ALWAYS_INLINE uint16_t packed(uint32_t rb, uint32_t green, int bright)
{
    uint32_t r, g, b;
    if (bright) { /* ZS_HELD takes less than 2^31 */
        ZS_HELD(r, rb >> 1, 24, 5);
        ZS_HELD(g, green >> 1, 23, 6);
        ZS_HELD(b, rb & 0xffffu, 9, 5);
    } else {
        ZS_HELD(r, rb, 25, 5);
        ZS_HELD(g, green, 24, 6);
        ZS_HELD(b, rb & 0x7fffu, 9, 5);
    }
    return zs_wire16((uint16_t)(r << 11 | g << 5 | b));
}

/* Fill n > 0 pixels. Constants: glossy: 0 leaves out highlights; bright: as above. */
ZS_ALWAYS_INLINE void block_fill(uint16_t *out, int32_t n, const struct block *b,
                                 const struct gloss *g, const struct zs_shine *shine, int glossy,
                                 int bright)
{
    uint32_t q = b->q, by_q = b->by_q;
    int32_t l = b->l, h = b->h;
    const uint32_t by_by = b->by_by;
    const int32_t by_l = b->by_l, by_h = b->by_h;
    const uint32_t base_rb = g->base[0], base_g = g->base[1], rb_by = g->diffuse[0],
                   g_by = g->diffuse[1], rb_shine = g->shine[0], g_shine = g->shine[1];
    /* h is in entries of the table / 2^14; its products have 15 fraction bits; the nearest entry */
    const int32_t least = glossy ? (int32_t)(zs_mul_uu(shine->least, shine->scale) >> 8) - (1 << 14)
                                 : 0;
    const uint8_t *const level = glossy ? shine->level : 0;
    for (uint16_t *const end = out + n; out != end; out++) {
        const uint32_t over = zs_lit_rsqrt(q);
        const uint32_t light = (zs_umulh(zs_positive(l), over) + (1u << 21)) >> 22; /* uq_7 */
        uint32_t rb = base_rb + light * rb_by, green = base_g + light * g_by;
        if (glossy) {
            const int32_t t = (int32_t)zs_umulh(zs_positive(h), over) - least;
            if (t > 0 && l > 0) {
                const uint32_t s = level[t >> 15];
                rb += s * rb_shine;
                green += s * g_shine;
            }
            h += by_h;
        }
        *out = packed(rb, green, bright);
        l += by_l;
        q += by_q;
        by_q += by_by;
    }
}

static ZS_NOINLINE void fill_glossy(uint16_t *out, int32_t n, const struct block *b,
                                    const struct gloss *g, const struct zs_shine *shine)
{
    block_fill(out, n, b, g, shine, 1, 0);
}

/* Of a light thing that shines; pixel by pixel these took four times as much. */
static ZS_NOINLINE void fill_bright(uint16_t *out, int32_t n, const struct block *b,
                                    const struct gloss *g, const struct zs_shine *shine)
{
    block_fill(out, n, b, g, shine, 1, 1);
}

static ZS_NOINLINE void fill_matt(uint16_t *out, int32_t n, const struct block *b,
                                  const struct gloss *g)
{
    block_fill(out, n, b, g, 0, 0, 0);
}

static void phong_run(struct zs_job *job, const struct zs_row *row, int32_t r0, int32_t r1)
{
    const struct zs_instance *const in = zs_instance_of(job->r, job->tri->instance);
    const struct gloss *const g = gloss_of(job);
    const struct zs_shine *shine = zs_lit_material_of(in)->shine;
    int32_t from = row->x0 + ((r0 - row->x0) & -BLOCK);
    if (job->sub_log2 == GENERAL) {
        each(job, row, r0, r1, 0);
        return;
    }
    if (job->sub_log2 == FAST && !(g->shine[0] | g->shine[1]))
        shine = 0;
    const uint32_t scale = shine ? shine->scale : 0u;
    struct end next, ends[2];
    end_at(&next, job, g, scale, from, row->y);
    for (; from < r1; from += BLOCK) {
        const int32_t to = zs_min32(from + BLOCK, row->x1 - 1); /* its far end: a covered pixel */
        const int32_t i0 = zs_max32(from, r0), i1 = zs_min32(from + BLOCK, r1);
        struct block b;
        ends[0] = next;
        end_at(&next, job, g, scale, to, row->y);
        int steps = block_start(&b, &ends[0], &next, to - from, i0 - from);
        if (!steps) {
            far_ends(ends, job, g, scale, from, to, row->y);
            steps = block_start(&b, &ends[0], &ends[1], to - from, i0 - from);
        }
        if (!steps)
            each(job, row, i0, i1, 0);
        else if (job->sub_log2 == BRIGHT)
            fill_bright(job->color + row->at + i0, i1 - i0, &b, g, shine);
        else if (shine)
            fill_glossy(job->color + row->at + i0, i1 - i0, &b, g, shine);
        else
            fill_matt(job->color + row->at + i0, i1 - i0, &b, g);
    }
}

static void near_run(struct zs_job *job, const struct zs_row *row, int32_t r0, int32_t r1)
{
    const struct zs_instance *const in = zs_instance_of(job->r, job->tri->instance);
    each(job, row, r0, r1, zs_lit_placed(zs_lit_material_of(in), &job->r->camera));
}

#define PHONG(vertex_, start_, run_, check_, varyings_) \
    { .vertex = (vertex_), .face = zs_phong_face, .start = (start_), .run = (run_), \
      .check = (check_), .n_varyings = (varyings_), .opaque = 1 }

const struct zs_shader zs_shade_phong = PHONG(zs_phong_vertex, phong_start, phong_run,
                                              zs_phong_check, ZS_VARYINGS_LIT);
const struct zs_shader zs_shade_phong_near = PHONG(zs_phong_near_vertex, near_start, near_run,
                                                   zs_phong_near_check, ZS_VARYINGS_PHONG_NEAR);
