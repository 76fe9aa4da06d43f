/* Which strips may differ from the frame before, known before anything is drawn: from a sum of all that each instance is
 * drawn from, and from the strips that its sphere can reach. The others are on the glass as they should be, and are neither
 * cleared, binned, drawn nor sent.
 *
 * A frame is a function of two things: what holds for all of it (camera, camera units, light, background, the number of
 * instances; the configuration stays) and what holds for each instance. Where the first differs from the frame before, every
 * strip is due. Else a pixel can differ only where an instance that differs covers it in one of the two frames, as a pixel
 * is the least (key, scene order) of what covers it, and neither changes for the other instances. So the strips of both
 * frames' places of that instance are due. Camera units are those of the farthest thing in view: where one instance's way changes
 * them, all strips are due.
 *
 * The strips of a sphere. Every vertex as computed lies in the sphere that the walk culls by (zs_cull_walk); clipping adds
 * points between vertices only. Of the sphere, seen along x, that is a circle of centre (y, z), down and away from the eye,
 * and radius R. The octagon of the corners (y -+ R, z -+ R/2) and (y -+ R/2, z -+ R) holds it: its slanting sides are 1.5 R /
 * sqrt(2) = 1.06 R from the centre. Where all of it lies between near and far, projection takes straight lines to straight
 * lines, so that the row of each point of the octagon lies between those of two corners; corners are projected by the function
 * that projects vertices. R is raised by 8 more camera units, as all of this is rounded to them. Where it does not, as where
 * a sphere holds the eye, no range is known: all strips.
 *
 * SPDX-License-Identifier: MIT
 */
#include "cold.h" /* first: sums alone are made often, and their loop is short */
#include "changed.h"

#define BESIDE 32 /* sub-pixels: corner and vertex are snapped by up to 8 each, their projections are within 2 each */

struct zs_record { /* an instance in the frame begun last */
    uint32_t sum[2];
    uint16_t first, end; /* strips [first, end) may show it */
};
_Static_assert(sizeof(struct zs_record) == 12 && ZS_TRACK_WORDS(1, 1, 1) == 2 + 3 + 1, "ZS_TRACK_WORDS");

static struct zs_record *records(const struct zs_renderer *r)
{
    return (struct zs_record *)(void *)(r->track_memory + 2);
}

static ZS_NOINLINE void make_due(struct zs_renderer *r, uint32_t first, uint32_t end)
{
    for (uint8_t *due = r->track_due; first < end; first++)
        due[first] = 1;
}

/* ---- Sums -------------------------------------------------------------------------------------------- */

static void begin(uint32_t lane[2])
{
    static const uint32_t lanes[2] = ZS_LANES;
    lane[0] = lanes[0];
    lane[1] = lanes[1];
}

/* A struct of the scene, as it lies in memory. Padding counts too: it can only make strips due that need not be. */
static ZS_NOINLINE void add(uint32_t lane[2], const void *data, uint32_t bytes)
{
    const zs_pair *at = data, *const end = (const zs_pair *)((const uint8_t *)data + bytes);
    uint32_t l[2] = { lane[0], lane[1] };
    while (at < end)
        zs_mix(l, *at++);
    lane[0] = l[0];
    lane[1] = l[1];
}

/* What instances may have in common, so that the next one need not add it up again. */
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
    if (in->state)
        add(lane, in->state, sizeof *in->state);
}

/* What holds for all of a frame but view.shift; never 0 0. Camera, configuration and shift make all of zs_view. */
static void frame_sum(uint32_t lane[2], const struct zs_renderer *r, const struct zs_scene *scene)
{
    const struct zs_camera *camera = &r->camera;
    const uint32_t others[2] = { camera->projection, scene->background | scene->n_instances << 16 };
    begin(lane);
    add(lane, camera->rot, sizeof camera->rot + sizeof camera->pos);
    add(lane, &camera->focal, sizeof *camera - offsetof(struct zs_camera, focal));
    add(lane, &scene->light, sizeof scene->light);
    add(lane, others, sizeof others);
    lane[0] += !(lane[0] | lane[1]);
}
_Static_assert(offsetof(struct zs_camera, pos) == sizeof(((struct zs_camera *)0)->rot), "rot and pos are summed as one");

/* ---- The strips of a sphere ------------------------------------------------------------------------ */

/* Sub-pixels between which the sphere lies, from the frame's top. Return 0: not known. */
static int sphere_rows(int32_t at[2], const struct zs_renderer *r, const struct zs_bounds *b)
{
    const struct zs_view *view = &r->view;
    const int32_t y = zs_view_length(view, b->c[1]), z = zs_view_length(view, b->c[2]);
    const int32_t size = zs_view_length(view, b->r + b->slack) + 8;
    if (size > 1 << 29 || z - size < view->z_near || z + size > view->z_far)
        return 0;
    at[0] = INT32_MAX;
    at[1] = INT32_MIN;
    for (int k = 0; k < 8; k++) {
        const int32_t dy = size >> !(k & 1), dz = size >> (k & 1), down = k & 2 ? y + dy : y - dy; /* < 2^30.6 */
        const struct zs_point p = { { 0, (int32_t)zs_round_shift(zs_mul_ss(down, view->ratio), 30), k & 4 ? z + dz : z - dz } };
        struct zs_vertex v;
        (void)zs_xform_project(r, &p, &v); /* beside the guard band: beside the frame, which is enough */
        at[0] = zs_min32(at[0], v.y - BESIDE);
        at[1] = zs_max32(at[1], v.y + BESIDE);
    }
    return 1;
}

/* The strip of the first sample at or below a height, sub-pixels, `rows` rows further down; n_strips: none. */
static ZS_NOINLINE uint16_t strip_at(const struct zs_renderer *r, int32_t y, uint32_t rows)
{
    const int32_t row = zs_max32(zs_first_sample(y), 0);
    return (uint16_t)zs_minu32(((uint32_t)row + rows) / r->config.strip_h, r->n_strips);
}

static void find_strips(struct zs_renderer *r, uint32_t number)
{
    struct zs_record *rec = &records(r)[number];
    struct zs_bounds b;
    int32_t at[2];
    rec->first = rec->end = 0;
    if (zs_cull_walk(&b, r, number))
        return;
    rec->end = r->n_strips;
    if (!sphere_rows(at, r, &b))
        return;
    rec->first = strip_at(r, at[0], 0);
    rec->end = strip_at(r, at[1], r->config.strip_h - 1u);
}

/* ---- Frames ------------------------------------------------------------------------------------------ */

/* Keep a sum. Return 1: it was another one. */
static ZS_NOINLINE int differs(uint32_t kept[2], const uint32_t lane[2])
{
    const uint32_t differ = (kept[0] ^ lane[0]) | (kept[1] ^ lane[1]);
    kept[0] = lane[0];
    kept[1] = lane[1];
    return differ != 0;
}

#define OPEN 65535u /* zs_record.first: the strips are not known yet */

/* Keep sums of a scene that has not been checked. all 0: what differs leaves its strips, which are due. Return 1: there is
 * something that differs, or cannot be read. */
static int sums_keep(struct zs_renderer *r, const struct zs_scene *scene, int all)
{
    uint32_t lane[2];
    struct looks looks = { 0, 0, { 0, 0 } };
    int changed = all;
    struct zs_record *rec = records(r);
    const struct zs_instance *in = scene->instance, *const end = in + scene->n_instances;
    for (; in < end; in++, rec++) {
        if (!in->mesh || !in->material)
            return 1;
        instance_sum(lane, in, &looks);
        if (!differs(rec->sum, lane) && !all)
            continue;
        if (!all)
            make_due(r, rec->first, rec->end);
        rec->first = OPEN;
        changed = 1;
    }
    return changed;
}

static int track_check(struct zs_renderer *r, const struct zs_scene *scene)
{
    uint32_t lane[2], *kept = r->track_memory;
    if (scene->n_instances > r->track_instances)
        return ZS_ERR_SIZE;
    if (scene->n_instances && !scene->instance)
        return ZS_ERR_NULL;
    frame_sum(lane, r, scene);
    int all = differs(kept, lane);
    if (sums_keep(r, scene, all)) {
        const int32_t shift = r->view.shift;
        kept[0] = kept[1] = 0; /* not known: so it stays where the frame is refused */
        const int err = zs_frame_check(r, scene);
        if (err)
            return err;
        kept[0] = lane[0];
        kept[1] = lane[1];
        r->scene = scene;
        if (shift != r->view.shift)
            all = 1;
        struct zs_record *rec = records(r);
        for (uint32_t i = 0; i < scene->n_instances; i++, rec++)
            if (all || rec->first == OPEN) {
                find_strips(r, i);
                make_due(r, rec->first, rec->end);
            }
        if (all)
            make_due(r, 0, r->n_strips);
    }
    while (r->draw_end && !r->track_due[r->draw_end - 1u])
        r->draw_end--;
    return ZS_OK;
}

static int track_due(struct zs_renderer *r)
{
    uint8_t *due = r->track_due + r->strip;
    const int draw = *due;
    *due = 0;
    if (!draw) {
        r->stats.strips_unchanged++;
        r->stats.strips_skipped++;
        if (r->strip < r->band_end)
            zs_raster_pass(r);
    }
    return draw;
}

static int track_touches(const struct zs_renderer *r, uint32_t number, uint16_t rows[2])
{
    const struct zs_record *rec = &records(r)[number];
    const uint32_t h = r->config.strip_h;
    uint32_t first = r->n_strips, end = 0;
    for (uint32_t s = zs_maxu32(rec->first, r->strip); s < rec->end && s < r->band_end; s++)
        if (s == r->strip || r->track_due[s]) { /* track_due has cleared the one that is being drawn */
            first = zs_minu32(first, s);
            end = s + 1u;
        }
    rows[0] = (uint16_t)(first * h);
    rows[1] = (uint16_t)zs_minu32(end * h, r->config.height);
    return end != 0;
}

static void track_forget(struct zs_renderer *r, const struct zs_rect *rect)
{
    for (uint32_t s = 0; s < r->n_strips; s++)
        r->track_due[s] |= (uint8_t)zs_strip_in(r, s, rect);
    r->draw_end = r->n_strips;
    r->band_end = 0; /* in a frame: what is binned lacks instances of strips that were not due */
}

static const struct zs_track_kernel zs_track_sums = { track_check, track_due, track_touches, track_forget };

int zs_track(struct zs_renderer *r, uint32_t *memory, uint32_t n_instances)
{
    if (!r)
        return ZS_ERR_NULL;
    if (r->ready != 1 || r->scene)
        return ZS_ERR_STATE;
    if (memory && n_instances > 65535u)
        return ZS_ERR_SIZE;
    r->track = memory ? &zs_track_sums : 0;
    r->track_memory = memory;
    r->track_instances = (uint16_t)n_instances;
    if (memory) {
        r->track_due = (uint8_t *)(records(r) + n_instances);
        memory[0] = memory[1] = 0; /* no frame's sum */
        make_due(r, 0, r->n_strips);
    }
    return ZS_OK;
}
