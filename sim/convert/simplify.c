/* Edges collapsed by meshoptimizer, cheapest first by quadrics (Garland and Heckbert 1997). It takes vertices at one
 * place for a seam, and keeps it: so a vertex is a point with all that its corner has.
 *
 * SPDX-License-Identifier: MIT
 */
#include "simplify.h"

#include <math.h>
#include <meshoptimizer.h>
#include <stdlib.h>
#include <string.h>

#include "model.h"
#include "sim.h"
#include "vec.h"

#define MANY 0.9 /* of the triangles: where an error leaves more, seams are in the way */

/* What is wanted: so many triangles, or so large an error of the extent. */
struct goal {
    double tris, error;
};

static int goal_of(struct goal *g, const char *text)
{
    char *end;
    const double value = strtod(text, &end);
    const int percent = *end == '%', part = percent || strchr(text, '.') != NULL;
    *g = part ? (struct goal){ 0.0, percent ? value / 100.0 : value } : (struct goal){ value, 1e6 };
    return end != text && end[percent] == '\0' &&
           (part ? g->error > 0.0 && g->error < 1.0
                 : value >= 1.0 && value <= 4e9 && value == floor(value));
}

int sim_simplify_check(const char *text)
{
    struct goal g;
    return text == NULL || goal_of(&g, text)
               ? SIM_OK
               : sim_usage("--simplify wants a number of triangles, or an error between 0 and 1 "
                           "with a point in it, as 0.01, or "
                           "in percent, as 1%%, not '%s'",
                           text);
}

/* All that a corner has. No byte of it is padding that was not cleared. */
struct vertex {
    double uv[2];
    float normal[3];
    uint32_t point, material;
    struct zs_rgb rgb;
    uint8_t has_uv;
};

struct mesh {
    struct vertex *vertex;    /* [n] */
    float (*position)[3];     /* [n] */
    unsigned *index, *result; /* [3 n_tris], [n_result] */
    size_t n, n_result;
    float error;
};

static void mesh_free(struct mesh *m)
{
    SIM_FREE(m->vertex, m->position, m->index, m->result);
    memset(m, 0, sizeof *m);
}

static void take_corner(struct vertex *v, const struct sim_model *model, uint32_t t, int k,
                        int normals)
{
    memset(v, 0, sizeof *v);
    v->point = model->tri[t][k];
    v->material = model->tri_material[t];
    v->rgb = model->rgb[t][k];
    if (model->normal != NULL && normals)
        memcpy(v->normal, model->normal[t][k], sizeof v->normal);
    if (model->uv != NULL) {
        memcpy(v->uv, model->uv[t][k], sizeof v->uv);
        v->has_uv = model->has_uv[t];
    }
}

/* normals: flag, they keep vertices apart; else those of a vertex become their mean. */
static void make(struct mesh *m, const struct sim_model *model, int normals)
{
    const size_t corners = 3 * (size_t)model->n_tris;
    struct vertex *all = sim_alloc(corners, sizeof *all);
    unsigned *remap = sim_alloc(corners, sizeof *remap);
    for (uint32_t t = 0; t < model->n_tris; t++)
        for (int k = 0; k < 3; k++)
            take_corner(&all[3 * (size_t)t + (size_t)k], model, t, k, normals);
    m->n = meshopt_generateVertexRemap(remap, NULL, corners, all, corners, sizeof *all);
    m->vertex = sim_alloc(m->n, sizeof *m->vertex);
    m->position = sim_alloc(m->n, sizeof *m->position);
    m->index = sim_alloc(corners, sizeof *m->index);
    m->result = sim_alloc(corners, sizeof *m->result);
    meshopt_remapVertexBuffer(m->vertex, all, corners, sizeof *all, remap);
    meshopt_remapIndexBuffer(m->index, NULL, corners, remap);
    for (size_t i = 0; i < m->n; i++)
        for (int k = 0; k < 3; k++)
            m->position[i][k] = (float)((model->point[m->vertex[i].point][k] - model->center[k]) /
                                        model->radius);
    for (size_t c = 0; model->normal != NULL && !normals && c < corners; c++)
        for (int k = 0; k < 3; k++)
            m->vertex[remap[c]].normal[k] += model->normal[c / 3][c % 3][k];
    SIM_FREE(all, remap);
}

static void collapse(struct mesh *m, const struct sim_model *model, const struct goal *g)
{
    const size_t corners = 3 * (size_t)model->n_tris;
    const size_t wanted = g->tris > 0.0 && g->tris < model->n_tris ? 3 * (size_t)g->tris
                          : g->tris > 0.0                          ? corners
                                                                   : 0;
    m->n_result = meshopt_simplify(m->result, m->index, corners, m->position[0], m->n,
                                   sizeof *m->position, wanted, (float)g->error, 0, &m->error);
}

/* The result into the model. */
static void put_back(struct sim_model *model, const struct mesh *m)
{
    uint32_t *number = sim_alloc(model->n_points, sizeof *number), n_points = 0; /* new one + 1 */
    const uint32_t n = (uint32_t)(m->n_result / 3);
    for (size_t c = 0; c < m->n_result; c++)
        number[m->vertex[m->result[c]].point] = 1;
    for (uint32_t i = 0; i < model->n_points; i++)
        if (number[i] != 0) {
            memmove(model->point[n_points], model->point[i], sizeof *model->point);
            number[i] = ++n_points;
        }
    for (uint32_t t = 0; t < n; t++)
        for (int k = 0; k < 3; k++) {
            const struct vertex *v = &m->vertex[m->result[3 * (size_t)t + (size_t)k]];
            double normal[3] = { (double)v->normal[0], (double)v->normal[1], (double)v->normal[2] };
            model->tri[t][k] = number[v->point] - 1;
            model->rgb[t][k] = v->rgb;
            model->tri_material[t] = v->material;
            if (!(sim_unit(normal) > 0.0))
                normal[2] = 1.0;
            for (int i = 0; model->normal != NULL && i < 3; i++)
                model->normal[t][k][i] = (float)normal[i];
            if (model->uv != NULL) {
                memcpy(model->uv[t][k], v->uv, sizeof v->uv);
                model->has_uv[t] = v->has_uv;
            }
        }
    model->simplified_from = model->n_tris;
    model->simplify_error = (double)m->error;
    model->n_tris = n;
    model->n_points = n_points;
    free(number);
}

void sim_simplify(struct sim_model *model, const char *text)
{
    struct mesh m = { 0 }, plain = { 0 };
    struct goal g;
    if (text == NULL || !goal_of(&g, text))
        return;
    make(&m, model, 1);
    collapse(&m, model, &g);
    const double most = g.tris > 0.0 ? g.tris : MANY * model->n_tris;
    if (model->file_normals && (double)(m.n_result / 3) > most) {
        make(&plain, model, 0);
        collapse(&plain, model, &g);
    }
    const struct mesh *best = plain.vertex != NULL && plain.n_result < m.n_result ? &plain : &m;
    if (best->n_result >= 3)
        put_back(model, best);
    else
        model->simplified_to_none = 1;
    mesh_free(&m);
    mesh_free(&plain);
}

void sim_simplify_print(FILE *f, const char *lead, const struct sim_model *model)
{
    if (model->simplified_to_none)
        (void)fprintf(f, "%snot simplified: no triangle would be left; give --simplify more than that\n", lead);
    if (model->simplified_from > 0)
        (void)fprintf(f,
                      "%ssimplified: %u triangles before, %u after, off by about %.2g %% of the "
                      "model's size\n",
                      lead, model->simplified_from, model->n_tris, 100.0 * model->simplify_error);
}
