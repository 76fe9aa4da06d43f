/* Set-up of a renderer, the checks of a frame, and the loop over strips.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/cull.h"
#include "core/damage.h"
#include "core/depth.h"
#include "core/fast.h"
#include "core/frame.h"
#include "core/fx.h"
#include "core/method.h"
#include "core/pass.h"
#include "core/raster.h"
#include "core/rotation.h"
#include "core/rows.h"
#include "core/usual.h"
#include "core/view.h"
#include "core/walk.h"
#include "zs_damage.h"
#include "zs_shader.h"

/* ---- Set-up ---------------------------------------------------------------------------------- */

static ZS_RARE int config_ok(const struct zs_config *c)
{
    return c->width >= 1 && c->width <= ZS_SIZE_MAX && c->height >= 1 && c->height <= ZS_SIZE_MAX &&
           c->strip_h >= 1 && c->max_tris >= 1 && c->max_tris <= ZS_POOL_MAX && c->max_verts >= 3 &&
           c->max_verts <= ZS_POOL_MAX && c->varyings <= ZS_VARYINGS_MAX && c->buffers <= 2 &&
           (c->subpixel_bits == 0 || c->subpixel_bits == 8 || c->subpixel_bits == 4);
}

/* config.strip_h, at most the height. */
static uint16_t strip_h_of(const struct zs_config *c)
{
    return c->strip_h < c->height ? c->strip_h : c->height;
}

static int has_depth(const struct zs_config *c)
{
    return !c->depth || !c->depth->span;
}

uint32_t zs_arena_bytes(const struct zs_config *c)
{
    if (!c || !config_ok(c))
        return 0;
    return ZS_ARENA_BYTES(c->width, c->height, strip_h_of(c), c->max_tris, c->max_verts,
                          c->varyings, c->buffers) -
           (has_depth(c) ? 0u : ZS_DEPTH_BYTES(c->width, strip_h_of(c)));
}

/* Take the next pool from the arena. */
static void *take(uintptr_t *at, uint32_t bytes)
{
    void *pool = (void *)*at;
    *at += bytes;
    return pool;
}

/* Place all pools from an address on. Return the arena's end, zs_arena_bytes further on. */
static ZS_RARE uintptr_t place_pools(struct zs_renderer *r, uintptr_t at)
{
    const struct zs_config *c = &r->config;
    const uint32_t color = ZS_COLOR_BYTES(c->width, c->strip_h, 1u);
    const uint32_t half_words = ZS_ROUND4(c->max_verts * 2u);
    r->color[0] = take(&at, color);
    r->color[1] = c->buffers == 2 ? take(&at, color) : r->color[0];
    r->depth = has_depth(c) ? take(&at, ZS_DEPTH_BYTES(c->width, c->strip_h)) : 0;
    r->drawn = take(&at, ZS_DRAWN_BYTES(c->strip_h));
    r->bound = take(&at, ZS_BOUND_BYTES(c->width, c->height, c->strip_h));
    r->bin = take(&at, ZS_BIN_BYTES(c->height, c->strip_h));
    r->tri = take(&at, ZS_TRI_BYTES(c->max_tris));
    r->vert = take(&at, c->max_verts * 12u);
    r->vert_src = take(&at, half_words);
    r->vert_map = take(&at, half_words);
    r->attr = take(&at, ZS_ROUND4((uint32_t)c->max_verts * c->varyings * 2u));
    return at;
}

/* Compute the factor and shift that replace the division row / strip_h. With 2^l <= strip_h < 2^(l
 * + 1) and n = 19 + l, strip_mul exceeds 2^n / strip_h by at most 1. That adds at most row / 2^n <
 * 2^-7 / 2^l < 2^-6 / strip_h to a quotient, whose fraction is at most 1 - 1 / strip_h; so its
 * floor is exact. */
static ZS_RARE void strip_divisor(struct zs_renderer *r)
{
    const uint32_t h = r->config.strip_h;
    const int n = 19 + 31 - zs_clz32(h);
    r->strip_shift = (uint8_t)n;
    r->strip_mul = (1u << n) / h + 1u; /* <= 2^19 + 1; times a row < 2^31.1 */
}

/* Choose the accelerators of the frame: the first of each kind in the list. `touch` and `tiles`
 * work only in a frame of one pass, whose depth test is zs_rows_test. */
static ZS_RARE void accelerators(struct zs_renderer *r)
{
    if (ZS_NO_FAST)
        return;
    r->touch = 0;
    r->tiles = 0;
    r->batch = 0;
    r->clusters_hooks = 0;
    r->edges = 0;
    r->divided = 0;
    for (const struct zs_fast *const *at = r->config.fast; at && *at; at++) {
        const struct zs_fast *fast = *at;
        r->touch = r->touch ? r->touch : fast->touch;
        r->tiles = r->tiles ? r->tiles : fast->tiles;
        r->batch = r->batch ? r->batch : fast->batch;
        r->clusters_hooks = r->clusters_hooks ? r->clusters_hooks : fast->clusters;
        r->edges = r->edges ? r->edges : fast->edges;
        r->divided = r->divided ? r->divided : fast->divided;
    }
    if (r->passes || r->span != zs_rows_test) {
        r->touch = 0;
        r->tiles = 0;
    }
    r->refit = r->passes != 0;
}

/* The bit fields of ZS_BUILD must not overlap. */
_Static_assert(sizeof(struct zs_renderer) < 1u << 14 && ZS_VARYINGS_MAX < 1 << 4 &&
                   ZS_SIZE_MAX < 1 << 14,
               "ZS_BUILD tells sizes apart");

ZS_RARE int zs_init_build(struct zs_renderer *r, const struct zs_config *config, void *arena,
                          size_t bytes, uint32_t build)
{
    if (!r)
        return ZS_ERR_NULL;
    if (build != ZS_BUILD)
        return ZS_ERR_BUILD;
    *r = (struct zs_renderer){ 0 };
    if (!config || !arena || !config->depth)
        return ZS_ERR_NULL;
    if (!config_ok(config))
        return ZS_ERR_SIZE;
    if (config->depth_bits > 16 || (config->depth_bits < 8 && config->depth_bits))
        return ZS_ERR_DEPTH;
    r->config = *config;
    r->span = config->depth->span ? config->depth->span : zs_rows_test;
    if (config->method) {
        const int err = config->method->begin(r);
        if (err)
            return err;
    } else {
        r->config.method = &zs_method_buffer;
    }
    r->config.buffers = config->buffers == 2 ? 2 : 1;
    r->config.subpixel_bits = config->subpixel_bits == 4 ? 4 : 8;
    r->config.depth_bits = config->depth_bits ? config->depth_bits : 16;
    r->config.strip_h = strip_h_of(config);
    r->n_strips = (uint16_t)((config->height + r->config.strip_h - 1) / r->config.strip_h);
    strip_divisor(r);
    const uintptr_t at = (uintptr_t)arena;
    if (place_pools(r, at) - at > bytes || (at & 3u))
        return ZS_ERR_ARENA;
    for (uint32_t v = 0; v < config->max_verts; v++)
        r->vert_map[v] = r->vert_src[v] = 0; /* so that none is read uninitialised; entries are
                                              checked, so any value is correct */
    r->window[1] = config->width;
    accelerators(r);
    r->ready = 1;
    return ZS_OK;
}

/* ---- Checks of a frame ----------------------------------------------------------------------- */

static ZS_RARE int instance_check(const struct zs_renderer *r, const struct zs_instance *in)
{
    const struct zs_mesh *mesh = in->mesh;
    const struct zs_material *material = in->material;
    if (!mesh || !material || !material->shader)
        return ZS_ERR_NULL;
    if ((!mesh->pos && mesh->n_verts) || (!mesh->tri && mesh->n_tris) || mesh->n_verts > 65535u ||
        material->cull > ZS_CULL_NONE)
        return ZS_ERR_MESH;
    const struct zs_shader *shader = material->shader;
    if (!shader->run || (shader->by_fragment && !shader->fragment))
        return ZS_ERR_NULL;
    if (shader->n_varyings > r->config.varyings || (shader->vertex && !shader->n_varyings))
        return ZS_ERR_VARYINGS;
    if (in->depth_state && in->depth_state->func > ZS_DEPTH_ALWAYS)
        return ZS_ERR_RANGE;
    return material->shader->check ? material->shader->check(in, &r->config) : ZS_OK;
}

/* Check all instances, and find the reach: the largest |coordinate| in camera axes among the
 * instances in view. */
static ZS_RARE int scene_check(const struct zs_renderer *r, const struct zs_scene *scene,
                               int64_t *reach)
{
    if (scene->n_instances > 65535u)
        return ZS_ERR_SIZE;
    if (scene->n_instances && !scene->instance)
        return ZS_ERR_NULL;
    if (!zs_within(scene->light.dir, 3, ZS_UNIT_MOST) || scene->light.ambient > ZS_Q16_ONE ||
        scene->light.diffuse > ZS_Q16_ONE)
        return ZS_ERR_RANGE;
    if ((scene->sky && !scene->sky->fill) || (scene->n_resolves && !scene->resolve))
        return ZS_ERR_NULL;
    for (uint32_t k = 0; k < scene->n_resolves; k++)
        if (!scene->resolve[k].draw)
            return ZS_ERR_NULL;
    *reach = 1;
    for (uint32_t i = 0; i < scene->n_instances; i++) {
        struct zs_bounds b;
        int err = instance_check(r, &scene->instance[i]);
        if (!err)
            err = zs_cull_bounds(&b, r, &scene->instance[i]);
        if (err)
            return err;
        if (!zs_cull_sphere(&b, &r->camera, &r->view) && *reach < b.reach + b.slack)
            *reach = b.reach + b.slack;
    }
    return ZS_OK;
}

ZS_RARE int zs_frame_check(struct zs_renderer *r, const struct zs_scene *scene)
{
    const struct zs_camera *camera = &r->camera;
    int64_t reach;
    int err = zs_view_camera(&r->view, &r->config, camera);
    err = err ? err : scene_check(r, scene, &reach);
    err = err ? err : zs_view_units(&r->view, camera, reach);
    if (!err)
        err = r->view.depth->setup(&r->view, camera, r->config.depth_bits);
    return err;
}

ZS_RARE void zs_frame_open(struct zs_renderer *r)
{
    const struct zs_stats none = { 0 };
    if (r->passes || r->refit)
        accelerators(r);
    r->stats = none;
    r->strip = 0;
    r->band_end = 0; /* so the first strip starts a walk */
    r->counting = 1;
    r->large = 0;
    r->config.max_tris = (uint16_t)(r->config.max_tris + r->parts_tris);
    r->parts_tris = 0;
    zs_frame_forget_edges(r);
}

ZS_RARE int zs_frame_begin(struct zs_renderer *r, const struct zs_scene *scene,
                           const struct zs_camera *camera)
{
    if (!r)
        return ZS_ERR_NULL;
    r->scene = 0;
    if (!scene || !camera)
        return ZS_ERR_NULL;
    if (r->ready != 1)
        return ZS_ERR_SEQUENCE;
    zs_usual_camera(r, scene, camera);
    r->draw_end = r->n_strips;
    r->passes = 0;
    r->first = 0;
    r->n_instances = (uint16_t)scene->n_instances;
    zs_view_frame(&r->view, &r->config);
    const struct zs_track_ops *track = r->track;
    const int err = track ? track->check(r, scene) : zs_frame_check(r, scene);
    if (err)
        return err;
    zs_frame_open(r);
    r->scene = scene;
    return ZS_OK;
}

/* ---- Strips ---------------------------------------------------------------------------------- */

void zs_frame_resolve(const struct zs_renderer *r, const struct zs_scene *scene)
{
    const struct zs_resolve *hook = scene->resolve;
    struct zs_target target;
    if (!hook)
        return;
    target.color = r->color[0];
    target.depth = r->depth;
    target.y0 = (uint16_t)(r->strip * r->config.strip_h);
    target.y1 = (uint16_t)zs_min32(target.y0 + r->config.strip_h, r->config.height);
    target.x0 = r->window[0];
    target.x1 = r->window[1];
    target.pitch = r->config.width;
    for (uint32_t n = scene->n_resolves; n; n--, hook++)
        hook->draw(hook->ctx, &target);
}

int zs_frame_strip(struct zs_renderer *r, struct zs_strip *out)
{
    if (!r || !out)
        return ZS_ERR_NULL;
    if (r->ready != 1 || !r->scene)
        return ZS_ERR_SEQUENCE;
    if (r->strip == r->n_strips)
        return 0;
    const struct zs_track_ops *track = r->track;
    const int draw = !track || track->due(r);
    if (draw) {
        const struct zs_pass_ops *passes = r->passes;
        if (passes)
            passes->begin(r);
        if (ZS_IF_FAST(r->touch))
            r->touch->begin(r);
        else
            zs_raster_clear_all(r);
        r->config.method->strip(r);
        if (ZS_IF_FAST(r->untouched))
            r->touch->end(r);
        if (passes)
            passes->end(r);
        else
            zs_frame_resolve(r, r->scene);
    }

    const uint32_t y0 = (uint32_t)r->strip * r->config.strip_h;
    const uint32_t left = r->config.height - y0;
    out->x = 0;
    out->y = (uint16_t)y0;
    out->w = r->config.width;
    out->h = (uint16_t)(left < r->config.strip_h ? left : r->config.strip_h);
    out->px = (const uint8_t *)r->color[0];
    out->n_bytes = (uint32_t)out->w * out->h * 2u;
    out->depth = r->depth;
    out->dirty_x = draw ? r->window[0] : 0u;
    out->dirty_w = draw ? (uint16_t)(r->window[1] - r->window[0]) : 0u;
    const struct zs_strip_hash_ops *strip_hash = r->strip_hash;
    if (strip_hash && draw)
        strip_hash->look(r, out);
    uint16_t *const given = r->color[0];
    r->color[0] = r->color[1];
    r->color[1] = given;
    r->strip++;
    r->stats.strips++;
    return 1;
}

int zs_frame_skip(struct zs_renderer *r)
{
    if (!r)
        return ZS_ERR_NULL;
    if (r->ready != 1 || !r->scene || r->track)
        return ZS_ERR_SEQUENCE;
    if (r->strip == r->n_strips)
        return 0;
    if (r->strip < r->band_end)
        zs_raster_leave(r);
    r->strip++;
    r->stats.strips++;
    r->stats.strips_skipped++;
    return 1;
}

int zs_frame_end(struct zs_renderer *r)
{
    if (!r)
        return ZS_ERR_NULL;
    if (r->ready != 1 || !r->scene)
        return ZS_ERR_SEQUENCE;
    r->scene = 0;
    return ZS_OK;
}

const struct zs_stats *zs_frame_stats(const struct zs_renderer *r)
{
    return &r->stats;
}

/* Wait for the strip that a sink is sending, if there is one. */
static int waited(const struct zs_sink *sink, int *sending)
{
    const int wait = *sending && sink->wait;
    *sending = 0;
    return wait ? sink->wait(sink->ctx) : ZS_OK;
}

int zs_frame_send(struct zs_renderer *r, const struct zs_sink *sink)
{
    struct zs_strip strip;
    int err = ZS_OK, sending = 0, more;
    do {
        if (r->config.buffers == 1)
            err = waited(sink, &sending);
        more = !err && zs_frame_strip(r, &strip) > 0;
        err = err ? err : waited(sink, &sending); /* two buffers: the strip before */
        if (more && !err && strip.dirty_w) {
            err = sink->submit(sink->ctx, &strip);
            sending = !err;
        }
    } while (more && !err);
    const struct zs_strip *const last = err ? &strip : 0; /* NULL: any strip may be missing */
    if (sink->end) {
        const int at_end = sink->end(sink->ctx);
        err = err ? err : at_end;
    }
    if (err && r->unsent)
        r->unsent(r, last);
    (void)zs_frame_end(r);
    return err;
}

int zs_render(struct zs_renderer *r, const struct zs_scene *scene, const struct zs_camera *camera,
              const struct zs_sink *sink)
{
    if (!sink || !sink->submit)
        return ZS_ERR_NULL;
    const int err = zs_frame_begin(r, scene, camera);
    return err ? err : zs_frame_send(r, sink);
}
