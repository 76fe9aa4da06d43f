/* Numbers in place of colours, three bits at a time.
 *
 * SPDX-License-Identifier: MIT
 */
#include "texel_numbers.h"

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
        if (t == NULL)
            c->material[i].shader = &zs_shade_raw;
        else if (c->material[i].shader != &zs_shade_texture_smooth)
            c->material[i].shader = &zs_shade_texture;
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

/* Bits shift, shift + 1 and shift + 2 of the numbers, each all of a channel; shift < 0: all three
 * everywhere. */
static void number(struct numbered *c, int shift)
{
    static const uint16_t channel[3] = { 0xf800u, 0x07e0u, 0x001fu };
    for (uint32_t i = 0; i < c->n; i++) {
        const struct zs_texture *t = &c->texture[i];
        uint16_t *code = (uint16_t *)(uintptr_t)t->texel; /* of copy() */
        for (size_t k = 0; code != NULL && k < n_texels(t); k++) {
            const unsigned bits = shift < 0 ? 7u : (unsigned)((k + 1) >> shift) & 7u;
            code[k] = 0;
            for (int b = 0; b < 3; b++)
                code[k] |= bits >> b & 1u ? channel[b] : 0u;
        }
    }
}

/* A pixel's three bits. */
static uint32_t bits_of(uint16_t c)
{
    return (c & 0xf800u ? 1u : 0u) | (c & 0x07e0u ? 2u : 0u) | (c & 0x001fu ? 4u : 0u);
}

static int n_bits(const struct numbered *c)
{
    int most = 0;
    for (uint32_t i = 0; i < c->n; i++)
        if (c->texture[i].texel != NULL && c->texture[i].log2_w + c->texture[i].log2_h + 1 > most)
            most = c->texture[i].log2_w + c->texture[i].log2_h + 1;
    return most;
}

static void drop(struct numbered *c)
{
    for (uint32_t i = 0; i < c->n; i++)
        free((void *)(uintptr_t)c->texture[i].texel);
    SIM_FREE(c->instance, c->mesh, c->material, c->texture);
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
    uint8_t *visible = sim_alloc(pixels, 1);
    for (int shift = -3; err == ZS_OK && shift < n_bits(&c); shift += 3) {
        struct sim_frame frame;
        number(&c, shift);
        err = sim_frame_render(&frame, &seen, camera, config, "texels");
        for (size_t i = 0; err == ZS_OK && i < pixels; i++)
            if (shift < 0)
                visible[i] = bits_of(frame.rgb565[i]) == 7u;
            else if (visible[i])
                texel[i] |= bits_of(frame.rgb565[i]) << shift;
        sim_frame_free(&frame);
    }
    free(visible);
    drop(&c);
    return err;
}
