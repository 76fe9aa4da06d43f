/* Dithering: fewer colours than RGB565 in a way that their mean is the colour.
 *
 *     static const struct zs_dither to_grey = { .format = &zs_dither_grey4,
 *                                               .pattern = &zs_dither_blue };
 *     static const struct zs_resolve hook = { .draw = zs_dither_draw, .ctx = (void *)&to_grey };
 *
 * A hook, the last one of a scene, replaces each pixel by a colour of the format: it goes to the
 * level above or below, whichever a threshold at that place of the frame says. The picture stays
 * RGB565, in colours that a panel of that format shows as these levels and nothing between them
 * (hal/panel rounds none of them a second time). Thresholds stand still from frame to frame.
 *
 * Dithering to RGB565 is done where the bits still are: zs_shade_smooth_ordered and _blue.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_DITHER_H
#define ZS_DITHER_H

#include "zstrip.h"

ZS_C_BEGIN

/* Thresholds, a square that is repeated over the frame. Cost in flash: 64 and 256 bytes. */
struct zs_dither_pattern {
    const uint8_t *rank; /* [2^log2][2^log2], rows: 0 .. 4^log2 - 1, each once. The threshold is
                            (rank + 1/2) / 4^log2 */
    uint8_t log2;        /* 1 .. 4 */
};
extern const struct zs_dither_pattern zs_dither_ordered; /* Bayer's matrix of 8 x 8 */
extern const struct zs_dither_pattern zs_dither_blue; /* 16 x 16, blue noise: without a texture of
                                                         its own, a little coarser */

/* What is left of a colour. Over an area of one colour, the mean of a pattern's square is that
 * colour to 1 / (2 * 4^log2) + 1/1000 of a step between two levels. */
struct zs_dither_format {
    /* Replace n > 0 pixels, from column x on; rank is the pattern's row, mask its length - 1; a
     * rank r's threshold is (2 r + 1) << shift, uq0_16. */
    void (*run)(uint16_t *out, uint32_t n, uint32_t x, const uint8_t *rank, uint32_t mask,
                uint32_t shift);
};
extern const struct zs_dither_format zs_dither_rgb332; /* 8, 8 and 4 levels of red, green, blue */
extern const struct zs_dither_format zs_dither_grey4;  /* 16 greys of a panel (hal/panel/panel.h),
                                                          from 77 red + 150 green + 29 blue */
extern const struct zs_dither_format zs_dither_mono;   /* black and white, from that grey */

/* Without one of them nothing is drawn. zs_invalidate (zs_damage.h) after a change under damage
 * tracking. */
struct zs_dither {
    const struct zs_dither_format *format;
    const struct zs_dither_pattern *pattern;
};

/* The function of a struct zs_resolve; ctx is the struct zs_dither, which is not written. Cost on a
 * Cortex-M3: 28 to 29 instructions a pixel, to black and white 22. 0.2 KB of flash and as much for
 * each format. */
void zs_dither_draw(void *ctx, const struct zs_target *target);

/* zs_shade_smooth, its colours rounded to RGB565 by a threshold in place of to nearest, so that
 * light that changes slowly shows no bands: the mean over a pattern's square is the colour to 1/32
 * code. Needs what zs_shade_smooth needs; drawn without its accelerator. Cost: 7 to 8
 * instructions a pixel more (Cortex-M3), 0.9 KB of flash and the pattern. */
extern const struct zs_shader zs_shade_smooth_ordered;
extern const struct zs_shader zs_shade_smooth_blue;

ZS_C_END

#endif
