/* The arrays of a mesh as C text.
 *
 * SPDX-License-Identifier: MIT
 */
#include <inttypes.h>

#include "convert_text.h"
#include "zs_method.h"

static struct sim_text_row begin(FILE *f, const char *type, const char *name, uint32_t part, const char *what,
                                 size_t n, const char *width)
{
    (void)fprintf(f, "static const %s %s_%s_%" PRIu32 "[%zu]%s = {\n", type, name, what, part, n, width);
    return (struct sim_text_row){ f, 0 };
}

static void end(FILE *f)
{
    (void)fputs("\n};\n", f);
}

static void triples(FILE *f, const char *name, uint32_t part, const char *what, const int16_t (*v)[3], size_t n)
{
    struct sim_text_row row = begin(f, "int16_t", name, part, what, n, "[3]");
    for (size_t i = 0; i < n; i++)
        sim_text_put(&row, "{%d,%d,%d},", v[i][0], v[i][1], v[i][2]);
    end(f);
}

static void colors(FILE *f, const char *name, uint32_t part, const char *what, const struct zs_rgb *v, size_t n)
{
    struct sim_text_row row = begin(f, "struct zs_rgb", name, part, what, n, "");
    for (size_t i = 0; i < n; i++)
        sim_text_put(&row, "{%d,%d,%d},", v[i].r, v[i].g, v[i].b);
    end(f);
}

void sim_convert_numbers(FILE *f, const char *name, uint32_t part, const char *what, const uint16_t *v16,
                         const uint8_t *v8, size_t n)
{
    struct sim_text_row row = begin(f, v16 != NULL ? "uint16_t" : "uint8_t", name, part, what, n, "");
    for (size_t i = 0; i < n; i++)
        if (v16 != NULL)
            sim_text_put(&row, "0x%04x,", v16[i]);
        else
            sim_text_put(&row, "%d,", v8[i]);
    end(f);
}

static void positions(FILE *f, const char *name, uint32_t part, const struct sim_piece *p, int fine)
{
    struct sim_text_row row = begin(f, "int16_t", name, part, "pos", p->n_verts, "[3]");
    for (uint32_t i = 0; i < p->n_verts; i++) {
        int16_t v[3];
        for (int k = 0; k < 3; k++)
            v[k] = (int16_t)((p->fine[i][k] - (p->fine[i][k] & 255)) / 256);
        sim_text_put(&row, "{%d,%d,%d},", v[0], v[1], v[2]);
    }
    end(f);
    if (!fine)
        return;
    row = begin(f, "uint8_t", name, part, "pos_lo", p->n_verts, "[3]");
    for (uint32_t i = 0; i < p->n_verts; i++)
        sim_text_put(&row, "{%d,%d,%d},", p->fine[i][0] & 255, p->fine[i][1] & 255, p->fine[i][2] & 255);
    end(f);
}

static void indices(FILE *f, const char *name, uint32_t part, const struct sim_piece *p)
{
    struct sim_text_row row = begin(f, "uint16_t", name, part, "tri", p->n_tris, "[3]");
    for (uint32_t i = 0; i < p->n_tris; i++)
        sim_text_put(&row, "{%u,%u,%u},", p->tri[i][0], p->tri[i][1], p->tri[i][2]);
    end(f);
}

static void coordinates(FILE *f, const char *name, uint32_t part, const struct sim_piece *p)
{
    struct sim_text_row row = begin(f, "int16_t", name, part, "uv", p->n_verts, "[2]");
    for (uint32_t i = 0; i < p->n_verts; i++)
        sim_text_put(&row, "{%d,%d},", p->uv[i][0], p->uv[i][1]);
    end(f);
}

static void clusters(FILE *f, const char *name, uint32_t part, const struct sim_piece *p)
{
    struct sim_text_row row = begin(f, "struct zs_cluster", name, part, "cluster", p->n_clusters, "");
    for (uint32_t i = 0; i < p->n_clusters; i++) {
        const struct zs_cluster *c = &p->cluster[i];
        sim_text_put(
            &row,
            "{.first=%" PRIu32 ",.n_tris=%u,.center={%d,%d,%d},.radius=%u,.axis={%d,%d,%d},.cutoff=%d,.height=%u},",
            c->first, c->n_tris, c->center[0], c->center[1], c->center[2], c->radius, c->axis[0], c->axis[1],
            c->axis[2], c->cutoff, c->height);
    }
    end(f);
}

static void nodes(FILE *f, const char *name, uint32_t part, const struct sim_piece *p)
{
    struct sim_text_row row = begin(f, "struct zs_bvh_node", name, part, "bvh", p->n_nodes, "");
    for (uint32_t i = 0; i < p->n_nodes; i++) {
        const struct zs_bvh_node *n = &p->bvh[i];
        sim_text_put(&row, "{.center={%d,%d,%d},.radius=%u,.first=%" PRIu32 ",.skip=%" PRIu32 "},", n->center[0],
                     n->center[1], n->center[2], n->radius, n->first, n->skip);
    }
    end(f);
}

void sim_convert_arrays(FILE *f, const char *name, uint32_t part, const struct sim_piece *p, int fine)
{
    (void)fprintf(f, "\n/* Mesh %" PRIu32 " */\n", part);
    positions(f, name, part, p, fine);
    indices(f, name, part, p);
    if (p->normal != NULL)
        triples(f, name, part, "normal", (const int16_t(*)[3])p->normal, p->n_verts);
    if (p->face_normal != NULL)
        triples(f, name, part, "face_normal", (const int16_t(*)[3])p->face_normal, p->n_tris);
    if (p->vertex_rgb != NULL)
        colors(f, name, part, "vertex_rgb", p->vertex_rgb, p->n_verts);
    if (p->face_rgb != NULL)
        colors(f, name, part, "face_rgb", p->face_rgb, p->n_tris);
    if (p->face_raw != NULL)
        sim_convert_numbers(f, name, part, "face_raw", p->face_raw, NULL, p->n_tris);
    if (p->uv != NULL)
        coordinates(f, name, part, p);
    if (p->cluster != NULL)
        clusters(f, name, part, p);
    if (p->bvh != NULL)
        nodes(f, name, part, p);
}
