/* Points that are welded, normals from faces, bounds.
 *
 * SPDX-License-Identifier: MIT
 */
#include "model_shape.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sim.h"
#include "vec.h"

#define EXTENT_MIN 1e-30
#define EXTENT_RELATIVE 0x1p-32 /* of the coordinates: doubles then keep 1/512 px at 4096 px */

/* ---- Points ---------------------------------------------------------------------------------- */

void sim_weld_begin(struct sim_weld *w, size_t corners)
{
    uint32_t slots = 16;
    while (slots < 2 * corners && slots < 1u << 31)
        slots *= 2;
    w->slot = sim_alloc(slots, sizeof *w->slot);
    w->mask = slots - 1;
}

void sim_weld_end(struct sim_weld *w)
{
    free(w->slot);
    w->slot = NULL;
}

uint32_t sim_weld_point(struct sim_weld *w, struct sim_model *model, const double p[3])
{
    double key[3];
    uint64_t bits[3], h = 0;
    for (int k = 0; k < 3; k++)
        key[k] = p[k] + 0.0; /* -0 becomes 0 */
    memcpy(bits, key, sizeof bits);
    for (int k = 0; k < 3; k++) {
        h = (h ^ bits[k]) * 0x9e3779b97f4a7c15u;
        h ^= h >> 29;
    }
    uint32_t i = (uint32_t)(h >> 16) & w->mask;
    while (w->slot[i] != 0) {
        if (memcmp(model->point[w->slot[i] - 1], key, sizeof key) == 0)
            return w->slot[i] - 1;
        i = (i + 1) & w->mask;
    }
    memcpy(model->point[model->n_points++], key, sizeof key);
    w->slot[i] = model->n_points;
    return model->n_points - 1;
}

/* ---- Normals and bounds ---------------------------------------------------------------------- */

void sim_model_face_normal(const struct sim_model *model, uint32_t tri, double out[3])
{
    const uint32_t *v = model->tri[tri];
    double a[3], b[3];
    sim_sub(a, model->point[v[1]], model->point[v[0]]);
    sim_sub(b, model->point[v[2]], model->point[v[0]]);
    (void)sim_unit(a); /* directions are enough, and keep the product of tiny edges above 0 */
    (void)sim_unit(b);
    sim_cross(out, a, b);
    (void)sim_unit(out);
}

struct zs_rgb sim_model_face_rgb(const struct sim_model *model, uint32_t tri)
{
    const struct zs_rgb *c = model->rgb[tri];
    return (struct zs_rgb){ (uint8_t)((c[0].r + c[1].r + c[2].r + 1) / 3),
                            (uint8_t)((c[0].g + c[1].g + c[2].g + 1) / 3),
                            (uint8_t)((c[0].b + c[1].b + c[2].b + 1) / 3) };
}

static double corner_angle(const struct sim_model *model, uint32_t tri, int k)
{
    const double *p = model->point[model->tri[tri][k]];
    double a[3], b[3], c[3];
    sim_sub(a, model->point[model->tri[tri][(k + 1) % 3]], p);
    sim_sub(b, model->point[model->tri[tri][(k + 2) % 3]], p);
    (void)sim_unit(a);
    (void)sim_unit(b);
    sim_cross(c, a, b);
    return atan2(sqrt(sim_dot(c, c)), sim_dot(a, b));
}

static void flatten_face(struct sim_model *model, uint32_t t)
{
    double n[3];
    sim_model_face_normal(model, t, n);
    for (int k = 0; k < 3 && sim_dot(n, n) > 0.5; k++)
        for (int i = 0; i < 3; i++)
            model->normal[t][k][i] = (float)n[i];
}

/* Corners without a normal get the mean of the faces around their point, weighted by angle
 * (Thuermer and Wuethrich, Journal of Graphics Tools 3(1), 1998). */
void sim_model_fill_normals(struct sim_model *model, int flat)
{
    static const float none[3][3];
    double(*sum)[3] = sim_alloc(model->n_points, sizeof *sum);
    for (uint32_t t = 0; flat && model->file_normals && t < model->n_tris; t++)
        if (memcmp(model->normal[t], none, sizeof none) == 0)
            flatten_face(model, t);
    for (uint32_t t = 0; t < model->n_tris; t++) {
        double n[3];
        sim_model_face_normal(model, t, n);
        for (int k = 0; k < 3; k++) {
            const double angle = corner_angle(model, t, k);
            for (int i = 0; i < 3; i++)
                sum[model->tri[t][k]][i] += angle * n[i];
        }
    }
    for (uint32_t t = 0; t < model->n_tris; t++)
        for (int k = 0; k < 3; k++) {
            float *out = model->normal[t][k];
            double n[3];
            if (out[0] != 0.0f || out[1] != 0.0f || out[2] != 0.0f)
                continue;
            memcpy(n, sum[model->tri[t][k]], sizeof n);
            if (!(sim_unit(n) > 1e-9)) /* faces that cancel out: the face's own */
                sim_model_face_normal(model, t, n);
            if (sim_dot(n, n) < 0.5)
                n[2] = 1.0;
            for (int i = 0; i < 3; i++)
                out[i] = (float)n[i];
        }
    free(sum);
}

void sim_model_flatten(struct sim_model *model)
{
    for (uint32_t t = 0; t < model->n_tris; t++)
        flatten_face(model, t);
}

int sim_model_fill_bounds(struct sim_model *model)
{
    double extent = 0.0, squared = 0.0, reach = 0.0;
    for (int k = 0; k < 3; k++) {
        model->lo[k] = model->hi[k] = model->point[0][k];
        for (uint32_t i = 1; i < model->n_points; i++) {
            model->lo[k] = fmin(model->lo[k], model->point[i][k]);
            model->hi[k] = fmax(model->hi[k], model->point[i][k]);
        }
        model->center[k] = model->lo[k] + (model->hi[k] - model->lo[k]) / 2.0;
        extent = fmax(extent, model->hi[k] - model->lo[k]);
        reach = fmax(reach, fmax(fabs(model->lo[k]), fabs(model->hi[k])));
    }
    if (extent == 0.0)
        return sim_refuse(model->file, 0, "all its vertices lie at one point: it has no extent");
    if (extent < EXTENT_MIN)
        return sim_refuse(model->file, 0, "an extent of %g is below %g; scale the model up", extent,
                          EXTENT_MIN);
    if (extent < EXTENT_RELATIVE * reach)
        return sim_refuse(model->file, 0,
                          "an extent of %g is lost beside coordinates of %g; move the model to 0,0,0",
                          extent, reach);
    for (uint32_t i = 0; i < model->n_points; i++) {
        double d[3];
        sim_sub(d, model->point[i], model->center);
        squared = fmax(squared, sim_dot(d, d));
    }
    model->radius = sqrt(squared) * (1.0 + 1e-12);
    return SIM_OK;
}

/* ---- All of it ------------------------------------------------------------------------------- */

void sim_model_free(struct sim_model *model)
{
    SIM_FREE(model->point, model->tri, model->normal, model->rgb, model->uv, model->has_uv,
             model->tri_material);
    for (uint32_t i = 0; i < model->n_materials; i++)
        free(model->material[i].name);
    for (uint32_t i = 0; i < model->n_textures; i++)
        sim_texture_free(&model->texture[i]);
    SIM_FREE(model->material, model->texture, model->lost_materials);
    memset(model, 0, sizeof *model);
}

const struct sim_texture *sim_model_texture(const struct sim_model *model, uint32_t tri)
{
    const uint32_t n = model->material[model->tri_material[tri]].texture;
    return n != SIM_NO_TEXTURE && model->has_uv[tri] ? &model->texture[n] : NULL;
}
