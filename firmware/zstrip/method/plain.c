/* The material's colour, unlit: for lines and points. And nothing: for what only hides.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/fx.h"
#include "core/rows.h"
#include "zs_lines.h"
#include "zs_shader.h"

uint16_t zs_plain_face(const struct zs_shading *s, uint32_t t)
{
    const struct zs_rgb *c = &s->instance->material->rgb;
    (void)t;
    return zs_wire16(zs_rgb565(c->r, c->g, c->b));
}

static void none_run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to)
{
    (void)job;
    (void)row;
    (void)from;
    (void)to;
}

const struct zs_shader zs_shade_plain = { .face = zs_plain_face, .run = zs_solid_run, .opaque = 1 };
const struct zs_shader zs_shade_none = { .run = none_run };
