/* Methods of hidden-surface removal by name, for command lines, tables and the gallery.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_METHOD_NAMES_H
#define SIM_METHOD_NAMES_H

#include "zs_method.h"

struct sim_method {
    const char *name;
    const struct zs_method *method; /* NULL: the depth buffer */
    const struct zs_depth *depth;   /* the mapping that it needs; NULL: any with depth memory */
    uint16_t least_tris, least_verts; /* of pools */
    int records;                      /* flag: it keeps records of its own in the triangle pool */
    int keys;                         /* flag: zs_strip.depth holds keys */
    const char *title, *take, *fails; /* for the gallery: its name in full, when to take it, what it gets wrong */
};

#define SIM_METHOD_ONE(...) +1
#define SIM_METHOD_WORD(name_, ...) "|" #name_
#define SIM_METHODS (1 ZS_METHOD_EACH(SIM_METHOD_ONE))
#define SIM_METHOD_WORDS "zbuffer" ZS_METHOD_EACH(SIM_METHOD_WORD) /* in the order of the table */
extern const struct sim_method sim_methods[SIM_METHODS];

/* The one of a configuration; NULL: it is not in the table. */
const struct sim_method *sim_method_of(const struct zs_config *config);

/* Set a configuration's method, and its mapping and least pools where the method asks for some. */
void sim_method_apply(struct zs_config *config, const struct sim_method *method);

/* The triangle pool for one set, for a method that has binned so many triangles: with room for its own records. */
uint16_t sim_method_pool(const struct sim_method *method, uint32_t used);

#endif
