/* Grid, world unit, parts, camera.
 *
 * The grid: if all positions are multiples of one power of two, or of one power of ten (as a
 * modeller that writes four decimals makes them), that fit 24 bits over the model's largest extent,
 * then that is the step and nothing is lost. Otherwise the extent is divided by 2^24 - 4.
 *
 * The world unit: a mesh step (256 grid steps) is 2^k world units, with k as large as the eye and the
 * model allow, so that they use 2^28 .. 2^29 of the world. The far plane may be 2^15 times farther. Where
 * half a unit would be more than OFF_MAX_PX on the screen, the camera is refused: better than a wrong picture.
 *
 * SPDX-License-Identifier: MIT
 */
#include "quantise.h"

#include <stdlib.h>
#include <string.h>

#include "sim.h"
#include "vec.h"

#define GRID_STEPS 16777212.0 /* 2^24 - 4: room for rounding at both ends */
#define WORLD_USE 0.98        /* of ZS_WORLD_MAX: room for bounding spheres rounded up */
#define UNITS_LOG2_MAX 15     /* world units to a mesh step: mesh.scale is uq16_16 */
#define UNITS_LOG2_MIN (-15) /* the model is then one world unit wide */
#define OFF_MAX_PX (1.0 / 32.0)
#define PART_VERTS_MAX 65535u
#define SLOTS 262144u /* hash of a part's vertices */

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

static double largest_extent(const struct sim_model *model)
{
    double extent = 0.0;
    for (int k = 0; k < 3; k++)
        extent = fmax(extent, model->hi[k] - model->lo[k]);
    return extent;
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
    const double extent = largest_extent(model);
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

/* ---- World and camera ------------------------------------------------------------------------ */

/* Rounding the eye to a unit moves the model by up to half of one. */
static int check_unit(const struct sim_scene *s, const struct sim_model *model,
                      const struct sim_view *v, double need)
{
    double d[3];
    sim_sub(d, model->center, v->eye);
    const double clear = sqrt(sim_dot(d, d)) - model->radius; /* from the eye to the model */
    const double z = fmax(fmax(v->near_z, clear), model->radius / 16.0);
    const double px = v->orthographic ? v->height / v->span : v->focal / z;
    if (s->unit / 2.0 * px <= OFF_MAX_PX)
        return SIM_OK;
    return sim_refuse(model->file, 0,
                      "the eye or the far plane is so far away, %g beside a model of %g, that the "
                      "integers would move the model by %.2g px; bring it closer",
                      fmax(need, v->far_z), largest_extent(model), s->unit / 2.0 * px);
}

static int choose_unit(struct sim_scene *s, int *units_log2, const struct sim_model *model,
                       const struct sim_view *v)
{
    double d[3], eye = 0.0;
    sim_sub(d, model->center, s->origin);
    double need = model->radius + sqrt(sim_dot(d, d));
    for (int k = 0; k < 3; k++)
        eye = fmax(eye, fabs(v->eye[k] - s->origin[k]));
    need = fmax(fmax(need, eye), fabs(v->near_z));
    need = fmax(need, fabs(v->far_z) * ZS_WORLD_MAX / (double)ZS_FAR_MAX); /* may be far outside */
    if (v->orthographic)
        need = fmax(need, v->span / 2.0);
    const double mesh_step = 256.0 * s->step;
    const double k = floor(log2(WORLD_USE * ZS_WORLD_MAX * mesh_step / need));
    if (!(k >= UNITS_LOG2_MIN)) {
        const double size = largest_extent(model);
        const double most = WORLD_USE * ZS_WORLD_MAX * exp2(-UNITS_LOG2_MIN) * mesh_step / size;
        return sim_refuse(
            model->file, 0,
            "%s %g is %.3g times the model's size %g; the integers hold up to %.3g times",
            eye >= 0.5 * need ? "the eye's distance" : "the far plane's or the view's extent", need,
            need / size, size, most);
    }
    *units_log2 = k > UNITS_LOG2_MAX ? UNITS_LOG2_MAX : (int)k;
    s->unit = ldexp(mesh_step, -*units_log2);
    return check_unit(s, model, v, need);
}

static void scaled(int32_t out[3], const double v[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = (int32_t)lrint(v[k] * 1073741824.0 * (1.0 - 0x1p-30));
}

static int build_camera(struct sim_scene *s, const struct sim_view *v, const char *file)
{
    struct zs_camera *c = &s->camera;
    double forward[3];
    int32_t eye[3], dir[3], up[3];
    for (int k = 0; k < 3; k++) {
        eye[k] = (int32_t)lrint((v->eye[k] - s->origin[k]) / s->unit);
        forward[k] = -v->back[k];
    }
    scaled(dir, forward);
    scaled(up, v->up);
    c->projection = v->orthographic ? ZS_ORTHOGRAPHIC : ZS_PERSPECTIVE;
    c->focal = (zs_uq32_32)llrint(v->focal * 4294967296.0);
    c->height = llrint(v->span / s->unit * 65536.0);
    c->z_near = llrint(v->near_z / s->unit * 65536.0);
    c->z_far = llrint(v->far_z / s->unit * 65536.0);
    const int err = zs_camera_look_along(c, eye, dir, up);
    if (err != ZS_OK)
        return sim_refuse(file, 0, "the camera was refused: %s", zs_strerror(err));
    if (!v->orthographic && c->z_near <= 0)
        return sim_refuse(file, 0,
                          "near %g is too small beside a world that reaches %g; enlarge it",
                          v->near_z, s->unit * ZS_WORLD_MAX);
    return SIM_OK;
}

static void build_light(struct sim_scene *s, const struct sim_view *v, const struct sim_options *o)
{
    for (int k = 0; k < 3; k++)
        s->scene.light.dir[k] = (zs_q2_30)lrint(v->light[k] * 1073741824.0);
    s->scene.light.ambient = (zs_uq16_16)lrint(o->ambient * 65536.0);
    s->scene.light.diffuse = (zs_uq16_16)lrint(o->diffuse * 65536.0);
    s->scene.background = zs_rgb565(o->background.r, o->background.g, o->background.b);
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
};

/* The part that is being filled. */
struct build {
    struct sim_scene *scene;
    const struct sim_model *model;
    const struct grid *grid;
    int smooth;
    uint32_t *slot; /* [SLOTS], vertex + 1 */
    struct key *key; /* [PART_VERTS_MAX] */
    uint32_t n_verts, first, n_tris;
    uint32_t tri_room;
    uint16_t (*tri)[3];
    double scale; /* world units to a mesh step */
};

static struct key corner_key(const struct build *b, uint32_t t, int k)
{
    struct key key;
    memset(&key, 0, sizeof key);
    key.point = b->model->tri[t][k];
    if (b->smooth) {
        for (int i = 0; i < 3; i++)
            key.normal[i] = to_q15((double)b->model->normal[t][k][i]);
        key.rgb = b->model->rgb[t][k];
    }
    return key;
}

static int same_key(const struct key *a, const struct key *b)
{
    return a->point == b->point && memcmp(a->normal, b->normal, sizeof a->normal) == 0 &&
           memcmp(&a->rgb, &b->rgb, sizeof a->rgb) == 0;
}

/* The part's vertex of a key; PART_VERTS_MAX where it is full. */
static uint32_t vertex_of(struct build *b, const struct key *key)
{
    uint32_t h = key->point * 2654435761u;
    for (int i = 0; i < 3; i++)
        h = (h ^ (uint16_t)key->normal[i]) * 2246822519u;
    h = (h ^ ((uint32_t)key->rgb.r << 16 | (uint32_t)key->rgb.g << 8 | key->rgb.b)) * 3266489917u;
    uint32_t i = (h ^ h >> 15) % SLOTS;
    for (; b->slot[i] != 0; i = (i + 1) % SLOTS)
        if (same_key(&b->key[b->slot[i] - 1], key))
            return b->slot[i] - 1;
    if (b->n_verts == PART_VERTS_MAX)
        return PART_VERTS_MAX;
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
        if (b->smooth) {
            memcpy(part->normal[i], b->key[i].normal, sizeof part->normal[i]);
            part->vertex_rgb[i] = b->key[i].rgb;
        }
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
        part->face_rgb[t] = sim_model_face_rgb(b->model, b->first + t);
        part->face_raw[t] = (uint16_t)(b->first + t + 1u);
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
    if (b->smooth) {
        part->normal = sim_alloc(b->n_verts, sizeof *part->normal);
        part->vertex_rgb = sim_alloc(b->n_verts, sizeof *part->vertex_rgb);
    }
    part->face_normal = sim_alloc(b->n_tris, sizeof *part->face_normal);
    part->face_rgb = sim_alloc(b->n_tris, sizeof *part->face_rgb);
    part->face_raw = sim_alloc(b->n_tris, sizeof *part->face_raw);
    part->tri = sim_grow(b->tri, b->n_tris, sizeof *b->tri);
    part->mesh = (struct zs_mesh){ .pos = (const int16_t(*)[3])part->pos,
                                   .pos_lo = (const uint8_t(*)[3])part->pos_lo,
                                   .tri = (const uint16_t(*)[3])part->tri,
                                   .normal = (const zs_q1_15(*)[3])part->normal,
                                   .face_normal = (const zs_q1_15(*)[3])part->face_normal,
                                   .vertex_rgb = part->vertex_rgb,
                                   .face_rgb = part->face_rgb,
                                   .face_raw = part->face_raw,
                                   .n_verts = b->n_verts,
                                   .n_tris = b->n_tris,
                                   .scale = (zs_uq16_16)(b->scale * 65536.0) };
    fill_vertices(b, part);
    fill_faces(b, part);
    fill_sphere(b, part);
    s->n_verts += b->n_verts;
    b->first += b->n_tris;
    b->n_tris = b->n_verts = b->tri_room = 0;
    b->tri = NULL;
    memset(b->slot, 0, SLOTS * sizeof *b->slot);
}

static void build_parts(struct build *b)
{
    b->slot = sim_alloc(SLOTS, sizeof *b->slot);
    b->key = sim_alloc(PART_VERTS_MAX, sizeof *b->key);
    for (uint32_t t = 0; t < b->model->n_tris; t++) {
        if (!add_triangle(b, t)) {
            finish_part(b);
            (void)add_triangle(b, t);
        }
        if (t % 4096 == 0)
            sim_progress("quantising", t, b->model->n_tris);
    }
    finish_part(b);
    free(b->slot);
    free(b->key);
}

/* Parts do not move any more: point at them. */
static void build_instances(struct sim_scene *s)
{
    s->instance = sim_alloc(s->n_parts, sizeof *s->instance);
    for (uint32_t i = 0; i < s->n_parts; i++) {
        s->instance[i].mesh = &s->part[i].mesh;
        s->instance[i].material = &s->material;
        zs_pose_identity(&s->instance[i].pose);
    }
    s->scene.instance = s->instance;
    s->scene.n_instances = s->n_parts;
}

int sim_scene_build(struct sim_scene *out, const struct sim_model *model,
                    const struct sim_view *view, const struct sim_options *o)
{
    struct grid grid;
    int units_log2 = 0;
    memset(out, 0, sizeof *out);
    choose_grid(&grid, model);
    memcpy(out->origin, grid.origin, sizeof out->origin);
    out->step = grid.step;
    int status = choose_unit(out, &units_log2, model, view);
    if (status == SIM_OK)
        status = build_camera(out, view, model->file);
    if (status != SIM_OK)
        return status;
    build_light(out, view, o);
    out->material.shader = o->shade == SIM_SHADE_ID     ? &zs_shade_raw
                           : o->shade == SIM_SHADE_FLAT ? &zs_shade_flat
                                                        : &zs_shade_smooth;
    out->material.rgb = (struct zs_rgb){ 204, 204, 204 };
    out->material.cull = (uint8_t)o->cull;
    struct build b = { .scene = out, .model = model, .grid = &grid,
                       .smooth = o->shade == SIM_SHADE_SMOOTH, .scale = ldexp(1.0, units_log2) };
    build_parts(&b);
    if (out->n_parts > UINT16_MAX) {
        status = sim_refuse(model->file, 0, "%u parts of 65535 vertices; the renderer takes %u",
                            out->n_parts, UINT16_MAX);
        sim_scene_free(out);
        return status;
    }
    build_instances(out);
    return SIM_OK;
}

void sim_scene_free(struct sim_scene *scene)
{
    for (uint32_t i = 0; i < scene->n_parts; i++) {
        struct sim_part *p = &scene->part[i];
        free(p->pos);
        free(p->pos_lo);
        free(p->tri);
        free(p->normal);
        free(p->face_normal);
        free(p->vertex_rgb);
        free(p->face_rgb);
        free(p->face_raw);
    }
    free(scene->part);
    free(scene->instance);
    memset(scene, 0, sizeof *scene);
}
