/* What a triangle must look like, by int64, rational and double arithmetic. Shares nothing with
 * firmware/: written from the conventions alone.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef TESTS_ORACLE_H
#define TESTS_ORACLE_H

#include <stdint.h>

/* ---- Snapped triangles ---------------------------------------------------------------------- */

struct oracle_tri {
    int64_t x[3], y[3]; /* 1/256 px, y down */
};

/* Twice the area, 2^-16 px^2, > 0 where the corners turn clockwise on the screen. */
int64_t oracle_area(const struct oracle_tri *t);
/* 1: the sample in the middle of pixel (i, j) belongs to the triangle by the top-left rule,
 * whichever way its corners turn. */
int oracle_covers(const struct oracle_tri *t, int i, int j);
/* 1: that sample lies exactly on the line through two of the corners, between them. */
int oracle_on_edge(const struct oracle_tri *t, int i, int j);
/* Barycentric weights of that sample; their sum is |oracle_area|. */
void oracle_weights(const struct oracle_tri *t, int i, int j, int64_t out[3]);
/* key - (exact value of the plane through the corners' d, at most most * 65536) / 65536, in
 * buckets. d in uq16_16. Exact but for the last conversion to double. */
double oracle_key_error(const struct oracle_tri *t, const uint32_t d[3], int i, int j, uint32_t key,
                        uint32_t most);

/* ---- Float keys: near / z as a float of e exponent bits, taken from 2^bits ------------------ */

struct oracle_float {
    int e, bits; /* 2 .. 5, 8 .. 16 */
};

/* near / z that a corner's stored key d (uq16_16, at most (2^bits - 1) << 16) stands for, exactly,
 * times 2^oracle_float_scale: at most 2^58. */
uint64_t oracle_float_r(const struct oracle_float *f, uint32_t d);
int oracle_float_scale(const struct oracle_float *f);
/* The d of r = near / z, nearest, saturated; 0 < r <= 1. */
uint32_t oracle_float_d(const struct oracle_float *f, double r);
/* The exact key, unrounded and not saturated, of the plane in near / z through the corners. Exact
 * but for the conversion (64-bit mantissa). */
long double oracle_float_plane(const struct oracle_float *f, const struct oracle_tri *t,
                               const uint32_t d[3], int i, int j);
/* key - that, the latter at most 2^bits - 2: as oracle_key_error. */
double oracle_float_error(const struct oracle_float *f, const struct oracle_tri *t,
                          const uint32_t d[3], int i, int j, uint32_t key);
/* The key, unrounded, of r = near / z. */
double oracle_float_key(const struct oracle_float *f, double r);

/* ---- Unsnapped polygons in eye space -------------------------------------------------------- */

struct oracle_view {
    double focal;        /* px; 0: orthographic, scale px to a unit */
    double scale;
    double width, height; /* px */
    double z_near, z_far; /* distances */
};

struct oracle_point {
    double x, y, z; /* eye space: right, up, distance */
};

#define ORACLE_POLYGON_MAX 16

/* On the screen. x, y in px, y down; q is linear on the screen: 1/z, or z where orthographic. */
struct oracle_polygon {
    int n;
    double x[ORACLE_POLYGON_MAX], y[ORACLE_POLYGON_MAX], q[ORACLE_POLYGON_MAX];
    double area;       /* twice; > 0 clockwise on the screen */
    double q0, qx, qy; /* q = q0 + qx x + qy y, screen px */
};

/* Clip a convex, flat polygon of n <= 8 corners at near and far and project it; out->n is 0 where
 * nothing is left. */
void oracle_project(const struct oracle_view *v, const struct oracle_point *p, int n,
                    struct oracle_polygon *out);
/* How far the sample of pixel (i, j) is inside, px; negative outside. Exact to 1e-9 px. */
double oracle_inside(const struct oracle_polygon *p, int i, int j);
/* Distance along the view axis at the sample. */
double oracle_z(const struct oracle_view *v, const struct oracle_polygon *p, int i, int j);
/* The key, unrounded, of a distance. mapping: 0 reciprocal, 1 linear, 3 .. 5 float of so many
 * exponent bits. */
double oracle_key(const struct oracle_view *v, double z, int mapping, int bits);
/* How much the key may be off at the sample where corners are off by `px`. */
double oracle_key_slack(const struct oracle_view *v, const struct oracle_polygon *p, int i, int j,
                        int mapping, int bits, double px);

#endif
