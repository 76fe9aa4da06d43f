/* Mirrors: a pass whose eye is behind the mirror.
 *
 * Let H x = x - 2 (n . x) n, and q a point of the plane. A mirror shows x at H (x - q) + q. With
 * the camera's rows R and its eye e that is c = R (H (x - q) + q - e) = R H (x - e'), where e' = e
 * - 2 s n is the eye's picture in the mirror and s = n . (e - q) its distance. The rows R H are a
 * left-handed system. The camera of the pass is right-handed while it is checked: its first row is
 * negated. Then the sign is turned back, in the camera and in the view. So the picture is mirrored
 * left to right, triangles turn the other way on the screen (core/assemble.c), and shaders find the
 * camera's axes as those of the mirrored picture.
 *
 * An eye is in whole world units. What e' is off by rounding is taken from each transform
 * (core/xform.c), so that a mirror in any direction shows things where they are. The rows have two
 * roundings more than those of a camera: 2^-29.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/cold.h"
#include "core/depth.h"
#include "core/fx.h"
#include "core/frame.h"
#include "core/rotation.h"
#include "core/usual.h"
#include "core/view.h"
#include "core/xform.h"
#include "zs_environment.h"
#include "zs_shader.h"

#define UNIT ((int64_t)1 << 16)   /* a world unit, q48_16 */
#define BLIND 1                   /* the eye is not in front of the mirror */
#define AT_MAX ((int64_t)1 << 60) /* above sqrt 3 * ZS_WORLD_MAX * 2^30 */

/* ---- A pass in a mirror ---------------------------------------------------------------------- */

static void direction(const struct zs_mirror *mirror, zs_q2_30 v[3])
{
    const int64_t twice = zs_round_shift(zs_dot(v, mirror->normal), 29); /* |.| < 2^31.1 */
    for (int k = 0; k < 3; k++)
        v[k] = (zs_q2_30)(v[k] - zs_round_shift(twice * mirror->normal[k], 30));
}

/* Reflect a camera, all but the sign of its first row. *s: the eye's distance from the plane, world
 * units * q2_30, |.| < 2^61. eye: the rounded eye minus the exact one, world axes, in the same
 * units. Return ZS_OK, ZS_ERR_RANGE, or BLIND. */
static int reflect(struct zs_camera *camera, const struct zs_mirror *mirror, int64_t *s,
                   int32_t eye[3])
{
    for (int k = 0; k < 3; k++)
        if (zs_size32(camera->pos[k]) > ZS_WORLD_MAX)
            return ZS_ERR_RANGE;
    *s = zs_dot(mirror->normal, camera->pos) - mirror->at;
    if (*s <= 0)
        return BLIND;
    for (int k = 0; k < 3; k++) {
        const int32_t n = mirror->normal[k];
        const int64_t size = zs_mulshift_s64(*s, zs_size32(n), 29), by = n < 0 ? size : -size;
        const int64_t whole = zs_round_shift(by, 30);        /* |by| < 2^62 */
        eye[k] = (int32_t)(whole * ((int64_t)1 << 30) - by); /* |.| <= 2^29 */
        if (zs_size64(camera->pos[k] + whole) > ZS_WORLD_MAX)
            return ZS_ERR_RANGE;
        camera->pos[k] += (int32_t)whole;
        direction(mirror, camera->rot + 3 * k);
        camera->rot[k] = -camera->rot[k];
    }
    return ZS_OK;
}

/* struct zs_reflection.move: c + eye, by t of each row (enum zs_row_word). */
static int move(struct zs_renderer *r)
{
    int32_t *row = r->xform.row;
    for (int k = 0; k < 3; k++, row += ZS_ROW_WORDS) {
        const int32_t by = r->view.mirror->eye[k];
#if ZS_ROW_WIDE
        uint64_t t = (uint64_t)(uint32_t)row[4] << 32 | (uint32_t)row[3];
        t += (uint64_t)(int64_t)by << row[5];
        row[3] = (int32_t)(uint32_t)t;
        row[4] = (int32_t)(uint32_t)(t >> 32);
#else
        row[ZS_ROW_T_HIGH] += by;
#endif
    }
    r->xform.cull ^= 1u; /* triangles turn the other way on the screen */
    return 1;
}

/* struct zs_reflection.inside. The sum of three products is below 2^30 * (2^30 + 2) sqrt 3. */
static int64_t inside(const struct zs_view *view, const struct zs_point *p)
{
    const struct zs_reflection *const of = view->mirror;
    return zs_mul_ss(of->n[0], p->c[0]) + zs_mul_ss(of->n[1], p->c[1]) +
           zs_mul_ss(of->n[2], p->c[2]) + of->at;
}

static uint32_t outcode(const struct zs_view *view, const struct zs_point *p, uint32_t code)
{
    return inside(view, p) < 0 ? code | ZS_OUT_MIRROR : code;
}

/* Instances are culled as they are seen from the rounded eye, less than a world unit off.
 * Move the planes of the camera, which nothing else uses from here on, outwards by that. Side
 * planes go through the eye; with t the tangent of half the angle of view, they have to hold what
 * lies within t (z + 1) + 1 for z >= near - 1, so their tangent is t + (1 + t) / (near - 1). */
static void loosen(struct zs_renderer *r)
{
    struct zs_camera *const camera = &r->camera;
    struct zs_view *const view = &r->view;
    const uint32_t half[2] = { view->width * (uint32_t)ZS_SUBPX_HALF,
                               view->height * (uint32_t)ZS_SUBPX_HALF };
    const int64_t from = camera->z_near - UNIT;
    camera->z_near -= UNIT;
    camera->z_far += UNIT;
    camera->height += 2 * UNIT * (1 + view->height / view->width);
    for (int k = 0; k < 2 && view->perspective; k++) {
        const uint64_t sum = ((camera->focal >> 24) + half[k]) << 16; /* < 2^48 */
        const uint64_t wide = from < UNIT ? UINT64_MAX : half[k] + sum / (uint64_t)from + 1u;
        view->side[k][0] = view->side[k][1] = 0; /* nothing is culled */
        if (wide <= 1u << 20)
            zs_view_side(view->side[k], camera->focal, (uint32_t)wide);
    }
}

/* Complete `eye`: from world axes, q2_30, to camera units. A world unit is at most 2^30 of these;
 * if it is more than 2^23, there must be room for it beside what is in view. */
static int eye_set(struct zs_renderer *r, struct zs_reflection *out)
{
    struct zs_view *const view = &r->view;
    const int32_t eye[3] = { out->eye[0], out->eye[1], out->eye[2] };
    int err = ZS_OK;
    if (!(eye[0] | eye[1] | eye[2]))
        return ZS_OK;
    if (view->shift > 23) {
        err = zs_view_units(view, &r->camera, (int64_t)1 << (46 - view->shift));
        err = err ? err : view->depth->setup(view, &r->camera, r->config.depth_bits);
    }
    for (int k = 0; k < 3; k++) { /* |dot| <= 2^59.8 */
        const int64_t dot = zs_dot(view->rot + 3 * k, eye);
        out->eye[k] = (int32_t)zs_round_shift(k ? dot : -dot, zs_min32(60 - view->shift, 62));
    }
    loosen(r);
    return err;
}

/* A point at c from the eye has the distance n . c - s from the plane. In camera units x' and y'
 * are ratio * x and -ratio * y, so the sum is taken ratio times. It is off by 2 camera units: each
 * element by 2^-30 of at most 2^30. */
static void complete(struct zs_renderer *r, const struct zs_mirror *mirror,
                     struct zs_reflection *out)
{
    struct zs_view *const view = &r->view;
    const int64_t limit = (int64_t)1 << 61;
    int32_t n[3];
    for (int k = 0; k < 3; k++) {
        r->camera.rot[k] = -r->camera.rot[k];
        view->rot[k] = -view->rot[k];
    }
    for (int k = 0; k < 3; k++)
        n[k] = (int32_t)zs_round_shift(zs_dot(r->camera.rot + 3 * k, mirror->normal), 30);
    out->n[0] = n[0];
    out->n[1] = -n[1];
    out->n[2] = (int32_t)zs_round_shift(zs_mul_ss(-n[2], view->ratio), 30);
    /* from 2^31 camera units on, all that is in view lies behind the mirror */
    const int32_t up = view->shift;
    const int64_t s = up > 0 && out->at > limit >> up ? limit : zs_scale2(out->at, up);
    out->at = -zs_mulshift_s64(s > limit ? limit : s, (uint32_t)view->ratio, 30);
    out->move = move;
    out->inside = inside;
    out->outcode = outcode;
    view->mirror = out;
}

/* struct zs_mirror_ops.check */
static int check(struct zs_renderer *r, const struct zs_mirror *mirror,
                 const struct zs_scene *scene, struct zs_reflection *out)
{
    const int seen = reflect(&r->camera, mirror, &out->at, out->eye);
    int err = seen < 0 ? seen : zs_frame_check(r, scene);
    if (err || seen == BLIND)
        return err ? err : BLIND;
    err = eye_set(r, out);
    complete(r, mirror, out);
    return err;
}

static const struct zs_mirror_ops ops = { .check = check, .direction = direction };

/* ---- The plane ------------------------------------------------------------------------------- */

int zs_mirror_plane(struct zs_mirror *mirror, const int32_t point[3], const int32_t normal[3])
{
    for (int k = 0; k < 3; k++)
        if (zs_size32(point[k]) > ZS_WORLD_MAX)
            return ZS_ERR_RANGE;
    if (zs_unit(mirror->normal, normal))
        return ZS_ERR_VECTOR;
    mirror->at = zs_dot(mirror->normal, point);
    mirror->ops = &ops;
    return ZS_OK;
}

/* Find the normal of the largest triangle, in mesh axes, and a point of it. Return ZS_ERR_MESH if
 * no triangle has an area, or a number is that of no vertex. */
static int largest(zs_q2_30 normal[3], int32_t point[3], const struct zs_mesh *mesh)
{
    int64_t most = 0;
    for (uint32_t t = 0; t < mesh->n_tris; t++) {
        int32_t p[3][3], e[2][3];
        int64_t n[3], size = 0;
        for (int i = 0; i < 3; i++) {
            if (mesh->tri[t][i] >= mesh->n_verts)
                return ZS_ERR_MESH;
            zs_mesh_place(mesh, mesh->tri[t][i], p[i]);
        }
        for (int k = 0; k < 3; k++) {
            e[0][k] = p[1][k] - p[0][k]; /* |.| < 2^24 */
            e[1][k] = p[2][k] - p[0][k];
        }
        for (int k = 0; k < 3; k++) {
            n[k] = zs_cross_at(e[0], e[1], k); /* |.| < 2^49.1 */
            size += zs_size64(n[k]);
        }
        if (size > most) {
            most = size;
            (void)zs_unit64(normal, n);
            for (int k = 0; k < 3; k++)
                point[k] = p[0][k];
        }
    }
    return most ? ZS_OK : ZS_ERR_MESH;
}

int zs_mirror_of(struct zs_mirror *mirror, const struct zs_instance *in, uint32_t tolerance)
{
    if (!mirror || !in || !in->mesh || !in->mesh->pos || !in->mesh->tri)
        return ZS_ERR_NULL;
    const struct zs_mesh *const mesh = in->mesh;
    const zs_q2_30 *const rot = zs_usual_rotation(in->pose.rot);
    zs_q2_30 n[3], world[3];
    int32_t p[3];
    if (largest(n, p, mesh))
        return ZS_ERR_MESH;
    const int64_t at = zs_dot(n, p); /* q2_30 * 1/256 step, |.| < 2^54 */
    for (uint32_t t = 0; t < mesh->n_tris; t++)
        for (int i = 0; i < 3; i++) {
            zs_mesh_place(mesh, mesh->tri[t][i], p);
            if (zs_size64(zs_dot(n, p) - at) > (int64_t)((uint64_t)tolerance << 30))
                return ZS_ERR_MESH;
        }
    const uint64_t scale = zs_usual_scale(in); /* q32_32 */
    if (scale >> 47 || !zs_rotation_ok(rot))
        return ZS_ERR_RANGE;
    for (int k = 0; k < 3; k++) {
        if (zs_size32(in->pose.pos[k]) > ZS_WORLD_MAX)
            return ZS_ERR_RANGE;
        world[k] = (zs_q2_30)zs_round_shift(zs_dot(rot + 3 * k, n), 30);
    }
    const int64_t off = zs_mulshift_s64(at, scale, 40); /* < 2^61 */
    const int64_t sum = zs_dot(world, in->pose.pos) + off;
    if (zs_size64(sum) > AT_MAX)
        return ZS_ERR_RANGE;
    for (int k = 0; k < 3; k++)
        mirror->normal[k] = world[k];
    mirror->at = sum;
    mirror->ops = &ops;
    return ZS_OK;
}

int zs_mirror_camera(struct zs_camera *out, const struct zs_camera *camera,
                     const struct zs_mirror *mirror)
{
    const zs_q2_30 *const rot = zs_usual_rotation(camera->rot);
    struct zs_camera to = *camera;
    int64_t s;
    int32_t eye[3];
    for (int k = 0; k < 9; k++)
        to.rot[k] = rot[k];
    const int err = reflect(&to, mirror, &s, eye);
    if (err)
        return err < 0 ? err : ZS_ERR_VECTOR;
    *out = to;
    return ZS_OK;
}
