/* Pixels that are not as the double-precision reference has them.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef WEB_WRONG_H
#define WEB_WRONG_H

#include "frame.h"
#include "image.h"
#include "reference.h"

struct web_wrong {
    uint32_t missing, extra; /* drawn by the reference alone; by the renderer alone */
    uint32_t color,
        near; /* drawn by both: a channel is more than one step of RGB565 off; one step */
};

/* The frame, darkened, with red where a pixel is missing, yellow where there is one too many, magenta where its colour
 * is another one, blue where it is one step off. */
void web_wrong_draw(struct sim_picture *out, struct web_wrong *n, const struct sim_frame *ours,
                    const struct ref_image *reference);

#endif
