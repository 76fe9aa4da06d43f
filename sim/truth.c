/* A zstrip scene as the double-precision reference sees it.
 *
 * SPDX-License-Identifier: MIT
 */
#include "truth.h"

#include <math.h>
#include <string.h>

#include "sim.h"

static double q30(int32_t v)
{
    return (double)v / 1073741824.0;
}

/* world = rot * (scale * p) + pos, of the very numbers that the mesh and the pose hold */
static void world_position(double out[3], const struct zs_instance *in, uint32_t v)
{
    const struct zs_mesh *m = in->mesh;
    const double scale = (double)m->scale / 65536.0 * ((double)in->pose.scale / 65536.0);
    double p[3];
    for (int k = 0; k < 3; k++)
        p[k] = (m->pos[v][k] + (m->pos_lo ? m->pos_lo[v][k] / 256.0 : 0.0)) * scale;
    for (int i = 0; i < 3; i++) {
        out[i] = in->pose.pos[i];
        for (int j = 0; j < 3; j++)
            out[i] += q30(in->pose.rot[3 * i + j]) * p[j];
    }
}

static void world_normal(double out[3], const struct zs_instance *in, const zs_q1_15 n[3])
{
    const double length = sqrt((double)n[0] * n[0] + (double)n[1] * n[1] + (double)n[2] * n[2]);
    for (int i = 0; i < 3; i++) {
        out[i] = 0.0;
        for (int j = 0; j < 3 && length > 0.0; j++)
            out[i] += q30(in->pose.rot[3 * i + j]) * n[j] / length;
    }
}

static void channels(double out[3], const struct zs_rgb *c)
{
    out[0] = c->r / 255.0;
    out[1] = c->g / 255.0;
    out[2] = c->b / 255.0;
}

static void triangle(struct ref_triangle *t, const struct zs_instance *in, uint32_t number)
{
    const struct zs_mesh *m = in->mesh;
    const struct zs_material *material = in->material;
    for (int k = 0; k < 3; k++) {
        const uint32_t v = m->tri[number][k];
        world_position(t->p[k], in, v);
        if (material->shader == &zs_shade_smooth) {
            world_normal(t->n[k], in, m->normal[v]);
            channels(t->rgb[k], m->vertex_rgb ? &m->vertex_rgb[v] : &material->rgb);
        }
    }
    t->cull = material->cull;
    if (material->shader == &zs_shade_raw) {
        t->shade = REF_SHADE_RAW;
        t->raw = m->face_raw ? m->face_raw[number]
                             : zs_rgb565(material->rgb.r, material->rgb.g, material->rgb.b);
    } else if (material->shader == &zs_shade_flat) {
        t->shade = REF_SHADE_FLAT;
        channels(t->rgb[0], m->face_rgb ? &m->face_rgb[number] : &material->rgb);
        t->has_face_n = m->face_normal != NULL;
        if (t->has_face_n)
            world_normal(t->face_n, in, m->face_normal[number]);
    } else {
        t->shade = REF_SHADE_SMOOTH;
    }
}

struct ref_triangle *sim_truth_triangles(const struct zs_scene *scene, size_t *n)
{
    *n = 0;
    for (uint32_t i = 0; i < scene->n_instances; i++)
        *n += scene->instance[i].mesh->n_tris;
    struct ref_triangle *all = sim_alloc(*n ? *n : 1, sizeof *all);
    size_t at = 0;
    for (uint32_t i = 0; i < scene->n_instances; i++)
        for (uint32_t t = 0; t < scene->instance[i].mesh->n_tris; t++, at++) {
            triangle(&all[at], &scene->instance[i], t);
            all[at].id = (uint32_t)at + 1u;
        }
    return all;
}

void sim_truth_camera(struct ref_camera *out, const struct zs_camera *camera)
{
    memset(out, 0, sizeof *out);
    for (int k = 0; k < 3; k++) {
        out->eye[k] = camera->pos[k];
        out->right[k] = q30(camera->rot[k]);
        out->up[k] = q30(camera->rot[3 + k]);
        out->back[k] = q30(camera->rot[6 + k]);
    }
    out->orthographic = camera->projection == ZS_ORTHOGRAPHIC;
    out->focal = (double)camera->focal / 4294967296.0;
    out->height = (double)camera->height / 65536.0;
    out->near_z = (double)camera->z_near / 65536.0;
    out->far_z = (double)camera->z_far / 65536.0;
}

void sim_truth_light(struct ref_light *out, const struct zs_light *light)
{
    for (int k = 0; k < 3; k++)
        out->dir[k] = q30(light->dir[k]);
    out->ambient = (double)light->ambient / 65536.0;
    out->diffuse = (double)light->diffuse / 65536.0;
}
