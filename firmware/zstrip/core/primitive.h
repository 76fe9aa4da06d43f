/* The interface of primitives other than triangles. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_CORE_PRIMITIVE_H
#define ZS_CORE_PRIMITIVE_H

#include "core/assemble.h"

struct zs_bounds;

/* How primitives of one kind are drawn. They are assembled as triangles (core/bin.h): bins, set-up,
 * depth test and shaders know triangles alone. */
struct zs_primitive_ops {
    /* Assemble and bin primitive k of r->xform.instance; as zs_assemble_tri. */
    zs_assemble_fn *assemble;
    /* Enlarge the bounding sphere, so that all that is drawn on the screen lies in its projection:
     * for primitives that have a width in pixels. r->camera and the size of r->view are set. Return
     * ZS_OK, or the error with which zs_frame_begin refuses the instance. */
    int (*widen)(const struct zs_renderer *r, const struct zs_instance *in, struct zs_bounds *b);
};

/* The number of triangles, or of other primitives, of an instance. */
static inline uint32_t zs_primitives_of(const struct zs_instance *in)
{
    const struct zs_primitive *primitive = in->material->primitive;
    return primitive ? primitive->n : in->mesh->n_tris;
}

#endif
