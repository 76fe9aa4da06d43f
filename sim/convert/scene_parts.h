/* From the options of `zsim render` to a model, and from its conversion to what is drawn.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_SCENE_PARTS_H
#define SIM_SCENE_PARTS_H

#include "converted.h"
#include "quantise.h"

/* What the options of a conversion are that these options mean. Its command is NULL. */
void sim_scene_wish(struct sim_convert_options *c, const struct sim_options *o);

/* Is all of the model drawn opaque and without light of its materials' own, for an option's sake? */
int sim_scene_is_plain(const struct sim_options *o);

/* Load o->model as its conversion does; o->shade becomes the one that is chosen where none was named. With --mesh
 * convert its textures get the size that they will have. Return as sim_convert_load. */
int sim_scene_load(struct sim_model *model, struct sim_options *o);

/* The parts of a scene, its materials and textures from a conversion, whose arrays it takes over.
 * The scale of its meshes is left to sim_scene_aim. */
void sim_scene_parts(struct sim_scene *out, struct sim_converted *made, const struct sim_options *o);

#endif
