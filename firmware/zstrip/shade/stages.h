/* Stages of the opaque shaders, for shaders over them (effect/). Internal.
 *
 * A shader over one of shade/ names its stages, not the fields of zs_shade_smooth and the like: a
 * call of such a field could be one of itself, for who bounds the stack.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_SHADE_STAGES_H
#define ZS_SHADE_STAGES_H

#include "core/rows.h"
#include "zs_shader.h"

/* zs_shader.opaque of zs_shade_raw, whose face gives mesh.face_raw where there is one. */
#define ZS_RAW 5u
/* zs_shader.face: a colour, as it lies in memory; zs_solid_run (core/rows.h) fills the pixels. */
uint16_t zs_raw_face(const struct zs_shading *s, uint32_t t);
uint16_t zs_flat_face(const struct zs_shading *s, uint32_t t);
/* zs_shade_smooth's. */
void zs_smooth_vertex(const struct zs_shading *s, uint32_t v, uint16_t *out);
void zs_smooth_start(struct zs_job *job);
void zs_smooth_run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to);
/* Compute the colour at a covered pixel by division: codes, uq16_16, with half a code added; not of
 * a triangle that is affine. */
void zs_smooth_at(const struct zs_job *job, int32_t i, int32_t row, uint32_t out[3]);
int zs_smooth_usable(const struct zs_instance *in, const struct zs_config *config);
/* Those of the textured shaders: texture coordinates; and light at vertices, or of a face. */
void zs_texture_vertex(const struct zs_shading *s, uint32_t v, uint16_t *out);
void zs_texture_lit_vertex(const struct zs_shading *s, uint32_t v, uint16_t *out);
uint16_t zs_texture_lit_face(const struct zs_shading *s, uint32_t t);
void zs_texture_start(struct zs_job *job);
int zs_texture_usable(const struct zs_instance *in, const struct zs_config *config);
int zs_texture_lit_usable(const struct zs_instance *in, const struct zs_config *config);

#endif
