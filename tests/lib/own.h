/* Stages of one's own for random scenes: a shader, a sky, and what is drawn over strips.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef TESTS_OWN_H
#define TESTS_OWN_H

#include "zs_shader.h"

/* Three varyings, a face's value and the pixel's place go into a colour; needs config.varyings of 3. */
extern const struct zs_shader own_shader;
/* The same, but that some pixels are left as they are, and others are mixed with what is there. */
extern const struct zs_shader glass_shader;
/* struct zs_background.fill: differs from pixel to pixel. ctx: a uint16_t */
void own_fill(void *ctx, uint16_t *out, uint16_t x, uint16_t y, uint16_t n);
/* struct zs_resolve.draw: colours and keys of a rectangle go into its colours. ctx: a struct zs_rect, px */
void own_draw(void *ctx, const struct zs_target *t);

#endif
