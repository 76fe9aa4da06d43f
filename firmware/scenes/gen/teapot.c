/* The Utah teapot, from Martin Newell's 32 bicubic Bezier patches (1975), 306 control points, in
 * the proportions of Jim Blinn's published data.
 *
 * All patches follow one of two patterns, so the data below are those points without repetition:
 *   turned  rim, body, lid and bottom: a profile around the z axis. A row (r, c, z) stands for the
 *           control points (r, 0), (r, -c), (c, -r), (0, -r) at height z and three quarter turns.
 *   tube    handle and spout: halves that mirror each other at y = 0. A row stands for the points
 *           (x0, 0, z0), (x0, -w, z0), (x1, -w, z1), (x1, 0, z1) and their mirror images.
 *
 * Two departures, because a culled back side is a hole: the lid is widened by 14/13, so that it
 * meets the rim exactly, and tea stands in the spout's mouth (a mesh of its own).
 *
 * Published axes: z up. Mesh: x, z - middle, -y.
 *
 * SPDX-License-Identifier: MIT
 */
#include "gen.h"

#define UNIT 100000        /* control units to a published unit */
#define LID_NUM 14
#define LID_DEN 13
#define STEPS 8000         /* mesh steps to a published unit */
#define MIDDLE 157500      /* half the height, control units */

#define QUARTER 8          /* segments around a quarter of the turned parts */
#define HALF 6             /* segments around half a tube */

struct turned_row {
    int32_t r, c, z;
};

struct tube_row {
    int32_t x0, z0, x1, z1, w;
};

/* Four rows a Bezier segment, the last being the next one's first. Top to bottom. */
static const struct turned_row lid[] = {
    { 0, 0, 315000 },          { 80000, 45000, 315000 },   { 0, 0, 285000 },
    { 20000, 11200, 270000 },  { 40000, 22400, 255000 },   { 130000, 72800, 255000 },
    { 130000, 72800, 240000 },
};
static const struct turned_row pot[] = {
    /* rim */
    { 140000, 78400, 240000 }, { 133750, 74900, 253125 },  { 143750, 80500, 253125 },
    /* body */
    { 150000, 84000, 240000 }, { 175000, 98000, 187500 },  { 200000, 112000, 135000 },
    { 200000, 112000, 90000 }, { 200000, 112000, 45000 },  { 150000, 84000, 22500 },
    /* bottom */
    { 150000, 84000, 15000 },  { 150000, 84000, 7500 },    { 142500, 79800, 0 },
    { 0, 0, 0 },
};
static const int lid_rows[] = { 7, 6 };       /* mesh rows to each segment */
static const int pot_rows[] = { 3, 7, 7, 4 };

static const struct tube_row handle[] = {
    { -160000, 202500, -150000, 225000, 30000 }, { -230000, 202500, -250000, 225000, 30000 },
    { -270000, 202500, -300000, 225000, 30000 }, { -270000, 180000, -300000, 180000, 30000 },
    { -270000, 157500, -300000, 135000, 30000 }, { -250000, 112500, -265000, 93750, 30000 },
    { -200000, 90000, -190000, 60000, 30000 },
};
static const struct tube_row spout[] = {
    { 170000, 142500, 170000, 60000, 66000 },   { 260000, 142500, 310000, 82500, 66000 },
    { 230000, 210000, 240000, 202500, 25000 },  { 270000, 240000, 330000, 240000, 25000 },
    { 280000, 247500, 352500, 249375, 25000 },  { 290000, 247500, 345000, 251250, 15000 },
    { 280000, 240000, 320000, 240000, 15000 },
};
static const int handle_rows[] = { 8, 8 };
static const int spout_rows[] = { 9, 5 };

#define UV_BITS 12

static const struct gen_rgb white = { 255, 255, 255 };

/* ---- Evaluation: exact, over the denominator (n m)^3 --------------------------------------- */

struct patch {
    int64_t p[4][4][3]; /* [v][u] */
};

/* Bernstein polynomials of degree 3 at i / n, times n^3; and their derivatives, times n^2. */
static void bernstein(int64_t b[4], int64_t i, int64_t n)
{
    const int64_t j = n - i;
    b[0] = j * j * j;
    b[1] = 3 * i * j * j;
    b[2] = 3 * i * i * j;
    b[3] = i * i * i;
}

static void bernstein_slope(int64_t b[4], int64_t i, int64_t n)
{
    const int64_t j = n - i;
    b[0] = -3 * j * j;
    b[1] = 3 * j * j - 6 * i * j;
    b[2] = 6 * i * j - 3 * i * i;
    b[3] = 3 * i * i;
}

static void weigh(int64_t out[3], const struct patch *patch, const int64_t bv[4],
                  const int64_t bu[4])
{
    for (int k = 0; k < 3; k++) {
        out[k] = 0;
        for (int v = 0; v < 4; v++)
            for (int u = 0; u < 4; u++)
                out[k] += bv[v] * bu[u] * patch->p[v][u][k]; /* sum < 9^6 * 9 * 5e6 < 2^45 */
    }
}

struct point {
    int64_t pos[3], normal[3]; /* mesh axes, steps; any length */
};

/* The point (iu / nu, iv / nv). den: control units are 1 / den of those in the tables. The normal
 * is dP/du x dP/dv times side; where the patch is pinched, the z axis, up or down. */
static struct point evaluate(const struct patch *patch, int64_t iu, int64_t nu, int64_t iv,
                             int64_t nv, int64_t den, int64_t side)
{
    int64_t bu[4], bv[4], du[4], dv[4], at[3], along_u[3], along_v[3], n[3];
    bernstein(bu, iu, nu);
    bernstein(bv, iv, nv);
    bernstein_slope(du, iu, nu);
    bernstein_slope(dv, iv, nv);
    weigh(at, patch, bv, bu);
    weigh(along_u, patch, bv, du);
    weigh(along_v, patch, dv, bu);

    const int64_t scale = nu * nu * nu * nv * nv * nv;
    struct point out;
    const int64_t from[3] = { at[0], at[2] - MIDDLE * den * scale, -at[1] };
    for (int k = 0; k < 3; k++)
        out.pos[k] = gen_div(from[k] * STEPS / 1000, scale * den * (UNIT / 1000));

    gen_fit(along_u, (int64_t)1 << 29);
    gen_fit(along_v, (int64_t)1 << 29);
    gen_cross(n, along_u, along_v);
    if (n[0] == 0 && n[1] == 0 && n[2] == 0)
        n[2] = at[2] > MIDDLE * den * scale ? side : -side;
    out.normal[0] = side * n[0];
    out.normal[1] = side * n[2];
    out.normal[2] = side * -n[1];
    return out;
}

/* ---- Turned parts ---------------------------------------------------------------------------- */

static struct patch turned_patch(const struct turned_row row[4], int64_t num, int64_t den)
{
    struct patch out;
    for (int v = 0; v < 4; v++) {
        const int64_t r = row[v].r * num, c = row[v].c * num, z = row[v].z * den;
        const int64_t p[4][3] = { { r, 0, z }, { r, -c, z }, { c, -r, z }, { 0, -r, z } };
        for (int u = 0; u < 4; u++)
            for (int k = 0; k < 3; k++)
                out.p[v][u][k] = p[u][k];
    }
    return out;
}

/* Vertex i of a ring of n gets u so that the texture goes around in mirrored halves, `repeats` of it to each: no
 * seam. v in 64ths of the texture. */
static void cover(struct gen_mesh *m, uint32_t vertex, int64_t i, int64_t n, int64_t repeats, int64_t v)
{
    const int64_t half = i <= n / 2 ? i : n - i;
    gen_uv(m, vertex, gen_div(half * 2 * repeats << UV_BITS, n), v << UV_BITS >> 6);
}

/* One ring of 4 QUARTER vertices, or a single one where the profile meets the axis. Returns the
 * first one's number. */
static uint32_t turned_ring(struct gen_mesh *m, const struct patch *patch, int iv, int nv,
                            int64_t den, int64_t v)
{
    const uint32_t first = m->n_verts;
    for (int quarter = 0; quarter < 4; quarter++) {
        for (int iu = 0; iu < QUARTER; iu++) {
            struct point q = evaluate(patch, iu, QUARTER, iv, nv, den, 1);
            for (int turn = 0; turn < quarter; turn++) { /* mesh x -> z -> -x: exact */
                const int64_t x = q.pos[0], nx = q.normal[0];
                q.pos[0] = -q.pos[2];
                q.pos[2] = x;
                q.normal[0] = -q.normal[2];
                q.normal[2] = nx;
            }
            cover(m, gen_vert_normal(m, q.pos, q.normal, white), quarter * QUARTER + iu, 4 * QUARTER, 3, v);
            if (q.pos[0] == 0 && q.pos[2] == 0)
                return first;
        }
    }
    return first;
}

static void turned(struct gen_mesh *m, const struct turned_row *rows, const int *n_rows,
                   int n_segments, int64_t num, int64_t den, int64_t v)
{
    const uint32_t n = 4 * QUARTER;
    uint32_t upper = 0, n_upper = 0;
    for (int s = 0; s < n_segments; s++) {
        const struct patch patch = turned_patch(rows + 3 * s, num, den);
        for (int iv = s ? 1 : 0; iv <= n_rows[s]; iv++, v += 5) {
            const uint32_t lower = turned_ring(m, &patch, iv, n_rows[s], den, v);
            const uint32_t n_lower = m->n_verts - lower;
            for (uint32_t i = 0; n_upper && i < n; i++) {
                const uint32_t j = (i + 1) % n;
                if (n_lower > 1 && n_upper > 1) {
                    gen_tri(m, upper + i, upper + j, lower + i, white);
                    gen_tri(m, lower + i, upper + j, lower + j, white);
                } else if (n_lower > 1) {
                    gen_tri(m, upper, lower + j, lower + i, white);
                } else {
                    gen_tri(m, upper + i, upper + j, lower, white);
                }
            }
            upper = lower;
            n_upper = n_lower;
        }
    }
}

/* ---- Tubes ----------------------------------------------------------------------------------- */

static struct patch tube_patch(const struct tube_row row[4], int mirrored)
{
    struct patch out;
    for (int v = 0; v < 4; v++) {
        const struct tube_row *r = &row[v];
        const int64_t p[4][3] = { { r->x0, 0, r->z0 }, { r->x0, -r->w, r->z0 },
                                  { r->x1, -r->w, r->z1 }, { r->x1, 0, r->z1 } };
        for (int u = 0; u < 4; u++) {
            const int64_t *from = p[mirrored ? 3 - u : u];
            out.p[v][u][0] = from[0];
            out.p[v][u][1] = mirrored ? -from[1] : from[1];
            out.p[v][u][2] = from[2];
        }
    }
    return out;
}

static struct point tube_point(const struct tube_row row[4], uint32_t i, int iv, int nv,
                               int64_t side)
{
    const struct patch patch = tube_patch(row, i >= HALF);
    return evaluate(&patch, i % HALF, HALF, iv, nv, 1, side);
}

/* side: +1 where u x v points outwards. */
static void tube(struct gen_mesh *m, const struct tube_row *rows, const int *n_rows, int64_t side)
{
    const uint32_t n = 2 * HALF;
    for (int s = 0; s < 2; s++) {
        for (int iv = s ? 1 : 0; iv <= n_rows[s]; iv++) {
            const uint32_t now = m->n_verts;
            for (uint32_t i = 0; i < n; i++) {
                const struct point q = tube_point(rows + 3 * s, i, iv, n_rows[s], side);
                cover(m, gen_vert_normal(m, q.pos, q.normal, white), i, n, 1, (s * n_rows[0] + iv) * 5);
            }
            const uint32_t old = now - n;
            for (uint32_t i = 0; (s || iv) && i < n; i++) {
                const uint32_t j = (i + 1) % n;
                if (side > 0) {
                    gen_tri(m, old + i, old + j, now + i, white);
                    gen_tri(m, now + i, old + j, now + j, white);
                } else {
                    gen_tri(m, old + i, now + i, old + j, white);
                    gen_tri(m, now + i, now + j, old + j, white);
                }
            }
        }
    }
}

/* The level surface inside the spout's last ring: its vertices, zig-zag from end to end. */
static void tea(void)
{
    struct gen_mesh *m = gen_begin("tea");
    const int64_t up[3] = { 0, 1, 0 };
    for (uint32_t i = 0; i < 2 * HALF; i++) {
        const struct point q = tube_point(spout + 3, i, spout_rows[1], spout_rows[1], 1);
        gen_vert_normal(m, q.pos, up, white);
    }
    for (uint32_t lo = 0, hi = 2 * HALF - 1; lo + 1 < hi; lo++, hi--) {
        gen_tri(m, lo, lo + 1, hi, white);
        if (lo + 2 < hi)
            gen_tri(m, lo + 1, hi - 1, hi, white);
    }
    gen_write(m, GEN_NORMAL, 65536);
}

/* A round table: in the pot's shade under it, bright around it, and fading into the background, as
 * the scene lights it, at its edge. */
static void table(void)
{
    static const struct {
        int64_t radius; /* steps */
        struct gen_rgb rgb;
    } rings[] = {
        { 9000, { 12, 22, 52 } },
        { 14000, { 32, 54, 108 } },
        { 17000, { 46, 76, 144 } },
        { 23000, { 36, 60, 118 } },
        { 30500, { 17, 29, 68 } },
    };
    const uint32_t n = 4 * QUARTER, n_rings = sizeof rings / sizeof rings[0];
    const int64_t up[3] = { 0, 1, 0 }, y = -MIDDLE * STEPS / UNIT - 40;
    struct gen_mesh *m = gen_begin("table");
    const int64_t middle[3] = { 0, y, 0 };
    gen_vert_normal(m, middle, up, rings[0].rgb);
    for (uint32_t k = 0; k < n_rings; k++) {
        for (uint32_t i = 0; i < n; i++) {
            const int64_t a = (int64_t)i * 65536 / n;
            const int64_t pos[3] = { gen_div(gen_cos(a) * rings[k].radius, GEN_Q30), y,
                                     gen_div(gen_sin(a) * rings[k].radius, GEN_Q30) };
            gen_vert_normal(m, pos, up, rings[k].rgb);
        }
        const uint32_t out = 1 + k * n, in = out - n;
        for (uint32_t i = 0; i < n; i++) {
            const uint32_t j = (i + 1) % n;
            if (k == 0)
                gen_tri(m, 0, out + j, out + i, white);
            else
                gen_quad(m, in + i, in + j, out + j, out + i, white);
        }
    }
    gen_write(m, GEN_NORMAL | GEN_VERTEX_RGB, 65536);
}

/* Cobalt on white, symmetric in u: a lattice of lozenges with a flower in each, and a band. */
static void glaze(void)
{
    static const struct gen_rgb china = { 244, 242, 232 }, cobalt = { 26, 54, 150 }, sky = { 130, 164, 222 };
    static const struct gen_rgb gold = { 214, 170, 72 };
    struct gen_image *im = gen_image("glaze", 64, 64);
    for (int64_t y = 0; y < im->h; y++) {
        for (int64_t x = 0; x < im->w; x++) {
            const int64_t dx = x < 32 ? 31 - x : x - 32, dy = y < 32 ? 31 - y : y - 32; /* to the middle */
            const int64_t r = dx * dx + dy * dy, lattice = dx + dy;
            struct gen_rgb c = gen_mix(china, sky, (int64_t)(gen_hash((uint32_t)dx, (uint32_t)y, 5) % 3), 24);
            if (lattice >= 30 && lattice <= 32)
                c = cobalt;
            else if (lattice == 28 || lattice == 34)
                c = sky;
            else if (r < 14)
                c = gold;
            else if (r < 190 && (dx < 4 || dy < 4 || (dx > dy - 3 && dx < dy + 3 && r < 130)))
                c = r > 120 ? sky : cobalt;
            if (dx > 28 && dy > 28)
                c = gold;
            gen_dot(im, x, y, c);
        }
    }
    gen_texture(im, GEN_PAL8, GEN_REPEAT);
}

void gen_teapot(void)
{
    struct gen_mesh *m = gen_begin("teapot");
    m->uv_bits = UV_BITS;
    turned(m, lid, lid_rows, 2, LID_NUM, LID_DEN, 0);
    turned(m, pot, pot_rows, 4, 1, 1, 0);
    tube(m, handle, handle_rows, 1);
    tube(m, spout, spout_rows, 1);
    gen_write(m, GEN_NORMAL | GEN_UV, 65536);
    glaze();
    tea();
    table();
}
