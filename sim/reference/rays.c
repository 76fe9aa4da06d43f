/* rays.c - see rays.h.
 *
 * A hit is that of Moeller and Trumbore (1997), in plain doubles: samples that lie on an edge to
 * 1e-14 or so may be given to both sides or to none, other than in reference.c.
 *
 * SPDX-License-Identifier: MIT
 */
#include "rays.h"

#include <stdlib.h>
#include <string.h>

#include "vec.h"

#define LEAF 4u
#define NONE SIZE_MAX
#define OFF 1e-9 /* of the distance: how far from a surface its own rays begin */

/* In preorder. A leaf holds item[first .. first + count). */
struct node {
    double lo[3], hi[3];
    size_t first, count; /* count 0: not a leaf */
    size_t skip;         /* the next node that is not below it */
};

struct caster {
    const struct ref_triangle *triangle;
    const struct ref_camera *camera;
    const struct ref_light *light;
    struct ref_rays *rays;
    struct node *node;
    size_t n_nodes, *item;
    double background[3];
};

struct ray {
    double from[3], to[3], least, most; /* points from + t to, least <= t <= most */
    int sides;                          /* 1: triangles are culled as their material says */
};

/* ---- Hierarchy ---- */

static double middle(const struct ref_triangle *t, int k)
{
    return t->p[0][k] + t->p[1][k] + t->p[2][k];
}

static void bounds(struct node *b, const struct caster *c, size_t first, size_t n)
{
    for (int k = 0; k < 3; k++) {
        b->lo[k] = INFINITY;
        b->hi[k] = -INFINITY;
        for (size_t i = 3 * first; i < 3 * (first + n); i++) {
            const double at = c->triangle[c->item[i / 3]].p[i % 3][k];
            b->lo[k] = fmin(b->lo[k], at);
            b->hi[k] = fmax(b->hi[k], at);
        }
    }
}

/* Move the items whose middle along axis k is below `at` to the front. Return how many. */
static size_t part(struct caster *c, size_t first, size_t n, int k, double at)
{
    size_t front = 0;
    for (size_t i = 0; i < n; i++) {
        const size_t item = c->item[first + i];
        if (middle(&c->triangle[item], k) >= at)
            continue;
        c->item[first + i] = c->item[first + front];
        c->item[first + front++] = item;
    }
    return front;
}

static void build(struct caster *c, size_t first, size_t n)
{
    struct node *const b = &c->node[c->n_nodes++];
    int axis = 0;
    bounds(b, c, first, n);
    b->first = first;
    b->count = n <= LEAF ? n : 0;
    if (n > LEAF) {
        for (int k = 1; k < 3; k++)
            if (b->hi[k] - b->lo[k] > b->hi[axis] - b->lo[axis])
                axis = k;
        size_t front = part(c, first, n, axis, 1.5 * (b->lo[axis] + b->hi[axis]));
        if (front == 0 || front == n)
            front = n / 2;
        build(c, first, front);
        build(c, first + front, n - front);
    }
    b->skip = c->n_nodes;
}

/* ---- Hits ---- */

static int in_box(const struct node *b, const struct ray *r, double most)
{
    double from = r->least, to = most;
    for (int k = 0; k < 3; k++) {
        if (r->to[k] == 0.0) {
            if (r->from[k] < b->lo[k] || r->from[k] > b->hi[k])
                return 0;
            continue;
        }
        const double a = (b->lo[k] - r->from[k]) / r->to[k], z = (b->hi[k] - r->from[k]) / r->to[k];
        const double slack = 1e-12 * (fabs(a) + fabs(z));
        from = fmax(from, fmin(a, z) - slack);
        to = fmin(to, fmax(a, z) + slack);
    }
    return from <= to;
}

/* Return where a ray meets a triangle, or INFINITY. */
static double hit(const struct ref_triangle *t, const struct ray *r)
{
    double e1[3], e2[3], s[3], p[3], q[3];
    sim_sub(e1, t->p[1], t->p[0]);
    sim_sub(e2, t->p[2], t->p[0]);
    sim_cross(p, r->to, e2);
    const double det = sim_dot(e1, p); /* > 0: the ray sees the front */
    const int culled = (t->cull == REF_CULL_BACK && det < 0.0) || (t->cull == REF_CULL_FRONT && det > 0.0);
    if (det == 0.0 || (r->sides && culled))
        return INFINITY;
    sim_sub(s, r->from, t->p[0]);
    sim_cross(q, s, e1);
    const double u = sim_dot(s, p) / det, v = sim_dot(r->to, q) / det, at = sim_dot(e2, q) / det;
    return u >= 0.0 && v >= 0.0 && u + v <= 1.0 && at >= r->least && at <= r->most ? at : (double)INFINITY;
}

/* The nearest triangle that a ray meets, or NONE; any: the first that is found. */
static size_t nearest(const struct caster *c, const struct ray *r, double *at, int any)
{
    size_t best = NONE;
    *at = INFINITY;
    c->rays->cast++;
    for (size_t i = 0; i < c->n_nodes;) {
        const struct node *b = &c->node[i];
        if (!in_box(b, r, fmin(r->most, *at))) {
            i = b->skip;
            continue;
        }
        for (size_t k = 0; k < b->count; k++) {
            const size_t item = c->item[b->first + k];
            const double d = hit(&c->triangle[item], r);
            if (d < *at || (d == *at && d < (double)INFINITY && item < best)) {
                *at = d;
                best = item;
                if (any)
                    return best;
            }
        }
        i++;
    }
    return best;
}

/* ---- Colours ---- */

static void of_565(double out[3], uint16_t v)
{
    out[0] = (v >> 11) / 31.0;
    out[1] = (v >> 5 & 63) / 63.0;
    out[2] = (v & 31) / 31.0;
}

static uint16_t to_565(const double c[3])
{
    return (uint16_t)((unsigned)floor(c[0] * 31.0 + 0.5) << 11 | (unsigned)floor(c[1] * 63.0 + 0.5) << 5 |
                      (unsigned)floor(c[2] * 31.0 + 0.5));
}

/* The colour of a ray that ends at a triangle or at nothing, and of its reflections. */
static void color_of(const struct caster *c, struct ray r, size_t item, double at, double out[3])
{
    double weight = 1.0;
    out[0] = out[1] = out[2] = 0.0;
    for (int bounce = 0;; bounce++) {
        double own[3], n[3], e1[3], e2[3], point[3];
        if (item == NONE) {
            for (int k = 0; k < 3; k++)
                out[k] += weight * c->background[k];
            return;
        }
        const struct ref_triangle *t = &c->triangle[item];
        sim_sub(e1, t->p[1], t->p[0]);
        sim_sub(e2, t->p[2], t->p[0]);
        sim_cross(n, e1, e2);
        (void)sim_unit(n);
        for (int k = 0; k < 3; k++)
            point[k] = r.from[k] + at * r.to[k];
        const double off = OFF * (fabs(point[0]) + fabs(point[1]) + fabs(point[2]) + at * sqrt(sim_dot(r.to, r.to)));
        of_565(own, t->raw);
        if (t->shade != REF_SHADE_RAW) {
            double diffuse = c->light->diffuse * fmax(0.0, sim_dot(t->has_face_n ? t->face_n : n, c->light->dir));
            if (c->rays->shadows && diffuse > 0.0) {
                double where;
                struct ray light = { .least = off, .most = INFINITY };
                memcpy(light.from, point, sizeof point);
                memcpy(light.to, c->light->dir, sizeof point);
                if (nearest(c, &light, &where, 1) != NONE)
                    diffuse = 0.0;
            }
            for (int k = 0; k < 3; k++)
                own[k] = fmin(1.0, t->rgb[0][k] * (c->light->ambient + diffuse));
        }
        const double mirror = c->rays->mirror && bounce < c->rays->bounces ? c->rays->mirror[item] : 0.0;
        for (int k = 0; k < 3; k++)
            out[k] += weight * (1.0 - mirror) * own[k];
        weight *= mirror;
        if (weight == 0.0)
            return;
        const double along = 2.0 * sim_dot(r.to, n);
        for (int k = 0; k < 3; k++) {
            r.to[k] -= along * n[k];
            r.from[k] = point[k];
        }
        (void)sim_unit(r.to);
        r.least = off;
        r.most = INFINITY;
        r.sides = 0;
        item = nearest(c, &r, &at, 0);
    }
}

/* ---- Pixels ---- */

/* The ray of a pixel: t is the distance along the axis. */
static struct ray primary(const struct ref_camera *camera, int width, int height, int i, int j)
{
    const double x = i + 0.5 - width / 2.0, y = height / 2.0 - j - 0.5;
    const double unit = camera->orthographic ? camera->height / height : 1.0 / camera->focal;
    struct ray r = { .least = camera->near_z, .most = camera->far_z, .sides = 1 };
    for (int k = 0; k < 3; k++) {
        const double aside = unit * (x * camera->right[k] + y * camera->up[k]);
        r.from[k] = camera->eye[k] + (camera->orthographic ? aside : 0.0);
        r.to[k] = (camera->orthographic ? 0.0 : aside) - camera->back[k];
    }
    return r;
}

int ref_cast(const struct ref_triangle *triangles, size_t n, const struct ref_camera *camera,
             const struct ref_light *light, uint16_t background, int width, int height,
             struct ref_rays *rays, struct ref_image *image)
{
    struct caster c = { .triangle = triangles, .camera = camera, .light = light, .rays = rays };
    if (width < 1 || width > REF_MAX_SIDE || height < 1 || height > REF_MAX_SIDE || rays->bounces < 0 ||
        rays->bounces > 16)
        return REF_BAD_ARGUMENT;
    c.node = malloc((2 * n + 1) * sizeof *c.node);
    c.item = malloc((n + 1) * sizeof *c.item);
    if (c.node != NULL && c.item != NULL) {
        of_565(c.background, background);
        rays->cast = 0;
        for (size_t i = 0; i < n; i++)
            c.item[i] = i;
        if (n > 0)
            build(&c, 0, n);
        for (size_t at = 0; at < (size_t)width * (size_t)height; at++) {
            double z, color[3];
            const struct ray r = primary(camera, width, height, (int)(at % (size_t)width), (int)(at / (size_t)width));
            const size_t item = nearest(&c, &r, &z, 0);
            if (image->id != NULL)
                image->id[at] = item == NONE ? 0 : triangles[item].id;
            if (image->z != NULL)
                image->z[at] = z;
            if (image->rgb565 == NULL)
                continue;
            color_of(&c, r, item, z, color);
            image->rgb565[at] = to_565(color);
        }
    }
    const int err = c.node != NULL && c.item != NULL ? REF_OK : REF_NO_MEMORY;
    free(c.node);
    free(c.item);
    return err;
}
