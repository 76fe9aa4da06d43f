/* Looks: frames with effects together, in several passes, and the showpieces. What they take is counted on emulated
 * cores (tests/lab/effects/looks_app.c) and estimated (looks_error.c).
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_LOOKS_H
#define SIM_LOOKS_H

#include "zs_pass.h"

#define LOOK_STRIP 24u   /* rows of a strip */
#define LOOK_TRIS 8000u  /* pools: one walk over each scene */
#define LOOK_VERTS 6000u

struct look {
    const char *name;
    struct zs_pass pass[3];
    uint32_t n; /* passes */
    const struct zs_method *method;
    uint16_t w, h;
    uint8_t varyings;
};

/* Make look i, in static memory: one at a time. Return 0: there is none. err, if not NULL, becomes ZS_OK or why it
 * could not be made. */
int look_make(struct look *out, uint32_t i, int *err);

/* Draw it by a renderer of its configuration (LOOK_STRIP, 16-bit float depth, 8 sub-pixel bits). Return as
 * zs_render. */
int look_draw(const struct look *look, struct zs_renderer *r, const struct zs_sink *sink);

#endif
