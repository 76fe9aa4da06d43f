/* Texels with alpha, for shaders that leave texels out or blend them. Internal.
 *
 *     .start = zs_alpha_start,
 *     static void my_run(struct zs_job *job, const struct zs_row *row, int32_t r0, int32_t r1)
 *     {
 *         uint16_t px[2 * ZS_ALPHA_RUN];
 *         for (; r0 < r1; r0 += ZS_ALPHA_RUN) {
 *             const int32_t n = zs_min32(r1 - r0, ZS_ALPHA_RUN);
 *             zs_alpha_fetch(job, row, r0, n, px);
 *             ... px[i] is the colour of pixel r0 + i, px[ZS_ALPHA_RUN + i] its alpha
 *         }
 *     }
 *
 * Coordinates are those of shade/texture.c, bit for bit; they do not depend on where a run begins.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_EFFECT_ALPHA_TEXELS_H
#define ZS_EFFECT_ALPHA_TEXELS_H

#include "shade/texture.h"

#define ZS_ALPHA_RUN 32 /* pixels fetched at a time */

/* A shader's `start`, in place of zs_texture_start (shade/stages.h), which it calls. The texture's
 * format may have no alpha; its texels then have 255. Set-up of a triangle takes some 40
 * instructions more. */
void zs_alpha_start(struct zs_job *job);

/* Fetch n = 1 .. ZS_ALPHA_RUN pixels of a scanline from column r0 on, all of them covered by the
 * triangle and inside the viewport. px[i]: colour, lit as the shader's n_varyings and `light` say,
 * RGB565, most significant byte first; px[ZS_ALPHA_RUN + i]: alpha, 0 .. 255. */
void zs_alpha_fetch(struct zs_job *job, const struct zs_row *row, int32_t r0, int32_t n,
                    uint16_t px[2 * ZS_ALPHA_RUN]);

/* Let the rest of job's triangle be drawn from a texture of the shader's own: the copy that this
 * returns, whose fields may be changed. Its format's `fetch` finds the instance's texture by
 * zs_texture_behind. To be called after the textured shader's start. */
struct zs_texture *zs_texture_instead(struct zs_job *job);
const struct zs_texture *zs_texture_behind(const struct zs_texture *instead);

#endif
