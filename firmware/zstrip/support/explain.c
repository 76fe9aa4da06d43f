/* What is wrong with a picture: the walk through what can be, the worst first; sentences; frames
 * that are drawn to be looked at.
 *
 * A frame is drawn again over a background of a colour that is not a usual one, so that its pixels
 * tell what was drawn on, whatever the shaders are. Where nothing is seen, each instance is drawn
 * alone, without accelerators: the statistics are then its own, and say of each triangle why it is
 * not seen.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/cold.h"
#include "core/fast.h"
#include "core/fx.h"
#include "core/method.h"
#include "support/explain.h"

#define UNUSUAL 0x5a4bu    /* RGB565, the background while pixels are looked at */
#define PASSES_MANY 8u     /* a frame in more passes than this is slow */
#define PIXELS_MANY 16384u /* a frame of more pixels, or ... */
#define TRIS_MANY 1000u    /* ... triangles, gains much from accelerators */
#define DIM 9u             /* levels, of 32, of a channel of 5 bits that was taken for one of 8 */
#define WEAK 4096u         /* light, uq16_16, that leaves a picture dark */
#define PIECES 6u          /* triangles that clipping can add to one */
#define CORNERS 9u         /* vertices of those */

/* ---- Sentences ------------------------------------------------------------------------------- */

static void flush(struct zs_explainer *e)
{
    e->text[e->n] = 0;
    e->say(e->ctx, e->text);
    e->n = 0;
}

static void put(struct zs_explainer *e, char c)
{
    e->text[e->n++] = c;
    if (e->n == ZS_EXPLAIN_PIECE - 1u)
        flush(e);
}

static void put_number(struct zs_explainer *e, int64_t v)
{
    char digit[20];
    int n = 0;
    uint64_t rest = v < 0 ? 0u - (uint64_t)v : (uint64_t)v;
    if (v < 0)
        put(e, '-');
    do {
        digit[n++] = (char)('0' + rest % 10u);
        rest /= 10u;
    } while (rest);
    while (n)
        put(e, digit[--n]);
}

/* A length in world units: three decimals below 10, none above. Any v: a refused camera may hold
 * anything. */
static void put_length(struct zs_explainer *e, zs_q48_16 v)
{
    const uint64_t size = v < 0 ? 0u - (uint64_t)v : (uint64_t)v;
    const int small = size < 10 * 65536;
    const uint32_t thousandths = small ? (uint32_t)((size * 1000u + 32768u) >> 16) : 0;
    if (v < 0)
        put(e, '-');
    put_number(e, (int64_t)(small ? thousandths / 1000u : (size + 32768u) >> 16));
    uint32_t rest = thousandths % 1000u;
    if (rest)
        put(e, '.');
    for (uint32_t unit = 100; rest; rest %= unit, unit /= 10u)
        put(e, (char)('0' + rest / unit));
}

void zs_explain_piece(struct zs_explainer *e, const char *form, const int64_t *number)
{
    for (; *form && e->said < ZS_EXPLAIN_MOST; form++) {
        if (*form == '%')
            put_number(e, *number++);
        else if (*form == '$')
            put_length(e, *number++);
        else
            put(e, *form);
    }
}

void zs_explain_say(struct zs_explainer *e, const char *form, const int64_t *number)
{
    if (e->said == ZS_EXPLAIN_MOST)
        return;
    zs_explain_piece(e, form, number);
    put(e, '\n');
    if (e->n)
        flush(e);
    e->said++;
}

/* ---- Frames that are looked at --------------------------------------------------------------- */

static void look(const struct zs_explainer *e, const struct zs_strip *strip, uint16_t *first,
                 struct zs_seen *seen)
{
    const uint16_t *px = (const uint16_t *)(const void *)strip->px;
    const uint32_t n = (uint32_t)strip->w * strip->h;
    if (strip->y == 0)
        *first = zs_wire16(px[0]);
    for (uint32_t i = 0; i < n; i++) {
        const uint16_t c = zs_wire16(px[i]);
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

/* ---- Light ----------------------------------------------------------------------------------- */

/* Return 1 if a mesh has colours of its own, not all of them black. */
static int colored(const struct zs_mesh *m)
{
    uint32_t sum = 0;
    for (uint32_t k = 0; m->vertex_rgb && k < m->n_verts; k++)
        sum |= m->vertex_rgb[k].r | m->vertex_rgb[k].g | m->vertex_rgb[k].b;
    for (uint32_t k = 0; k < m->n_tris; k++)
        sum |= (m->face_raw ? m->face_raw[k] : 0u) |
               (m->face_rgb ? m->face_rgb[k].r | m->face_rgb[k].g | m->face_rgb[k].b : 0u);
    return sum != 0;
}

/* The instances whose material has the colour that it has when none is given. */
static void say_black(struct zs_explainer *e)
{
    for (uint32_t i = 0; i < e->scene->n_instances; i++) {
        const struct zs_material *m = e->scene->instance[i].material;
        const struct zs_mesh *mesh = e->scene->instance[i].mesh;
        const int own = mesh->vertex_rgb || mesh->face_rgb || mesh->face_raw;
        if ((m->rgb.r | m->rgb.g | m->rgb.b) || m->texture || (own && !colored(mesh)))
            continue;
        ZS_SAY(e,
               own ? "instance % is black: its material's rgb is 0, and of its mesh, zs_shade_raw "
                     "reads face_raw alone, zs_shade_flat face_rgb, zs_shade_smooth vertex_rgb."
                   : "instance % is black: its material's rgb is 0; give it a colour.",
               i);
        return;
    }
    ZS_SAY(e, "all that is drawn is black: colours, texture or lamps are (of a lamp, look at "
              "strength: 1 is ZS_Q16_ONE; at range, half and dir; scene.light is none).");
}

/* Little is seen: are all materials' colours those of 5, 6 and 5 bits? */
static void say_dim(struct zs_explainer *e)
{
    for (uint32_t i = 0; i < e->scene->n_instances; i++) {
        const struct zs_material *m = e->scene->instance[i].material;
        const struct zs_mesh *mesh = e->scene->instance[i].mesh;
        if (m->rgb.r > 31 || m->rgb.g > 63 || m->rgb.b > 31 || m->texture || mesh->vertex_rgb ||
            mesh->face_rgb || mesh->face_raw)
            return;
    }
    ZS_SAY(e, "all colours are dark: a channel of material.rgb has 8 bits, 255 is full; "
              "ZS_RGB(0xffc040) sets it.");
}

/* Return 1 if a light is what zs_light says of darkness. */
static int meant_dark(const struct zs_light *light)
{
    return light->ambient == 1 && light->diffuse == 0;
}

static int light_given(const struct zs_light *light)
{
    return (light->dir[0] | light->dir[1] | light->dir[2]) != 0 ||
           (light->ambient | light->diffuse) != 0;
}

/* Say that diffuse light falls on nothing that is seen, where the opposite light does; of a picture
 * that is as dark as ambient light leaves it. */
static void say_behind(struct zs_explainer *e, const struct zs_seen *all)
{
    struct zs_light light = e->scene->light;
    const uint32_t sum = all->sum;
    struct zs_seen seen;
    if (light.ambient > ZS_Q16_ONE / 2u || all->brightest > (light.ambient * 31u >> 16) + 1u)
        return;
    light.diffuse = 0;
    zs_explain_draw(e, 0, &light, &seen);
    if (seen.sum != sum)
        return;
    light.diffuse = e->scene->light.diffuse;
    for (int k = 0; k < 3; k++)
        light.dir[k] = -light.dir[k];
    zs_explain_draw(e, 0, &light, &seen);
    if (seen.sum != sum)
        ZS_SAY(e, "the light falls on nothing that is seen: its dir points from the surface "
                  "towards the light.");
}

/* The fields of the light. Return 1 if something was said. */
static int say_light(struct zs_explainer *e, const struct zs_seen *all)
{
    const struct zs_light *const light = &e->scene->light, usual = { .ambient = 0 };
    const uint32_t before = e->said;
    uint64_t square = 0; /* < 3 * 2^60.1 */
    struct zs_seen seen;
    for (int k = 0; k < 3; k++)
        square += (uint64_t)((int64_t)light->dir[k] * light->dir[k]);
    const uint32_t length = zs_isqrt64(square); /* q2_30 */
    if (light->diffuse && light->diffuse < 256u)
        ZS_SAY(e, "the light's diffuse is %/65536: was ZS_Q16_ONE meant?", light->diffuse);
    if (light->ambient > 1u && light->ambient < 256u && light->diffuse < 256u)
        ZS_SAY(e, "the light's ambient is %/65536: was ZS_Q16_ONE meant?", light->ambient);
    if (light->diffuse && (length >> 26 == 0 || length >> 26 > 16))
        ZS_SAY(e, "the light's dir has length $, and 1 is ZS_Q30_ONE: zs_unit makes it that long.",
               length >> 14);
    if (!(light->ambient | light->diffuse)) {
        zs_explain_draw(e, 0, &usual, &seen);
        if (seen.sum != all->sum)
            ZS_SAY(e, "the light's ambient and diffuse are 0: give one, or all fields 0 for the "
                      "usual light.");
    }
    if (light->ambient == ZS_Q16_ONE && light->diffuse)
        ZS_SAY(e, "the light's ambient is full, so diffuse adds nothing, and shapes are not seen: "
                  "1/4 and 3/4 are usual.");
    else if (e->said == before && light->ambient && light->diffuse)
        say_behind(e, all);
    return e->said != before;
}

static void say_dark(struct zs_explainer *e, const struct zs_seen *all)
{
    const struct zs_light *const light = &e->scene->light, usual = { .ambient = 0 };
    const int given = light_given(light);
    struct zs_seen seen;
    if (all->colored == 0 || (given && meant_dark(light)))
        return;
    if (all->brightest > 1) {
        if (all->brightest < DIM)
            say_dim(e);
        return;
    }
    zs_explain_draw(e, 0, &usual, &seen);
    if (given && seen.brightest > 1 && light->ambient < WEAK && light->diffuse < WEAK)
        ZS_SAY(e, "the light's ambient is %/65536, its diffuse %/65536: 1 is ZS_Q16_ONE.",
               light->ambient, light->diffuse);
    else if (given && seen.brightest > 1)
        ZS_SAY(e, "all that is seen is dark: the light comes from behind it; dir points from the "
                  "surface towards the light.");
    else
        say_black(e);
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

/* Say which pool is too small, and what one pass takes. */
static void say_passes(struct zs_explainer *e, const struct zs_stats *s)
{
    const struct zs_config *c = &e->r->config;
    const uint64_t clipped = s->tris_clipped;
    const uint32_t max_tris = c->max_tris + e->r->parts_tris; /* of the pool (fast/parts.c) */
    uint64_t verts = CORNERS * clipped, tris = s->tris_drawn + PIECES * clipped;
    for (uint32_t i = 0; i < e->scene->n_instances; i++) {
        struct zs_bounds b;
        zs_explain_bounds(e, i, &b);
        if (!zs_cull_sphere(&b, &e->r->camera, &e->r->view))
            verts += e->scene->instance[i].mesh->n_verts;
    }
    ZS_PIECE(e, "the frame takes % passes; one needs", s->passes);
    if (tris > max_tris)
        ZS_PIECE(e, " max_tris % (it is %)", (int64_t)(tris < ZS_POOL_MAX ? tris : ZS_POOL_MAX),
                 max_tris);
    if (verts > c->max_verts)
        ZS_PIECE(e, " max_verts % (it is %)", (int64_t)(verts < ZS_POOL_MAX ? verts : ZS_POOL_MAX),
                 c->max_verts);
    ZS_SAY(e, tris > max_tris || verts > c->max_verts ? "." : " larger pools.");
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
    const struct zs_strip_hash_kernel *strip_hash;
    const struct zs_track_kernel *track;
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

/* The scene is one that zs_frame_begin accepts. */
static void say_all(struct zs_explainer *e, const struct zs_stats *last)
{
    const struct zs_scene *const scene = e->scene;
    struct zs_seen all, one;
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
    const int lit = !light_given(&scene->light) || !say_light(e, &all);
    const int seen = (scene->sky ? all.colored : all.visible) != 0;
    for (uint32_t i = 0; !seen && i < scene->n_instances && e->said < ZS_EXPLAIN_MOST / 2u; i++)
        (void)zs_explain_unseen(e, i, &one);
    if (seen && all.uniform)
        say_filled(e);
    if (lit)
        say_dark(e, &all);
    for (uint32_t i = 0; i < scene->n_instances; i++)
        zs_explain_instance_data(e, i, seen);
    zs_explain_draw(e, 0, 0, &all); /* the view is that of all instances again */
    zs_explain_depth(e);
    zs_explain_hooks(e);
    say_slow(e, &all);
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
        say_all(e, &kept.stats);
    else if (number < e->scene->n_instances)
        zs_explain_fate(e, number);
    else
        ZS_SAY(e, "there is no instance %: n_instances is %.", number, e->scene->n_instances);
    restore(e, &kept);
    return e->said;
}

uint32_t zs_explain_instance(struct zs_renderer *r, const struct zs_scene *scene,
                             const struct zs_camera *camera, uint32_t number,
                             void (*say)(void *ctx, const char *text), void *ctx)
{
    struct zs_explainer e = { r, scene, camera, say, ctx, 0, 0, { 0 } };
    return explain(&e, number);
}

uint32_t zs_explain(struct zs_renderer *r, const struct zs_scene *scene,
                    const struct zs_camera *camera, void (*say)(void *ctx, const char *text),
                    void *ctx)
{
    return zs_explain_instance(r, scene, camera, UINT32_MAX, say, ctx);
}
