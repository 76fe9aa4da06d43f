/* Textures in light, with highlights on top, both from the vertices.
 *
 * Where no vertex of a triangle has a highlight, and there is no emission, its pixels are those of
 * zs_shade_texture_smooth, and cost no more.
 *
 * Where a vertex cannot have as many varyings, the shaders are empty: what uses them is
 * refused, ZS_ERR_VARYINGS.
 *
 * SPDX-License-Identifier: MIT
 */
#include "effect/gloss.h"

#define GLOSS(of, n)                                                                               \
    .vertex = of##_vertex, .start = of##_start, .run = of##_run, .check = zs_lit_texture_check,    \
    .n_varyings = (n), .opaque = ZS_TEXTURED

/* ---- By luminance ---------------------------------------------------------------------------- */

#if ZS_VARYINGS_MAX >= 4
static inline uint32_t most_of(struct zs_rgb c)
{
    return zs_maxu32(zs_maxu32(c.r, c.g), c.b);
}

/* Rec. 601: 77, 150 and 29 of 256. c < 2^21 */
static uint32_t luminance(const uint32_t c[3])
{
    return (c[0] * 77u + c[1] * 150u + c[2] * 29u + 128u) >> 8;
}

#define LIGHT_MAX 65504u /* uq1_15, just below 2: zs_texture_light adds a half */

/* Light, uq1_15; and highlights of the strongest channel of the material's specular colour. */
static void gloss_vertex(const struct zs_shading *s, uint32_t v, uint16_t *out)
{
    struct zs_lit_sum sum;
    zs_gloss_vertex(s, v, out, &sum);
    out[2] = (uint16_t)zs_minu32((luminance(sum.diffuse) + 1u) >> 1, LIGHT_MAX);
    const uint8_t most = (uint8_t)most_of(zs_lit_material_of(s->instance)->specular);
    out[3] = (uint16_t)zs_minu32(zs_lit_part(most, luminance(sum.shine)), 65535u);
}

static const struct zs_shader as_smooth = { .light = zs_texture_light, .n_varyings = 3 };

static void gloss_start(struct zs_job *job)
{
    zs_gloss_start_as(job, &as_smooth);
    const uint16_t *a[3];
    zs_persp_attrs(job, a);
    if (a[0][3] | a[1][3] | a[2][3])
        zs_gloss_planes(job, 3, 4);
    else
        job->c[3] = (struct zs_plane){ 0 };
}

static void gloss_run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to)
{
    zs_gloss_run_as(job, &as_smooth, row, from, to);
    const struct zs_lit_material *const m =
        zs_lit_material_of(zs_instance_of(job->r, job->tri->instance));
    const struct zs_plane *const plane = &job->c[3];
    const int shines = (plane->base | plane->gx | plane->gy) != 0;
    const uint32_t most = most_of(m->specular);
    const uint8_t e[3] = { m->emission.r, m->emission.g, m->emission.b };
    const uint8_t c[3] = { m->specular.r, m->specular.g, m->specular.b };
    static const uint32_t one[3] = { ZS_Q16_ONE, ZS_Q16_ONE, ZS_Q16_ONE };
    uint32_t share[3] = { 0, 0, 0 }; /* of the strongest channel, uq1_15 */
    if (!shines && !(e[0] | e[1] | e[2]))
        return;
    for (int k = 0; shines && k < 3; k++)
        share[k] = (c[k] * 32768u + most / 2u) / most;
    for (int32_t i = from; i < to; i++) {
        uint32_t more[3], w, h = 0;
        int32_t lz;
        if (shines) {
            const uint32_t rcp = zs_persp_rcp(job, i, row->y, &w, &lz);
            h = zs_persp_over(zs_plane_at(plane, i, row->y), w, rcp, lz) >> 15;
        }
        for (int k = 0; k < 3; k++)
            more[k] = (share[k] * h >> 15) + e[k] * 257u;
        zs_gloss_pixel(job->color + row->at + i, one, more);
    }
}

const struct zs_shader zs_shade_texture_gloss = { GLOSS(gloss, ZS_VARYINGS_TEXTURE_GLOSS) };
#else
const struct zs_shader zs_shade_texture_gloss = ZS_GLOSS_REFUSED(ZS_VARYINGS_TEXTURE_GLOSS);
#endif

/* ---- By channel ------------------------------------------------------------------------------ */

#if ZS_VARYINGS_MAX >= 8
static void tinted_vertex(const struct zs_shading *s, uint32_t v, uint16_t *out)
{
    struct zs_lit_sum sum;
    zs_gloss_vertex(s, v, out, &sum);
    static const struct zs_rgb black = { 0, 0, 0 };
    zs_lit_mix(zs_lit_material_of(s->instance), black, &sum, out + 5);
    for (int k = 0; k < 3; k++)
        out[2 + k] = (uint16_t)zs_minu32((sum.diffuse[k] + 1u) >> 1, 65535u);
}

static const struct zs_shader as_unlit = { .n_varyings = 2 };

static void tinted_start(struct zs_job *job)
{
    zs_gloss_start_as(job, &as_unlit);
    zs_gloss_planes(job, 2, 8);
}

static void tinted_run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to)
{
    zs_gloss_run_as(job, &as_unlit, row, from, to);
    for (int32_t i = from; i < to; i++) {
        uint32_t c[6], w;
        int32_t lz;
        const uint32_t rcp = zs_persp_rcp(job, i, row->y, &w, &lz);
        for (int k = 0; k < 6; k++) /* light: twice that is uq16_16 */
            c[k] = zs_persp_over(zs_plane_at(&job->c[2 + k], i, row->y), w, rcp, lz) >>
                   (k < 3 ? 14 : 15);
        zs_gloss_pixel(job->color + row->at + i, c, c + 3);
    }
}

const struct zs_shader zs_shade_texture_gloss_tinted = {
    GLOSS(tinted, ZS_VARYINGS_TEXTURE_GLOSS_TINTED)
};
#else
const struct zs_shader zs_shade_texture_gloss_tinted =
    ZS_GLOSS_REFUSED(ZS_VARYINGS_TEXTURE_GLOSS_TINTED);
#endif
