/* What a shader is. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_SHADER_H
#define ZS_SHADER_H

#include "zstrip.h"

struct zs_job;
struct zs_row;

struct zs_shader {
    /* Attributes of a vertex: out[n_attrs]. NULL: none. */
    void (*vertex)(const struct zs_renderer *r, uint32_t v, uint16_t *out);
    /* What zs_tri.paint becomes for a face of the current instance; NULL: 0. */
    uint16_t (*face)(const struct zs_renderer *r, uint32_t t);
    /* Gradients of the triangle's colours, before run; NULL: none. */
    void (*start)(struct zs_job *job);
    /* Colour pixels [from, to) of a row, already found nearest. */
    void (*run)(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to);
    /* ZS_OK, or why this instance cannot be drawn with it. */
    int (*check)(const struct zs_instance *instance, const struct zs_config *config);
    /* Textures: n pixels times light, uq1_31, which changes by step; NULL: none. */
    void (*light)(uint16_t *out, int32_t n, uint32_t level, uint32_t step);
    uint8_t n_attrs;
};

#endif
