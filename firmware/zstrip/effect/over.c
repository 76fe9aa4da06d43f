/* Stages of the opaque shaders, as functions that other shaders can name.
 *
 * SPDX-License-Identifier: MIT
 */
#include "effect/over.h"

uint16_t zs_over_raw_face(const struct zs_shading *s, uint32_t t)
{
    return zs_shade_raw.face(s, t);
}

uint16_t zs_over_flat_face(const struct zs_shading *s, uint32_t t)
{
    return zs_shade_flat.face(s, t);
}

void zs_over_smooth_vertex(const struct zs_shading *s, uint32_t v, uint16_t *out)
{
    zs_shade_smooth.vertex(s, v, out);
}

void zs_over_smooth_start(struct zs_job *job)
{
    zs_shade_smooth.start(job);
}

int zs_over_smooth_check(const struct zs_instance *in, const struct zs_config *config)
{
    return zs_shade_smooth.check(in, config);
}

void zs_over_texture_vertex(const struct zs_shading *s, uint32_t v, uint16_t *out)
{
    zs_shade_texture.vertex(s, v, out);
}

void zs_over_texture_lit_vertex(const struct zs_shading *s, uint32_t v, uint16_t *out)
{
    zs_shade_texture_smooth.vertex(s, v, out);
}

uint16_t zs_over_texture_face(const struct zs_shading *s, uint32_t t)
{
    return zs_shade_texture_flat.face(s, t);
}

void zs_over_texture_start(struct zs_job *job)
{
    zs_shade_texture.start(job);
}

int zs_over_texture_check(const struct zs_instance *in, const struct zs_config *config)
{
    return zs_shade_texture.check(in, config);
}

int zs_over_texture_lit_check(const struct zs_instance *in, const struct zs_config *config)
{
    return zs_shade_texture_smooth.check(in, config);
}
