/* Showpieces: scenes with effects. A piece is one file here, a line in pieces.c and one in ../sizes.h; it names
 * whatever headers of the library it needs, and a firmware links what its own piece names.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef PIECES_H
#define PIECES_H

#include "stage.h"
#include "zs_pass.h"

#ifdef __cplusplus
extern "C" {
#endif

#define PIECE_PASSES_MAX 2u

/* A demo scene, and what a frame of it takes besides. demo.pose fills what is static in the piece's file (overlays,
 * fog, passes), so that one picture of a piece is drawn at a time. */
struct piece {
    struct demo demo;
    const struct zs_method *method; /* NULL: the depth buffer */
    const struct zs_pass *pass;     /* [n_passes], filled by demo.pose; scene and camera of struct demo_frame are then
                                       what the first pass draws */
    uint16_t n_passes;              /* 0 .. PIECE_PASSES_MAX; 0: the scene by itself */
};

/* A piece, piece_ID, composed for 240 x 240 px; last the accelerators for what is in it. */
#define PIECE(id, what_, frames_, varyings_, method_, pass_, n_passes_, pose_, ...) \
    static const struct zs_fast *const fast_##id[] = { __VA_ARGS__, ZS_FAST_END }; \
    const struct piece piece_##id = { .demo = { .name = #id, .what = what_, .width = 240, .height = 240, \
                                                .frames = frames_, .varyings = varyings_, .depth = &zs_depth_float, \
                                                .fast = fast_##id, .pose = pose_ }, \
                                      .method = method_, .pass = pass_, .n_passes = n_passes_ }

/* Begin a frame that piece->demo.pose has filled, with its scene and camera. memory: [PIECE_PASSES_MAX], this
 * renderer's, kept until the frame's end. Return as zs_frame_begin. */
static inline int piece_begin(struct zs_renderer *r, const struct piece *piece, const struct zs_scene *scene,
                              const struct zs_camera *camera, struct zs_pass_memory *memory)
{
    return piece->n_passes ? zs_frame_begin_passes(r, piece->pass, memory, piece->n_passes)
                           : zs_frame_begin(r, scene, camera);
}

/* The same for a whole frame, as zs_render. */
static inline int piece_render(struct zs_renderer *r, const struct piece *piece, const struct zs_scene *scene,
                               const struct zs_camera *camera, struct zs_pass_memory *memory,
                               const struct zs_sink *sink)
{
    return piece->n_passes ? zs_render_passes(r, piece->pass, memory, piece->n_passes, sink)
                           : zs_render(r, scene, camera, sink);
}

extern const struct piece *const pieces[]; /* [n_pieces] */
extern const uint32_t n_pieces;
extern const struct piece piece_stilllife, piece_cockpit, piece_forest;

#ifdef __cplusplus
}
#endif

#endif
