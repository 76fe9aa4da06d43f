/* Passes: several scenes or cameras in one frame (split screen, an inset, a model over a scene).
 *
 *     static struct zs_pass_memory memory[2];
 *     const struct zs_pass pass[2] = {
 *         { .scene = &road, .camera = &forwards },
 *         { .scene = &road, .camera = &backwards, .viewport = { 80, 0, 80, 30 } } };
 *     err = zs_render_passes(&renderer, pass, memory, 2, &sink);
 *
 * A pass draws a scene, seen by a camera, into a rectangle of the frame, its viewport. Set a
 * perspective camera with the viewport's height, not the frame's: a focal length is in pixels.
 * The picture is, bit for bit, that of a frame of the viewport's size; but skies, fragment stages
 * and resolve hooks are told where a pixel is in the whole frame. All passes of a strip are drawn
 * before the strip is sent, so that the panel gets each pixel once. All passes share the pools:
 * max_tris and max_verts count the triangles and vertices of all.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_PASS_H
#define ZS_PASS_H

#include "zstrip.h"

ZS_C_BEGIN

enum zs_keep { /* or-ed: what a pass finds in its viewport */
    ZS_KEEP_COLOR = 1, /* what the passes before have drawn, not its scene's background */
    ZS_KEEP_DEPTH = 2  /* their keys: the pass is in front only where its keys are less. For passes
                          that have the same camera and the same farthest instance in view;
                          else the wrong surfaces are hidden. The pass before must have the same
                          mapping, or it is refused; so should all that have drawn there */
};

struct zs_mirror; /* zs_environment.h */
struct zs_mask;

struct zs_pass {
    const struct zs_scene *scene;   /* its light and its background hold for this pass */
    const struct zs_camera *camera;
    struct zs_rect viewport;        /* px, inside the frame; all 0: the whole frame */
    const struct zs_depth *depth;   /* NULL: the configuration's. All passes have depth memory, or
                                       none has */
    uint8_t keep;                   /* enum zs_keep. The first pass always clears the whole strip */
    uint8_t early;                  /* 1: the resolve hooks of its scene, which no other pass has,
                                       are called before the next pass begins, in place of at the
                                       end: fog behind transparent layers, fog in a mirror */
    const struct zs_mirror *mirror; /* the pass shows what the camera sees in it; NULL: directly */
    const struct zs_mask *mask;     /* it is seen in windows of the pass before; NULL: everywhere */
};

/* State of a pass during a frame. The fields belong to the library. */
struct zs_pass_memory {
    struct zs_view view;
    struct zs_camera camera;
    struct zs_light light;
    struct zs_reflection mirror;
    uint16_t first, end;        /* its instances */
    const struct zs_pass *pass; /* in the first one: the list, ... */
    uint16_t n, now, begun;     /* ... its length, the current pass, passes that are begun, ... */
    const struct zs_fast_batch *batch; /* ... and accelerators of the passes without a mirror */
    const struct zs_fast_clusters *clusters;
};

/* As zs_render, in passes. Pixels in no viewport show the background of the first pass's scene.
 * When all passes have been drawn, the resolve hooks of each scene are called once, with the
 * whole strip; those of an `early` pass before the next pass.
 *
 * pass    [n], drawn in this order; the array, its scenes and its cameras are borrowed until the
 *         return.
 * memory  [n], the caller's, kept until the return; its contents do not matter.
 * n       1 .. 65535; all scenes together have at most 65535 instances.
 * Cost    of a pass beyond its picture: the clearing of its viewport, and some hundred
 *         instructions in each strip that the viewport reaches. The accelerators `touch` and
 *         `tiles` do nothing in such a frame.
 * Return  as zs_render. ZS_ERR_SIZE: n, or too many instances; ZS_ERR_PASS: a viewport that is
 *         not inside the frame, a keep that is no enum zs_keep or keeps the keys of another
 *         mapping, a mask or windows that zs_environment.h does not allow, some passes with depth
 *         memory and some without, or a method that knows no passes; ZS_ERR_SEQUENCE:
 *         zs_damage_track is on (zs_damage_compare may be). */
int zs_render_passes(struct zs_renderer *r, const struct zs_pass *pass,
                     struct zs_pass_memory *memory, uint32_t n, const struct zs_sink *sink);

/* Begin a frame of several passes; otherwise as zs_frame_begin. pass and memory are borrowed until
 * zs_frame_end. */
int zs_frame_begin_passes(struct zs_renderer *r, const struct zs_pass *pass,
                          struct zs_pass_memory *memory, uint32_t n);

ZS_C_END

#endif
