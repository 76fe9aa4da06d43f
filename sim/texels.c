/* Numbers in place of colours.
 *
 * SPDX-License-Identifier: MIT
 */
#include "texels.h"

#include <stdlib.h>
#include <string.h>

#include "frame.h"
#include "sim.h"

/* A scene of copies: textures hold numbers, everything else is drawn in colour 0. */
struct numbered {
    uint32_t n;
    struct zs_instance *instance; /* [n] */
    struct zs_mesh *mesh;
    struct zs_material *material;
    struct zs_texture *texture;
};

static size_t n_texels(const struct zs_texture *t)
{
    return (size_t)1 << (t->log2_w + t->log2_h);
}

/* The instance before i that shares its texture; i where there is none. */
static uint32_t first_user(const struct zs_scene *scene, uint32_t i)
{
    uint32_t k = 0;
    while (k < i && scene->instance[k].material->texture != scene->instance[i].material->texture)
        k++;
    return k;
}

static void copy(struct numbered *c, const struct zs_scene *scene)
{
    c->n = scene->n_instances;
    c->instance = sim_alloc(c->n, sizeof *c->instance);
    c->mesh = sim_alloc(c->n, sizeof *c->mesh);
    c->material = sim_alloc(c->n, sizeof *c->material);
    c->texture = sim_alloc(c->n, sizeof *c->texture);
    for (uint32_t i = 0; i < c->n; i++) {
        const struct zs_texture *t = scene->instance[i].material->texture;
        c->instance[i] = scene->instance[i];
        c->mesh[i] = *scene->instance[i].mesh;
        c->material[i] = *scene->instance[i].material;
        c->instance[i].mesh = &c->mesh[i];
        c->instance[i].material = &c->material[i];
        c->mesh[i].face_raw = NULL;
        memset(&c->material[i].rgb, 0, sizeof c->material[i].rgb);
        c->material[i].shader = t != NULL ? &zs_shade_texture : &zs_shade_raw;
        if (t == NULL)
            continue;
        const uint32_t k = first_user(scene, i);
        if (k == i) {
            c->texture[i] = *t;
            c->texture[i].format = &zs_texel_565;
            c->texture[i].texel = sim_alloc(n_texels(t), sizeof(uint16_t));
        }
        c->material[i].texture = &c->texture[k];
    }
}

static void number(struct numbered *c, int shift)
{
    for (uint32_t i = 0; i < c->n; i++) {
        const struct zs_texture *t = &c->texture[i];
        uint16_t *code = (uint16_t *)(uintptr_t)t->texel; /* of copy() */
        for (size_t k = 0; code != NULL && k < n_texels(t); k++)
            code[k] = (uint16_t)((k + 1) >> shift);
    }
}

static void drop(struct numbered *c)
{
    for (uint32_t i = 0; i < c->n; i++)
        free((void *)(uintptr_t)c->texture[i].texel);
    free(c->instance);
    free(c->mesh);
    free(c->material);
    free(c->texture);
}

int sim_frame_texels(uint32_t *texel, const struct zs_scene *scene, const struct zs_camera *camera,
                     const struct zs_config *config)
{
    struct numbered c;
    struct zs_scene seen = *scene;
    const size_t pixels = (size_t)config->width * config->height;
    int err = ZS_OK;
    copy(&c, scene);
    seen.instance = c.instance;
    seen.background = 0;
    memset(texel, 0, pixels * sizeof *texel);
    for (int shift = 0; err == ZS_OK && shift < 32; shift += 16) {
        struct sim_frame frame;
        number(&c, shift);
        err = sim_frame_render(&frame, &seen, camera, config, "texels");
        for (size_t i = 0; err == ZS_OK && i < pixels; i++)
            texel[i] |= (uint32_t)frame.rgb565[i] << shift;
        sim_frame_free(&frame);
    }
    drop(&c);
    return err;
}
