/* Counting the lamps that reach pixels which are lit one by one: a lamp that does not takes a tenth of one whose
 * highlight does. By every fourth pixel, with the renderer's own functions.
 *
 * SPDX-License-Identifier: MIT
 */
#include "costs_look.h"
#include "effect/gloss.h"

#define EVERY 4
#define BIAS (1u << 30) /* of planes of zs_shade_phong and zs_shade_phong_near (effect/lit_phong.c) */

/* The varying that a shader's normals begin with; < 0: it is not lit at each pixel. */
static int normals_of(const struct zs_shader *of)
{
    return of == &zs_shade_texture_phong || of == &zs_shade_shadowed_texture_phong                             ? 2
           : of == &zs_shade_phong || of == &zs_shade_phong_near || of == &zs_shade_shadowed_phong ? 0
                                                                                                   : -1;
}

/* The point of a pixel, as the shader finds it; w: as effect/gloss.h does. */
static void point_at(struct zs_lit_at *at, const struct zs_job *job, const struct zs_instance *in,
                     const struct zs_shader *of, int32_t i, int32_t row, int placed)
{
    int32_t n[3], p[3], exp, lz;
    uint32_t square, w;
    if (of != &zs_shade_phong && of != &zs_shade_phong_near) {
        zs_gloss_point(job, in, i, row, normals_of(of), placed, at);
        return;
    }
    for (int k = 0; k < 3; k++)
        n[k] = (int32_t)(zs_plane_at(&job->c[k], i, row) - BIAS);
    (void)zs_lit_unit(at->n, n, &square, &exp);
    if (!placed || of == &zs_shade_phong)
        return;
    const uint32_t rcp = zs_persp_rcp(job, i, row, &w, &lz);
    for (int k = 0; k < 3; k++)
        p[k] = (int32_t)(zs_persp_over(zs_plane_at(&job->c[3 + k], i, row), w, rcp, lz) >> 7) - 32768 * 256;
    zs_lit_place(at, in, p);
}

void sim_look_lamps(const struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to, double n,
                    struct our_shader *s)
{
    const struct zs_shader *const of = s->made.of;
    if (normals_of(of) < 0)
        return;
    const struct zs_instance *const in = zs_instance_of(job->r, job->tri->instance);
    const struct zs_lit_material *const m = zs_lit_material_of(in);
    const struct zs_camera *const camera = &job->r->camera;
    const int placed = zs_lit_placed(m, camera);
    const double each = n / ((to - from + EVERY - 1) / EVERY);
    struct zs_lighting one = { .n_lamps = 1 };
    struct zs_lit_material by_one = *m;
    struct zs_lit_at at;
    by_one.lighting = &one;
    zs_lit_view(&at, camera, 0);
    if (of == &zs_shade_phong && job->sub_log2 == 0)
        s->work.single += n;
    for (int32_t i = from; i < to; i += EVERY) {
        point_at(&at, job, in, of, i, row->y, placed);
        if (m->flags & ZS_LIT_NEAR_VIEWER)
            zs_lit_view(&at, camera, 1);
        for (uint32_t k = 0; k < m->lighting->n_lamps; k++) {
            struct zs_lit_sum sum;
            one.lamp = &m->lighting->lamp[k];
            zs_lit_add(&by_one, &at, &sum);
            s->work.lit += (sum.diffuse[0] | sum.diffuse[1] | sum.diffuse[2]) != 0 ? each : 0.0;
            s->work.shiny += (sum.shine[0] | sum.shine[1] | sum.shine[2]) != 0 ? each : 0.0;
        }
    }
}
