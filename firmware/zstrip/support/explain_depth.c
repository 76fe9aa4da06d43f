/* What spoils a picture though all of it is drawn: depth that does not tell surfaces apart, things
 * in the wrong order without depth memory, hooks that change nothing, or all.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/cold.h"
#include "core/depth.h"
#include "core/fx.h"
#include "core/method.h"
#include "core/view.h"
#include "support/explain.h"
#include "zs_damage.h"
#include "zs_overlay.h"
#include "zs_shader.h"

#define KEYS_FEW 16u  /* an instance of fewer keys from front to back shows its back in its front */
#define ORDER_MAX 64u /* instances whose order is looked at */
#define CUT_MAX 4u    /* instances that are drawn to see whether near or far cuts them */

/* ---- Keys ------------------------------------------------------------------------------------ */

/* The key at a distance, uq16_16. */
static uint32_t key_at(const struct zs_view *view, int64_t z)
{
    const int32_t units = zs_max32(zs_min32(zs_view_length(view, z), view->z_far), view->z_near);
    const int32_t lz = view->perspective ? zs_clz32((uint32_t)units) : 0;
    const uint32_t rcp = view->perspective ? zs_recip((uint32_t)units << lz) : 0u;
    const uint32_t d = view->depth->vertex(view, units, rcp, lz);
    return view->depth->key ? view->depth->key(view, d) : d;
}

/* The box of an instance, without what lies outside of half of it each way: on the screen, two
 * spheres overlap if these boxes do. */
static int inner_box(const struct zs_explainer *e, uint32_t i, struct zs_bounds *b,
                     struct zs_box *box)
{
    zs_explain_bounds(e, i, b);
    if (zs_cull_sphere(b, &e->r->camera, &e->r->view) || !zs_cull_box(e->r, b, box))
        return 0;
    const int32_t w = (box->x1 - box->x0) / 4, h = (box->y1 - box->y0) / 4;
    box->x0 += w;
    box->x1 -= w;
    box->y0 += h;
    box->y1 -= h;
    return 1;
}

static void say_keys(struct zs_explainer *e)
{
    const struct zs_view *const view = &e->r->view;
    for (uint32_t i = 0; i < e->scene->n_instances; i++) {
        struct zs_bounds b;
        struct zs_box box;
        if (!inner_box(e, i, &b, &box) || box.x1 - box.x0 < 8)
            continue;
        const uint32_t keys = (key_at(view, b.c[2] + b.r) - key_at(view, b.c[2] - b.r)) >> 16;
        if (keys >= KEYS_FEW)
            continue;
        ZS_SAY(e,
               view->perspective
                   ? "instance % has % depth keys from front to back, so its surfaces flicker: "
                     "raise near = $, lower far = $, or take zs_depth_float and depth_bits 16."
                   : "instance % has % depth keys from front to back, so its surfaces flicker: "
                     "raise near = $, lower far = $, or take depth_bits 16.",
               i, keys, e->r->camera.z_near, e->r->camera.z_far);
        return;
    }
}

/* ---- Near and far ---------------------------------------------------------------------------- */

/* Of instance i, which reaches beyond near or far, more is seen where these are farther out. */
static int say_cut(struct zs_explainer *e, uint32_t i, const struct zs_bounds *b,
                   const struct zs_camera *c)
{
    const struct zs_camera *const camera = e->camera;
    struct zs_camera wide = *c;
    struct zs_seen seen;
    const int64_t begins = b->c[2] - b->r, ends = b->c[2] + b->r;
    const int near = begins < c->z_near;
    if (!near)
        wide.z_far = ends + 65536;
    else
        wide.z_near = c->projection == ZS_PERSPECTIVE ? c->z_near / 8 : begins - 65536;
    zs_explain_draw(e, &e->scene->instance[i], 0, &seen);
    const uint32_t sum = seen.sum;
    e->camera = &wide;
    zs_explain_draw(e, &e->scene->instance[i], 0, &seen);
    e->camera = camera;
    if (seen.sum == sum || !seen.colored)
        return 0;
    ZS_PIECE(e, near ? "near = $ cuts instance %" : "far = $ cuts instance %",
             near ? c->z_near : c->z_far, i);
    ZS_SAY(e,
           near ? ", which begins $ before it: lower near."
                : ", which ends $ beyond it: raise far.",
           near ? c->z_near - begins : ends - c->z_far);
    return 1;
}

/* All that is in view reaches beyond near or far; or one instance does, that lies before the eye,
 * in a scene of which nothing is wholly beyond far, and that has no hooks, which might be fog:
 * there, far is no limit that was meant. The eye is not in it, as in a room or over a landscape. */
void zs_explain_cut(struct zs_explainer *e)
{
    const struct zs_camera own = e->r->camera, *const c = &own; /* of all draws but one */
    uint32_t whole = e->scene->n_resolves, tried = 0;
    struct zs_bounds b;
    for (uint32_t i = 0; i < e->scene->n_instances; i++) {
        zs_explain_bounds(e, i, &b);
        if (zs_explain_eye_inside(&b))
            return;
        if (b.c[2] - b.r > c->z_far)
            whole = 1;
    }
    for (uint32_t i = 0; whole && i < e->scene->n_instances; i++) {
        zs_explain_bounds(e, i, &b);
        if (!zs_cull_sphere(&b, c, &e->r->view) && b.c[2] - b.r >= c->z_near &&
            b.c[2] + b.r <= c->z_far)
            return;
    }
    for (uint32_t i = 0; i < e->scene->n_instances && tried < CUT_MAX; i++) {
        zs_explain_bounds(e, i, &b);
        if (zs_cull_sphere(&b, c, &e->r->view) || (!whole && b.c[2] < b.r) ||
            (b.c[2] - b.r >= c->z_near && b.c[2] + b.r <= c->z_far))
            continue;
        tried++;
        if (say_cut(e, i, &b, c))
            return;
    }
}

/* ---- Order ----------------------------------------------------------------------------------- */

/* Return 1 if instance k lies wholly behind i, and both overlap on the screen. */
static int behind(const struct zs_explainer *e, uint32_t i, uint32_t k)
{
    struct zs_bounds near_b, far_b;
    struct zs_box near_box, far_box;
    return inner_box(e, i, &near_b, &near_box) && inner_box(e, k, &far_b, &far_box) &&
           far_b.c[2] - far_b.r >= near_b.c[2] + near_b.r && near_box.x1 > far_box.x0 &&
           far_box.x1 > near_box.x0 && near_box.y1 > far_box.y0 && far_box.y1 > near_box.y0;
}

/* One that lies behind another, and is drawn after it: without depth memory, or behind a
 * transparent one, or one that is read-only, which write no keys. */
static void say_order(struct zs_explainer *e)
{
    const uint32_t n = zs_minu32(e->scene->n_instances, ORDER_MAX);
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t k = i + 1; k < n; k++) {
            const struct zs_instance *const in = e->scene->instance;
            const struct zs_depth_state *const state = in[i].depth_state;
            const int layer = in[i].material->shader->layer;
            if (e->r->depth &&
                ((!layer && !(state && state->read_only)) || in[k].material->shader->layer))
                continue;
            if (!behind(e, i, k))
                continue;
            ZS_SAY(e,
                   e->r->depth && layer
                       ? "instance % is behind instance %, which is transparent, and drawn over "
                         "it: list transparent ones last, or take zs_method_transparent."
                   : e->r->depth
                       ? "instance % is behind instance %, whose depth_state is read_only, and "
                         "drawn over it: list it before."
                       : "instance % is behind instance % and drawn over it: without depth "
                         "memory, list far ones first, or take ZS_RENDERER and a depth "
                         "mapping.",
                   k, i);
            return;
        }
}

/* A depth state that turns round what is before what: instance i is the nearer one. */
static int say_state(struct zs_explainer *e, uint32_t i, uint32_t k)
{
    const struct zs_view *const view = &e->r->view;
    const struct zs_depth_state *const near = e->scene->instance[i].depth_state;
    const struct zs_depth_state *const far = e->scene->instance[k].depth_state;
    struct zs_bounds a, b;
    if ((!near && !far) || !behind(e, i, k))
        return 0;
    if (far && far->func == ZS_DEPTH_ALWAYS && k > i) {
        ZS_SAY(e,
               "instance % is behind instance %, and drawn over it: its depth_state.func is "
               "ZS_DEPTH_ALWAYS; list it before, or take ZS_DEPTH_LESS.",
               k, i);
        return 1;
    }
    zs_explain_bounds(e, i, &a);
    zs_explain_bounds(e, k, &b);
    const int64_t gap = (int64_t)(key_at(view, b.c[2]) >> 16) - (key_at(view, a.c[2]) >> 16);
    const int64_t shift = (near ? near->bias : 0) - (far ? far->bias : 0);
    if (shift <= gap || shift < (int64_t)KEYS_FEW)
        return 0;
    ZS_SAY(e,
           "instance % is behind instance %, and drawn over it: % depth keys lie between them, and "
           "their depth_state.bias differs by %.",
           k, i, gap, shift);
    return 1;
}

static void say_states(struct zs_explainer *e)
{
    const uint32_t n = zs_minu32(e->scene->n_instances, ORDER_MAX);
    for (uint32_t i = 0; i < n * n; i++)
        if (say_state(e, i / n, i % n))
            return;
}

void zs_explain_depth(struct zs_explainer *e)
{
    const struct zs_config *const c = &e->r->config;
    if (c->method == &zs_method_buffer)
        say_order(e);
    if (e->r->depth) {
        say_states(e);
        say_keys(e);
    }
}

/* ---- Hooks ----------------------------------------------------------------------------------- */

/* What a hook does to the strips of a frame. */
struct effect {
    uint32_t hook;
    uint16_t before, after; /* the first colours of what was drawn, in memory's order */
    uint8_t some;           /* 1: these are known */
    uint8_t varied;         /* 1: what was drawn had more than one colour */
    uint8_t one;            /* 1: behind the hook it has not */
    uint8_t changes;        /* 1: it changes a pixel, of this frame or of another one */
};

static uint32_t hash_of(const struct zs_target *t)
{
    const uint32_t n = (uint32_t)(t->y1 - t->y0) * t->pitch;
    uint32_t sum = 0;
    for (uint32_t i = 0; i < n; i++)
        sum = (sum ^ t->color[i]) * 16777619u;
    return sum;
}

/* Look at what was drawn, before or behind the hook. */
static void compare(struct effect *f, const struct zs_target *t, int behind)
{
    const uint32_t n = (uint32_t)(t->y1 - t->y0) * t->pitch;
    for (uint32_t i = 0; t->depth && i < n; i++) {
        if (t->depth[i] == ZS_DEPTH_CLEAR)
            continue;
        if (!f->some) {
            f->before = t->color[i];
            f->some = 1;
        } else if (!behind) {
            f->varied |= t->color[i] != f->before;
        }
        if (behind && f->one == 2) {
            f->after = t->color[i];
            f->one = 1;
        } else if (behind && t->color[i] != f->after) {
            f->one = 0;
        }
    }
}

/* Call the hook for a strip that is all of one colour and key. */
static void try_plain(const struct zs_resolve *hook, struct effect *f, struct zs_target *t,
                      uint16_t *keys, uint16_t key, uint16_t color)
{
    const uint32_t n = (uint32_t)(t->y1 - t->y0) * t->pitch;
    for (uint32_t i = 0; i < n; i++) {
        t->color[i] = color;
        if (keys)
            keys[i] = key;
    }
    const uint32_t sum = hash_of(t);
    hook->draw(hook->ctx, t);
    f->changes |= hash_of(t) != sum;
}

static void strip_of(struct zs_explainer *e, const struct zs_strip *strip, struct effect *f)
{
    struct zs_renderer *const r = e->r;
    const struct zs_resolve *const hook = &e->scene->resolve[f->hook];
    struct zs_target t = { .color = r->color[1],
                           .depth = strip->depth,
                           .y0 = strip->y,
                           .y1 = (uint16_t)(strip->y + strip->h),
                           .x1 = strip->w,
                           .pitch = strip->w };
    const uint32_t sum = hash_of(&t);
    compare(f, &t, 0);
    hook->draw(hook->ctx, &t);
    f->changes |= hash_of(&t) != sum;
    compare(f, &t, 1);
    for (int k = 0; k < 4 && !f->changes; k++) /* nothing, or all of it at the farthest key */
        try_plain(hook, f, &t, r->depth, k & 1 ? ZS_DEPTH_CLEAR : ZS_DEPTH_CLEAR - 1u,
                  k & 2 ? 0xffffu : 0);
}

void zs_explain_hooks(struct zs_explainer *e)
{
    struct zs_scene scene = *e->scene;
    scene.n_resolves = 0;
    scene.resolve = 0;
    for (uint32_t k = 0; k < e->scene->n_resolves; k++) {
        struct effect f = { .hook = k, .one = 2 };
        struct zs_strip strip;
        (void)zs_frame_begin(e->r, &scene, e->camera);
        while (zs_frame_strip(e->r, &strip) == 1)
            strip_of(e, &strip, &f);
        (void)zs_frame_end(e->r);
        if (!f.changes)
            ZS_SAY(e,
                   "resolve hook % changes no pixel: what it draws is beside the picture, "
                   "hidden, or not set up.",
                   k);
        else if (e->scene->resolve[k].draw == zs_overlay_draw)
            zs_explain_items(e, k);
        else if (f.varied && f.one == 1)
            ZS_SAY(e,
                   "resolve hook % gives all that is drawn one colour: fog that ends before it, "
                   "or whose zs_fog_set returned an error?",
                   k);
    }
}
