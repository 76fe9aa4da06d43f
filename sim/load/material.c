/* Textures: where assimp says they are, found, decoded once for each use, and checked against the
 * uv that go with them.
 *
 * SPDX-License-Identifier: MIT
 */
#include "material.h"
#include "mirrored.h"

#include <assimp/GltfMaterial.h>
#include <assimp/material.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "outside.h"
#include "sim.h"

#define SPECULAR_LEAST 0.1 /* of full light */
#define SPECULAR_POWER_MAX 128.0

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

/* enum sim_alpha by glTF's word; -1: the file is no glTF. */
static int gltf_mode(const struct aiMaterial *m)
{
    struct aiString mode;
    if (aiGetMaterialString(m, AI_MATKEY_GLTF_ALPHAMODE, &mode) != aiReturn_SUCCESS)
        return -1;
    return strcmp(mode.data, "MASK") == 0    ? SIM_ALPHA_MASK
           : strcmp(mode.data, "BLEND") == 0 ? SIM_ALPHA_BLEND
                                             : SIM_ALPHA_OPAQUE;
}

static void set_scale(double uv[2][3], const double scale[2], const double shift[2])
{
    for (int k = 0; k < 2; k++) {
        uv[k][k] = scale[k];
        uv[k][1 - k] = 0.0;
        uv[k][2] = shift[k];
    }
}

/* KHR_texture_transform of a rotation: offset + rotation * (scale * uv), v downwards. assimp negates the angle, and
 * changes the offset as if it turned about the picture's middle and scaled afterwards: that is undone. */
static void set_turn(double uv[2][3], const struct aiUVTransform *t)
{
    const double c = cos(-(double)t->mRotation), s = sin(-(double)t->mRotation);
    const double x = (double)t->mScaling.x, y = (double)t->mScaling.y;
    const double offset[2] = { (double)t->mTranslation.x - 0.5 * x * (-c + s + 1.0),
                               0.5 * y * (s + c - 1.0) + 1.0 - y - (double)t->mTranslation.y };
    const double down[2][3] = { { c * x, s * y, offset[0] }, { -s * x, c * y, offset[1] } };
    for (int k = 0; k < 2; k++) { /* v downwards is 1 - v upwards, before and after */
        const double sign = k == 0 ? 1.0 : -1.0;
        uv[k][0] = sign * down[k][0];
        uv[k][1] = -sign * down[k][1];
        uv[k][2] = sign * (down[k][1] + down[k][2]) + (double)k;
    }
}

/* assimp gives shifts so that a plain scale is about 0,0. */
static void look_up_transform(struct sim_use *out, const struct aiMaterial *material,
                              enum aiTextureType slot)
{
    struct aiUVTransform t;
    if (aiGetMaterialUVTransform(material, AI_MATKEY_UVTRANSFORM(slot, 0), &t) != aiReturn_SUCCESS)
        return;
    const int turned = fabsf(t.mRotation) > 1e-6f;
    set_scale(out->uv, (const double[2]){ (double)t.mScaling.x, (double)t.mScaling.y },
              (const double[2]){ (double)t.mTranslation.x, (double)t.mTranslation.y });
    if (turned && gltf_mode(material) >= 0)
        set_turn(out->uv, &t);
    else
        out->turned = (uint8_t)turned;
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
    if (aiGetMaterialColor(material, AI_MATKEY_BASE_COLOR, &c) == aiReturn_SUCCESS) { /* of glTF */
        out->factor[0] = sim_srgb((double)c.r);
        out->factor[1] = sim_srgb((double)c.g);
        out->factor[2] = sim_srgb((double)c.b);
    }
}

/* ---- How it looks ---------------------------------------------------------------------------- */

static uint8_t to_byte(double v)
{
    return v >= 1.0 ? 255 : v > 0.0 ? (uint8_t)(v * 255.0 + 0.5) : 0; /* NaN: 0 */
}

double sim_srgb(double light)
{
    return light > 0.0031308 ? 1.055 * pow(light, 1.0 / 2.4) - 0.055 : 12.92 * light;
}

static double number_of(const struct aiMaterial *m, const char *key, unsigned type, unsigned n, double otherwise)
{
    float v;
    return aiGetMaterialFloat(m, key, type, n, &v) == aiReturn_SUCCESS ? (double)v : otherwise;
}

static void set_opacity(struct sim_material *to, double opacity)
{
    to->alpha = to_byte(opacity);
    to->alpha_mode = to->alpha < 255 ? SIM_ALPHA_BLEND : SIM_ALPHA_OPAQUE;
}

/* Highlights of a share of light, rgb, and a power; too faint or wide ones are none, and brighter ones than full keep
 * their hue. */
static void set_specular(struct sim_material *to, const double rgb[3], double power)
{
    const double most = fmax(rgb[0], fmax(rgb[1], rgb[2])), full = fmax(most, 1.0);
    if (!(most >= SPECULAR_LEAST) || !(power >= 1.0))
        return;
    to->specular = (struct zs_rgb){ to_byte(rgb[0] / full), to_byte(rgb[1] / full), to_byte(rgb[2] / full) };
    to->power = (uint8_t)fmin(power, SPECULAR_POWER_MAX);
}

/* Metallic-roughness as Blinn-Phong: the power whose lobe is as wide as GGX's, as bright at its top as one that
 * reflects as much light. Dielectrics reflect 4 %, metals their colour. */
static void set_roughness(struct sim_material *to, double rough, double metal, const double base[3])
{
    const double power = fmin(2.0 / pow(fmax(rough, 0.1), 4.0) - 2.0, SPECULAR_POWER_MAX);
    double rgb[3];
    to->power = 0;
    to->specular = (struct zs_rgb){ 0, 0, 0 };
    for (int k = 0; k < 3; k++)
        rgb[k] = (0.04 + metal * (base[k] - 0.04)) * (power + 8.0) / 8.0;
    if (rough < 0.95)
        set_specular(to, rgb, power);
}

static double rough_of(const struct aiMaterial *m)
{
    return number_of(m, AI_MATKEY_ROUGHNESS_FACTOR, 1.0);
}

static double metal_of(const struct aiMaterial *m)
{
    return fmin(fmax(number_of(m, AI_MATKEY_METALLIC_FACTOR, 1.0), 0.0), 1.0);
}

/* Metals reflect the colour of their texture: its mean. The texels are times the base colour. */
static void set_textured_metal(struct sim_material *to, const struct sim_use *use, const struct sim_texture *texture)
{
    const struct sim_image *image = &texture->image;
    const size_t n = (size_t)image->width * image->height;
    double base[3] = { 0.0, 0.0, 0.0 };
    if (use->rough < 0.0 || use->metal == 0.0)
        return;
    for (size_t i = 0; i < n; i++)
        for (int k = 0; k < 3; k++)
            base[k] += image->rgb[i][k];
    for (int k = 0; k < 3; k++)
        base[k] /= 255.0 * (double)n;
    set_roughness(to, use->rough, use->metal, base);
}

static int has_map(const struct aiMaterial *m, enum aiTextureType type)
{
    struct aiString path;
    return aiGetMaterialString(m, AI_MATKEY_TEXTURE(type, 0), &path) == aiReturn_SUCCESS && path.length > 0;
}

static void look_of(struct sim_material *to, const struct aiMaterial *m)
{
    struct aiColor4D c = { 0.0f, 0.0f, 0.0f, 1.0f };
    int flag = 0;
    const int mode = gltf_mode(m);
    to->two_sided = aiGetMaterialInteger(m, AI_MATKEY_TWOSIDED, &flag) == aiReturn_SUCCESS && flag != 0;
    if (!has_map(m, aiTextureType_EMISSIVE) && /* it would be times that, which is not carried over */
        aiGetMaterialColor(m, AI_MATKEY_COLOR_EMISSIVE, &c) == aiReturn_SUCCESS) {
        double rgb[3] = { (double)c.r, (double)c.g, (double)c.b };
        for (int k = 0; k < 3 && mode >= 0; k++)
            rgb[k] = sim_srgb(rgb[k]);
        to->emission = (struct zs_rgb){ to_byte(rgb[0]), to_byte(rgb[1]), to_byte(rgb[2]) };
    }
    to->unlit = aiGetMaterialInteger(m, AI_MATKEY_SHADING_MODEL, &flag) == aiReturn_SUCCESS &&
                flag == (int)aiShadingMode_Unlit;
    if (mode >= 0) {
        const int has = aiGetMaterialColor(m, AI_MATKEY_BASE_COLOR, &c) == aiReturn_SUCCESS;
        to->alpha_mode = (uint8_t)mode;
        to->alpha = mode == SIM_ALPHA_OPAQUE || !has ? 255 : to_byte((double)c.a);
        to->alpha_least = to_byte(number_of(m, AI_MATKEY_GLTF_ALPHACUTOFF, 0.5) / /* texels are times its alpha */
                                  (has && c.a > 0.0f ? (double)c.a : 1.0));
        const double base[3] = { to->rgb.r / 255.0, to->rgb.g / 255.0, to->rgb.b / 255.0 };
        set_roughness(to, rough_of(m), metal_of(m), base);
        return;
    }
    const double opacity = number_of(m, AI_MATKEY_OPACITY, 1.0);
    if (opacity > 0.0) /* some writers put 0 where they mean nothing */
        set_opacity(to, opacity);
    if (aiGetMaterialColor(m, AI_MATKEY_COLOR_SPECULAR, &c) == aiReturn_SUCCESS)
        set_specular(to, (const double[3]){ (double)c.r, (double)c.g, (double)c.b },
                     number_of(m, AI_MATKEY_SHININESS, 0.0));
}

void sim_material_look(struct sim_material *to, const struct aiMaterial *material,
                       const struct sim_mtl_entry *mtl)
{
    to->alpha = 255;
    to->alpha_least = 128;
    if (mtl != NULL) {
        set_opacity(to, mtl->d);
        to->emission = (struct zs_rgb){ to_byte(mtl->ke[0]), to_byte(mtl->ke[1]), to_byte(mtl->ke[2]) };
        set_specular(to, mtl->ks, mtl->ns);
        if (mtl->mask != NULL && to->alpha_mode == SIM_ALPHA_OPAQUE)
            to->alpha_mode = SIM_ALPHA_MASK;
    } else if (material != NULL) {
        look_of(to, material);
    }
    to->alpha_least = to->alpha_least > 0 ? to->alpha_least : 1;
}

/* ---- How it uses its texture ----------------------------------------------------------------- */

/* Kd multiplies the texture, but black stands for "not set" beside one. */
static void take_mtl(struct sim_use *out, const struct sim_mtl_entry *mtl)
{
    if (mtl->picture == NULL)
        return;
    free(out->path);
    out->path = copy(mtl->picture);
    set_scale(out->uv, mtl->scale, mtl->shift);
    out->mode[0] = out->mode[1] = mtl->clamp ? aiTextureMapMode_Clamp : aiTextureMapMode_Wrap;
    if (mtl->kd[0] != 0.0 || mtl->kd[1] != 0.0 || mtl->kd[2] != 0.0)
        memcpy(out->factor, mtl->kd, sizeof out->factor);
}

void sim_material_use(struct sim_use *out, const struct aiMaterial *material,
                      const struct sim_mtl_entry *mtl)
{
    *out = (struct sim_use){ .path = copy(""), .mask = copy(mtl != NULL && mtl->mask != NULL ? mtl->mask : ""),
                             .uv = { { 1.0 }, { 0.0, 1.0 } }, .factor = { 1.0, 1.0, 1.0 } };
    out->says_alpha = mtl == NULL && material != NULL && gltf_mode(material) >= 0;
    if (mtl != NULL)
        take_mtl(out, mtl);
    else if (material != NULL)
        look_up(out, material);
    out->rough = out->says_alpha ? rough_of(material) : -1.0;
    out->metal = out->says_alpha ? metal_of(material) : 0.0;
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

void sim_decode_percents(char *text)
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
            sim_decode_percents(name);
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
        return sim_image_decode(out, name, from->pcData, from->mWidth, 1);
    if (from->mWidth < 1 || from->mWidth > SIM_IMAGE_MAX || from->mHeight > SIM_IMAGE_MAX)
        return sim_refuse(name, 0, "a picture of %u x %u px; zsim reads up to %d each way",
                          from->mWidth, from->mHeight, SIM_IMAGE_MAX);
    const size_t n = (size_t)from->mWidth * from->mHeight;
    *out = (struct sim_image){ from->mWidth, from->mHeight, sim_alloc(n, sizeof *out->rgb), NULL };
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

/* What alpha of a picture does; where it does nothing, or is not given, it goes. */
static void take_alpha(struct sim_model *model, struct sim_texture *t, const struct sim_use *use)
{
    t->alpha_mode = t->image.alpha != NULL ? use->alpha_mode : SIM_ALPHA_OPAQUE;
    t->alpha_least = use->alpha_least;
    if (t->alpha_mode != SIM_ALPHA_OPAQUE || t->image.alpha == NULL)
        return;
    if (!use->says_alpha)
        sim_lose(model->lost, SIM_LOST_TEXEL_ALPHA, strrchr(t->name, '/') != NULL ? strrchr(t->name, '/') + 1
                                                                                  : t->name);
    free(t->image.alpha);
    t->image.alpha = NULL;
}

/* The opacity that an MTL names, as the picture's alpha: that of the mask, or how red it is. */
static void load_mask(struct sim_model *model, struct sim_image *image, const struct sim_use *use, const char *material)
{
    struct sim_image mask = { 0 };
    char *name = use->mask[0] != '\0' ? find_picture(model->file, use->mask) : NULL;
    if (use->mask[0] == '\0')
        return;
    sim_quiet++;
    const int same = strcmp(use->mask, use->path) == 0 && image->alpha != NULL;
    if (!same && (name == NULL || sim_image_load(&mask, name, 1) != SIM_OK || mask.width != image->width ||
                  mask.height != image->height)) {
        sim_lose(model->lost, SIM_LOST_OPACITY_MAP, material);
    } else if (!same) {
        const size_t n = (size_t)mask.width * mask.height;
        free(image->alpha);
        image->alpha = sim_alloc(n, 1);
        for (size_t i = 0; i < n; i++)
            image->alpha[i] = mask.alpha != NULL ? mask.alpha[i] : mask.rgb[i][0];
    }
    sim_quiet--;
    free(name);
    sim_image_free(&mask);
}

static int load_texture(struct sim_model *model, const struct aiScene *scene,
                        const struct sim_use *use, uint8_t clamp, unsigned mirrored, const char *material)
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
        status = name != NULL ? sim_image_load(&image, name, 1) : sim_outside_check();
        if (name == NULL && status == SIM_OK)
            status = sim_refuse(model->file, 0, "its texture '%s' is missing; put it beside the model", use->path);
    }
    if (status == SIM_OK) {
        load_mask(model, &image, use, material);
        status = sim_mirror_picture(&image, mirrored, name);
        if (status != SIM_OK)
            sim_image_free(&image);
    }
    if (status == SIM_OK) {
        status = add_texture(model, &image, name, use->factor, clamp);
        take_alpha(model, &model->texture[model->n_textures - 1], use);
    }
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

static unsigned mirrored_axes(const struct sim_use *use)
{
    return (use->mode[0] == aiTextureMapMode_Mirror ? SIM_AXIS_U : 0u) |
           (use->mode[1] == aiTextureMapMode_Mirror ? SIM_AXIS_V : 0u);
}

static int same_use(const struct sim_use *a, const struct sim_use *b)
{
    return strcmp(a->path, b->path) == 0 && a->mode[0] == b->mode[0] && a->mode[1] == b->mode[1] &&
           memcmp(a->factor, b->factor, sizeof a->factor) == 0 && strcmp(a->mask, b->mask) == 0 &&
           a->alpha_mode == b->alpha_mode && a->alpha_least == b->alpha_least;
}

/* The axes along which a texture is doubled, for materials from `first` on that share it. */
static unsigned doubled_axes(const struct sim_model *model, const struct sim_use *use, const uint8_t *used,
                             uint32_t first)
{
    unsigned axes = 0;
    for (uint32_t i = first; i < model->n_materials; i++)
        if (used[i] && same_use(&use[first], &use[i]))
            axes |= sim_mirror_leaves(model, i, mirrored_axes(&use[i]));
    return axes;
}

static void halve_uv(struct sim_model *model, const struct sim_use *use, const uint8_t *used, uint32_t first,
                     unsigned axes)
{
    for (uint32_t i = first; i < model->n_materials; i++)
        if (used[i] && same_use(&use[first], &use[i]))
            sim_mirror_uv(model, i, axes);
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
                        const struct sim_use *use, enum sim_wrap wrap, int lenient)
{
    uint8_t *used = used_materials(model);
    int status = SIM_OK;
    for (uint32_t i = 0; status == SIM_OK && i < model->n_materials; i++) {
        uint32_t same = 0;
        if (!used[i] || use[i].path[0] == '\0')
            continue;
        while (same < i && !(used[same] && same_use(&use[same], &use[i])))
            same++;
        const uint32_t before = model->n_textures;
        if (use[i].turned)
            sim_lose(model->lost, SIM_LOST_TEXTURE_TURN, model->material[i].name);
        if (same == i) {
            const unsigned axes = wrap == SIM_WRAP_FILE ? doubled_axes(model, use, used, i) : 0;
            sim_quiet += lenient;
            status = load_texture(model, scene, &use[i], clamp_of(&use[i], wrap), axes, model->material[i].name);
            sim_quiet -= lenient;
            if (status == SIM_OK)
                halve_uv(model, use, used, i, axes);
            if (status != SIM_OK && lenient) {
                sim_lose(model->lost, SIM_LOST_TEXTURE, use[i].path);
                status = SIM_OK;
            }
        }
        model->material[i].texture = same < i                      ? model->material[same].texture
                                     : model->n_textures > before ? before
                                                                  : SIM_NO_TEXTURE;
        if (status == SIM_OK && model->material[i].texture != SIM_NO_TEXTURE)
            set_textured_metal(&model->material[i], &use[i], &model->texture[model->material[i].texture]);
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
    int status = sim_image_load(&image, want->picture, 0);
    if (status == SIM_OK)
        status = add_texture(model, &image, want->picture, NULL,
                             want->wrap == SIM_WRAP_CLAMP ? ZS_CLAMP_U | ZS_CLAMP_V : 0);
    const struct sim_use plain = { .alpha_mode = SIM_ALPHA_OPAQUE };
    if (status == SIM_OK)
        take_alpha(model, &model->texture[0], &plain);
    for (uint32_t i = 0; status == SIM_OK && i < model->n_materials; i++)
        model->material[i].texture = 0;
    return status;
}

int sim_material_textures(struct sim_model *model, const struct aiScene *scene,
                          const struct sim_use *use, const struct sim_want *want)
{
    return want->picture != NULL ? given_texture(model, want)
                                 : own_textures(model, scene, use, want->wrap, want->lenient);
}
