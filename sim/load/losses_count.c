/* Counting what of assimp's scene is not carried over.
 *
 * SPDX-License-Identifier: MIT
 */
#include "losses.h"

#include <assimp/material.h>
#include <assimp/scene.h>

static void count_meshes(struct sim_lost *lost, const struct aiScene *scene)
{
    for (unsigned i = 0; i < scene->mNumMeshes; i++) {
        const struct aiMesh *mesh = scene->mMeshes[i];
        unsigned lines = 0, clear = 0, none = 0;
        if (mesh->mNumBones > 0)
            sim_lose(lost, SIM_LOST_SKIN, mesh->mName.data);
        if (mesh->mNumAnimMeshes > 0)
            sim_lose(lost, SIM_LOST_MORPH, mesh->mName.data);
        if (mesh->mTextureCoords[0] != NULL && mesh->mTextureCoords[1] != NULL)
            sim_lose(lost, SIM_LOST_UV_SETS, mesh->mName.data);
        for (unsigned f = 0; f < mesh->mNumFaces; f++)
            lines += mesh->mFaces[f].mNumIndices < 3;
        for (unsigned v = 0; mesh->mColors[0] != NULL && v < mesh->mNumVertices; v++)
            clear += mesh->mColors[0][v].a < 0.998f, none += mesh->mColors[0][v].a == 0.0f;
        if (lines > 0)
            sim_lose(lost, SIM_LOST_LINES, mesh->mName.data);
        if (clear > 0 && none < mesh->mNumVertices) /* colours of three numbers have 0 */
            sim_lose(lost, SIM_LOST_VERTEX_ALPHA, mesh->mName.data);
    }
}

static const struct {
    enum aiTextureType type;
    enum sim_lost_kind kind;
} maps[] = {
    { aiTextureType_NORMALS, SIM_LOST_NORMAL_MAP },
    { aiTextureType_HEIGHT, SIM_LOST_NORMAL_MAP },
    { aiTextureType_NORMAL_CAMERA, SIM_LOST_NORMAL_MAP },
    { aiTextureType_DISPLACEMENT, SIM_LOST_NORMAL_MAP },
    { aiTextureType_METALNESS, SIM_LOST_METAL_MAP },
    { aiTextureType_DIFFUSE_ROUGHNESS, SIM_LOST_METAL_MAP },
    { aiTextureType_UNKNOWN, SIM_LOST_METAL_MAP }, /* glTF's metallicRoughnessTexture */
    { aiTextureType_EMISSIVE, SIM_LOST_EMISSION_MAP },
    { aiTextureType_EMISSION_COLOR, SIM_LOST_EMISSION_MAP },
    { aiTextureType_LIGHTMAP, SIM_LOST_OCCLUSION_MAP },
    { aiTextureType_AMBIENT_OCCLUSION, SIM_LOST_OCCLUSION_MAP },
    { aiTextureType_SPECULAR, SIM_LOST_SPECULAR_MAP },
    { aiTextureType_SHININESS, SIM_LOST_SPECULAR_MAP },
    { aiTextureType_OPACITY, SIM_LOST_OPACITY_MAP },
    { aiTextureType_AMBIENT, SIM_LOST_OTHER_MAP },
    { aiTextureType_REFLECTION, SIM_LOST_OTHER_MAP },
    { aiTextureType_SHEEN, SIM_LOST_OTHER_MAP },
    { aiTextureType_CLEARCOAT, SIM_LOST_OTHER_MAP },
    { aiTextureType_TRANSMISSION, SIM_LOST_OTHER_MAP },
};

/* A kind once for a material. */
static void count_maps(struct sim_lost *lost, const struct aiMaterial *material)
{
    struct aiString name = { .length = 0 }, path;
    unsigned seen = 0;
    (void)aiGetMaterialString(material, AI_MATKEY_NAME, &name);
    for (size_t i = 0; i < sizeof maps / sizeof maps[0]; i++)
        if (!(seen >> maps[i].kind & 1u) &&
            aiGetMaterialString(material, AI_MATKEY_TEXTURE(maps[i].type, 0), &path) ==
                aiReturn_SUCCESS &&
            path.length > 0) {
            seen |= 1u << maps[i].kind;
            sim_lose(lost, maps[i].kind, name.data);
        }
}

void sim_losses_count(struct sim_lost *lost, const struct aiScene *scene, const uint8_t *used)
{
    for (unsigned i = 0; i < scene->mNumAnimations; i++)
        sim_lose(lost, SIM_LOST_ANIMATION, scene->mAnimations[i]->mName.data);
    for (unsigned i = 0; i < scene->mNumCameras; i++)
        sim_lose(lost, SIM_LOST_CAMERA, scene->mCameras[i]->mName.data);
    for (unsigned i = 0; i < scene->mNumLights; i++)
        sim_lose(lost, SIM_LOST_LIGHT, scene->mLights[i]->mName.data);
    count_meshes(lost, scene);
    for (unsigned i = 0; used != NULL && i < scene->mNumMaterials; i++)
        if (used[i])
            count_maps(lost, scene->mMaterials[i]);
}
