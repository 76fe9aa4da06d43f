/* Pictures as textures: powers of two, at most 1024 texels each way.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_RESAMPLE_H
#define SIM_RESAMPLE_H

#include "image.h"
#include "zstrip.h"

/* What alpha does. */
enum sim_alpha { SIM_ALPHA_OPAQUE, SIM_ALPHA_MASK, SIM_ALPHA_BLEND };

#define SIM_TEXTURE_MAX (1u << ZS_TEXTURE_LOG2_MAX) /* texels each way */

struct sim_texture {
    char *name;                       /* the picture's file, or where in the model it lies */
    struct sim_image image;           /* both sides powers of two, 1 .. SIM_TEXTURE_MAX */
    uint32_t file_width, file_height; /* px, before it was resampled; equal to the image's if not */
    uint8_t clamp;                    /* enum zs_clamp */
    uint8_t alpha_mode, alpha_least; /* as of struct sim_material; opaque: the image has no alpha */
};

/* A texture from a picture: each channel times a factor, then resampled. A side that is a power of
 * two up to SIM_TEXTURE_MAX is kept; another becomes the nearest one (by ratio), at most
 * SIM_TEXTURE_MAX, each new texel the mean of the area that it covers. Colours are averaged and
 * multiplied as the file holds them, without gamma.
 * image   taken over: *image is empty afterwards.
 * name    copied.
 * factor  0 .. 1 a channel, or NULL for 1. */
void sim_texture_make(struct sim_texture *out, struct sim_image *image, const char *name,
                      const double factor[3]);
void sim_texture_free(struct sim_texture *texture);

/* 0 .. 10: log2 of a side of a texture. */
uint8_t sim_texture_log2(uint32_t side);

/* The texels as RGB565 values, [height][width], malloc'ed: the nearest one for each. */
uint16_t *sim_texture_565(const struct sim_texture *texture);

#endif
