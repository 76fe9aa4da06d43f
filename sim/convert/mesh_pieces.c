/* From a model to pieces: group triangles by material (mesh_groups.c), make pieces of each group (mesh_cut.c).
 *
 * Untextured triangles of several colours can be one mesh with a colour a vertex or face, or a mesh
 * a colour; what takes less is chosen.
 *
 * SPDX-License-Identifier: MIT
 */
#include "mesh_pieces.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesh_work.h"
#include "sim.h"
#include "vec.h"

#define MESH_BYTES 152u /* a mesh, material and instance of its own, on a 32-bit machine */

/* One way of grouping. *done is 0 where it is none. */
static int make_all(struct work *w, int by_color, int *done)
{
    struct sim_pieces *out = w->out;
    int status = SIM_OK;
    out->normal_error = -1.0;
    out->uv_error = sim_alloc(w->model->n_textures, sizeof *out->uv_error);
    for (uint32_t i = 0; i < w->model->n_textures; i++)
        out->uv_error[i] = -1.0;
    *done = sim_groups_make(w, by_color);
    for (uint32_t i = 0; *done && status == SIM_OK && i < w->groups.n; i++)
        status = sim_group_cut(w, i);
    if (status == SIM_OK && *done && out->n_tris == 0 && out->n_flat_before == w->model->n_tris)
        status = sim_refuse(w->model->file, 0, "no triangle in it has an area: their corners lie on lines; repair it");
    else if (status == SIM_OK && *done && out->n_tris == 0)
        status = sim_refuse(w->model->file, 0,
                            "none of its triangles has an area on a grid of %g: they are too small beside the whole; "
                            "remove what lies far away, or give --precise to zsim convert or render",
                            w->steps->fine ? w->steps->step / 256.0 : w->steps->step);
    return status;
}

static void measure_places(struct work *w)
{
    double squared = 0.0;
    w->place = sim_alloc(w->model->n_points, sizeof *w->place);
    for (uint32_t i = 0; i < w->model->n_points; i++) {
        double back[3], d[3];
        sim_steps_place(w->place[i], w->steps, w->model->point[i]);
        sim_steps_position(back, w->steps, (const int32_t *)w->place[i]);
        sim_sub(d, back, w->model->point[i]);
        const double off = w->steps->exact ? 0.0 : sim_dot(d, d);
        squared += off;
        w->out->error_max = fmax(w->out->error_max, sqrt(off));
    }
    w->out->error_rms = sqrt(squared / w->model->n_points);
}

enum sim_form sim_paint_form(const struct sim_paint *paint)
{
    return paint->lit ? SIM_FORM_LIT : paint->alpha_mode == SIM_ALPHA_BLEND ? SIM_FORM_BLEND : SIM_FORM_MATERIAL;
}

uint32_t sim_paint_powers(uint8_t power[128], const struct sim_pieces *pieces)
{
    uint32_t n = 0;
    for (unsigned p = 1; p <= 128; p++)
        for (uint32_t i = 0; i < pieces->n_paints; i++)
            if (pieces->paint[i].power == p) {
                power[n++] = (uint8_t)p;
                break;
            }
    return n;
}

static size_t total(const struct sim_pieces *p, int fine)
{
    struct sim_flash f;
    sim_pieces_flash(&f, p, fine);
    return f.pos + f.pos_lo + f.tri + f.normal + f.face_normal + f.uv + f.rgb + f.cluster + f.bvh +
           (size_t)p->n_pieces * MESH_BYTES;
}

/* Do untextured triangles have more than one colour, so that there is a choice? */
static int has_choice(const struct work *w)
{
    for (uint32_t i = 0; i < w->groups.n; i++)
        if (!w->groups.at[i].same_rgb && !is_textured(w->groups.at[i].paint.shader))
            return 1;
    return 0;
}

int sim_pieces_make(struct sim_pieces *out, const struct sim_model *model, const struct sim_steps *steps,
                    const struct sim_convert_options *o, const uint32_t (*texture_size)[2])
{
    struct sim_pieces by_color = { 0 };
    struct work w = { .model = model, .steps = steps, .options = o, .texture_size = texture_size, .out = out };
    int done = 0;
    memset(out, 0, sizeof *out);
    measure_places(&w);
    by_color.error_max = out->error_max;
    by_color.error_rms = out->error_rms;
    int status = make_all(&w, 0, &done);
    const int choice = status == SIM_OK && has_choice(&w);
    sim_groups_free(&w.groups);
    if (choice) {
        w.out = &by_color;
        status = make_all(&w, 1, &done);
        sim_groups_free(&w.groups);
        if (status == SIM_OK && done && total(&by_color, steps->fine) < total(out, steps->fine)) {
            const struct sim_pieces larger = *out;
            *out = by_color;
            by_color = larger;
        }
        sim_pieces_free(&by_color);
    }
    free(w.place);
    w.out = out;
    if (status == SIM_OK)
        sim_groups_losses(&w);
    if (status != SIM_OK)
        sim_pieces_free(out);
    return status;
}

void sim_pieces_flash(struct sim_flash *sum, const struct sim_pieces *pieces, int fine)
{
    memset(sum, 0, sizeof *sum);
    for (uint32_t i = 0; i < pieces->n_pieces; i++) {
        const struct sim_piece *p = &pieces->piece[i];
        sum->pos += 6 * (size_t)p->n_verts;
        sum->pos_lo += fine ? 3 * (size_t)p->n_verts : 0;
        sum->tri += 6 * (size_t)p->n_tris;
        sum->normal += p->normal != NULL ? 6 * (size_t)p->n_verts : 0;
        sum->face_normal += p->face_normal != NULL ? 6 * (size_t)p->n_tris : 0;
        sum->uv += p->uv != NULL ? 4 * (size_t)p->n_verts : 0;
        sum->rgb += (p->vertex_rgb != NULL ? 3 * (size_t)p->n_verts : 0) +
                    (p->face_rgb != NULL ? 3 * (size_t)p->n_tris : 0) +
                    (p->face_raw != NULL ? 2 * (size_t)p->n_tris : 0);
        sum->cluster += 20 * (size_t)p->n_clusters; /* as every ABI lays it out */
        sum->bvh += 16 * (size_t)p->n_nodes;
    }
}

void sim_pieces_free(struct sim_pieces *pieces)
{
    for (uint32_t i = 0; i < pieces->n_pieces; i++) {
        struct sim_piece *p = &pieces->piece[i];
        SIM_FREE(p->fine, p->normal, p->face_normal, p->vertex_rgb, p->face_rgb, p->face_raw, p->uv, p->tri, p->source,
                 p->cluster, p->bvh);
    }
    SIM_FREE(pieces->piece, pieces->paint, pieces->uv_error);
    memset(pieces, 0, sizeof *pieces);
}
