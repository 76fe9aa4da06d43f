/* The reference's view of a model.
 *
 * SPDX-License-Identifier: MIT
 */
#include "original.h"

#include <stdlib.h>
#include <string.h>

#include "sim.h"

static void channels(double out[3], struct zs_rgb c)
{
    out[0] = c.r / 255.0;
    out[1] = c.g / 255.0;
    out[2] = c.b / 255.0;
}

static void fill(struct ref_triangle *to, const struct sim_model *model, uint32_t t,
                 const struct sim_options *o)
{
    to->id = t + 1u;
    to->raw = (uint16_t)(t + 1u);
    to->shade = o->shade == SIM_SHADE_ID     ? REF_SHADE_RAW
                : o->shade == SIM_SHADE_FLAT ? REF_SHADE_FLAT
                                             : REF_SHADE_SMOOTH;
    to->cull = o->cull == ZS_CULL_BACK    ? REF_CULL_BACK
               : o->cull == ZS_CULL_FRONT ? REF_CULL_FRONT
                                          : REF_CULL_NONE;
    for (int k = 0; k < 3; k++) {
        memcpy(to->p[k], model->point[model->tri[t][k]], sizeof to->p[k]);
        channels(to->rgb[k], model->rgb[t][k]);
        for (int i = 0; i < 3 && o->shade == SIM_SHADE_SMOOTH; i++)
            to->n[k][i] = (double)model->normal[t][k][i];
    }
    if (o->shade == SIM_SHADE_FLAT)
        channels(to->rgb[0], sim_model_face_rgb(model, t));
}

static void set_up(struct sim_original *out, struct ref_light *light, const struct sim_view *view,
                   const struct sim_options *o)
{
    struct ref_camera *c = &out->camera;
    memcpy(c->eye, view->eye, sizeof c->eye);
    memcpy(c->right, view->right, sizeof c->right);
    memcpy(c->up, view->up, sizeof c->up);
    memcpy(c->back, view->back, sizeof c->back);
    c->orthographic = view->orthographic;
    c->focal = view->focal;
    c->height = view->span;
    c->near_z = view->near_z;
    c->far_z = view->far_z;
    memcpy(light->dir, view->light, sizeof light->dir);
    light->ambient = o->ambient;
    light->diffuse = o->diffuse;
    const int linear = view->orthographic || o->depth == SIM_DEPTH_LINEAR;
    out->depth.mapping = linear ? REF_DEPTH_LINEAR : REF_DEPTH_RECIP;
    out->depth.bits = (int)o->depth_bits;
}

static void report(void *user, size_t done, size_t total)
{
    (void)user;
    sim_progress("reference", done, total);
}

int sim_original_render(struct sim_original *out, const struct sim_model *model,
                        const struct sim_view *view, const struct sim_options *o)
{
    struct ref_light light;
    memset(out, 0, sizeof *out);
    memset(&light, 0, sizeof light);
    set_up(out, &light, view, o);
    const size_t n = (size_t)view->width * (size_t)view->height;
    out->image.rgb565 = sim_alloc(n, sizeof *out->image.rgb565);
    out->image.key = sim_alloc(n, sizeof *out->image.key);
    out->image.id = sim_alloc(n, sizeof *out->image.id);
    out->image.z = sim_alloc(n, sizeof *out->image.z);
    out->image.exact_key = sim_alloc(n, sizeof *out->image.exact_key);
    struct ref_triangle *tris = sim_alloc(model->n_tris, sizeof *tris);
    for (uint32_t t = 0; t < model->n_tris; t++)
        fill(&tris[t], model, t, o);
    const uint16_t background = zs_rgb565(o->background.r, o->background.g, o->background.b);
    const int err = ref_render(tris, model->n_tris, &out->camera, &light, &out->depth, background,
                               view->width, view->height, &out->image, report, NULL);
    free(tris);
    sim_progress_end();
    if (err == REF_OK)
        return SIM_OK;
    sim_original_free(out);
    return sim_refuse(model->file, 0, "the reference cannot draw it: %s",
                      err == REF_NO_MEMORY ? "out of memory" : "a value is outside its range");
}

void sim_original_free(struct sim_original *original)
{
    free(original->image.rgb565);
    free(original->image.key);
    free(original->image.id);
    free(original->image.z);
    free(original->image.exact_key);
    memset(original, 0, sizeof *original);
}
