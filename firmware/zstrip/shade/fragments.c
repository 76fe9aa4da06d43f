/* Shaders with a fragment stage: varyings are interpolated perspective-correctly at each pixel.
 *
 * A varying of 16 bits is interpolated as value * w. Divided by w, it is exact to 2^-21 of its
 * range (shade/persp.h, core/plane.c), and then rounded.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/pass.h"
#include "shade/persp.h"
#include "zs_shader.h"

void zs_fragments_start(struct zs_job *job)
{
    const struct zs_shader *shader = job->shader;
    const uint16_t *a[3];
    uint32_t w[3], v[3];
    zs_persp_attrs(job, a);
    zs_persp_w(job, w);
    zs_persp_plane(&job->geom, w, ZS_PLANE_WIDE, &job->w);
    for (int c = 0; c < shader->n_varyings; c++) {
        for (int k = 0; k < 3; k++)
            v[k] = zs_umulh((uint32_t)a[k][c] << 16, w[k]);
        zs_persp_plane(&job->geom, v, ZS_PLANE_WIDE, &job->c[c]);
    }
}

void zs_fragments_run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to)
{
    const struct zs_shader *shader = job->shader;
    const struct zs_instance *instance = zs_instance_of(job->r, job->tri->instance);
    const struct zs_view *view = &job->r->view;
    struct zs_fragment f;
    f.y = (uint16_t)row->y;
    f.paint = job->tri->paint;
    for (int32_t i = from; i < to; i++) {
        uint32_t w;
        int32_t lz;
        const uint32_t rcp = zs_persp_rcp(job, i, row->y, &w, &lz);
        f.x = (uint16_t)(i + view->x);
        f.color = job->color + row->at + i;
        for (int c = 0; c < shader->n_varyings; c++) {
            const uint32_t at = zs_persp_over(zs_plane_at(&job->c[c], i, row->y), w, rcp,
                                              lz); /* uq1_31 */
            f.v[c] = (uint16_t)zs_minu32((at + 0x4000u) >> 15, 65535u);
        }
        shader->fragment(instance, &f);
    }
}
