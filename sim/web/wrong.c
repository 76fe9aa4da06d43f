/* By keys, what is drawn; by colours, how.
 *
 * SPDX-License-Identifier: MIT
 */
#include "wrong.h"

#include <stdlib.h>
#include <string.h>

#include "sim.h"

/* The largest step between two colours, of their five or six bits. */
static int steps(uint16_t a, uint16_t b)
{
    const int r = abs((a >> 11) - (b >> 11)), g = abs((a >> 5 & 63) - (b >> 5 & 63)),
              l = abs((a & 31) - (b & 31));
    const int most = r > g ? r : g;
    return most > l ? most : l;
}

void web_wrong_draw(struct sim_picture *out, struct web_wrong *n, const struct sim_frame *ours,
                    const struct ref_image *reference)
{
    static const uint8_t red[3] = { 255, 48, 48 }, yellow[3] = { 255, 224, 0 },
                         magenta[3] = { 255, 64, 255 }, blue[3] = { 32, 96, 224 };
    const size_t pixels = (size_t)ours->width * ours->height;
    memset(n, 0, sizeof *n);
    sim_picture_free(out);
    sim_picture_565(out, ours->width, ours->height, ours->rgb565);
    for (size_t i = 0; i < pixels; i++) {
        uint8_t *to = out->rgb + 3 * i;
        const int here = ours->key[i] != ZS_DEPTH_CLEAR,
                  there = reference->key[i] != ZS_DEPTH_CLEAR;
        const int off = here && there ? steps(ours->rgb565[i], reference->rgb565[i]) : 0;
        const uint8_t *mark = here && !there   ? yellow
                              : there && !here ? red
                              : off > 1        ? magenta
                              : off > 0        ? blue
                                               : NULL;
        n->missing += there && !here;
        n->extra += here && !there;
        n->color += off > 1;
        n->near += off == 1;
        for (int k = 0; k < 3; k++)
            to[k] = mark != NULL ? mark[k] : (uint8_t)(to[k] / 3);
    }
}
