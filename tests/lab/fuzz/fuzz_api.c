/* A seeded fuzzer of the whole public interface, for builds with the sanitizers and ZS_ASSERT.
 *
 *   fuzz_api SEED cases N       cases 1 .. N of a seed
 *   fuzz_api SEED seconds S     as many as fit
 *   fuzz_api SEED case K        one of them again, described
 *
 * A case depends on SEED and its number alone. What must hold, beside nothing being read or written out of
 * bounds, overflowed or asserted wrongly:
 *
 *   the same scene, camera and profile give the same picture and counts, or the same refusal, for any strips,
 *   pools, buffers and accelerators; an arena is exactly zs_arena_bytes() long; nothing that is const is written
 *   calls in any order are answered as zstrip.h says, a refused zs_init leaves arena and renderer as it says,
 *   each strip given out is that of the picture and stays as long as promised; sinks that fail are obeyed; a glass that
 *   gets changed columns alone (zs_damage_compare, zs_damage_track, zs_invalidate) shows the picture
 *   helpers that succeed give what a frame accepts, and that fail leave what they were given
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "fast_lists.h"
#include "core/method.h"
#include "effects.h"
#include "fnv1a.h"
#include "kinds.h"
#include "picture.h"
#include "replay.h"
#include "world.h"
#include "zs_pass.h"
#include "zs_check.h"
#include "zs_damage.h"

#define CASE_SECONDS 60 /* a case that takes longer hangs */

/* ---- Replaying -------------------------------------------------------------------------------- */

static struct {
    unsigned long long seed;
    int alone;
} now;

static void wrong(int line, const char *what)
{
    fprintf(stderr, "wrong: %s:%d: %s\n", __FILE__, line, what);
    replay_say();
    exit(1);
}

#define EXPECT(condition) \
    do { \
        if (!(condition)) \
            wrong(__LINE__, #condition); \
    } while (0)

/* ---- What was reached ------------------------------------------------------------------------- */

static struct {
    uint64_t frames, pixels, tris, clipped, passes, strips, unchanged, skipped, in_passes, refused[16];
    uint64_t depth[KINDS(kind_depths)][2]; /* [perspective] */
    uint64_t shader[KINDS(kind_shaders)], texel[KINDS(kind_texels)], state, cluster;
    uint64_t method[KINDS(kind_methods)], effect[EFFECT_KINDS], alpha[EFFECT_TEXELS], lines, points, hooks, mirrors,
        windows;
} reached;

static void count_refusal(int err)
{
    EXPECT(err <= 0 && err > -16);
    reached.refused[-err]++;
}

static void count_frame(const struct world *w, const struct zs_config *c, const struct picture *p)
{
    count_refusal(p->err);
    if (p->err || (p->covered == 0 && !(c->method && p->stats.tris_drawn)))
        return;
    EXPECT(c->method || (p->covered <= p->stats.pixels_written && p->stats.pixels_written <= p->stats.pixels_tested));
    for (int32_t i = 0; i < p->w * p->h; i++) /* keys saturate */
        EXPECT(p->key[i] == ZS_DEPTH_CLEAR || p->key[i] <= (1u << c->depth_bits) - 2u);
    for (size_t k = 0; k < KINDS(kind_methods); k++)
        reached.method[k] += c->method == kind_methods[k].method;
    for (uint32_t k = 0; k < w->scene.n_resolves; k++)
        reached.hooks += w->scene.resolve[k].draw != own_draw;
    reached.frames++;
    reached.pixels += p->covered;
    reached.tris += p->stats.tris_drawn;
    reached.clipped += p->stats.tris_clipped;
    for (size_t k = 0; k < KINDS(kind_depths); k++)
        reached.depth[k][w->camera.projection == ZS_PERSPECTIVE] += c->depth == kind_depths[k].depth;
    for (uint32_t i = 0; i < w->scene.n_instances; i++) {
        const struct zs_material *m = w->instance[i].material;
        if (!m || !w->instance[i].mesh)
            continue;
        const int effect = effects_of(m->shader);
        if (effect >= 0) {
            reached.effect[effect]++;
            reached.lines += m->primitive && m->primitive->ops == &zs_lines_ops;
            reached.points += m->primitive && m->primitive->ops == &zs_points_ops;
            for (size_t f = 0; f < EFFECT_TEXELS && kind_effects[effect].needs & EFFECT_TEXTURE; f++)
                reached.alpha[f] += m->texture && m->texture->format == kind_alpha_texels[f].format;
        }
        for (size_t k = 0; k < KINDS(kind_shaders); k++) {
            reached.shader[k] += m->shader == kind_shaders[k].shader;
            for (size_t f = 0; f < KINDS(kind_texels) && m->shader == kind_shaders[k].shader; f++)
                reached.texel[f] += kind_shaders[k].texture && m->texture /* none: the same */ &&
                                    m->texture->format == kind_texels[f].format;
        }
        reached.state += w->instance[i].depth_state != NULL;
        reached.cluster += w->instance[i].mesh->cluster != NULL;
    }
}

/* was: how often it was met. 1: it was; else its name is written. */
static int met(unsigned long long was, const char *kind, const char *name)
{
    if (!was)
        fprintf(stderr, "not reached: %s%s\n", kind, name);
    return was != 0;
}

/* Names what a long run never came to; 1: nothing. */
static int reached_all(void)
{
    static const int errors[] = { ZS_OK, ZS_ERR_NULL, ZS_ERR_SIZE, ZS_ERR_DEPTH, ZS_ERR_CAMERA, ZS_ERR_RANGE,
                                  ZS_ERR_MESH, ZS_ERR_VARYINGS, ZS_ERR_NEAR, ZS_ERR_TEXTURE };
    int all = reached.state && reached.cluster && reached.clipped && reached.passes && reached.unchanged &&
              reached.skipped && reached.in_passes && reached.lines && reached.points && reached.hooks &&
              reached.mirrors && reached.windows;
    for (size_t k = 0; k < KINDS(errors); k++)
        all &= met(reached.refused[-errors[k]], "", zs_error_string(errors[k]));
    for (size_t k = 0; k < KINDS(kind_depths); k++)
        all &= met(reached.depth[k][1] && (!kind_depths[k].any_camera || reached.depth[k][0]), "depth ",
                   kind_depths[k].name);
    for (size_t k = 0; k < KINDS(kind_shaders); k++)
        all &= met(reached.shader[k], "shader ", kind_shaders[k].name);
    for (size_t k = 0; k < KINDS(kind_texels); k++)
        all &= met(reached.texel[k], "texels ", kind_texels[k].name);
    for (size_t k = 0; k < KINDS(kind_methods); k++)
        all &= met(reached.method[k], "method ", kind_methods[k].name);
    for (size_t k = 0; k < EFFECT_KINDS; k++)
        all &= met(reached.effect[k], "effect ", kind_effects[k].name);
    for (size_t k = 0; k < EFFECT_TEXELS; k++)
        all &= met(reached.alpha[k], "texels ", kind_alpha_texels[k].name);
    return all;
}

/* ---- Configurations --------------------------------------------------------------------------- */

/* The part that a picture depends on; mostly a mapping that the camera takes. Every third by a method. */
static struct zs_config profile(struct prng *p, const struct zs_camera *camera)
{
    const struct kind_method *method = &kind_methods[one_in(p, 3) ? prng_pick(p, KINDS(kind_methods)) : 0];
    const struct kind_depth *depth = &kind_depths[prng_pick(p, KINDS(kind_depths))];
    while (camera->projection == ZS_ORTHOGRAPHIC && !depth->any_camera && !one_in(p, 20))
        depth = &kind_depths[prng_pick(p, KINDS(kind_depths))];
    struct zs_config c = picture_config(1 + (int32_t)prng_pick(p, 64), 1 + (int32_t)prng_pick(p, 64), depth->depth);
    c.max_tris = c.max_verts = 3000;
    c.varyings = ZS_VARYINGS_MAX;
    c.subpixel_bits = one_in(p, 4) ? 4 : 8;
    c.depth_bits = (uint8_t)(one_in(p, 2) ? 16 : prng_range(p, 8, 16));
    if (one_in(p, 16)) /* a long one */
        *(one_in(p, 2) ? &c.width : &c.height) = (uint16_t)(1 + prng_pick(p, 512));
    if (one_in(p, 64))
        *(one_in(p, 2) ? &c.width : &c.height) = ZS_SIZE_MAX;
    if (method->method) { /* few pixels: of small pools each may take a walk */
        c.width = (uint16_t)(1 + prng_pick(p, 24));
        c.height = (uint16_t)(1 + prng_pick(p, 16));
    }
    c.method = method->method;
    c.depth = method->depth ? method->depth : c.depth;
    c.strip_h = c.height;
    c.fast = NULL; /* the plainest way */
    return c;
}

/* Those of a list by bits, as fast_of takes them. */
static uint32_t bit_of(const char *name)
{
    for (unsigned k = 0; k < fast_count(); k++)
        if (strcmp(fast_name(k), name) == 0)
            return 1u << k;
    abort();
}

static uint32_t bits_of(const struct zs_fast *const *list)
{
    static const struct zs_fast *one[32];
    uint32_t bits = 0;
    for (unsigned k = 0; k < fast_count(); k++) {
        one[k] = one[k] ? one[k] : fast_of(1u << k)[0];
        for (const struct zs_fast *const *at = list; at && *at; at++)
            bits |= (uint32_t)(*at == one[k]) << k;
    }
    return bits;
}

/* Any accelerators, all or none. Where spheres and cones need not hold what they say, without those that ask them: what
 * is missing then depends on strips and pools. Static storage: the list of one way is gone in the next but seven. */
static const struct zs_fast *const *lists(struct prng *p, int trusted)
{
    uint32_t bits = one_in(p, 2) ? prng_next(p) : ~0u;
    if (one_in(p, 8))
        return NULL;
    if (one_in(p, 4))
        bits = ~(1u << prng_pick(p, fast_count()));
    if (!trusted)
        bits &= ~(bit_of("clusters") | bit_of("tiles"));
    return fast_of(bits);
}

/* 1: the world has many triangles. Methods then get pools in which a pixel does not take hundreds of walks. */
static int crowded;

/* How it is drawn. */
static struct zs_config way(struct prng *p, struct zs_config c, int trusted)
{
    static const uint16_t small[] = { 1, 2, 3, 4, 5, 7, 8, 11, 16, 23, 64, 200, 3000 };
    c.strip_h = one_in(p, 3) ? (uint16_t)(1 + prng_pick(p, 65535)) : (uint16_t)(1 + prng_pick(p, 12));
    if (c.strip_h < c.height / 64) /* not hours */
        c.strip_h = (uint16_t)(c.height / 64);
    c.max_tris = one_in(p, 4) ? (uint16_t)(1 + prng_pick(p, 100)) : small[prng_pick(p, KINDS(small))];
    c.max_verts = (uint16_t)(3 + small[prng_pick(p, KINDS(small))] - 1);
    c.buffers = (uint8_t)(1 + prng_pick(p, 2));
    c.fast = lists(p, trusted);
    const struct kind_method *method = method_of(&c);
    const uint16_t tris = crowded ? 1000 : method->least_tris, verts = crowded ? 1000 : method->least_verts;
    c.max_tris = c.method && c.max_tris < tris ? tris : c.max_tris;
    c.max_verts = c.method && c.max_verts < verts ? verts : c.max_verts;
    return c;
}

/* Every second world has effects. They are kept until the next. */
static struct effects effects;

static void dress(struct world *w, struct prng *p, const struct zs_config *c, uint32_t odd)
{
    uint32_t tris = 0;
    if (one_in(p, 2))
        EXPECT(world_effects(w, &effects, p, c, odd));
    for (uint32_t i = 0; i < w->n_instances; i++)
        tris += w->instance[i].mesh ? w->instance[i].mesh->n_tris : 0;
    crowded = tris > 100;
}

static void print_config(const struct zs_config *c)
{
    const char *depth = "no";
    for (size_t k = 0; k < KINDS(kind_depths); k++)
        if (kind_depths[k].depth == c->depth)
            depth = kind_depths[k].name;
    fprintf(stderr,
            "%s, %ux%u, strips of %u, %u triangles, %u vertices, %u attributes, %u buffers, %u "
            "sub-pixel bits, "
            "%u bits of %s, accelerators %#x\n",
            method_of(c)->name, c->width, c->height, c->strip_h, c->max_tris, c->max_verts, c->varyings, c->buffers,
            c->subpixel_bits, c->depth_bits, depth, bits_of(c->fast));
}

/* ---- The same picture every way ----------------------------------------------------------------- */

static int same_counts(const struct zs_stats *a, const struct zs_stats *b)
{
    return a->tris_in == b->tris_in && a->tris_drawn == b->tris_drawn && a->tris_cluster == b->tris_cluster &&
           a->tris_frustum == b->tris_frustum && a->tris_near == b->tris_near &&
           a->tris_far == b->tris_far && a->tris_offscreen == b->tris_offscreen &&
           a->tris_facing == b->tris_facing && a->tris_zero == b->tris_zero &&
           a->tris_empty == b->tris_empty && a->tris_index == b->tris_index &&
           a->tris_clipped == b->tris_clipped && a->instances_culled == b->instances_culled;
}

static void print_counts(const struct zs_stats *s)
{
    fprintf(stderr,
            "instances %u, culled %u; triangles in %u: drawn %u frustum %u near %u far %u "
            "offscreen %u facing %u "
            "zero %u empty %u index %u; clipped %u\n",
            s->instances_in, s->instances_culled, s->tris_in, s->tris_drawn, s->tris_frustum, s->tris_near,
            s->tris_far, s->tris_offscreen, s->tris_facing, s->tris_zero, s->tris_empty, s->tris_index,
            s->tris_clipped);
}

/* Pixels are counted alike but for those of hidden triangles, how many depends on the strips; plain, without
 * accelerators, draws these too. */
static void compare(const struct world *w, const struct picture *plain, const struct zs_config *c)
{
    struct picture p = picture_draw(c, &w->scene, &w->camera);
    if (p.err != plain->err || (!p.err && !picture_same(plain, &p, "fuzz_api"))) {
        print_config(c);
        fprintf(stderr, "%s, and plainly: %s\n", zs_error_string(p.err), zs_error_string(plain->err));
        wrong(__LINE__, "the same picture");
    }
    if (!p.err) {
        EXPECT(stats_add_up(&p.stats) && p.stats.tris_in == plain->stats.tris_in);
        EXPECT(p.stats.max_tris_used <= c->max_tris && p.stats.max_verts_used <= c->max_verts);
        reached.passes += p.stats.passes - 1u;
    }
    if (!p.err && !c->method) {
        EXPECT(p.stats.pixels_tested <= plain->stats.pixels_tested);
        EXPECT(p.stats.pixels_written <=
               p.stats.pixels_tested); /* a hidden triangle left out may let others write that lose to it */
        EXPECT(bits_of(c->fast) & bit_of("tiles") || (p.stats.pixels_tested == plain->stats.pixels_tested &&
                                                      p.stats.pixels_written == plain->stats.pixels_written));
        EXPECT(p.stats.tris_drawn == plain->stats.tris_drawn ||
               (p.stats.instances_hidden && p.stats.tris_drawn < plain->stats.tris_drawn));
        const int fewer = p.stats.clusters_culled ||
                          p.stats.instances_hidden; /* instances are then counted as culled */
        if (!fewer && !same_counts(&p.stats, &plain->stats)) {
            print_config(c);
            print_counts(&p.stats);
            print_counts(&plain->stats);
            wrong(__LINE__, "the same counts");
        }
    }
    picture_free(&p);
}

static void case_pictures(struct prng *p, uint32_t odd)
{
    struct world w;
    world_make(&w, p, odd);
    struct zs_config plain_config = profile(p, &w.camera);
    if (odd && one_in(p, odd))
        plain_config.varyings = (uint8_t)prng_pick(p, ZS_VARYINGS_MAX + 1);
    dress(&w, p, &plain_config, odd);
    if (now.alone) {
        world_print(&w);
        print_config(&plain_config);
    }
    const uint64_t before = world_sum(&w);
    for (int cameras = 0; cameras < 2; cameras++) {
        struct picture plain = picture_draw(&plain_config, &w.scene, &w.camera);
        if (now.alone)
            fprintf(stderr, "%s, %u pixels\n", zs_error_string(plain.err), plain.covered);
        count_frame(&w, &plain_config, &plain);
        EXPECT(plain.err || stats_add_up(&plain.stats));
        for (int n = plain.err ? 1 : 3; n > 0; n--) {
            const struct zs_config c = way(p, plain_config, w.trusted);
            compare(&w, &plain, &c);
        }
        if (!w.trusted) { /* whatever it shows */
            struct zs_config c = way(p, plain_config, 1);
            struct picture any = picture_draw(&c, &w.scene, &w.camera);
            picture_free(&any);
        }
        picture_free(&plain);
        if (cameras == 0) {
            EXPECT(before == world_sum(&w));
            world_camera(&w, p, odd);
        }
    }
    world_free(&w);
}

/* A mesh and pools of the largest counts, or as many instances as there may be. */
static void case_big(struct prng *p, uint32_t odd)
{
    struct world w;
    world_make(&w, p, odd);
    world_big(&w, p);
    struct zs_config c = profile(p, &w.camera);
    c.width = c.height = (uint16_t)(1 + prng_pick(p, 40));
    if (c.method) { /* to sort so many takes minutes */
        c.method = NULL;
        c.depth = &zs_depth_linear;
    }
    c.max_tris = c.max_verts = ZS_POOL_MAX;
    struct picture plain = picture_draw(&c, &w.scene, &w.camera);
    count_frame(&w, &c, &plain);
    c.max_tris = (uint16_t)(ZS_POOL_MAX - prng_pick(p, 60000));
    c.max_verts = (uint16_t)(ZS_POOL_MAX - prng_pick(p, 60000));
    c.strip_h = (uint16_t)(1 + prng_pick(p, 40));
    c.fast = lists(p, w.trusted);
    compare(&w, &plain, &c);
    picture_free(&plain);
    world_free(&w);
}

/* ---- Calls in any order --------------------------------------------------------------------------- */

#define CLOSED (-1)
#define DESK_PASSES 3

struct desk { /* a renderer and what it should be in */
    struct zs_renderer *r;
    struct zs_config config; /* with strip_h cut to the height */
    const struct zs_fast *fast[32]; /* config.fast, kept */
    uint8_t *arena;
    int ready, open;         /* open: the camera, or CLOSED */
    uint32_t given;          /* strips of the open frame, those left out too */
    uint32_t left_out;       /* of these: by zs_frame_skip */
    struct zs_strip last;    /* the one given out before, if last_whole */
    uint64_t last_sum;
    int last_whole;
    uint64_t *sum;           /* zs_damage_compare's; NULL: off */
    struct zs_strip_hashes sums;     /* of the panel, over it */
    uint32_t *memory;        /* zs_damage_track's; NULL: off */
    uint32_t room;           /* instances that it takes */
    int columns;             /* zs_damage_columns is on */
    uint16_t *glass;         /* [height][width]: what arrived of what was given out as changed */
    struct zs_pass pass[DESK_PASSES]; /* of the open frame, if it is in passes */
    struct zs_pass_memory pass_memory[DESK_PASSES];
    struct zs_mirror mirror[DESK_PASSES];
    struct zs_scene behind; /* of the passes but the last */
    int loose;              /* 1: zs_damage_track was given spheres that need not hold: whatever it shows */
};

struct room {
    struct world w;
    struct zs_config profile;
    struct zs_camera camera[2];
    struct picture picture[2]; /* by camera */
    struct desk desk[2];
    uint64_t sum;
};

/* The changed columns arrive; then the glass shows the strip's rows of the picture. */
static int glass_right(struct desk *d, const struct picture *p, const struct zs_strip *s)
{
    for (int32_t j = 0; j < s->h; j++)
        for (int32_t i = s->dirty_x; i < s->dirty_x + s->dirty_w; i++) {
            const uint8_t *px = s->px + 2 * (j * s->w + i);
            d->glass[(s->y + j) * p->w + i] = (uint16_t)(px[0] << 8 | px[1]);
        }
    return memcmp(d->glass + s->y * p->w, p->color + s->y * p->w, s->n_bytes) == 0;
}

/* 1: the strip is rows [y, y + h) of the picture; by columns: in those that are drawn for sure. */
static int strip_right(const struct picture *p, const struct zs_strip *s, int columns)
{
    const int32_t grain = (int32_t)ZS_DAMAGE_GRAIN, from = columns ? s->dirty_x / grain * grain : 0;
    const int32_t end = columns ? (s->dirty_x + s->dirty_w + grain - 1) / grain * grain : s->w;
    for (int32_t i = 0; i < s->w * s->h; i++) {
        const int32_t at = s->y * p->w + i;
        if (i % s->w < from || i % s->w >= end)
            continue;
        if ((s->px[2 * i] << 8 | s->px[2 * i + 1]) != p->color[at] || (s->depth && s->depth[i] != p->key[at]))
            return 0;
    }
    return 1;
}

static void strip_expect(const struct room *m, struct desk *d, const struct zs_strip *s)
{
    const struct zs_config *c = &d->config;
    const uint32_t y = d->given * c->strip_h, left = c->height - y;
    EXPECT(s->x == 0 && s->w == c->width && s->y == y);
    EXPECT(s->h == (left < c->strip_h ? left : c->strip_h));
    EXPECT(s->n_bytes == 2u * s->w * s->h);
    const int drawn = s->dirty_w || !d->memory;
    EXPECT(s->dirty_x + s->dirty_w <= s->w && (d->sum || d->columns || drawn == 0 || s->dirty_w == s->w));
    EXPECT((d->sum || d->memory || s->dirty_w == s->w) && (drawn || s->dirty_w == 0));
    EXPECT(!drawn || d->loose || strip_right(&m->picture[d->open], s, d->columns));
    EXPECT(glass_right(d, &m->picture[d->open], s) || d->loose);
    if (d->last_whole && c->buffers == 2) /* the one before is still whole */
        EXPECT(fnv1a(FNV1A_BASIS, d->last.px, d->last.n_bytes) == d->last_sum);
    d->last = *s;
    d->last_sum = fnv1a(FNV1A_BASIS, s->px, s->n_bytes);
    d->last_whole = drawn;
    d->given++;
    reached.strips++;
    reached.unchanged += !s->dirty_w;
}

static void no_memory(struct desk *d)
{
    free(d->sum);
    free(d->memory);
    d->sum = NULL;
    d->memory = NULL;
    d->columns = 0;
}

static void do_init(struct room *m, struct desk *d, struct prng *p)
{
    struct zs_config c = way(p, m->profile, m->w.trusted);
    for (uint32_t k = 0; c.fast && (k == 0 || d->fast[k - 1]); k++)
        d->fast[k] = c.fast[k];
    c.fast = c.fast ? d->fast : NULL;
    int want = ZS_OK;
    uint32_t bytes = zs_arena_bytes(&c), off = 0;
    EXPECT(bytes != 0);
    const uint32_t full = bytes;
    switch (prng_pick(p, 16)) {
    case 0: c.width = (uint16_t)(one_in(p, 2) ? 0 : ZS_SIZE_MAX + 1); want = ZS_ERR_SIZE; break;
    case 1: c.max_verts = (uint16_t)(one_in(p, 2) ? 2 : 65535); want = ZS_ERR_SIZE; break;
    case 2: c.depth_bits = (uint8_t)(one_in(p, 2) ? 7 : 17); want = ZS_ERR_DEPTH; break;
    case 3: c.depth = NULL; want = ZS_ERR_NULL; break;
    case 4: bytes -= 1 + prng_pick(p, full < 64 ? full : 64); want = ZS_ERR_ARENA; break;
    case 5: off = 1 + prng_pick(p, 3); want = ZS_ERR_ARENA; break;
    default: break;
    }
    uint8_t *arena = malloc(full + off + 4);
    for (uint32_t i = 0; i < full + off; i++)
        arena[i] = (uint8_t)prng_next(p);
    free(d->arena);
    d->arena = malloc(bytes + off ? bytes + off : 1);
    memcpy(d->arena, arena, bytes + off);
    const int got = zs_init(d->r, &c, d->arena + off, bytes);
    if (got != want)
        print_config(&c);
    EXPECT(got == want);
    if (want)
        EXPECT(memcmp(d->arena, arena, bytes + off) == 0);
    free(arena);
    d->config = c;
    if (d->config.strip_h > c.height)
        d->config.strip_h = c.height;
    d->ready = want == ZS_OK;
    d->open = CLOSED;
    no_memory(d); /* zs_init ends them */
}

/* What zs_frame_begin says of camera k. */
static int begin_answer(const struct room *m, const struct desk *d, int k)
{
    if (!d->ready)
        return ZS_ERR_SEQUENCE;
    return d->memory && m->w.scene.n_instances > d->room ? ZS_ERR_SIZE : m->picture[k].err;
}

static void do_begin(struct room *m, struct desk *d, struct prng *p)
{
    const int k = (int)prng_pick(p, 2);
    const struct zs_scene *scene = one_in(p, 12) ? NULL : &m->w.scene;
    const struct zs_camera *camera = one_in(p, 12) ? NULL : &m->camera[k];
    const int want = !scene || !camera ? ZS_ERR_NULL : begin_answer(m, d, k);
    EXPECT(zs_frame_begin(NULL, scene, camera) == ZS_ERR_NULL);
    const int said = zs_frame_begin(d->r, scene, camera);
    /* zs_damage_track looks at instances first: of two errors that one */
    EXPECT(said == want || (said < 0 && scene && d->memory && want));
    d->open = said ? CLOSED : k;
    d->given = d->left_out = 0;
    d->last_whole = 0;
    if (said == ZS_OK)
        EXPECT(zs_frame_stats(d->r)->strips == 0);
}

/* Has the scene hooks that zs_frame_begin refuses? */
static int broken_hooks(const struct zs_scene *scene)
{
    for (uint32_t k = 0; k < scene->n_resolves; k++)
        if (!scene->resolve || !scene->resolve[k].draw)
            return 1;
    return 0;
}

/* Let a pass that another one covers be seen in a mirror, or in windows of the one before it. */
static int strange_pass(struct zs_pass *pass, struct zs_mirror *mirror, struct prng *p, uint32_t i)
{
    const int32_t at[3] = { prng_range(p, -99, 99), 0, 0 },
                  normal[3] = { prng_range(p, -9, 9), 10, prng_range(p, -9, 9) };
    if (one_in(p, 3) && !zs_mirror_plane(mirror, at, normal))
        pass->mirror = mirror;
    if (i && one_in(p, 4))
        pass->mask = &zs_mask_window;
    return pass->mirror || pass->mask;
}

/* As do_begin, in passes that each fill the frame: the last one is what is seen. */
static void do_begin_passes(struct room *m, struct desk *d, struct prng *p)
{
    const uint32_t n = 1 + prng_pick(p, DESK_PASSES), total = n * m->w.scene.n_instances;
    int k = 0, want = d->ready && !d->memory ? ZS_OK : ZS_ERR_SEQUENCE, strange = 0;
    d->behind = m->w.scene;
    d->behind.resolve = NULL;
    d->behind.n_resolves = 0;
    for (uint32_t i = 0; i < n; i++) {
        k = (int)prng_pick(p, 2);
        d->pass[i] = (struct zs_pass){ .scene = i + 1u < n ? &d->behind : &m->w.scene, .camera = &m->camera[k] };
        d->pass[i].early = (uint8_t)prng_pick(p, 2);
        want = want ? want : m->picture[k].err;
        if (one_in(p, 2))
            d->pass[i].viewport = (struct zs_rect){ 0, 0, d->config.width, d->config.height };
        if (i + 1u < n)
            strange |= strange_pass(&d->pass[i], &d->mirror[i], p, i);
    }
    if (want == ZS_OK && d->config.method && !d->config.method->passes)
        want = ZS_ERR_PASS;
    if (want == ZS_OK && total > 65535u)
        want = ZS_ERR_SIZE;
    if (want == ZS_OK && one_in(p, 8)) {
        d->pass[prng_pick(p, n)].viewport = (struct zs_rect){ 1, 0, d->config.width, 1 };
        want = ZS_ERR_PASS;
    }
    const int said = zs_frame_begin_passes(d->r, d->pass, d->pass_memory, n);
    /* passes without hooks come first: where the hooks are broken, another error of the scene may be found there */
    EXPECT(said == want || (said == ZS_ERR_SIZE && want && total > 65535u) ||
           (said < 0 && want == ZS_ERR_NULL && n > 1 && broken_hooks(&m->w.scene)) ||
           (said < 0 && (strange || (want && d->config.method)))); /* of two errors either */
    reached.in_passes += !said;
    for (uint32_t i = 0; i < n && !said; i++) {
        reached.mirrors += d->pass[i].mirror != NULL;
        reached.windows += d->pass[i].mask != NULL;
    }
    d->open = said ? CLOSED : k;
    d->given = d->left_out = 0;
    d->last_whole = 0;
}

static void do_strip(struct room *m, struct desk *d)
{
    struct zs_strip s;
    EXPECT(zs_frame_strip(d->r, NULL) == ZS_ERR_NULL && zs_frame_strip(NULL, &s) == ZS_ERR_NULL);
    const int got = zs_frame_strip(d->r, &s);
    if (!d->ready || d->open == CLOSED) {
        EXPECT(got == ZS_ERR_SEQUENCE);
        return;
    }
    const uint32_t n = (d->config.height + d->config.strip_h - 1u) / d->config.strip_h;
    EXPECT(got == (d->given < n));
    if (got)
        strip_expect(m, d, &s);
    const struct zs_stats *counts = zs_frame_stats(d->r);
    EXPECT(counts->strips == d->given && (d->memory || counts->strips_skipped == d->left_out));
}

static void do_skip(struct desk *d)
{
    EXPECT(zs_frame_skip(NULL) == ZS_ERR_NULL);
    const int got = zs_frame_skip(d->r);
    if (!d->ready || d->open == CLOSED || d->memory) {
        EXPECT(got == ZS_ERR_SEQUENCE);
        return;
    }
    EXPECT(got == (d->given < ZS_STRIPS(d->config.height, d->config.strip_h)));
    d->given += got > 0;
    d->left_out += got > 0;
    d->last_whole = 0;
    reached.skipped += got > 0;
}

/* Junk in the caller's memory; sometimes off again. */
static void do_compare(struct desk *d, struct prng *p)
{
    const int open = !d->ready || d->open != CLOSED;
    const uint32_t n = open ? 1 : ZS_STRIPS(d->config.height, d->config.strip_h), w = open ? 9 : d->config.width;
    const int bad = one_in(p, 8), off = one_in(p, 4);
    const uint32_t columns = bad ? (one_in(p, 2) ? 0 : w + 1) : 1 + prng_pick(p, w);
    uint64_t *sum = off || open ? NULL : malloc(n * columns * sizeof *sum + 1);
    for (uint32_t i = 0; sum && i < n * columns; i++)
        sum[i] = one_in(p, 2) ? 0 : prng_next(p);
    struct zs_strip_hashes sums = { 0 };
    EXPECT(zs_damage_compare(NULL, &sums) == ZS_ERR_NULL);
    if (sum)
        EXPECT(zs_strip_hashes_init(&sums, sum, d->config.width, d->config.height, d->config.strip_h, columns) ==
               (bad ? ZS_ERR_SIZE : ZS_OK));
    const int want = open ? ZS_ERR_SEQUENCE : sum && bad ? ZS_ERR_SIZE : ZS_OK;
    if (sum && !bad)
        d->sums = sums;
    EXPECT(zs_damage_compare(d->r, sum ? bad ? &sums : &d->sums : NULL) == want);
    if (want) {
        free(sum);
        return;
    }
    free(d->sum);
    d->sum = sum;
}

static void do_track(struct room *m, struct desk *d, struct prng *p)
{
    const int bad = one_in(p, 8), off = one_in(p, 4), open = !d->ready || d->open != CLOSED;
    const uint32_t n = m->w.scene.n_instances, few = n && one_in(p, 4) ? prng_pick(p, n > 20 ? 20 : n) : n;
    const uint32_t room = bad ? 65536 + prng_pick(p, 9) : few > 65535 ? 65535 : few;
    const size_t words = open ? 2 : ZS_DAMAGE_WORDS(room, d->config.height, d->config.strip_h);
    uint32_t *memory = off || open ? NULL : malloc(words * sizeof *memory);
    for (size_t i = 0; memory && i < words; i++)
        memory[i] = (uint32_t)prng_next(p);
    EXPECT(zs_damage_track(NULL, memory, room) == ZS_ERR_NULL);
    const int want = open ? ZS_ERR_SEQUENCE : memory && bad ? ZS_ERR_SIZE : ZS_OK;
    EXPECT(zs_damage_track(d->r, memory, room) == want);
    if (want) {
        free(memory);
        return;
    }
    free(d->memory);
    d->memory = memory;
    d->room = room;
    d->columns = 0;
    d->loose |= memory && !m->w.trusted;
}

static void do_columns(struct desk *d, struct prng *p)
{
    const int on = (int)prng_pick(p, 2), may = d->ready && d->open == CLOSED && d->memory;
    EXPECT(zs_damage_columns(NULL, on) == ZS_ERR_NULL);
    EXPECT(zs_damage_columns(d->r, on) == (may ? ZS_OK : ZS_ERR_SEQUENCE));
    if (may)
        d->columns = on;
}

/* What is declared invalid is gone from the glass; in a frame, rows that were given out already as well. */
static void do_invalidate(struct desk *d, struct prng *p)
{
    const struct zs_rect rect = { (uint16_t)prng_pick(p, 70), (uint16_t)prng_pick(p, 70), (uint16_t)prng_pick(p, 70),
                                  (uint16_t)(one_in(p, 8) ? 65535 : prng_pick(p, 70)) };
    const struct zs_rect *part = one_in(p, 2) ? NULL : &rect;
    EXPECT(zs_invalidate(NULL, part) == ZS_ERR_NULL);
    EXPECT(zs_invalidate(d->r, part) == (d->ready ? ZS_OK : ZS_ERR_SEQUENCE));
    if (!d->ready)
        return;
    const uint32_t w = d->config.width, h = d->config.height;
    for (uint32_t j = part ? part->y : 0; j < h && (!part || j < (uint32_t)part->y + part->h); j++)
        for (uint32_t i = part ? part->x : 0; i < w && (!part || i < (uint32_t)part->x + part->w); i++)
            d->glass[j * w + i] ^= 0x5555;
}

static void do_end(struct desk *d)
{
    EXPECT(zs_frame_end(NULL) == ZS_ERR_NULL);
    EXPECT(zs_frame_end(d->r) == (d->ready && d->open != CLOSED ? ZS_OK : ZS_ERR_SEQUENCE));
    d->open = CLOSED;
}

struct panel {
    struct room *m;
    struct desk *d;
    uint32_t rows;                  /* above it: not to be sent any more */
    int submits, waits, lent;       /* calls so far; strips not waited for */
    int bad_submit, bad_wait;       /* the call that fails, from 1; 0: none */
    struct zs_strip strip;
    uint64_t sum;
};

static int panel_submit(void *ctx, const struct zs_strip *s)
{
    struct panel *at = ctx;
    EXPECT(at->lent == 0 && s->y >= at->rows && s->dirty_w);
    at->rows = (uint32_t)s->y + s->h;
    if (++at->submits == at->bad_submit)
        return -1000;
    at->d->given = (uint32_t)s->y / at->d->config.strip_h; /* without change: not sent */
    at->d->last_whole = 0;
    strip_expect(at->m, at->d, s);
    at->lent++;
    at->strip = *s;
    at->sum = fnv1a(FNV1A_BASIS, s->px, s->n_bytes);
    return 0;
}

static int panel_wait(void *ctx)
{
    struct panel *at = ctx;
    EXPECT(at->lent == 1 && fnv1a(FNV1A_BASIS, at->strip.px, at->strip.n_bytes) == at->sum);
    at->lent--;
    return ++at->waits == at->bad_wait ? -1001 : 0;
}

static int panel_gone(void *ctx, const struct zs_strip *s)
{
    struct panel *at = ctx;
    const int err = panel_submit(ctx, s);
    at->lent = 0; /* done with it: there is no wait */
    return err;
}

static void do_render(struct room *m, struct desk *d, struct prng *p)
{
    const int k = (int)prng_pick(p, 2);
    struct panel at = { .m = m, .d = d };
    const int waits = (int)prng_pick(p, 2);
    const struct zs_sink sink = { .submit = waits ? panel_submit : panel_gone, .wait = waits ? panel_wait : NULL,
                                  .ctx = &at };
    if (one_in(p, 3))
        *(one_in(p, 2) ? &at.bad_submit : &at.bad_wait) = 1 + (int)prng_pick(p, 20);
    d->open = k; /* strip_expect looks there */
    d->given = 0;
    const int answer = begin_answer(m, d, k);
    const int got = zs_render(d->r, &m->w.scene, &m->camera[k], &sink);
    d->open = CLOSED;
    const int refused = d->memory && answer && got < 0 && got > -1000; /* do_begin() says why */
    if (answer || refused) {
        EXPECT((got == answer || refused) && at.submits == 0);
        return;
    }
    const int n = (d->config.height + d->config.strip_h - 1) / d->config.strip_h;
    const int all = d->sum || d->memory ? at.submits : n; /* some may be without change */
    const int stops = at.bad_submit && at.bad_submit <= all, late = waits && at.bad_wait && at.bad_wait <= all;
    EXPECT(got == (stops ? -1000 : late ? -1001 : 0));
    EXPECT(at.lent == 0 && at.submits <= n && (stops || late || at.submits == all));
    EXPECT(!stops || at.submits == at.bad_submit);
    EXPECT(!late || at.waits == at.bad_wait);
    if (!got && !d->loose)
        EXPECT(memcmp(d->glass, m->picture[k].color, sizeof *d->glass * d->config.width * d->config.height) == 0);
}

static void case_calls(struct prng *p, uint32_t odd)
{
    static struct room m;
    memset(&m, 0, sizeof m);
    world_make(&m.w, p, odd);
    m.profile = profile(p, &m.w.camera);
    dress(&m.w, p, &m.profile, odd);
    for (int k = 0; k < 2; k++) {
        if (k)
            world_camera(&m.w, p, odd);
        m.camera[k] = m.w.camera;
        m.picture[k] = picture_draw(&m.profile, &m.w.scene, &m.camera[k]);
        count_frame(&m.w, &m.profile, &m.picture[k]);
    }
    const uint64_t before = world_sum(&m.w);
    for (int k = 0; k < 2; k++) {
        m.desk[k].r = malloc(sizeof *m.desk[k].r);
        m.desk[k].open = CLOSED;
        m.desk[k].glass = calloc((size_t)m.profile.width * m.profile.height, sizeof *m.desk[k].glass);
        memset(m.desk[k].r, 0x5a, sizeof *m.desk[k].r);
        do_init(&m, &m.desk[k], p); /* any state: only zs_init may be called first */
    }
    for (uint32_t n = 20 + prng_pick(p, 90); n > 0; n--) {
        struct desk *d = &m.desk[prng_pick(p, 2)];
        const uint32_t op = prng_pick(p, 51);
        if (op == 0)
            do_init(&m, d, p);
        else if (op < 4)
            do_begin(&m, d, p);
        else if (op < 5)
            do_begin_passes(&m, d, p);
        else if (op < 7)
            do_end(d);
        else if (op < 10)
            do_render(&m, d, p);
        else if (op < 12)
            do_skip(d);
        else if (op < 14)
            do_compare(d, p);
        else if (op < 17)
            do_track(&m, d, p);
        else if (op < 20)
            do_columns(d, p);
        else if (op < 21)
            do_invalidate(d, p);
        else
            do_strip(&m, d);
    }
    EXPECT(before == world_sum(&m.w));
    for (int k = 0; k < 2; k++) {
        free(m.desk[k].r);
        free(m.desk[k].arena);
        free(m.desk[k].glass);
        no_memory(&m.desk[k]);
        picture_free(&m.picture[k]);
    }
    world_free(&m.w);
}

/* ---- Configurations ------------------------------------------------------------------------------- */

static uint16_t any_size(struct prng *p)
{
    static const uint16_t ends[] = { 0, 1, 2, 3, 4095, 4096, 4097, 65533, 65534, 65535 };
    return one_in(p, 3) ? ends[prng_pick(p, 10)] : (uint16_t)(prng_next(p) >> 48 >> prng_pick(p, 16));
}

static int within(uint32_t v, uint32_t lo, uint32_t hi)
{
    return v >= lo && v <= hi;
}

static void case_config(struct prng *p, uint32_t odd)
{
    struct zs_config c = {
        .width = any_size(p), .height = any_size(p), .strip_h = any_size(p), .max_tris = any_size(p),
        .max_verts = any_size(p), .varyings = (uint8_t)prng_pick(p, 5), .buffers = (uint8_t)prng_pick(p, 4),
        .subpixel_bits = one_in(p, 2) ? 8 : (uint8_t)prng_pick(p, 10),
        .depth_bits = one_in(p, 2) ? 16 : (uint8_t)prng_pick(p, 20),
        .depth = kind_depths[prng_pick(p, KINDS(kind_depths))].depth
    };
    const int ok = within(c.width, 1, ZS_SIZE_MAX) && within(c.height, 1, ZS_SIZE_MAX) && c.strip_h &&
                   within(c.max_tris, 1, ZS_POOL_MAX) && within(c.max_verts, 3, ZS_POOL_MAX) &&
                   c.varyings <= ZS_VARYINGS_MAX && c.buffers <= 2 &&
                   (c.subpixel_bits == 8 || c.subpixel_bits == 4 || c.subpixel_bits == 0);
    const uint32_t bytes = zs_arena_bytes(&c);
    EXPECT((bytes != 0) == ok);
    if (now.alone)
        print_config(&c);
    struct zs_renderer *r = malloc(sizeof *r);
    memset(r, 1, sizeof *r);
    if (!ok) {
        uint32_t none[4] = { 1, 2, 3, 4 };
        const int err = zs_init(r, &c, none, sizeof none);
        count_refusal(err);
        EXPECT(err == ZS_ERR_SIZE && none[0] == 1 && none[3] == 4);
    } else if (bytes < 2000000 && (uint32_t)c.width * c.height < 200000u) {
        const uint16_t rows = c.strip_h < c.height ? c.strip_h : c.height;
        EXPECT(bytes == ZS_ARENA_BYTES(c.width, c.height, rows, c.max_tris, c.max_verts, c.varyings, c.buffers));
        if ((c.depth_bits < 8 && c.depth_bits) || c.depth_bits > 16) {
            struct picture p2 = picture_draw(&c, NULL, NULL);
            EXPECT(p2.err == ZS_ERR_DEPTH);
            picture_free(&p2);
        } else {
            struct world w;
            world_make(&w, p, odd);
            for (int i = 0; i < WORLD_MESHES; i++) { /* full screen is enough work */
                w.mesh[i].n_tris %= 20u;
                w.mesh[i].cluster = NULL;
                w.mesh[i].n_clusters = 0;
            }
            struct picture a = picture_draw(&c, &w.scene, &w.camera);
            count_frame(&w, &c, &a);
            struct zs_config c2 = way(p, c, w.trusted);
            c2.varyings = c.varyings;
            c2.max_tris = (uint16_t)(c2.max_tris + 40u);
            c2.max_verts = (uint16_t)(c2.max_verts + 90u);
            compare(&w, &a, &c2);
            picture_free(&a);
            world_free(&w);
        }
    }
    free(r);
}

/* ---- Helpers ---------------------------------------------------------------------------------------- */

static int32_t helper32(struct prng *p)
{
    static const int32_t ends[] = { INT32_MIN, INT32_MAX, 0, 1, -1, ZS_WORLD_MAX, -ZS_WORLD_MAX, ZS_WORLD_MAX + 1 };
    return one_in(p, 4) ? ends[prng_pick(p, 8)] : (int32_t)(prng_log(p) >> 32);
}

static void vector(struct prng *p, int32_t v[3])
{
    for (int k = 0; k < 3; k++)
        v[k] = helper32(p);
}

/* What a frame with an empty scene says of a camera. */
static int camera_answer(const struct zs_camera *camera)
{
    static uint32_t arena[400];
    struct zs_renderer r;
    const struct zs_config c = { .width = 4, .height = 4, .strip_h = 4, .max_tris = 4, .max_verts = 4, .buffers = 1,
                                 .subpixel_bits = 8, .depth_bits = 16, .depth = &zs_depth_linear };
    const struct zs_scene empty = { 0 };
    EXPECT(zs_init(&r, &c, arena, sizeof arena) == ZS_OK);
    return zs_frame_begin(&r, &empty, camera);
}

static void helper_cameras(struct prng *p)
{
    int32_t a[3], b[3], up[3];
    vector(p, a);
    vector(p, b);
    vector(p, up);
    struct zs_camera c, old;
    memset(&c, 0x33, sizeof c);
    old = c;
    if (zs_camera_perspective(&c, (zs_turn)prng_next(p), (uint16_t)prng_next(p), helper32(p), helper32(p)) == ZS_OK) {
        const int err = camera_answer(&c); /* ZS_ERR_CAMERA: far - near < far / 65536 */
        EXPECT(err == ZS_OK || err == ZS_ERR_NEAR ||
               (err == ZS_ERR_CAMERA && c.z_far - c.z_near < c.z_far / 65536));
    } else {
        EXPECT(memcmp(&c, &old, sizeof c) == 0);
    }
    memset(&c, 0x33, sizeof c);
    if (zs_camera_orthographic(&c, helper32(p), helper32(p), helper32(p)) == ZS_OK) {
        const int err = camera_answer(&c);
        EXPECT(err == ZS_OK || err == ZS_ERR_NEAR || err == ZS_ERR_RANGE ||
               (err == ZS_ERR_CAMERA && c.height > (zs_q48_16)ZS_WORLD_MAX * 2 * 65536));
    } else {
        EXPECT(memcmp(&c, &old, sizeof c) == 0);
    }
    EXPECT(zs_camera_perspective(&c, 8192, 100, 100, 1000) == ZS_OK);
    old = c;
    const int err = one_in(p, 3)   ? zs_camera_look_at(&c, a, b, up)
                    : one_in(p, 2) ? zs_camera_look_along(&c, a, b, up)
                                   : zs_camera_orbit(&c, a, b[0], (zs_turn)b[1], (int16_t)b[2]);
    EXPECT(err == ZS_OK || err == ZS_ERR_RANGE || err == ZS_ERR_VECTOR);
    if (err)
        EXPECT(memcmp(&c, &old, sizeof c) == 0);
    else /* an orbit's eye may lie beyond the world; a rotation is one */
        EXPECT(camera_answer(&c) != ZS_ERR_CAMERA);
}

static void helper_poses(struct prng *p)
{
    int32_t v[3];
    struct zs_pose pose, old;
    zs_q2_30 unit[3] = { 7, 7, 7 };
    vector(p, v);
    zs_pose_identity(&pose);
    for (int n = 0; n < 5; n++) {
        zs_pose_turn(&pose, (zs_turn)prng_next(p), (zs_turn)prng_next(p), (zs_turn)prng_next(p));
        old = pose;
        vector(p, v);
        if (zs_pose_rotate(&pose, v, (zs_turn)prng_next(p)))
            EXPECT((v[0] | v[1] | v[2]) == 0 && memcmp(&pose, &old, sizeof pose) == 0);
        const int64_t *none = NULL;
        (void)none;
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) {
                int64_t dot = 0;
                for (int k = 0; k < 3; k++)
                    dot += (int64_t)pose.rot[3 * i + k] * pose.rot[3 * j + k] >> 2;
                const int64_t off = dot - (i == j ? (int64_t)1 << 58 : 0);
                EXPECT(off < (int64_t)1 << 34 && off > -((int64_t)1 << 34)); /* 2^-24 */
            }
    }
    if (zs_unit(unit, v)) {
        EXPECT((v[0] | v[1] | v[2]) == 0 && unit[0] == 7 && unit[1] == 7 && unit[2] == 7);
    } else {
        int64_t square = 0;
        for (int k = 0; k < 3; k++)
            square += (int64_t)unit[k] * unit[k] >> 2;
        const int64_t off = square - ((int64_t)1 << 58);
        EXPECT(off < (int64_t)1 << 33 && off > -((int64_t)1 << 33)); /* 2^-25 */
    }
    const int64_t s = zs_sin((zs_turn)v[0]), c = zs_cos((zs_turn)v[0]);
    const int64_t off = (s * s >> 2) + (c * c >> 2) - ((int64_t)1 << 58);
    EXPECT(off < (int64_t)1 << 33 && off > -((int64_t)1 << 33));
}

static void case_helpers(struct prng *p, uint32_t odd)
{
    (void)odd;
    for (int n = 0; n < 20; n++) {
        helper_cameras(p);
        helper_poses(p);
    }
    for (int n = 0; n < 4; n++) {
        EXPECT(zs_error_string((int)(prng_log(p) >> 32))[0] != 0);
        EXPECT(zs_flaw_string((enum zs_flaw)(prng_log(p) >> 32))[0] != 0);
    }
}

/* ---- Cases ------------------------------------------------------------------------------------------- */

typedef void fuzz_fn(struct prng *p, uint32_t odd);

static void run_case(unsigned long long number)
{
    static fuzz_fn *const kinds[] = { case_pictures, case_pictures, case_pictures, case_pictures, case_pictures,
                                      case_calls,    case_calls,    case_config,   case_helpers };
    static const uint32_t odds[] = { 0, 60, 60, 12 };
    struct prng p = { now.seed * 0x9e3779b97f4a7c15u ^ number };
    replay_case(number, CASE_SECONDS);
    (void)prng_next(&p);
    fuzz_fn *const kind = one_in(&p, 500) ? case_big : kinds[prng_pick(&p, KINDS(kinds))];
    kind(&p, odds[prng_pick(&p, KINDS(odds))]);
}

static void report(unsigned long long cases)
{
    printf("seed %llu, %llu cases: %llu frames with %llu triangles (%llu cut), %llu pixels; %llu "
           "passes more, "
           "%llu strips by hand, %llu of them unchanged, %llu left out\n",
           now.seed, cases, (unsigned long long)reached.frames, (unsigned long long)reached.tris,
           (unsigned long long)reached.clipped, (unsigned long long)reached.pixels, (unsigned long long)reached.passes,
           (unsigned long long)reached.strips, (unsigned long long)reached.unchanged,
           (unsigned long long)reached.skipped);
    printf("answers:");
    for (int k = 0; k < 13; k++)
        if (reached.refused[k])
            printf(" %d: %llu", -k, (unsigned long long)reached.refused[k]);
    printf("\nframes by depth:");
    for (size_t k = 0; k < KINDS(kind_depths); k++)
        printf(" %s %llu", kind_depths[k].name, (unsigned long long)(reached.depth[k][0] + reached.depth[k][1]));
    printf("\ninstances by shader:");
    for (size_t k = 0; k < KINDS(kind_shaders); k++)
        printf(" %s %llu", kind_shaders[k].name, (unsigned long long)reached.shader[k]);
    printf("; with a state %llu\nframes by method:", (unsigned long long)reached.state);
    for (size_t k = 0; k < KINDS(kind_methods); k++)
        printf(" %s %llu", kind_methods[k].name, (unsigned long long)reached.method[k]);
    uint64_t effects_drawn = 0, least = UINT64_MAX;
    for (size_t k = 0; k < EFFECT_KINDS; k++) {
        effects_drawn += reached.effect[k];
        least = reached.effect[k] < least ? reached.effect[k] : least;
    }
    printf("\ninstances by effects %llu, at least %llu by each of %d; lines %llu, points %llu; "
           "hooks %llu; passes in mirrors "
           "%llu, in windows %llu\n",
           (unsigned long long)effects_drawn, (unsigned long long)least, EFFECT_KINDS,
           (unsigned long long)reached.lines, (unsigned long long)reached.points, (unsigned long long)reached.hooks,
           (unsigned long long)reached.mirrors, (unsigned long long)reached.windows);
}

int main(int argc, char **argv)
{
    if (argc != 4) {
        fprintf(stderr, "usage: %s SEED cases N | SEED seconds S | SEED case K\n", argv[0]);
        return 2;
    }
    now.seed = strtoull(argv[1], NULL, 0);
    const unsigned long long n = strtoull(argv[3], NULL, 0);
    replay_arm("fuzz_api", "%s %llu case", argv[0], now.seed);
    if (strcmp(argv[2], "case") == 0) {
        now.alone = 1;
        run_case(n);
        printf("ok fuzz_api: case %llu\n", n);
        return 0;
    }
    const int timed = strcmp(argv[2], "seconds") == 0, progress = isatty(2);
    const time_t start = time(NULL);
    unsigned long long k = 0;
    while (timed ? (unsigned long long)(time(NULL) - start) < n : k < n) {
        run_case(++k);
        if (progress && k % 200 == 0)
            fprintf(stderr, "\rfuzz_api: %llu cases ", k);
    }
    if (progress)
        fprintf(stderr, "\r                              \r");
    report(k);
    if (k >= 4000 && !reached_all()) {
        printf("FAILED fuzz_api: a part of the library was not reached\n");
        return 1;
    }
    printf("ok stress_29_fuzz_api: %llu cases of seed %llu\n", k, now.seed);
    return 0;
}
