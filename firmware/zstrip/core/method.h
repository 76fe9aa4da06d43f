/* The interface of a method of hidden-surface removal. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_CORE_METHOD_H
#define ZS_CORE_METHOD_H

#include "zstrip.h"

struct zs_job;
struct zs_row;

struct zs_method {
    /* Called by zs_init: return ZS_OK, or the error with which r->config is refused. A method that
     * colours pixels in its own way sets r->span. NULL in zs_method_buffer alone. */
    int (*begin)(struct zs_renderer *r);
    /* Bin if r->band_end says so (zs_walk), and draw strip r->strip. What a method keeps meanwhile
     * is on the stack of this function; its other hooks find it at r->method_state. */
    void (*strip)(struct zs_renderer *r);
    /* Called in a walk when the band is one strip and a pool is full: make room for at least three
     * vertices and one triangle. */
    void (*full)(struct zs_renderer *r);
    /* Take the strip's triangles, those in its bin and those in r->active, which continue from the
     * strip above. Return them as a list in the order in which they are drawn. */
    uint16_t (*list)(struct zs_renderer *r);
    uint8_t passes; /* 1: frames may be drawn in passes (zs_pass.h): a list has the triangles of a
                       pass before those of the next one */
    uint8_t buffer; /* 1: opaque triangles are drawn as zs_method_buffer does; layers (.layer) are
                       not */
    /* once: 1: of each pixel, only the nearest triangle's colour is computed. records: 1: of the
     * triangle pool it keeps a part for itself. Of 5/2 n + 64, n are triangles at least */
    uint8_t once, records;
};

/* zs_method.list in scene order. */
uint16_t zs_scene_list(struct zs_renderer *r);
/* Draw the binned triangles, and empty the pools. */
void zs_buffer_full(struct zs_renderer *r);

/* The depth buffer: the method of a configuration without one (core/buffer.c). */
extern const struct zs_method zs_method_buffer;

#endif
