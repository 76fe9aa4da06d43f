/* Mirrors and windows (passes), skies, environment maps and billboards. Each is linked only when a
 * program names it.
 *
 *     static struct zs_mirror mirror;
 *     err = zs_mirror_of(&mirror, &glass, 16);
 *     const struct zs_pass pass[2] = {                 // room: its last instance is the glass,
 *         { .scene = &room, .camera = &camera },       // drawn by zs_shade_window
 *         { .scene = &seen, .camera = &camera, .mirror = &mirror, .mask = &zs_mask_window } };
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_ENVIRONMENT_H
#define ZS_ENVIRONMENT_H

#include "zs_pass.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What passes call. The fields belong to the library. */
struct zs_mirror_ops {
    /* In place of the usual check of a pass: 1: the eye sees nothing in the mirror. */
    int (*check)(struct zs_renderer *r, const struct zs_mirror *mirror,
                 const struct zs_scene *scene, struct zs_reflection *out);
};
struct zs_mask {
    int (*check)(const struct zs_renderer *r, const struct zs_pass *pass,
                 const struct zs_pass_memory *memory, uint32_t number);
    /* Prepare n pixels of a row of the strip: before the windows are drawn; before the pass is. */
    void (*before)(struct zs_renderer *r, int32_t row, int32_t x, int32_t n);
    void (*open)(struct zs_renderer *r, int32_t row, int32_t x, int32_t n);
};

/* ---- Mirrors ------------------------------------------------------------------------------ */

/* A pass with a mirror (zs_pass.mirror) shows what its camera sees in it: the scene reflected at
 * the mirror's plane, without what lies behind that plane. Its picture is mirrored left to right.
 * Material.cull means the same as without a mirror, the usual light is that of the camera itself.
 * An eye in the plane or behind it sees nothing of the scene, only the background; that is no
 * error.
 *
 * Without a mask the mirror fills the viewport: a rear-view mirror.
 *
 * Errors  A vertex is where it would be without a mirror, seen from the reflected eye, to the same
 *         errors (core/xform.c) and 2^-29 of its distance. What is cut off at the plane is exact to
 *         2 camera units, which are below 2^-28 of the farthest coordinate in view.
 * Points  (zs_lines.h) are drawn as a whole or not at all, by their middle.
 * Cost    the accelerators `batch` and `clusters` do nothing in such a pass. ZS_ERR_RANGE: the
 *         eye's picture lies outside the world. */

/* The plane of a mirror. A function below sets it. */
struct zs_mirror {
    const struct zs_mirror_ops *ops;
    zs_q2_30 normal[3]; /* unit, world axes; eyes on the side that it points to see something */
    int64_t at;         /* normal . x of the plane's points, world units * q2_30 */
};

/* Set a mirror from a point of its plane and the direction in which it faces.
 *
 * point   world units, |coordinate| <= ZS_WORLD_MAX.
 * normal  any length but 0; on that side of the plane are the eyes that see something.
 * Error   of the normal 2^-28.
 * Return  ZS_OK; ZS_ERR_RANGE, ZS_ERR_VECTOR: mirror is not to be used. */
int zs_mirror_plane(struct zs_mirror *mirror, const int32_t point[3], const int32_t normal[3]);

/* Set a mirror from an instance that is its surface. It faces to where the front of the mesh's
 * largest triangle faces.
 *
 * in         borrowed during the call. When its pose changes, call this again.
 * tolerance  1/256 mesh step: how far vertices may lie off that triangle's plane.
 * Cost       two loops over the mesh's triangles: call it when the mirror moves.
 * Return     ZS_OK; ZS_ERR_NULL; ZS_ERR_MESH: the mesh is not plane, or has no triangle with an
 *            area, or one with a vertex that there is not; ZS_ERR_RANGE. After an error mirror is
 *            untouched. */
int zs_mirror_of(struct zs_mirror *mirror, const struct zs_instance *in, uint32_t tolerance);

/* Reflect a direction of any length up to 1. */
void zs_mirror_direction(const struct zs_mirror *mirror, zs_q2_30 v[3]);

/* ---- Windows ------------------------------------------------------------------------------ */

/* A pass with .mask = &zs_mask_window is seen only where instances of the pass before it, drawn by
 * zs_shade_window, are visible: a mirror in a room, or a view into another place. Those instances
 * come last in their scene. They have no colour; the background of the pass with the mask is drawn
 * there. The test is ZS_DEPTH_LESS_EQUAL, and a depth state's bias is added, but its func and
 * read_only do not matter.
 *
 * Both passes have the same viewport. keep of the pass with the mask is 0, and its instances have
 * no depth state with a func other than ZS_DEPTH_LESS (else ZS_ERR_PASS). Under 16 depth bits, the
 * pass with the windows does not draw surfaces with the key 65534, that is, at the far plane. After
 * a pass with a mask, keys outside of the windows are 0: a later pass must not keep them, and hooks
 * that read keys (zs_target.depth) find that all is near there.
 *
 * Cost  Cortex-M3: 5 instructions for each pixel of the viewport, and the background of the
 *       windows. */
extern const struct zs_shader zs_shade_window;
extern const struct zs_mask zs_mask_window;

#ifdef __cplusplus
}
#endif

#endif
