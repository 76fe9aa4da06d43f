/* A texture as firmware stores it.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_TEXEL_PACK_H
#define SIM_TEXEL_PACK_H

#include <stddef.h>
#include <stdint.h>

#include "convert_options.h"
#include "palette.h"
#include "resample.h"

struct sim_packed_texels {
    enum sim_texels format; /* not auto */
    uint32_t w, h;          /* powers of two */
    uint8_t clamp;          /* enum zs_clamp */
    uint8_t alpha_least;    /* of a mask, 1 .. 255; else 0 */
    uint16_t *texel;        /* [h][w], with 565 and 4444; else NULL */
    uint8_t *index;         /* [h][w] or [h][w / 2]; else NULL */
    uint16_t palette[2 * SIM_PALETTE_MAX]; /* with pal8a and pal4a the second half of [2 * n_colors] is alphas */
    uint32_t n_colors; /* 0 without a palette */
    uint32_t n_levels; /* 1, or with --mipmap as many as the size allows: those after the first follow it
                          in texel or index, each half as wide and high, with the same palette */
    size_t texel_bytes, palette_bytes; /* of all levels */
    struct sim_loss loss; /* against the picture at this size */
    int exact;            /* 1: the same as with 565 */
};

/* Of formats with a palette: how many values it has. */
uint32_t sim_packed_palette(const struct sim_packed_texels *packed);

/* The size that a texture will have: its own, halved each way until it is at most `most`. */
void sim_packed_size(uint32_t size[2], const struct sim_texture *texture, const long most[2]);

/* Give it that size: each new texel the mean of those that it covers. */
void sim_texture_halve(struct sim_texture *texture, const long most[2]);

/* Halve and quantise. file: for messages. SIM_OK; SIM_REFUSED, said why, nothing to free. */
int sim_packed_make(struct sim_packed_texels *out, const struct sim_texture *texture, const char *file,
                    const struct sim_convert_options *o);
void sim_packed_free(struct sim_packed_texels *packed);

#endif
