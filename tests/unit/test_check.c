/* Checks of data that cannot be trusted: every flaw by its name and place, extremes, and the cone's
 * promise against eyes that are tried out.
 *
 * Every array lies in a block of the heap that is exactly as long as its count says.
 *
 * SPDX-License-Identifier: MIT
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cases.h"
#include "meshes.h"
#include "nodes.h"
#include "picture.h"
#include "zs_check.h"
#include "zstrip.h"

#define ANY_INDEX 0xfeedfaceu /* what index holds before a check */

/* ---- A sound mesh: an octahedron in two clusters --------------------------------------------- */

#define VERTS 6
#define TRIS 8

struct sample { /* writable arrays of a mesh */
    struct zs_mesh mesh;
    int16_t (*pos)[3];
    uint8_t (*pos_lo)[3];
    uint16_t (*tri)[3];
    zs_q1_15 (*normal)[3];
    zs_q1_15 (*face_normal)[3];
    int16_t (*uv)[2];
    struct zs_cluster *cluster;
};

static void *block(const void *from, size_t bytes)
{
    void *p = malloc(bytes ? bytes : 1);
    if (!p)
        abort();
    memcpy(p, from, bytes);
    return p;
}

static struct sample sample_new(void)
{
    static const int16_t pos[VERTS][3] = { { 100, 0, 0 },  { 0, 100, 0 },  { 0, 0, 100 },
                                           { -100, 0, 0 }, { 0, -100, 0 }, { 0, 0, -100 } };
    static const uint8_t pos_lo[VERTS][3] = { { 0 } };
    static const uint16_t tri[TRIS][3] = { { 2, 0, 1 }, { 0, 5, 1 }, { 5, 3, 1 }, { 3, 2, 1 },
                                           { 0, 2, 4 }, { 5, 0, 4 }, { 3, 5, 4 }, { 2, 3, 4 } };
    static const zs_q1_15 normal[VERTS][3] = { { 32767, 0, 0 },      { 0, 32767, 0 },
                                               { 0, 0, 32767 },      { -32768, 0, 0 },
                                               { 0, -23170, 23170 }, { 0, 0, 0 } };
    static const zs_q1_15 face_normal[TRIS][3] = {
        { 18918, 18918, 18918 },   { 18918, 18918, -18918 },  { -18918, 18918, -18918 },
        { -18918, 18918, 18918 },  { 18918, -18918, 18918 },  { 18918, -18918, -18918 },
        { -18918, -18918, -18918 }, { -18918, -18918, 18918 }
    };
    static const int16_t uv[VERTS][2] = { { -32768, 32767 } };
    /* normals lean out by a sine of 0.8165, 103.7 of 127 */
    static const struct zs_cluster cluster[2] = {
        { .first = 0, .n_tris = 4, .radius = 100, .axis = { 0, 127, 0 }, .cutoff = 104 },
        { .first = 4, .n_tris = 4, .radius = 100, .axis = { 0, -127, 0 }, .cutoff = 104 }
    };
    struct sample s;
    memset(&s, 0, sizeof s);
    s.mesh.pos = s.pos = block(pos, sizeof pos);
    s.mesh.pos_lo = s.pos_lo = block(pos_lo, sizeof pos_lo);
    s.mesh.tri = s.tri = block(tri, sizeof tri);
    s.mesh.normal = s.normal = block(normal, sizeof normal);
    s.mesh.face_normal = s.face_normal = block(face_normal, sizeof face_normal);
    s.mesh.uv = s.uv = block(uv, sizeof uv);
    s.mesh.cluster = s.cluster = block(cluster, sizeof cluster);
    s.mesh.n_verts = VERTS;
    s.mesh.n_tris = TRIS;
    s.mesh.n_clusters = 2;
    s.mesh.scale = ZS_Q16_ONE;
    s.mesh.radius = 100;
    s.mesh.uv_bits = 15;
    return s;
}

static void sample_free(struct sample *s)
{
    free(s->pos);
    free(s->pos_lo);
    free(s->tri);
    free(s->normal);
    free(s->face_normal);
    free(s->uv);
    free(s->cluster);
}

/* What the check answers, with and without a place to put the index; index is where it is put. */
#define ANSWER_OF(name, type, check) \
    static enum zs_flaw name(const struct type *of, uint32_t *index) \
    { \
        *index = ANY_INDEX; \
        const enum zs_flaw flaw = check(of, index); \
        assert_int_equal(check(of, NULL), flaw); \
        assert_true(*index != ANY_INDEX); \
        return flaw; \
    }
ANSWER_OF(flaw_of, zs_mesh, zs_mesh_check)
ANSWER_OF(texture_flaw, zs_texture, zs_texture_check)

#define ANSWERS(answer, of, flaw, at) \
    do { \
        uint32_t index_; \
        assert_int_equal(answer(of, &index_), flaw); \
        assert_int_equal(index_, at); \
    } while (0)
#define HAS(m, flaw, at) ANSWERS(flaw_of, m, flaw, at)
#define TEXTURE_HAS(x, flaw, at) ANSWERS(texture_flaw, x, flaw, at)

/* The sound mesh after a change has exactly this flaw. */
#define CHANGED(change, flaw, at) \
    do { \
        struct sample s = sample_new(); \
        change; \
        HAS(&s.mesh, flaw, at); \
        sample_free(&s); \
    } while (0)

static void a_sound_mesh_passes(void **state)
{
    CHANGED((void)0, ZS_FLAW_NONE, 0);
    /* what may be missing */
    CHANGED(s.mesh.pos_lo = NULL; s.mesh.normal = NULL; s.mesh.face_normal = NULL, ZS_FLAW_NONE, 0);
    CHANGED(s.mesh.cluster = NULL; s.mesh.n_clusters = 0, ZS_FLAW_NONE, 0);
    CHANGED(s.mesh.uv = NULL; s.mesh.uv_bits = 255, ZS_FLAW_NONE, 0); /* read by nobody */
    const struct zs_mesh empty = { .scale = 1 };
    HAS(&empty, ZS_FLAW_NONE, 0);
    const struct zs_mesh points = { .scale = 1, .n_verts = 1, .pos = (const int16_t[1][3]){ { 0 } } };
    HAS(&points, ZS_FLAW_NONE, 0);
}

static void every_mesh_of_the_scenes_passes(void **state)
{
    static const struct zs_mesh *const meshes[] = {
        &mesh_teapot, &mesh_tea, &mesh_table, &mesh_cube, &mesh_knot, &mesh_terrain, &mesh_city,
        &mesh_car, &mesh_bumpy, &mesh_layer, &mesh_sheet, &mesh_corridor, &mesh_slivers,
        &mesh_relief
    };
    for (size_t i = 0; i < sizeof meshes / sizeof meshes[0]; i++) {
        uint32_t at;
        const enum zs_flaw flaw = flaw_of(meshes[i], &at);
        if (flaw)
            print_error("mesh %zu: %s, %u\n", i, zs_flaw_string(flaw), at);
        assert_int_equal(flaw, ZS_FLAW_NONE);
    }
}

/* ---- Each flaw of a mesh ------------------------------------------------------------------------ */

static void what_is_missing(void **state)
{
    HAS(NULL, ZS_FLAW_NULL, 0);
    CHANGED(s.mesh.pos = NULL, ZS_FLAW_NULL, 0);
    CHANGED(s.mesh.tri = NULL, ZS_FLAW_NULL, 0);
    CHANGED(s.mesh.cluster = NULL, ZS_FLAW_NULL, 0);
}

static void what_is_not_aligned(void **state)
{
#define ODD(field) \
    CHANGED(s.mesh.field = (const void *)((const uint8_t *)s.mesh.field + 1), ZS_FLAW_ALIGN, 0)
    ODD(pos);
    ODD(tri);
    ODD(normal);
    ODD(face_normal);
    ODD(uv);
    ODD(cluster);
    CHANGED(s.mesh.cluster = (const void *)((const uint8_t *)s.cluster + 2), ZS_FLAW_ALIGN, 0);
    CHANGED(s.mesh.face_raw = (const void *)((const uint8_t *)s.tri + 1), ZS_FLAW_ALIGN, 0);
#undef ODD
    CHANGED(s.mesh.pos_lo++; s.mesh.n_verts = 1; s.mesh.n_tris = s.mesh.n_clusters = 0, ZS_FLAW_NONE,
            0); /* bytes lie anywhere */
}

static void counts_and_scale(void **state)
{
    CHANGED(s.mesh.n_verts = 65536, ZS_FLAW_COUNT, 65536); /* nothing is read then */
    CHANGED(s.mesh.n_verts = UINT32_MAX, ZS_FLAW_COUNT, UINT32_MAX);
    CHANGED(s.mesh.scale = 0, ZS_FLAW_NONE, 0); /* one world unit a step */
    CHANGED(s.mesh.scale = UINT32_MAX, ZS_FLAW_NONE, 0);
    CHANGED(s.mesh.uv_bits = 16, ZS_FLAW_UV_BITS, 16);
    CHANGED(s.mesh.uv_bits = 255, ZS_FLAW_UV_BITS, 255);
}

static void indices(void **state)
{
    for (int t = 0; t < TRIS; t++)
        for (int k = 0; k < 3; k++) {
            CHANGED(s.tri[t][k] = VERTS, ZS_FLAW_INDEX, t);
            CHANGED(s.tri[t][k] = 65535, ZS_FLAW_INDEX, t);
        }
    CHANGED(s.tri[5][0] = VERTS; s.tri[3][2] = 999, ZS_FLAW_INDEX, 3); /* the first */
    CHANGED(s.mesh.n_verts = 0, ZS_FLAW_INDEX, 0);
    CHANGED(s.mesh.n_verts = 0; s.mesh.pos = NULL, ZS_FLAW_INDEX, 0);
}

static void the_sphere_is_exact(void **state)
{
    for (int v = 0; v < VERTS; v++)
        CHANGED(s.pos[v][v % 3] = (int16_t)(s.pos[v][v % 3] * 101 / 100);
                s.mesh.cluster = NULL; s.mesh.n_clusters = 0, ZS_FLAW_SPHERE, v);
    CHANGED(s.mesh.radius = 99, ZS_FLAW_SPHERE, 0);
    CHANGED(s.mesh.center[1] = 1; s.mesh.radius = 101, ZS_FLAW_NONE, 0);
    CHANGED(s.mesh.center[1] = 1, ZS_FLAW_SPHERE, 0); /* 100.005 away */
    /* 1/256 step beyond it, and on it: 60 80 0 and 28 96 0 are 100 long */
    CHANGED(s.pos_lo[0][0] = 1, ZS_FLAW_SPHERE, 0);
    CHANGED(s.pos_lo[0][1] = 1, ZS_FLAW_SPHERE, 0);
    CHANGED(s.pos_lo[3][0] = 1, ZS_FLAW_NONE, 0); /* -100 + 1/256 */
    CHANGED(s.pos[2][0] = 60; s.pos[2][1] = 80; s.pos[2][2] = 0;
            s.mesh.cluster = NULL; s.mesh.n_clusters = 0, ZS_FLAW_NONE, 0);
    CHANGED(s.pos[2][0] = 60; s.pos[2][1] = 80; s.pos[2][2] = 0; s.pos_lo[2][2] = 1;
            s.mesh.cluster = NULL; s.mesh.n_clusters = 0, ZS_FLAW_SPHERE, 2);
    /* no vertex of a triangle, but the sphere is around all */
    CHANGED(s.tri[0][0] = s.tri[3][1] = s.tri[4][1] = s.tri[7][0] = 0; s.pos[2][2] = 101;
            s.mesh.cluster = NULL; s.mesh.n_clusters = 0, ZS_FLAW_SPHERE, 2);
}

static void normals_have_length_one_or_none(void **state)
{
    for (int v = 0; v < VERTS; v++) {
        CHANGED(s.normal[v][0] = s.normal[v][1] = s.normal[v][2] = 0, ZS_FLAW_NONE, 0);
        CHANGED(s.normal[v][0] = s.normal[v][1] = s.normal[v][2] = 20000, ZS_FLAW_NORMAL, v);
        CHANGED(s.normal[v][0] = s.normal[v][1] = s.normal[v][2] = -32768, ZS_FLAW_NORMAL, v);
        CHANGED(s.normal[v][0] = s.normal[v][1] = 0; s.normal[v][2] = 1, ZS_FLAW_NORMAL, v);
    }
    for (int t = 0; t < TRIS; t++) {
        CHANGED(s.face_normal[t][1] = 0, ZS_FLAW_FACE_NORMAL, t);
        CHANGED(memset(s.face_normal[t], 0, 6), ZS_FLAW_NONE, 0);
    }
    /* 0.98 * 32767 = 32111.7, 1.02 * 32767 = 33422.3 */
    CHANGED(s.normal[0][0] = 32112, ZS_FLAW_NONE, 0);
    CHANGED(s.normal[0][0] = -32111, ZS_FLAW_NORMAL, 0);
    CHANGED(s.normal[0][0] = 32767; s.normal[0][2] = 6585, ZS_FLAW_NONE, 0);    /* 33422.15 */
    CHANGED(s.normal[0][0] = 32767; s.normal[0][2] = 6587, ZS_FLAW_NORMAL, 0);  /* 33422.54 */
}

static void clusters_hold_all_in_order(void **state)
{
    CHANGED(s.cluster[0].n_tris = 0, ZS_FLAW_CLUSTERS, 0);
    CHANGED(s.cluster[1].n_tris = 0, ZS_FLAW_CLUSTERS, 1);
    CHANGED(s.cluster[0].first = 1, ZS_FLAW_CLUSTERS, 0);
    CHANGED(s.cluster[1].first = 3, ZS_FLAW_CLUSTERS, 1);
    CHANGED(s.cluster[1].first = 5, ZS_FLAW_CLUSTERS, 1);
    CHANGED(s.cluster[1].first = UINT32_MAX - 1, ZS_FLAW_CLUSTERS, 1);
    CHANGED(s.cluster[1].n_tris = 5, ZS_FLAW_CLUSTERS, 1);
    CHANGED(s.cluster[1].n_tris = 65535, ZS_FLAW_CLUSTERS, 1);
    CHANGED(s.cluster[1].n_tris = 3, ZS_FLAW_CLUSTERS, 2); /* one is left over */
    CHANGED(s.mesh.n_clusters = 1, ZS_FLAW_CLUSTERS, 1);
    CHANGED(s.mesh.n_clusters = 0, ZS_FLAW_CLUSTERS, 0);
    CHANGED(s.mesh.n_tris = 7, ZS_FLAW_CLUSTERS, 1);
    CHANGED(s.mesh.n_tris = 4, ZS_FLAW_CLUSTERS, 1);
    CHANGED(s.mesh.n_tris = 0, ZS_FLAW_CLUSTERS, 0);
    CHANGED(s.mesh.n_tris = 0; s.mesh.n_clusters = 0, ZS_FLAW_NONE, 0);
}

static void clusters_lie_in_their_spheres(void **state)
{
    for (int c = 0; c < 2; c++) {
        CHANGED(s.cluster[c].radius = 99, ZS_FLAW_CLUSTER_SPHERE, c);
        CHANGED(s.cluster[c].center[2] = -1, ZS_FLAW_CLUSTER_SPHERE, c);
        CHANGED(s.cluster[c].radius = 65535, ZS_FLAW_NONE, 0);
    }
    CHANGED(s.pos_lo[4][0] = 1; s.mesh.radius = 101, ZS_FLAW_CLUSTER_SPHERE, 1);
    CHANGED(s.pos_lo[1][0] = 1; s.mesh.radius = 101, ZS_FLAW_CLUSTER_SPHERE, 0);
    /* the last triangle of a cluster, and each of its corners */
    for (uint16_t k = 0; k < 3; k++)
        CHANGED(s.tri[3][0] = s.tri[3][1] = s.tri[3][2] = 1; s.tri[3][k] = 4; s.cluster[0].cutoff = 127;
                s.cluster[0].center[1] = 50; s.cluster[0].radius = 112, ZS_FLAW_CLUSTER_SPHERE, 0);
}

static void cones_hold_their_triangles(void **state)
{
    for (int c = 0; c < 2; c++) {
        CHANGED(s.cluster[c].cutoff = 103, ZS_FLAW_CLUSTER_CONE, c);
        CHANGED(s.cluster[c].cutoff = 105, ZS_FLAW_NONE, 0);
        CHANGED(s.cluster[c].cutoff = 126, ZS_FLAW_NONE, 0);
        CHANGED(s.cluster[c].cutoff = 0, ZS_FLAW_CLUSTER_CONE, c);
        CHANGED(s.cluster[c].cutoff = -1, ZS_FLAW_CLUSTER_CONE, c);
        CHANGED(s.cluster[c].cutoff = -128, ZS_FLAW_CLUSTER_CONE, c);
        CHANGED(s.cluster[c].axis[1] = (int8_t)-s.cluster[c].axis[1], ZS_FLAW_CLUSTER_CONE, c);
        CHANGED(s.cluster[c].axis[1] = (int8_t)-s.cluster[c].axis[1]; s.cluster[c].cutoff = 126,
                ZS_FLAW_CLUSTER_CONE, c);
        CHANGED(s.cluster[c].axis[0] = 20, ZS_FLAW_CLUSTER_CONE, c);
        CHANGED(s.cluster[c].axis[0] = 20; s.cluster[c].cutoff = 127, ZS_FLAW_NONE, 0);
        CHANGED(s.cluster[c].axis[0] = 15; s.cluster[c].cutoff = 126, ZS_FLAW_NONE, 0); /* 127.9 long */
        CHANGED(s.cluster[c].axis[0] = 17; s.cluster[c].cutoff = 126, ZS_FLAW_CLUSTER_CONE, c);
        CHANGED(memset(s.cluster[c].axis, 0, 3), ZS_FLAW_NONE, 0); /* for no eye */
        CHANGED(memset(s.cluster[c].axis, -128, 3), ZS_FLAW_CLUSTER_CONE, c);
        CHANGED(memset(s.cluster[c].axis, -128, 3); s.cluster[c].cutoff = 127, ZS_FLAW_NONE, 0);
    }
    /* each triangle turned round */
    for (int t = 0; t < TRIS; t++)
        CHANGED(const uint16_t v = s.tri[t][0]; s.tri[t][0] = s.tri[t][1]; s.tri[t][1] = v,
                ZS_FLAW_CLUSTER_CONE, t / 4);
    /* one without area fits everywhere */
    CHANGED(s.tri[2][0] = s.tri[2][1]; s.tri[6][0] = s.tri[6][2], ZS_FLAW_NONE, 0);
}

/* A flat cluster keeps its promise with cutoff 0 only where the axis is exactly its normal, and, the axis
 * being longer than 1, where it does not touch the far end of the sphere. */
static void flat_clusters(void **state)
{
    int16_t pos[3][3] = { { 0, 0, 7 }, { 10, 0, 7 }, { 0, 10, 7 } };
    const uint16_t tri[1][3] = { { 0, 1, 2 } };
    struct zs_cluster c = { .first = 0, .n_tris = 1, .radius = 13, .axis = { 0, 0, 127 } };
    const struct zs_mesh m = { .pos = (const int16_t (*)[3])pos, .tri = tri, .n_verts = 3, .n_tris = 1,
                               .scale = 1, .radius = 40000, .cluster = &c, .n_clusters = 1 };
    HAS(&m, ZS_FLAW_NONE, 0);
    c.axis[2] = 1; /* a short axis: for fewer eyes */
    HAS(&m, ZS_FLAW_NONE, 0);
    c.axis[2] = -1;
    HAS(&m, ZS_FLAW_CLUSTER_CONE, 0);
    c.axis[0] = 1;
    HAS(&m, ZS_FLAW_CLUSTER_CONE, 0);
    c.axis[0] = 0;
    c.axis[2] = -128;
    HAS(&m, ZS_FLAW_CLUSTER_CONE, 0);
    for (int v = 0; v < 3; v++)
        pos[v][2] = -20000;
    c.radius = 20001;
    c.axis[2] = 127;
    HAS(&m, ZS_FLAW_NONE, 0);
    /* 128 / 127 long: it counts eyes from d = 0.9922 * 20001 = 19844.7 on, the plane is 20000 behind */
    c.axis[2] = -128;
    const int16_t first = pos[1][0];
    pos[1][0] = pos[2][0]; /* turn it round: now it looks along -z, away from the centre it is before */
    pos[1][1] = pos[2][1];
    pos[2][0] = first;
    pos[2][1] = 0;
    HAS(&m, ZS_FLAW_NONE, 0);
    for (int v = 0; v < 3; v++)
        pos[v][2] = 20000;
    HAS(&m, ZS_FLAW_CLUSTER_CONE, 0);
    for (int v = 0; v < 3; v++)
        pos[v][2] = 19844; /* nearer than the nearest eye */
    HAS(&m, ZS_FLAW_NONE, 0);
    for (int v = 0; v < 3; v++)
        pos[v][2] = 19845;
    HAS(&m, ZS_FLAW_CLUSTER_CONE, 0);
}

/* ---- The cone's promise, tried out ------------------------------------------------------------- */

struct cone_case {
    struct zs_mesh mesh;
    struct zs_cluster cluster;
    int16_t pos[24][3];
    uint8_t pos_lo[24][3];
    uint16_t tri[8][3];
};

/* Corner in 1/256 step. */
static void corner(const struct cone_case *c, uint32_t t, int k, int64_t out[3])
{
    const uint32_t v = c->tri[t][k];
    for (int i = 0; i < 3; i++)
        out[i] = c->pos[v][i] * 256 + (c->mesh.pos_lo ? c->pos_lo[v][i] : 0);
}

static void normal_of(const struct cone_case *c, uint32_t t, int64_t n[3])
{
    int64_t p[3][3];
    for (int k = 0; k < 3; k++)
        corner(c, t, k, p[k]);
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        n[k] = (p[1][i] - p[0][i]) * (p[2][j] - p[0][j]) - (p[1][j] - p[0][j]) * (p[2][i] - p[0][i]);
    }
}

/* A few triangles that lean about a common direction, by small or large angles, in a sphere; the axis and
 * the cutoff as a maker would round them. Returns |axis| * the sine of the widest angle, unrounded. */
static double cone_make(struct cone_case *c, struct prng *p)
{
    memset(c, 0, sizeof *c);
    const int32_t size = 1 << prng_range(p, 2, 14), thick = size >> prng_pick(p, 12);
    const int axis = (int)prng_pick(p, 3);
    const uint32_t n = 1u + prng_pick(p, 8);
    int32_t shear[3];
    for (int k = 0; k < 3; k++)
        shear[k] = prng_range(p, -4, 4);
    double sum[3] = { 0 };
    for (uint32_t t = 0; t < n; t++) {
        for (int k = 0; k < 3; k++) {
            const uint32_t v = 3 * t + (uint32_t)k;
            for (int i = 0; i < 3; i++) {
                c->pos[v][i] = (int16_t)(i == axis ? prng_range(p, -thick, thick)
                                                   : prng_range(p, -size, size));
                c->pos_lo[v][i] = (uint8_t)prng_next(p);
            }
            c->pos[v][axis] = (int16_t)(c->pos[v][axis] / 2 +
                                        c->pos[v][(axis + 1) % 3] * shear[axis] / 8);
            c->tri[t][k] = (uint16_t)v;
        }
        int64_t normal[3];
        normal_of(c, t, normal);
        if (normal[axis] < 0 && prng_pick(p, 50)) {
            c->tri[t][1] = (uint16_t)(3 * t + 2);
            c->tri[t][2] = (uint16_t)(3 * t + 1);
            normal_of(c, t, normal);
        }
        const double length = sqrt((double)normal[0] * (double)normal[0] + (double)normal[1] *
                                   (double)normal[1] + (double)normal[2] * (double)normal[2]);
        for (int i = 0; i < 3 && length > 0; i++)
            sum[i] += (double)normal[i] / length;
    }
    c->mesh.pos = (const int16_t (*)[3])c->pos;
    c->mesh.tri = (const uint16_t (*)[3])c->tri;
    if (prng_pick(p, 2))
        c->mesh.pos_lo = (const uint8_t (*)[3])c->pos_lo;
    c->mesh.n_verts = 3 * n;
    c->mesh.n_tris = n;
    c->mesh.scale = 1;
    c->mesh.radius = 65535;
    c->mesh.cluster = &c->cluster;
    c->mesh.n_clusters = 1;
    c->cluster.n_tris = (uint16_t)n;
    double most = 0;
    for (uint32_t v = 0; v < 3 * n; v++) {
        double square = 0;
        for (int i = 0; i < 3; i++)
            square += pow(c->pos[v][i] + (c->mesh.pos_lo ? c->pos_lo[v][i] / 256.0 : 0), 2);
        most = fmax(most, square);
    }
    c->cluster.radius = (uint16_t)ceil(sqrt(most) * (1 + 1e-12));
    const double length = sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
    for (int i = 0; i < 3; i++)
        c->cluster.axis[i] = (int8_t)lround(length > 0 ? 127 * sum[i] / length : 0);
    const int8_t *a = c->cluster.axis;
    const double a_length = sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
    double sine = 0;
    for (uint32_t t = 0; t < n; t++) {
        int64_t normal[3];
        normal_of(c, t, normal);
        const double nn[3] = { (double)normal[0], (double)normal[1], (double)normal[2] };
        const double nl = sqrt(nn[0] * nn[0] + nn[1] * nn[1] + nn[2] * nn[2]);
        if (nl == 0)
            continue;
        const double cross[3] = { nn[1] * a[2] - nn[2] * a[1], nn[2] * a[0] - nn[0] * a[2],
                                  nn[0] * a[1] - nn[1] * a[0] };
        const double s = sqrt(cross[0] * cross[0] + cross[1] * cross[1] + cross[2] * cross[2]) / nl;
        sine = fmax(sine, nn[0] * a[0] + nn[1] * a[1] + nn[2] * a[2] < 0 ? 999 : s);
    }
    c->cluster.cutoff = (int8_t)(sine > 126 || a_length == 0 ? 127 : ceil(sine));
    return sine;
}

/* 1: some front is seen from the eye d before the centre (1/256 step), exactly. */
static int front_seen(const struct cone_case *c, const int64_t d[3])
{
    for (uint32_t t = 0; t < c->mesh.n_tris; t++) {
        int64_t n[3], p[3];
        normal_of(c, t, n);
        corner(c, t, 0, p);
        __int128 side = 0;
        for (int k = 0; k < 3; k++)
            side += (__int128)n[k] * (d[k] + p[k] - c->cluster.center[k] * 256);
        if (side < 0)
            return 1;
    }
    return 0;
}

/* 1: the header promises that nothing is seen from there, with 1e-9 to spare. */
static int promised(const struct zs_cluster *c, const int64_t d[3])
{
    long double at = 0, square = 0;
    for (int k = 0; k < 3; k++) {
        at += (long double)d[k] * c->axis[k];
        square += (long double)d[k] * (long double)d[k];
    }
    return at >= (c->cutoff * sqrtl(square) + 127 * 256.0L * c->radius) * (1 + 1e-9L) + 1e-6L;
}

/* Eyes on the border of what is promised, from the sphere out to far away, and some inside. */
static int seen_where_promised(const struct cone_case *c, struct prng *p, int tries, uint32_t *used)
{
    const int8_t *a = c->cluster.axis;
    for (int n = 0; n < tries; n++) {
        int64_t d[3];
        if (n % 8 == 7) {
            for (int k = 0; k < 3; k++)
                d[k] = prng_range(p, -(1 << 26), 1 << 26) >> prng_pick(p, 16);
        } else { /* a direction that makes the border's angle with the axis, as far as needed and beyond */
            const double aa = a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
            double side[3], along = 0, ss = 0;
            for (int k = 0; k < 3; k++) {
                side[k] = prng_range(p, -1000, 1000);
                along += side[k] * a[k];
            }
            for (int k = 0; k < 3; k++) {
                side[k] -= along / (aa > 0 ? aa : 1) * a[k];
                ss += side[k] * side[k];
            }
            const double cosine = fmin(1, c->cluster.cutoff / sqrt(aa) * (1 + pow(2, -prng_range(p, 1, 30))) +
                                              pow(2, -prng_range(p, 1, 30)));
            const double sine = sqrt(1 - cosine * cosine);
            const double least = 127 * 256.0 * c->cluster.radius /
                                 fmax(cosine * sqrt(aa) - c->cluster.cutoff, 1e-12);
            const double far = fmin(4e12, least * (1 + pow(2, prng_range(p, -24, 6))) + 2);
            for (int k = 0; k < 3; k++)
                d[k] = (int64_t)(far * (cosine * a[k] / sqrt(aa > 0 ? aa : 1) +
                                        sine * side[k] / sqrt(ss > 0 ? ss : 1)));
        }
        if (!promised(&c->cluster, d))
            continue;
        (*used)++;
        if (front_seen(c, d))
            return 1;
    }
    return 0;
}

static uint32_t cones_held, cones_refused, eyes_tried;

static int cone_case(uint64_t seed)
{
    struct prng p = { seed };
    static struct cone_case c;
    const double sine = cone_make(&c, &p);
    uint32_t at;
    enum zs_flaw flaw = zs_mesh_check(&c.mesh, &at);
    if (flaw) /* what is made by the rule that check.c names must pass */
        return case_wrong("%s, cutoff %d for %.9g", zs_flaw_string(flaw), c.cluster.cutoff, sine);
    if (seed % 2) { /* now anything near it */
        c.cluster.cutoff = (int8_t)prng_range(&p, c.cluster.cutoff - 3, c.cluster.cutoff + 1);
        c.cluster.axis[prng_pick(&p, 3)] += (int8_t)prng_range(&p, -1, 1);
        if (c.cluster.cutoff == -128)
            c.cluster.cutoff = 127;
    }
    flaw = zs_mesh_check(&c.mesh, &at);
    CASE_CHECK(flaw == ZS_FLAW_NONE || flaw == ZS_FLAW_CLUSTER_CONE);
    if (flaw) {
        cones_refused++;
        return 1;
    }
    cones_held += c.cluster.cutoff < 127;
    if (c.cluster.cutoff < 127 && seen_where_promised(&c, &p, 200, &eyes_tried))
        return case_wrong("a front is seen: axis %d %d %d, cutoff %d", c.cluster.axis[0],
                          c.cluster.axis[1], c.cluster.axis[2], c.cluster.cutoff);
    return 1;
}

/* The other way: where the check refuses a cutoff that is one too small, there is an eye. */
static uint32_t broken_shown;

static int broken_case(uint64_t seed)
{
    struct prng p = { seed };
    static struct cone_case c;
    const double sine = cone_make(&c, &p);
    uint32_t at, used = 0;
    if (c.cluster.cutoff < 2 || c.cluster.cutoff == 127 || c.cluster.radius == 0)
        return 1;
    c.cluster.cutoff = (int8_t)(c.cluster.cutoff - 1);
    CASE_CHECK(zs_mesh_check(&c.mesh, &at) == ZS_FLAW_CLUSTER_CONE && at == 0);
    if (sine - c.cluster.cutoff < 0.2)
        return 1; /* eyes that show it are few */
    broken_shown += (uint32_t)seen_where_promised(&c, &p, 3000, &used);
    return 1;
}

/* ---- Extremes ------------------------------------------------------------------------------------- */

/* Any content at all: the sanitizers watch. */
static int noise_case(uint64_t seed)
{
    struct prng p = { seed };
    const uint32_t n_verts = 1u + prng_pick(&p, 8), n_tris = prng_pick(&p, 10);
    struct sample s = sample_new();
    struct zs_mesh m = { .n_verts = n_verts, .n_tris = n_tris, .n_clusters = 1 };
    void *arrays[8];
    const size_t bytes[8] = { n_verts * 6, n_verts * 3, n_tris * 6, n_verts * 6, n_tris * 6,
                              n_verts * 4, sizeof(struct zs_cluster), n_tris * 2 };
    const int extreme = (int)prng_pick(&p, 2);
    for (int i = 0; i < 8; i++) {
        uint8_t *a = malloc(bytes[i] ? bytes[i] : 1);
        for (size_t b = 0; b < bytes[i]; b++)
            a[b] = (uint8_t)prng_next(&p);
        for (size_t b = 0; extreme && b + 1 < bytes[i]; b += 2) {
            static const int16_t ends[] = { -32768, 32767, -1, 0, 255, -32767 };
            memcpy(a + b, &ends[prng_pick(&p, 6)], 2);
        }
        arrays[i] = a;
    }
    uint16_t *tri = arrays[2];
    for (uint32_t i = 0; i < 3 * n_tris; i++)
        tri[i] = (uint16_t)prng_pick(&p, n_verts);
    struct zs_cluster *c = arrays[6];
    c->first = 0;
    c->n_tris = (uint16_t)n_tris;
    m.pos = arrays[0];
    m.pos_lo = prng_pick(&p, 2) ? arrays[1] : NULL;
    m.tri = arrays[2];
    m.normal = prng_pick(&p, 4) ? NULL : arrays[3];
    m.face_normal = prng_pick(&p, 4) ? NULL : arrays[4];
    m.uv = arrays[5];
    m.cluster = prng_pick(&p, 8) ? arrays[6] : NULL;
    m.face_raw = arrays[7];
    m.scale = (uint32_t)prng_next(&p) | 1u;
    m.radius = 65535;
    for (int k = 0; k < 3; k++)
        m.center[k] = (int16_t)prng_next(&p);
    if (prng_pick(&p, 2)) { /* let it through to the clusters */
        memset(m.center, 0, sizeof m.center);
        memset(c->center, 0, sizeof c->center);
        c->radius = 65535;
        m.normal = m.face_normal = NULL;
    }
    uint32_t at;
    (void)flaw_of(&m, &at);
    for (int i = 0; i < 8; i++)
        free(arrays[i]);
    sample_free(&s);
    return 1;
}

/* The largest numbers that the sums can meet. */
static void the_largest_sums(void **state)
{
    const int16_t pos[4][3] = { { -32768, -32768, -32768 }, { 32767, 32767, -32768 },
                                { 32767, -32768, 32767 }, { -32768, 32767, 32767 } };
    const uint8_t lo[4][3] = { { 0 }, { 255, 255, 0 }, { 255, 0, 255 }, { 0, 255, 255 } };
    const uint16_t tri[2][3] = { { 0, 1, 2 }, { 1, 3, 2 } };
    struct zs_cluster c = { .first = 0, .n_tris = 2, .radius = 65535, .axis = { 0, 0, 127 }, .cutoff = 126 };
    struct zs_mesh m = { .pos = pos, .pos_lo = lo, .tri = tri, .n_verts = 4, .n_tris = 2, .scale = 1,
                         .radius = 65535, .cluster = &c, .n_clusters = 1 };
    for (int n = 0; n < 27; n++)
        for (int cutoff = -128; cutoff <= 127; cutoff++) {
            static const int8_t ends[] = { -128, 0, 127 };
            for (int k = 0; k < 3; k++)
                c.axis[k] = ends[n / (k == 0 ? 1 : k == 1 ? 3 : 9) % 3];
            c.cutoff = (int8_t)cutoff;
            uint32_t at;
            const enum zs_flaw flaw = flaw_of(&m, &at);
            assert_true(flaw == ZS_FLAW_NONE || flaw == ZS_FLAW_CLUSTER_CONE);
            if (cutoff == 127)
                assert_int_equal(flaw, ZS_FLAW_NONE);
            if (cutoff < 0)
                assert_int_equal(flaw, ZS_FLAW_CLUSTER_CONE);
        }
    /* the farthest corners, and a radius that is one too small: sqrt(3) * 32768 = 56755.8 */
    m.cluster = NULL;
    m.n_clusters = 0;
    m.radius = 56756;
    HAS(&m, ZS_FLAW_NONE, 0);
    m.radius = 56755;
    HAS(&m, ZS_FLAW_SPHERE, 0);
    m.center[0] = m.center[1] = m.center[2] = 32767;
    m.radius = 65535; /* the first corner is 113,508 away */
    HAS(&m, ZS_FLAW_SPHERE, 0);
}

static void the_largest_counts(void **state)
{
    const uint32_t n_verts = 65535, n_tris = 200000;
    int16_t (*pos)[3] = calloc(n_verts, sizeof *pos);
    uint16_t (*tri)[3] = calloc(n_tris, sizeof *tri);
    struct zs_mesh m = { .pos = (const int16_t (*)[3])pos, .tri = (const uint16_t (*)[3])tri,
                         .n_verts = n_verts, .n_tris = n_tris, .scale = 1 };
    HAS(&m, ZS_FLAW_NONE, 0);
    tri[n_tris - 1][2] = 65534;
    HAS(&m, ZS_FLAW_NONE, 0);
    pos[65534][2] = 1;
    HAS(&m, ZS_FLAW_SPHERE, 65534);
    tri[n_tris - 1][2] = 65535;
    HAS(&m, ZS_FLAW_INDEX, n_tris - 1);
    /* clusters of 65535 triangles */
    tri[n_tris - 1][2] = 0;
    pos[65534][2] = 0;
    struct zs_cluster c[4];
    memset(c, 0, sizeof c);
    for (uint32_t i = 0; i < 4; i++) {
        c[i].first = 65535 * i;
        c[i].n_tris = (uint16_t)(i < 3 ? 65535 : n_tris - 3 * 65535);
    }
    m.cluster = c;
    m.n_clusters = 4;
    HAS(&m, ZS_FLAW_NONE, 0);
    c[3].n_tris++;
    HAS(&m, ZS_FLAW_CLUSTERS, 3);
    m.n_clusters = 3;
    HAS(&m, ZS_FLAW_CLUSTERS, 3);
    free(pos);
    free(tri);
}

/* ---- Textures -------------------------------------------------------------------------------------- */

static void sound_textures_pass(void **state)
{
    static const struct zs_texel *const formats[] = { &zs_texel_565, &zs_texel_pal8, &zs_texel_pal4 };
    static const uint32_t bits[] = { 16, 8, 4 };
    for (uint8_t w = 0; w <= ZS_TEXTURE_LOG2_MAX; w++)
        for (uint8_t h = 0; h <= ZS_TEXTURE_LOG2_MAX; h++)
            for (int f = w ? 0 : 1; f < 3; f++) {
                const size_t bytes = ((size_t)bits[f % 3] << (w + h)) / 8;
                struct zs_texture x = { .format = formats[f], .texel = calloc(bytes ? bytes : 1, 1),
                                        .log2_w = w, .log2_h = h, .clamp = (uint8_t)(w & 3) };
                const uint16_t palette[1] = { 7 };
                if (f) {
                    x.palette = palette;
                    x.n_colors = 1;
                }
                if (f == 2 && w == 0)
                    TEXTURE_HAS(&x, ZS_FLAW_SIZE, 0);
                else
                    TEXTURE_HAS(&x, ZS_FLAW_NONE, 0);
                free((void *)(uintptr_t)x.texel);
            }
}

static void each_flaw_of_a_texture(void **state)
{
    uint16_t plain[16] = { 0xffff };
    uint8_t pal8[16] = { 4, 0, 4 }, pal4[8] = { 0x44, 0x04, 0x40 };
    const uint16_t palette[256] = { 0 };
    const struct zs_texture all[3] = {
        { .format = &zs_texel_565, .texel = plain, .log2_w = 2, .log2_h = 2 },
        { .format = &zs_texel_pal8, .texel = pal8, .palette = palette, .n_colors = 5, .log2_w = 3,
          .log2_h = 1, .clamp = ZS_CLAMP_U },
        { .format = &zs_texel_pal4, .texel = pal4, .palette = palette, .n_colors = 5, .log2_w = 1,
          .log2_h = 3, .clamp = ZS_CLAMP_U | ZS_CLAMP_V }
    };
    TEXTURE_HAS(NULL, ZS_FLAW_NULL, 0);
    for (int i = 0; i < 3; i++) {
#define CHANGED_TEXTURE(change, flaw, at) \
    do { \
        struct zs_texture x = all[i]; \
        change; \
        TEXTURE_HAS(&x, flaw, at); \
    } while (0)
        CHANGED_TEXTURE((void)0, ZS_FLAW_NONE, 0);
        CHANGED_TEXTURE(x.format = NULL, ZS_FLAW_NULL, 0);
        CHANGED_TEXTURE(x.format = (const void *)plain, ZS_FLAW_NULL, 0);
        CHANGED_TEXTURE(x.texel = NULL, ZS_FLAW_NULL, 0);
        CHANGED_TEXTURE(x.palette = NULL, i ? ZS_FLAW_NULL : ZS_FLAW_NONE, 0);
        CHANGED_TEXTURE(x.palette = (const void *)(pal8 + 1), i ? ZS_FLAW_ALIGN : ZS_FLAW_NONE, 0);
        CHANGED_TEXTURE(x.log2_w = 11, ZS_FLAW_SIZE, 11);
        CHANGED_TEXTURE(x.log2_h = 11, ZS_FLAW_SIZE, 11);
        CHANGED_TEXTURE(x.log2_h = 255; x.log2_w = 0, ZS_FLAW_SIZE, i == 2 ? 0 : 255);
        CHANGED_TEXTURE(x.clamp = 4, ZS_FLAW_CLAMP, 4);
        CHANGED_TEXTURE(x.clamp = 255, ZS_FLAW_CLAMP, 255);
        CHANGED_TEXTURE(x.n_colors = 0, i ? ZS_FLAW_COLORS : ZS_FLAW_NONE, 0);
        CHANGED_TEXTURE(x.n_colors = 65535, i ? ZS_FLAW_COLORS : ZS_FLAW_NONE, i ? 65535 : 0);
        CHANGED_TEXTURE(x.n_colors = 257, i ? ZS_FLAW_COLORS : ZS_FLAW_NONE, i ? 257 : 0);
        CHANGED_TEXTURE(x.n_colors = 17, i == 2 ? ZS_FLAW_COLORS : ZS_FLAW_NONE, i == 2 ? 17 : 0);
        CHANGED_TEXTURE(x.n_colors = 16, ZS_FLAW_NONE, 0);
        CHANGED_TEXTURE(x.n_colors = 4, i ? ZS_FLAW_TEXEL : ZS_FLAW_NONE, 0);
    }
    for (uint32_t at = 0; at < 16; at++) { /* every texel alone */
        struct zs_texture x = all[1];
        memset(pal8, 0, sizeof pal8);
        pal8[at] = 5;
        TEXTURE_HAS(&x, ZS_FLAW_TEXEL, at);
        pal8[at] = 255;
        x.n_colors = 256;
        TEXTURE_HAS(&x, ZS_FLAW_NONE, 0);
        x.n_colors = 255;
        TEXTURE_HAS(&x, ZS_FLAW_TEXEL, at);
        x = all[2];
        memset(pal4, 0, sizeof pal4);
        pal4[at / 2] = (uint8_t)(at % 2 ? 0x54 : 0x45); /* the right texel in the high bits */
        TEXTURE_HAS(&x, ZS_FLAW_TEXEL, at);
        x.n_colors = 6;
        TEXTURE_HAS(&x, ZS_FLAW_NONE, 0);
    }
    struct zs_texture odd = all[0];
    odd.texel = (const uint8_t *)plain + 1;
    TEXTURE_HAS(&odd, ZS_FLAW_ALIGN, 0);
}

/* ---- Hierarchies ----------------------------------------------------------------------------------- */

#define NODE_TRIS 40
#define NODE_ROOM (2 * NODE_TRIS)

static struct {
    struct zs_mesh mesh;
    struct zs_cluster cluster;
    int16_t pos[3 * NODE_TRIS][3];
    uint16_t tri[NODE_TRIS][3];
    struct zs_bvh_node node[NODE_ROOM]; /* of the sound hierarchy */
    uint32_t n;
} tree;

/* Triangles in a row, in a hierarchy with leaves of two, which is sound. */
static void tree_make(struct prng *p, uint32_t n_tris)
{
    memset(&tree, 0, sizeof tree);
    for (uint32_t v = 0; v < 3 * n_tris; v++) {
        tree.pos[v][0] = (int16_t)(prng_range(p, -300, 300) + (int32_t)(v / 3 * 200) - 3000);
        tree.pos[v][1] = (int16_t)prng_range(p, -900, 900);
        tree.pos[v][2] = (int16_t)prng_range(p, -900, 900);
        tree.tri[v / 3][v % 3] = (uint16_t)v;
    }
    tree.cluster = (struct zs_cluster){ .n_tris = (uint16_t)n_tris, .radius = 65535, .cutoff = 127 };
    tree.mesh = (struct zs_mesh){ .pos = (const int16_t (*)[3])tree.pos, .tri = (const uint16_t (*)[3])tree.tri,
                                  .n_verts = 3 * n_tris, .n_tris = n_tris, .radius = 65535,
                                  .cluster = &tree.cluster, .n_clusters = 1 };
    tree.n = nodes_make(tree.node, NODE_ROOM, &tree.mesh, 2);
    tree.mesh.bvh = tree.node;
}

#define NODE_CHANGED(change, flaw, at) \
    do { \
        struct zs_bvh_node sound[NODE_ROOM]; \
        memcpy(sound, tree.node, sizeof sound); \
        struct zs_bvh_node *const node = tree.node; \
        change; \
        HAS(&tree.mesh, flaw, at); \
        memcpy(tree.node, sound, sizeof sound); \
    } while (0)

static void each_flaw_of_a_hierarchy(void **state)
{
    struct prng p = { 5 };
    tree_make(&p, 8); /* 7 nodes: 0 (1 (2 3) 4 (5 6)) */
    assert_int_equal(tree.n, 7);
    NODE_CHANGED((void)node, ZS_FLAW_NONE, 0);
    NODE_CHANGED(node[0].skip = 0, ZS_FLAW_NODES, 0);
    NODE_CHANGED(node[0].skip = 17, ZS_FLAW_NODES, 0); /* more than two a triangle: not read */
    NODE_CHANGED(node[0].skip = UINT32_MAX, ZS_FLAW_NODES, 0);
    NODE_CHANGED(node[0].skip = 6, ZS_FLAW_NODES, 4); /* its second child goes on */
    NODE_CHANGED(node[0].first = 1, ZS_FLAW_NODES, 0);
    NODE_CHANGED(node[3].skip = 3, ZS_FLAW_NODES, 3); /* a walk would not end */
    NODE_CHANGED(node[4].skip = 1, ZS_FLAW_NODES, 4);
    NODE_CHANGED(node[6].skip = 8, ZS_FLAW_NODES, 6);
    NODE_CHANGED(node[1].skip = 5, ZS_FLAW_NODES, 1); /* it ends within another one */
    NODE_CHANGED(node[2].skip = 4, ZS_FLAW_NODES, 2); /* no leaf then, and its child begins elsewhere */
    NODE_CHANGED(node[1].skip = 3, ZS_FLAW_NONE, 0);  /* nodes of one child, or of three, are fine */
    NODE_CHANGED(node[3].first = 9, ZS_FLAW_NODES, 2);
    NODE_CHANGED(node[5].first = 5, ZS_FLAW_NODES, 4);
    NODE_CHANGED(node[3].first = 0, ZS_FLAW_NODES, 2); /* a leaf without triangles */
    NODE_CHANGED(node[6].first = 8, ZS_FLAW_NODES, 6);
    for (uint32_t k = 0; k < tree.n; k++) {
        NODE_CHANGED(node[k].radius = 200, ZS_FLAW_NODE_SPHERE, k);
        NODE_CHANGED(node[k].center[0] = 30000, ZS_FLAW_NODE_SPHERE, k);
    }
    tree.mesh.bvh = (const struct zs_bvh_node *)(const void *)((const uint8_t *)tree.node + 2);
    HAS(&tree.mesh, ZS_FLAW_ALIGN, 0);
    tree.mesh.bvh = tree.node;
    tree.mesh.n_tris = 0;
    tree.mesh.cluster = NULL;
    tree.mesh.n_clusters = 0;
    HAS(&tree.mesh, ZS_FLAW_NODES, 0);
}

static uint32_t nodes_sound, nodes_drawn;

/* A hierarchy of which some numbers are anything: refused, or the depth buffer's frame is drawn by it. */
static int nodes_case(uint64_t seed)
{
    static const struct zs_material material = { .shader = &zs_shade_flat, .rgb = { 9, 9, 9 }, .cull = ZS_CULL_NONE };
    struct prng p = { seed };
    tree_make(&p, 1 + prng_pick(&p, NODE_TRIS));
    struct zs_bvh_node *const node = block(tree.node, tree.n * sizeof *node); /* nothing behind it */
    for (uint32_t k = prng_pick(&p, 4); k; k--) {
        struct zs_bvh_node *const at = &node[prng_pick(&p, tree.n)];
        const uint32_t any = prng_pick(&p, 3) ? prng_pick(&p, NODE_TRIS + 4u) : (uint32_t)prng_log(&p);
        switch (prng_pick(&p, 4)) {
        case 0: at->skip = at != node || any <= tree.n || any > 2 * tree.mesh.n_tris ? any : at->skip; break;
        case 1: at->first = any; break;
        case 2: at->radius = (uint16_t)(prng_pick(&p, 2) ? 65535 : prng_next(&p)); break;
        default: at->center[prng_pick(&p, 3)] += (int16_t)prng_range(&p, -50, 50); break;
        }
    }
    tree.mesh.bvh = node;
    uint32_t at;
    const enum zs_flaw flaw = flaw_of(&tree.mesh, &at);
    int ok = flaw == ZS_FLAW_NONE || ((flaw == ZS_FLAW_NODES || flaw == ZS_FLAW_NODE_SPHERE) && at < tree.n);
    if (flaw == ZS_FLAW_NONE) {
        struct zs_instance in = { .mesh = &tree.mesh, .material = &material };
        const struct zs_scene scene = { .instance = &in, .n_instances = 1 };
        const int32_t none[3] = { prng_range(&p, -3000, 3000), 0, 0 };
        struct zs_camera camera;
        memset(&camera, 0, sizeof camera);
        (void)zs_camera_perspective(&camera, 9000, 24, 20, 20000);
        (void)zs_camera_orbit(&camera, none, 2500, (zs_turn)prng_next(&p), 2000);
        struct zs_config c = picture_config(32, 24, &zs_depth_recip);
        struct picture want = picture_draw(&c, &scene, &camera);
        c.method = &zs_method_raycast;
        c.strip_h = (uint16_t)prng_range(&p, 1, 24);
        c.max_tris = (uint16_t)prng_range(&p, 4, 60);
        c.max_verts = (uint16_t)prng_range(&p, 6, 90);
        struct picture is = picture_draw(&c, &scene, &camera);
        if (!want.err && !is.err)
            memcpy(is.key, want.key, 32 * 24 * 2); /* rays leave none */
        ok = picture_same(&want, &is, "a hierarchy that passed");
        nodes_sound++;
        nodes_drawn += want.covered > 0;
        PICTURES_FREE(&want, &is);
    }
    free(node);
    return ok;
}

static void any_hierarchy_is_refused_or_right(void **state)
{
    (void)state;
    nodes_sound = nodes_drawn = 0;
    CASES(nodes_case, 2000);
    assert_true(!cases_all() || (nodes_sound > 500 && nodes_sound < 1500 && nodes_drawn > 300));
}

/* ---- Sentences ------------------------------------------------------------------------------------- */

static void strflaw_has_a_text_for_each(void **state)
{
    for (int a = 0; a <= ZS_FLAW_NODE_SPHERE + 1; a++) {
        assert_non_null(zs_flaw_string((enum zs_flaw)a));
        for (int b = 0; b < a; b++)
            assert_string_not_equal(zs_flaw_string((enum zs_flaw)a), zs_flaw_string((enum zs_flaw)b));
    }
    assert_string_equal(zs_flaw_string((enum zs_flaw)-1), zs_flaw_string((enum zs_flaw)1000));
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_sound_mesh_passes),
    cmocka_unit_test(every_mesh_of_the_scenes_passes),
    cmocka_unit_test(what_is_missing),
    cmocka_unit_test(what_is_not_aligned),
    cmocka_unit_test(counts_and_scale),
    cmocka_unit_test(indices),
    cmocka_unit_test(the_sphere_is_exact),
    cmocka_unit_test(normals_have_length_one_or_none),
    cmocka_unit_test(clusters_hold_all_in_order),
    cmocka_unit_test(clusters_lie_in_their_spheres),
    cmocka_unit_test(cones_hold_their_triangles),
    cmocka_unit_test(flat_clusters),
    CASES_COUNTS(no_front_is_seen_where_a_cone_passes, cone_case, 4000,
                 { "cones passed", &cones_held, 1000 }, { "cones refused", &cones_refused, 300 },
                 { "eyes tried", &eyes_tried, 20000 }),
    CASES_COUNT(what_a_cone_is_refused_for_can_be_seen, broken_case, 300,
                &broken_shown, 100, "cones of 300 shown to be broken by an eye"),
    CASES_TEST(any_content_is_checked_without_overflow, noise_case, 20000),
    cmocka_unit_test(the_largest_sums),
    cmocka_unit_test(the_largest_counts),
    cmocka_unit_test(sound_textures_pass),
    cmocka_unit_test(each_flaw_of_a_texture),
    cmocka_unit_test(each_flaw_of_a_hierarchy),
    cmocka_unit_test(any_hierarchy_is_refused_or_right),
    cmocka_unit_test(strflaw_has_a_text_for_each),
};

CASES_MAIN(tests)
