/* Light on textures, highlights on top: what these shaders share. Internal.
 *
 * Texels are drawn by the stages of zs_shade_texture or zs_shade_texture_smooth, which use the
 * planes of two or three varyings. The others are planes of value * w, which is divided by w at
 * each pixel.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_EFFECT_GLOSS_H
#define ZS_EFFECT_GLOSS_H

#include "core/pass.h"
#include "effect/lights.h"
#include "shade/stages.h"
#include "shade/texture.h"

/* Call a stage as `shader` would have it: the textures' stages go by its varyings and its light. */
static inline void zs_gloss_start_as(struct zs_job *job, const struct zs_shader *shader)
{
    const struct zs_shader *const own = job->shader;
    job->shader = shader;
    zs_texture_start(job);
    job->shader = own;
}

static inline void zs_gloss_run_as(struct zs_job *job, const struct zs_shader *shader,
                                   const struct zs_row *row, int32_t from, int32_t to)
{
    const struct zs_shader *const own = job->shader;
    job->shader = shader;
    zs_texture_run(job, row, from, to);
    job->shader = own;
}

/* Set the planes of varyings [first, end), and w, after zs_texture_start. */
static inline void zs_gloss_planes(struct zs_job *job, int first, int end)
{
    const uint16_t *a[3];
    uint32_t w[3], v[3];
    zs_persp_attrs(job, a);
    zs_persp_w(job, w);
    if (job->sub_log2 == ZS_AFFINE) /* else it is there */
        zs_persp_plane(&job->geom, w, ZS_PLANE_WIDE, &job->w);
    for (int c = first; c < end; c++) {
        for (int k = 0; k < 3; k++)
            v[k] = zs_umulh((uint32_t)a[k][c] << 16, w[k]);
        zs_persp_plane(&job->geom, v, ZS_PLANE_WIDE, &job->c[c]);
    }
}

/* Set mesh->uv and zs_lit_sum of a vertex. */
static inline void zs_gloss_vertex(const struct zs_shading *s, uint32_t v, uint16_t uv[2],
                                   struct zs_lit_sum *sum)
{
    const struct zs_mesh *const mesh = s->instance->mesh;
    int32_t p[3];
    zs_mesh_place(mesh, v, p);
    zs_lit_sum_at(s, p, mesh->normal[v], sum);
    uv[0] = (uint16_t)(mesh->uv[v][0] + 32768);
    uv[1] = (uint16_t)(mesh->uv[v][1] + 32768);
}

/* Set at->n at a covered pixel, and at->pos if `placed`. first: of the varyings normal and place. A
 * normal n as a varying is n + 32768 of 65536. Times w, both are linear on the screen, and so is
 * their difference, N w, whose direction is that of N: nothing is divided for it. */
static inline void zs_gloss_point(const struct zs_job *job, const struct zs_instance *in,
                                  int32_t i, int32_t row, int first, int placed,
                                  struct zs_lit_at *at)
{
    uint32_t w, square;
    int32_t lz, n[3], p[3], exp;
    const uint32_t rcp = zs_persp_rcp(job, i, row, &w, &lz);
    const int turned = job->tri->paint & ZS_PHONG_TURNED;
    for (int k = 0; k < 3; k++) { /* < 2^31 - 2^30, both */
        const int32_t nw = (int32_t)(zs_plane_at(&job->c[first + k], i, row) - (w >> 1));
        n[k] = turned ? -nw : nw;
    }
    (void)zs_lit_unit(at->n, n, &square, &exp);
    if (!placed)
        return;
    for (int k = 0; k < 3; k++)
        p[k] = (int32_t)(zs_persp_over(zs_plane_at(&job->c[first + 3 + k], i, row), w, rcp, lz) >>
                         7) -
               32768 * 256; /* uq1_31 of 65536 steps */
    zs_lit_place(at, in, p);
}

/* Stages of textures lit at each pixel: mesh->uv, normal and place. */
void zs_gloss_phong_vertex(const struct zs_shading *s, uint32_t v, uint16_t *out);
void zs_gloss_phong_start(struct zs_job *job);

/* A code of RGB565 in light (uq16_16, < 2^21), with `more` on top (65535 is full, < 2^22). */
static inline uint32_t zs_gloss_code(uint32_t code, uint32_t light, uint32_t more, uint32_t most)
{
    const uint32_t sum = code * light + more * most + 0x8000u; /* < 2^29.1 */
    return zs_minu32(sum >> 16, most);
}

/* The texel at *px in that light. */
static inline void zs_gloss_pixel(uint16_t *px, const uint32_t light[3], const uint32_t more[3])
{
    const uint32_t c = zs_wire16(*px);
    *px = zs_wire16((uint16_t)(zs_gloss_code(c >> 11, light[0], more[0], 31) << 11 |
                               zs_gloss_code(c >> 5 & 63u, light[1], more[1], 63) << 5 |
                               zs_gloss_code(c & 31u, light[2], more[2], 31)));
}

/* A shader of more varyings than a vertex can have: a frame with it, or with a filter or a layer of
 * it, is refused, ZS_ERR_VARYINGS. */
#define ZS_GLOSS_REFUSED(n) { .run = zs_texture_run, .n_varyings = (n), .opaque = ZS_TEXTURED }

#endif
