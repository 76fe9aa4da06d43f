/* Textures: where assimp says they are, found, decoded once for each use, and checked against the
 * uv that go with them.
 *
 * SPDX-License-Identifier: MIT
 */
#include "material.h"

#include <assimp/material.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "outside.h"
#include "sim.h"

/* ---- What a material says -------------------------------------------------------------------- */

/* Its diffuse texture's slot; aiTextureType_NONE where it has none. */
static enum aiTextureType slot_of(const struct aiMaterial *material, struct aiString *path)
{
    static const enum aiTextureType slots[] = { aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE };
    for (size_t i = 0; i < sizeof slots / sizeof slots[0]; i++)
        if (aiGetMaterialString(material, AI_MATKEY_TEXTURE(slots[i], 0), path) ==
                aiReturn_SUCCESS &&
            path->length > 0)
            return slots[i];
    return aiTextureType_NONE;
}

static char *copy(const char *text)
{
    return strcpy(sim_alloc(strlen(text) + 1, 1), text);
}

/* KHR_texture_transform and its like; assimp gives shifts so that a plain scale is about 0,0. */
static void look_up_transform(struct sim_use *out, const struct aiMaterial *material,
                              enum aiTextureType slot)
{
    struct aiUVTransform t;
    if (aiGetMaterialUVTransform(material, AI_MATKEY_UVTRANSFORM(slot, 0), &t) != aiReturn_SUCCESS)
        return;
    out->rotation = fabsf(t.mRotation) > 1e-6f ? (double)t.mRotation : 0.0;
    out->scale[0] = (double)t.mScaling.x;
    out->scale[1] = (double)t.mScaling.y;
    out->shift[0] = (double)t.mTranslation.x;
    out->shift[1] = (double)t.mTranslation.y;
}

static void look_up(struct sim_use *out, const struct aiMaterial *material)
{
    struct aiString path;
    struct aiColor4D c;
    int channel = 0;
    const enum aiTextureType slot = slot_of(material, &path);
    if (slot == aiTextureType_NONE)
        return;
    free(out->path);
    out->path = copy(path.data);
    (void)aiGetMaterialInteger(material, AI_MATKEY_UVWSRC(slot, 0), &channel);
    out->channel = channel > 0 ? (unsigned)channel : 0;
    (void)aiGetMaterialInteger(material, AI_MATKEY_MAPPINGMODE_U(slot, 0), &out->mode[0]);
    (void)aiGetMaterialInteger(material, AI_MATKEY_MAPPINGMODE_V(slot, 0), &out->mode[1]);
    look_up_transform(out, material, slot);
    if (aiGetMaterialColor(material, AI_MATKEY_BASE_COLOR, &c) == aiReturn_SUCCESS) {
        out->factor[0] = (double)c.r;
        out->factor[1] = (double)c.g;
        out->factor[2] = (double)c.b;
    }
}

/* Kd multiplies the texture, but black stands for "not set" beside one. */
static void take_mtl(struct sim_use *out, const struct sim_mtl_entry *mtl)
{
    if (mtl->picture == NULL)
        return;
    free(out->path);
    out->path = copy(mtl->picture);
    memcpy(out->scale, mtl->scale, sizeof out->scale);
    memcpy(out->shift, mtl->shift, sizeof out->shift);
    out->mode[0] = out->mode[1] = mtl->clamp ? aiTextureMapMode_Clamp : aiTextureMapMode_Wrap;
    if (mtl->kd[0] != 0.0 || mtl->kd[1] != 0.0 || mtl->kd[2] != 0.0)
        memcpy(out->factor, mtl->kd, sizeof out->factor);
}

void sim_material_use(struct sim_use *out, const struct aiMaterial *material,
                      const struct sim_mtl_entry *mtl)
{
    *out = (struct sim_use){ .path = copy(""), .scale = { 1.0, 1.0 }, .factor = { 1.0, 1.0, 1.0 } };
    if (mtl != NULL)
        take_mtl(out, mtl);
    else if (material != NULL)
        look_up(out, material);
    for (int k = 0; k < 3; k++) /* a NaN becomes 0 */
        out->factor[k] = out->factor[k] > 0.0 ? fmin(out->factor[k], 1.0) : 0.0;
}

/* ---- Pictures -------------------------------------------------------------------------------- */

static int is_file(const char *path)
{
    struct stat st;
    return stat(path, &st) == 0 && S_ISREG(st.st_mode);
}

static int hex_digit(char c)
{
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
}

/* "%20" to a space, in place. */
static void decode_percents(char *text)
{
    char *to = text;
    for (const char *p = text; *p != '\0'; p++, to++) {
        const int high = p[0] == '%' ? hex_digit(p[1]) : -1;
        const int low = high >= 0 ? hex_digit(p[2]) : -1;
        *to = *p;
        if (low >= 0 && 16 * high + low > 0) {
            *to = (char)(16 * high + low);
            p += 2;
        }
    }
    *to = '\0';
}

/* The file that a model means by a name: that path, from the model's folder; or the bare name in
 * it. malloc'ed; NULL where neither is there. */
static char *find_picture(const char *model_file, const char *given)
{
    const char *slash = strrchr(model_file, '/');
    const size_t folder = slash != NULL ? (size_t)(slash - model_file) + 1 : 0;
    const size_t n = strlen(given);
    char *name = sim_alloc(n + 1, 1), *path = sim_alloc(folder + n + 1, 1);
    memcpy(name, given, n);
    for (int way = 0; way < 4; way++) { /* as given, percents decoded; then bare, the same */
        if (way == 1 || way == 3)
            decode_percents(name);
        if (way == 2)
            memcpy(name, given, n + 1);
        for (char *p = name; *p != '\0'; p++)
            if (*p == '\\')
                *p = '/';
        const char *bare = strrchr(name, '/');
        const char *rest = way >= 2 && bare != NULL ? bare + 1 : name;
        (void)snprintf(path, folder + n + 1, "%.*s%s", rest[0] == '/' ? 0 : (int)folder,
                       model_file, rest);
        if (sim_outside_allows(path) && is_file(path)) {
            sim_outside_forget();
            free(name);
            return path;
        }
    }
    free(name);
    free(path);
    return NULL;
}

/* The picture in the model that a path means, or NULL: "*3", or the name that one goes by. */
static const struct aiTexture *find_embedded(const struct aiScene *scene, const char *path)
{
    char *end;
    const unsigned long n = path[0] == '*' ? strtoul(path + 1, &end, 10) : 0;
    if (path[0] == '*' && *end == '\0' && end != path + 1)
        return n < scene->mNumTextures ? scene->mTextures[n] : NULL;
    for (unsigned i = 0; i < scene->mNumTextures; i++)
        if (strcmp(scene->mTextures[i]->mFilename.data, path) == 0)
            return scene->mTextures[i];
    return NULL;
}

static int decode_embedded(struct sim_image *out, const char *name, const struct aiTexture *from)
{
    if (from->mHeight == 0) /* mWidth bytes of a file */
        return sim_image_decode(out, name, from->pcData, from->mWidth);
    if (from->mWidth < 1 || from->mWidth > SIM_IMAGE_MAX || from->mHeight > SIM_IMAGE_MAX)
        return sim_refuse(name, 0, "a picture of %u x %u px; zsim reads up to %d each way",
                          from->mWidth, from->mHeight, SIM_IMAGE_MAX);
    const size_t n = (size_t)from->mWidth * from->mHeight;
    *out = (struct sim_image){ from->mWidth, from->mHeight, sim_alloc(n, sizeof *out->rgb) };
    for (size_t i = 0; i < n; i++) {
        const uint8_t rgb[3] = { from->pcData[i].r, from->pcData[i].g, from->pcData[i].b };
        memcpy(out->rgb[i], rgb, sizeof rgb);
    }
    return SIM_OK;
}

/* ---- Textures -------------------------------------------------------------------------------- */

static int add_texture(struct sim_model *model, struct sim_image *image, const char *name,
                       const double factor[3], uint8_t clamp)
{
    const size_t n = (size_t)model->n_textures + 1;
    model->texture = sim_grow(model->texture, n, sizeof *model->texture);
    struct sim_texture *t = &model->texture[model->n_textures++];
    sim_texture_make(t, image, name, factor);
    t->clamp = clamp;
    return SIM_OK;
}

static int load_texture(struct sim_model *model, const struct aiScene *scene,
                        const struct sim_use *use, uint8_t clamp)
{
    struct sim_image image = { 0 };
    const struct aiTexture *embedded = find_embedded(scene, use->path);
    char *name;
    int status;
    if (embedded != NULL || use->path[0] == '*') {
        const size_t room = strlen(model->file) + strlen(use->path) + 20;
        name = sim_alloc(room, 1);
        (void)snprintf(name, room, "%s, picture %s", model->file, use->path);
        status = embedded != NULL ? decode_embedded(&image, name, embedded)
                                  : sim_refuse(name, 0, "is not in the file; export it again");
    } else {
        name = find_picture(model->file, use->path);
        status = name != NULL ? sim_image_load(&image, name) : sim_outside_check();
        if (name == NULL && status == SIM_OK)
            status = sim_refuse(model->file, 0, "its texture '%s' is missing; put it beside the model", use->path);
    }
    if (status == SIM_OK)
        status = add_texture(model, &image, name, use->factor, clamp);
    free(name);
    return status;
}

static uint8_t clamp_of(const struct sim_use *use, enum sim_wrap wrap)
{
    if (wrap != SIM_WRAP_FILE)
        return wrap == SIM_WRAP_CLAMP ? ZS_CLAMP_U | ZS_CLAMP_V : 0;
    return (uint8_t)((use->mode[0] == aiTextureMapMode_Clamp ? ZS_CLAMP_U : 0) |
                     (use->mode[1] == aiTextureMapMode_Clamp ? ZS_CLAMP_V : 0));
}

/* Inside the picture, mirrored repeat is as good as any. */
static int check_mirror(const struct sim_model *model, uint32_t material, const struct sim_use *use)
{
    for (int axis = 0; axis < 2; axis++)
        for (uint32_t t = 0; use->mode[axis] == aiTextureMapMode_Mirror && t < model->n_tris; t++)
            for (int k = 0; model->tri_material[t] == material && k < 3; k++)
                if (model->uv[t][k][axis] < 0.0 || model->uv[t][k][axis] > 1.0)
                    return sim_refuse(model->file, 0,
                                      "material '%s' repeats its texture mirrored, which the "
                                      "renderer cannot; give --wrap repeat or --wrap clamp",
                                      model->material[material].name);
    return SIM_OK;
}

static int same_use(const struct sim_use *a, const struct sim_use *b)
{
    return strcmp(a->path, b->path) == 0 && a->mode[0] == b->mode[0] && a->mode[1] == b->mode[1] &&
           memcmp(a->factor, b->factor, sizeof a->factor) == 0;
}

static uint8_t *used_materials(const struct sim_model *model)
{
    uint8_t *used = sim_alloc(model->n_materials, 1);
    for (uint32_t t = 0; t < model->n_tris; t++)
        used[model->tri_material[t]] |= model->has_uv[t];
    return used;
}

/* The model's own textures, for materials of faces with uv. */
static int own_textures(struct sim_model *model, const struct aiScene *scene,
                        const struct sim_use *use, enum sim_wrap wrap)
{
    uint8_t *used = used_materials(model);
    int status = SIM_OK;
    for (uint32_t i = 0; status == SIM_OK && i < model->n_materials; i++) {
        uint32_t same = 0;
        if (!used[i] || use[i].path[0] == '\0')
            continue;
        if (wrap == SIM_WRAP_FILE)
            status = check_mirror(model, i, &use[i]);
        while (same < i && !(used[same] && same_use(&use[same], &use[i])))
            same++;
        if (status == SIM_OK && same == i)
            status = load_texture(model, scene, &use[i], clamp_of(&use[i], wrap));
        model->material[i].texture = same < i ? model->material[same].texture
                                              : model->n_textures - 1;
        sim_progress("textures", i, model->n_materials);
    }
    free(used);
    return status;
}

/* One picture for everything. */
static int given_texture(struct sim_model *model, const struct sim_want *want)
{
    struct sim_image image;
    uint32_t t = 0;
    while (t < model->n_tris && !model->has_uv[t])
        t++;
    if (t == model->n_tris)
        return sim_refuse(model->file, 0,
                          "has no texture coordinates for %s; unwrap it in a modeller and export "
                          "them too",
                          want->picture);
    int status = sim_image_load(&image, want->picture);
    if (status == SIM_OK)
        status = add_texture(model, &image, want->picture, NULL,
                             want->wrap == SIM_WRAP_CLAMP ? ZS_CLAMP_U | ZS_CLAMP_V : 0);
    for (uint32_t i = 0; status == SIM_OK && i < model->n_materials; i++)
        model->material[i].texture = 0;
    return status;
}

int sim_material_textures(struct sim_model *model, const struct aiScene *scene,
                          const struct sim_use *use, const struct sim_want *want)
{
    return want->picture != NULL ? given_texture(model, want)
                                 : own_textures(model, scene, use, want->wrap);
}
