/* A model as the prebuilt show of the Pico takes it (firmware/app/show_model.h): its scene's structs and arrays, one
 * after another, with the addresses that they have in flash. Structs of this machine are those of the Pico, which has
 * pointers as wide. What the show itself holds, shaders and the like, is left as a name, whose address the page knows.
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdlib.h>
#include <string.h>

#include "answer.h"
#include "demo_frame.h"
#include "engine.h"
#include "fnv1a.h"
#include "shader_table.h"
#include "show_model.h"
#include "sim.h"
#include "zs_blend.h"
#include "zs_filter.h"
#include "zs_fog.h"
#include "zs_lights.h"
#include "zs_method.h"
#include "zs_shadow.h"

#define SIDE 240    /* px, of the show's panel, each way */
#define RATE 24     /* frames of the animation a second */
#define LEAST_ROWS 8
#define HOLDS_MAX 4096
#define NAMES_MAX 8192
#define VARIANTS_MAX 256

struct image {
    uint8_t *byte;
    uint32_t n, room;
    struct {
        const void *of;
        uint32_t bytes, at;
    } held[HOLDS_MAX], made[HOLDS_MAX]; /* arrays that lie there; structs of the instances in hand */
    struct {
        uint32_t at;
        const char *name, *effect;
    } name[NAMES_MAX]; /* words that become addresses of the show's */
    struct {
        uint64_t of; /* a hash of what views may change in them */
        uint32_t at;
    } variant[VARIANTS_MAX]; /* of the instances */
    uint32_t n_held, n_made, n_names, n_variants;
    struct show_view view;   /* of the frame in hand ... */
    uint32_t instances;      /* ... and where its instances lie */
    struct zs_config config; /* of the first */
};

static uint32_t room_for(struct image *im, uint32_t bytes)
{
    const uint32_t at = (im->n + 7u) & ~7u;
    if (at + bytes > im->room) {
        const uint32_t room = 2u * (at + bytes) + 4096u;
        im->byte = sim_grow(im->byte, room, 1);
        memset(im->byte + im->room, 0, room - im->room);
        im->room = room;
    }
    im->n = at + bytes;
    return at;
}

/* Where bytes lie, put there now unless the same ones have been; 0: there are none. */
static uint32_t put(struct image *im, const void *of, size_t bytes)
{
    if (of == NULL || bytes == 0)
        return 0;
    for (uint32_t i = 0; i < im->n_held; i++)
        if (im->held[i].of == of && im->held[i].bytes == bytes && memcmp(im->byte + im->held[i].at, of, bytes) == 0)
            return im->held[i].at;
    const uint32_t at = room_for(im, (uint32_t)bytes);
    memcpy(im->byte + at, of, bytes);
    if (im->n_held < HOLDS_MAX) {
        im->held[im->n_held].of = of;
        im->held[im->n_held].bytes = (uint32_t)bytes;
        im->held[im->n_held++].at = at;
    }
    return at;
}

/* Was this struct put there for the instances in hand? *at: where; else it is put there now, for the caller to fill. */
static int is_made(struct image *im, const void *of, size_t bytes, uint32_t *at)
{
    for (uint32_t i = 0; i < im->n_made; i++)
        if (im->made[i].of == of) {
            *at = im->made[i].at;
            return 1;
        }
    *at = room_for(im, (uint32_t)bytes);
    memcpy(im->byte + *at, of, bytes);
    if (im->n_made < HOLDS_MAX) {
        im->made[im->n_made].of = of;
        im->made[im->n_made++].at = *at;
    }
    return 0;
}

/* A word: the address of what lies at `to`; 0: NULL. */
static void point(struct image *im, uint32_t at, uint32_t to)
{
    const uint32_t address = to != 0 ? SHOW_MODEL + to : 0u;
    memcpy(im->byte + at, &address, sizeof address);
}

static int name(struct image *im, uint32_t at, const char *what, const char *effect)
{
    if (im->n_names == NAMES_MAX)
        return sim_refuse(web.name, 0, "has too many parts for the prebuilt show; make a project with zsim new");
    im->name[im->n_names].at = at;
    im->name[im->n_names].name = what;
    im->name[im->n_names++].effect = effect;
    return SIM_OK;
}

#define FIELD(base, type, field) ((base) + (uint32_t)offsetof(type, field))

/* ---- Textures, meshes, materials ---------------------------------------------------------------- */

static int put_texture(struct image *im, const struct zs_texture *t, uint32_t *at)
{
    const struct {
        const struct zs_texel *format;
        const char *name;
        uint32_t bits;
    } formats[] = { { &zs_texel_565, "zs_texel_565", 16 },   { &zs_texel_pal8, "zs_texel_pal8", 8 },
                    { &zs_texel_pal4, "zs_texel_pal4", 4 },  { &zs_texel_4444, "zs_texel_4444", 16 },
                    { &zs_texel_pal8a, "zs_texel_pal8a", 8 }, { &zs_texel_pal4a, "zs_texel_pal4a", 4 } };
    size_t k = 0, bits = 0;
    while (k < sizeof formats / sizeof formats[0] && formats[k].format != t->format)
        k++;
    if (k == sizeof formats / sizeof formats[0])
        return sim_refuse(web.name, 0, "has texels that the prebuilt show does not know");
    for (uint32_t level = 0; level < (t->n_levels > 1 ? t->n_levels : 1u); level++)
        bits += (size_t)formats[k].bits << (t->log2_w + t->log2_h - 2u * level);
    if (is_made(im, t, sizeof *t, at))
        return SIM_OK;
    point(im, FIELD(*at, struct zs_texture, texel), put(im, t->texel, (bits + 7u) / 8u));
    point(im, FIELD(*at, struct zs_texture, palette), put(im, t->palette, 2u * (size_t)t->n_colors));
    return name(im, FIELD(*at, struct zs_texture, format), formats[k].name, NULL);
}

static uint32_t put_mesh(struct image *im, const struct zs_mesh *m)
{
    uint32_t at;
    if (is_made(im, m, sizeof *m, &at))
        return at;
#define ARRAY(field, n) point(im, FIELD(at, struct zs_mesh, field), put(im, m->field, sizeof *m->field * (size_t)(n)))
    ARRAY(pos, m->n_verts);
    ARRAY(pos_lo, m->n_verts);
    ARRAY(tri, m->n_tris);
    ARRAY(normal, m->n_verts);
    ARRAY(face_normal, m->n_tris);
    ARRAY(vertex_rgb, m->n_verts);
    ARRAY(face_rgb, m->n_tris);
    ARRAY(face_raw, m->n_tris);
    ARRAY(uv, m->n_verts);
    ARRAY(cluster, m->n_clusters);
#undef ARRAY
    point(im, FIELD(at, struct zs_mesh, bvh), 0); /* of zs_method_raycast alone */
    return at;
}

static void put_lit(struct image *im, uint32_t at, const struct zs_lit_material *m)
{
    const struct zs_lighting *l = m->lighting;
    uint32_t lighting;
    if (!is_made(im, l, sizeof *l, &lighting))
        point(im, FIELD(lighting, struct zs_lighting, lamp), put(im, l->lamp, sizeof *l->lamp * l->n_lamps));
    point(im, FIELD(at, struct zs_lit_material, lighting), lighting);
    point(im, FIELD(at, struct zs_lit_material, shine), put(im, m->shine, m->shine != NULL ? sizeof *m->shine : 0));
}

static void put_shadowed(struct image *im, uint32_t at, const struct zs_shadow_map *map)
{
    uint32_t to;
    if (!is_made(im, map, sizeof *map, &to))
        point(im, FIELD(to, struct zs_shadow_map, key), put(im, map->key, sizeof *map->key * map->w * map->h));
    point(im, FIELD(at, struct zs_shadowed_material, map), to);
}

static int put_material(struct image *im, const struct zs_material *m, uint32_t *at)
{
    const struct sim_shader_row *row = sim_shader_row_of(m->shader);
    uint32_t texture = 0;
    int status = SIM_OK;
    if (m->primitive != NULL)
        return sim_refuse(web.name, 0, "lines and points are not in the prebuilt show; leave --style solid");
    if (row == NULL || row->material == SIM_MATERIAL_SHADOWED_LIT ||
        row->material == SIM_MATERIAL_SHADOWED_PHONG)
        return sim_refuse(web.name, 0, "this shading is not in the prebuilt show; make a project with zsim new");
    if (is_made(im, m, sim_shader_material_bytes(row->material), at))
        return SIM_OK;
    if (m->texture != NULL)
        status = put_texture(im, m->texture, &texture);
    point(im, FIELD(*at, struct zs_material, texture), texture);
    if (row->material == SIM_MATERIAL_LIT)
        put_lit(im, *at, (const struct zs_lit_material *)(const void *)m);
    if (row->material == SIM_MATERIAL_SHADOWED)
        put_shadowed(im, *at, ((const struct zs_shadowed_material *)(const void *)m)->map);
    return status == SIM_OK ? name(im, FIELD(*at, struct zs_material, shader), row->name, row->effect) : status;
}

/* ---- A scene ------------------------------------------------------------------------------------ */

static int can_take(const struct sim_drawn_scene *d)
{
    const struct zs_config *c = &d->config;
    if (web.scene != NULL && sim_demo_piece(web.scene) != NULL)
        return sim_refuse(web.name, 0, "has effects and an image of its own: make firmware BOARD=pico SCENE=%s",
                          web.name);
    if (d->samples > 1)
        return sim_refuse(web.name, 0, "four samples a pixel are not in the prebuilt show; leave --samples 1");
    if (d->passes > 1)
        return sim_refuse(web.name, 0, "a mirror is not in the prebuilt show, nor is fog behind what is transparent; "
                                       "leave --mirror out, or --fog");
    for (uint32_t i = 0; i < d->scene->n_resolves; i++)
        if (d->scene->resolve[i].draw != zs_fog_draw)
            return sim_refuse(web.name, 0, "dithering is not in the prebuilt show; leave --dither out");
    if (c->width != SIDE || c->height != SIDE ||
        (web.chosen.panel.name != NULL && strcmp(web.chosen.panel.name, "st7789:240x240") != 0))
        return sim_refuse(web.name, 0, "the prebuilt show drives an ST7789 of %dx%d; choose that panel", SIDE, SIDE);
    if (web.chosen.panel.turns != 0)
        return sim_refuse(web.name, 0, "the prebuilt show does not turn its panel; leave --rotate 0");
    if (c->method != NULL && c->method != &zs_method_transparent)
        return sim_refuse(web.name, 0, "the prebuilt show has the depth buffer alone; leave --method zbuffer");
    if ((c->subpixel_bits != 0 && c->subpixel_bits != 8) || (c->depth_bits != 0 && c->depth_bits != 16))
        return sim_refuse(web.name, 0, "the prebuilt show has 8 sub-pixel bits and 16 bits of depth; choose those");
    return SIM_OK;
}

/* What views change in instances: poses, scales, where lamps are, shadows on the floor. */
static uint64_t hash_instances(const struct zs_scene *s)
{
    uint64_t h = 14695981039346656037u;
    for (uint32_t i = 0; i < s->n_instances; i++) {
        const struct zs_instance *in = &s->instance[i];
        const struct sim_shader_row *row = sim_shader_row_of(in->material->shader);
        h = fnv1a(h, &in->pose, sizeof in->pose);
        h = fnv1a(h, &in->mesh->scale, sizeof in->mesh->scale);
        if (in->material->shader == &zs_shade_shadow)
            h = fnv1a(h, in->mesh->pos, sizeof *in->mesh->pos * in->mesh->n_verts);
        if (row != NULL && row->material == SIM_MATERIAL_LIT) {
            const struct zs_lighting *l = ((const struct zs_lit_material *)(const void *)in->material)->lighting;
            h = fnv1a(h, l->lamp, sizeof *l->lamp * l->n_lamps);
        }
    }
    return h;
}

static int put_instances(struct image *im, const struct zs_scene *s)
{
    const uint64_t of = hash_instances(s);
    int status = SIM_OK;
    for (uint32_t i = 0; i < im->n_variants; i++)
        if (im->variant[i].of == of) {
            im->instances = im->variant[i].at;
            return SIM_OK;
        }
    if (im->n_variants == VARIANTS_MAX)
        return SIM_REFUSED;
    const uint32_t bytes = (uint32_t)(sizeof *s->instance * s->n_instances);
    im->n_made = 0;
    im->instances = room_for(im, bytes);
    memcpy(im->byte + im->instances, s->instance, bytes);
    for (uint32_t i = 0; status == SIM_OK && i < s->n_instances; i++) {
        const uint32_t at = im->instances + i * (uint32_t)sizeof *s->instance;
        const struct zs_depth_state *state = s->instance[i].depth_state;
        uint32_t material = 0;
        status = put_material(im, s->instance[i].material, &material);
        point(im, FIELD(at, struct zs_instance, mesh), put_mesh(im, s->instance[i].mesh));
        point(im, FIELD(at, struct zs_instance, material), material);
        point(im, FIELD(at, struct zs_instance, depth_state), put(im, state, state != NULL ? sizeof *state : 0));
    }
    im->variant[im->n_variants].of = of;
    im->variant[im->n_variants++].at = im->instances;
    return status;
}

/* A frame: its instances, unless others have the same, and its view. */
static int put_view(void *ctx, const struct sim_drawn_scene *d)
{
    struct image *im = ctx;
    const int status = put_instances(im, d->scene);
    im->view = (struct show_view){ .camera = *d->camera, .light = d->scene->light };
    return status;
}

/* Hooks: fog, whose values hold for all views. */
static int put_fog(struct image *im, const struct zs_scene *s)
{
    int status = SIM_OK;
    const uint32_t hooks = put(im, s->resolve, sizeof *s->resolve * s->n_resolves);
    point(im, (uint32_t)offsetof(struct show_model, scene.resolve), hooks);
    for (uint32_t i = 0; status == SIM_OK && i < s->n_resolves; i++) {
        const uint32_t at = hooks + i * (uint32_t)sizeof *s->resolve;
        point(im, FIELD(at, struct zs_resolve, changes), 0);
        point(im, FIELD(at, struct zs_resolve, ctx), put(im, s->resolve[i].ctx, sizeof(struct zs_fog)));
        status = name(im, FIELD(at, struct zs_resolve, draw), "zs_fog_draw", "fog");
    }
    return status;
}

/* The first frame: its scene and configuration as well. */
static int put_scene(void *ctx, const struct sim_drawn_scene *d)
{
    struct image *im = ctx;
    const int status = can_take(d);
    if (status != SIM_OK)
        return status;
    (void)room_for(im, sizeof(struct show_model));
    memcpy(im->byte + offsetof(struct show_model, scene), d->scene, sizeof *d->scene);
    point(im, (uint32_t)offsetof(struct show_model, scene.instance), 0); /* struct show_view has them */
    im->config = d->config;
    const int put_ok = put_fog(im, d->scene);
    return put_ok == SIM_OK ? put_view(ctx, d) : put_ok;
}

/* ---- The show ----------------------------------------------------------------------------------- */

static uint16_t least(uint32_t n, uint32_t least_of)
{
    return (uint16_t)(n < least_of ? least_of : n);
}

/* Pools that take the frame in one pass; fewer rows, then smaller ones, where the show's arena is too small. Return 1
 * if it was. */
static int fit(struct zs_config *c, uint32_t arena)
{
    const struct zs_stats *s = &web.drawn.frame.stats;
    const int own_tris = web.chosen.tris > 0, own_verts = web.chosen.verts > 0;
    c->buffers = 2;
    c->strip_h = c->strip_h < c->height ? c->strip_h : c->height;
    if (!own_tris)
        c->max_tris = least(s->max_tris_used + s->max_tris_used / 8u, 16);
    if (!own_verts)
        c->max_verts = least(s->max_verts_used + s->max_verts_used / 8u, 48);
    if (zs_arena_bytes(c) <= arena)
        return 0;
    while (zs_arena_bytes(c) > arena) {
        const uint32_t strips = ZS_COLOR_BYTES(c->width, c->strip_h, 2) + ZS_DEPTH_BYTES(c->width, c->strip_h);
        if (strips > arena / 2u && c->strip_h > LEAST_ROWS)
            c->strip_h--;
        else {
            c->max_tris = least(c->max_tris * 31u / 32u, 16);
            c->max_verts = least(c->max_verts * 31u / 32u, 48);
        }
        if (c->max_tris == 16 && c->max_verts == 48 && c->strip_h <= LEAST_ROWS)
            break;
    }
    return 1;
}

static int put_show(struct image *im, uint32_t frames, uint32_t views)
{
    const struct zs_config *c = &im->config;
    struct show_model *m = (struct show_model *)(void *)im->byte;
    const char *const depth = c->depth == &zs_depth_recip    ? "zs_depth_recip"
                              : c->depth == &zs_depth_linear ? "zs_depth_linear"
                                                             : "zs_depth_float";
    m->magic = SHOW_MODEL_MAGIC;
    m->show.rate = RATE;
    m->show.rows = c->strip_h;
    m->show.tris = c->max_tris;
    m->show.verts = c->max_verts;
    m->show.varyings = c->varyings;
    m->show.arena_bytes = zs_arena_bytes(c);
    m->piece.demo.width = m->piece.demo.height = SIDE;
    m->piece.demo.frames = (uint16_t)frames;
    m->piece.demo.varyings = c->varyings;
    const uint32_t text = room_for(im, 8);
    memcpy(im->byte + text, "model", 6);
    point(im, (uint32_t)offsetof(struct show_model, piece.demo.name), text);
    point(im, (uint32_t)offsetof(struct show_model, show.demo), (uint32_t)offsetof(struct show_model, piece));
    point(im, (uint32_t)offsetof(struct show_model, view), views);
    int status = name(im, (uint32_t)offsetof(struct show_model, show.arena), "show_model_arena", NULL);
    if (status == SIM_OK)
        status = name(im, (uint32_t)offsetof(struct show_model, piece.demo.depth), depth, NULL);
    if (status == SIM_OK)
        status = name(im, (uint32_t)offsetof(struct show_model, piece.demo.fast), "show_model_fast", NULL);
    if (status == SIM_OK)
        status = name(im, (uint32_t)offsetof(struct show_model, piece.demo.pose), "show_model_pose", NULL);
    if (status == SIM_OK && c->method != NULL)
        status = name(im, (uint32_t)offsetof(struct show_model, piece.method), "zs_method_transparent", "transparency");
    return status;
}

static int put_all(struct image *im, uint32_t frames, uint32_t arena, int *shrunk)
{
    const struct sim_orbit stands = web.orbit;
    int (*const seen)(int (*use)(void *ctx, const struct sim_drawn_scene *drawn), void *ctx) =
        web.scene != NULL ? web_scene_scene : web_model_scene;
    int status = seen(put_scene, im);
    if (status != SIM_OK)
        return status;
    const uint32_t views = room_for(im, frames * (uint32_t)sizeof(struct show_view));
    for (uint32_t n = 0; status == SIM_OK && n < frames; n++) {
        const uint32_t at = views + n * (uint32_t)sizeof(struct show_view);
        web.orbit.yaw = stands.yaw + 6.283185307179586 * n / frames;
        status = n > 0 ? seen(put_view, im) : SIM_OK;
        memcpy(im->byte + at, &im->view, sizeof im->view);
        point(im, FIELD(at, struct show_view, instance), im->instances);
    }
    web.orbit = stands;
    if (status != SIM_OK)
        return status;
    *shrunk = fit(&im->config, arena);
    return zs_arena_bytes(&im->config) <= arena
               ? put_show(im, frames, views)
               : sim_refuse(web.name, 0, "does not fit the show's %u bytes of RAM", (unsigned)arena);
}

/* The model, or a still of the scene, as it is drawn now, in so many frames that go once round it, for a show with so
 * much arena and flash.
 * {"at": where its bytes are, "bytes": how many, "names": [[place, name, effect], ...], ...}. NULL: it is refused. */
WEB_EXPORT(flash) const char *web_flash(uint32_t frames, uint32_t arena, uint32_t flash)
{
    static struct image im;
    int shrunk = 0;
    free(im.byte);
    memset(&im, 0, sizeof im);
    if (web.name == NULL || put_all(&im, frames, arena, &shrunk) != SIM_OK)
        return NULL;
    if (im.n > flash) {
        (void)sim_refuse(web.name, 0, "takes %u bytes of flash, and the prebuilt show leaves it %u; simplify it first",
                         (unsigned)im.n, (unsigned)flash);
        return NULL;
    }
    const struct show_model *m = (const struct show_model *)(const void *)im.byte;
    FILE *f = answer_begin();
    (void)fprintf(f,
                  "{\"at\":%u,\"bytes\":%u,\"base\":%u,\"frames\":%u,\"rows\":%u,\"tris\":%u,\"verts\":%u,"
                  "\"shrunk\":%s,\"names\":[",
                  (unsigned)(uintptr_t)im.byte, (unsigned)im.n, SHOW_MODEL, m->piece.demo.frames, m->show.rows,
                  m->show.tris, m->show.verts, shrunk ? "true" : "false");
    for (uint32_t i = 0; i < im.n_names; i++)
        (void)fprintf(f, "%s[%u,\"%s\",\"%s\"]", i > 0 ? "," : "", (unsigned)im.name[i].at, im.name[i].name,
                      im.name[i].effect != NULL ? im.name[i].effect : "");
    (void)fputs("]}", f);
    return answer_end();
}
