/* Letters for textures: 5 x 7 dots.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef GEN_FONT_H
#define GEN_FONT_H

#include <stdint.h>

/* dots */
#define FONT_W 5
#define FONT_H 7

/* The rows of a letter from the top, its left dot in bit 4; NULL: there is none. */
const uint8_t *font_rows(char letter);

#endif
