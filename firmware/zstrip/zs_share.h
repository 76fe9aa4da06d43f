/* A frame that two renderers draw together, each on a core of its own: each bins a part of the
 * scene's triangles, and gets the other's; from then on each can draw any strip.
 *
 *     zs_share_set(&share, &renderer[0], &renderer[1], 32768);  one core, before the frame
 *     zs_frame_begin(&renderer[core], &scene, &camera);         both, with the same arguments
 *     for (step = 0; step < ZS_SHARE_STEPS; step++) {
 *         zs_share_step(&share, core, step);
 *         wait until the other core is through with this step, too
 *     }
 *     zs_frame_strip or zs_frame_skip for each strip            each core, in any order of cores
 *
 * Without the steps each renderer bins the whole scene. The picture is the same, bit for bit. Both
 * renderers have the same configuration, and an arena each. Needs ZS_FAST_FRAME; not for passes,
 * damage tracking, or a method other than the depth buffer, nor where the pools do not hold what
 * one pass draws: then steps do nothing or give up, and each renderer bins for itself.
 *
 * In zs_stats, tris_in and instances_in of each renderer count the whole scene; tris_frustum and
 * instances_culled also what is wholly the other's part. The other counts, tris_drawn to tris_index
 * and tris_clipped, are of its own part: the sum of both is the frame's.
 *
 * What it is worth stands in fast/share.c. Not with ZS_NO_FAST.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_SHARE_H
#define ZS_SHARE_H

#include "zstrip.h"

ZS_C_BEGIN

#define ZS_SHARE_STEPS 4u

/* What is binned by one renderer. The fields belong to the library. */
struct zs_share_part {
    uint32_t begin, end;            /* of the scene's triangles, in its order over all instances */
    uint32_t number, first;         /* an instance, and its first triangle in that order ... */
    uint32_t from, to;              /* ... and of its own triangles, those that are in the part */
    uint32_t tris, least, verts;    /* in the pools: triangles; the first vertex, the last + 1 */
    uint32_t of;                    /* the instance whose vertices `least` is one of */
    int32_t ok;                     /* 1: it is; 0: not tried; -1: pools are too small */
};

/* The state of a shared frame; seen by both cores. */
struct zs_share {
    struct zs_renderer *r[2];
    struct zs_share_part part[2];
    uint32_t cut;
    uint32_t tris, verts, tris_end, verts_end; /* the end of part 0 in both pools, and of part 1 */
    int32_t joined;
};

/* Share the next frame of two renderers, which are set up, and may be between frames.
 *
 * share  the caller's, until the frame's last step
 * cut    0 .. 65536: this part of the scene's triangles, in 2^-16, is the first renderer's. Choose
 *        it so that step 0 takes both as long.
 * Costs some instructions. */
void zs_share_set(struct zs_share *share, struct zs_renderer *first, struct zs_renderer *second,
                  uint32_t cut);

/* Do one step of a frame that both renderers have begun without an error.
 *
 * core   0, 1: the renderer's number
 * step   0 .. ZS_SHARE_STEPS - 1, in order. What the other one has written in the steps before
 *        must be seen
 * Return after the last step 1 if the frame is shared, 0 if each bins for itself. */
int zs_share_step(struct zs_share *share, uint32_t core, uint32_t step);

ZS_C_END

#endif
