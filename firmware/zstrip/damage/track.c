/* Damage tracking: which strips may differ from the frame before, found before anything is drawn.
 * Each instance has a hash of everything that it is drawn from, and the range of strips that its
 * bounding sphere can reach. A strip that cannot differ is already right on the panel; it is
 * neither cleared, binned, drawn nor sent.
 *
 * A frame is a function of two things: state of the whole frame (camera, camera units, light,
 * background, number of instances; the configuration is fixed), and state of each instance. If the
 * first differs from the frame before, every strip is dirty. Otherwise a pixel can differ only
 * where an instance that differs covers it in one of the two frames, because a pixel is the least
 * (key, scene order) of what covers it, and neither changes for the other instances. So the strips
 * that such an instance can reach, in either frame, are dirty. Camera units depend on the farthest
 * thing in view; if one instance's movement changes them, all strips are dirty.
 *
 * The strips of a sphere. Every computed vertex lies in the sphere that zs_cull_walk uses; clipping
 * only adds points between vertices. Seen along x, the sphere is a circle with centre (y, z), down
 * and away from the eye, and radius R. The octagon with the corners (y -+ R, z -+ R/2) and (y -+
 * R/2, z -+ R) contains it: its slanting sides are 1.5 R / sqrt(2) = 1.06 R from the centre. If the
 * octagon lies between near and far, projection maps straight lines to straight lines, so the row
 * of each of its points is between those of two corners. Corners are projected by the function that
 * projects vertices. R is increased by 8 camera units, because all of this is rounded to camera
 * units. If the octagon does not lie between near and far (for example, if the sphere contains the
 * eye), no range is known, and the instance counts for all strips.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/cold.h" /* first: only hashing runs often, and its loop is short */
#include "core/cull.h"
#include "core/damage.h"
#include "core/fast.h"
#include "core/frame.h"
#include "core/fx.h"
#include "core/raster.h"
#include "core/rows.h"
#include "core/view.h"
#include "core/xform.h"
#include "damage/changed.h"

#define BESIDE                                                                                     \
    32 /* sub-pixels: a corner and a vertex are snapped by up to 8 each, and each projection has   \
          an error of up to 2 */

struct zs_record { /* an instance in the last frame */
    uint32_t sum[2];
    uint16_t first, end; /* the strips [first, end) that it can reach ... */
    uint16_t x, x_end;   /* ... and the columns [x, x_end) */
};
_Static_assert(sizeof(struct zs_record) == 16 && ZS_DAMAGE_WORDS(1, 1, 1) == 2 + 4 + 1,
               "ZS_DAMAGE_WORDS");

static struct zs_record *records(const struct zs_renderer *r)
{
    return (struct zs_record *)(void *)(r->track_memory + 2);
}

/* Mark columns [x, x_end) of strips [first, end) as dirty. The columns are widened to whole cells
 * of zs_damage_compare, which compares only those, and then to ZS_DAMAGE_GRAIN. */
static ZS_NOINLINE void make_due(struct zs_renderer *r, uint32_t first, uint32_t end, uint32_t x,
                                 uint32_t x_end)
{
    const uint32_t width = r->config.width;
    if (x >= x_end)
        return;
    if (r->strip_hash) {
        const uint32_t step = zs_strip_hash_step(r);
        x = x / step * step;
        x_end = (x_end + step - 1u) / step * step;
    }
    x &= 0u - ZS_DAMAGE_GRAIN;
    x_end = zs_minu32((x_end + ZS_DAMAGE_GRAIN - 1u) & (0u - ZS_DAMAGE_GRAIN), width);
    for (uint32_t *due = r->track_due + first, *const last = r->track_due + end; due < last;
         due++) {
        const uint32_t old = *due ? *due : width; /* first + end * 2^16 */
        *due = zs_minu32(old & 65535u, x) | zs_maxu32(old >> 16, x_end) << 16;
    }
}

/* Find the columns to draw of a strip with the dirty columns `due`. */
static inline void window_of(uint16_t window[2], const struct zs_renderer *r, uint32_t due)
{
    window[0] = r->track_columns ? (uint16_t)due : 0u;
    window[1] = r->track_columns ? (uint16_t)(due >> 16) : r->config.width;
}

/* ---- Hashes ---------------------------------------------------------------------------------- */

static void begin(uint32_t lane[2])
{
    static const uint32_t lanes[2] = ZS_LANES;
    lane[0] = lanes[0];
    lane[1] = lanes[1];
}

/* Add a struct of the scene to a hash, as it lies in memory. That includes padding,
 * which can at worst mark strips as dirty that are not. */
static ZS_NOINLINE void add(uint32_t lane[2], const void *data, uint32_t bytes)
{
    const zs_pair *at = data, *const end = (const zs_pair *)((const uint8_t *)data + bytes);
    uint32_t l[2] = { lane[0], lane[1] };
    while (at < end)
        zs_mix(l, *at++);
    lane[0] = l[0];
    lane[1] = l[1];
}

/* The hash of a mesh and a material, kept for the next instance, which may share them. */
struct looks {
    const struct zs_mesh *mesh;
    const struct zs_material *material;
    uint32_t sum[2];
};

static void looks_sum(struct looks *s, const struct zs_instance *in)
{
    const struct zs_texture *texture = in->material->texture;
    s->mesh = in->mesh;
    s->material = in->material;
    begin(s->sum);
    add(s->sum, in->mesh, sizeof *in->mesh);
    add(s->sum, in->material, sizeof *in->material);
    if (texture)
        add(s->sum, texture, sizeof *texture);
}

static void instance_sum(uint32_t lane[2], const struct zs_instance *in, struct looks *looks)
{
    if (in->mesh != looks->mesh || in->material != looks->material)
        looks_sum(looks, in);
    begin(lane);
    add(lane, looks->sum, sizeof looks->sum);
    add(lane, in, sizeof *in);
    if (in->depth_state) { /* packed to words here: in memory it is 6 bytes at an even address */
        const struct zs_depth_state *s = in->depth_state;
        const uint32_t words[2] = { s->func | (uint32_t)s->read_only << 8,
                                    (uint16_t)s->bias | (uint32_t)(uint16_t)s->slope_bias << 16 };
        add(lane, words, sizeof words);
    }
}

/* Hash the state of the whole frame, except view.shift; never 0 0. zs_view is a function of camera,
 * configuration and shift. */
static void frame_sum(uint32_t lane[2], const struct zs_renderer *r, const struct zs_scene *scene)
{
    const struct zs_camera *camera = &r->camera;
    const uint32_t others[3] = { camera->projection, scene->background | scene->n_instances << 16,
                                 scene->n_resolves };
    begin(lane);
    add(lane, camera->rot, sizeof camera->rot + sizeof camera->pos);
    add(lane, &camera->focal, sizeof *camera - offsetof(struct zs_camera, focal));
    add(lane, &scene->light, sizeof scene->light);
    add(lane, others, sizeof others);
    add(lane, &scene->sky, 2u * sizeof(void *));
    if (scene->resolve)
        add(lane, scene->resolve, scene->n_resolves * (uint32_t)sizeof *scene->resolve);
    lane[0] += !(lane[0] | lane[1]);
}
_Static_assert(offsetof(struct zs_scene, resolve) ==
                   offsetof(struct zs_scene, sky) + sizeof(void *),
               "sky and resolve, the same");
_Static_assert(offsetof(struct zs_camera, pos) == sizeof(((struct zs_camera *)0)->rot),
               "rot and pos are summed as one");

/* ---- The strips of a sphere ------------------------------------------------------------------ */

/* Find the range of sub-pixels that contains the sphere along axis 0 (from the frame's left) or 1
 * (from its top). Return 0 if it is not known. */
static int sphere_extent(int32_t at[2], const struct zs_renderer *r, const struct zs_bounds *b,
                         int axis)
{
    const struct zs_view *view = &r->view;
    const int32_t y = zs_view_length(view, b->c[axis]), z = zs_view_length(view, b->c[2]);
    const int32_t size = zs_view_length(view, b->r + b->slack) + 8;
    if (size > 1 << 29 || z - size < view->z_near || z + size > view->z_far)
        return 0;
    at[0] = INT32_MAX;
    at[1] = INT32_MIN;
    for (int k = 0; k < 8; k++) {
        const int32_t dy = size >> !(k & 1), dz = size >> (k & 1),
                      down = k & 2 ? y + dy : y - dy; /* < 2^30.6 */
        struct zs_point p = { { 0, 0, k & 4 ? z + dz : z - dz } };
        struct zs_vertex v;
        p.c[axis] = (int32_t)zs_round_shift(zs_mul_ss(down, view->ratio), 30);
        (void)zs_xform_project(r, &p,
                               &v); /* 0: outside the guard band, so outside the frame; exact enough
                                       */
        const int32_t subpx = axis ? v.y : v.x;
        at[0] = zs_min32(at[0], subpx - BESIDE);
        at[1] = zs_max32(at[1], subpx + BESIDE);
    }
    return 1;
}

/* Return the strip of the row that is `rows` below the first sample at or below y, sub-pixels;
 * n_strips if the row is below the frame. */
static ZS_NOINLINE uint16_t strip_at(const struct zs_renderer *r, int32_t y, uint32_t rows)
{
    const int32_t row = zs_max32(zs_first_sample(y), 0);
    return (uint16_t)zs_minu32(((uint32_t)row + rows) / r->config.strip_h, r->n_strips);
}

/* Set the strips and columns that an instance can reach. */
static void find_strips(struct zs_renderer *r, uint32_t number)
{
    struct zs_record *rec = &records(r)[number];
    struct zs_bounds b;
    int32_t at[2];
    rec->first = rec->end = rec->x = 0;
    rec->x_end = r->config.width;
    if (zs_cull_walk(&b, r, number))
        return;
    rec->end = r->n_strips;
    if (!sphere_extent(at, r, &b, 1))
        return;
    rec->first = strip_at(r, at[0], 0);
    rec->end = strip_at(r, at[1], r->config.strip_h - 1u);
    if (!r->track_columns || rec->first >= rec->end || !sphere_extent(at, r, &b, 0))
        return;
    rec->x = (uint16_t)zs_max32(zs_first_sample(at[0]), 0);
    rec->x_end = (uint16_t)zs_max32(zs_min32(zs_first_sample(at[1]), rec->x_end), 0);
}

/* ---- Frames ---------------------------------------------------------------------------------- */

/* Store a hash. Return 1 if it differs from the one before. */
static ZS_NOINLINE int differs(uint32_t kept[2], const uint32_t lane[2])
{
    const uint32_t differ = (kept[0] ^ lane[0]) | (kept[1] ^ lane[1]);
    kept[0] = lane[0];
    kept[1] = lane[1];
    return differ != 0;
}

#define OPEN 65535u /* zs_record.first: the strips of this frame are not known yet */

/* Store the hashes of a scene that has not been checked. If all is 0, the old strips of each
 * instance that differs become dirty. Return 1 if anything differs, or if a pointer is missing. */
static int sums_keep(struct zs_renderer *r, const struct zs_scene *scene, int all)
{
    uint32_t lane[2];
    struct looks looks = { 0, 0, { 0, 0 } };
    int changed = all;
    struct zs_record *rec = records(r);
    const struct zs_instance *in = scene->instance;
    for (uint32_t n = scene->n_instances; n; n--, in++, rec++) {
        if (!in->mesh || !in->material)
            return 1;
        instance_sum(lane, in, &looks);
        if (!differs(rec->sum, lane) && !all)
            continue;
        if (!all)
            make_due(r, rec->first, rec->end, rec->x, rec->x_end);
        rec->first = OPEN;
        changed = 1;
    }
    return changed;
}

/* Mark the strips and columns of a rectangle as dirty. NULL: all. */
static void rect_due(struct zs_renderer *r, const struct zs_rect *rect)
{
    const uint32_t width = r->config.width;
    const uint32_t x = rect ? zs_minu32(rect->x, width) : 0u,
                   x_end = rect ? zs_minu32((uint32_t)rect->x + rect->w, width) : width;
    for (uint32_t s = 0; s < r->n_strips; s++)
        if (zs_strip_in(r, s, rect) && x < x_end)
            make_due(r, s, s + 1u, x, x_end);
}

/* Mark what the resolve hooks change as dirty. */
static void resolves_due(struct zs_renderer *r, const struct zs_scene *scene)
{
    const struct zs_resolve *hook = scene->resolve;
    for (uint32_t k = 0; k < scene->n_resolves; k++, hook++) {
        struct zs_rect rect = { 0, 0, 0, 0 };
        if (hook->changes && hook->changes(hook->ctx, &rect) && rect.w && rect.h)
            rect_due(r, &rect);
    }
}

static int track_check(struct zs_renderer *r, const struct zs_scene *scene)
{
    uint32_t lane[2], *kept = r->track_memory;
    if (scene->n_instances > r->track_instances || (scene->n_instances && !scene->instance)) {
        kept[0] = kept[1] = 0;
        return scene->n_instances > r->track_instances ? ZS_ERR_SIZE : ZS_ERR_NULL;
    }
    frame_sum(lane, r, scene);
    int all = differs(kept, lane);
    if (sums_keep(r, scene, all) || r->track_anew) {
        const int32_t shift = r->view.shift;
        kept[0] = kept[1] = 0; /* not known; it stays so if the frame is refused */
        const int err = zs_frame_check(r, scene);
        if (err)
            return err;
        kept[0] = lane[0];
        kept[1] = lane[1];
        r->scene = scene;
        if (shift != r->view.shift)
            all = 1;
        struct zs_record *rec = records(r);
        for (uint32_t i = 0; i < scene->n_instances; i++, rec++) {
            const int due = all || rec->first == OPEN;
            if (due || r->track_anew)
                find_strips(r, i);
            if (due)
                make_due(r, rec->first, rec->end, rec->x, rec->x_end);
        }
        r->track_anew = 0;
        if (all)
            make_due(r, 0, r->n_strips, 0, r->config.width);
    }
    resolves_due(r, scene);
    while (r->draw_end && !r->track_due[r->draw_end - 1u])
        r->draw_end--;
    return ZS_OK;
}

static int track_due(struct zs_renderer *r)
{
    uint32_t *due = r->track_due + r->strip;
    const int draw = *due != 0;
    window_of(r->window, r, *due);
    *due = 0;
    if (!draw) {
        r->stats.strips_clean++;
        r->stats.strips_skipped++;
        if (r->strip < r->band_end)
            zs_raster_leave(r);
    }
    return draw;
}

static int track_touches(const struct zs_renderer *r, uint32_t number, struct zs_region *region)
{
    const struct zs_record *rec = &records(r)[number];
    const uint32_t h = r->config.strip_h;
    uint32_t first = r->n_strips, end = 0, x = rec->x_end, x_end = 0;
    for (uint32_t s = zs_maxu32(rec->first, r->strip); s < rec->end && s < r->band_end; s++) {
        uint16_t window[2] = {
            r->window[0], r->window[1]
        }; /* of the current strip: track_due has cleared its entry */
        if (s != r->strip) {
            if (!r->track_due[s])
                continue;
            window_of(window, r, r->track_due[s]);
        }
        if (rec->x >= window[1] || rec->x_end <= window[0])
            continue;
        first = zs_minu32(first, s);
        end = s + 1u;
        x = zs_minu32(x, window[0]);
        x_end = zs_maxu32(x_end, window[1]);
    }
    region->y = (uint16_t)(first * h);
    region->y_end = (uint16_t)zs_minu32(end * h, r->config.height);
    region->x = (uint16_t)x;
    region->x_end = (uint16_t)x_end;
    return end != 0;
}

static void track_forget(struct zs_renderer *r, const struct zs_rect *rect)
{
    rect_due(r, rect);
    r->track_anew = 1;
    r->draw_end = r->n_strips;
    r->band_end = 0; /* in a frame: bins lack the instances of strips that were clean */
}

/* ---- Columns of a strip ---------------------------------------------------------------------- */

/* Return 1 if job->tri lies outside the columns that are drawn. */
static int beside(struct zs_job *job)
{
    const struct zs_vertex *pool = job->r->vert;
    const uint16_t *v = job->tri->v, *window = job->r->window;
    const struct zs_vertex *a = &pool[v[0]], *b = &pool[v[1]], *c = &pool[v[2]];
    job->tri_end = zs_first_sample(zs_max32(b->y, c->y)); /* a is the top one */
    return zs_first_sample(zs_min32(zs_min32(a->x, b->x), c->x)) >= window[1] ||
           zs_first_sample(zs_max32(zs_max32(a->x, b->x), c->x)) <= window[0];
}

#define ASIDE                                                                                      \
    24 /* columns outside r->window: to split scanlines costs less than to draw so many pixels */

/* Return 1 if job->tri reaches so far beyond the columns that are drawn that its scanlines are
 * split. */
static int reaches_beside(const struct zs_job *job)
{
    const struct zs_vertex *pool = job->r->vert;
    const uint16_t *v = job->tri->v, *window = job->r->window;
    const int32_t a = pool[v[0]].x, b = pool[v[1]].x, c = pool[v[2]].x;
    const int32_t left = window[0] * ZS_SUBPX_ONE - zs_min32(zs_min32(a, b), c);
    const int32_t right = zs_max32(zs_max32(a, b), c) - window[1] * ZS_SUBPX_ONE;
    return zs_max32(left, right) >= ASIDE * ZS_SUBPX_ONE;
}

/* Draw the part of a piece that is inside the columns that are drawn. */
static void window_piece(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1,
                         uint32_t sum, uint32_t step)
{
    const struct zs_renderer *r = job->r;
    const int32_t from = zs_max32(i0, r->window[0]), to = zs_min32(i1, r->window[1]);
    /* zs_rows_walk has counted them */
    job->r->stats.pixels_tested -= (uint32_t)(i1 - i0 - zs_max32(to - from, 0));
    if (from >= to)
        return;
    sum += zs_wrap_mul(step, from - i0);
    if (job->split & ZS_SPLIT_TOUCH)
        r->touch->piece(job, row, from, to, sum, step);
    else
        job->span(job, row, from, to, sum, step);
}

static const struct zs_track_ops zs_track_sums = {
    .check = track_check, .due = track_due, .forget = track_forget, .touches = track_touches,
    .beside = beside, .reaches = reaches_beside, .piece = window_piece
};

int zs_damage_track(struct zs_renderer *r, uint32_t *memory, uint32_t n_instances)
{
    if (!r)
        return ZS_ERR_NULL;
    if (r->ready != 1 || r->scene)
        return ZS_ERR_SEQUENCE;
    if (memory && n_instances > 65535u)
        return ZS_ERR_SIZE;
    r->track = memory ? &zs_track_sums : 0;
    r->unsent = zs_unsent;
    r->track_memory = memory;
    r->track_instances = (uint16_t)n_instances;
    r->track_columns = 0;
    r->window[0] = 0;
    r->window[1] = r->config.width;
    if (memory) {
        r->track_due = (uint32_t *)(void *)(records(r) + n_instances);
        memory[0] = memory[1] = 0; /* the hash of no frame */
        for (uint32_t s = 0; s < r->n_strips; s++)
            r->track_due[s] = (uint32_t)r->config.width << 16;
    }
    return ZS_OK;
}

int zs_damage_columns(struct zs_renderer *r, int on)
{
    if (!r)
        return ZS_ERR_NULL;
    if (r->ready != 1 || r->scene || !r->track)
        return ZS_ERR_SEQUENCE;
    r->track_columns = on != 0;
    return ZS_OK;
}
