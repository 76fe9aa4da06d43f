/* The reference's frame: a scene turned into its triangles, drawn into an image that has all buffers.
 *
 * SPDX-License-Identifier: MIT
 */
#include "reference_frame.h"

#include <string.h>

#include "scene_reference.h"
#include "sim.h"

int sim_reference_frame_draw(struct sim_reference_frame *t, const struct zs_scene *scene,
                             const struct zs_camera *camera, const struct zs_config *config)
{
    const size_t n = (size_t)config->width * config->height;
    memset(t, 0, sizeof *t);
    t->tri = sim_reference_triangles(scene, camera, &t->n_tris);
    sim_reference_camera(&t->camera, camera);
    sim_reference_light(&t->light, &scene->light, camera);
    t->depth = (struct ref_depth){ sim_reference_mapping(config->depth, camera), config->depth_bits };
    t->image = (struct ref_image){
        .rgb565 = sim_alloc(n, sizeof(uint16_t)), .key = sim_alloc(n, sizeof(uint16_t)),
        .id = sim_alloc(n, sizeof(uint32_t)), .z = sim_alloc(n, sizeof(double)),
        .exact_key = sim_alloc(n, sizeof(double)), .rgb = sim_alloc(3 * n, sizeof(double)),
        .u = sim_alloc(n, sizeof(double)), .v = sim_alloc(n, sizeof(double)), .texel = sim_alloc(n, sizeof(uint32_t)),
        .texture = sim_alloc(n, sizeof(void *))
    };
    const struct sim_judge judge = {
        .tri = t->tri, .camera = &t->camera, .light = &t->light, .depth = &t->depth, .width = config->width,
        .height = config->height, .sub_pixel = 1.0 / (1 << config->subpixel_bits),
        .unit = sim_judge_unit(t->tri, t->n_tris, &t->camera)
    };
    t->judge = judge;
    return ref_render(t->tri, t->n_tris, &t->camera, &t->light, &t->depth, scene->background, config->width,
                      config->height, &t->image, NULL, NULL);
}

void sim_reference_frame_free(struct sim_reference_frame *t)
{
    const struct ref_image *i = &t->image;
    SIM_FREE(t->tri, i->rgb565, i->key, i->id, i->z, i->exact_key, i->rgb, i->u, i->v, i->texel, (void *)i->texture);
}
