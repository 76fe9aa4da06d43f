/* What is wrong with a picture's light and colours: nothing but black, all of it dark, or a light
 * that falls on nothing that is seen.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/cold.h"
#include "core/fx.h"
#include "support/explain.h"

#define DIM 9u     /* levels, of 32, of a channel of 5 bits that was taken for one of 8 */
#define WEAK 4096u /* light, uq16_16, that leaves a picture dark */

/* Return 1 if a mesh has colours of its own, not all of them black. */
static int colored(const struct zs_mesh *m)
{
    uint32_t sum = 0;
    for (uint32_t k = 0; m->vertex_rgb && k < m->n_verts; k++)
        sum |= m->vertex_rgb[k].r | m->vertex_rgb[k].g | m->vertex_rgb[k].b;
    for (uint32_t k = 0; k < m->n_tris; k++)
        sum |= (m->face_raw ? m->face_raw[k] : 0u) |
               (m->face_rgb ? m->face_rgb[k].r | m->face_rgb[k].g | m->face_rgb[k].b : 0u);
    return sum != 0;
}

/* The instances whose material has the colour that it has when none is given. */
static void say_black(struct zs_explainer *e)
{
    for (uint32_t i = 0; i < e->scene->n_instances; i++) {
        const struct zs_material *m = e->scene->instance[i].material;
        const struct zs_mesh *mesh = e->scene->instance[i].mesh;
        const int own = mesh->vertex_rgb || mesh->face_rgb || mesh->face_raw;
        if ((m->rgb.r | m->rgb.g | m->rgb.b) || m->texture || (own && !colored(mesh)))
            continue;
        ZS_SAY(e,
               own ? "instance % is black: its material's rgb is 0, and of its mesh, zs_shade_raw "
                     "reads face_raw alone, zs_shade_flat face_rgb, zs_shade_smooth vertex_rgb."
                   : "instance % is black: its material's rgb is 0; give it a colour.",
               i);
        return;
    }
    ZS_SAY(e, "all that is drawn is black: colours, texture or lamps are (of a lamp, look at "
              "strength: 1 is ZS_Q16_ONE; at range, half and dir; scene.light is none).");
}

/* Little is seen: are all materials' colours those of 5, 6 and 5 bits? */
static void say_dim(struct zs_explainer *e)
{
    for (uint32_t i = 0; i < e->scene->n_instances; i++) {
        const struct zs_material *m = e->scene->instance[i].material;
        const struct zs_mesh *mesh = e->scene->instance[i].mesh;
        if (m->rgb.r > 31 || m->rgb.g > 63 || m->rgb.b > 31 || m->texture || mesh->vertex_rgb ||
            mesh->face_rgb || mesh->face_raw)
            return;
    }
    ZS_SAY(e, "all colours are dark: a channel of material.rgb has 8 bits, 255 is full; "
              "ZS_RGB(0xffc040) sets it.");
}

/* Return 1 if a light is what zs_light says of darkness. */
static int meant_dark(const struct zs_light *light)
{
    return light->ambient == 1 && light->diffuse == 0;
}

static int light_given(const struct zs_light *light)
{
    return (light->dir[0] | light->dir[1] | light->dir[2]) != 0 ||
           (light->ambient | light->diffuse) != 0;
}

/* Say that diffuse light falls on nothing that is seen, where the opposite light does; of a picture
 * that is as dark as ambient light leaves it. */
static void say_behind(struct zs_explainer *e, const struct zs_seen *all)
{
    struct zs_light light = e->scene->light;
    const uint32_t sum = all->sum;
    struct zs_seen seen;
    if (light.ambient > ZS_Q16_ONE / 2u || all->brightest > (light.ambient * 31u >> 16) + 1u)
        return;
    light.diffuse = 0;
    zs_explain_draw(e, 0, &light, &seen);
    if (seen.sum != sum)
        return;
    light.diffuse = e->scene->light.diffuse;
    for (int k = 0; k < 3; k++)
        light.dir[k] = -light.dir[k];
    zs_explain_draw(e, 0, &light, &seen);
    if (seen.sum != sum)
        ZS_SAY(e, "the light falls on nothing that is seen: its dir points from the surface "
                  "towards the light.");
}

int zs_explain_light(struct zs_explainer *e, const struct zs_seen *all)
{
    const struct zs_light *const light = &e->scene->light, usual = { .ambient = 0 };
    const uint32_t before = e->said;
    uint64_t square = 0; /* < 3 * 2^60.1 */
    struct zs_seen seen;
    if (!light_given(light))
        return 0;
    for (int k = 0; k < 3; k++)
        square += (uint64_t)((int64_t)light->dir[k] * light->dir[k]);
    const uint32_t length = zs_isqrt64(square); /* q2_30 */
    if (light->diffuse && light->diffuse < 256u)
        ZS_SAY(e, "the light's diffuse is %/65536: was ZS_Q16_ONE meant?", light->diffuse);
    if (light->ambient > 1u && light->ambient < 256u && light->diffuse < 256u)
        ZS_SAY(e, "the light's ambient is %/65536: was ZS_Q16_ONE meant?", light->ambient);
    if (light->diffuse && (length >> 26 == 0 || length >> 26 > 16))
        ZS_SAY(e, "the light's dir has length $, and 1 is ZS_Q30_ONE: zs_unit makes it that long.",
               length >> 14);
    if (!(light->ambient | light->diffuse)) {
        zs_explain_draw(e, 0, &usual, &seen);
        if (seen.sum != all->sum)
            ZS_SAY(e, "the light's ambient and diffuse are 0: give one, or all fields 0 for the "
                      "usual light.");
    }
    if (light->ambient == ZS_Q16_ONE && light->diffuse)
        ZS_SAY(e, "the light's ambient is full, so diffuse adds nothing, and shapes are not seen: "
                  "1/4 and 3/4 are usual.");
    else if (e->said == before && light->ambient && light->diffuse)
        say_behind(e, all);
    return e->said != before;
}

void zs_explain_dark(struct zs_explainer *e, const struct zs_seen *all)
{
    const struct zs_light *const light = &e->scene->light, usual = { .ambient = 0 };
    const int given = light_given(light);
    struct zs_seen seen;
    if (all->colored == 0 || (given && meant_dark(light)))
        return;
    if (all->brightest > 1) {
        if (all->brightest < DIM)
            say_dim(e);
        return;
    }
    zs_explain_draw(e, 0, &usual, &seen);
    if (given && seen.brightest > 1 && light->ambient < WEAK && light->diffuse < WEAK)
        ZS_SAY(e, "the light's ambient is %/65536, its diffuse %/65536: 1 is ZS_Q16_ONE.",
               light->ambient, light->diffuse);
    else if (given && seen.brightest > 1)
        ZS_SAY(e, "all that is seen is dark: the light comes from behind it; dir points from the "
                  "surface towards the light.");
    else
        say_black(e);
}
