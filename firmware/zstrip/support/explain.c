/* What is wrong with a picture: the walk through what can be, the worst first; and frames that are
 * drawn to be looked at.
 *
 * A frame is drawn again over a background of a colour that is not a usual one, so that its pixels
 * tell what was drawn on, whatever the shaders are. Where nothing is seen, each instance is drawn
 * alone, without accelerators: the statistics are then its own, and say of each triangle why it is
 * not seen.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/bin.h"
#include "core/cold.h"
#include "core/damage.h"
#include "core/fast.h"
#include "core/fx.h"
#include "core/method.h"
#include "core/walk.h"
#include "support/explain.h"
#include "zs_damage.h"
#include "zs_shader.h"

#define UNUSUAL 0x5a4bu    /* RGB565, the background while pixels are looked at */
#define PASSES_MANY 8u     /* a frame in more passes than this is slow */
#define PIXELS_MANY 16384u /* a frame of more pixels, or ... */
#define TRIS_MANY 1000u    /* ... triangles, gains much from accelerators */
#define COLUMNS_MAX 32u    /* of zs_damage_compare */

/* ---- Frames that are looked at --------------------------------------------------------------- */

/* Look at a strip, and spoil it: what the next one shows, it has drawn itself. */
static void look(const struct zs_explainer *e, const struct zs_strip *strip, uint16_t *first,
                 struct zs_seen *seen)
{
    uint16_t *const px = e->r->color[1]; /* the one given out */
    const uint32_t n = (uint32_t)strip->w * strip->h;
    if (strip->y == 0)
        *first = zs_wire16(px[0]);
    for (uint32_t i = 0; i < n; i++) {
        const uint16_t c = zs_wire16(px[i]);
        px[i] = (uint16_t)~UNUSUAL;
        if (c == UNUSUAL) {
            seen->uniform = 0;
            continue;
        }
        const uint32_t red = c >> 11, green = c >> 6 & 31u, blue = c & 31u;
        const uint32_t most = zs_maxu32(zs_maxu32(red, green), blue);
        seen->brightest = (uint8_t)zs_maxu32(seen->brightest, most);
        seen->colored++;
        seen->visible += c != e->scene->background;
        seen->uniform &= c == *first;
        seen->sum = (seen->sum ^ c ^ i << 16) * 16777619u;
    }
}

void zs_explain_draw(struct zs_explainer *e, const struct zs_instance *one,
                     const struct zs_light *light, struct zs_seen *seen)
{
    const struct zs_seen none = { .uniform = 1 };
    struct zs_renderer *const r = e->r;
    const struct zs_fast *const *const fast = r->config.fast;
    struct zs_scene scene = *e->scene;
    struct zs_strip strip;
    uint16_t first = 0;
    scene.background = UNUSUAL;
    scene.sky = 0;
    scene.n_resolves = 0;
    scene.resolve = 0;
    if (light)
        scene.light = *light;
    if (one) {
        scene.instance = one;
        scene.n_instances = 1;
        r->config.fast = 0;
        r->refit = 1;
    }
    *seen = none;
    if (!zs_frame_begin(r, &scene, e->camera))
        while (zs_frame_strip(r, &strip) == 1)
            look(e, &strip, &first, seen);
    (void)zs_frame_end(r);
    seen->stats = r->stats;
    r->config.fast = fast;
    r->refit = 1; /* the next frame chooses its accelerators anew */
}

/* ---- Too large ------------------------------------------------------------------------------- */

/* All pixels have one colour: who gave it? */
static void say_filled(struct zs_explainer *e)
{
    const uint32_t most = zs_maxu32(e->r->config.width, e->r->config.height);
    for (uint32_t i = e->scene->n_instances; i-- > 0;) {
        struct zs_seen seen;
        struct zs_bounds b;
        zs_explain_draw(e, &e->scene->instance[i], 0, &seen);
        zs_explain_bounds(e, i, &b);
        if (!seen.uniform || zs_explain_size(e, &b) >> 17 < most)
            continue; /* less than twice the frame across: made for it */
        ZS_SAY(e,
               "instance % fills the picture with one colour: it is $ across, its centre $ "
               "ahead; lower its scale, or move the camera away.",
               i, 2 * b.r, b.c[2]);
        return;
    }
}

/* ---- Slow ------------------------------------------------------------------------------------ */

/* What pools have to hold for one walk over a frame. */
struct need {
    uint64_t tris, verts;
    uint32_t most; /* vertices of a mesh that are looked up by their numbers */
};

/* Empty the pools, and count what was in them beside vertices of meshes. */
static void count_full(struct zs_renderer *r)
{
    struct need *const n = r->method_state;
    n->tris += r->n_tris;
    for (uint32_t v = 0; v < r->n_verts; v++)
        n->verts += r->vert_src[v] == ZS_NO_SOURCE; /* a clipped polygon's, or a line's */
    zs_bin_empty(r);
}

static void count_strip(struct zs_renderer *r)
{
    zs_walk(r, 1);
    count_full(r);
}

/* Bins all of a frame as if it were one strip, and draws nothing. */
static const struct zs_method counting = { .strip = count_strip, .full = count_full };

/* Of a frame that zs_frame_begin accepts. */
static ZS_NOINLINE void count_need(struct zs_explainer *e, struct need *n)
{
    struct zs_renderer *const r = e->r;
    const struct zs_method *const method = r->config.method;
    const uint32_t strip_mul = r->strip_mul;
    struct zs_scene scene = *e->scene;
    struct zs_bounds b;
    struct zs_strip strip;
    scene.n_resolves = 0;
    r->refit = 1;
    (void)zs_frame_begin(r, &scene, e->camera);
    /* looks no vertex up in pools that hold all; meshes of few triangles may do without it */
    const int batch = r->batch != 0;
    r->batch = 0;
    r->clusters_hooks = 0;
    r->tiles = 0;
    for (uint32_t i = 0; i < scene.n_instances; i++) {
        const struct zs_instance *const in = &scene.instance[i];
        if (zs_cull_walk(&b, r, i))
            continue;
        n->verts += in->mesh->n_verts;
        if (!batch || in->material->primitive || in->material->shader->place ||
            in->mesh->n_tris <= 64u)
            n->most = zs_maxu32(n->most, in->mesh->n_verts);
    }
    r->config.method = &counting;
    r->method_state = n;
    r->strip_mul = 0; /* all rows are strip 0's */
    (void)zs_frame_strip(r, &strip);
    (void)zs_frame_end(r);
    r->config.method = method;
    r->method_state = 0;
    r->strip_mul = strip_mul;
    r->refit = 1;
}

/* Say which pool is too small, and what one pass takes. */
static void say_passes(struct zs_explainer *e, const struct zs_stats *s)
{
    const struct zs_config *c = &e->r->config;
    struct need n = { 0, 0, 0 };
    count_need(e, &n);
    if (c->method->records)
        n.tris = n.tris * 5u / 2u + 64u;
    /* numbers that share an entry of the map would be transformed again and again */
    if (n.verts <= ZS_POOL_MAX && zs_bin_mask((uint32_t)n.verts) + 1u < n.most)
        n.verts = 2u * (zs_bin_mask(n.most - 1u) + 1u);
    ZS_PIECE(e, "the frame takes % passes; ", s->passes);
    if (n.tris > ZS_POOL_MAX || n.verts > ZS_POOL_MAX) {
        ZS_SAY(e, "pools of % do not hold it in one: larger ones take fewer.", ZS_POOL_MAX);
        return;
    }
    ZS_PIECE(e, "one needs");
    if (n.tris > c->max_tris)
        ZS_PIECE(e, " max_tris % (it is %)", (int64_t)n.tris, c->max_tris);
    if (n.verts > c->max_verts)
        ZS_PIECE(e, " max_verts % (it is %)", (int64_t)n.verts, c->max_verts);
    ZS_SAY(e, ".");
}

/* The promise that accelerators change nothing rests on what a shader says of itself. */
static void say_accelerated(struct zs_explainer *e, const struct zs_seen *all)
{
    struct zs_renderer *const r = e->r;
    const struct zs_fast *const *const fast = r->config.fast;
    struct zs_seen plain;
    if (ZS_NO_FAST || !fast || e->said)
        return;
    r->config.fast = 0;
    r->refit = 1;
    zs_explain_draw(e, 0, 0, &plain);
    r->config.fast = fast;
    if (plain.sum != all->sum)
        ZS_SAY(e, "without accelerators it is another picture: a shader that leaves pixels out, or "
                  "reads the old colour, has .opaque 0.");
}

/* Columns of a strip whose hashes are not those that the panel has: what was sent is not what is
 * drawn now. */
static ZS_NOINLINE uint32_t stale(struct zs_renderer *r, const struct zs_strip_hash_ops *hashes,
                                  struct zs_strip *strip)
{
    uint64_t *const sum = r->sums->sum + strip->y / r->config.strip_h * r->sums->columns;
    uint64_t was[COLUMNS_MAX];
    uint32_t n = 0;
    for (uint32_t k = 0; k < r->sums->columns; k++)
        was[k] = sum[k];
    hashes->look(r, strip);
    for (uint32_t k = 0; k < r->sums->columns; k++) {
        n += was[k] != 0 && was[k] != sum[k];
        sum[k] = was[k];
    }
    return n;
}

/* Under zs_damage_track: the panel shows another picture than the scene's. */
static void say_stale(struct zs_explainer *e, const struct zs_strip_hash_ops *hashes)
{
    struct zs_renderer *const r = e->r;
    struct zs_strip strip;
    uint32_t n = 0;
    if (!e->tracked || !hashes || r->sums->columns > COLUMNS_MAX)
        return;
    (void)zs_frame_begin(r, e->scene, e->camera);
    while (zs_frame_strip(r, &strip) == 1)
        n += stale(r, hashes, &strip) != 0;
    (void)zs_frame_end(r);
    if (n)
        ZS_SAY(e,
               "the panel shows another picture, in % strips: bytes have changed that "
               "zs_damage_track does not look at; call zs_invalidate after it.",
               n);
}

static void say_slow(struct zs_explainer *e, const struct zs_seen *all)
{
    const struct zs_stats *const s = &all->stats;
    const struct zs_config *const c = &e->r->config;
    const uint64_t small = (uint64_t)s->tris_empty + s->tris_zero;
    if (s->passes > PASSES_MANY)
        say_passes(e, s);
    if (ZS_IF_FAST(1) && !c->fast && (all->colored > PIXELS_MANY || s->tris_in > TRIS_MANY))
        ZS_SAY(e, "config.fast is NULL: accelerators (zs_fast.h) draw the same frame in less "
                  "time.");
    if (c->strip_h < 4 && c->height > 16)
        ZS_SAY(e, "strips of % rows are slow: 16 take % bytes more.", c->strip_h,
               (c->buffers + (e->r->depth ? 1u : 0u)) * 2u * c->width * (16u - c->strip_h));
    if (e->r->view.pixelwise)
        ZS_SAY(e, "the depth mapping computes each pixel's key by itself for a perspective camera: "
                  "zs_depth_float is faster.");
    if (small > 1000u && small / 3u > s->tris_drawn)
        ZS_SAY(e, "% triangles in view are smaller than a pixel: take a mesh of fewer.",
               (int64_t)small);
}

/* ---- All of it ------------------------------------------------------------------------------- */

/* What a frame that is drawn between two others must not change: zs_damage_track compares with it.
 */
struct kept {
    struct zs_stats stats;
    struct zs_view view;
    const struct zs_strip_hash_ops *strip_hash;
    const struct zs_track_ops *track;
    uint16_t window[2];
};

/* Return 1 if the renderer can be asked. */
static int usable(struct zs_explainer *e)
{
    struct zs_renderer *const r = e->r;
    if (!r)
        ZS_SAY(e, "the renderer is NULL.");
    else if (r->ready != 1)
        ZS_SAY(e, "the renderer is not set up: look at what zs_init returned; zs_explain_init says "
                  "why.");
    else if (r->scene)
        ZS_SAY(e, "a frame is open: ask after zs_render or zs_frame_end.");
    return e->said == 0;
}

static void keep(struct zs_explainer *e, struct kept *kept)
{
    struct zs_renderer *const r = e->r;
    kept->stats = r->stats;
    kept->view = r->view;
    kept->strip_hash = r->strip_hash;
    kept->track = r->track;
    kept->window[0] = r->window[0];
    kept->window[1] = r->window[1];
    e->tracked = r->track != 0;
    r->strip_hash = 0;
    r->track = 0;
    r->window[0] = 0;
    r->window[1] = r->config.width;
}

static void restore(struct zs_explainer *e, const struct kept *kept)
{
    struct zs_renderer *const r = e->r;
    r->stats = kept->stats;
    r->view = kept->view;
    r->strip_hash = kept->strip_hash;
    r->track = kept->track;
    r->window[0] = kept->window[0];
    r->window[1] = kept->window[1];
}

/* 0.5 / tan(1/2 degree) is 57.3: a focal length of that many heights sees one degree. */
static void say_narrow(struct zs_explainer *e)
{
    const struct zs_camera *c = &e->r->camera;
    const uint64_t heights = (c->focal >> 32) / e->r->config.height;
    if (c->projection == ZS_PERSPECTIVE && heights > 57u)
        ZS_SAY(e, "the camera sees less than one degree: was ZS_DEGREES meant for its angle?");
}

/* Of a frame in which nothing is seen. Not inlined: what is seen of one takes stack. */
static ZS_NOINLINE void say_unseen(struct zs_explainer *e)
{
    struct zs_seen one;
    for (uint32_t i = 0; i < e->scene->n_instances && e->said < ZS_EXPLAIN_MOST / 2u; i++)
        (void)zs_explain_unseen(e, i, &one);
}

/* The scene is one that zs_frame_begin accepts. */
static void say_all(struct zs_explainer *e, const struct kept *kept)
{
    const struct zs_stats *const last = &kept->stats;
    const struct zs_scene *const scene = e->scene;
    struct zs_seen all;
    if (last->strips && last->strips < e->r->n_strips)
        ZS_SAY(e,
               "the last frame ended after % of % strips: a function of the sink returned an "
               "error; it returns 0 for none.",
               last->strips, e->r->n_strips);
    if (scene->n_instances == 0 && !scene->sky && !scene->n_resolves)
        ZS_SAY(e, "the scene has no instance: n_instances is 0.");
    if (scene->resolve && !scene->n_resolves)
        ZS_SAY(e, "scene.resolve is given, and no hook is called: n_resolves is 0.");
    say_narrow(e);
    zs_explain_camera_turned(e);
    zs_explain_draw(e, 0, 0, &all);
    const int light = zs_explain_light(e, &all);
    const int seen = (scene->sky ? all.colored : all.visible) != 0;
    if (!seen)
        say_unseen(e);
    if (seen && all.uniform)
        say_filled(e);
    if (!light)
        zs_explain_dark(e, &all);
    for (uint32_t i = 0; i < scene->n_instances; i++)
        zs_explain_instance_data(e, i, seen, &all);
    zs_explain_draw(e, 0, 0, &all); /* the view is that of all instances again */
    if (seen)
        zs_explain_cut(e);
    zs_explain_draw(e, 0, 0, &all);
    zs_explain_depth(e);
    zs_explain_hooks(e);
    say_accelerated(e, &all);
    say_stale(e, kept->strip_hash);
    say_slow(e, &all);
}

static void say_one(struct zs_explainer *e, uint32_t i)
{
    struct zs_seen seen;
    const int unseen = zs_explain_fate(e, i, &seen);
    zs_explain_instance_data(e, i, !unseen, &seen);
}

/* number: of an instance; UINT32_MAX: all. */
static uint32_t explain(struct zs_explainer *e, uint32_t number)
{
    struct kept kept;
    if (!usable(e))
        return e->said;
    keep(e, &kept);
    const int err = zs_frame_begin(e->r, e->scene, e->camera);
    (void)zs_frame_end(e->r);
    if (err)
        zs_explain_refused(e);
    else if (kept.track && e->scene->n_instances > e->r->track_instances)
        ZS_SAY(e, "zs_damage_track has memory for % instances, and n_instances is %.",
               e->r->track_instances, e->scene->n_instances);
    else if (number == UINT32_MAX)
        say_all(e, &kept);
    else if (number < e->scene->n_instances)
        say_one(e, number);
    else
        ZS_SAY(e, "there is no instance %: n_instances is %.", number, e->scene->n_instances);
    restore(e, &kept);
    return e->said;
}

uint32_t zs_explain_instance(struct zs_renderer *r, const struct zs_scene *scene,
                             const struct zs_camera *camera, uint32_t number,
                             void (*say)(void *ctx, const char *text), void *ctx)
{
    struct zs_explainer e = { r, scene, camera, say, ctx, 0, 0, { 0 }, 0 };
    return explain(&e, number);
}

uint32_t zs_explain(struct zs_renderer *r, const struct zs_scene *scene,
                    const struct zs_camera *camera, void (*say)(void *ctx, const char *text),
                    void *ctx)
{
    return zs_explain_instance(r, scene, camera, UINT32_MAX, say, ctx);
}
