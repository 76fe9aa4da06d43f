/* Textures lit at each pixel: Phong shading, highlights on top.
 *
 * SPDX-License-Identifier: MIT
 */
#include "effect/gloss.h"

#if ZS_VARYINGS_MAX >= 8
static const struct zs_shader as_unlit = { .n_varyings = 2 };

void zs_gloss_phong_vertex(const struct zs_shading *s, uint32_t v, uint16_t *out)
{
    const struct zs_mesh *const mesh = s->instance->mesh;
    out[0] = (uint16_t)(mesh->uv[v][0] + 32768);
    out[1] = (uint16_t)(mesh->uv[v][1] + 32768);
    zs_phong_near_vertex(s, v, out + 2);
}

void zs_gloss_phong_start(struct zs_job *job)
{
    zs_gloss_start_as(job, &as_unlit);
    zs_gloss_planes(job, 2, 8);
}

static void pixel_run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to)
{
    zs_gloss_run_as(job, &as_unlit, row, from, to);
    const struct zs_instance *const in = zs_instance_of(job->r, job->tri->instance);
    const struct zs_lit_material *const m = zs_lit_material_of(in);
    const struct zs_camera *const camera = &job->r->camera;
    const int near = m->flags & ZS_LIT_NEAR_VIEWER, placed = zs_lit_placed(m, camera);
    const uint8_t s[3] = { m->specular.r, m->specular.g, m->specular.b };
    const uint8_t e[3] = { m->emission.r, m->emission.g, m->emission.b };
    struct zs_lit_at at;
    zs_lit_view(&at, camera, 0);
    for (int32_t i = from; i < to; i++) {
        struct zs_lit_sum sum;
        uint32_t more[3];
        zs_gloss_point(job, in, i, row->y, 2, placed, &at);
        if (near)
            zs_lit_view(&at, camera, 1);
        zs_lit_add(m, &at, &sum);
        for (int k = 0; k < 3; k++)
            more[k] = zs_lit_part(s[k], sum.shine[k]) + e[k] * 257u;
        zs_gloss_pixel(job->color + row->at + i, sum.diffuse, more);
    }
}

const struct zs_shader zs_shade_texture_phong = {
    .vertex = zs_gloss_phong_vertex, .face = zs_phong_face, .start = zs_gloss_phong_start,
    .run = pixel_run, .check = zs_lit_texture_check, .n_varyings = ZS_VARYINGS_TEXTURE_PHONG,
    .opaque = ZS_TEXTURED
};
#else
const struct zs_shader zs_shade_texture_phong = ZS_GLOSS_REFUSED(ZS_VARYINGS_TEXTURE_PHONG);
#endif
