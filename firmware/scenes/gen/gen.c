/* The mesh builder: arithmetic, checks and a mesh as C.
 *
 * SPDX-License-Identifier: MIT
 */
#include "gen.h"
#include "out.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CLUSTER 64u /* triangles to a cluster */

static struct gen_mesh mesh;

/* ---- Arithmetic ------------------------------------------------------------------------------ */

int64_t gen_div(int64_t a, int64_t b)
{
    return a < 0 ? -((-a + b / 2) / b) : (a + b / 2) / b;
}

/* Taylor series on [0, pi/4]; the first term left out is below 2^-34. x in q30. */
static int64_t sin_series(int64_t x)
{
    const int64_t x2 = gen_div(x * x, GEN_Q30);
    int64_t s = GEN_Q30;
    for (int64_t k = 10; k >= 2; k -= 2)
        s = GEN_Q30 - gen_div(gen_div(x2 * s, GEN_Q30), k * (k + 1));
    return gen_div(x * s, GEN_Q30);
}

static int64_t cos_series(int64_t x)
{
    const int64_t x2 = gen_div(x * x, GEN_Q30);
    int64_t s = GEN_Q30;
    for (int64_t k = 11; k >= 1; k -= 2)
        s = GEN_Q30 - gen_div(gen_div(x2 * s, GEN_Q30), k * (k + 1));
    return s;
}

int64_t gen_sin(int64_t turn)
{
    const int64_t pi_q30 = 3373259426;
    const int64_t a = turn & 65535;
    const int64_t in_quarter = (a & 16384) ? 16384 - (a & 16383) : a & 16383;
    const int64_t x = in_quarter <= 8192 ? in_quarter : 16384 - in_quarter;
    const int64_t x_q30 = gen_div(x * pi_q30, 32768);
    const int64_t s = in_quarter <= 8192 ? sin_series(x_q30) : cos_series(x_q30);
    return a & 32768 ? -s : s;
}

int64_t gen_cos(int64_t turn)
{
    return gen_sin(turn + 16384);
}

uint64_t gen_sqrt(uint64_t v)
{
    uint64_t root = 0;
    for (uint64_t bit = (uint64_t)1 << 31; bit; bit >>= 1)
        if ((root + bit) * (root + bit) <= v)
            root += bit;
    return root;
}

uint32_t gen_hash(uint32_t a, uint32_t b, uint32_t seed)
{
    uint32_t h = seed * 0x9e3779b9u ^ a * 0x85ebca6bu ^ b * 0xc2b2ae35u;
    h = (h ^ h >> 16) * 0x7feb352du;
    h = (h ^ h >> 15) * 0x846ca68bu;
    return h ^ h >> 16;
}

void gen_cross(int64_t out[3], const int64_t a[3], const int64_t b[3])
{
    const int64_t r[3] = { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                           a[0] * b[1] - a[1] * b[0] };
    memcpy(out, r, sizeof r);
}

static int64_t largest(const int64_t v[3])
{
    int64_t most = 0;
    for (int i = 0; i < 3; i++)
        if (llabs(v[i]) > most)
            most = llabs(v[i]);
    return most;
}

void gen_fit(int64_t v[3], int64_t limit)
{
    const int64_t by = (largest(v) + limit - 1) / limit;
    for (int i = 0; i < 3 && by > 1; i++)
        v[i] = gen_div(v[i], by);
}

void gen_unit(int64_t v[3], int64_t one)
{
    /* As long as the squares' sum allows: short vectors lose least then. */
    const int64_t limit = (int64_t)1 << 30;
    gen_fit(v, limit);
    const int64_t up = limit / largest(v);
    uint64_t sum = 0;
    for (int i = 0; i < 3; i++) {
        v[i] *= up;
        sum += (uint64_t)(v[i] * v[i]); /* <= 3 * 2^60 */
    }
    const int64_t length = (int64_t)gen_sqrt(sum);
    for (int i = 0; i < 3; i++)
        v[i] = gen_div(v[i] * one, length); /* |v| * one < 2^61 */
}

struct gen_rgb gen_mix(struct gen_rgb a, struct gen_rgb b, int64_t t, int64_t t_max)
{
    const struct gen_rgb c = { (uint8_t)gen_div(a.r * (t_max - t) + b.r * t, t_max),
                               (uint8_t)gen_div(a.g * (t_max - t) + b.g * t, t_max),
                               (uint8_t)gen_div(a.b * (t_max - t) + b.b * t, t_max) };
    return c;
}

struct gen_rgb gen_hue(int64_t turn)
{
    uint8_t c[3];
    for (int i = 0; i < 3; i++)
        c[i] = (uint8_t)(150 + gen_div(104 * gen_cos(turn - i * 21845), GEN_Q30));
    const struct gen_rgb rgb = { c[0], c[1], c[2] };
    return rgb;
}

/* A corner of the lattice, 0 .. 65535. */
static int64_t lattice(const int64_t corner[3], int64_t cells, uint32_t seed)
{
    return gen_hash(gen_hash((uint32_t)(corner[0] % cells), (uint32_t)(corner[1] % cells), seed),
                    (uint32_t)(corner[2] % cells), seed) & 65535;
}

int64_t gen_noise(const int64_t at[3], int64_t cells, uint32_t seed)
{
    int64_t sum = 0, weight[2][3];
    for (int i = 0; i < 3; i++) {
        const int64_t f = (at[i] & 65535) >> 6; /* 3 t^2 - 2 t^3 in q10 */
        weight[1][i] = gen_div(f * f * (3 * 1024 - 2 * f), 1024 * 1024);
        weight[0][i] = 1024 - weight[1][i];
    }
    for (int k = 0; k < 8; k++) {
        const int x = k & 1, y = k >> 1 & 1, z = k >> 2;
        const int64_t corner[3] = { (at[0] >> 16) + x, (at[1] >> 16) + y, (at[2] >> 16) + z };
        sum += lattice(corner, cells, seed) * weight[x][0] * weight[y][1] * weight[z][2];
    }
    return gen_div(sum, GEN_Q30);
}

int64_t gen_fractal(const int64_t at[3], int64_t cells, int octaves, uint32_t seed)
{
    int64_t sum = 0, fine[3] = { at[0], at[1], at[2] };
    for (int k = 0; k < octaves; k++) {
        sum += gen_noise(fine, cells << k, seed + (uint32_t)k) << (octaves - 1 - k);
        for (int i = 0; i < 3; i++)
            fine[i] *= 2;
    }
    return gen_div(sum, ((int64_t)1 << octaves) - 1);
}

/* ---- Building -------------------------------------------------------------------------------- */

struct gen_mesh *gen_begin(const char *name)
{
    memset(&mesh, 0, sizeof mesh);
    mesh.name = name;
    return &mesh;
}

uint32_t gen_vert(struct gen_mesh *m, int64_t x, int64_t y, int64_t z)
{
    if (m->n_verts == GEN_VERTS_MAX)
        out_die("too many vertices", m->name);
    const int64_t pos[3] = { x, y, z };
    for (int i = 0; i < 3; i++)
        if (pos[i] < -32768 || pos[i] > 32767)
            out_die("a position that int16 cannot hold", m->name);
    memcpy(m->pos[m->n_verts], pos, sizeof pos);
    return m->n_verts++;
}

/* q1_15; -1 is not used, so that a normal and its opposite are exact mirror images. */
static void to_q15(int16_t out[3], const int64_t v[3])
{
    int64_t n[3] = { v[0], v[1], v[2] };
    gen_unit(n, 32768);
    for (int i = 0; i < 3; i++)
        out[i] = (int16_t)(n[i] > 32767 ? 32767 : n[i] < -32767 ? -32767 : n[i]);
}

uint32_t gen_vert_normal(struct gen_mesh *m, const int64_t pos[3], const int64_t normal[3],
                         struct gen_rgb rgb)
{
    const uint32_t i = gen_vert(m, pos[0], pos[1], pos[2]);
    if (largest(normal) == 0)
        out_die("a normal of length 0", m->name);
    to_q15(m->normal[i], normal);
    m->vertex_rgb[i] = rgb;
    return i;
}

static void face_cross(int64_t out[3], const struct gen_mesh *m, uint32_t t)
{
    const uint32_t *v = m->tri[t];
    int64_t ab[3], ac[3];
    for (int i = 0; i < 3; i++) {
        ab[i] = m->pos[v[1]][i] - m->pos[v[0]][i];
        ac[i] = m->pos[v[2]][i] - m->pos[v[0]][i];
    }
    gen_cross(out, ab, ac);
}

uint32_t gen_tri(struct gen_mesh *m, uint32_t a, uint32_t b, uint32_t c, struct gen_rgb rgb)
{
    if (m->n_tris == GEN_TRIS_MAX)
        out_die("too many triangles", m->name);
    if (a >= m->n_verts || b >= m->n_verts || c >= m->n_verts)
        out_die("a vertex number out of range", m->name);
    const uint32_t t = m->n_tris++;
    m->tri[t][0] = a;
    m->tri[t][1] = b;
    m->tri[t][2] = c;
    m->face_rgb[t] = m->face_raw[t] = rgb;
    int64_t n[3];
    face_cross(n, m, t);
    if (largest(n) == 0)
        out_die("a triangle without area", m->name);
    return t;
}

void gen_uv(struct gen_mesh *m, uint32_t vertex, int64_t u, int64_t v)
{
    if (u < -32768 || u > 32767 || v < -32768 || v > 32767)
        out_die("a texture coordinate that int16 cannot hold", m->name);
    m->uv[vertex][0] = u;
    m->uv[vertex][1] = v;
}

void gen_quad(struct gen_mesh *m, uint32_t a, uint32_t b, uint32_t c, uint32_t d,
              struct gen_rgb rgb)
{
    gen_tri(m, a, b, c, rgb);
    gen_tri(m, a, c, d, rgb);
}

void gen_box_side(int64_t corner[3], int64_t right[3], int64_t down[3], const int8_t side[2][3], int64_t half,
                  int from_outside)
{
    int64_t middle[3];
    for (int k = 0; k < 3; k++) {
        right[k] = 2 * half * side[0][k];
        down[k] = 2 * half * side[1][k];
    }
    if (from_outside)
        gen_cross(middle, down, right);
    else
        gen_cross(middle, right, down);
    gen_unit(middle, half);
    for (int k = 0; k < 3; k++)
        corner[k] = middle[k] - (right[k] + down[k]) / 2;
}

void gen_panel(struct gen_mesh *m, const int64_t corner[3], const int64_t right[3],
               const int64_t down[3], const int64_t uv[2][2])
{
    static const struct gen_rgb white = { 255, 255, 255 };
    int64_t normal[3];
    uint32_t v[4];
    gen_cross(normal, down, right);
    for (int i = 0; i < 4; i++) { /* counter-clockwise from the top left */
        const int64_t to_right = i >> 1, to_down = i == 1 || i == 2;
        int64_t pos[3];
        for (int k = 0; k < 3; k++)
            pos[k] = corner[k] + to_right * right[k] + to_down * down[k];
        v[i] = gen_vert_normal(m, pos, normal, white);
        gen_uv(m, v[i], uv[to_right][0], uv[to_down][1]);
    }
    gen_quad(m, v[0], v[1], v[2], v[3], white);
}

static int same_place(const struct gen_mesh *m, uint32_t a, uint32_t b)
{
    return memcmp(m->pos[a], m->pos[b], sizeof m->pos[a]) == 0;
}

void gen_smooth(struct gen_mesh *m)
{
    static int64_t sum[GEN_VERTS_MAX][3];
    memset(sum, 0, sizeof sum);
    for (uint32_t t = 0; t < m->n_tris; t++) {
        int64_t n[3];
        face_cross(n, m, t);
        for (int k = 0; k < 3; k++)
            for (int i = 0; i < 3; i++)
                sum[m->tri[t][k]][i] += n[i];
    }
    for (uint32_t v = 0; v < m->n_verts; v++) {
        int64_t n[3] = { 0, 0, 0 };
        for (uint32_t w = 0; w < m->n_verts; w++)
            if (same_place(m, v, w))
                for (int i = 0; i < 3; i++)
                    n[i] += sum[w][i];
        if (largest(n) == 0)
            out_die("a vertex whose faces leave it no normal", m->name);
        to_q15(m->normal[v], n);
    }
}

void gen_bake(struct gen_mesh *m, const int64_t dir[3], int64_t ambient)
{
    int64_t light[3] = { dir[0], dir[1], dir[2] };
    gen_unit(light, 32768);
    for (uint32_t t = 0; t < m->n_tris; t++) {
        int64_t n[3];
        face_cross(n, m, t);
        gen_unit(n, 32768);
        const int64_t cosine = n[0] * light[0] + n[1] * light[1] + n[2] * light[2]; /* q30 */
        int64_t lit = ambient + gen_div((256 - ambient) * (cosine > 0 ? cosine : 0), GEN_Q30);
        if (lit > 256)
            lit = 256;
        const struct gen_rgb black = { 0, 0, 0 };
        m->face_raw[t] = gen_mix(black, m->face_rgb[t], lit, 256);
    }
}

/* ---- Output ---------------------------------------------------------------------------------- */

static void write_arrays(FILE *f, const struct gen_mesh *m, unsigned parts)
{
    struct out_rows r = out_array(f, "int16_t", "pos", m->n_verts, "[3]");
    for (uint32_t i = 0; i < m->n_verts; i++)
        out_row3(&r, m->pos[i][0], m->pos[i][1], m->pos[i][2]);
    out_array_end(&r);
    r = out_array(f, "uint16_t", "tri", m->n_tris, "[3]");
    for (uint32_t i = 0; i < m->n_tris; i++)
        out_row3(&r, m->tri[i][0], m->tri[i][1], m->tri[i][2]);
    out_array_end(&r);
    if (parts & GEN_NORMAL) {
        r = out_array(f, "zs_q1_15", "normal", m->n_verts, "[3]");
        for (uint32_t i = 0; i < m->n_verts; i++)
            out_row3(&r, m->normal[i][0], m->normal[i][1], m->normal[i][2]);
        out_array_end(&r);
    }
    if (parts & GEN_UV) {
        r = out_array(f, "int16_t", "uv", m->n_verts, "[2]");
        for (uint32_t i = 0; i < m->n_verts; i++)
            out_row2(&r, m->uv[i][0], m->uv[i][1]);
        out_array_end(&r);
    }
    if (parts & GEN_FACE_NORMAL) {
        r = out_array(f, "zs_q1_15", "face_normal", m->n_tris, "[3]");
        for (uint32_t i = 0; i < m->n_tris; i++) {
            int64_t n[3];
            int16_t q[3];
            face_cross(n, m, i);
            to_q15(q, n);
            out_row3(&r, q[0], q[1], q[2]);
        }
        out_array_end(&r);
    }
    if (parts & GEN_VERTEX_RGB) {
        r = out_array(f, "struct zs_rgb", "vertex_rgb", m->n_verts, "");
        for (uint32_t i = 0; i < m->n_verts; i++)
            out_row3(&r, m->vertex_rgb[i].r, m->vertex_rgb[i].g, m->vertex_rgb[i].b);
        out_array_end(&r);
    }
    if (parts & GEN_FACE_RGB) {
        r = out_array(f, "struct zs_rgb", "face_rgb", m->n_tris, "");
        for (uint32_t i = 0; i < m->n_tris; i++)
            out_row3(&r, m->face_rgb[i].r, m->face_rgb[i].g, m->face_rgb[i].b);
        out_array_end(&r);
    }
    if (parts & GEN_FACE_RAW) {
        r = out_array(f, "uint16_t", "face_raw", m->n_tris, "");
        for (uint32_t i = 0; i < m->n_tris; i++) {
            char text[16];
            snprintf(text, sizeof text, "0x%04x,", out_rgb565(m->face_raw[i]));
            out_row(&r, text);
        }
        out_array_end(&r);
    }
}

/* The middle of the box around the vertices of triangles [first, first + n), and the distance of the farthest one,
 * rounded up. */
static uint64_t sphere(const struct gen_mesh *m, uint32_t first, uint32_t n, int64_t center[3])
{
    const uint32_t *const from = m->tri[first], *const end = m->tri[first + n];
    for (int i = 0; i < 3; i++) {
        int64_t least = INT16_MAX, most = INT16_MIN;
        for (const uint32_t *v = from; v < end; v++) {
            least = m->pos[*v][i] < least ? m->pos[*v][i] : least;
            most = m->pos[*v][i] > most ? m->pos[*v][i] : most;
        }
        center[i] = gen_div(least + most, 2);
    }
    uint64_t far2 = 0;
    for (const uint32_t *v = from; v < end; v++) {
        uint64_t d2 = 0;
        for (int i = 0; i < 3; i++) {
            const int64_t d = m->pos[*v][i] - center[i];
            d2 += (uint64_t)(d * d);
        }
        far2 = d2 > far2 ? d2 : far2;
    }
    const uint64_t root = gen_sqrt(far2);
    return root * root < far2 ? root + 1 : root;
}

/* Of a triangle, 1/16 step, rounded down: over its longest side. */
static uint64_t height(const struct gen_mesh *m, uint32_t t, const int64_t normal[3])
{
    int64_t area2 = 0, longest = 0; /* both squared: of twice the area, below 2^62 as |side| < 2^15.6 in all scenes */
    for (int i = 0; i < 3; i++) {
        int64_t side2 = 0;
        for (int k = 0; k < 3; k++) {
            const int64_t d = m->pos[m->tri[t][i]][k] - m->pos[m->tri[t][(i + 1) % 3]][k];
            side2 += d * d;
        }
        longest = side2 > longest ? side2 : longest;
        area2 += normal[i] / 2 * (normal[i] / 2);
    }
    return gen_sqrt((uint64_t)(area2 / longest) * 4 * 256);
}

/* The cone around the normals of triangles [first, first + n): axis and cutoff, 127 is 1; 127: there is none. Return
 * the least height. */
static uint64_t cone(const struct gen_mesh *m, uint32_t first, uint32_t n, int64_t axis[3], int64_t *cutoff)
{
    int64_t sum[3] = { 0, 0, 0 }, normal[3];
    uint64_t least = 65535;
    for (uint32_t t = first; t < first + n; t++) {
        face_cross(normal, m, t);
        const uint64_t high = height(m, t, normal);
        least = high < least ? high : least;
        gen_unit(normal, 1 << 20);
        for (int i = 0; i < 3; i++)
            sum[i] += normal[i];
    }
    *cutoff = 127;
    if (largest(sum) == 0)
        return least;
    gen_unit(sum, 127);
    int64_t most = 0;
    for (uint32_t t = first; t < first + n; t++) {
        int64_t across[3], ahead = 0;
        face_cross(normal, m, t);
        gen_unit(normal, 1 << 20);
        gen_cross(across, normal, sum);
        uint64_t sine2 = 0;
        for (int i = 0; i < 3; i++) {
            ahead += normal[i] * sum[i];
            sine2 += (uint64_t)(across[i] * across[i]); /* < 2^54 */
        }
        const int64_t sine = ((int64_t)gen_sqrt(sine2) >> 20) + 2; /* 127 times it, and what rounding may have lost */
        most = ahead <= 0 || sine > 127 ? 127 : sine > most ? sine : most;
    }
    *cutoff = most;
    for (int i = 0; i < 3; i++)
        axis[i] = sum[i];
    return least;
}

/* Triangles as they come, CLUSTER at a time. Return how many clusters. */
static uint32_t write_clusters(FILE *f, const struct gen_mesh *m)
{
    const uint32_t n = (m->n_tris + CLUSTER - 1) / CLUSTER;
    struct out_rows r = out_array(f, "struct zs_cluster", "cluster", n, "");
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t first = i * CLUSTER, left = m->n_tris - first, size = left < CLUSTER ? left : CLUSTER;
        int64_t center[3], axis[3] = { 0, 0, 0 }, cutoff;
        const uint64_t radius = sphere(m, first, size, center), high = cone(m, first, size, axis, &cutoff);
        char text[200];
        snprintf(text, sizeof text,
                 "{.first=%lu,.n_tris=%lu,.center={%lld,%lld,%lld},.radius=%llu,.axis={%lld,%lld,%lld},.cutoff=%lld,"
                 ".height=%llu},",
                 (unsigned long)first, (unsigned long)size, (long long)center[0], (long long)center[1],
                 (long long)center[2], (unsigned long long)radius, (long long)axis[0], (long long)axis[1],
                 (long long)axis[2], (long long)cutoff, (unsigned long long)high);
        out_row(&r, text);
    }
    out_array_end(&r);
    return n;
}

void gen_write(const struct gen_mesh *m, unsigned parts, uint32_t scale)
{
    int64_t center[3];
    const uint64_t radius = sphere(m, 0, m->n_tris, center);
    const uint32_t n_clusters = parts & GEN_CLUSTERS ? (m->n_tris + CLUSTER - 1) / CLUSTER : 0;
    if (radius > 65535)
        out_die("the radius does not fit uint16", m->name);

    const uint32_t bytes = m->n_verts * (6u + (parts & GEN_NORMAL ? 6u : 0) +
                                         (parts & GEN_UV ? 4u : 0) +
                                         (parts & GEN_VERTEX_RGB ? 3u : 0)) +
                           m->n_tris * (6u + (parts & GEN_FACE_NORMAL ? 6u : 0) +
                                        (parts & GEN_FACE_RGB ? 3u : 0) +
                                        (parts & GEN_FACE_RAW ? 2u : 0)) +
                           20u * n_clusters;

    char name[64];
    snprintf(name, sizeof name, "mesh_%s", m->name);
    FILE *f = out_begin(name);
    fprintf(f, "/* %lu vertices, %lu triangles, %lu bytes of flash. */\n",
            (unsigned long)m->n_verts, (unsigned long)m->n_tris, (unsigned long)bytes);
    write_arrays(f, m, parts);
    if (n_clusters)
        write_clusters(f, m);
    fprintf(f, "\nconst struct zs_mesh %s = {\n", name);
    out_field(f, "pos");
    out_field(f, "tri");
    if (parts & GEN_NORMAL)
        out_field(f, "normal");
    if (parts & GEN_UV) {
        out_field(f, "uv");
        fprintf(f, "    .uv_bits = %lu,\n", (unsigned long)m->uv_bits);
    }
    if (parts & GEN_FACE_NORMAL)
        out_field(f, "face_normal");
    if (parts & GEN_VERTEX_RGB)
        out_field(f, "vertex_rgb");
    if (parts & GEN_FACE_RGB)
        out_field(f, "face_rgb");
    if (parts & GEN_FACE_RAW)
        out_field(f, "face_raw");
    fprintf(f, "    .n_verts = %lu,\n    .n_tris = %lu,\n    .scale = %luu,\n",
            (unsigned long)m->n_verts, (unsigned long)m->n_tris, (unsigned long)scale);
    if (n_clusters) {
        out_field(f, "cluster");
        fprintf(f, "    .n_clusters = %lu,\n", (unsigned long)n_clusters);
    }
    fprintf(f, "    .center = { %lld, %lld, %lld },\n    .radius = %llu,\n};\n",
            (long long)center[0], (long long)center[1], (long long)center[2],
            (unsigned long long)radius);
    char size[64];
    snprintf(size, sizeof size, "%lu vertices, %lu triangles", (unsigned long)m->n_verts,
             (unsigned long)m->n_tris);
    out_declare("zs_mesh", "mesh", m->name, size, bytes);
}
