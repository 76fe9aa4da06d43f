/* A zstrip scene as the double-precision reference sees it.
 *
 * SPDX-License-Identifier: MIT
 */
#include "scene_reference.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sim.h"

static double q30(int32_t v)
{
    return (double)v / 1073741824.0;
}

/* Element e of a rotation; all 0 is none */
static double turned(const zs_q2_30 rot[9], int e)
{
    for (int k = 0; k < 9; k++)
        if (rot[k])
            return q30(rot[e]);
    return e % 4 == 0;
}

static double scale_of(zs_uq16_16 scale)
{
    return scale ? (double)scale / 65536.0 : 1.0;
}

/* world = rot * (scale * p) + pos, of the very numbers that the mesh and the pose hold */
static void world_position(double out[3], const struct zs_instance *in, uint32_t v)
{
    const struct zs_mesh *m = in->mesh;
    const double scale = scale_of(m->scale) * scale_of(in->pose.scale);
    double p[3];
    for (int k = 0; k < 3; k++)
        p[k] = (m->pos[v][k] + (m->pos_lo ? m->pos_lo[v][k] / 256.0 : 0.0)) * scale;
    for (int i = 0; i < 3; i++) {
        out[i] = in->pose.pos[i];
        for (int j = 0; j < 3; j++)
            out[i] += turned(in->pose.rot, 3 * i + j) * p[j];
    }
}

static void world_normal(double out[3], const struct zs_instance *in, const zs_q1_15 n[3])
{
    const double length = sqrt((double)n[0] * n[0] + (double)n[1] * n[1] + (double)n[2] * n[2]);
    for (int i = 0; i < 3; i++) {
        out[i] = 0.0;
        for (int j = 0; j < 3 && length > 0.0; j++)
            out[i] += turned(in->pose.rot, 3 * i + j) * n[j] / length;
    }
}

static void channels(double out[3], const struct zs_rgb *c)
{
    out[0] = c->r / 255.0;
    out[1] = c->g / 255.0;
    out[2] = c->b / 255.0;
}

static int is_textured(const struct zs_material *m)
{
    return m->shader == &zs_shade_texture || m->shader == &zs_shade_texture_flat ||
           m->shader == &zs_shade_texture_smooth;
}

static int is_smooth(const struct zs_material *m)
{
    return m->shader == &zs_shade_smooth || m->shader == &zs_shade_texture_smooth;
}

static size_t count_texels(const struct zs_texture *t)
{
    return (size_t)1 << (t->log2_w + t->log2_h);
}

/* RGB565 value of a texel, in any format. */
static uint16_t texel(const struct zs_texture *t, size_t i)
{
    const uint8_t *byte = t->texel;
    if (t->format == &zs_texel_pal8)
        return t->palette[byte[i]];
    if (t->format == &zs_texel_pal4) /* the left one of a pair in the low bits */
        return t->palette[byte[i / 2] >> (i & 1u ? 4 : 0) & 15];
    return ((const uint16_t *)t->texel)[i];
}

static void texture(struct ref_texture *out, uint16_t *code, const struct zs_texture *t)
{
    for (size_t i = 0; i < count_texels(t); i++)
        code[i] = texel(t, i);
    *out = (struct ref_texture){ .width = 1 << t->log2_w, .height = 1 << t->log2_h,
                                 .rgb565 = code, .clamp_u = (t->clamp & ZS_CLAMP_U) != 0,
                                 .clamp_v = (t->clamp & ZS_CLAMP_V) != 0 };
}

static void corner(struct ref_triangle *t, const struct zs_instance *in, uint32_t v, int k)
{
    const struct zs_mesh *m = in->mesh;
    const struct zs_material *material = in->material;
    world_position(t->p[k], in, v);
    if (is_smooth(material))
        world_normal(t->n[k], in, m->normal[v]);
    if (material->shader == &zs_shade_smooth)
        channels(t->rgb[k], m->vertex_rgb ? &m->vertex_rgb[v] : &material->rgb);
    for (int c = 0; c < 2 && is_textured(material); c++)
        t->uv[k][c] = ldexp(m->uv[v][c], -m->uv_bits);
}

/* ref: the instance's texture; NULL: it has none. */
static void triangle(struct ref_triangle *t, const struct zs_instance *in, uint32_t number,
                     const struct ref_texture *ref)
{
    const struct zs_mesh *m = in->mesh;
    const struct zs_material *material = in->material;
    for (int k = 0; k < 3; k++)
        corner(t, in, m->tri[number][k], k);
    t->cull = material->cull;
    t->texture = ref;
    t->has_face_n = m->face_normal != NULL;
    if (t->has_face_n)
        world_normal(t->face_n, in, m->face_normal[number]);
    if (material->shader == &zs_shade_raw) {
        t->shade = REF_SHADE_RAW;
        t->raw = m->face_raw ? m->face_raw[number]
                             : zs_rgb565(material->rgb.r, material->rgb.g, material->rgb.b);
    } else if (material->shader == &zs_shade_flat) {
        t->shade = REF_SHADE_FLAT;
        channels(t->rgb[0], m->face_rgb ? &m->face_rgb[number] : &material->rgb);
    } else if (material->shader == &zs_shade_smooth) {
        t->shade = REF_SHADE_SMOOTH;
    } else {
        t->shade = material->shader == &zs_shade_texture        ? REF_SHADE_TEXTURE
                   : material->shader == &zs_shade_texture_flat ? REF_SHADE_TEXTURE_FLAT
                                                                : REF_SHADE_TEXTURE_SMOOTH;
    }
}

/* The textures of a scene's instances, each once: behind the triangles, in the same block. */
struct shelf {
    struct ref_texture *ref;         /* [n] */
    const struct zs_texture **source; /* [n] */
    uint16_t *code;                  /* of all */
    size_t n, n_texels;
};

static size_t find_texture(const struct shelf *s, const struct zs_texture *t)
{
    size_t i = 0;
    while (i < s->n && s->source[i] != t)
        i++;
    return i;
}

static void collect(struct shelf *s, const struct zs_scene *scene)
{
    s->source = sim_alloc(scene->n_instances, sizeof(void *));
    for (uint32_t i = 0; i < scene->n_instances; i++) {
        const struct zs_material *m = scene->instance[i].material;
        if (!is_textured(m) || find_texture(s, m->texture) < s->n)
            continue;
        s->source[s->n++] = m->texture;
        s->n_texels += count_texels(m->texture);
    }
}

/* See scene_reference.h. */
static void move(struct ref_triangle *t, const struct zs_instance *in, const struct zs_camera *camera)
{
    if (in->depth_state == NULL || camera == NULL || camera->projection == ZS_ORTHOGRAPHIC)
        return;
    const double part = 1.0 + (in->depth_state->bias + in->depth_state->slope_bias / 256.0) * 0x1p-13 / 100.0;
    for (int k = 0; k < 3; k++)
        for (int c = 0; c < 3; c++)
            t->p[k][c] = camera->pos[c] + (t->p[k][c] - camera->pos[c]) * part;
}

struct ref_triangle *sim_reference_triangles(const struct zs_scene *scene, const struct zs_camera *camera,
                                             size_t *n)
{
    struct shelf s = { 0 };
    *n = 0;
    for (uint32_t i = 0; i < scene->n_instances; i++)
        *n += scene->instance[i].mesh->n_tris;
    collect(&s, scene);
    struct ref_triangle *all = sim_alloc(1, *n * sizeof *all + s.n * sizeof *s.ref +
                                                s.n_texels * sizeof *s.code);
    s.ref = (struct ref_texture *)(void *)(all + *n);
    s.code = (uint16_t *)(void *)(s.ref + s.n);
    for (size_t i = 0; i < s.n; i++) {
        texture(&s.ref[i], s.code, s.source[i]);
        s.code += count_texels(s.source[i]);
    }
    size_t at = 0;
    for (uint32_t i = 0; i < scene->n_instances; i++) {
        const struct zs_instance *in = &scene->instance[i];
        const struct ref_texture *ref =
            is_textured(in->material) ? &s.ref[find_texture(&s, in->material->texture)] : NULL;
        for (uint32_t t = 0; t < in->mesh->n_tris; t++, at++) {
            triangle(&all[at], in, t, ref);
            move(&all[at], in, camera);
            all[at].id = (uint32_t)at + 1u;
        }
    }
    free(s.source);
    return all;
}

int sim_reference_mapping(const struct zs_depth *depth, const struct zs_camera *camera)
{
    if (depth == &zs_depth_float)
        return camera->z_far <= camera->z_near * 128     ? REF_DEPTH_E3M13
               : camera->z_far <= camera->z_near * 32768 ? REF_DEPTH_E4M12
                                                         : REF_DEPTH_E5M11;
    return depth == &zs_depth_linear  ? REF_DEPTH_LINEAR
           : depth == &zs_depth_e3m13 ? REF_DEPTH_E3M13
           : depth == &zs_depth_e4m12 ? REF_DEPTH_E4M12
           : depth == &zs_depth_e5m11 ? REF_DEPTH_E5M11
                                      : REF_DEPTH_RECIP;
}

void sim_reference_camera(struct ref_camera *out, const struct zs_camera *camera)
{
    memset(out, 0, sizeof *out);
    for (int k = 0; k < 3; k++) {
        out->eye[k] = camera->pos[k];
        out->right[k] = turned(camera->rot, k);
        out->up[k] = turned(camera->rot, 3 + k);
        out->back[k] = turned(camera->rot, 6 + k);
    }
    out->orthographic = camera->projection == ZS_ORTHOGRAPHIC;
    out->focal = (double)camera->focal / 4294967296.0;
    out->height = (double)camera->height / 65536.0;
    out->near_z = (double)camera->z_near / 65536.0;
    out->far_z = (double)camera->z_far / 65536.0;
}

void sim_reference_light(struct ref_light *out, const struct zs_light *light, const struct zs_camera *camera)
{
    *out = (struct ref_light){ 0 };
    if (!light->dir[0] && !light->dir[1] && !light->dir[2] && !light->ambient && !light->diffuse) {
        for (int k = 0; k < 3; k++)
            out->dir[k] = (2 * turned(camera->rot, 6 + k) + 2 * turned(camera->rot, 3 + k) - turned(camera->rot, k)) /
                          3;
        out->ambient = 0.25;
        out->diffuse = 0.75;
        return;
    }
    for (int k = 0; k < 3; k++)
        out->dir[k] = q30(light->dir[k]);
    out->ambient = (double)light->ambient / 65536.0;
    out->diffuse = (double)light->diffuse / 65536.0;
}
