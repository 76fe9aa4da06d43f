/* Boxes on the ground, and rays at them in doubles: for tests of shadows.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef BOXES_H
#define BOXES_H

#include <math.h>
#include <stddef.h>

#include "cases.h"
#include "picture.h"
#include "zs_shadow.h"
#include "zstrip.h"

static const int16_t box_pos[8][3] = { { -50, -50, 50 },  { 50, -50, 50 },  { 50, 50, 50 },  { -50, 50, 50 },
                                       { -50, -50, -50 }, { 50, -50, -50 }, { 50, 50, -50 }, { -50, 50, -50 } };
static const uint16_t box_tri[12][3] = {
    { 0, 1, 2 }, { 0, 2, 3 }, { 5, 4, 7 }, { 5, 7, 6 }, { 1, 5, 6 }, { 1, 6, 2 },
    { 4, 0, 3 }, { 4, 3, 7 }, { 3, 2, 6 }, { 3, 6, 7 }, { 4, 5, 1 }, { 4, 1, 0 }
};
static const int16_t ground_pos[4][3] = { { -100, 0, 100 }, { 100, 0, 100 }, { 100, 0, -100 }, { -100, 0, -100 } };
static const uint16_t ground_tri[2][3] = { { 0, 1, 2 }, { 0, 2, 3 } };

/* Draw the map with a renderer for it alone: in any way by *p, or, where p is NULL, in one strip. Return what it ends
 * with. */
static int map_drawn(struct zs_shadow_map *map, const struct zs_scene *casters, const struct zs_camera *light,
                     const struct zs_depth *depth, struct prng *p)
{
    struct zs_config c = { .width = map->w, .height = map->h, .strip_h = map->h, .max_tris = 200, .max_verts = 200,
                           .depth = depth };
    struct zs_renderer r;
    if (p)
        picture_any_way(p, &c, 2, 6);
    void *arena = malloc(zs_arena_bytes(&c));
    int err = arena ? zs_init(&r, &c, arena, zs_arena_bytes(&c)) : -1;
    err = err ? err : zs_shadow_map_draw(map, &r, casters, light);
    free(arena);
    return err;
}

static void unit_of(double v[3])
{
    const double n = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int k = 0; k < 3; k++)
        v[k] /= n;
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

struct face {
    double at[3], e1[3], e2[3], n[3]; /* n: unit, outwards */
    const struct zs_instance *of;
};

/* The front sides of things: triangles of boxes and grounds, 100 at most. */
static struct face faces[100];
static int n_faces;

static void faces_make(const struct zs_instance *thing, int n)
{
    n_faces = 0;
    for (int k = 0; k < n; k++) {
        const struct zs_instance *in = &thing[k];
        const double scale = in->pose.scale / 65536.0;
        for (uint32_t t = 0; t < in->mesh->n_tris; t++) {
            struct face *f = &faces[n_faces++];
            assert_true(n_faces <= 100);
            double corner[3][3];
            for (int c = 0; c < 3; c++)
                for (int a = 0; a < 3; a++) {
                    const int16_t *v = in->mesh->pos[in->mesh->tri[t][c]];
                    const zs_q2_30 *row = in->pose.rot + 3 * a;
                    corner[c][a] = in->pose.pos[a] +
                                   scale * ((double)row[0] * v[0] + (double)row[1] * v[1] + (double)row[2] * v[2]) /
                                       ZS_Q30_ONE;
                }
            for (int a = 0; a < 3; a++) {
                f->at[a] = corner[0][a];
                f->e1[a] = corner[1][a] - corner[0][a];
                f->e2[a] = corner[2][a] - corner[0][a];
            }
            for (int a = 0; a < 3; a++)
                f->n[a] = f->e1[(a + 1) % 3] * f->e2[(a + 2) % 3] - f->e1[(a + 2) % 3] * f->e2[(a + 1) % 3];
            unit_of(f->n);
            f->of = in;
        }
    }
}

/* How far along a ray its front is hit; INFINITY: not. */
static double hit(const struct face *f, const double from[3], const double dir[3])
{
    double h[3], s[3], q[3];
    for (int a = 0; a < 3; a++) {
        h[a] = dir[(a + 1) % 3] * f->e2[(a + 2) % 3] - dir[(a + 2) % 3] * f->e2[(a + 1) % 3];
        s[a] = from[a] - f->at[a];
    }
    for (int a = 0; a < 3; a++)
        q[a] = s[(a + 1) % 3] * f->e1[(a + 2) % 3] - s[(a + 2) % 3] * f->e1[(a + 1) % 3];
    const double det = dot(f->e1, h);
    if (det <= 0)
        return INFINITY;
    const double u = dot(s, h) / det, v = dot(dir, q) / det;
    return u < 0 || v < 0 || u + v > 1 ? INFINITY : dot(f->e2, q) / det;
}

/* The face that is seen through a point of the picture, and where. NULL: none. */
static const struct face *seen(const struct zs_camera *c, int w, int h, double x, double y, double at[3])
{
    const double focal = (double)c->focal / 4294967296.0, in[3] = { (x - w / 2.0) / focal, (h / 2.0 - y) / focal, -1 };
    double from[3], dir[3], nearest = INFINITY;
    const struct face *best = NULL;
    for (int a = 0; a < 3; a++) {
        from[a] = c->pos[a];
        dir[a] = (c->rot[a] * in[0] + c->rot[3 + a] * in[1] + c->rot[6 + a] * in[2]) / ZS_Q30_ONE;
    }
    for (int k = 0; k < n_faces; k++) {
        const double t = hit(&faces[k], from, dir);
        if (t < nearest) {
            nearest = t;
            best = &faces[k];
        }
    }
    for (int a = 0; best && a < 3; a++)
        at[a] = from[a] + nearest * dir[a];
    return best;
}

#endif
