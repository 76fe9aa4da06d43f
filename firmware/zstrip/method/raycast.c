/* Ray casting: the loops of the depth buffer in the inverse order. For each pixel of a strip, a ray
 * finds the triangle that is seen there; then the strip's visible triangles colour their pixels.
 *
 * All rays start in the eye, so a ray is a point on the screen: the pixel's sample. It hits a
 * triangle if the snapped triangle covers the sample, by the rule of core/edges.c, and the key at
 * the hit is that of the planes of core/plane.c. Among the hits the depth test of
 * core/depth_test.c decides, in scene order. So the frame is that of the depth buffer, bit for bit.
 *
 * MEMORY. The triangle pool is shared out between triangles and boxes. The
 * depth memory holds the numbers of the triangles that the rays have hit, until they are coloured.
 * If there are resolve hooks, which may read keys, a second ray for each pixel writes the key
 * afterwards.
 *
 * If the pools cannot hold what is in a strip, the strip is cut into regions, each of which takes
 * a walk over the scene: half of the rows or columns, again and again, down to a pixel. If the
 * pools cannot hold what is in a pixel, its ray is cast in several parts: the pools keep the
 * triangle that is seen so far.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/bin.h"
#include "core/depth.h"
#include "core/fast.h"
#include "core/method.h"
#include "core/raster.h"
#include "core/walk.h"
#include "method/raycast.h"
#include "method/sort.h"
#include "zs_method.h"

/* ---- Memory ---------------------------------------------------------------------------------- */

/* The number of boxes for n triangles. */
static uint32_t boxes_of(uint32_t n)
{
    uint32_t sum = n;
    while (n > ZS_RAY_CHILDREN) {
        n = (n + ZS_RAY_CHILDREN - 1u) >> ZS_RAY_CHILDREN_LOG2;
        sum += n;
    }
    return sum;
}

/* The number of triangles, most of which leave a pool of n records room for their boxes. */
static uint32_t tris_of(uint32_t n)
{
    uint32_t tris = (3u * n + 4u) / 7u; /* boxes_of(t) >= 4/3 (t - 1) */
    while (tris + boxes_of(tris) > n)
        tris--;
    return tris;
}

/* The boxes: the pool's records after the triangles, since ray_strip has shared it out. */
static struct zs_ray_box *boxes(const struct zs_renderer *r)
{
    return (struct zs_ray_box *)(void *)(r->tri + r->config.max_tris);
}

static int32_t strip_end(const struct zs_renderer *r)
{
    return zs_min32((r->strip + 1) * r->config.strip_h, r->config.height);
}

/* ---- Regions --------------------------------------------------------------------------------- */

/* Drop the triangles beside the region. */
static void keep_region(struct zs_renderer *r, const struct zs_rays *s)
{
    for (uint32_t t = 0; t < r->n_tris; t++) {
        struct zs_ray_box b;
        zs_rays_box(&b, r, t);
        const int in = b.x0 < s->x_end && b.x1 > s->x && b.y0 < s->y_end && b.y1 > s->y;
        r->tri[t].next = in ? 0 : ZS_NIL;
    }
    zs_sort_pack(r);
}

/* Cast the ray of a region of one pixel at the triangles in the pool, and keep the one that is
 * seen. To test that one again later changes nothing. */
static void keep_seen(struct zs_renderer *r, struct zs_rays *s)
{
    zs_rays_build(r, s, boxes(r), zs_scene_list(r));
    s->first = zs_rays_cast(r, s, 0);
    for (uint32_t k = 0; k < s->count[0]; k++)
        r->tri[s->level[0][k].tri].next = k == s->first.box ? 0 : ZS_NIL;
    zs_sort_pack(r);
    if (s->first.box != ZS_NIL)
        s->first.box = 0;
}

/* Make the region smaller, until a quarter of both pools is free. */
static void ray_full(struct zs_renderer *r)
{
    const uint32_t tris = r->config.max_tris, verts = r->config.max_verts;
    struct zs_rays *s = r->method_state;
    for (;;) {
        keep_region(r, s);
        if (tris - r->n_tris > tris / 4u && verts - r->n_verts >= verts / 4u + 3u)
            return;
        if (s->y_end - s->y > 1)
            s->y_end = s->y + (s->y_end - s->y) / 2;
        else if (s->x_end - s->x > 1)
            s->x_end = s->x + (s->x_end - s->x) / 2;
        else
            break;
    }
    keep_seen(r, s);
}

/* Return the list of the triangles, in scene order, that are marked as hit, or that go on in the
 * strip below. */
static uint16_t chosen(struct zs_renderer *r, const struct zs_rays *s, int hit)
{
    const int32_t end = strip_end(r);
    uint16_t list = ZS_NIL, *to = &list;
    for (uint32_t i = 0; i < s->count[0]; i++) {
        const struct zs_ray_box *b = &s->level[0][i];
        if (hit ? r->tri[b->tri].next & ZS_RAY_HIT : b->y1 > end) {
            *to = b->tri;
            to = &r->tri[b->tri].next;
        }
    }
    *to = ZS_NIL;
    return list;
}

/* Draw the region, whose triangles are binned. */
static void region_draw(struct zs_renderer *r, struct zs_rays *s)
{
    zs_rays_build(r, s, boxes(r), zs_scene_list(r));
    (void)zs_rays_cast(r, s, 0);
    r->stats.rays += (uint32_t)((s->y_end - s->y) * (s->x_end - s->x));
    s->list = chosen(r, s, 1);
    zs_raster_strip(r);
    if (r->scene->n_resolves) {
        s->n_planes = 0; /* flags are gone */
        (void)zs_rays_cast(r, s, 1);
    }
    r->active = r->strip + 1 < r->band_end ? chosen(r, s, 0) : ZS_NIL;
}

/* Begin a region: all that is left of the strip. Return 0 if nothing is left. */
static int region_next(const struct zs_renderer *r, struct zs_rays *s)
{
    const struct zs_ray_seen nothing = { ZS_DEPTH_CLEAR, ZS_NIL };
    s->first = nothing;
    if (s->x_end < r->window[1]) {
        s->x = s->x_end;
    } else {
        s->x = r->window[0];
        s->y = s->y_end;
        s->y_end = strip_end(r);
    }
    s->x_end = r->window[1];
    return s->y < s->y_end;
}

static void ray_strip(struct zs_renderer *r)
{
    struct zs_rays s;
    const uint16_t all = r->config.max_tris;
    r->config.max_tris = (uint16_t)tris_of(all);
    r->method_state = &s;
    const struct zs_fast_clusters *const others = r->clusters_hooks;
    r->clusters_hooks = &zs_ray_nodes;
    s.x_end = r->window[1];
    s.y_end = r->strip * r->config.strip_h;
#if ZS_STATS
    s.counted = (struct zs_ray_counts){ 0 };
#endif
    for (int again = 0; region_next(r, &s); again = 1) {
        if (again || r->strip >= r->band_end)
            zs_walk(r, again ? (uint16_t)(r->strip + 1u) : r->draw_end);
        region_draw(r, &s);
    }
    r->clusters_hooks = others;
    r->method_state = 0;
    r->config.max_tris = all;
}

static uint16_t ray_list(struct zs_renderer *r)
{
    const struct zs_rays *s = r->method_state;
    return s ? s->list : zs_scene_list(r); /* a strip is left out: zs_raster_leave */
}

static int ray_begin(struct zs_renderer *r)
{
    const struct zs_config *c = &r->config;
    if (c->depth->span)
        return ZS_ERR_DEPTH;
    if (c->max_tris < 4 || c->max_verts < 6)
        return ZS_ERR_SIZE;
    r->span = zs_rays_span;
    r->method_state = 0;
    return ZS_OK;
}

const struct zs_method zs_method_raycast = {
    .begin = ray_begin, .strip = ray_strip, .full = ray_full, .list = ray_list, .once = 1,
    .records = 1
};
