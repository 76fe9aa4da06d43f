/* Several pictures in one frame: split screen, an inset, a model in front of a scene.
 *
 *     static struct zs_pass_memory memory[2];
 *     const struct zs_pass pass[2] = {
 *         { .scene = &road, .camera = &forwards },
 *         { .scene = &road, .camera = &backwards, .viewport = { 80, 0, 80, 30 } } };
 *     err = zs_render_passes(&renderer, pass, memory, 2, &sink);
 *
 * A pass draws a scene, seen by a camera, into a rectangle of the frame. The picture there is, bit for
 * bit, that of a frame of the rectangle's size. All passes of a strip are drawn before the strip is
 * sent, so that the panel gets each pixel once. All passes share the pools: max_tris and max_verts
 * count the triangles and vertices of all.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_PASS_H
#define ZS_PASS_H

#include "zstrip.h"

#ifdef __cplusplus
extern "C" {
#endif

enum zs_keep { /* or-ed: what a pass finds in its viewport */
    ZS_KEEP_COLOR = 1, /* what the passes before have drawn, not its scene's background */
    ZS_KEEP_DEPTH = 2  /* their keys: the pass is in front only where its keys are less. Keys can be
                          compared only between passes of one camera and one farthest instance */
};

struct zs_pass {
    const struct zs_scene *scene;   /* its light, background and resolve hooks hold for this pass */
    const struct zs_camera *camera;
    struct zs_rect viewport;        /* px, inside the frame; w and h 0: the whole frame */
    const struct zs_depth *depth;   /* NULL: the configuration's. All passes have depth memory, or none */
    uint8_t keep;                   /* enum zs_keep; of no effect in the first pass */
};

/* What the renderer keeps of a pass during a frame. The fields are the library's. */
struct zs_pass_memory {
    struct zs_view view;
    struct zs_camera camera;
    struct zs_light light;
    uint32_t first, end;
};

/* As zs_render, in passes. Pixels in no viewport show the background of the first pass's scene. When
 * all passes have been drawn, the resolve hooks of all scenes are called with the whole strip.
 *
 * pass    [n], drawn in this order; borrowed until the return, as their scenes and cameras are.
 * memory  [n], the caller's, kept until the return; its contents do not matter.
 * n       1 .. 65535; all scenes together have at most 65535 instances.
 * Cost    of a pass beyond its picture: about 1,000 instructions in each strip, and the clearing of its
 *         viewport. The accelerators `touch` and `tiles` do nothing in such a frame.
 * Return  as zs_render. ZS_ERR_SIZE: n, a viewport that is not inside the frame, or too many
 *         instances; ZS_ERR_DEPTH: one pass with depth memory and one without; ZS_ERR_RANGE: keep;
 *         ZS_ERR_SEQUENCE: zs_damage_track is on (zs_damage_compare may be). */
int zs_render_passes(struct zs_renderer *r, const struct zs_pass *pass,
                     struct zs_pass_memory *memory, uint32_t n, const struct zs_sink *sink);

/* As zs_frame_begin, in passes. pass and memory are borrowed until zs_frame_end. */
int zs_frame_begin_passes(struct zs_renderer *r, const struct zs_pass *pass,
                          struct zs_pass_memory *memory, uint32_t n);

#ifdef __cplusplus
}
#endif

#endif
