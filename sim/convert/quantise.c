/* A scene for a view: of meshes that `zsim convert` writes (scene_parts.c), or, with --mesh file, of the model's
 * triangles as they are (quantise_file.c).
 *
 * SPDX-License-Identifier: MIT
 */
#include "quantise.h"

#include <stdlib.h>
#include <string.h>

#include "quantise_parts.h"
#include "scene_parts.h"
#include "sim.h"

struct zs_mesh sim_part_mesh(const struct sim_part *part, uint32_t n_verts, uint32_t n_tris)
{
    return (struct zs_mesh){
        .pos = (const int16_t(*)[3])part->pos, .pos_lo = (const uint8_t(*)[3])part->pos_lo,
        .tri = (const uint16_t(*)[3])part->tri, .normal = (const zs_q1_15(*)[3])part->normal,
        .face_normal = (const zs_q1_15(*)[3])part->face_normal, .vertex_rgb = part->vertex_rgb,
        .face_rgb = part->face_rgb, .face_raw = part->face_raw, .uv = (const int16_t(*)[2])part->uv,
        .cluster = part->cluster, .n_verts = n_verts, .n_tris = n_tris
    };
}

int sim_scene_aim(struct sim_scene *scene, const struct sim_model *model, const struct sim_view *view,
                  const struct sim_options *o)
{
    uint32_t scale;
    const int status = sim_scene_view(scene, &scale, model, view, o);
    if (status != SIM_OK)
        return status;
    for (uint32_t i = 0; i < scene->n_parts; i++)
        scene->part[i].mesh.scale = scale;
    return SIM_OK;
}

static int build_converted(struct sim_scene *out, const struct sim_model *model, const struct sim_view *view,
                           const struct sim_options *o)
{
    struct sim_convert_options wish;
    struct sim_converted made;
    sim_scene_wish(&wish, o);
    int status = sim_converted_make(&made, model, &wish);
    memcpy(out->origin, made.steps.origin, sizeof out->origin);
    out->step = made.steps.step / 256.0;
    out->made_unit = 1.0 / made.steps.unit;
    if (status == SIM_OK)
        sim_scene_parts(out, &made, o);
    if (status == SIM_OK)
        status = sim_scene_aim(out, model, view, o);
    sim_converted_free(&made);
    return status;
}

/* Parts do not move any more: point at them. */
static void build_instances(struct sim_scene *s)
{
    s->instance = sim_alloc(s->n_parts, sizeof *s->instance);
    for (uint32_t i = 0; i < s->n_parts; i++) {
        s->instance[i].mesh = &s->part[i].mesh;
        s->instance[i].material = s->part[i].material;
        zs_pose_identity(&s->instance[i].pose);
    }
    s->scene.instance = s->instance;
    s->scene.n_instances = s->n_parts;
}

int sim_scene_build(struct sim_scene *out, const struct sim_model *model,
                    const struct sim_view *view, const struct sim_options *o)
{
    memset(out, 0, sizeof *out);
    const int status = o->mesh == SIM_MESH_FILE ? sim_scene_file(out, model, view, o)
                                                : build_converted(out, model, view, o);
    if (status != SIM_OK) {
        sim_scene_free(out);
        return status;
    }
    build_instances(out);
    return SIM_OK;
}

uint8_t sim_scene_varyings(const struct zs_scene *scene)
{
    uint8_t most = 0;
    for (uint32_t i = 0; i < scene->n_instances; i++) {
        const uint8_t n = (uint8_t)scene->instance[i].material->shader->n_varyings;
        most = n > most ? n : most;
    }
    return most;
}

const struct zs_method *sim_scene_method(const struct zs_scene *scene)
{
    for (uint32_t i = 0; i < scene->n_instances; i++)
        if (scene->instance[i].material->shader->layer)
            return &zs_method_transparent;
    return NULL;
}

void sim_scene_file_ids(uint32_t *id, size_t n, const struct sim_scene *scene)
{
    for (size_t i = 0; scene->source != NULL && i < n; i++)
        id[i] = id[i] != 0 ? scene->source[id[i] - 1] + 1u : 0;
}

void sim_scene_free(struct sim_scene *scene)
{
    for (uint32_t i = 0; i < scene->n_parts; i++) {
        struct sim_part *p = &scene->part[i];
        SIM_FREE(p->pos, p->pos_lo, p->tri, p->normal, p->face_normal, p->vertex_rgb, p->face_rgb,
                 p->face_raw, p->uv, p->cluster);
    }
    for (uint32_t i = 0; i < scene->n_textures; i++)
        free((void *)(uintptr_t)scene->texture[i].texel);
    SIM_FREE(scene->texture, scene->palette, scene->material, scene->part, scene->instance,
             scene->source, scene->blend,
             scene->lit, scene->shine);
    memset(scene, 0, sizeof *scene);
}

int sim_kept_take(struct sim_kept_scene *kept, const struct sim_model *model, const struct sim_view *view,
                  const struct sim_options *o)
{
    if (kept->is_built && o->mesh == SIM_MESH_CONVERT)
        return sim_scene_aim(&kept->scene, model, view, o);
    sim_kept_free(kept);
    const int status = sim_scene_build(&kept->scene, model, view, o);
    kept->is_built = status == SIM_OK;
    return status;
}

void sim_kept_free(struct sim_kept_scene *kept)
{
    sim_scene_free(&kept->scene);
    kept->is_built = 0;
}
