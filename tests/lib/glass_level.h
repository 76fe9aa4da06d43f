/* What a grey or one-bit panel should show of a colour, from the formulas in panel.h, once more and by other means:
 * divisions where the driver has none, the matrix from its rule where the driver has a table.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef TESTS_GLASS_LEVEL_H
#define TESTS_GLASS_LEVEL_H

#include <stdint.h>

static inline unsigned quantise_grey8(unsigned r, unsigned g, unsigned b)
{
    return (77 * r + 150 * g + 29 * b + 128) / 256;
}

/* 0 .. 15 */
static inline unsigned quantise_level(unsigned r, unsigned g, unsigned b)
{
    return (quantise_grey8(r, g, b) * 15 + 127) / 255;
}

/* The ordered matrix of 8 x 8: from one of 2 x 2, 0 2 / 3 1, put into itself twice. */
static inline unsigned quantise_order(unsigned x, unsigned y)
{
    unsigned order = 0;
    for (unsigned bit = 0; bit < 3; bit++) {
        const unsigned xb = x >> bit & 1, yb = y >> bit & 1;
        order = order * 4 + (yb ? (xb ? 1 : 3) : (xb ? 2 : 0));
    }
    return order;
}

/* 0 or 1 for a pixel of the picture */
static inline unsigned quantise_bit(unsigned r, unsigned g, unsigned b, unsigned x, unsigned y)
{
    return quantise_grey8(r, g, b) > 255 * (2 * quantise_order(x, y) + 1) / 128;
}

#endif
