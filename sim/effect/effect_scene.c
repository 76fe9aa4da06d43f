/* Instances of the model with other materials; what is drawn beside it; how it becomes a frame.
 *
 * SPDX-License-Identifier: MIT
 */
#include "effect_scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sim.h"
#include "zs_blend.h"
#include "zs_supersample.h"

/* One material for each of the model's, in the form that its shader takes. */
struct sim_effect_surface {
    struct zs_blend *blend;
};

/* Shaders in place of the plain ones. */
struct shaders {
    const struct zs_shader *raw, *flat, *smooth, *texture, *texture_flat, *texture_smooth;
};
#define SHADERS(family)                                                                                                \
    {                                                                                                                  \
        &zs_##family##_raw, &zs_##family##_flat, &zs_##family##_smooth, &zs_##family##_texture,                        \
            &zs_##family##_texture_flat, &zs_##family##_texture_smooth                                                 \
    }

static const struct zs_shader *in_place_of(const struct shaders *of, const struct zs_shader *plain)
{
    return plain == &zs_shade_raw            ? of->raw
           : plain == &zs_shade_flat         ? of->flat
           : plain == &zs_shade_smooth       ? of->smooth
           : plain == &zs_shade_texture      ? of->texture
           : plain == &zs_shade_texture_flat ? of->texture_flat
                                             : of->texture_smooth;
}

/* ---- Surfaces -------------------------------------------------------------------------------------------------- */

static void make_transparent(struct sim_effect_scene *out, uint32_t n, const struct sim_effect_options *e)
{
    static const struct shaders families[] = { SHADERS(blend), SHADERS(add), SHADERS(stipple) };
    out->surface->blend = sim_alloc(n, sizeof *out->surface->blend);
    for (uint32_t i = 0; i < n; i++) {
        struct zs_blend *m = &out->surface->blend[i];
        *m = (struct zs_blend){ .material = *out->instance[i].material, .alpha = (uint8_t)lround(e->alpha * 255.0) };
        m->material.shader = in_place_of(&families[e->blend], m->material.shader);
        out->instance[i].material = &m->material;
    }
    if (e->blend != SIM_BLEND_SCREEN_DOOR)
        out->method = &zs_method_transparent;
}

int sim_effect_make(struct sim_effect_scene *out, const struct sim_scene *from, const struct sim_view *view,
                    const struct sim_options *o)
{
    const struct sim_effect_options *e = &o->effects;
    const uint32_t n = from->scene.n_instances;
    (void)view;
    memset(out, 0, sizeof *out);
    out->scene = from->scene;
    out->camera = from->camera;
    out->samples = e->samples;
    out->instance = sim_alloc((size_t)n + 1, sizeof *out->instance);
    out->surface = sim_alloc(1, sizeof *out->surface);
    memcpy(out->instance, from->scene.instance, n * sizeof *out->instance);
    out->scene.instance = out->instance;
    if (e->has_alpha)
        make_transparent(out, n, e);
    return SIM_OK;
}

void sim_effect_free(struct sim_effect_scene *s)
{
    if (s->surface != NULL)
        free(s->surface->blend);
    SIM_FREE(s->instance, s->surface);
    memset(s, 0, sizeof *s);
}

/* ---- Frames ---------------------------------------------------------------------------------------------------- */

static int draw(void *ctx, struct zs_renderer *r, const struct zs_sink *sink)
{
    const struct sim_effect_scene *s = ctx;
    struct zs_supersample samples;
    if (s->samples > 1) {
        const int err = zs_supersample_init(&samples, r, sink);
        if (err != ZS_OK)
            return err;
        sink = &samples.sink;
    }
    return zs_render(r, &s->scene, &s->camera, sink);
}

int sim_effect_draw(const struct sim_effect_scene *scene, struct sim_frame *frame, const struct zs_config *config,
                    const char *what, const struct zs_sink *to)
{
    struct sim_effect_scene s = *scene;
    struct zs_config c = *config;
    const struct sim_drawing drawing = { draw, &s, config->width, config->height, s.samples > 1 };
    if (c.varyings < s.varyings)
        c.varyings = s.varyings;
    c.method = s.method;
    if (s.samples > 1) {
        c.width = (uint16_t)(2 * c.width);
        c.height = (uint16_t)(2 * c.height);
        c.strip_h = (uint16_t)(2 * c.strip_h);
        s.camera.focal *= 2;
    }
    return sim_frame_render_by(frame, &drawing, &c, what, to);
}
