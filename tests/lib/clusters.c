/* Clusters of a mesh as it is: see clusters.h.
 *
 * SPDX-License-Identifier: MIT
 */
#include "clusters.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void corner(double out[3], const struct zs_mesh *m, uint32_t t, int k)
{
    const uint32_t v = m->tri[t][k];
    for (int j = 0; j < 3; j++)
        out[j] = m->pos[v][j] + (m->pos_lo ? m->pos_lo[v][j] / 256.0 : 0.0);
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* The normal, any length; its triangle's least height, or HUGE_VAL where two corners are one point. */
static double normal_of(double out[3], const struct zs_mesh *m, uint32_t t)
{
    double c[3][3], longest = 0.0;
    int point = 0;
    for (int k = 0; k < 3; k++)
        corner(c[k], m, t, k);
    for (int k = 0; k < 3; k++) {
        double side[3];
        for (int j = 0; j < 3; j++)
            side[j] = c[k][j] - c[(k + 1) % 3][j];
        longest = fmax(longest, dot(side, side));
        point |= dot(side, side) == 0.0;
    }
    for (int j = 0; j < 3; j++) {
        const int a = (j + 1) % 3, b = (j + 2) % 3;
        out[j] = (c[1][a] - c[0][a]) * (c[2][b] - c[0][b]) - (c[1][b] - c[0][b]) * (c[2][a] - c[0][a]);
    }
    return point ? HUGE_VAL : sqrt(dot(out, out) / longest);
}

static void sphere(struct zs_cluster *c, const struct zs_mesh *m)
{
    double lo[3] = { 1e9, 1e9, 1e9 }, hi[3] = { -1e9, -1e9, -1e9 }, most = 0.0;
    for (uint32_t t = c->first; t < c->first + c->n_tris; t++)
        for (int k = 0; k < 3; k++) {
            double p[3];
            corner(p, m, t, k);
            for (int j = 0; j < 3; j++) {
                lo[j] = fmin(lo[j], p[j]);
                hi[j] = fmax(hi[j], p[j]);
            }
        }
    for (int j = 0; j < 3; j++)
        c->center[j] = (int16_t)fmin(rint((lo[j] + hi[j]) / 2.0), 32767.0);
    for (uint32_t t = c->first; t < c->first + c->n_tris; t++)
        for (int k = 0; k < 3; k++) {
            double p[3];
            corner(p, m, t, k);
            for (int j = 0; j < 3; j++)
                p[j] -= c->center[j];
            most = fmax(most, dot(p, p));
        }
    c->radius = (uint16_t)fmin(ceil(sqrt(most) + 1e-6), 65535.0);
}

/* C = |A| times the sine of the widest angle between A, rounded, and a normal: |N x A|, rounded up. */
static void cone(struct zs_cluster *c, const struct zs_mesh *m)
{
    double sum[3] = { 0.0, 0.0, 0.0 }, least = HUGE_VAL, sine = 0.0;
    for (uint32_t t = c->first; t < c->first + c->n_tris; t++) {
        double n[3];
        least = fmin(least, normal_of(n, m, t));
        const double length = sqrt(dot(n, n));
        for (int j = 0; j < 3 && length > 0.0; j++)
            sum[j] += n[j] / length;
    }
    c->height = (uint16_t)floor(fmin(least * 16.0 * (1.0 - 1e-9), 65535.0));
    c->cutoff = 127;
    const double length = sqrt(dot(sum, sum));
    if (length < 1e-3)
        return;
    for (int j = 0; j < 3; j++)
        c->axis[j] = (int8_t)rint(127.0 * sum[j] / length);
    for (uint32_t t = c->first; t < c->first + c->n_tris; t++) {
        double n[3], across[3];
        (void)normal_of(n, m, t);
        const double size = sqrt(dot(n, n));
        if (size == 0.0)
            continue;
        for (int j = 0; j < 3; j++) {
            const int a = (j + 1) % 3, b = (j + 2) % 3;
            across[j] = (n[a] * c->axis[b] - n[b] * c->axis[a]) / size;
        }
        if (n[0] * c->axis[0] + n[1] * c->axis[1] + n[2] * c->axis[2] <= 0.0)
            return;
        sine = fmax(sine, sqrt(dot(across, across)));
    }
    c->cutoff = (int8_t)fmin(ceil(sine + 1e-6), 127.0);
}

void clusters_make(struct zs_mesh *mesh, struct zs_cluster *out, struct prng *p, uint32_t most, uint32_t loose)
{
    uint32_t n = 0, flawed;
    memset(out, 0, mesh->n_tris * sizeof *out);
    for (uint32_t t = 0; t < mesh->n_tris; t += out[n++].n_tris) {
        struct zs_cluster *c = &out[n];
        const uint32_t size = 1 + prng_pick(p, most), left = mesh->n_tris - t;
        c->first = t;
        c->n_tris = (uint16_t)(size < left ? size : left);
        sphere(c, mesh);
        cone(c, mesh);
        if (loose && !prng_pick(p, loose)) {
            c->radius = (uint16_t)(c->radius + prng_pick(p, 65536u - c->radius) / (1u + prng_pick(p, 100)));
            c->height = (uint16_t)(prng_pick(p, 2) ? c->height / (1u + prng_pick(p, 9)) : 0);
            c->cutoff = (int8_t)(c->cutoff + (int8_t)prng_pick(p, 128u - (uint32_t)c->cutoff));
        }
    }
    mesh->cluster = out;
    mesh->n_clusters = n;
    for (enum zs_flaw flaw; (flaw = zs_mesh_check(mesh, &flawed)) != ZS_FLAW_NONE;) {
        if (flaw != ZS_FLAW_CLUSTER_CONE || out[flawed].cutoff == 127)
            abort();
        out[flawed].cutoff++;
    }
}
