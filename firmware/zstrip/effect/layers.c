/* Sorted layers: the depth buffer for opaque triangles in scene order, then the triangles of layers
 * (zs_shader.layer) from far to near, tested and not written.
 *
 * The order of two layers is that of their farthest vertices (zs_vertex.d); on a tie, scene order.
 * In a frame of several passes, those of a pass come before those of the next one. The order is the
 * same in every strip.
 *
 * Pools that hold a strip's triangles: its list is sorted, and drawn in one go. Else opaque
 * triangles are drawn, in scene order, whenever a pool is full, so that layers alone stay in it. Of
 * these the farthest are kept, and further walks draw the rest (method/sort.h). The first layer is
 * drawn when the first walk has ended: all opaque triangles are there then. Of several passes, one
 * at a time is drawn like that.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/depth.h"
#include "core/method.h"
#include "core/pass.h"
#include "core/raster.h"
#include "core/walk.h"
#include "method/sort.h"
#include "zs_blend.h"
#include "zs_pass.h"

struct state {
    struct zs_farthest far; /* layers of the pass: method/sort.h */
    uint16_t pass;          /* the pass that is drawn, once a pool was full in this strip */
    uint8_t split;          /* 1: a pool was full: the strip is drawn in several sets */
    uint8_t opaque;         /* 1: list opaque triangles only */
    uint8_t later;          /* 1: triangles of later passes were dropped */
};

/* ---- The order ------------------------------------------------------------------------------- */

/* Return the number of the pass of triangle t of the pool, and its instance. */
static uint32_t pass_of(const struct zs_renderer *r, uint32_t t, const struct zs_instance **in)
{
    const struct zs_pass_memory *const m = r->pass_memory;
    const uint32_t number = r->tri[t].instance;
    uint32_t k = 0;
    if (!r->passes) {
        *in = zs_instance_of(r, number);
        return 0;
    }
    while (number >= m[k].end)
        k++;
    *in = &m->pass[k].scene->instance[number - m[k].first];
    return k;
}

enum { OPAQUE, LAYERS, OTHERS }; /* OTHERS: of another pass */

static uint32_t kind_of(const struct zs_renderer *r, uint32_t t, uint32_t pass)
{
    const struct zs_instance *in;
    return pass_of(r, t, &in) != pass ? OTHERS : in->material->shader->layer ? LAYERS : OPAQUE;
}

/* Part a list into three, each in the list's order. */
static void part(struct zs_renderer *r, uint16_t list, uint32_t pass, uint16_t out[3])
{
    uint16_t *end[3] = { &out[OPAQUE], &out[LAYERS], &out[OTHERS] };
    for (; list != ZS_NIL; list = r->tri[list].next) {
        const uint32_t kind = kind_of(r, list, pass);
        *end[kind] = list;
        end[kind] = &r->tri[list].next;
    }
    *end[OPAQUE] = *end[LAYERS] = *end[OTHERS] = ZS_NIL;
}

/* Append a list at *to, the end of another one. Return its end. */
static uint16_t *appended(struct zs_renderer *r, uint16_t *to, uint16_t list)
{
    *to = list;
    while (*to != ZS_NIL)
        to = &r->tri[*to].next;
    return to;
}

/* The strip's triangles in the order of drawing. r->active is in that order already. */
static uint16_t layers_list(struct zs_renderer *r)
{
    const struct state *s = r->method_state;
    uint16_t above = r->active, begun = r->bin[r->strip], all = ZS_NIL, *end = &all;
    uint16_t old[3], new[3];
    const int opaque = s && s->opaque; /* no state: the strip is left out (zs_raster_leave) */
    for (uint32_t pass = opaque ? s->pass : 0u; above != ZS_NIL || begun != ZS_NIL; pass++) {
        part(r, above, pass, old);
        part(r, begun, pass, new);
        r->active = old[OPAQUE];
        r->bin[r->strip] = new[OPAQUE];
        end = appended(r, end, zs_scene_list(r));
        if (opaque)
            break;
        end = appended(r, end, zs_sort_merge(r, old[LAYERS], zs_sort_list(r, new[LAYERS])));
        above = old[OTHERS];
        begun = new[OTHERS];
    }
    r->bin[r->strip] = ZS_NIL;
    return all;
}

/* ---- Bounded memory -------------------------------------------------------------------------- */

/* Draw the opaque triangles of the pass, and keep only layers that belong to this walk. */
static void sift(struct zs_renderer *r)
{
    struct state *s = r->method_state;
    if (!s->far.again) {
        s->opaque = 1;
        zs_raster_strip(r);
        s->opaque = 0;
    }
    for (uint32_t t = 0; t < r->n_tris; t++) {
        const uint32_t kind = t < s->far.sifted ? LAYERS : kind_of(r, t, s->pass);
        const struct zs_instance *in;
        if (kind == OTHERS && pass_of(r, t, &in) > s->pass)
            s->later = 1;
        const int stays = t < s->far.sifted ||
                          (kind == LAYERS && zs_farthest_belongs(r, &s->far, t));
        r->tri[t].next = stays ? 0 : ZS_NIL;
    }
    zs_sort_pack(r);
    s->far.sifted = r->n_tris;
}

/* Draw what is opaque; then drop the nearest layers. */
static void layers_full(struct zs_renderer *r)
{
    struct state *s = r->method_state;
    s->split = 1;
    r->stats.passes++;
    sift(r);
    zs_farthest_room(r, &s->far);
}

/* Set the state of the next walk of a strip in several sets. Return 0: the strip is complete. */
static int next_set(struct zs_renderer *r)
{
    struct state *s = r->method_state;
    struct state next = { .pass = s->pass, .split = 1 };
    if (s->far.dropped)
        next.far = zs_farthest_next(r, &s->far);
    else if (s->later)
        next.pass++;
    else
        return 0;
    *s = next;
    return 1;
}

static void layers_strip(struct zs_renderer *r)
{
    struct state s = { .split = 0 };
    r->method_state = &s;
    if (r->strip >= r->band_end)
        zs_walk(r, r->draw_end);
    if (!s.split)
        zs_raster_strip(r);
    while (s.split) {
        sift(r);
        zs_raster_strip(r);
        if (!next_set(r))
            break;
        zs_walk(r, (uint16_t)(r->strip + 1u));
    }
    r->method_state = 0;
}

static int layers_begin(struct zs_renderer *r)
{
    r->method_state = 0;
    if (r->config.depth->span) /* the mapping has no depth memory */
        return ZS_ERR_DEPTH;
    return r->config.max_tris >= 2 && r->config.max_verts >= 6 ? ZS_OK : ZS_ERR_SIZE;
}

const struct zs_method zs_method_transparent = {
    .begin = layers_begin, .strip = layers_strip, .full = layers_full, .list = layers_list,
    .passes = 1, .buffer = 1
};
