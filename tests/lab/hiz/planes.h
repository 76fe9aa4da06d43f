/* Lossless compression of depth tiles as planes.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef TESTS_PLANES_H
#define TESTS_PLANES_H

#include <stdint.h>

enum planes_kind { PLANES_FLAT, PLANES_4, PLANES_2, PLANES_1, PLANES_KINDS };

#define PLANES_TILE 8                              /* rows and columns */
#define PLANES_RAW (2 * PLANES_TILE * PLANES_TILE) /* bytes of a tile */

/* Sums over strips. */
struct planes {
    uint32_t tiles, of[PLANES_KINDS];
    uint32_t raw, packed;       /* bytes, with 2 bits a tile */
    uint32_t strip_raw, worst;  /* bytes of a strip; of the strip that packs worst */
    uint32_t pixels, operations; /* of packed tiles, to decode */
    uint32_t wrong;             /* tiles that were not what they were after decoding; 0 */
};

/* Pack and unpack the depth of a strip, keys[h][w]; what is beyond its edges counts as cleared. */
void planes_strip(struct planes *p, const uint16_t *keys, int w, int h);

#endif
