/* Procedural meshes, integers only: the same on every machine.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef TESTS_SHAPES_H
#define TESTS_SHAPES_H

#include "prng.h"
#include "zstrip.h"

#define SHAPE_VERTS 1200
#define SHAPE_TRIS 2400

/* A mesh and everything that it points at: keep it where it is while it is used. */
struct shape {
    struct zs_mesh mesh;
    int16_t pos[SHAPE_VERTS][3];
    uint8_t pos_lo[SHAPE_VERTS][3];
    zs_q1_15 normal[SHAPE_VERTS][3];
    struct zs_rgb vertex_rgb[SHAPE_VERTS];
    uint16_t tri[SHAPE_TRIS][3];
    struct zs_rgb face_rgb[SHAPE_TRIS];
    uint16_t face_raw[SHAPE_TRIS];
};

static inline void shape_begin(struct shape *s)
{
    const struct zs_mesh none = { 0 };
    s->mesh = none;
    s->mesh.scale = ZS_Q16_ONE;
}

/* Give it texture coordinates at random, up to `most` each way, of so many bits. uv: [n_verts], kept where it is as
 * long as the shape. */
static inline void shape_uv(struct shape *s, int16_t (*uv)[2], struct prng *p, int32_t most, uint8_t bits)
{
    for (uint32_t v = 0; v < s->mesh.n_verts; v++)
        for (int k = 0; k < 2; k++)
            uv[v][k] = (int16_t)prng_range(p, -most, most);
    s->mesh.uv = (const int16_t (*)[2])uv;
    s->mesh.uv_bits = bits;
}

/* Returns the vertex's number. The normal is the direction of n. */
static inline uint32_t shape_vertex(struct shape *s, const int32_t p[3], const int32_t n[3])
{
    const uint32_t v = s->mesh.n_verts++;
    zs_q2_30 unit[3] = { 0, 0, ZS_Q30_ONE };
    (void)zs_unit(unit, n);
    for (int k = 0; k < 3; k++) {
        s->pos[v][k] = (int16_t)p[k];
        s->pos_lo[v][k] = (uint8_t)(v * 37u + (uint32_t)k * 91u);
        s->normal[v][k] = (zs_q1_15)(unit[k] / 32768 > 32767 ? 32767 : unit[k] / 32768);
    }
    s->vertex_rgb[v].r = (uint8_t)(255u - v % 7u * 30u);
    s->vertex_rgb[v].g = (uint8_t)(90u + v % 5u * 40u);
    s->vertex_rgb[v].b = (uint8_t)(v % 3u * 120u);
    return v;
}

static inline void shape_tri(struct shape *s, uint32_t a, uint32_t b, uint32_t c)
{
    const uint32_t t = s->mesh.n_tris++;
    s->tri[t][0] = (uint16_t)a;
    s->tri[t][1] = (uint16_t)b;
    s->tri[t][2] = (uint16_t)c;
    s->face_rgb[t].r = (uint8_t)(80u + t % 4u * 50u);
    s->face_rgb[t].g = (uint8_t)(255u - t % 9u * 20u);
    s->face_rgb[t].b = (uint8_t)(60u + t % 2u * 150u);
    s->face_raw[t] = (uint16_t)(t + 1u);
}

/* The sphere, from the bounding box's middle. Colours and normals are there for all shaders. */
static inline void shape_end(struct shape *s)
{
    struct zs_mesh *m = &s->mesh;
    int32_t lo[3] = { 32767, 32767, 32767 }, hi[3] = { -32768, -32768, -32768 };
    for (uint32_t v = 0; v < m->n_verts; v++)
        for (int k = 0; k < 3; k++) {
            lo[k] = s->pos[v][k] < lo[k] ? s->pos[v][k] : lo[k];
            hi[k] = s->pos[v][k] > hi[k] ? s->pos[v][k] : hi[k];
        }
    for (int k = 0; k < 3; k++)
        m->center[k] = (int16_t)(m->n_verts ? lo[k] + (hi[k] - lo[k]) / 2 : 0);
    uint64_t most = 0;
    for (uint32_t v = 0; v < m->n_verts; v++) {
        uint64_t square = 0;
        for (int k = 0; k < 3; k++) {
            const int64_t d = s->pos[v][k] - m->center[k];
            square += (uint64_t)(d * d);
        }
        most = square > most ? square : most;
    }
    uint64_t radius = 0;
    for (uint64_t bit = (uint64_t)1 << 16; bit; bit >>= 1)
        if ((radius + bit) * (radius + bit) < most)
            radius += bit;
    m->radius = (uint16_t)(radius + 2u < 65535u ? radius + 2u : 65535u);
    m->pos = (const int16_t (*)[3])s->pos;
    m->tri = (const uint16_t (*)[3])s->tri;
    m->normal = (const zs_q1_15 (*)[3])s->normal;
    m->vertex_rgb = s->vertex_rgb;
    m->face_rgb = s->face_rgb;
    m->face_raw = s->face_raw;
}

static inline void shape_sphere(struct shape *s, uint32_t rings, uint32_t sectors, int32_t radius)
{
    shape_begin(s);
    for (uint32_t y = 0; y <= rings; y++)
        for (uint32_t x = 0; x < sectors; x++) {
            const zs_turn up = (zs_turn)(16384u - y * 32768u / rings);
            const zs_turn round = (zs_turn)(x * 65536u / sectors);
            const int64_t flat = zs_cos(up);
            const int32_t n[3] = { (int32_t)(flat * zs_cos(round) / ZS_Q30_ONE), zs_sin(up),
                                   (int32_t)(-flat * zs_sin(round) / ZS_Q30_ONE) };
            int32_t p[3];
            for (int k = 0; k < 3; k++)
                p[k] = (int32_t)((int64_t)n[k] * radius / ZS_Q30_ONE);
            (void)shape_vertex(s, p, n);
        }
    for (uint32_t y = 0; y < rings; y++)
        for (uint32_t x = 0; x < sectors; x++) {
            const uint32_t next = (x + 1u) % sectors;
            const uint32_t a = y * sectors + x, b = y * sectors + next;
            shape_tri(s, a, a + sectors, b + sectors);
            shape_tri(s, a, b + sectors, b);
        }
    shape_end(s);
}

static inline void shape_torus(struct shape *s, uint32_t rings, uint32_t sectors, int32_t big,
                               int32_t small)
{
    shape_begin(s);
    for (uint32_t y = 0; y < rings; y++)
        for (uint32_t x = 0; x < sectors; x++) {
            const zs_turn a = (zs_turn)(y * 65536u / rings), b = (zs_turn)(x * 65536u / sectors);
            const int64_t out = zs_cos(b);
            const int32_t n[3] = { (int32_t)(out * zs_cos(a) / ZS_Q30_ONE), zs_sin(b),
                                   (int32_t)(-out * zs_sin(a) / ZS_Q30_ONE) };
            const int32_t p[3] = {
                (int32_t)(((int64_t)zs_cos(a) * big + (int64_t)n[0] * small) / ZS_Q30_ONE),
                (int32_t)((int64_t)n[1] * small / ZS_Q30_ONE),
                (int32_t)((-(int64_t)zs_sin(a) * big + (int64_t)n[2] * small) / ZS_Q30_ONE)
            };
            (void)shape_vertex(s, p, n);
        }
    for (uint32_t y = 0; y < rings; y++)
        for (uint32_t x = 0; x < sectors; x++) {
            const uint32_t y1 = (y + 1u) % rings, x1 = (x + 1u) % sectors;
            const uint32_t a = y * sectors + x, b = y1 * sectors + x;
            const uint32_t c = y1 * sectors + x1, d = y * sectors + x1;
            shape_tri(s, a, b, c);
            shape_tri(s, a, c, d);
        }
    shape_end(s);
}

/* End a shape whose vertices are (n + 1) rows of n + 1: n x n cells between them. */
static inline void shape_cells(struct shape *s, uint32_t n)
{
    for (uint32_t z = 0; z < n; z++)
        for (uint32_t x = 0; x < n; x++) {
            const uint32_t a = z * (n + 1u) + x, b = a + n + 1u;
            shape_tri(s, a, b, a + 1u);
            shape_tri(s, a + 1u, b, b + 1u);
        }
    shape_end(s);
}

/* n x n cells over the xz square of half side `half`, bumps of at most `bump`. */
static inline void shape_ground(struct shape *s, uint32_t n, int32_t half, int32_t bump,
                                uint64_t seed)
{
    struct prng p = { seed };
    shape_begin(s);
    for (uint32_t z = 0; z <= n; z++)
        for (uint32_t x = 0; x <= n; x++) {
            const int32_t at[3] = { -half + (int32_t)(2 * (int64_t)half * x / n),
                                    prng_range(&p, -bump, bump),
                                    -half + (int32_t)(2 * (int64_t)half * z / n) };
            const int32_t up[3] = { prng_range(&p, -50, 50), 100, prng_range(&p, -50, 50) };
            (void)shape_vertex(s, at, up);
        }
    shape_cells(s, n);
}

/* n loose triangles in a cube; some twice, some without area, all sizes. */
static inline void shape_soup(struct shape *s, uint32_t n, int32_t half, uint64_t seed)
{
    struct prng p = { seed };
    shape_begin(s);
    while (s->mesh.n_tris < n) {
        int32_t first[3], dir[3];
        const int32_t size = half >> prng_pick(&p, 7);
        for (int k = 0; k < 3; k++)
            first[k] = prng_range(&p, -half, half);
        const uint32_t v = s->mesh.n_verts;
        for (int c = 0; c < 3; c++) {
            int32_t at[3];
            for (int k = 0; k < 3; k++) {
                at[k] = first[k] + prng_range(&p, -size, size);
                at[k] = at[k] < -half ? -half : at[k] > half ? half : at[k];
                dir[k] = prng_range(&p, -100, 100);
            }
            (void)shape_vertex(s, at, dir);
        }
        shape_tri(s, v, v + 1u, v + 2u);
        const uint32_t more = prng_pick(&p, 8);
        if (more == 0 && s->mesh.n_tris < n)
            shape_tri(s, v + 1u, v + 2u, v);
        if (more == 1 && s->mesh.n_tris < n)
            shape_tri(s, v, v + 1u, v);
        if (more == 2 && s->mesh.n_tris < n && v >= 3u)
            shape_tri(s, v - 1u, v, v + 1u);
    }
    shape_end(s);
}

#endif
