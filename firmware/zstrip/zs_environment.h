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

ZS_C_BEGIN

/* What passes call. The fields belong to the library. */
struct zs_mirror_ops {
    /* In place of the usual check of a pass: 1: the eye sees nothing in the mirror. */
    int (*check)(struct zs_renderer *r, const struct zs_mirror *mirror,
                 const struct zs_scene *scene, struct zs_reflection *out);
    void (*direction)(const struct zs_mirror *mirror, zs_q2_30 v[3]); /* reflects it */
};
struct zs_mask {
    int (*check)(const struct zs_renderer *r, const struct zs_pass *pass,
                 const struct zs_pass_memory *memory, uint32_t number);
    /* Prepare n pixels of a row of the strip: before the windows are drawn (fresh: no key is yet);
     * before the pass is. */
    void (*before)(struct zs_renderer *r, int32_t row, int32_t x, int32_t n, int fresh);
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
 * Cost    the accelerators `batch` and `clusters` do nothing in such a pass: on a Cortex-M3 a mesh
 *         of 2,500 triangles takes 1.81 million instructions in place of 1.19, a city 2.70 in place
 *         of 2.00, cubes 0.39 in place of 0.36. What lies behind the plane is transformed and
 *         dropped: leave it out of the scene where that is known.
 * ZS_ERR_RANGE: the eye's picture lies outside the world. */

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
 *            area, or one with a vertex that there is not; ZS_ERR_RANGE: a position, a scale, or a
 *            pose.rot that is no rotation. After an error mirror is untouched. */
int zs_mirror_of(struct zs_mirror *mirror, const struct zs_instance *in, uint32_t tolerance);

/* Set a camera that stands where the eye's picture in the mirror is, and looks where it looks. It
 * is that of a pass with the mirror, but its picture is not mirrored left to right, and nothing is
 * cut off. For what is set from a camera: zs_pose_face.
 *
 * out     may be camera. The eye is rounded to world units.
 * Return  ZS_OK; ZS_ERR_RANGE: the eye's picture is outside the world; ZS_ERR_VECTOR: the eye
 *         is not in front of the mirror. After an error out is untouched. */
int zs_mirror_camera(struct zs_camera *out, const struct zs_camera *camera,
                     const struct zs_mirror *mirror);

/* ---- Windows ------------------------------------------------------------------------------ */

/* A pass with .mask = &zs_mask_window is seen only where instances of the pass before it, drawn by
 * zs_shade_window, are visible: a mirror in a room, or a view into another place. Those instances
 * come last in their scene. They have no colour; the background of the pass with the mask is drawn
 * there. The test is ZS_DEPTH_LESS_EQUAL, and a depth state's bias is added, but its func and
 * read_only do not matter.
 *
 * Both passes have the same viewport. keep of the pass with the mask is 0, and its instances have
 * no depth state with a func other than ZS_DEPTH_LESS (else ZS_ERR_PASS). With 16 depth bits, the
 * pass with the windows does not draw surfaces with the key 65534, that is, at the far plane. After
 * a pass with a mask, keys outside of the windows are 0: a later pass must not keep them, and hooks
 * that read keys (zs_target.depth) find that all is near there: fog (zs_fog.h) is seen in the
 * windows alone. What is blended (zs_blend.h) before a window is not seen there, since it writes no
 * keys: the pass with the mask covers it. Methods with depth memory and without passes
 * (zs_method.h) refuse windows: ZS_ERR_DEPTH.
 *
 * Cost  Cortex-M3: 8 instructions for each pixel of the viewport, and the background of the
 *       windows. */
extern const struct zs_shader zs_shade_window;
extern const struct zs_mask zs_mask_window;

/* ---- Skies -------------------------------------------------------------------------------- */

/* A sky around the eye, as far away as can be: it turns with the camera, in any direction, and does
 * not move when the camera moves.
 *
 *     static struct zs_sky sky;
 *     err = zs_sky_panorama(&sky, &image, 16384, -16384);    // once
 *     zs_sky_look(&sky, &camera, &whole, NULL);              // each frame
 *     scene.sky = &sky.background;
 *
 * Errors  2^-16 turn, and what is interpolated between every 16th column: at most 0.4 px, and up to
 *         1/16 turn from the horizon 21 / f px for a focal length of f px (0.1 px at 320x240 and 60
 *         degrees). A px is that in the middle of the viewport. An image's rows are off by 2^-17 of
 *         its height besides.
 * Cost    Cortex-M3: see zs_sky_look.
 * zs_damage_track does not see that a sky changes: zs_invalidate when the camera turns. Skies hold
 * pointers into themselves: do not copy or move one that is set. */
struct zs_sky {
    struct zs_background background; /* scene.sky; the other fields belong to the library */
    const struct zs_texture *texture;
    zs_q2_30 rot[9];
    int32_t focal, step, reach, down;
    int16_t top, x, y, width, height;
};

/* Set a sky from an image that goes around the eye once.
 *
 * image   its middle is at -z, its right half is on the +x side. Borrowed as long as the sky is
 *         used. Its clamp does not matter.
 * top, bottom  the pitch of its upper and lower edge, 65536 to the turn, -16384 .. 16384 (straight
 *         down and up), at least 64 apart. Beyond them the first and the last row continue.
 * Return  ZS_OK; ZS_ERR_NULL, ZS_ERR_TEXTURE, ZS_ERR_RANGE: sky is untouched. */
int zs_sky_panorama(struct zs_sky *sky, const struct zs_texture *image, int16_t top,
                    int16_t bottom);

/* A sky whose colour is a function of the pitch. */
#define ZS_SKY_COLORS_LOG2 7
#define ZS_SKY_COLORS (1u << ZS_SKY_COLORS_LOG2)
struct zs_sky_gradient {
    struct zs_sky sky;
    struct zs_texture image;
    uint16_t color[ZS_SKY_COLORS];
};
/* color  [4]: straight up, above the horizon, below the horizon, straight down. */
void zs_sky_gradient(struct zs_sky_gradient *sky, const struct zs_rgb color[4]);

/* Let a sky be seen by a camera. An orthographic one sees the colour of one direction everywhere.
 *
 * viewport  the pass's. Without a pass, or where the pass's is all 0: a rectangle of 0, 0, width
 *           and height of the frame. Not NULL.
 * mirror    the pass's; NULL: none.
 * Cost      a few hundred instructions. Those of the sky, Cortex-M3, for each pixel that it
 *           colours, at 320x240 and 60 degrees: 32 at the horizon, 46 at 30 degrees, 71 at 60. */
void zs_sky_look(struct zs_sky *sky, const struct zs_camera *camera, const struct zs_rect *viewport,
                 const struct zs_mirror *mirror);

/* ---- Environment maps --------------------------------------------------------------------- */

/* A shader that looks its texture up by the normal in the camera's axes (matcap, sphere mapping):
 * chrome, or light from all sides at no cost. The image is that of a sphere which fills it, up to
 * the middles of its outermost texels: its middle faces the camera, its upper edge is up. Nothing
 * lights it. In a mirror pass the axes are those of the mirrored picture.
 *
 * It needs mesh.normal (unit), material.texture, and mesh.uv_bits above log2 of the texture's width
 * and height, at most 15; 15 is best (else ZS_ERR_MESH). mesh.uv is not read.
 * Errors  2^-14.5 of the image's width, half a step of 2^-uv_bits, and those of zs_shade_texture.
 * Cost    that of zs_shade_texture whose triangles are not small (zs_fast_texture helps with
 *         divided pixels alone), and 75 instructions more a vertex on a Cortex-M3. */
extern const struct zs_shader zs_shade_matcap;
#define ZS_VARYINGS_MATCAP 2u

/* ---- Billboards --------------------------------------------------------------------------- */

/* Turn a pose so that the mesh's x, y and z point to the camera's right, up and back: a quad in its
 * plane z = 0 lies parallel to the screen, and is as large as its distance says. pos and scale
 * stay. It is a triangle mesh like any other: keys, strips and tracking know nothing of it. Call it
 * for each frame. In a mirror pass, give the camera of zs_mirror_camera.
 * Exact: the elements are the camera's. */
void zs_pose_face(struct zs_pose *pose, const struct zs_camera *camera);

/* Turn a pose about the axis `up` so that its z points to the eye as far as it can: trees.
 *
 * up      world axes, any length but 0; the mesh's y.
 * Error   2^-27 an element, more where the eye is less than 2^12 world units from the axis: its
 *         direction is known to a world unit.
 * Return  ZS_OK; ZS_ERR_RANGE: pose or eye outside the world; ZS_ERR_VECTOR: up is 0 0 0, or
 *         the eye is straight above or below. After an error pose is untouched. */
int zs_pose_face_upright(struct zs_pose *pose, const struct zs_camera *camera,
                         const int32_t up[3]);

ZS_C_END

#endif
