/* Materials and textures as assimp gives them.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_MATERIAL_H
#define SIM_MATERIAL_H

#include <assimp/scene.h>

#include "model.h"

/* Which of a mesh's texture coordinates a material's texture takes, and how:
 * uv = scale * given + shift, v still upwards as in assimp. */
struct sim_mapping {
    unsigned channel;
    double scale[2], shift[2];
};

/* The mapping of a material; without a texture, channel 0 as it is. file: for messages.
 * SIM_OK; SIM_REFUSED where the coordinates are rotated. */
int sim_material_mapping(struct sim_mapping *out, const char *file,
                         const struct aiMaterial *material);

/* Give model->material[i] the texture of scene->mMaterials[i], for the materials that triangles
 * name. model: its triangles and materials are filled, without textures.
 * SIM_OK; SIM_REFUSED, said why: what was loaded is in the model. */
int sim_material_textures(struct sim_model *model, const struct aiScene *scene,
                          const struct sim_want *want);

#endif
