/* The gallery's page: HTML that needs no other file.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_GALLERY_PAGE_H
#define SIM_GALLERY_PAGE_H

#include <stdio.h>

#include "gallery_effects.h"
#include "image.h"
#include "method_names.h"

#define GALLERY_SCENES 4

/* A scene drawn by a method. */
struct gallery_shot {
    struct sim_picture picture, overdraw;
    struct zs_stats stats;
    uint32_t arena_bytes, depth_bytes;
    uint32_t pixels, visible, written; /* of the frame; that something was drawn on; colourings of pixels */
    uint32_t wrong;                    /* pixels that are not as the double-precision reference has them */
    double instructions;               /* on a Cortex-M3 */
    int estimated;                     /* flag: these, as zsim budget estimates them */
};

/* Write the page. shot: [SIM_METHODS][GALLERY_SCENES]; scene: names; effect: [GALLERY_EFFECTS]. */
void gallery_page_write(FILE *f, struct gallery_shot (*shot)[GALLERY_SCENES], const char *const scene[GALLERY_SCENES],
                        const struct sim_picture *effect);

#endif
