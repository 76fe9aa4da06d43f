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

struct sim_skin {
    enum sim_texels format; /* 565, pal8 or pal4 */
    uint32_t w, h;          /* powers of two */
    uint8_t clamp;          /* enum zs_clamp */
    uint16_t *texel;        /* [h][w], with 565; else NULL */
    uint8_t *index;         /* [h][w] or [h][w / 2]; with 565 NULL */
    uint16_t palette[SIM_PALETTE_MAX];
    uint32_t n_colors; /* 0 with 565 */
    uint32_t n_levels; /* 1, or with --mipmap as many as the size allows: those after the first follow it
                          in texel or index, each half as wide and high, with the same palette */
    size_t texel_bytes, palette_bytes; /* of all levels */
    struct sim_loss loss; /* against the picture at this size */
    int exact;            /* 1: the same as with 565 */
};

/* The size that a texture will have: its own, halved each way until it is at most `most`. */
void sim_skin_size(uint32_t size[2], const struct sim_texture *texture, const long most[2]);

/* Give it that size: each new texel the mean of those that it covers. */
void sim_texture_halve(struct sim_texture *texture, const long most[2]);

/* Halve and quantise. file: for messages. SIM_OK; SIM_REFUSED, said why, nothing to free. */
int sim_skin_make(struct sim_skin *out, const struct sim_texture *texture, const char *file,
                  const struct sim_convert_options *o);
void sim_skin_free(struct sim_skin *skin);

#endif
