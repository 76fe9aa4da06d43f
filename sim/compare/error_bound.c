/* How far the integer renderer may be from the reference at a pixel: see error_bound.h.
 *
 * A triangle is clipped in space at near and far, projected, and compared in doubles. The plane and
 * the attributes come from the unclipped triangle, by homogeneous coordinates: with corners v = (X,
 * Y, w) such that the screen position is (X / w, Y / w), and lines l_k = v_(k+1) x v_(k+2), a
 * sample s = (x, y, 1) has the weights l_k . s / det, whose sum is 1 / w.
 *
 * SPDX-License-Identifier: MIT
 */
#include "error_bound.h"

#include <math.h>
#include <string.h>

#include "vec.h"

#define CORNERS_MAX 5
#define UNITS 3.0       /* camera units that a corner may be off by */
#define SEPARATION 1.01 /* buckets: twice 0.505 */

struct place { /* a triangle on the screen; px from the image's centre, y down */
    int n;     /* corners between near and far */
    double x[CORNERS_MAX], y[CORNERS_MAX], q[CORNERS_MAX]; /* q = 1 / z, or where orthographic 1 */
    double line[3][3], z[3];
    double det;
};

static void to_eye(const struct ref_camera *c, const double p[3], double out[3])
{
    double rel[3];
    sim_sub(rel, p, c->eye);
    out[0] = sim_dot(rel, c->right);
    out[1] = sim_dot(rel, c->up);
    out[2] = -sim_dot(rel, c->back);
}

/* Pixels to a world unit; perspective: at distance 1. */
static double scale_of(const struct sim_judge *j)
{
    return j->camera->orthographic ? j->height / j->camera->height : j->camera->focal;
}

static int clip(double p[][3], int n, double at, double sign)
{
    double out[CORNERS_MAX][3];
    int kept = 0;
    for (int i = 0; i < n; i++) {
        const double *a = p[i], *b = p[(i + 1) % n];
        const double da = sign * (a[2] - at), db = sign * (b[2] - at);
        if (da >= 0)
            memcpy(out[kept++], a, sizeof out[0]);
        if ((da > 0 && db < 0) || (da < 0 && db > 0)) {
            const double s = da / (da - db);
            out[kept][0] = a[0] + (b[0] - a[0]) * s;
            out[kept][1] = a[1] + (b[1] - a[1]) * s;
            out[kept++][2] = at;
        }
    }
    memcpy(p, out, (size_t)kept * sizeof out[0]);
    return kept;
}

static void place_lines(struct place *p, double v[3][3])
{
    for (int k = 0; k < 3; k++)
        sim_cross(p->line[k], v[(k + 1) % 3], v[(k + 2) % 3]);
    p->det = sim_dot(v[0], p->line[0]);
}

static void place_make(const struct sim_judge *j, uint32_t id, struct place *p)
{
    const struct ref_triangle *t = &j->tri[id - 1];
    const struct ref_camera *camera = j->camera;
    const double scale = scale_of(j);
    double c[CORNERS_MAX][3], v[3][3];
    for (int k = 0; k < 3; k++) {
        to_eye(camera, t->p[k], c[k]);
        p->z[k] = c[k][2];
        v[k][0] = c[k][0] * scale;
        v[k][1] = -c[k][1] * scale;
        v[k][2] = camera->orthographic ? 1 : c[k][2];
    }
    place_lines(p, v);
    p->n = clip(c, 3, camera->near_z, 1);
    p->n = clip(c, p->n, camera->far_z, -1);
    for (int k = 0; k < p->n; k++) {
        p->q[k] = camera->orthographic ? 1 : 1 / c[k][2];
        p->x[k] = c[k][0] * scale * p->q[k];
        p->y[k] = -c[k][1] * scale * p->q[k];
    }
}

/* Weights of the corners in space at a point of the screen; their sum is 1. Return 1 / w there. */
static double weights(const struct place *p, double x, double y, double out[3])
{
    double sum = 0;
    for (int k = 0; k < 3; k++) {
        out[k] = p->line[k][0] * x + p->line[k][1] * y + p->line[k][2];
        sum += out[k];
    }
    for (int k = 0; k < 3; k++)
        out[k] /= sum;
    return sum / p->det;
}

/* How far corners at this 1 / z may be off, px along an axis. */
static double shift_of(const struct sim_judge *j, double q)
{
    return j->sub_pixel / 2 + UNITS * j->unit * scale_of(j) * q;
}

/* 1: inside the outline; *edge: within the tolerance of it. */
static int inside(const struct sim_judge *j, const struct place *p, double x, double y, int *edge)
{
    int crossings = 0;
    for (int a = 0; a < p->n; a++) {
        const int b = (a + 1) % p->n;
        const double dx = p->x[b] - p->x[a], dy = p->y[b] - p->y[a], square = dx * dx + dy * dy;
        double s = square > 0 ? ((x - p->x[a]) * dx + (y - p->y[a]) * dy) / square : 0;
        s = s < 0 ? 0 : s > 1 ? 1 : s;
        const double away = hypot(p->x[a] + s * dx - x, p->y[a] + s * dy - y);
        const double q = p->q[a] + s * (p->q[b] - p->q[a]);
        /* a whole sub-pixel: snapping moves a corner by its half diagonal at most */
        if (away <= j->sub_pixel + 1.5 * (shift_of(j, q) - j->sub_pixel / 2))
            *edge = 1;
        if ((p->y[a] > y) != (p->y[b] > y))
            crossings += x < p->x[a] + (y - p->y[a]) / dy * dx;
    }
    return crossings & 1;
}

static double clamped_key(const struct sim_judge *j, double z)
{
    const double top = ldexp(1, j->depth->bits) - 2;
    const double n = j->camera->near_z, f = j->camera->far_z;
    const double key = ref_exact_key(j->depth, j->camera, z < n ? n : z > f ? f : z);
    return key < 0 ? 0 : key > top ? top : key;
}

/* The key at a sample and how much it may be off. */
static double key_at(const struct sim_judge *j, const struct place *p, double x, double y,
                     double *slack)
{
    double w[3], gx = 0, gy = 0, lo, hi, z;
    const double q = weights(p, x, y, w);
    *slack = (double)INFINITY;
    if (p->n < 3 || p->det == 0 || !isfinite(q) || q <= 0)
        return 0;
    if (j->camera->orthographic) {
        z = w[0] * p->z[0] + w[1] * p->z[1] + w[2] * p->z[2];
        for (int k = 0; k < 3; k++) {
            gx += p->line[k][0] * p->z[k] / p->det;
            gy += p->line[k][1] * p->z[k] / p->det;
        }
        const double off = (fabs(gx) + fabs(gy)) * shift_of(j, 1) + (UNITS + 0.5) * j->unit;
        lo = z - off;
        hi = z + off;
    } else {
        double most = 0;
        for (int k = 0; k < p->n; k++)
            most = fmax(most, p->q[k]);
        z = 1 / q;
        for (int k = 0; k < 3; k++) {
            gx += p->line[k][0] / p->det;
            gy += p->line[k][1] / p->det;
        }
        /* 1 / z of the corners is off by UNITS unit / z^2 each, near by half a unit */
        const double off = (fabs(gx) + fabs(gy)) * shift_of(j, q) + UNITS * j->unit * q * most +
                           0.5 * j->unit * q / j->camera->near_z;
        hi = q > off ? 1 / (q - off) : (double)INFINITY;
        lo = 1 / (q + off);
    }
    const double key = clamped_key(j, z);
    *slack = fmax(clamped_key(j, hi) - key, key - clamped_key(j, lo)) + 3e-4; /* stored to 2^-16 */
    return key;
}

static double sample_x(const struct sim_judge *j, int x)
{
    return x + 0.5 - j->width / 2.0;
}

static double sample_y(const struct sim_judge *j, int y)
{
    return y + 0.5 - j->height / 2.0;
}

/* 1: the same triangle, b beginning with corner `turn` of a. */
static int same_corners(const struct ref_triangle *a, const struct ref_triangle *b, int turn)
{
    for (int k = 0; k < 9; k++) {
        const double p = a->p[k / 3][k % 3], q = b->p[(k / 3 + turn) % 3][k % 3];
        if (p < q || p > q)
            return 0;
    }
    return 1;
}

/* Of a triangle that is there twice the first is seen. Begun with another corner, its pieces after
 * a cut may be others, and their keys a bucket apart. */
static enum sim_verdict twice(const struct sim_judge *j, uint32_t ours, uint32_t truth,
                              enum sim_verdict otherwise)
{
    const struct ref_triangle *a = &j->tri[ours - 1], *b = &j->tri[truth - 1];
    if (same_corners(a, b, 0))
        return ours < truth ? SIM_SAME : SIM_WRONG;
    return ours < truth && (same_corners(a, b, 1) || same_corners(a, b, 2)) ? SIM_SAME : otherwise;
}

enum sim_verdict sim_judge_pixel(const struct sim_judge *j, uint32_t ours, uint32_t truth, int x,
                                 int y)
{
    const uint32_t id[2] = { ours, truth };
    const double sx = sample_x(j, x), sy = sample_y(j, y);
    double key[2] = { 0 }, slack[2] = { 0 };
    int covered = 1, edge = 0;
    if (ours == truth)
        return SIM_SAME;
    for (int k = 0; k < 2; k++) {
        struct place p;
        if (id[k] == 0) {
            covered = 0;
            continue;
        }
        place_make(j, id[k], &p);
        covered &= inside(j, &p, sx, sy, &edge);
        key[k] = key_at(j, &p, sx, sy, &slack[k]);
    }
    const int tie = covered && fabs(key[0] - key[1]) <= SEPARATION + slack[0] + slack[1];
    const enum sim_verdict verdict = edge ? SIM_EDGE : tie ? SIM_TIE : SIM_WRONG;
    return ours && truth ? twice(j, ours, truth, verdict) : verdict;
}

double sim_judge_key_slack(const struct sim_judge *j, uint32_t id, int x, int y)
{
    struct place p;
    double slack;
    place_make(j, id, &p);
    (void)key_at(j, &p, sample_x(j, x), sample_y(j, y), &slack);
    return slack;
}

/* The unit normal of the side that turns counter-clockwise; the largest side's length. */
static double plane_normal(const struct ref_triangle *t, double n[3])
{
    double u[3], v[3];
    sim_sub(u, t->p[1], t->p[0]);
    sim_sub(v, t->p[2], t->p[0]);
    sim_cross(n, u, v);
    (void)sim_unit(n);
    return sqrt(fmax(sim_dot(u, u), sim_dot(v, v)));
}

int sim_judge_same_plane(const struct ref_triangle *a, const struct ref_triangle *b)
{
    double n[3], other[3], rel[3];
    const double size = fmax(plane_normal(b, other), plane_normal(a, n));
    for (int k = 0; k < 3; k++) {
        sim_sub(rel, b->p[k], a->p[0]);
        if (fabs(sim_dot(rel, n)) > 1e-6 * size)
            return 0;
    }
    return sim_dot(n, other) > 0.5;
}

double sim_judge_unit(const struct ref_triangle *tri, size_t n, const struct ref_camera *camera)
{
    double reach = fabs(camera->near_z);
    for (size_t i = 0; i < n; i++)
        for (int k = 0; k < 3; k++) {
            double c[3];
            to_eye(camera, tri[i].p[k], c);
            for (int a = 0; a < 3; a++)
                reach = fmax(reach, fabs(c[a]));
        }
    return reach * 2 * 0x1p-28; /* an instance's sphere reaches further than its corners */
}

/* ---- Attributes ----------------------------------------------------------------------------- */

static double intensity_of(const struct ref_light *light, const double n[3])
{
    return light->ambient + light->diffuse * fmax(0, sim_dot(n, light->dir));
}

/* Range of an attribute with these values at the corners over the box that snapping may reach: it
 * is a quotient of linear functions, so its ends are at the box's corners, and within the corners'
 * range. */
static void range(const struct sim_judge *j, const struct place *p, double x, double y,
                  const double value[3], double *lo, double *hi)
{
    double w[3];
    const double q = weights(p, x, y, w);
    const double shift = shift_of(j, j->camera->orthographic ? 1 : q);
    const double least = fmin(value[0], fmin(value[1], value[2]));
    const double most = fmax(value[0], fmax(value[1], value[2]));
    *lo = most;
    *hi = least;
    for (int k = 0; k < 4; k++) {
        const double at = weights(p, x + (k & 1 ? shift : -shift), y + (k & 2 ? shift : -shift), w);
        double v = w[0] * value[0] + w[1] * value[1] + w[2] * value[2];
        if (!isfinite(v) || at * q <= 0) { /* beyond the horizon: anything */
            *lo = least;
            *hi = most;
            return;
        }
        v = v < least ? least : v > most ? most : v;
        *lo = fmin(*lo, v);
        *hi = fmax(*hi, v);
    }
}

static void corner_light(const struct sim_judge *j, const struct ref_triangle *t, double out[3])
{
    double n[3];
    (void)plane_normal(t, n);
    if (t->has_face_n)
        memcpy(n, t->face_n, sizeof n);
    for (int k = 0; k < 3; k++)
        switch (t->shade) {
        case REF_SHADE_FLAT:
        case REF_SHADE_TEXTURE_FLAT: out[k] = intensity_of(j->light, n); break;
        case REF_SHADE_SMOOTH:
        case REF_SHADE_TEXTURE_SMOOTH: out[k] = intensity_of(j->light, t->n[k]); break;
        default: out[k] = 1;
        }
}

void sim_judge_color(const struct sim_judge *j, uint32_t id, int x, int y, double lo[3],
                     double hi[3])
{
    static const double most[3] = { 31, 63, 31 };
    const struct ref_triangle *t = &j->tri[id - 1];
    const double raw[3] = { t->raw >> 11, t->raw >> 5 & 63, t->raw & 31 };
    double light[3];
    struct place p;
    place_make(j, id, &p);
    corner_light(j, t, light);
    for (int c = 0; c < 3; c++) {
        double value[3];
        for (int k = 0; k < 3; k++) {
            const double base = t->rgb[t->shade == REF_SHADE_SMOOTH ? k : 0][c];
            value[k] = t->shade == REF_SHADE_RAW ? raw[c] : fmin(base * light[k], 1) * most[c];
        }
        range(j, &p, sample_x(j, x), sample_y(j, y), value, &lo[c], &hi[c]);
    }
}

double sim_judge_texture(const struct sim_judge *j, uint32_t id, int x, int y, double light[2],
                         double lo[2], double hi[2])
{
    const struct ref_triangle *t = &j->tri[id - 1];
    double value[3];
    struct place p;
    place_make(j, id, &p);
    corner_light(j, t, value);
    range(j, &p, sample_x(j, x), sample_y(j, y), value, &light[0], &light[1]);
    for (int axis = 0; axis < 2; axis++) {
        for (int k = 0; k < 3; k++)
            value[k] = t->uv[k][axis] * (axis ? t->texture->height : t->texture->width);
        range(j, &p, sample_x(j, x), sample_y(j, y), value, &lo[axis], &hi[axis]);
    }
    double least = (double)INFINITY, most = 0;
    for (int k = 0; k < p.n; k++) {
        least = fmin(least, p.q[k]);
        most = fmax(most, p.q[k]);
    }
    return p.n ? most / least : 1;
}
