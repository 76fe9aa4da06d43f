/* Passes: the functions that stages call in a frame of several passes. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_CORE_PASS_H
#define ZS_CORE_PASS_H

#include "zstrip.h"

/* Linked if the program calls zs_frame_begin_passes. */
struct zs_pass_ops {
    /* Before a strip is drawn: load the first pass. No viewport of another pass is cleared yet. */
    void (*begin)(struct zs_renderer *r);
    /* During a walk: load the pass of an instance into r->scene, r->camera and r->view. */
    void (*use)(struct zs_renderer *r, uint32_t number);
    /* While r->strip is drawn: load the pass of an instance, and clear the viewports of all passes
     * up to it. */
    void (*reach)(struct zs_renderer *r, uint32_t number);
    /* After a strip is drawn: clear the viewports of the remaining passes, and call the resolve
     * hooks of all passes. */
    void (*end)(struct zs_renderer *r);
};

/* An instance by its number in the frame. It must belong to the current pass. */
static inline const struct zs_instance *zs_instance_of(const struct zs_renderer *r, uint32_t number)
{
    return &r->scene->instance[number - r->first];
}

#endif
