/* Models: handed over piece by piece, then loaded and drawn as zsim render does.
 *
 * SPDX-License-Identifier: MIT
 */
#include "engine.h"

#include <stdlib.h>
#include <string.h>

#include "answer.h"
#include "framing.h"
#include "given.h"
#include "model_reference.h"
#include "scene_parts.h"
#include "sim.h"

static struct web_given coming, kept;

/* ---- Handing over ------------------------------------------------------------------------------- */

/* Begin: what there will be. */
WEB_EXPORT(model_begin)
void web_model_begin(const char *name, uint32_t n_verts, uint32_t n_tris, uint32_t n_paints,
                     uint32_t n_images)
{
    web_given_free(&coming);
    coming.name = strcpy(sim_alloc(strlen(name) + 1, 1), name);
    coming.n_verts = n_verts;
    coming.n_tris = n_tris;
    coming.n_paints = n_paints > 0 ? n_paints : 1;
    coming.n_images = n_images;
    coming.point = sim_alloc(n_verts, sizeof *coming.point);
    coming.tri = sim_alloc(n_tris, sizeof *coming.tri);
    coming.paint = sim_alloc(coming.n_paints, sizeof *coming.paint);
    coming.paint_name = sim_alloc(coming.n_paints, sizeof *coming.paint_name);
    coming.image = sim_alloc(n_images, sizeof *coming.image);
    for (uint32_t i = 0; i < coming.n_paints; i++) {
        coming.paint[i] = (struct web_paint){ .rgb = { -1.0 },
                                              .opacity = 1.0,
                                              .alpha_least = 0.5,
                                              .texture = -1.0,
                                              .textured = { [3] = -1.0 },
                                              .factor = { 1.0, 1.0, 1.0 } };
        coming.paint_name[i] = sim_alloc(1, 1);
    }
}

/* Where the arrays of struct web_given are to be written, by their order there. */
WEB_EXPORT(model_array) void *web_model_array(int which)
{
    const size_t v = coming.n_verts;
    switch (which) {
    case 0:
        return coming.point;
    case 1:
        return coming.uv = sim_grow(coming.uv, v, sizeof *coming.uv);
    case 2:
        return coming.normal = sim_grow(coming.normal, v, sizeof *coming.normal);
    case 3:
        return coming.rgb = sim_grow(coming.rgb, v, sizeof *coming.rgb);
    case 4:
        return coming.tri;
    case 5:
        return coming.tri_material = sim_grow(coming.tri_material, coming.n_tris,
                                              sizeof *coming.tri_material);
    default:
        return NULL;
    }
}

/* A material: where its struct web_paint is to be written. */
WEB_EXPORT(model_paint) double *web_model_paint(uint32_t i, const char *name)
{
    if (i >= coming.n_paints)
        return NULL;
    free(coming.paint_name[i]);
    coming.paint_name[i] = strcpy(sim_alloc(strlen(name) + 1, 1), name);
    return coming.paint[i].rgb;
}

/* A picture: where its RGBA is to be written. NULL: it is too large. */
WEB_EXPORT(model_image)
uint8_t *web_model_image(uint32_t i, const char *name, uint32_t width, uint32_t height)
{
    if (i >= coming.n_images || width < 1 || height < 1 || width > SIM_IMAGE_MAX ||
        height > SIM_IMAGE_MAX || (uint64_t)width * height > 1u << 27) {
        (void)sim_refuse(name, 0, "a picture of %u x %u px; zsim reads up to %d each way",
                         (unsigned)width, (unsigned)height, SIM_IMAGE_MAX);
        return NULL;
    }
    struct web_image *to = &coming.image[i];
    *to = (struct web_image){ width, height, sim_alloc((size_t)width * height, 4),
                              strcpy(sim_alloc(strlen(name) + 1, 1), name) };
    return to->rgba;
}

static int has_images(const struct web_given *g)
{
    for (uint32_t i = 0; i < g->n_images; i++)
        if (g->image[i].rgba == NULL)
            return 0;
    return 1;
}

/* ---- Drawing ------------------------------------------------------------------------------------ */

int web_model_load(struct sim_model *model, struct sim_options *o)
{
    web_given_now = &kept;
    o->model = kept.name;
    return sim_scene_load(model, o);
}

/* The eye of --eye or of a framed model, turned about the point that it looks at. */
static int turn(struct sim_options *o, const struct sim_model *model, const struct sim_orbit *by)
{
    struct sim_view view;
    const int status = sim_view_plan(&view, o, model);
    if (status != SIM_OK || (by->yaw == 0.0 && by->pitch == 0.0 && by->distance == 1.0))
        return status;
    sim_view_orbit(o->eye, &view, o->up, by->yaw, by->pitch, by->distance);
    memcpy(o->at, view.at, sizeof o->at);
    o->has_eye = o->has_at = 1;
    return SIM_OK;
}

int web_model_draw(struct sim_rendered *out, struct sim_kept_scene *scene, const struct sim_model *model,
                   const struct sim_options *o)
{
    struct sim_options turned = *o;
    struct sim_model_reference original;
    int status = turn(&turned, model, &web.orbit);
    if (status == SIM_OK)
        status = sim_render_all(out, scene, model, &turned);
    if (status != SIM_OK || !o->compare)
        return status;
    status = sim_model_reference_render(&original, model, &out->view, &turned);
    if (status == SIM_OK)
        web_wrong_draw(&out->shown, &web.wrong, &out->frame, &original.image);
    else
        sim_render_free(out);
    sim_model_reference_free(&original);
    return status;
}

int web_model_scene(int (*use)(void *ctx, const struct sim_drawn_scene *drawn), void *ctx)
{
    struct sim_options turned = web.chosen;
    const int status = turn(&turned, &web.model, &web.orbit);
    return status == SIM_OK ? sim_render_scene(&web.kept, &web.model, &turned, use, ctx) : status;
}

/* End: the model that came is drawn from here on, unless it is refused. */
WEB_EXPORT(model_end) int web_model_end(int up_z, int single, int flat)
{
    struct web_given before = kept;
    struct sim_model model = { 0 };
    struct sim_options o = web.options;
    struct sim_rendered drawn;
    struct sim_orbit orbit = web.orbit;
    coming.up_z = up_z;
    coming.single = single;
    coming.flat = flat;
    kept = coming;
    memset(&coming, 0, sizeof coming);
    web.orbit = (struct sim_orbit)SIM_ORBIT_HOME;
    int status = has_images(&kept) ? web_model_load(&model, &o) : SIM_REFUSED;
    if (status == SIM_OK)
        status = web_model_draw(&drawn, NULL, &model, &o);
    if (status != SIM_OK) {
        sim_model_free(&model);
        web_given_free(&kept);
        kept = before;
        web.orbit = orbit;
        return status;
    }
    web_given_free(&before);
    web_choose(NULL, kept.name, &model, &o, &drawn);
    return SIM_OK;
}

/* What is not carried over, a sentence a line. */
WEB_EXPORT(losses) const char *web_losses(void)
{
    FILE *f = answer_begin();
    sim_losses_print(f, "", web.drawn.lost);
    return answer_end();
}
