/* Stages that the shaders of zs_filter.h share: those of the textured shaders.
 *
 * SPDX-License-Identifier: MIT
 */
#include "effect/filter.h"

void zs_filter_vertex(const struct zs_shading *s, uint32_t v, uint16_t *out)
{
    zs_shade_texture.vertex(s, v, out);
}

void zs_filter_vertex_lit(const struct zs_shading *s, uint32_t v, uint16_t *out)
{
    zs_shade_texture_smooth.vertex(s, v, out);
}

uint16_t zs_filter_face_lit(const struct zs_shading *s, uint32_t t)
{
    return zs_shade_texture_flat.face(s, t);
}

int zs_filter_check(const struct zs_instance *in, const struct zs_config *config)
{
    return zs_shade_texture.check(in, config);
}

int zs_filter_check_lit(const struct zs_instance *in, const struct zs_config *config)
{
    return zs_shade_texture_smooth.check(in, config);
}
