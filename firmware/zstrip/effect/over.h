/* Shaders that draw with an opaque shader of shade/ and then change its pixels. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_EFFECT_OVER_H
#define ZS_EFFECT_OVER_H

#include "core/fx.h"
#include "core/rows.h"
#include "shade/texture.h"
#include "zs_shader.h"

typedef void zs_run_fn(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to);

#define ZS_OVER_MAX 32 /* pixels of a piece: a group of textures, two sub-spans of smooth colours */
_Static_assert(ZS_OVER_MAX == 1 << ZS_TEXTURE_GROUP_LOG2, "pieces end where groups end");

/* The end of the piece that pixel `from` is in. */
static inline int32_t zs_over_next(const struct zs_row *row, int32_t from)
{
    return row->x0 + ((from - row->x0) | (ZS_OVER_MAX - 1)) + 1;
}

/* Copy n > 0 pixels. */
static inline void zs_over_keep(uint16_t *to, const uint16_t *from, int32_t n)
{
    for (uint16_t *const end = to + n; to != end;)
        *to++ = *from++;
}

/* Stages of the opaque shaders, for shaders over them: a shader's address is constant, its fields
 * are not. */
void zs_over_smooth_vertex(const struct zs_shading *s, uint32_t v, uint16_t *out);
void zs_over_smooth_start(struct zs_job *job);
int zs_over_smooth_check(const struct zs_instance *in, const struct zs_config *config);
void zs_over_texture_vertex(const struct zs_shading *s, uint32_t v, uint16_t *out);
void zs_over_texture_lit_vertex(const struct zs_shading *s, uint32_t v, uint16_t *out);
uint16_t zs_over_texture_face(const struct zs_shading *s, uint32_t t);
void zs_over_texture_start(struct zs_job *job);
int zs_over_texture_check(const struct zs_instance *in, const struct zs_config *config);
int zs_over_texture_lit_check(const struct zs_instance *in, const struct zs_config *config);
uint16_t zs_over_raw_face(const struct zs_shading *s, uint32_t t);
uint16_t zs_over_flat_face(const struct zs_shading *s, uint32_t t);

#define ZS_OVER_SMOOTH(check_)                                                                     \
    .vertex = zs_over_smooth_vertex, .start = zs_over_smooth_start, .check = check_,               \
    .n_varyings = ZS_VARYINGS_SMOOTH
#define ZS_OVER_TEXTURE(check_)                                                                    \
    .vertex = zs_over_texture_vertex, .start = zs_over_texture_start, .check = check_,             \
    .n_varyings = ZS_VARYINGS_TEXTURE
#define ZS_OVER_TEXTURE_FLAT(check_)                                                               \
    ZS_OVER_TEXTURE(check_), .face = zs_over_texture_face, .light = zs_texture_light
#define ZS_OVER_TEXTURE_SMOOTH(check_)                                                             \
    .vertex = zs_over_texture_lit_vertex, .start = zs_over_texture_start, .check = check_,         \
    .light = zs_texture_light, .n_varyings = ZS_VARYINGS_TEXTURE_SMOOTH

#endif
