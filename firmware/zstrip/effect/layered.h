/* Layers of any shader: what the kinds share. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_EFFECT_LAYERED_H
#define ZS_EFFECT_LAYERED_H

#include "effect/blend.h"
#include "effect/over.h"

struct zs_layer_kind {
    void (*run)(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to);
    void (*span)(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1, uint32_t sum,
                 uint32_t step);
    uint8_t layer; /* of the shader */
};

static inline const struct zs_layered *zs_layered_of(const struct zs_job *job)
{
    return (const struct zs_layered *)(const void *)job->shader;
}

/* Draw columns [from, to) by the layer's shader, to px; at most ZS_OVER_MAX. */
void zs_layered_draw(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to,
                     uint16_t *px);

#endif
