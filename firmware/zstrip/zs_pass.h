/* Passes: several scenes or cameras in one frame (split screen, an inset, a model over a scene).
 *
 *     static struct zs_pass_memory memory[2];
 *     const struct zs_pass pass[2] = {
 *         { .scene = &road, .camera = &forwards },
 *         { .scene = &road, .camera = &backwards, .viewport = { 80, 0, 80, 30 } } };
 *     err = zs_render_passes(&renderer, pass, memory, 2, &sink);
 *
 * A pass draws one scene with one camera into one rectangle of the frame, its viewport. The pixels
 * of the viewport equal, bit for bit, those of a frame of the viewport's size. All passes of a
 * strip are drawn before the strip is sent, so that the panel receives each pixel once. The passes
 * share the pools: max_tris and max_verts are for the triangles and vertices of all passes.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_PASS_H
#define ZS_PASS_H

#include "zstrip.h"

#ifdef __cplusplus
extern "C" {
#endif

enum zs_keep { /* or-ed: what is not cleared in the viewport before a pass is drawn */
    ZS_KEEP_COLOR = 1, /* keep the colours of the passes before; without it, the viewport is filled
                          with the background of the pass's scene */
    ZS_KEEP_DEPTH = 2  /* keep the depth keys of the passes before; without it, the viewport's keys
                          are cleared. Keys of two passes can be compared only if both have the same
                          camera and the same farthest instance */
};

struct zs_pass {
    const struct zs_scene *scene;   /* with its light, background and resolve hooks */
    const struct zs_camera *camera;
    struct zs_rect viewport;        /* px, inside the frame; w and h 0: the whole frame */
    const struct zs_depth *depth;   /* the mapping; NULL: the configuration's. Either all passes
                                       have depth memory or none has */
    uint8_t keep;                   /* enum zs_keep; without effect in the first pass */
};

/* State of a pass during a frame. The fields belong to the library. */
struct zs_pass_memory {
    struct zs_view view;
    struct zs_camera camera;
    struct zs_light light;
    uint32_t first, end;
};

/* Draw and send a frame of several passes; otherwise as zs_render. A pixel outside all viewports
 * gets the background of the first pass's scene. After all passes of a strip have been drawn, the
 * resolve hooks of all their scenes are called with the whole strip.
 *
 * pass    [n], drawn in this order; the array, its scenes and its cameras are borrowed until the
 *         return.
 * memory  [n], the caller's, kept until the return; its contents do not matter.
 * n       1 .. 65535; all scenes together have at most 65535 instances.
 * Cost    a pass costs about 1,000 instructions in each strip and the clearing of its viewport, in
 *         addition to its triangles. The accelerators `touch` and `tiles` do nothing in a frame of
 *         passes.
 * Return  as zs_render. ZS_ERR_SIZE: n, a viewport that is not inside the frame, or too many
 *         instances; ZS_ERR_DEPTH: one pass with depth memory and one without; ZS_ERR_RANGE: keep;
 *         ZS_ERR_SEQUENCE: zs_damage_track is on (zs_damage_compare may be). */
int zs_render_passes(struct zs_renderer *r, const struct zs_pass *pass,
                     struct zs_pass_memory *memory, uint32_t n, const struct zs_sink *sink);

/* Begin a frame of several passes; otherwise as zs_frame_begin. pass and memory are borrowed until
 * zs_frame_end. */
int zs_frame_begin_passes(struct zs_renderer *r, const struct zs_pass *pass,
                          struct zs_pass_memory *memory, uint32_t n);

#ifdef __cplusplus
}
#endif

#endif
