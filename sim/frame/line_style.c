/* A scene as lines or points.
 *
 * SPDX-License-Identifier: MIT
 */
#include "line_style.h"

#include <stdlib.h>
#include <string.h>

#include "sim.h"
#include "value.h"

int sim_edges_take(uint32_t *kinds, const char *list)
{
    static const char words[] = "all|border|crease|silhouette";
    static const uint32_t kind[] = { ZS_EDGE_ALL, ZS_EDGE_BORDER, ZS_EDGE_CREASE, ZS_EDGE_SILHOUETTE };
    char word[16];
    *kinds = 0;
    for (;; list++) {
        const size_t length = strcspn(list, ",");
        (void)snprintf(word, sizeof word, "%.*s", (int)(length < 15 ? length : 15), list);
        const int k = sim_value_choice(word, words);
        if (k < 0)
            return sim_usage("--edges: '%.*s' is none of all, border, crease, silhouette", (int)length, list);
        *kinds |= kind[k];
        list += length;
        if (*list == '\0')
            return SIM_OK;
    }
}

int sim_dash_take(uint8_t *on, uint8_t *off, const char *text)
{
    const char *end;
    long px[2];
    if (!sim_value_long(text, &end, &px[0]) || *end != ',' || !sim_value_long(end + 1, &end, &px[1]) || *end != '\0' ||
        px[0] < 1 || px[0] > 255 || px[1] < 1 || px[1] > 255)
        return sim_usage("--dash wants ON,OFF, two whole numbers from 1 to 255, as 6,4; not '%s'", text);
    *on = (uint8_t)px[0];
    *off = (uint8_t)px[1];
    return SIM_OK;
}

static const struct zs_depth_state pushed_back = ZS_HIDDEN_LINE_STATE;

/* The edges of a mesh that are wanted, as pairs of vertices; *n: how many. NULL: the mesh has too many triangles. */
static uint16_t (*edges_of(const struct zs_instance *of, const struct zs_camera *camera,
                           const struct sim_line_wish *wish, uint32_t *n))[2]
{
    const struct zs_mesh *mesh = of->mesh;
    struct zs_mesh_edge *edge = sim_alloc(3 * (size_t)mesh->n_tris, sizeof *edge);
    const int32_t found = zs_edges_of(edge, mesh);
    uint16_t(*line)[2] = NULL;
    if (found >= 0) {
        line = sim_alloc((size_t)found + 1, sizeof *line);
        *n = zs_edges_choose(line, (uint32_t)found, edge, (uint32_t)found, mesh, wish->kinds, wish->crease, of, camera);
    }
    free(edge);
    return line;
}

/* The lines or points of instance i. */
static int ink_instance(struct sim_styled *s, uint32_t i, const struct zs_instance *of, const struct zs_camera *camera,
                        const struct sim_line_wish *wish)
{
    const struct zs_primitive *primitive = &s->points[i].primitive;
    uint32_t n = of->mesh->n_verts;
    if (wish->style == SIM_STYLE_POINTS) {
        const struct zs_points points = { ZS_POINTS(NULL, n), .size = wish->width };
        s->points[i] = points;
    } else {
        s->line[i] = edges_of(of, camera, wish, &n);
        if (s->line[i] == NULL)
            return sim_refuse(NULL, 0, "--style: a part of the model has more than 65534 triangles");
        const struct zs_lines lines = { ZS_LINES((const uint16_t(*)[2])s->line[i], n), .width = wish->width,
                                        .on = wish->on, .off = wish->off };
        s->lines[i] = lines;
        primitive = &s->lines[i].primitive;
    }
    s->n_lines += n;
    s->material[i] = (struct zs_material){ .shader = &zs_shade_plain, .rgb = wish->ink, .primitive = primitive };
    return SIM_OK;
}

int sim_styled_make(struct sim_styled *out, const struct zs_scene *scene, const struct zs_camera *camera,
                    const struct sim_line_wish *wish)
{
    const uint32_t n = scene->n_instances, faces = wish->style == SIM_STYLE_HIDDEN_LINE ? n : 0;
    memset(out, 0, sizeof *out);
    out->n = n;
    out->instance = sim_alloc(2 * (size_t)n + 1, sizeof *out->instance);
    out->material = sim_alloc((size_t)n + 1, sizeof *out->material);
    out->lines = sim_alloc((size_t)n + 1, sizeof *out->lines);
    out->points = sim_alloc((size_t)n + 1, sizeof *out->points);
    out->line = sim_alloc((size_t)n + 1, sizeof *out->line);
    out->scene = *scene;
    out->scene.instance = out->instance;
    out->scene.n_instances = faces + n;
    out->material[n] = (struct zs_material){ .shader = &zs_shade_none, .cull = ZS_CULL_NONE };
    for (uint32_t i = 0; i < n; i++) {
        const struct zs_instance *of = &scene->instance[i];
        const int status = ink_instance(out, i, of, camera, wish);
        if (status != SIM_OK)
            return status;
        out->instance[faces + i] = *of;
        out->instance[faces + i].material = &out->material[i];
        if (faces) { /* the faces hide; they are pushed back, so that their own edges are seen */
            out->instance[i] = *of;
            out->instance[i].material = &out->material[n];
            out->instance[i].depth_state = &pushed_back;
        }
    }
    return SIM_OK;
}

void sim_styled_free(struct sim_styled *s)
{
    for (uint32_t i = 0; s->line != NULL && i < s->n; i++)
        free(s->line[i]);
    SIM_FREE(s->instance, s->material, s->lines, s->points, s->line);
    memset(s, 0, sizeof *s);
}
