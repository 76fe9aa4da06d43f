/* The pictures that tests/tools/convert.sh converts, by formula.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef PAINT_H
#define PAINT_H

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* A colour of a picture, 0 .. 255. */
static inline void paint(const char *kind, unsigned x, unsigned y, unsigned w, unsigned h,
                         uint8_t rgb[3])
{
    const double u = (x + 0.5) / w, v = (y + 0.5) / h;
    if (strcmp(kind, "photo") == 0) {
        rgb[0] = (uint8_t)(127.5 + 127.0 * sin(7 * u + 3 * sin(5 * v)));
        rgb[1] = (uint8_t)(127.5 + 127.0 * sin(11 * v + 2 * cos(9 * u * v)));
        rgb[2] = (uint8_t)(127.5 + 127.0 * cos(6 * (u + v)));
        return;
    }
    const unsigned most = (unsigned)strtoul(kind, NULL, 10);
    const unsigned c =
        ((x * 200 / w) + 3 * (y * 64 / h) * (y * 64 / h)) % most; /* well apart: c * 37 mod 256 */
    rgb[0] = (uint8_t)(c * 37);
    rgb[1] = (uint8_t)(c * 101 + 40);
    rgb[2] = (uint8_t)(255 - c * 59);
}

#endif
