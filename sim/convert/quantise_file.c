/* The triangles of a model as they are (--mesh file): grid, parts, texture coordinates.
 *
 * The grid: if all positions are multiples of one power of two, or of one power of ten (as a
 * modeller that writes four decimals makes them), that fit 24 bits over the model's largest extent,
 * then that is the step and nothing is lost. Otherwise the extent is divided by 2^24 - 4.
 *
 * Texture coordinates: a part has as many uv bits as the range of its int16 allows. Whole repeats
 * are taken off the part as a whole; where the coordinates could then not be held to 1/16 texel, off
 * every triangle, which splits the vertices that it shares with one that is moved otherwise. Where
 * even that does not do, the model is refused: cutting a face would change which pixels it covers.
 *
 * SPDX-License-Identifier: MIT
 */
#include "quantise_parts.h"

#include <string.h>

#include "sim.h"
#include "vec.h"
#include "zs_shader.h"

#define GRID_STEPS 16777212.0 /* 2^24 - 4: room for rounding at both ends */
#define PART_VERTS_MAX 65535u
#define SLOTS 262144u /* hash of a part's vertices */
#define UV_BITS_MAX 15
#define UV_ERROR_MAX (1.0 / 16.0) /* texels */

/* ---- Grid ------------------------------------------------------------------------------------ */

struct grid {
    double origin[3], step;
    double per_unit;  /* decimal grids: steps to a model unit, a power of ten; else 0 */
    double first[3];  /* what n = 0 is counted from: a position, or (decimal) a number of steps */
    double middle[3]; /* whole steps from there to the origin */
};

/* A position in steps, not yet rounded. */
static double grid_coord(const struct grid *g, const double p[3], int k)
{
    if (g->per_unit > 0.0)
        return rint(p[k] * g->per_unit) - g->first[k] - g->middle[k];
    return (p[k] - g->first[k]) / g->step - g->middle[k];
}

static int is_binary(const struct sim_model *model, double step)
{
    for (uint32_t i = 0; i < model->n_points; i++)
        for (int k = 0; k < 3; k++) {
            const double d = model->point[i][k] - model->lo[k];
            if (model->lo[k] + d != model->point[i][k] || d / step != rint(d / step))
                return 0;
        }
    return 1;
}

static int is_decimal(const struct sim_model *model, double per_unit)
{
    for (uint32_t i = 0; i < model->n_points; i++)
        for (int k = 0; k < 3; k++) {
            const double p = model->point[i][k], n = rint(p * per_unit), back = n / per_unit;
            if (fabs(n) > 0x1p52 ||
                (model->single ? (float)back != (float)p : back != p))
                return 0;
        }
    return 1;
}

/* Powers of ten that a double holds exactly, least first. */
static double largest_decimal(double extent)
{
    double per_unit = 1.0;
    if (extent > GRID_STEPS)
        return 0.0;
    while (per_unit < 1e22 && extent * per_unit * 10.0 <= GRID_STEPS)
        per_unit *= 10.0;
    return per_unit;
}

static void choose_grid(struct grid *g, const struct sim_model *model)
{
    const double extent = sim_model_extent(model);
    const double decimal = largest_decimal(extent);
    memset(g, 0, sizeof *g);
    g->step = exp2(ceil(log2(extent / GRID_STEPS)));
    if (!is_binary(model, g->step)) {
        g->step = extent / GRID_STEPS;
        if (decimal > 0.0 && is_decimal(model, decimal)) {
            g->per_unit = decimal;
            g->step = 1.0 / decimal;
        }
    }
    for (int k = 0; k < 3; k++) {
        g->first[k] = g->per_unit > 0.0 ? rint(model->lo[k] * g->per_unit) : model->lo[k];
        g->middle[k] = rint((model->hi[k] - model->lo[k]) / g->step / 2.0);
        g->origin[k] = g->per_unit > 0.0 ? (g->first[k] + g->middle[k]) / g->per_unit
                                         : g->first[k] + g->middle[k] * g->step;
    }
}

/* ---- Parts ----------------------------------------------------------------------------------- */

static zs_q1_15 to_q15(double v)
{
    const double n = rint(v * 32768.0);
    return (zs_q1_15)(n > 32767.0 ? 32767.0 : n < -32768.0 ? -32768.0 : n);
}

/* What makes two corners one vertex. */
struct key {
    uint32_t point;
    zs_q1_15 normal[3];
    struct zs_rgb rgb;
    int16_t uv[2];
};

/* How the texture coordinates of a run of triangles become integers: (uv - repeats) * 2^bits. */
struct uv_grid {
    const struct sim_texture *texture; /* NULL: the run has none, and nothing else counts */
    int bits;
    int by_triangle;  /* flag: every triangle is first brought to 0 .. 1 and up, by whole repeats */
    double repeats[2]; /* taken off everything */
};

/* The part that is being filled. */
struct build {
    struct sim_scene *scene;
    const struct sim_model *model;
    const struct grid *grid;
    const struct sim_options *options;
    struct uv_grid uv;
    uint32_t *slot; /* [SLOTS], vertex + 1 */
    struct key *key; /* [PART_VERTS_MAX] */
    uint32_t *slot_of; /* [PART_VERTS_MAX], where a vertex is in slot */
    uint32_t n_verts, first, n_tris;
    uint32_t tri_room;
    uint16_t (*tri)[3];
    double scale; /* world units to a mesh step */
};

/* ---- Texture coordinates --------------------------------------------------------------------- */

/* What one of a triangle's coordinates is before its run's repeats are taken off. */
static double uv_placed(const struct sim_model *model, const struct uv_grid *g, uint32_t t, int k,
                        int axis)
{
    const double(*uv)[2] = (const double(*)[2])model->uv[t];
    const int clamped = g->texture->clamp >> axis & 1;
    if (clamped || !g->by_triangle)
        return uv[k][axis];
    return uv[k][axis] - floor(fmin(uv[0][axis], fmin(uv[1][axis], uv[2][axis])));
}

static double uv_exact(const struct sim_model *model, const struct uv_grid *g, uint32_t t, int k,
                       int axis)
{
    return ldexp(uv_placed(model, g, t, k, axis) - g->repeats[axis], g->bits);
}

/* Bits and repeats for triangles first .. end - 1; -1 bits where int16 cannot hold their range. */
static void uv_fit(struct uv_grid *g, const struct sim_model *model, uint32_t first, uint32_t end)
{
    g->bits = UV_BITS_MAX;
    for (int axis = 0; axis < 2; axis++) {
        const int clamped = g->texture->clamp >> axis & 1;
        double lo = INFINITY, hi = -INFINITY;
        for (uint32_t t = first; t < end; t++)
            for (int k = 0; k < 3; k++) {
                lo = fmin(lo, uv_placed(model, g, t, k, axis));
                hi = fmax(hi, uv_placed(model, g, t, k, axis));
            }
        g->repeats[axis] = clamped ? 0.0 : ceil((lo + hi) / 2.0);
        lo -= g->repeats[axis];
        hi -= g->repeats[axis];
        while (g->bits >= 0 && (rint(ldexp(lo, g->bits)) < INT16_MIN ||
                                rint(ldexp(hi, g->bits)) > INT16_MAX))
            g->bits--;
    }
}

/* How far off the integers are at most, texels. */
static double uv_error(const struct sim_model *model, const struct uv_grid *g, uint32_t first,
                       uint32_t end)
{
    const double size[2] = { g->texture->image.width, g->texture->image.height };
    double most = 0.0;
    for (uint32_t t = first; t < end; t++)
        for (int k = 0; k < 3; k++)
            for (int axis = 0; axis < 2; axis++) {
                const double exact = uv_exact(model, g, t, k, axis);
                most = fmax(most, ldexp(fabs(exact - rint(exact)), -g->bits) * size[axis]);
            }
    return most;
}

static int refuse_uv(const struct sim_model *model, const struct sim_texture *texture)
{
    return sim_refuse(model->file, 0,
                      "a face repeats the texture %s, %u x %u texels, so often that 16 bits do not "
                      "hold its coordinates to 1/16 texel; cut the face up or make the picture "
                      "smaller",
                      texture->name, texture->image.width, texture->image.height);
}

/* The grid of a run of triangles that share a texture. */
static int uv_choose(struct build *b, uint32_t first, uint32_t end)
{
    struct uv_grid *g = &b->uv;
    struct sim_scene *s = b->scene;
    double error = INFINITY;
    *g = (struct uv_grid){ .texture = sim_options_textured(b->options)
                                          ? sim_model_texture(b->model, first)
                                          : NULL };
    if (g->texture == NULL)
        return SIM_OK;
    for (g->by_triangle = 0; g->by_triangle < 2 && !(error <= UV_ERROR_MAX); g->by_triangle++) {
        uv_fit(g, b->model, first, end);
        if (g->bits >= 0)
            error = uv_error(b->model, g, first, end);
    }
    g->by_triangle--;
    if (!(error <= UV_ERROR_MAX))
        return refuse_uv(b->model, g->texture);
    s->uv_error = fmax(s->uv_error, error);
    if (s->uv_bits_least == 0 || s->uv_bits_least > (uint32_t)g->bits)
        s->uv_bits_least = (uint32_t)g->bits;
    return SIM_OK;
}

/* ---- Vertices -------------------------------------------------------------------------------- */

static struct key corner_key(const struct build *b, uint32_t t, int k)
{
    struct key key;
    memset(&key, 0, sizeof key);
    key.point = b->model->tri[t][k];
    for (int i = 0; i < 3 && sim_options_smooth(b->options); i++)
        key.normal[i] = to_q15((double)b->model->normal[t][k][i]);
    if (sim_options_smooth(b->options) && b->uv.texture == NULL)
        key.rgb = b->model->rgb[t][k];
    for (int i = 0; i < 2 && b->uv.texture != NULL; i++)
        key.uv[i] = (int16_t)rint(uv_exact(b->model, &b->uv, t, k, i));
    return key;
}

static int same_key(const struct key *a, const struct key *b)
{
    return a->point == b->point && memcmp(a->normal, b->normal, sizeof a->normal) == 0 &&
           memcmp(&a->rgb, &b->rgb, sizeof a->rgb) == 0 &&
           memcmp(a->uv, b->uv, sizeof a->uv) == 0;
}

/* The part's vertex of a key; PART_VERTS_MAX where it is full. */
static uint32_t vertex_of(struct build *b, const struct key *key)
{
    uint32_t h = key->point * 2654435761u;
    for (int i = 0; i < 3; i++)
        h = (h ^ (uint16_t)key->normal[i]) * 2246822519u;
    h = (h ^ ((uint32_t)(uint16_t)key->uv[0] << 16 | (uint16_t)key->uv[1])) * 2654435761u;
    h = (h ^ ((uint32_t)key->rgb.r << 16 | (uint32_t)key->rgb.g << 8 | key->rgb.b)) * 3266489917u;
    uint32_t i = (h ^ h >> 15) % SLOTS;
    for (; b->slot[i] != 0; i = (i + 1) % SLOTS)
        if (same_key(&b->key[b->slot[i] - 1], key))
            return b->slot[i] - 1;
    if (b->n_verts == PART_VERTS_MAX)
        return PART_VERTS_MAX;
    b->slot_of[b->n_verts] = i;
    b->key[b->n_verts++] = *key;
    b->slot[i] = b->n_verts;
    return b->n_verts - 1;
}

/* Add a triangle to the part; 0 where its vertices do not fit any more. Vertices that were added in
 * vain stay behind unused, in one part at most two. */
static int add_triangle(struct build *b, uint32_t t)
{
    uint16_t v[3];
    for (int k = 0; k < 3; k++) {
        const struct key key = corner_key(b, t, k);
        const uint32_t n = vertex_of(b, &key);
        if (n == PART_VERTS_MAX)
            return 0;
        v[k] = (uint16_t)n;
    }
    if (b->n_tris == b->tri_room) {
        b->tri_room = 2 * b->tri_room + 1024;
        b->tri = sim_grow(b->tri, b->tri_room, sizeof *b->tri);
    }
    memcpy(b->tri[b->n_tris++], v, sizeof v);
    return 1;
}

static void fill_vertices(struct build *b, struct sim_part *part)
{
    const struct grid *g = b->grid;
    for (uint32_t i = 0; i < b->n_verts; i++) {
        const double *p = b->model->point[b->key[i].point];
        for (int k = 0; k < 3; k++) {
            const double exact = grid_coord(g, p, k), n = rint(exact);
            const int32_t fine = (int32_t)n; /* |fine| < 2^23 */
            part->pos[i][k] = (int16_t)((fine - (fine & 255)) / 256);
            part->pos_lo[i][k] = (uint8_t)(fine & 255);
            const double error = g->per_unit > 0.0 ? 0.0 : fabs(exact - n) * g->step;
            b->scene->error = fmax(b->scene->error, error);
        }
        if (part->normal != NULL)
            memcpy(part->normal[i], b->key[i].normal, sizeof part->normal[i]);
        if (part->vertex_rgb != NULL)
            part->vertex_rgb[i] = b->key[i].rgb;
        if (part->uv != NULL)
            memcpy(part->uv[i], b->key[i].uv, sizeof part->uv[i]);
    }
}

static void fill_faces(const struct build *b, struct sim_part *part)
{
    for (uint32_t t = 0; t < b->n_tris; t++) {
        double n[3];
        sim_model_face_normal(b->model, b->first + t, n);
        if (sim_dot(n, n) < 0.5)
            n[2] = 1.0; /* no area: hardly ever drawn */
        for (int k = 0; k < 3; k++)
            part->face_normal[t][k] = to_q15(n[k]);
        const struct zs_rgb rgb = sim_model_face_rgb(b->model, b->first + t);
        part->face_rgb[t] = rgb;
        part->face_raw[t] = b->options->shade == SIM_SHADE_UNLIT ? zs_rgb565(rgb.r, rgb.g, rgb.b)
                                                                 : (uint16_t)(b->first + t + 1u);
    }
}

static void fill_sphere(const struct build *b, struct sim_part *part)
{
    struct zs_mesh *m = &part->mesh;
    for (int k = 0; k < 3; k++) {
        int32_t lo = INT16_MAX, hi = INT16_MIN;
        for (uint32_t i = 0; i < b->n_verts; i++) {
            lo = part->pos[i][k] < lo ? part->pos[i][k] : lo;
            hi = part->pos[i][k] > hi ? part->pos[i][k] : hi;
        }
        m->center[k] = (int16_t)((lo + hi + 1 - ((lo + hi + 1) & 1)) / 2);
    }
    double squared = 0.0;
    for (uint32_t i = 0; i < b->n_verts; i++) {
        double d[3];
        for (int k = 0; k < 3; k++)
            d[k] = part->pos[i][k] + part->pos_lo[i][k] / 256.0 - m->center[k];
        squared = fmax(squared, sim_dot(d, d));
    }
    m->radius = (uint16_t)(ceil(sqrt(squared)) + 1.0); /* <= sqrt(3) * 32769 + 2 < 65536 */
}

static void finish_part(struct build *b)
{
    struct sim_scene *s = b->scene;
    s->part = sim_grow(s->part, (size_t)s->n_parts + 1, sizeof *s->part);
    struct sim_part *part = &s->part[s->n_parts++];
    memset(part, 0, sizeof *part);
    part->pos = sim_alloc(b->n_verts, sizeof *part->pos);
    part->pos_lo = sim_alloc(b->n_verts, sizeof *part->pos_lo);
    if (sim_options_smooth(b->options))
        part->normal = sim_alloc(b->n_verts, sizeof *part->normal);
    if (part->normal != NULL && b->uv.texture == NULL)
        part->vertex_rgb = sim_alloc(b->n_verts, sizeof *part->vertex_rgb);
    if (b->uv.texture != NULL)
        part->uv = sim_alloc(b->n_verts, sizeof *part->uv);
    part->material = &s->material[b->uv.texture != NULL
                                      ? 1 + (b->uv.texture - b->model->texture) : 0];
    part->face_normal = sim_alloc(b->n_tris, sizeof *part->face_normal);
    part->face_rgb = sim_alloc(b->n_tris, sizeof *part->face_rgb);
    part->face_raw = sim_alloc(b->n_tris, sizeof *part->face_raw);
    part->tri = sim_grow(b->tri, b->n_tris, sizeof *b->tri);
    part->mesh = sim_part_mesh(part, b->n_verts, b->n_tris);
    part->mesh.scale = (zs_uq16_16)(b->scale * 65536.0);
    part->mesh.uv_bits = (uint8_t)b->uv.bits;
    fill_vertices(b, part);
    fill_faces(b, part);
    fill_sphere(b, part);
    s->n_verts += b->n_verts;
    for (uint32_t i = 0; i < b->n_verts; i++)
        b->slot[b->slot_of[i]] = 0;
    b->first += b->n_tris;
    b->n_tris = b->n_verts = b->tri_room = 0;
    b->tri = NULL;
}

/* Triangles up to end, from where the parts so far end. */
static void build_run(struct build *b, uint32_t end)
{
    for (uint32_t t = b->first; t < end; t++) {
        if (!add_triangle(b, t)) {
            finish_part(b);
            (void)add_triangle(b, t);
        }
        if (t % 4096 == 0)
            sim_progress("quantising", t, b->model->n_tris);
    }
    finish_part(b);
}

/* Where the run of triangles that share the texture of `first` ends. */
static uint32_t run_end(const struct build *b, uint32_t first)
{
    uint32_t t = first + 1;
    if (!sim_options_textured(b->options))
        return b->model->n_tris;
    while (t < b->model->n_tris &&
           sim_model_texture(b->model, t) == sim_model_texture(b->model, first))
        t++;
    return t;
}

static int build_parts(struct build *b)
{
    int status = SIM_OK;
    b->slot = sim_alloc(SLOTS, sizeof *b->slot);
    b->slot_of = sim_alloc(PART_VERTS_MAX, sizeof *b->slot_of);
    b->key = sim_alloc(PART_VERTS_MAX, sizeof *b->key);
    while (status == SIM_OK && b->first < b->model->n_tris) {
        const uint32_t end = run_end(b, b->first);
        status = uv_choose(b, b->first, end);
        if (status == SIM_OK)
            build_run(b, end);
        if (status == SIM_OK && b->scene->n_parts > UINT16_MAX)
            status = sim_refuse(b->model->file, 0,
                                "more than %u parts, runs of triangles with one texture and up to "
                                "%u vertices; sort its faces by texture",
                                UINT16_MAX, PART_VERTS_MAX);
    }
    SIM_FREE(b->slot, b->slot_of, b->key);
    return status;
}

int sim_scene_file(struct sim_scene *out, const struct sim_model *model, const struct sim_view *view,
                   const struct sim_options *o)
{
    struct grid grid;
    uint32_t scale;
    choose_grid(&grid, model);
    memcpy(out->origin, grid.origin, sizeof out->origin);
    out->step = grid.step;
    const int status = sim_scene_view(out, &scale, model, view, o);
    if (status != SIM_OK)
        return status;
    sim_scene_materials(out, model, o);
    memcpy(out->lost, model->lost, sizeof out->lost);
    struct build b = { .scene = out, .model = model, .grid = &grid, .options = o, .scale = scale / 65536.0 };
    return build_parts(&b);
}
