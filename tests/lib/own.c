/* Stages of one's own: see own.h.
 *
 * SPDX-License-Identifier: MIT
 */
#include "own.h"

static void own_vertex(const struct zs_shading *s, uint32_t v, uint16_t *out)
{
    for (int k = 0; k < 3; k++)
        out[k] = (uint16_t)(s->instance->mesh->pos[v][k] * (2 * k + 3));
}

static uint16_t own_face(const struct zs_shading *s, uint32_t t)
{
    zs_q1_15 n[3];
    zs_light_face_normal(n, s->instance->mesh, t);
    return (uint16_t)(zs_light_intensity(s, n) + t);
}

static void own_fragment(const struct zs_instance *instance, struct zs_fragment *f)
{
    const uint32_t mixed = f->v[0] ^ (uint32_t)f->v[1] << 1 ^ f->v[2] >> 3 ^ f->paint;
    *f->color = (uint16_t)((mixed ^ f->x * 40503u ^ f->y * 10139u) + instance->material->rgb.r);
}

const struct zs_shader own_shader = { .vertex = own_vertex, .face = own_face, .fragment = own_fragment, ZS_FRAGMENTS,
                                      .n_varyings = 3, .opaque = 1 };

static void glass_fragment(const struct zs_instance *instance, struct zs_fragment *f)
{
    (void)instance;
    if (f->v[0] >> 13 & 1u)
        return;
    *f->color = (uint16_t)(*f->color * 3u + (f->v[1] >> 9) + f->paint);
}

const struct zs_shader glass_shader = {
    .vertex = own_vertex, .face = own_face, .fragment = glass_fragment, ZS_FRAGMENTS, .n_varyings = 3
};

void own_fill(void *ctx, uint16_t *out, uint16_t x, uint16_t y, uint16_t n)
{
    const uint16_t *const seed = (const uint16_t *)ctx;
    for (uint32_t k = 0; k < n; k++)
        out[k] = (uint16_t)((x + k) * 40503u ^ y * 10139u ^ *seed);
}

void own_draw(void *ctx, const struct zs_target *t)
{
    const struct zs_rect *const r = (const struct zs_rect *)ctx;
    for (uint32_t y = t->y0; y < t->y1; y++)
        for (uint32_t x = t->x0; x < t->x1; x++)
            if (x >= r->x && x < (uint32_t)r->x + r->w && y >= r->y && y < (uint32_t)r->y + r->h) {
                const uint32_t at = (y - t->y0) * t->pitch + x;
                t->color[at] = (uint16_t)(t->color[at] * 5u + (t->depth ? t->depth[at] >> 7 : 0));
            }
}
