/* Materials and textures as assimp gives them.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_MATERIAL_H
#define SIM_MATERIAL_H

#include <assimp/scene.h>

#include "model.h"
#include "scan.h"

/* How a material uses its texture. */
struct sim_use {
    char *path;           /* as the file says, or "*3": picture 3 in it; "": none */
    unsigned channel;     /* which of a mesh's texture coordinates; OBJ: there is one */
    double uv[2][3];      /* u and v of the picture: uv[k][0] * u + uv[k][1] * v + uv[k][2]; v upwards as in assimp */
    uint8_t turned;       /* flag: the file turns it in a way that no format defines, which is left out */
    int mode[2];          /* enum aiTextureMapMode, u and v */
    double factor[3];     /* times the texels, 0 .. 1 */
    char *mask;           /* OBJ: the picture of its opacity, as the file says; "": none */
    uint8_t alpha_mode, alpha_least; /* what its alpha does: enum sim_alpha */
    uint8_t says_alpha;   /* flag: the format says what a texture's alpha does */
    double rough, metal;  /* glTF: by which its highlights take the texture's colour; rough < 0: they do not */
};

/* A share of light as a share of 255, by sRGB's curve: glTF's factors and vertex colours are light, what is drawn and
 * texels are not. */
double sim_srgb(double light);

/* "%20" to a space, in place. */
void sim_decode_percents(char *text);

/* How a material looks, but for its colour and texture. material and mtl as below. */
void sim_material_look(struct sim_material *to, const struct aiMaterial *material,
                       const struct sim_mtl_entry *mtl);

/* Look that up. material: NULL for none; mtl: what an OBJ's material file says of it, which counts
 * instead, or NULL. free(out->path) and free(out->mask). */
void sim_material_use(struct sim_use *out, const struct aiMaterial *material,
                      const struct sim_mtl_entry *mtl);

/* Load the textures of the materials that faces with uv name, or want->picture for all.
 * model  its triangles and materials are filled.
 * use    [n_materials]
 * Return SIM_OK; SIM_REFUSED, said why: what was loaded is in the model. */
int sim_material_textures(struct sim_model *model, const struct aiScene *scene,
                          const struct sim_use *use, const struct sim_want *want);

#endif
