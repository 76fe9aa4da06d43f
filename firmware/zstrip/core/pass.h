/* Passes: what the stages see of a frame that is drawn in several. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_CORE_PASS_H
#define ZS_CORE_PASS_H

#include "zstrip.h"

/* Linked where zs_frame_begin_passes is named. */
struct zs_pass_kernel {
    /* Before a strip is drawn: the first pass, nothing cleared for the others. */
    void (*begin)(struct zs_renderer *r);
    /* In a walk: r->scene, camera and view are those of the pass that the instance is in. */
    void (*use)(struct zs_renderer *r, uint32_t number);
    /* While r->strip is drawn: the same, and the viewports of all passes up to it are cleared. */
    void (*reach)(struct zs_renderer *r, uint32_t number);
    /* When it has been drawn: the other passes' viewports are cleared; the resolve hooks of all. */
    void (*end)(struct zs_renderer *r);
};

/* An instance of the frame: of the pass in hand. */
static inline const struct zs_instance *zs_instance_of(const struct zs_renderer *r, uint32_t number)
{
    return &r->scene->instance[number - r->first];
}

#endif
