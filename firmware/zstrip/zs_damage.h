/* Damage tracking: send only what changed on the panel, and draw only what may have changed.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_DAMAGE_H
#define ZS_DAMAGE_H

#include "zstrip.h"

ZS_C_BEGIN

/* Strip hashes: what a panel shows, as one hash for each strip and column of cells. There is one
 * for each panel, and all renderers that draw for the panel share it, so that each knows what the
 * others have drawn. The fields belong to the library. */
struct zs_strip_hashes {
    uint64_t *sum;
    uint16_t width, height, strip_h, columns;
};

/* Begin with a panel whose picture is unknown.
 *
 * memory   [ZS_STRIPS(height, strip_h) * columns], caller's, kept; its contents do not matter.
 * width, height, strip_h  as in the configuration of the renderers.
 * columns  1 .. width. They are equally wide, but for the last ones.
 * Return   ZS_OK; ZS_ERR_NULL; ZS_ERR_SIZE (a number is out of range): *sums is untouched. */
int zs_strip_hashes_init(struct zs_strip_hashes *sums, uint64_t *memory, uint32_t width,
                         uint32_t height, uint32_t strip_h, uint32_t columns);

/* Send only what changed. From now on each strip is compared, column by column, with what the panel
 * shows. zs_render does not submit a strip without a change, and a sink may send the columns
 * dirty_x and dirty_w alone. Every strip is still drawn; after this call, zs_damage_track begins
 * anew with all strips.
 *
 * sums     the panel's, kept by the caller; NULL: stop comparing. Renderers on several cores may
 *          share it, because each writes the hashes of the strips that it draws.
 * Exact    a change within one word of two pixels is always seen. Others are missed with odds of
 *          2^-64, because hashes are compared and not pixels.
 * Cost     about ten instructions for two pixels.
 * Return   ZS_OK; ZS_ERR_NULL; ZS_ERR_SEQUENCE (r is not set up, or a frame is open); ZS_ERR_SIZE
 *          (sums is for another frame size or strip height): nothing changes. zs_init ends it. */
int zs_damage_compare(struct zs_renderer *r, struct zs_strip_hashes *sums);

/* Draw only what may have changed. From now on zs_frame_begin compares each instance with the frame
 * before: its pose, and the fields of its mesh, material, texture and depth state, but not the
 * arrays that they point at. A strip is dirty if an instance that differs could reach it, before or
 * now. A strip that is not dirty is not drawn: zs_frame_strip gives it out with dirty_w 0. A dirty
 * strip stays dirty until it is drawn, in whichever frame.
 *
 * All strips are dirty when the camera, light, background, resolve hooks (zs_resolve.draw and ctx,
 * not what they point to) or number of instances differ (so take a thing away by moving it out of
 * view: pose.pos[1] = -ZS_WORLD_MAX), when the distance of the farthest instance in view passes a
 * power of two, and after a frame that was refused. Strips that are drawn are the
 * same as without this call, bit for bit. With zs_damage_compare too, only the columns that differ
 * are dirty in a strip that is drawn.
 *
 * memory       [ZS_DAMAGE_WORDS(n_instances, height, strip_h)], caller's, kept; its contents do not
 *              matter. NULL: draw everything.
 * n_instances  0 .. 65535, the most that a scene may have; zs_frame_begin refuses more with
 *              ZS_ERR_SIZE.
 * Your duty    call zs_invalidate when bytes change that meshes, textures or palettes point at, and
 *              when something else has drawn on the panel. A mesh's sphere must hold the mesh.
 * Exact        a change of one field of a pose is always seen. Others are missed with odds of 2^-64
 *              each, because 64-bit hashes are compared; then the picture stays wrong until the
 *              instance changes again.
 * Cost         zs_frame_begin: 400 instructions for an instance where nothing differs, in place of
 *              its checks; 3,000 more for each instance that differs. 100 for a strip that is not
 *              drawn. An instance that reaches a strip that is drawn is transformed as a whole, but
 *              for clusters that lie elsewhere.
 * Return       ZS_OK; ZS_ERR_NULL; ZS_ERR_SEQUENCE (r is not set up, or a frame is open);
 *              ZS_ERR_SIZE: nothing changes. zs_init ends it. */
#define ZS_DAMAGE_WORDS(n_instances, height, strip_h)                                              \
    (2u + 4u * ZS_U32(n_instances) + ZS_STRIPS(height, strip_h))
int zs_damage_track(struct zs_renderer *r, uint32_t *memory, uint32_t n_instances);

/* Draw only the columns that may have changed, in the strips that zs_damage_track draws. A moving
 * object then costs its own rectangle. Of other triangles in the rectangle, wide ones are cut to
 * it; small ones, those with a depth state, and all under zs_depth_linear in perspective are drawn
 * whole.
 *
 * on         0: whole strips again, as after zs_damage_track.
 * Your duty  send dirty_x and dirty_w alone, because px and depth are undefined beside them. The
 *            columns are widened so that dirty_x and its end can be rounded to multiples of
 *            ZS_DAMAGE_GRAIN, or to the frame's end. zs_damage_compare compares those of its
 *            columns that were drawn whole.
 * Exact      the columns given out equal those of a full frame, bit for bit.
 * Cost       2,000 instructions more than zs_damage_track for an instance that differs, and 25 to
 *            80 for a triangle in a strip that is drawn in part. Where moving objects fill most of
 *            the frame, whole strips are a little cheaper.
 * Return     ZS_OK; ZS_ERR_NULL; ZS_ERR_SEQUENCE (zs_damage_track is not on, or a frame is open).
 *            zs_damage_track and zs_init end it. */
#define ZS_DAMAGE_GRAIN 8u /* px: a byte or page of any panel's RAM */
int zs_damage_columns(struct zs_renderer *r, int on);

/* Tell that the panel no longer shows what was given out. It was reset, asleep or rotated,
 * something else drew on it, or a strip could not be sent (zs_render sees to that by itself). Also
 * call it when bytes behind pointers of the scene change.
 *
 * rect    the strips and columns that touch it are dirty from now on; NULL: all. May be called
 *         within a frame, which then walks the scene again.
 * Return  ZS_OK; ZS_ERR_NULL; ZS_ERR_SEQUENCE (r is not set up). No effect without
 *         zs_damage_compare and zs_damage_track. */
int zs_invalidate(struct zs_renderer *r, const struct zs_rect *rect);

ZS_C_END

#endif
