/* The walk of the scene: cull, transform, reject, bin.
 *
 * The band. A walk starts with all strips from the current one down. When a pool is full, the band
 * loses its lower half and the triangles that begin there; vertices that no triangle holds go too.
 * When the band is one strip and a pool is still full, what is binned is drawn into that strip at
 * once and the pools are emptied: least (key, scene order) wins in any number of sets. So any pool
 * that holds one triangle takes any scene, in more passes.
 *
 * Where the pool has room for all of a mesh, its vertices are transformed at once and vertex v has the place
 * vert_base + v ("direct"). Elsewhere, and from the moment on that places were moved, they are transformed when a
 * triangle first asks for them, and vert_map[v] says where vertex v of the current mesh may lie in the pool; it is
 * believed only if that place belongs to the current instance and vert_src says v, so it needs no clearing. A vertex
 * gets its attributes when a triangle that holds it is binned.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/pipeline.h"
#include "core/rotation.h"

#define NO_SOURCE 65535u     /* vert_src of a vertex made by clipping: meshes have at most 65535 */
#define ATTR_UNLIT 0xa55au   /* first attribute of a vertex that no binned triangle holds yet. A lit one that is the
                                same is lit again, with the same outcome */

/* ---- Pools ----------------------------------------------------------------------------------------- */

/* Kept apart: where division is a call, only vertices beyond the pool's size pay for it. */
static ZS_NOINLINE uint32_t fold(uint32_t v, uint32_t n)
{
    return v % n;
}

/* Where vert_map, of n entries, looks for vertex v. */
static inline uint32_t map_index(uint32_t v, uint32_t n)
{
    return v < n ? v : fold(v, n);
}

/* Vertices below base are not the current instance's; without a cache none ever is. */
static void set_base(struct zs_renderer *r, uint32_t base)
{
    r->vert_base = ZS_OFF(r, ZS_SKIP_VCACHE) ? UINT32_MAX : base;
}


static void bins_clear(struct zs_renderer *r)
{
    for (uint32_t s = r->strip; s < r->n_strips; s++)
        r->bin[s] = ZS_NIL;
}

static void pools_empty(struct zs_renderer *r)
{
    r->n_tris = r->n_verts = r->vert_packed = 0;
    set_base(r, 0);
    r->active = ZS_NIL;
    bins_clear(r);
}

/* 0 <= row < ZS_SIZE_MAX */
static int32_t strip_of(const struct zs_renderer *r, int32_t row)
{
    return (int32_t)((uint32_t)row * r->strip_mul >> r->strip_shift);
}

static inline void bin_insert(struct zs_renderer *r, uint32_t t, int32_t row)
{
    const int32_t s = zs_max32(strip_of(r, row), r->strip);
    r->tri[t].next = r->bin[s];
    r->bin[s] = (uint16_t)t;
}

/* Drop binned triangles that begin below the band; the rest moves up in order. */
static ZS_RARE void tris_compact(struct zs_renderer *r)
{
    uint32_t kept = 0;
    bins_clear(r);
    for (uint32_t t = 0; t < r->n_tris; t++) {
        const struct zs_tri tri = r->tri[t];
        const int32_t y0 = zs_max32(zs_first_sample(r->vert[tri.v[0]].y), 0);
        if (strip_of(r, y0) >= r->band_end)
            continue;
        r->tri[kept] = tri;
        bin_insert(r, kept, y0);
        kept++;
    }
    r->n_tris = kept;
}



/* Drop vertices that no binned triangle holds. */
static ZS_RARE void verts_compact(struct zs_renderer *r)
{
    uint16_t *to = r->vert_map; /* its contents are rebuilt below */
    const uint32_t attrs = r->config.attrs;
    for (uint32_t v = 0; v < r->n_verts; v++)
        to[v] = ZS_NIL;
    for (uint32_t t = 0; t < r->n_tris; t++)
        for (int k = 0; k < 3; k++)
            to[r->tri[t].v[k]] = 0;
    uint32_t kept = 0, base = 0;
    for (uint32_t v = 0; v < r->n_verts; v++) {
        if (v == r->vert_base)
            base = kept;
        if (to[v] == ZS_NIL)
            continue;
        to[v] = (uint16_t)kept;
        r->vert[kept] = r->vert[v];
        r->vert_src[kept] = r->vert_src[v];
        for (uint32_t k = 0; k < attrs; k++)
            r->attr[kept * attrs + k] = r->attr[v * attrs + k];
        kept++;
    }
    if (r->vert_base >= r->n_verts)
        base = kept;
    for (uint32_t t = 0; t < r->n_tris; t++)
        for (int k = 0; k < 3; k++)
            r->tri[t].v[k] = to[r->tri[t].v[k]];
    r->n_verts = r->vert_packed = kept;
    set_base(r, base);
    for (uint32_t v = base; v < kept; v++)
        if (r->vert_src[v] != NO_SOURCE)
            r->vert_map[map_index(r->vert_src[v], r->config.max_verts)] = (uint16_t)v;
}


static ZS_RARE int roomy(const struct zs_renderer *r)
{
    const uint32_t tris = r->config.max_tris, verts = r->config.max_verts;
    const uint32_t verts_wanted = verts / 4u + 3u < verts ? verts / 4u + 3u : verts;
    return tris - r->n_tris >= tris / 4u + 1u && verts - r->n_verts >= verts_wanted;
}

static ZS_RARE void high_water(struct zs_renderer *r)
{
    if (r->stats.max_tris_used < r->n_tris)
        r->stats.max_tris_used = r->n_tris;
    if (r->stats.max_verts_used < r->n_verts)
        r->stats.max_verts_used = r->n_verts;
}

/* A pool is full: free at least a quarter of both. Slots change. */
static ZS_RARE void make_room(struct zs_renderer *r)
{
    r->direct = 0;
    high_water(r);
    verts_compact(r);
    while (!roomy(r)) {
        if (r->band_end - r->strip > 1) {
            r->band_end = (uint16_t)(r->strip + (r->band_end - r->strip) / 2);
            tris_compact(r);
            verts_compact(r);
        } else {
            zs_raster_strip(r);
            pools_empty(r);
            r->stats.passes++;
            return;
        }
    }
}

/* ---- Vertices ---------------------------------------------------------------------------------------- */

/* Vertices [from, from + n) of the mesh have been transformed to slots from `slot` on: whose they are. */
static void verts_mark(struct zs_renderer *r, uint32_t slot, uint32_t from, uint32_t n)
{
    const uint32_t attrs = r->config.attrs;
    r->stats.verts_transformed += n;
    for (uint32_t k = 0; k < n; k++)
        r->vert_src[slot + k] = (uint16_t)(from + k);
    if (attrs)
        for (uint16_t *at = &r->attr[slot * attrs], *const end = at + n * attrs; at < end; at += attrs)
            *at = ATTR_UNLIT;
}

static ZS_NOINLINE void vertex_light(struct zs_renderer *r, uint32_t slot, uint16_t *attr)
{
    const struct zs_shader *shader = r->xform.instance->material->shader;
    shader->vertex(r, r->vert_src[slot], attr);
}

static inline void corner_light(struct zs_renderer *r, uint32_t slot, uint32_t attrs)
{
    uint16_t *attr = &r->attr[slot * attrs];
    if (*attr == ATTR_UNLIT)
        vertex_light(r, slot, attr);
}


/* Attributes of a binned triangle's corners that no triangle before it needed. */
static inline void corners_light(struct zs_renderer *r, const uint32_t slot[3])
{
    const uint32_t attrs = r->config.attrs;
    corner_light(r, slot[0], attrs);
    corner_light(r, slot[1], attrs);
    corner_light(r, slot[2], attrs);
}

void zs_bin_verts(struct zs_renderer *r, uint32_t slot, uint32_t from, uint32_t n)
{
    verts_mark(r, slot, from, n);
    zs_xform_screen(r, from, n, &r->vert[slot]);
}

/* Transform all of a mesh, where there is room; not what only clusters need that are left out. */
static void verts_direct(struct zs_renderer *r, const struct zs_mesh *mesh)
{
    const struct zs_cluster_kernel *cluster = r->cluster_kernel;
    const uint32_t n = mesh->n_verts, room = r->config.max_verts - r->n_verts;
    if (n > room && n - room <= r->n_verts - r->vert_packed) { /* there may be room */
        high_water(r);
        verts_compact(r);
    }
    const uint32_t base = r->n_verts;
    set_base(r, base);
    r->direct = !(r->config.skip_off & ZS_SKIP_VCACHE) && n <= r->config.max_verts - base;
    if (!r->direct)
        return;
    r->n_verts += n;
    if (!cluster || !cluster->verts(r))
        zs_bin_verts(r, base, 0, n);
}


/* Transform vertex v into the next place of the pool; ZS_NIL: the pool is full. */
static ZS_NOINLINE uint32_t vertex_add(struct zs_renderer *r, uint32_t v)
{
    if (r->n_verts == r->config.max_verts)
        return ZS_NIL;
    const uint32_t slot = r->n_verts++;
    r->vert_map[map_index(v, r->config.max_verts)] = (uint16_t)slot;
    verts_mark(r, slot, v, 1);
    zs_xform_screen(r, v, 1, &r->vert[slot]);
    return slot;
}

/* The pool's places of a triangle's corners, transformed. Return 0: the pool is full. */
static ZS_RARE ZS_NOINLINE int corner_slots(struct zs_renderer *r, const uint16_t index[3], uint32_t slot[3])
{
    if (r->direct) {
        for (int k = 0; k < 3; k++)
            slot[k] = r->vert_base + index[k];
        return 1;
    }
    const uint16_t *map = r->vert_map, *src = r->vert_src;
    const uint32_t base = r->vert_base, cap = r->config.max_verts;
    uint32_t n = r->n_verts;
    for (int k = 0; k < 3; k++) {
        const uint32_t v = index[k];
        uint32_t s = map[map_index(v, cap)];
        if (s >= n || s < base || src[s] != v) {
            s = vertex_add(r, v);
            if (s == ZS_NIL)
                return 0;
            n = r->n_verts;
        }
        slot[k] = s;
    }
    return 1;
}

/* ---- Triangles --------------------------------------------------------------------------------------- */


enum fate { FATE_DRAWN, FATE_OFFSCREEN, FATE_FACING, FATE_ZERO, FATE_EMPTY, FATE_NEAR, FATE_FAR,
            FATE_INDEX, FATES, FATE_OPEN = FATES /* not known yet */ };

static ZS_RARE void count(struct zs_stats *s, const uint32_t fate[FATES])
{
    s->tris_drawn += fate[FATE_DRAWN];
    s->tris_offscreen += fate[FATE_OFFSCREEN];
    s->tris_facing += fate[FATE_FACING];
    s->tris_zero += fate[FATE_ZERO];
    s->tris_empty += fate[FATE_EMPTY];
    s->tris_near += fate[FATE_NEAR];
    s->tris_far += fate[FATE_FAR];
    s->tris_index += fate[FATE_INDEX];
}


/* Twice the area, q_16 px^2; positive clockwise on the screen (y down). |.| < 2^45 */
static int64_t signed_area(const struct zs_vertex *a, const struct zs_vertex *b,
                           const struct zs_vertex *c)
{
    return zs_mul_ss(b->x - a->x, c->y - a->y) - zs_mul_ss(c->x - a->x, b->y - a->y);
}


static inline const int32_t *xy(const struct zs_vertex *v)
{
    return (const int32_t *)(const void *)v;
}
_Static_assert(offsetof(struct zs_vertex, x) == 0 && offsetof(struct zs_vertex, y) == 4, "x and y come first");

/* The sign of signed_area. */
static int32_t sense(const struct zs_vertex *a, const struct zs_vertex *b, const struct zs_vertex *c)
{
    uint32_t wide;
    const int32_t area = zs_area_short(xy(a), xy(b), xy(c), &wide);
    if (!wide)
        return area;
    const int64_t left = zs_mul_ss(b->x - a->x, c->y - a->y), right = zs_mul_ss(c->x - a->x, b->y - a->y);
    return (left > right) - (left < right);
}


static inline int faces_away(int64_t area, uint32_t cull)
{
    return (cull == ZS_CULL_BACK && area > 0) || (cull == ZS_CULL_FRONT && area < 0);
}

/* A triangle that is about to be binned: the places of its corners, clockwise. Once it has been looked at, the top one
 * first (of two the left one), and its rows [y0, y1). */
struct place {
    uint32_t slot[3];
    int32_t y0, y1;
};

ZS_ALWAYS_INLINE void turn(struct place *at)
{
    const uint32_t first = at->slot[0];
    at->slot[0] = at->slot[1];
    at->slot[1] = at->slot[2];
    at->slot[2] = first;
}


/* Whether the box of a projected triangle holds a sample of the frame. */
ZS_ALWAYS_INLINE enum fate box_fate(struct zs_renderer *r, const struct zs_vertex *a, const struct zs_vertex *b,
                                 const struct zs_vertex *c, struct place *at)
{
    const int32_t ax = a->x, ay = a->y, bx = b->x, by = b->y, cx = c->x, cy = c->y;
    int32_t least = ax, most = bx, top = ay, bottom = by;
    if (by < ay || (by == ay && bx < ax)) {
        bottom = ay;
        top = by;
        turn(at);
        if (cy < by || (cy == by && cx < bx)) {
            top = cy;
            turn(at);
        } else if (cy > ay) {
            bottom = cy;
        }
    } else if (cy < ay || (cy == ay && cx < ax)) {
        top = cy;
        turn(at);
        turn(at);
    } else if (cy > by) {
        bottom = cy;
    }
    if (most < least) {
        least = bx;
        most = ax;
    }
    if (cx < least)
        least = cx;
    else if (cx > most)
        most = cx;
    const int32_t x0 = zs_first_sample(least), x1 = zs_first_sample(most);
    const int32_t y0 = zs_first_sample(top), y1 = zs_first_sample(bottom);
    at->y0 = y0;
    at->y1 = y1;
    if (x1 <= r->walk_x || x0 >= r->walk_end || y1 <= 0 || y0 >= r->config.height)
        return FATE_OFFSCREEN;
    if ((x0 >= x1 || y0 >= y1) && !ZS_OFF(r, ZS_SKIP_EMPTY))
        return FATE_EMPTY;
    return FATE_DRAWN;
}

/* The first strip of [r->strip, r->band_end) that a triangle of the frame has rows in, or ZS_NIL. */
ZS_ALWAYS_INLINE uint32_t strip_in_band(const struct zs_renderer *r, const struct place *at)
{
    uint32_t s = (uint32_t)strip_of(r, zs_max32(at->y0, 0));
    if (s < r->strip)
        s = at->y1 > r->strip * r->config.strip_h ? r->strip : ZS_NIL;
    return s < r->band_end ? s : ZS_NIL;
}

ZS_ALWAYS_INLINE void bin_push(struct zs_renderer *r, const struct place *at, uint16_t paint, uint32_t strip)
{
    const uint32_t n = r->n_tris;
    struct zs_tri *t = &r->tri[n];
    t->v[0] = (uint16_t)at->slot[0];
    t->v[1] = (uint16_t)at->slot[1];
    t->v[2] = (uint16_t)at->slot[2];
    t->next = r->bin[strip];
    t->paint = paint;
    t->instance = (uint16_t)r->xform.number;
    r->bin[strip] = (uint16_t)n;
    r->n_tris = n + 1u;
}


/* ---- Clipped triangles ----------------------------------------------------------------------------- */

struct polygon {
    struct zs_clip_vertex cv[ZS_CLIP_MAX];
    struct zs_vertex v[ZS_CLIP_MAX]; /* snapped */
    int n;
};

#define COORD_MAX (((int32_t)1 << 30) + 2) /* camera units: pipeline.h */

/* Which way a triangle turns on the screen, from its corners in camera units, exactly: > 0 clockwise. Where all
 * three are before the eye, the sign of a . (b x c) is that of the area. */
static ZS_RARE ZS_NOINLINE int sense_of(const struct zs_view *view, const struct zs_clip_vertex v[3])
{
    int32_t p[3][3];
    const int32_t *a = p[0], *b = p[1], *c = p[2];
    for (int k = 0; k < 9; k++) { /* only of a mesh that is larger than its sphere says; it loses parts */
        const int32_t c_k = v[k / 3].p.c[k % 3];
        if (c_k > COORD_MAX || c_k < -COORD_MAX)
            return 0;
        p[k / 3][k % 3] = view->perspective || k % 3 < 2 ? c_k : 1; /* orthographic: the area is a . (b x c) with z = 1 */
    }
    int64_t high = 0, low = 0; /* the sum is high * 2^32 + low, 0 <= low < 2^32 */
    for (int k = 0; k < 3; k++) {
        const int64_t n = zs_cross_at(b, c, k);                          /* |.| < 2^61.1 */
        high += zs_mul_ss((int32_t)(n >> 32), a[k]);                     /* |.| < 3 * 2^60 */
        low += zs_mul_su(a[k], (uint32_t)n);                             /* |.| < 2^62.1 */
        high += low >> 32;
        low &= 0xffffffff;
    }
    return high < 0 ? -1 : high > 0 || low > 0;
}

/* The snapped polygon's area, and a corner whose fan has no piece of the other sense: rounding can turn a
 * corner inwards by a sub-pixel. The first such from the least (y, x) on, so that it does not matter which corner
 * the triangle begins with. A polygon that is seen nearly edge-on may have none, because snapping made it cross
 * itself, and its snapped area may even have the wrong sign: then the sense of the triangle before it was cut
 * counts, and pieces of the other sense are dropped (polygon_bin). That leaves no hole: the samples of the right
 * sense are all in pieces of the right sense, whose signed sum the polygon is; it can draw beyond a thin
 * polygon's edge, by less than a sub-pixel's width.
 * fan: numbers of the corners, from that one on. */
static ZS_RARE int64_t fan_corner(const struct polygon *p, int sense, uint8_t fan[ZS_CLIP_MAX])
{
    int64_t area = 0;
    int start = 0;
    for (int k = 1; k < p->n; k++) {
        if (k + 1 < p->n)
            area += signed_area(&p->v[0], &p->v[k], &p->v[k + 1]); /* |.| < 7 * 2^45 */
        if (p->v[k].y < p->v[start].y || (p->v[k].y == p->v[start].y && p->v[k].x < p->v[start].x))
            start = k;
    }
    for (int i = 0; i <= p->n; i++, start++) { /* the last turn is the first again */
        int good = 1;
        for (int k = 0; k < p->n; k++)
            fan[k] = (uint8_t)((start + k) % p->n);
        for (int k = 1; k + 1 < p->n; k++) {
            const int64_t piece = signed_area(&p->v[fan[0]], &p->v[fan[k]], &p->v[fan[k + 1]]);
            good &= area > 0 ? piece >= 0 : piece <= 0;
        }
        if (good)
            return area;
    }
    return sense;
}

static ZS_RARE void polygon_project(struct zs_renderer *r, struct polygon *p)
{
    const int32_t reach = (int32_t)ZS_GUARD_SUBPX;
    for (int k = 0; k < p->n; k++) {
        struct zs_vertex *v = &p->v[k];
        (void)zs_xform_project(r, &p->cv[k].p, v); /* clipped: near <= z <= far */
        /* rounding in camera units may leave a new vertex a little outside the guard band */
        v->x = zs_min32(zs_max32(v->x, r->view.cx - reach), r->view.cx + reach);
        v->y = zs_min32(zs_max32(v->y, r->view.cy - reach), r->view.cy + reach);
    }
}


/* box: its slots are the corners' numbers in the polygon. */
static ZS_RARE void polygon_push(struct zs_renderer *r, const struct polygon *p, const struct place *box,
                                 uint16_t paint, uint32_t strip)
{
    if (r->n_tris == r->config.max_tris || r->n_verts + 3u > r->config.max_verts)
        make_room(r);
    struct place at;
    for (int k = 0; k < 3; k++) {
        const uint32_t slot = r->n_verts++, corner = box->slot[k];
        at.slot[k] = slot;
        r->vert[slot] = p->v[corner];
        r->vert_src[slot] = NO_SOURCE;
        for (uint32_t a = 0; a < r->xform.instance->material->shader->n_attrs; a++)
            r->attr[slot * r->config.attrs + a] = p->cv[corner].attr[a];
    }
    bin_push(r, &at, paint, strip);
}

static ZS_RARE enum fate polygon_bin(struct zs_renderer *r, const struct polygon *p, uint32_t t, int sense)
{
    const struct zs_material *material = r->xform.instance->material;
    uint8_t fan[ZS_CLIP_MAX];
    const int64_t area = fan_corner(p, sense, fan);
    if (area == 0)
        return FATE_ZERO;
    if (faces_away(area, material->cull))
        return FATE_FACING;
    enum fate all = FATE_EMPTY;
    const struct zs_shader *shader = material->shader;
    const uint16_t paint = shader->face ? shader->face(r, t) : 0u;
    for (int k = 1; k + 1 < p->n; k++) {
        struct place box;
        box.slot[0] = fan[area < 0 ? k + 1 : 0];
        box.slot[1] = fan[k];
        box.slot[2] = fan[area < 0 ? 0 : k + 1];
        if (signed_area(&p->v[box.slot[0]], &p->v[box.slot[1]], &p->v[box.slot[2]]) <= 0)
            continue;
        const enum fate fate = box_fate(r, &p->v[box.slot[0]], &p->v[box.slot[1]], &p->v[box.slot[2]], &box);
        if (fate != FATE_DRAWN) {
            all = all == FATE_DRAWN ? FATE_DRAWN : fate;
            continue;
        }
        all = FATE_DRAWN;
        if (r->tiles)
            r->tiles->cover(r, &p->v[box.slot[0]], &p->v[box.slot[1]], &p->v[box.slot[2]]);
        const uint32_t strip = strip_in_band(r, &box);
        if (strip != ZS_NIL)
            polygon_push(r, p, &box, paint, strip);
    }
    return all;
}


/* Why a triangle cannot be seen whose corners have an outcode in common. */
static enum fate outside(uint32_t all)
{
    return all & ZS_OUT_NEAR ? FATE_NEAR : all & ZS_OUT_FAR ? FATE_FAR : FATE_OFFSCREEN;
}


static ZS_RARE enum fate triangle_clip(struct zs_renderer *r, uint32_t t)
{
    const struct zs_mesh *mesh = r->xform.instance->mesh;
    const struct zs_shader *shader = r->xform.instance->material->shader;
    struct polygon p;
    uint32_t any = 0, all = ~0u, sides = 0;
    for (int k = 0; k < 3; k++) {
        const uint32_t v = mesh->tri[t][k];
        zs_xform_vertex(&r->xform, v, &p.cv[k].p);
        if (shader->vertex)
            shader->vertex(r, v, p.cv[k].attr);
        const uint32_t code = zs_xform_outcode(&r->view, &p.cv[k].p);
        any |= code;
        all &= code;
    }
    if (all)
        return outside(all);
    if (r->counting)
        r->stats.tris_clipped++;
    const int sense = sense_of(&r->view, p.cv);
    p.n = zs_clip_polygon(&r->view, p.cv, 3, any & (ZS_OUT_NEAR | ZS_OUT_FAR), shader->n_attrs);
    for (int k = 0; k < p.n; k++) /* sides mean something only now */
        sides |= zs_xform_outcode(&r->view, &p.cv[k].p) & ZS_OUT_SIDES;
    if (p.n && sides) {
        p.n = zs_clip_polygon(&r->view, p.cv, p.n, sides, shader->n_attrs);
        if (!p.n)
            return FATE_OFFSCREEN;
    }
    if (!p.n)
        return any & ZS_OUT_NEAR ? FATE_NEAR : FATE_FAR;
    polygon_project(r, &p);
    return polygon_bin(r, &p, t, sense);
}


/* ---- The walk -------------------------------------------------------------------------------------- */


/* Triangles go through in batches: those that are turned away leave first. */
#define BATCH 40 /* at most 64 */
struct batch {
    const uint16_t (*tri)[3];     /* the batch's first */
    const struct zs_vertex *pool; /* direct: of vertex 0 */
    const struct zs_shader *shader;
    uint32_t n_verts;
    int32_t away;                 /* times the area: > 0 where the triangle is turned away and that matters */
    uint32_t *fate;               /* [FATES]: counts of those that were dropped */
    uint8_t left[BATCH];          /* the others: 4 * number in the batch, 1 more where it turns counter-clockwise, 2 where
                                     that is not known */
};

static ZS_NOINLINE void dropped(struct batch *s, enum fate fate)
{
    s->fate[fate]++;
    s->fate[FATE_FACING]--; /* sieve() counts it there */
}

/* A triangle that is large, or not wholly inside near, far and guard. Return 0: it lies outside, and is dropped. */
static ZS_NOINLINE int odd(struct batch *s, const uint16_t index[3])
{
    const struct zs_vertex *const pool = s->pool;
    if (index[0] >= s->n_verts || index[1] >= s->n_verts || index[2] >= s->n_verts)
        return 1;
    const uint32_t all = pool[index[0]].d & pool[index[1]].d & pool[index[2]].d;
    if (all <= ZS_D_OUT)
        return 1;
    dropped(s, outside(all));
    return 0;
}

/* Drop triangles that lie on one side outside, and small ones that are turned away, for which 32 bits are enough. Return how
 * many are left. Vertices that are not inside near, far and guard need no test of their own: they are too far from all
 * others for a small triangle (zs_xform_screen). */
static ZS_NOINLINE uint32_t sieve(struct batch *s, uint32_t n)
{
    const struct zs_vertex *const pool = s->pool;
    const uint16_t (*tri)[3] = s->tri;
    const uint32_t n_verts = s->n_verts;
    const uint32_t end = 4u * n;
    uint8_t *out = s->left;
    for (uint32_t t = 0; t < end; t += 4u, tri++) {
        const uint32_t i = (*tri)[0], j = (*tri)[1], k = (*tri)[2];
        uint32_t wide = 1;
        int32_t area = 0;
        if (i < n_verts && j < n_verts && k < n_verts)
            area = zs_area_short(xy(pool + i), xy(pool + j), xy(pool + k), &wide);
        if (wide) {
            if (odd(s, *tri))
                *out++ = (uint8_t)(t + 2u);
        } else if (area == 0) {
            dropped(s, FATE_ZERO);
        } else if (area * s->away <= 0) {
            *out++ = (uint8_t)(t + ((uint32_t)area >> 31));
        }
    }
    ZS_ANEW(s); /* s->left is found again: no register holds it in the loop */
    const uint32_t left = (uint32_t)(out - s->left);
    s->fate[FATE_FACING] += end / 4u - left;
    return left;
}

/* All are left, none is looked at. */
static uint32_t sieve_none(struct batch *s, uint32_t n)
{
    for (uint32_t t = 0; t < n; t++)
        s->left[t] = (uint8_t)(4u * t + 2u);
    return n;
}


/* A triangle that is not wholly inside near, far and guard. */
static enum fate cut(struct zs_renderer *r, uint32_t t, const struct zs_vertex *a, const struct zs_vertex *b,
                     const struct zs_vertex *c)
{
    const uint32_t all = a->d & b->d & c->d; /* above ZS_D_OUT: a bit of all three outcodes */
    return all > ZS_D_OUT ? outside(all) : triangle_clip(r, t);
}

/* The places of a triangle's corners. Return FATE_OPEN where it faces the eye and is not cut. */
static ZS_NOINLINE enum fate look(struct zs_renderer *r, uint32_t t, struct place *at)
{
    const struct zs_mesh *mesh = r->xform.instance->mesh;
    const uint16_t *index = mesh->tri[t];
    uint32_t *const slot = at->slot;
    for (int k = 0; k < 3; k++)
        if (index[k] >= mesh->n_verts)
            return FATE_INDEX;
    if (index[0] == index[1] && index[0] == index[2])
        return FATE_ZERO; /* wherever it is */
    while (!corner_slots(r, index, slot))
        make_room(r);
    const struct zs_vertex *a = &r->vert[slot[0]], *b = &r->vert[slot[1]], *c = &r->vert[slot[2]];
    if (a->d >= ZS_D_OUT || b->d >= ZS_D_OUT || c->d >= ZS_D_OUT)
        return cut(r, t, a, b, c);
    const int32_t turns = sense(a, b, c);
    if (turns == 0)
        return FATE_ZERO;
    if (turns < 0) {
        const uint32_t first = slot[0];
        slot[0] = slot[2];
        slot[2] = first;
    }
    return faces_away(turns, r->xform.instance->material->cull) ? FATE_FACING : FATE_OPEN;
}


/* Bin a triangle, unless it lies outside the frame or the band. Return FATE_OPEN: the pool of triangles is full. */
ZS_ALWAYS_INLINE enum fate place(struct zs_renderer *r, const struct zs_shader *shader, uint32_t t, struct place *at)
{
    const enum fate fate = box_fate(r, &r->vert[at->slot[0]], &r->vert[at->slot[1]], &r->vert[at->slot[2]], at);
    if (fate != FATE_DRAWN)
        return fate;
    const uint32_t strip = strip_in_band(r, at);
    if (strip == ZS_NIL)
        return fate;
    if (r->n_tris == r->config.max_tris)
        return FATE_OPEN;
    if (shader->vertex)
        corners_light(r, at->slot);
    bin_push(r, at, shader->face ? shader->face(r, t) : 0u, strip);
    return FATE_DRAWN;
}



/* The n triangles from `from` on, as far as they are left. */
static void batch_bin(struct zs_renderer *r, const struct batch *s, uint32_t from, uint32_t n, uint32_t fate[FATES])
{
    const uint8_t *left = s->left, *const end = left + n;
    for (; left < end; left++) {
        const uint32_t what = *left, t = from + what / 4u;
        int known = r->direct && !(what & 2u);
        for (;;) {
            struct place at; /* in registers: its address is not taken */
            enum fate f;
            if (known) {
                const uint16_t *index = s->tri[what / 4u];
                const uint32_t base = r->vert_base, second = base + index[1], third = base + index[2];
                at.slot[0] = base + index[0];
                at.slot[1] = what & 1u ? third : second;
                at.slot[2] = what & 1u ? second : third;
            } else {
                struct place looked;
                f = look(r, t, &looked);
                if (f != FATE_OPEN) {
                    fate[f]++;
                    break;
                }
                at = looked;
                if (r->tiles)
                    r->tiles->cover(r, &r->vert[looked.slot[0]], &r->vert[looked.slot[1]], &r->vert[looked.slot[2]]);
            }
            f = place(r, s->shader, t, &at);
            if (f != FATE_OPEN) {
                fate[f]++;
                break;
            }
            make_room(r); /* slots are stale: look the vertices up again */
            known = 0;
        }
    }
}

/* Triangles of up to 128 px pass the sieve and are not asked what they hide (batch_bin()). In a small frame, these too. */
static inline int asked(const struct zs_renderer *r, const struct zs_mesh *mesh)
{
    return r->config.width <= 160u && mesh->n_tris <= BATCH;
}

/* Triangles [r->clusters.from, r->clusters.end) of the current instance. */
static ZS_NOINLINE void walk_mesh(struct zs_renderer *r, uint32_t fate[FATES])
{
    const struct zs_mesh *mesh = r->xform.instance->mesh;
    const uint32_t cull = r->xform.instance->material->cull;
    struct batch s;
    s.n_verts = mesh->n_verts;
    s.away = cull == ZS_CULL_BACK ? 1 : cull == ZS_CULL_FRONT ? -1 : 0;
    s.fate = fate;
    s.shader = r->xform.instance->material->shader;
    s.pool = &r->vert[r->direct ? r->vert_base : 0u];
    for (uint32_t t = r->clusters.from; t < r->clusters.end; t += BATCH) {
        const uint32_t n = zs_minu32(r->clusters.end - t, BATCH);
        s.tri = mesh->tri + t;
        batch_bin(r, &s, t, r->direct && !asked(r, mesh) ? sieve(&s, n) : sieve_none(&s, n), fate);
    }
}

/* Cull an instance, or make r->xform its own. Return 0: nothing of it can be seen, or no strip that shows it is drawn.
 * Apart, so that its frame is not on the stack below the walk. */
static ZS_RARE ZS_NOINLINE int instance_open(struct zs_renderer *r, uint32_t number)
{
    struct zs_bounds b;
    const struct zs_mesh *mesh = r->scene->instance[number].mesh;
    const struct zs_track_kernel *track = r->track;
    const struct zs_cluster_kernel *cluster = mesh->cluster_kernel;
    struct zs_part part;
    if (track) {
        if (!track->touches(r, number, &part))
            return 0;
        r->walk_x = part.x;
        r->walk_end = part.x_end;
        r->walk_least = (uint16_t)zs_minu32(r->walk_least, part.x);
        r->walk_most = (uint16_t)zs_maxu32(r->walk_most, part.x_end);
    }
    if (zs_cull_walk(&b, r, number) && !ZS_OFF(r, ZS_SKIP_FRUSTUM))
        return 0;
    if (r->large && !r->scene->instance[number].state && r->tiles->hides_sphere(r, &b)) {
        r->stats.instances_hidden += r->counting;
        return 0;
    }
    if (cluster && !cluster->edges(r, &b, number))
        return 0;
    if (!zs_xform_instance(r, number, &b))
        return 0;
    r->clusters.from = r->clusters.end = 0;
    if (cluster && !cluster->open(r, &b))
        cluster = 0;
    r->cluster_kernel = cluster;
    return 1;
}

/* The next run of triangles of the current instance. Return 0: there is none. */
static ZS_RARE int next_run(struct zs_renderer *r)
{
    const struct zs_cluster_kernel *cluster = r->cluster_kernel;
    if (cluster)
        return cluster->run(r);
    r->clusters.from = r->clusters.end;
    r->clusters.end = r->xform.instance->mesh->n_tris;
    return r->clusters.from < r->clusters.end;
}

static ZS_RARE void walk_instance(struct zs_renderer *r, uint32_t number)
{
    const struct zs_mesh *mesh = r->scene->instance[number].mesh;
    const int seen = instance_open(r, number);
    if (r->counting) {
        r->stats.instances_in++;
        r->stats.tris_in += mesh->n_tris;
        if (!seen) {
            r->stats.instances_culled++;
            r->stats.tris_frustum += mesh->n_tris;
        }
    }
    if (!seen)
        return;
    uint32_t fate[FATES] = { 0 };
    verts_direct(r, mesh);
    while (next_run(r))
        walk_mesh(r, fate);
    if (r->counting)
        count(&r->stats, fate);
}


ZS_RARE void zs_bin_walk(struct zs_renderer *r)
{
    pools_empty(r);
    r->band_end = ZS_OFF(r, ZS_SKIP_BINS) ? (uint16_t)(r->strip + 1u) : r->draw_end;
    r->stats.passes++;
    r->walk_x = r->walk_most = 0;
    r->walk_end = r->walk_least = r->config.width;
    for (uint32_t i = 0; i < r->scene->n_instances; i++)
        walk_instance(r, i);
    high_water(r);
    r->counting = 0;
}
