/* What a conversion says of itself: bytes, counts and what was lost, on the terminal and in the header's comment.
 *
 * SPDX-License-Identifier: MIT
 */
#include <inttypes.h>
#include <math.h>

#include "cluster.h"
#include "convert_text.h"
#include "simplify.h"

static void bytes_line(FILE *f, const char *lead, const char *what, size_t bytes)
{
    if (bytes > 0)
        (void)fprintf(f, "%s%-24s %9zu bytes\n", lead, what, bytes);
}

static void flash(FILE *f, const struct sim_conversion *c, const char *lead)
{
    struct sim_converted_bytes b;
    const struct sim_flash *s = &b.mesh;
    sim_converted_bytes(&b, &c->made);
    bytes_line(f, lead, "positions", s->pos);
    bytes_line(f, lead, "positions, low bits", s->pos_lo);
    bytes_line(f, lead, "indices", s->tri);
    bytes_line(f, lead, "normals", s->normal);
    bytes_line(f, lead, "face normals", s->face_normal);
    bytes_line(f, lead, "colours", s->rgb);
    bytes_line(f, lead, "texture coordinates", s->uv);
    bytes_line(f, lead, "clusters", s->cluster);
    bytes_line(f, lead, "hierarchy", s->bvh);
    bytes_line(f, lead, "texels and palettes", b.texels);
    bytes_line(f, lead, "structs (32-bit machine)", b.structs);
    bytes_line(f, lead, "flash", b.total);
}

static double extent(const struct sim_model *m)
{
    return fmax(m->hi[0] - m->lo[0], fmax(m->hi[1] - m->lo[1], m->hi[2] - m->lo[2]));
}

/* Vertices that a cache of a size takes in, to a triangle. */
static double misses(const struct sim_pieces *p, uint32_t size)
{
    double sum = 0.0;
    for (uint32_t i = 0; i < p->n_pieces; i++)
        sum += p->piece[i].n_tris *
               sim_cache_misses((const uint16_t(*)[3])p->piece[i].tri, p->piece[i].n_tris, p->piece[i].n_verts, size);
    return sum / p->n_tris;
}

static void mesh_figures(FILE *f, const struct sim_conversion *c, const char *lead)
{
    const struct sim_pieces *p = &c->made.pieces;
    uint32_t n_clusters = 0;
    for (uint32_t i = 0; i < p->n_pieces; i++)
        n_clusters += p->piece[i].n_clusters;
    (void)fprintf(f,
                  "%s%" PRIu32 " triangles, %" PRIu32 " vertices, %" PRIu32 " cluster%s, %" PRIu32 " mesh%s, %" PRIu32
                  " material%s\n",
                  lead, p->n_tris, p->n_verts, n_clusters, n_clusters == 1 ? "" : "s", p->n_pieces,
                  p->n_pieces == 1 ? "" : "es", p->n_paints,
                  p->n_paints == 1 ? "" : "s");
    if (c->model.lost_materials != NULL) {
        (void)fprintf(f, "%smaterial file ", lead);
        sim_text_quote(f, sim_text_last_name(c->model.lost_materials));
        (void)fputs(" cannot be read: its colours and textures are missing\n", f);
    }
    if (p->n_flat > 0)
        (void)fprintf(f, "%s%" PRIu32 " triangles left out: no area on the grid (%" PRIu32 " had none in the file)\n",
                      lead, p->n_flat, p->n_flat_before);
    sim_losses_print(f, lead, p->lost);
    sim_simplify_print(f, lead, &c->model);
    const struct sim_steps *s = &c->made.steps;
    char text[5][32];
    (void)fprintf(f, "%sposition = %s, %s, %s + %s * n%s; %s world units to a unit of the model\n", lead,
                  sim_text_exact(text[0], s->origin[0]), sim_text_exact(text[1], s->origin[1]),
                  sim_text_exact(text[2], s->origin[2]), sim_text_exact(text[3], s->step),
                  s->fine ? ", n = pos + pos_lo / 256" : "", sim_text_exact(text[4], s->unit));
    if (s->exact)
        (void)fprintf(f, "%spositions: exact\n", lead);
    else
        (void)fprintf(f, "%spositions: off by at most %.3g, rms %.3g units (%.2g and %.2g of the extent)\n", lead,
                      p->error_max, p->error_rms, p->error_max / extent(&c->model), p->error_rms / extent(&c->model));
    (void)fprintf(f, "%sorder: %.2f vertices to a triangle through a cache of 16, %.2f of 32\n", lead, misses(p, 16),
                  misses(p, 32));
    if (p->normal_error >= 0.0)
        (void)fprintf(f, "%snormals: off by at most %.4f degrees\n", lead, p->normal_error);
}

static void texture_figures(FILE *f, const struct sim_conversion *c, const char *lead)
{
    for (uint32_t i = 0; i < c->made.n_packed; i++) {
        const struct sim_packed_texels *s = &c->made.packed[i];
        (void)fprintf(f, "%stexture %" PRIu32 " ", lead, i);
        sim_text_quote(f, sim_text_last_name(c->model.texture[i].name));
        (void)fprintf(f, ": %" PRIu32 " x %" PRIu32 ", %s", s->w, s->h, sim_texels_name(s->format));
        if (s->n_colors > 0)
            (void)fprintf(f, ", %" PRIu32 " colours", s->n_colors);
        if (s->n_levels > 1)
            (void)fprintf(f, ", %" PRIu32 " levels", s->n_levels);
        if (isfinite(s->loss.psnr_db))
            (void)fprintf(f, ", PSNR %.1f dB, a channel off by at most %.0f of 255", s->loss.psnr_db,
                          ceil(s->loss.worst));
        else
            (void)fputs(", nothing lost", f);
        if (c->made.pieces.uv_error != NULL && c->made.pieces.uv_error[i] >= 0.0)
            (void)fprintf(f, "; coordinates off by at most %.4f texels", c->made.pieces.uv_error[i]);
        (void)fputc('\n', f);
    }
}

void sim_convert_figures(FILE *f, const struct sim_conversion *c, const char *lead)
{
    if (c->made.pieces.n_pieces > 0)
        mesh_figures(f, c, lead);
    else
        sim_losses_print(f, lead, c->made.pieces.lost);
    texture_figures(f, c, lead);
    flash(f, c, lead);
}
