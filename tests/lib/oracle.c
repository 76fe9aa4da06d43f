/* Oracles: see oracle.h.
 *
 * SPDX-License-Identifier: MIT
 */
#include "oracle.h"

#include <math.h>

/* ---- Snapped triangles ----------------------------------------------------------------------- */

/* > 0 where p is on the right of a -> b on a screen with y down. |.| < 2^46 for 2^22 coordinates */
static int64_t side(int64_t ax, int64_t ay, int64_t bx, int64_t by, int64_t px, int64_t py)
{
    return (bx - ax) * (py - ay) - (by - ay) * (px - ax);
}

int64_t oracle_area(const struct oracle_tri *t)
{
    return side(t->x[0], t->y[0], t->x[1], t->y[1], t->x[2], t->y[2]);
}

static int64_t edge_at(const struct oracle_tri *t, int a, int b, int i, int j)
{
    return side(t->x[a], t->y[a], t->x[b], t->y[b], (int64_t)i * 256 + 128, (int64_t)j * 256 + 128);
}

int oracle_covers(const struct oracle_tri *t, int i, int j)
{
    const int64_t area = oracle_area(t);
    if (area == 0)
        return 0;
    for (int k = 0; k < 3; k++) {
        const int a = area > 0 ? k : (k + 1) % 3, b = area > 0 ? (k + 1) % 3 : k;
        const int64_t e = edge_at(t, a, b, i, j);
        const int64_t dx = t->x[b] - t->x[a], dy = t->y[b] - t->y[a];
        const int top = dy == 0 && dx > 0, left = dy < 0;
        if (e < 0 || (e == 0 && !top && !left))
            return 0;
    }
    return 1;
}

int oracle_on_edge(const struct oracle_tri *t, int i, int j)
{
    const int64_t px = (int64_t)i * 256 + 128, py = (int64_t)j * 256 + 128;
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3;
        const int64_t x0 = t->x[a] < t->x[b] ? t->x[a] : t->x[b], x1 = t->x[a] + t->x[b] - x0;
        const int64_t y0 = t->y[a] < t->y[b] ? t->y[a] : t->y[b], y1 = t->y[a] + t->y[b] - y0;
        if (edge_at(t, a, b, i, j) == 0 && px >= x0 && px <= x1 && py >= y0 && py <= y1)
            return 1;
    }
    return 0;
}

void oracle_weights(const struct oracle_tri *t, int i, int j, int64_t out[3])
{
    const int64_t sign = oracle_area(t) < 0 ? -1 : 1;
    for (int k = 0; k < 3; k++)
        out[k] = sign * edge_at(t, (k + 1) % 3, (k + 2) % 3, i, j);
}

double oracle_key_error(const struct oracle_tri *t, const uint32_t d[3], int i, int j, uint32_t key,
                        uint32_t most)
{
    int64_t w[3], area = oracle_area(t);
    area = area < 0 ? -area : area;
    oracle_weights(t, i, j, w);
    __int128 sum = 0; /* exact value * area, uq16_16 */
    for (int k = 0; k < 3; k++)
        sum += (__int128)w[k] * d[k];
    const __int128 limit = (__int128)area * most * 65536;
    if (sum > limit)
        sum = limit;
    const __int128 off = (__int128)area * key * 65536 - sum;
    return (double)off / ((double)area * 65536.0);
}

/* ---- Float keys ------------------------------------------------------------------------------ */

/* A code is 2^bits - key. With j = 2^e - 2 - k it is j 2^m + r 2^(k + 1 + m), the second term at
 * most 2^(m + 1): so j = 0 up to 2^(m + 1), then one more every 2^m. */

static int mantissa(const struct oracle_float *f)
{
    return f->bits - f->e;
}

static int k_most(const struct oracle_float *f)
{
    return (1 << f->e) - 2;
}

int oracle_float_scale(const struct oracle_float *f)
{
    return k_most(f) + 1 + mantissa(f) + 16;
}

uint64_t oracle_float_r(const struct oracle_float *f, uint32_t d)
{
    const int m = mantissa(f) + 16;
    const uint64_t code = ((uint64_t)1 << (f->bits + 16)) - d; /* 16 fraction bits */
    int64_t j = (int64_t)(code >> m) - 1;
    j = j < 0 ? 0 : j > k_most(f) ? k_most(f) : j;
    /* r 2^(k + 1 + m) = code - j 2^m, and k = k_most - j */
    return (code - ((uint64_t)j << m)) << j;
}

double oracle_float_key(const struct oracle_float *f, double r)
{
    int k = 0;
    while (k < k_most(f) && ldexp(r, k + 1) < 1)
        k++;
    return ldexp(1, f->bits) - ldexp(k_most(f) - k, mantissa(f)) - ldexp(r, k + 1 + mantissa(f));
}

uint32_t oracle_float_d(const struct oracle_float *f, double r)
{
    const double d = floor(oracle_float_key(f, r) * 65536 + 0.5),
                 most = (ldexp(1, f->bits) - 1) * 65536;
    return (uint32_t)(d < 0 ? 0 : d > most ? most : d);
}

/* The plane's r at a sample as sum / (area 2^scale), and the j of it. */
static __int128 float_sum(const struct oracle_float *f, const struct oracle_tri *t,
                          const uint32_t d[3], int i, int j, int64_t *area, int *octave)
{
    int64_t w[3];
    __int128 sum = 0; /* < 2^45 * 2^58 */
    oracle_weights(t, i, j, w);
    *area = oracle_area(t);
    *area = *area < 0 ? -*area : *area;
    for (int k = 0; k < 3; k++)
        sum += (__int128)w[k] * (__int128)oracle_float_r(f, d[k]);
    int n = 0; /* r <= 2^-k is sum 2^k <= area 2^scale */
    while (n < k_most(f) && sum <= (__int128)*area << (oracle_float_scale(f) - n - 1))
        n++;
    *octave = k_most(f) - n;
    return sum;
}

/* (key - exact) as num / den: key - 2^bits + j 2^m + r 2^(k + 1 + m), r = sum / (area 2^scale). */
static __int128 float_off(const struct oracle_float *f, const struct oracle_tri *t,
                          const uint32_t d[3], int i, int j, uint32_t key, __int128 *den)
{
    int64_t area;
    int octave;
    const __int128 sum = float_sum(f, t, d, i, j, &area, &octave);
    const int64_t whole = (int64_t)key - ((int64_t)1 << f->bits) + ((int64_t)octave << mantissa(f));
    *den = (__int128)area << (octave + 16); /* scale - (k + 1 + m) */
    return whole * *den + sum;
}

long double oracle_float_plane(const struct oracle_float *f, const struct oracle_tri *t,
                               const uint32_t d[3], int i, int j)
{
    __int128 den;
    const __int128 off = float_off(f, t, d, i, j, 0, &den);
    return -(long double)off / (long double)den;
}

double oracle_float_error(const struct oracle_float *f, const struct oracle_tri *t,
                          const uint32_t d[3], int i, int j, uint32_t key)
{
    __int128 den;
    const uint32_t most = (1u << f->bits) - 2u;
    if (float_off(f, t, d, i, j, most, &den) < 0) /* exact > most */
        return (double)key - most;
    const __int128 off = float_off(f, t, d, i, j, key, &den);
    return (double)((long double)off / (long double)den);
}

/* ---- Unsnapped polygons in eye space --------------------------------------------------------- */

/* Keep the part of a polygon where sign * (z - at) >= 0. */
static int clip_z(struct oracle_point *p, int n, double at, double sign)
{
    struct oracle_point out[ORACLE_POLYGON_MAX];
    int kept = 0;
    for (int i = 0; i < n; i++) {
        const struct oracle_point a = p[i], b = p[(i + 1) % n];
        const double da = sign * (a.z - at), db = sign * (b.z - at);
        if (da >= 0)
            out[kept++] = a;
        if ((da > 0 && db < 0) || (da < 0 && db > 0)) {
            const double s = da / (da - db);
            const struct oracle_point c = { a.x + (b.x - a.x) * s, a.y + (b.y - a.y) * s, at };
            out[kept++] = c;
        }
    }
    for (int i = 0; i < kept; i++)
        p[i] = out[i];
    return kept;
}

static void plane_through(const struct oracle_view *v, const struct oracle_point t[3],
                          struct oracle_polygon *out)
{
    /* n . p = c in eye space; with x = (X - cx) z / f, y = (cy - Y) z / f it is linear in 1/z */
    const double ux = t[1].x - t[0].x, uy = t[1].y - t[0].y, uz = t[1].z - t[0].z;
    const double vx = t[2].x - t[0].x, vy = t[2].y - t[0].y, vz = t[2].z - t[0].z;
    const double nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
    const double c = nx * t[0].x + ny * t[0].y + nz * t[0].z;
    const double cx = v->width / 2, cy = v->height / 2;
    if (v->focal > 0) {
        out->qx = nx / (v->focal * c);
        out->qy = -ny / (v->focal * c);
        out->q0 = nz / c - out->qx * cx - out->qy * cy;
    } else {
        out->qx = -nx / (v->scale * nz);
        out->qy = ny / (v->scale * nz);
        out->q0 = c / nz - out->qx * cx - out->qy * cy;
    }
}

void oracle_project(const struct oracle_view *v, const struct oracle_point *p, int n,
                    struct oracle_polygon *out)
{
    struct oracle_point c[ORACLE_POLYGON_MAX];
    for (int i = 0; i < n; i++)
        c[i] = p[i];
    n = clip_z(c, n, v->z_near, 1);
    n = clip_z(c, n, v->z_far, -1);
    out->n = n < 3 ? 0 : n;
    out->area = 0;
    for (int i = 0; i < out->n; i++) {
        const double s = v->focal > 0 ? v->focal / c[i].z : v->scale;
        out->x[i] = v->width / 2 + c[i].x * s;
        out->y[i] = v->height / 2 - c[i].y * s;
        out->q[i] = v->focal > 0 ? 1 / c[i].z : c[i].z;
    }
    for (int i = 1; i + 1 < out->n; i++)
        out->area += (out->x[i] - out->x[0]) * (out->y[i + 1] - out->y[0]) -
                     (out->y[i] - out->y[0]) * (out->x[i + 1] - out->x[0]);
    plane_through(v, p, out);
}

double oracle_inside(const struct oracle_polygon *p, int i, int j)
{
    double least = 1e30;
    if (p->n == 0 || p->area == 0)
        return -1e30;
    for (int a = 0; a < p->n; a++) {
        const int b = (a + 1) % p->n;
        const double dx = p->x[b] - p->x[a], dy = p->y[b] - p->y[a], length = hypot(dx, dy);
        if (length < 1e-12)
            continue;
        const double e = (dx * (j + 0.5 - p->y[a]) - dy * (i + 0.5 - p->x[a])) / length;
        const double d = p->area > 0 ? e : -e;
        if (d < least)
            least = d;
    }
    return least;
}

double oracle_z(const struct oracle_view *v, const struct oracle_polygon *p, int i, int j)
{
    const double q = p->q0 + p->qx * (i + 0.5) + p->qy * (j + 0.5);
    return v->focal > 0 ? 1 / q : q;
}

double oracle_key(const struct oracle_view *v, double z, int mapping, int bits)
{
    const double n = v->z_near, f = v->z_far, top = ldexp(1, bits) - 1;
    const struct oracle_float as_float = { mapping, bits };
    if (mapping > 1)
        return oracle_float_key(&as_float, n / z);
    return mapping == 1 ? (z - n) / (f - n) * top : (1 / n - 1 / z) / (1 / n - 1 / f) * top;
}

double oracle_key_slack(const struct oracle_view *v, const struct oracle_polygon *p, int i, int j,
                        int mapping, int bits, double px)
{
    const double z = oracle_z(v, p, i, j), dq = (fabs(p->qx) + fabs(p->qy)) * px;
    const double dz = v->focal > 0 ? z * z * dq : dq;
    const double lo = fmax(z - dz, v->z_near), hi = fmin(z + dz, v->z_far);
    return fabs(oracle_key(v, hi, mapping, bits) - oracle_key(v, lo, mapping, bits));
}
