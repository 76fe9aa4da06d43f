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
 * a table. |N w|^2 is at least the least of u.u, u.v and v.v. Where that is below a quarter of what
 * the table holds (normals 75 degrees apart, w twice as large at one end), and with other lamps,
 * each pixel is lit by itself, as a vertex is.
 *
 * Error of a cosine in a block: normals of 15 bits, 2^-15; table, 2^-14.4; of its power p, p times
 * that, and 0.011 for the table of powers. Colours: light has 7 bits, red and blue of what it
 * multiplies 1/8 code, of highlights 1/4: 0.5 code in all.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/pass.h"
#include "effect/lights.h"
#include "shade/persp.h"

#define BLOCK 32
#define BIAS (1u << 30) /* of planes of normals */
#define FAST 1u         /* job->sub_log2: by blocks */
#define GENERAL 0u
#define NORMAL_ONE 32760 /* length of a normal as a varying, below 2^15 */

_Static_assert(BLOCK <= 1 << ZS_SUB_LOG2_MAX, "zs_one_over");

/* ---- Vertices and faces ---------------------------------------------------------------------- */

static void phong_vertex(const struct zs_shading *s, uint32_t v, uint16_t *out)
{
    const zs_q1_15 *const normal = s->instance->mesh->normal[v];
    const int32_t n[3] = { normal[0], normal[1], normal[2] };
    struct zs_lit_at at;
    zs_lit_normal(&at, s->instance, n);
    for (int k = 0; k < 3; k++)
        out[k] = (uint16_t)(32768 + ((at.n[k] * NORMAL_ONE + (1 << 14)) >> 15));
}

static void near_vertex(const struct zs_shading *s, uint32_t v, uint16_t *out)
{
    phong_vertex(s, v, out);
    for (int k = 0; k < 3; k++)
        out[3 + k] = (uint16_t)(s->instance->mesh->pos[v][k] + 32768);
}

#define TURNED 1u /* bit of zs_tri.paint; the others are face_rgb, five bits a channel */

/* The colour of a face whose paint is given. */
static struct zs_rgb color_of(const struct zs_instance *in, uint32_t paint)
{
    const uint32_t red = paint >> 11, green = paint >> 6 & 31u, blue = paint >> 1 & 31u;
    const struct zs_rgb rgb = { (uint8_t)(red << 3 | red >> 2), (uint8_t)(green << 3 | green >> 2),
                                (uint8_t)(blue << 3 | blue >> 2) };
    return in->mesh->face_rgb ? rgb : in->material->rgb;
}

/* A channel in five bits, nearest. */
static uint32_t five_bits(uint32_t channel)
{
    return (channel * 31u + 127u) / 255u;
}

/* TURNED: the face turns away from the eye, and its normals are turned round. */
static uint16_t turned(const struct zs_shading *s, uint32_t t)
{
    const struct zs_instance *const in = s->instance;
    const struct zs_mesh *const mesh = in->mesh;
    struct zs_lit_at at;
    zs_q1_15 normal[3];
    int32_t p[3], n[3];
    if (!(zs_lit_material_of(in)->flags & ZS_LIT_TWO_SIDED))
        return 0;
    zs_light_face_normal(normal, mesh, t);
    for (int k = 0; k < 3; k++) {
        p[k] = mesh->pos[mesh->tri[t][0]][k] * 256;
        n[k] = normal[k];
    }
    zs_lit_place(&at, in, p);
    zs_lit_normal(&at, in, n);
    zs_lit_view(&at, s->camera, 1);
    return zs_lit_dot(at.n, at.view) < 0;
}

static uint16_t phong_face(const struct zs_shading *s, uint32_t t)
{
    const struct zs_rgb *const rgb = s->instance->mesh->face_rgb;
    const uint32_t color = rgb ? five_bits(rgb[t].r) << 11 | five_bits(rgb[t].g) << 6 |
                                     five_bits(rgb[t].b) << 1
                               : 0u;
    return (uint16_t)(color | turned(s, t));
}

static int near_check(const struct zs_instance *in, const struct zs_config *config)
{
    return in->mesh->normal ? zs_lit_check(in, config) : ZS_ERR_MESH;
}

static int phong_check(const struct zs_instance *in, const struct zs_config *config)
{
    const struct zs_lit_material *const m = zs_lit_material_of(in);
    const int err = near_check(in, config);
    if (err)
        return err;
    for (uint32_t k = 0; k < m->lighting->n_lamps; k++)
        if (m->lighting->lamp[k].kind != ZS_LAMP_DIRECTIONAL)
            return ZS_ERR_RANGE;
    return m->flags & ZS_LIT_NEAR_VIEWER ? ZS_ERR_RANGE : ZS_OK;
}

/* ---- Set-up ---------------------------------------------------------------------------------- */

/* Convert a channel, up to 2 * 65535, to codes, uq16_16. */
static uint32_t codes(uint32_t channel, uint32_t most)
{
    return channel * most + (channel * most >> 16); /* < 2^23.1 */
}

/* Red and blue in 16 bits each, with `bits` of fraction; codes in uq16_16. */
static uint32_t both(const uint32_t c[3], int bits)
{
    const int down = 16 - bits;
    return ((c[0] + (1u << (down - 1))) >> down) << 16 | (c[2] + (1u << (down - 1))) >> down;
}

/* Set job->gloss. Return 0 if the triangle cannot be drawn by blocks. */
static int gloss_start(struct zs_job *job, const struct zs_instance *in)
{
    const struct zs_lit_material *const m = zs_lit_material_of(in);
    const struct zs_lamp *const lamp = m->lighting->lamp;
    struct zs_gloss *const g = &job->gloss;
    struct zs_lit_at at = { { 0 }, { 0 }, { 0 } };
    struct zs_lit_sum full, dark;
    uint16_t base[3];
    uint32_t c[3][3], square;
    int32_t exp;
    if (m->lighting->n_lamps != 1 || m->flags & ZS_LIT_REFLECT)
        return 0;
    zs_lit_view(&at, &job->r->camera, 0);
    for (int k = 0; k < 3; k++) {
        g->light[k] = (lamp->dir[k] + (1 << 14)) >> 15;
        g->half[k] = g->light[k] + at.view[k];
    }
    (void)zs_lit_unit(g->half, g->half, &square, &exp);
    zs_lit_add(m, &at, &dark); /* the normal is 0: ambient light alone */
    zs_lit_lamp(m, &full);
    const struct zs_rgb own = color_of(in, job->tri->paint);
    const uint8_t rgb[3] = { own.r, own.g, own.b };
    zs_lit_mix(m, own, &dark, base);
    const uint8_t specular[3] = { m->specular.r, m->specular.g, m->specular.b };
    for (int k = 0; k < 3; k++) {
        const uint32_t most = k == 1 ? 63u : 31u;
        const uint32_t d = zs_lit_part(rgb[k], full.diffuse[k]);
        const uint32_t s = m->shine ? zs_lit_part(specular[k], full.shine[k]) : 0u;
        if (base[k] + d + s > 129000u) /* twice full, and room for rounding */
            return 0;
        c[0][k] = codes(base[k], most);
        c[1][k] = codes(d, most);
        c[2][k] = codes(s, most);
    }
    /* at the end: red from bit 26, blue from bit 10, green from bit 25, each with half a code */
    g->base[0] = both(c[0], 10) + (1u << 25) + (1u << 9);
    g->base[1] = (c[0][1] << 9) + (1u << 24);
    g->diffuse[0] = both(c[1], 3); /* times 2^7 */
    g->diffuse[1] = c[1][1] << 2;
    for (int k = 0; k < 3; k++)
        c[2][k] += c[2][k] >> 8; /* times 255 instead of 256 */
    g->shine[0] = both(c[2], 2);
    g->shine[1] = c[2][1] << 1;
    return 1;
}

static void normal_planes(struct zs_job *job, const uint16_t *const a[3], const uint32_t w[3])
{
    for (int c = 0; c < 3; c++) {
        uint32_t v[3];
        for (int k = 0; k < 3; k++)
            v[k] = (uint32_t)(zs_mul_su(a[k][c] - 32768, w[k]) >> 16) + BIAS;
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
    job->sub_log2 = gloss_start(job, zs_instance_of(job->r, job->tri->instance)) ? FAST : GENERAL;
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
    for (int k = 0; k < 3; k++) {
        const int32_t v = (int32_t)(zs_plane_at(&job->c[k], i, row) - BIAS);
        n[k] = job->tri->paint & TURNED ? -v : v;
    }
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
        zs_lit_mix(m, color_of(in, job->tri->paint), &sum, c);
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

/* Set up a block of `length` pixels' steps from n to v (N w / 2), at its skip-th pixel. Return 0 if
 * the table does not reach. */
static int block_start(struct block *b, const struct zs_gloss *g, const int32_t n[3],
                       const int32_t v[3], int32_t length, int32_t skip)
{
    uint32_t most = 0;
    for (int k = 0; k < 3; k++)
        most |= zs_size32(n[k]) | zs_size32(v[k]);
    int32_t down = 17 - zs_clz32(most | 1u); /* below 2^15 */
    int32_t a[3], e[3];
    uint32_t aa, ee;
    if (down < 1)
        return 0;
    do {
        for (int k = 0; k < 3; k++) {
            a[k] = (n[k] + (1 << down >> 1)) >> down;
            e[k] = (v[k] + (1 << down >> 1)) >> down;
        }
        aa = square_of(a);
        ee = square_of(e);
        down++;
    } while (aa >= (1u << 30) - 256u || ee >= (1u << 30) - 256u);
    const uint32_t ae = (uint32_t)zs_lit_dot(a, e);
    if ((int32_t)ae < 0 || zs_minu32(zs_minu32(aa, ee), ae) < (1u << 28) + 256u)
        return 0;
    const uint32_t over = zs_one_over[length];
    const int32_t l0 = zs_lit_dot(a, g->light), h0 = zs_lit_dot(a, g->half);
    b->by_l = (int32_t)(zs_mul_su(zs_lit_dot(e, g->light) - l0, over) >> 32);
    b->by_h = (int32_t)(zs_mul_su(zs_lit_dot(e, g->half) - h0, over) >> 32);
    b->l = l0 + b->by_l * skip;
    b->h = h0 + b->by_h * skip;
    const uint32_t bend = zs_umulh(aa - ae + (ee - ae), over);
    b->by_by = (uint32_t)(zs_mul_uu(bend, over) >> 29); /* 8 (aa - 2 ae + ee) / length^2 */
    const uint32_t first = (uint32_t)(zs_mul_su((int32_t)(ae - aa), over) >> 29) + b->by_by / 2u;
    b->q = (aa << 2) + zs_wrap_mul(first, skip) + zs_wrap_mul(b->by_by, skip * (skip - 1) / 2);
    b->by_q = first + zs_wrap_mul(b->by_by, skip);
    return 1;
}

/* A colour of which a channel is more than full. */
static ZS_NOINLINE uint32_t held(uint32_t rb, uint32_t green)
{
    return zs_minu32(rb >> 26, 31u) << 11 | zs_minu32(green >> 25, 63u) << 5 |
           zs_minu32(rb >> 10 & 63u, 31u);
}

/* Fill n > 0 pixels. glossy is a constant: 0 leaves out highlights. */
ZS_ALWAYS_INLINE void block_fill(uint16_t *out, int32_t n, const struct block *b,
                                 const struct zs_gloss *g, const struct zs_shine *shine, int glossy)
{
    uint32_t q = b->q, by_q = b->by_q;
    int32_t l = b->l, h = b->h;
    const uint32_t by_by = b->by_by;
    const int32_t by_l = b->by_l, by_h = b->by_h;
    const uint32_t base_rb = g->base[0], base_g = g->base[1], rb_by = g->diffuse[0],
                   g_by = g->diffuse[1], rb_shine = g->shine[0], g_shine = g->shine[1];
    const uint32_t scale = glossy ? shine->scale : 0u;
    const int32_t least = glossy ? shine->least - (int32_t)((1u << 22) / scale) : 0;
    const uint8_t *const level = glossy ? shine->level : 0;
    for (uint16_t *const end = out + n; out != end; out++) {
        const uint32_t over = zs_lit_rsqrt(q);
        const uint32_t light = (zs_umulh((uint32_t)(l & ~(l >> 31)), over) + (1u << 21)) >> 22;
        uint32_t rb = base_rb + light * rb_by, green = base_g + light * g_by;
        if (glossy) {
            const int32_t t = (int32_t)(zs_umulh((uint32_t)(h & ~(h >> 31)), over) >> 13) - least;
            if (t > 0 && l > 0) {
                const uint32_t s = level[(uint32_t)t * scale >> 23];
                rb += s * rb_shine;
                green += s * g_shine;
            }
            h += by_h;
        }
        uint32_t c = rb >> 26 << 11 | green >> 25 << 5 | (rb >> 10 & 31u);
        if ((int32_t)(rb | green | rb << 16) < 0)
            c = held(rb, green);
        *out = zs_wire16((uint16_t)c);
        l += by_l;
        q += by_q;
        by_q += by_by;
    }
}

static ZS_NOINLINE void fill_glossy(uint16_t *out, int32_t n, const struct block *b,
                                    const struct zs_gloss *g, const struct zs_shine *shine)
{
    block_fill(out, n, b, g, shine, 1);
}

static ZS_NOINLINE void fill_matt(uint16_t *out, int32_t n, const struct block *b,
                                  const struct zs_gloss *g)
{
    block_fill(out, n, b, g, 0, 0);
}

static void phong_run(struct zs_job *job, const struct zs_row *row, int32_t r0, int32_t r1)
{
    const struct zs_instance *const in = zs_instance_of(job->r, job->tri->instance);
    const struct zs_shine *const shine = zs_lit_material_of(in)->shine;
    int32_t n[3], next[3], from = row->x0 + ((r0 - row->x0) & -BLOCK);
    if (job->sub_log2 != FAST) {
        each(job, row, r0, r1, 0);
        return;
    }
    normal_at(job, from, row->y, next);
    for (; from < r1; from += BLOCK) {
        const int32_t to = zs_min32(from + BLOCK, row->x1 - 1); /* its far end: a covered pixel */
        const int32_t i0 = zs_max32(from, r0), i1 = zs_min32(from + BLOCK, r1);
        struct block b;
        for (int k = 0; k < 3; k++)
            n[k] = next[k];
        if (to > from)
            normal_at(job, to, row->y, next);
        if (!block_start(&b, &job->gloss, n, next, to - from, i0 - from))
            each(job, row, i0, i1, 0);
        else if (shine && (job->gloss.shine[0] | job->gloss.shine[1]))
            fill_glossy(job->color + row->at + i0, i1 - i0, &b, &job->gloss, shine);
        else
            fill_matt(job->color + row->at + i0, i1 - i0, &b, &job->gloss);
    }
}

static void near_run(struct zs_job *job, const struct zs_row *row, int32_t r0, int32_t r1)
{
    const struct zs_instance *const in = zs_instance_of(job->r, job->tri->instance);
    each(job, row, r0, r1, zs_lit_placed(zs_lit_material_of(in), &job->r->camera));
}

const struct zs_shader zs_shade_phong = { .vertex = phong_vertex,
                                          .face = phong_face,
                                          .start = phong_start,
                                          .run = phong_run,
                                          .check = phong_check,
                                          .n_varyings = ZS_VARYINGS_LIT,
                                          .opaque = 1 };
const struct zs_shader zs_shade_phong_near = { .vertex = near_vertex,
                                               .face = phong_face,
                                               .start = near_start,
                                               .run = near_run,
                                               .check = near_check,
                                               .n_varyings = ZS_VARYINGS_PHONG_NEAR,
                                               .opaque = 1 };
