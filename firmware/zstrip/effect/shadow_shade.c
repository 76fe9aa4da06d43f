/* Shaders that darken what is there: flat shadows and discs.
 *
 * A colour is spread over a word, so that one product dims its three channels: green above, red and
 * blue below. A level has 5 bits and one value more, 0 .. 32.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/depth.h"
#include "core/fx.h"
#include "core/method.h"
#include "core/rows.h"
#include "zs_shadow.h"

#define FIELDS 0x07e0f81fu /* green | red, blue: 5 bits are free above each */
#define HALF (16u << 21 | 16u << 11 | 16u)
#define LEVELS 32u
#define USUAL_BIAS (-8)

/* Dim a pixel, as it lies in memory, to level / 32, nearest, halves up. */
static inline uint16_t dimmed(uint16_t wire, uint32_t level)
{
    const uint32_t v = zs_wire16(wire);
    const uint32_t part = ((v | v << 16) & FIELDS) * level +
                          HALF; /* green <= 63 * 32 + 16 < 2^11 */
    const uint32_t dim = part >> 5 & FIELDS;
    return zs_wire16((uint16_t)(dim | dim >> 16));
}

/* What is left of the light, 0 .. 32. */
static uint16_t left_face(const struct zs_shading *s, uint32_t t)
{
    (void)t;
    return (uint16_t)((s->instance->material->rgb.g * LEVELS + 127u) / 255u);
}

/* ---- Flat shadows ---------------------------------------------------------------------------- */

static void shadow_run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to)
{
    const uint32_t level = job->tri->paint;
    uint16_t *at = job->color + row->at + from;
    for (uint16_t *const end = at + (to - from); at != end; at++)
        *at = dimmed(*at, level);
}

/* In place of zs_rows_test, with b < 0: a pixel passes if what is there is less than |b| before the
 * key, or at most |b| behind it; the key is written moved by 2 b. */
static void shadow_span(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1,
                        uint32_t sum, uint32_t step)
{
    const int32_t bias = job->depth_state ? job->bias : USUAL_BIAS;
    const int32_t top = (int32_t)(job->r->view.key_top >> 16) - 1;
    uint16_t *const line = job->depth + row->at;
    for (int32_t i = i0; i < i1; i++, sum += step) { /* the step skips the pixel that failed */
        const int32_t from = i;
        for (; i < i1; i++, sum += step) {
            const int32_t key = zs_min32((int32_t)(sum >> 16), top), there = line[i];
            if (there <= zs_max32(key + bias, 0) ||
                there > zs_min32(key - bias, ZS_DEPTH_CLEAR - 1))
                break;
            line[i] = (uint16_t)zs_max32(key + 2 * bias, 0);
        }
        if (i > from) {
            zs_rows_written(job, i - from);
            shadow_run(job, row, from, i);
        }
    }
}

static int shadow_check(const struct zs_instance *in, const struct zs_config *config)
{
    const struct zs_depth_state *state = in->depth_state;
    if (config->depth->span || !config->method->buffer)
        return ZS_ERR_DEPTH;
    return state && (state->func != ZS_DEPTH_LESS || state->read_only || state->bias >= 0 ||
                     state->slope_bias)
               ? ZS_ERR_RANGE
               : ZS_OK;
}

const struct zs_shader zs_shade_shadow = {
    .face = left_face, .run = shadow_run, .span = shadow_span, .check = shadow_check
};

/* ---- Discs ----------------------------------------------------------------------------------- */

#define SIDE 128 /* steps */

static const int16_t disc_pos[4][3] = {
    { -SIDE, 0, SIDE }, { SIDE, 0, SIDE }, { SIDE, 0, -SIDE }, { -SIDE, 0, -SIDE }
};
static const uint16_t disc_tri[2][3] = { { 0, 1, 2 }, { 0, 2, 3 } };
const struct zs_mesh zs_shadow_disc = {
    .pos = disc_pos, .tri = disc_tri, .n_verts = 4, .n_tris = 2, .radius = 182
};

static void disc_vertex(const struct zs_shading *s, uint32_t v, uint16_t *out)
{
    const int16_t *const p = s->instance->mesh->pos[v];
    out[0] = (uint16_t)zs_min32(p[0] * 256 + 32768, 65535);
    out[1] = (uint16_t)zs_min32(p[2] * 256 + 32768, 65535);
}

static void disc_fragment(const struct zs_instance *instance, struct zs_fragment *f)
{
    const int32_t x = f->v[0] - 32768, y = f->v[1] - 32768;                /* |.| <= 2^15 */
    const uint32_t square = ((uint32_t)(x * x) + (uint32_t)(y * y)) >> 15; /* q15, <= 2^16 */
    (void)instance;
    if (square >= 32768u)
        return;
    const uint32_t inner = 32768u - square, dark = inner * inner >> 15; /* q15, <= 2^15 */
    const uint32_t level = LEVELS - (((LEVELS - f->paint) * dark + 16384u) >> 15);
    *f->color = dimmed(*f->color, level);
}

const struct zs_shader zs_shade_disc = { .vertex = disc_vertex,
                                         .face = left_face,
                                         .fragment = disc_fragment,
                                         ZS_FRAGMENTS,
                                         .n_varyings = ZS_VARYINGS_DISC };
