/* An easel for the rasterizer alone: see easel.h.
 *
 * SPDX-License-Identifier: MIT
 */
#include "easel.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fast_lists.h"
#include "kept.h"
#include "oracle.h"
#include "internals.h"

struct easel easel_default(int32_t width, int32_t height)
{
    const struct easel s = {
        .width = width, .height = height, .strip_h = height, .depth = &zs_depth_recip, .depth_bits = 16, .z_near = 256,
        .z_far = 1 << 20, .fast = fast_all
    };
    return s;
}

static void must(int ok, const char *what)
{
    if (!ok) {
        fprintf(stderr, "easel: %s\n", what);
        abort();
    }
}

/* A triangle's corners as bins have them: the top one first, of two the left one, then clockwise. Return 0: it has no
 * area. */
static int order_corners(const struct easel_tri *t, uint32_t order[3])
{
    const int64_t area = ((int64_t)t->x[1] - t->x[0]) * ((int64_t)t->y[2] - t->y[0]) -
                         ((int64_t)t->x[2] - t->x[0]) * ((int64_t)t->y[1] - t->y[0]);
    uint32_t top = 0;
    for (uint32_t v = 1; v < 3; v++)
        if (t->y[v] < t->y[top] || (t->y[v] == t->y[top] && t->x[v] < t->x[top]))
            top = v;
    order[0] = top;
    order[1] = (top + (area > 0 ? 1 : 2)) % 3;
    order[2] = (top + (area > 0 ? 2 : 1)) % 3;
    return area != 0;
}

static void fill_pools(struct zs_renderer *r, const struct easel_tri *t, uint32_t n,
                       uint32_t n_states, int lit)
{
    uint32_t n_tris = 0;
    for (uint32_t s = 0; s < r->n_strips; s++)
        r->bin[s] = ZS_NIL;
    for (uint32_t k = 0; k < n; k++) {
        int32_t top = INT32_MAX;
        for (uint32_t v = 0; v < 3; v++) {
            struct zs_vertex *out = &r->vert[3 * k + v];
            out->x = t[k].x[v];
            out->y = t[k].y[v];
            out->d = t[k].d[v];
            top = out->y < top ? out->y : top;
            for (uint32_t c = 0; c < r->config.varyings; c++)
                r->attr[(3 * k + v) * r->config.varyings + c] = t[k].rgb[v][c];
        }
        uint32_t order[3];
        if (!order_corners(&t[k], order))
            continue;
        int32_t row = (top + 127) >> 8; /* first row whose sample is not above the top */
        row = row < 0 ? 0 : row;
        if (row >= r->config.height)
            continue;
        struct zs_tri *tri = &r->tri[n_tris];
        for (uint32_t v = 0; v < 3; v++)
            tri->v[v] = (uint16_t)(3 * k + order[v]);
        tri->paint = lit ? t[k].rgb[0][2] : zs_wire16((uint16_t)(k + 1));
        must(n_states == 0 || t[k].state <= n_states, "state");
        tri->instance = (uint16_t)(n_states ? t[k].state : 0);
        const int32_t strip = row / r->config.strip_h;
        tri->next = r->bin[strip];
        r->bin[strip] = (uint16_t)n_tris;
        n_tris++;
    }
    r->n_tris = n_tris;
    r->n_verts = 3 * n;
    r->active = ZS_NIL;
    r->walk_x = r->walk_least = 0;
    r->walk_end = r->walk_most = r->config.width;
    r->walk_y = 0;
    r->walk_y_end = r->config.height;
    r->band_end = r->n_strips; /* bins are complete: no walk */
}

static const struct zs_shader *shader_of(const struct easel *s)
{
    if (s->texture)
        return s->smooth ? &zs_shade_texture_smooth : s->lit ? &zs_shade_texture_flat : &zs_shade_texture;
    return s->smooth ? &zs_shade_smooth : &zs_shade_raw;
}

static uint32_t attrs_of(const struct easel *s)
{
    if (s->texture)
        return s->smooth ? ZS_VARYINGS_TEXTURE_SMOOTH : ZS_VARYINGS_TEXTURE;
    return s->smooth ? ZS_VARYINGS_SMOOTH : ZS_VARYINGS_FLAT;
}

void easel_draw(const struct easel *s, const struct easel_tri *t, uint32_t n,
                struct easel_frame *out)
{
    struct zs_renderer r;
    const struct zs_config config = {
        .width = (uint16_t)s->width, .height = (uint16_t)s->height,
        .strip_h = (uint16_t)s->strip_h, .max_tris = (uint16_t)(n ? n : 1),
        .max_verts = (uint16_t)(n ? 3 * n : 3), .varyings = (uint8_t)attrs_of(s),
        .buffers = 1, .subpixel_bits = 8, .depth_bits = (uint8_t)s->depth_bits,
        .depth = s->depth, .fast = fast_counting(s->fast)
    };
    const uint32_t bytes = zs_arena_bytes(&config);
    void *arena = sim_kept(bytes);
    must(arena && zs_init(&r, &config, arena, bytes) == ZS_OK, "zs_init");

    static const zs_q1_15 normal[1][3] = { { 0, 0, 32767 } };
    static const int16_t uv[1][2] = { { 0, 0 } };
    struct zs_mesh mesh = {
        .scale = ZS_Q16_ONE, .normal = normal, .radius = 1, .uv = uv, .uv_bits = (uint8_t)s->uv_bits
    };
    const struct zs_material material = { .shader = shader_of(s), .cull = ZS_CULL_NONE, .texture = s->texture };
    struct zs_instance instance[EASEL_STATES_MAX + 1];
    memset(instance, 0, sizeof instance);
    must(s->n_states <= EASEL_STATES_MAX, "states");
    for (uint32_t k = 0; k <= s->n_states; k++) {
        instance[k].mesh = &mesh;
        instance[k].material = &material;
        zs_pose_identity(&instance[k].pose);
        instance[k].pose.pos[2] = -s->z_far; /* in view: the camera unit reaches to the far plane */
        instance[k].depth_state = k ? &s->state[k - 1] : NULL;
    }
    struct zs_scene scene = { .instance = instance, .n_instances = s->n_states + 1 };
    struct zs_camera camera;
    must(zs_camera_perspective(&camera, 8192, (uint16_t)s->height, s->z_near, s->z_far) == ZS_OK,
         "camera");
    must(zs_frame_begin(&r, &scene, &camera) == ZS_OK, "zs_frame_begin");
    fill_pools(&r, t, n, s->n_states, s->lit);

    const size_t n_px = (size_t)s->width * (size_t)s->height;
    out->color = sim_kept(n_px * 2);
    out->key = sim_kept(n_px * 2);
    must(out->color && out->key, "memory");
    struct zs_strip strip;
    size_t at = 0;
    while (zs_frame_strip(&r, &strip) == 1) {
        const size_t px = (size_t)strip.w * strip.h;
        must(at + px <= n_px, "strips beyond the frame");
        for (size_t i = 0; i < px; i++)
            out->color[at + i] = (uint16_t)(strip.px[2 * i] << 8 | strip.px[2 * i + 1]);
        memcpy(out->key + at, strip.depth, px * 2);
        at += px;
    }
    must(at == n_px, "strips do not fill the frame");
    out->tested = r.stats.pixels_tested;
    out->written = r.stats.pixels_written;
    out->setups = r.stats.tris_setup;
    out->at_once = fast_at_once;
    out->unit_near = r.view.z_near;
    out->shift = r.view.shift;
    out->key_far = (double)r.view.key_far / 65536.0;
    must(zs_frame_end(&r) == ZS_OK, "zs_frame_end");
    sim_kept_end(arena);
}

void easel_free(struct easel_frame *f)
{
    sim_kept_end(f->color);
    sim_kept_end(f->key);
    f->color = f->key = NULL;
}

int easel_float_bits(const struct zs_depth *depth)
{
    return depth == &zs_depth_e3m13   ? 3
           : depth == &zs_depth_e4m12 ? 4
           : depth == &zs_depth_e5m11 ? 5
                                      : 0;
}

int64_t easel_inverse(const struct easel *s, const struct easel_frame *f, const uint32_t d[3],
                      int k)
{
    const struct oracle_float as_float = { easel_float_bits(s->depth), s->depth_bits };
    if (as_float.e)
        return (int64_t)oracle_float_r(&as_float, d[k]);
    if (s->depth == &zs_depth_linear) /* 1 / z times the product of all three */
        return (int64_t)d[(k + 1) % 3] * d[(k + 2) % 3];
    const int64_t above = (int64_t)(f->key_far * 65536.0) - d[k]; /* the reciprocal mapping */
    return above > 0 ? above : 1;
}

struct oracle_tri easel_oracle(const struct easel_tri *t)
{
    const struct oracle_tri o = { { t->x[0], t->x[1], t->x[2] }, { t->y[0], t->y[1], t->y[2] } };
    return o;
}
