/* From a model to pieces: group triangles by material, place their corners on the grid, join what
 * is equal, cut groups of more than 65535 vertices in two until none is left, sort each piece.
 *
 * Untextured triangles of several colours can be one mesh with a colour a vertex or face, or a mesh
 * a colour; what takes less is chosen.
 *
 * SPDX-License-Identifier: MIT
 */
#include "mesh_pieces.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cluster.h"
#include "hierarchy.h"
#include "sim.h"
#include "vec.h"

#define PIECE_VERTS_MAX 65535u
#define COLORS_MAX 64u  /* meshes by colour: not more */
#define MESH_BYTES 152u /* a mesh, material and instance of its own, on a 32-bit machine */
#define STACK_MAX 64
#define TEXELS_OFF_MAX 0.5
#define DEGREES (180.0 / 3.14159265358979323846)

/* ---- Groups ---------------------------------------------------------------------------------- */

/* Triangles that share a material. */
struct group {
    struct sim_paint paint;
    uint32_t n_tris;
    uint32_t material; /* of its first triangle in the file */
    int same_material; /* flags: all of its triangles have that, and one colour */
    int same_rgb;
};

struct groups {
    struct group *at;
    uint32_t n;
    uint32_t *of; /* [model.n_tris], which; UINT32_MAX: left out */
};

/* What the work goes on, and where it goes to. */
struct work {
    const struct sim_model *model;
    const struct sim_steps *steps;
    const struct sim_convert_options *options;
    const uint32_t (*texture_size)[2];
    int32_t (*place)[3]; /* [model->n_points] */
    struct groups groups;
    struct sim_pieces *out;
};

static enum sim_shader shader_of(enum sim_look look, int textured)
{
    switch (look) {
    case SIM_LOOK_FLAT:
        return SIM_SHADER_FLAT;
    case SIM_LOOK_TEXTURED:
        return textured ? SIM_SHADER_TEXTURE_SMOOTH : SIM_SHADER_SMOOTH;
    case SIM_LOOK_TEXTURED_FLAT:
        return textured ? SIM_SHADER_TEXTURE_FLAT : SIM_SHADER_FLAT;
    case SIM_LOOK_UNLIT:
        return textured ? SIM_SHADER_TEXTURE : SIM_SHADER_RAW;
    case SIM_LOOK_RAW:
        return SIM_SHADER_RAW;
    case SIM_LOOK_SMOOTH:
    case SIM_LOOK_DEFAULT:
        break;
    }
    return SIM_SHADER_SMOOTH;
}

static int is_textured(enum sim_shader shader)
{
    return shader >= SIM_SHADER_TEXTURE;
}

static int has_normals(enum sim_shader shader)
{
    return shader == SIM_SHADER_SMOOTH || shader == SIM_SHADER_TEXTURE_SMOOTH;
}

static int same_rgb(struct zs_rgb a, struct zs_rgb b)
{
    return a.r == b.r && a.g == b.g && a.b == b.b;
}

/* The texture that a triangle will have, or SIM_NO_TEXTURE. */
static uint32_t texture_of(const struct work *w, uint32_t t)
{
    const enum sim_look look = (enum sim_look)w->options->look;
    if (look != SIM_LOOK_TEXTURED && look != SIM_LOOK_TEXTURED_FLAT && look != SIM_LOOK_UNLIT)
        return SIM_NO_TEXTURE;
    return sim_model_texture(w->model, t) != NULL ? w->model->material[w->model->tri_material[t]].texture
                                                  : SIM_NO_TEXTURE;
}

/* The colour of a triangle where its shader knows one; *whole is cleared where its corners differ.
 * */
static struct zs_rgb color_of(const struct work *w, uint32_t t, enum sim_shader shader, int *whole)
{
    const struct zs_rgb *c = w->model->rgb[t];
    if (shader == SIM_SHADER_SMOOTH && !(same_rgb(c[0], c[1]) && same_rgb(c[0], c[2])))
        *whole = 0;
    return shader == SIM_SHADER_SMOOTH ? c[0] : sim_model_face_rgb(w->model, t);
}

static int same_light(const struct sim_paint *a, const struct sim_paint *b)
{
    return a->lit == b->lit && a->power == b->power && a->two_sided == b->two_sided &&
           same_rgb(a->specular, b->specular) && same_rgb(a->emission, b->emission);
}

static uint32_t find_group(struct groups *g, const struct sim_paint *paint, int by_color)
{
    for (uint32_t i = 0; i < g->n; i++)
        if (g->at[i].paint.texture == paint->texture && g->at[i].paint.shader == paint->shader &&
            g->at[i].paint.cull == paint->cull && g->at[i].paint.alpha_mode == paint->alpha_mode &&
            g->at[i].paint.alpha == paint->alpha && same_light(&g->at[i].paint, paint) &&
            (!by_color || is_textured(paint->shader) || same_rgb(g->at[i].paint.rgb, paint->rgb)))
            return i;
    g->at = sim_grow(g->at, (size_t)g->n + 1, sizeof *g->at);
    g->at[g->n] = (struct group){ .paint = *paint, .material = UINT32_MAX, .same_material = 1, .same_rgb = 1 };
    return g->n++;
}

/* No area on the grid: exact. */
static int is_flat(const struct work *w, const uint32_t tri[3])
{
    int64_t a[3], b[3]; /* < 2^24 */
    for (int k = 0; k < 3; k++) {
        a[k] = w->place[tri[1]][k] - w->place[tri[0]][k];
        b[k] = w->place[tri[2]][k] - w->place[tri[0]][k];
    }
    return a[1] * b[2] == a[2] * b[1] && a[2] * b[0] == a[0] * b[2] && a[0] * b[1] == a[1] * b[0];
}

/* Blending costs more than a test, and that more than neither: where a material does not need it, it has none. */
static void set_alpha(const struct work *w, struct sim_paint *paint, const struct sim_material *material)
{
    const int textured = paint->texture != SIM_NO_TEXTURE && !w->options->opaque;
    const uint8_t texels = textured ? w->model->texture[paint->texture].alpha_mode : SIM_ALPHA_OPAQUE;
    paint->alpha = material->alpha_mode == SIM_ALPHA_BLEND && !w->options->opaque ? material->alpha : 255;
    paint->alpha_mode = paint->alpha < 255 ? SIM_ALPHA_BLEND : texels;
}

/* Highlights and emission, where there is a shader for them. */
static void set_light(const struct work *w, struct sim_paint *paint, const struct sim_material *material)
{
    const struct zs_rgb none = { 0, 0, 0 };
    const int smooth = paint->shader == SIM_SHADER_SMOOTH;
    const int flat = paint->shader == SIM_SHADER_FLAT && !w->options->no_face_normals;
    if (w->options->opaque || paint->alpha_mode != SIM_ALPHA_OPAQUE || !(smooth || flat) ||
        (material->power == 0 && same_rgb(material->emission, none)))
        return;
    paint->lit = 1;
    paint->two_sided = material->two_sided;
    paint->power = material->power;
    paint->specular = material->specular;
    paint->emission = material->emission;
}

/* How a triangle is drawn, but for its colour. */
static struct sim_paint paint_of(const struct work *w, uint32_t t)
{
    const uint32_t texture = texture_of(w, t);
    const struct sim_material *material = &w->model->material[w->model->tri_material[t]];
    const enum sim_look look = w->options->by_material && material->unlit ? SIM_LOOK_UNLIT
                                                                          : (enum sim_look)w->options->look;
    struct sim_paint paint = { .shader = shader_of(look, texture != SIM_NO_TEXTURE),
                               .texture = texture,
                               .rgb = { 255, 255, 255 } };
    paint.cull = (uint8_t)(material->two_sided && w->options->cull == ZS_CULL_BACK ? ZS_CULL_NONE : w->options->cull);
    set_alpha(w, &paint, material);
    set_light(w, &paint, material);
    return paint;
}

static void add_to_group(struct work *w, uint32_t t, int by_color, int *whole)
{
    struct sim_paint paint = paint_of(w, t);
    int triangle_whole = 1;
    if (!is_textured(paint.shader))
        paint.rgb = color_of(w, t, paint.shader, &triangle_whole);
    const uint32_t n = find_group(&w->groups, &paint, by_color);
    struct group *g = &w->groups.at[n];
    g->same_rgb = g->same_rgb && triangle_whole && same_rgb(g->paint.rgb, paint.rgb);
    g->same_material = g->same_material && (g->material == UINT32_MAX || g->material == w->model->tri_material[t]);
    g->material = w->model->tri_material[t];
    g->n_tris++;
    w->groups.of[t] = n;
    *whole = *whole && triangle_whole;
}

/* 0: by colour is impossible, or not worth trying. */
static int make_groups(struct work *w, int by_color)
{
    const struct sim_model *model = w->model;
    int whole = 1;
    w->groups = (struct groups){ .of = sim_alloc(model->n_tris, sizeof *w->groups.of) };
    w->out->n_flat = w->out->n_flat_before = 0;
    for (uint32_t t = 0; t < model->n_tris; t++) {
        w->groups.of[t] = UINT32_MAX;
        if (is_flat(w, model->tri[t])) {
            double n[3];
            sim_model_face_normal(model, t, n);
            w->out->n_flat++;
            w->out->n_flat_before += sim_dot(n, n) < 0.5;
            continue;
        }
        add_to_group(w, t, by_color, &whole);
        if (by_color && (!whole || w->groups.n > COLORS_MAX + model->n_textures))
            return 0;
    }
    for (uint32_t i = 0; i < w->groups.n; i++) {
        struct group *g = &w->groups.at[i];
        g->paint.name = g->same_material ? model->material[g->material].name : "";
    }
    return 1;
}

static void free_groups(struct groups *g)
{
    free(g->at);
    free(g->of);
    memset(g, 0, sizeof *g);
}

/* ---- Texture coordinates --------------------------------------------------------------------- */

/* How a group's coordinates become integers: rint((uv + shift) * 2^bits). */
struct fold {
    double shift[2]; /* whole pictures, on axes that repeat */
    uint8_t bits;
    uint8_t by_triangle; /* flag: each triangle is first brought to 0 .. 1 and up there, which splits vertices */
};

/* A coordinate before the shift. */
static double placed(const struct work *w, const struct fold *fold, const struct sim_texture *texture, uint32_t t,
                     int k, int axis)
{
    const double(*uv)[2] = (const double(*)[2])w->model->uv[t];
    if (!fold->by_triangle || (texture->clamp & (axis == 0 ? ZS_CLAMP_U : ZS_CLAMP_V)))
        return uv[k][axis];
    return uv[k][axis] - floor(fmin(uv[0][axis], fmin(uv[1][axis], uv[2][axis])));
}

/* Shifts and bits; how far off, in texels, coordinates then are at most. INFINITY: 16 bits do not hold them. */
static double fit_fold(const struct work *w, uint32_t group, struct fold *fold, double lo[2], double hi[2])
{
    const struct sim_model *model = w->model;
    const uint32_t n = w->groups.at[group].paint.texture, *size = w->texture_size[n];
    const struct sim_texture *texture = &model->texture[n];
    double most = 0.0;
    for (int axis = 0; axis < 2; axis++) {
        lo[axis] = INFINITY;
        hi[axis] = -INFINITY;
        for (uint32_t t = 0; t < model->n_tris; t++)
            for (int k = 0; w->groups.of[t] == group && k < 3; k++) {
                lo[axis] = fmin(lo[axis], placed(w, fold, texture, t, k, axis));
                hi[axis] = fmax(hi[axis], placed(w, fold, texture, t, k, axis));
            }
        const int clamps = texture->clamp & (axis == 0 ? ZS_CLAMP_U : ZS_CLAMP_V);
        fold->shift[axis] = clamps ? 0.0 : -rint((lo[axis] + hi[axis]) / 2.0 - 0.01); /* 0 .. 1 stays */
        most = fmax(most, fmax(fabs(lo[axis] + fold->shift[axis]), fabs(hi[axis] + fold->shift[axis])));
    }
    fold->bits = 15;
    while (fold->bits > 0 && rint(ldexp(most, fold->bits)) > INT16_MAX)
        fold->bits--;
    if (rint(ldexp(most, fold->bits)) > INT16_MAX)
        return INFINITY;
    return ldexp((double)(size[0] > size[1] ? size[0] : size[1]), -fold->bits - 1);
}

static int find_fold(const struct work *w, uint32_t group, struct fold *fold)
{
    const uint32_t *size = w->texture_size[w->groups.at[group].paint.texture];
    double lo[2], hi[2];
    for (fold->by_triangle = 0; fold->by_triangle < 2; fold->by_triangle++)
        if (fit_fold(w, group, fold, lo, hi) <= TEXELS_OFF_MAX)
            return SIM_OK;
    return sim_refuse(w->model->file, 0,
                      "texture coordinates of a face run from %.4g,%.4g to %.4g,%.4g: 16 bits hold %u x %u texels "
                      "%.3g times over; repeat the picture less often, or make it smaller (--texture-size)",
                      lo[0], lo[1], hi[0], hi[1], size[0], size[1],
                      INT16_MAX / (double)(size[0] > size[1] ? size[0] : size[1]));
}

/* ---- Vertices -------------------------------------------------------------------------------- */

/* What makes two corners one vertex. Without padding, compared byte by byte. */
struct corner {
    int32_t fine[3];
    zs_q1_15 normal[3];
    int16_t uv[2];
    uint8_t rgb[6]; /* three, and zeroes */
};
_Static_assert(sizeof(struct corner) == 28, "no padding");

/* A group while it is built. */
struct shape {
    const struct group *group;
    uint32_t paint; /* its number in the output */
    struct fold fold;
    struct corner *corner; /* [n_corners], different ones */
    uint32_t (*tri)[3];    /* [group->n_tris], into corner */
    uint32_t *source;      /* [group->n_tris] */
    uint32_t n_corners;
};

static zs_q1_15 to_q15(double v)
{
    return (zs_q1_15)fmin(fmax(rint(v * 32768.0), -32767.0), 32767.0);
}

/* The angle between a stored normal and the one it stands for, degrees. */
static double angle_between(const zs_q1_15 stored[3], const double n[3])
{
    const double s[3] = { stored[0], stored[1], stored[2] };
    double c[3];
    sim_cross(c, s, n);
    return atan2(sqrt(sim_dot(c, c)), sim_dot(s, n)) * DEGREES;
}

static void take_uv(struct work *w, const struct shape *s, uint32_t t, int k, int16_t out[2])
{
    const uint32_t texture = s->group->paint.texture;
    for (int axis = 0; axis < 2; axis++) {
        const double exact = placed(w, &s->fold, &w->model->texture[texture], t, k, axis) + s->fold.shift[axis];
        out[axis] = (int16_t)rint(ldexp(exact, s->fold.bits));
        const double off = fabs(exact - ldexp(out[axis], -s->fold.bits)) * w->texture_size[texture][axis];
        w->out->uv_error[texture] = fmax(w->out->uv_error[texture], off);
    }
}

static struct corner corner_of(struct work *w, const struct shape *s, uint32_t t, int k)
{
    const struct sim_model *model = w->model;
    const struct sim_paint *paint = &s->group->paint;
    struct corner c;
    memset(&c, 0, sizeof c);
    memcpy(c.fine, w->place[model->tri[t][k]], sizeof c.fine);
    if (has_normals(paint->shader)) {
        double n[3];
        for (int i = 0; i < 3; i++) {
            n[i] = (double)model->normal[t][k][i];
            c.normal[i] = to_q15(n[i]);
        }
        w->out->normal_error = fmax(w->out->normal_error, angle_between(c.normal, n));
    }
    if (is_textured(paint->shader))
        take_uv(w, s, t, k, c.uv);
    if (paint->shader == SIM_SHADER_SMOOTH && !s->group->same_rgb)
        memcpy(c.rgb, &model->rgb[t][k], 3);
    return c;
}

static uint32_t hash_of(const struct corner *c)
{
    uint32_t word[sizeof *c / 4], h = 0;
    memcpy(word, c, sizeof word);
    for (size_t i = 0; i < sizeof word / sizeof word[0]; i++) {
        h = (h ^ word[i]) * 2654435761u;
        h ^= h >> 15;
    }
    return h;
}

/* Fill corner, tri and source. */
static void join(struct work *w, struct shape *s, uint32_t group)
{
    const uint32_t n = s->group->n_tris;
    uint32_t mask = 15, filled = 0;
    while (mask / 2 < 3 * (uint64_t)n && mask < UINT32_MAX)
        mask = 2 * mask + 1;
    uint32_t *slot = sim_alloc((size_t)mask + 1, sizeof *slot);
    s->corner = sim_alloc(3 * (size_t)n, sizeof *s->corner);
    s->tri = sim_alloc(n, sizeof *s->tri);
    s->source = sim_alloc(n, sizeof *s->source);
    for (uint32_t t = 0; t < w->model->n_tris; t++) {
        for (int k = 0; w->groups.of[t] == group && k < 3; k++) {
            const struct corner c = corner_of(w, s, t, k);
            uint32_t i = hash_of(&c) & mask;
            while (slot[i] != 0 && memcmp(&s->corner[slot[i] - 1], &c, sizeof c) != 0)
                i = (i + 1) & mask;
            if (slot[i] == 0) {
                s->corner[s->n_corners] = c;
                slot[i] = ++s->n_corners;
            }
            s->tri[filled][k] = slot[i] - 1;
        }
        if (w->groups.of[t] == group)
            s->source[filled++] = t;
        if (t % 4096 == 0)
            sim_progress("joining vertices", t, w->model->n_tris);
    }
    free(slot);
}

/* ---- Pieces ---------------------------------------------------------------------------------- */

static void copy_vertices(struct sim_piece *p, const struct shape *s, const uint32_t *from)
{
    const enum sim_shader shader = s->group->paint.shader;
    p->fine = sim_alloc(p->n_verts, sizeof *p->fine);
    p->normal = has_normals(shader) ? sim_alloc(p->n_verts, sizeof *p->normal) : NULL;
    p->uv = is_textured(shader) ? sim_alloc(p->n_verts, sizeof *p->uv) : NULL;
    p->vertex_rgb = shader == SIM_SHADER_SMOOTH && !s->group->same_rgb ? sim_alloc(p->n_verts, sizeof *p->vertex_rgb)
                                                                       : NULL;
    for (uint32_t v = 0; v < p->n_verts; v++) {
        const struct corner *c = &s->corner[from[v]];
        memcpy(p->fine[v], c->fine, sizeof c->fine);
        if (p->normal != NULL)
            memcpy(p->normal[v], c->normal, sizeof c->normal);
        if (p->uv != NULL)
            memcpy(p->uv[v], c->uv, sizeof c->uv);
        if (p->vertex_rgb != NULL)
            memcpy(&p->vertex_rgb[v], c->rgb, sizeof p->vertex_rgb[v]);
    }
}

/* A face's normal, from the model; from the grid where the model gives it no area. */
static void face_normal(const struct work *w, uint32_t t, double n[3])
{
    const uint32_t *tri = w->model->tri[t];
    double a[3], b[3];
    sim_model_face_normal(w->model, t, n);
    if (sim_dot(n, n) > 0.5)
        return;
    for (int k = 0; k < 3; k++) {
        a[k] = w->place[tri[1]][k] - w->place[tri[0]][k];
        b[k] = w->place[tri[2]][k] - w->place[tri[0]][k];
    }
    sim_cross(n, a, b);
    (void)sim_unit(n);
}

static void copy_faces(struct work *w, struct sim_piece *p, const struct shape *s)
{
    const enum sim_shader shader = s->group->paint.shader;
    const int lit = shader == SIM_SHADER_FLAT || shader == SIM_SHADER_TEXTURE_FLAT;
    const int varies = !s->group->same_rgb;
    if (lit && !w->options->no_face_normals)
        p->face_normal = sim_alloc(p->n_tris, sizeof *p->face_normal);
    if (shader == SIM_SHADER_FLAT && varies)
        p->face_rgb = sim_alloc(p->n_tris, sizeof *p->face_rgb);
    if (shader == SIM_SHADER_RAW && varies)
        p->face_raw = sim_alloc(p->n_tris, sizeof *p->face_raw);
    for (uint32_t i = 0; i < p->n_tris; i++) {
        const struct zs_rgb c = sim_model_face_rgb(w->model, p->source[i]);
        if (p->face_rgb != NULL)
            p->face_rgb[i] = c;
        if (p->face_raw != NULL)
            p->face_raw[i] = zs_rgb565(c.r, c.g, c.b);
        if (p->face_normal == NULL)
            continue;
        double n[3];
        face_normal(w, p->source[i], n);
        for (int k = 0; k < 3; k++)
            p->face_normal[i][k] = to_q15(n[k]);
        w->out->normal_error = fmax(w->out->normal_error, angle_between(p->face_normal[i], n));
    }
}

/* Number the vertices of some triangles from 0. tri [n]; from, filled: number -> the shape's
 * corner. */
static uint32_t number(uint32_t (*tri)[3], uint32_t *from, const struct shape *s, const uint32_t *list, uint32_t n,
                       uint32_t *slot)
{
    uint32_t n_verts = 0;
    for (uint32_t i = 0; i < n; i++)
        for (int k = 0; k < 3; k++) {
            const uint32_t c = s->tri[list[i]][k];
            if (slot[c] == 0) {
                from[n_verts] = c;
                slot[c] = ++n_verts;
            }
            tri[i][k] = slot[c] - 1;
        }
    for (uint32_t v = 0; v < n_verts; v++)
        slot[from[v]] = 0;
    return n_verts;
}

/* Sort a piece's triangles: tri and list are permuted, its clusters filled. */
static void sort_piece(struct work *w, struct sim_piece *p, const struct shape *s, uint32_t (*tri)[3], uint32_t *list,
                       const uint32_t *from)
{
    int32_t(*fine)[3] = sim_alloc(p->n_verts, sizeof *fine);
    uint32_t *order = sim_alloc(p->n_tris, sizeof *order);
    uint32_t(*old)[3] = sim_alloc(p->n_tris, sizeof *old), *old_list = sim_alloc(p->n_tris, sizeof *old_list);
    for (uint32_t v = 0; v < p->n_verts; v++)
        memcpy(fine[v], s->corner[from[v]].fine, sizeof *fine);
    memcpy(old, tri, p->n_tris * sizeof *old);
    memcpy(old_list, list, p->n_tris * sizeof *old_list);
    const struct sim_shape shape = { (const int32_t(*)[3])fine, (const uint32_t(*)[3])old, p->n_verts, p->n_tris };
    p->cluster = sim_cluster(order, &p->n_clusters, &shape, s->group->paint.cull == ZS_CULL_BACK);
    if (w->options->bvh)
        p->bvh = sim_hierarchy(&p->n_nodes, order, p->cluster, p->n_clusters, &shape);
    for (uint32_t i = 0; i < p->n_tris; i++) {
        memcpy(tri[i], old[order[i]], sizeof *tri);
        list[i] = old_list[order[i]];
    }
    sim_sphere(p->center, &p->radius, (const int32_t(*)[3])fine, p->n_verts);
    SIM_FREE(fine, order, old, old_list);
}

/* A piece from the triangles of a list; slot: all zero, and again afterwards. */
static void make_piece(struct work *w, const struct shape *s, uint32_t *list, uint32_t n, uint32_t *slot)
{
    struct sim_pieces *out = w->out;
    struct sim_piece p = { .paint = s->paint, .n_tris = n, .uv_bits = s->fold.bits };
    uint32_t(*tri)[3] = sim_alloc(n, sizeof *tri), *from = sim_alloc(3 * (size_t)n, sizeof *from);
    p.n_verts = number(tri, from, s, list, n, slot);
    uint32_t *remap = sim_alloc(p.n_verts, sizeof *remap), *now = sim_alloc(p.n_verts, sizeof *now);
    sort_piece(w, &p, s, tri, list, from);
    (void)sim_use_order(remap, (const uint32_t(*)[3])tri, n, p.n_verts);
    p.tri = sim_alloc(n, sizeof *p.tri);
    p.source = sim_alloc(n, sizeof *p.source);
    for (uint32_t i = 0; i < n; i++) {
        for (int k = 0; k < 3; k++)
            p.tri[i][k] = (uint16_t)remap[tri[i][k]];
        p.source[i] = s->source[list[i]];
    }
    for (uint32_t v = 0; v < p.n_verts; v++)
        now[remap[v]] = from[v];
    copy_vertices(&p, s, now);
    copy_faces(w, &p, s);
    SIM_FREE(tri, from, remap, now);
    out->piece = sim_grow(out->piece, (size_t)out->n_pieces + 1, sizeof *out->piece);
    out->piece[out->n_pieces++] = p;
    out->n_verts += p.n_verts;
    out->n_tris += n;
}

static uint32_t count_vertices(const struct shape *s, const uint32_t *list, uint32_t n, uint32_t *slot)
{
    uint32_t n_verts = 0;
    for (uint32_t i = 0; i < n; i++)
        for (int k = 0; k < 3; k++)
            n_verts += slot[s->tri[list[i]][k]]++ == 0;
    for (uint32_t i = 0; i < n; i++)
        for (int k = 0; k < 3; k++)
            slot[s->tri[list[i]][k]] = 0;
    return n_verts;
}

struct ranked {
    int64_t along;
    uint32_t tri;
};

static int by_rank(const void *a, const void *b)
{
    const struct ranked *x = a, *y = b;
    return x->along != y->along ? (x->along < y->along ? -1 : 1) : x->tri < y->tri ? -1 : x->tri > y->tri;
}

/* Three times the middle of a triangle, along an axis. */
static int64_t middle(const struct shape *s, uint32_t t, int axis)
{
    int64_t sum = 0;
    for (int k = 0; k < 3; k++)
        sum += s->corner[s->tri[t][k]].fine[axis];
    return sum;
}

/* Sort a list along the axis on which its triangles are spread most, so that it can be cut in two.
 * */
static void spread(const struct shape *s, uint32_t *list, uint32_t n)
{
    int64_t most = -1;
    int axis = 0;
    for (int k = 0; k < 3; k++) {
        int64_t lo = INT64_MAX, hi = INT64_MIN;
        for (uint32_t i = 0; i < n; i++) {
            const int64_t m = middle(s, list[i], k);
            lo = m < lo ? m : lo;
            hi = m > hi ? m : hi;
        }
        if (hi - lo > most) {
            most = hi - lo;
            axis = k;
        }
    }
    struct ranked *rank = sim_alloc(n, sizeof *rank);
    for (uint32_t i = 0; i < n; i++)
        rank[i] = (struct ranked){ middle(s, list[i], axis), list[i] };
    qsort(rank, n, sizeof *rank, by_rank);
    for (uint32_t i = 0; i < n; i++)
        list[i] = rank[i].tri;
    free(rank);
}

/* All pieces of a shape. The stack stands in for recursion: each cut halves a list of less than
 * 2^31. */
static void cut(struct work *w, const struct shape *s)
{
    struct {
        uint32_t first, n;
    } stack[STACK_MAX];
    const uint32_t n_tris = s->group->n_tris;
    uint32_t *list = sim_alloc(n_tris, sizeof *list), *slot = sim_alloc(s->n_corners, sizeof *slot);
    int depth = 1;
    for (uint32_t t = 0; t < n_tris; t++)
        list[t] = t;
    stack[0].first = 0;
    stack[0].n = n_tris;
    while (depth > 0) {
        const uint32_t first = stack[--depth].first, n = stack[depth].n;
        if (s->n_corners <= PIECE_VERTS_MAX || count_vertices(s, list + first, n, slot) <= PIECE_VERTS_MAX) {
            make_piece(w, s, list + first, n, slot);
            continue;
        }
        spread(s, list + first, n);
        stack[depth].first = first + n / 2; /* the second half waits */
        stack[depth++].n = n - n / 2;
        stack[depth].first = first;
        stack[depth++].n = n / 2;
    }
    free(list);
    free(slot);
}

/* ---- All of it ------------------------------------------------------------------------------- */

static int make_group(struct work *w, uint32_t group)
{
    struct sim_pieces *out = w->out;
    struct shape s = { .group = &w->groups.at[group], .paint = out->n_paints };
    int status = SIM_OK;
    out->paint = sim_grow(out->paint, (size_t)out->n_paints + 1, sizeof *out->paint);
    out->paint[out->n_paints++] = s.group->paint;
    if (is_textured(s.group->paint.shader))
        status = find_fold(w, group, &s.fold);
    if (status == SIM_OK) {
        join(w, &s, group);
        cut(w, &s);
    }
    SIM_FREE(s.corner, s.tri, s.source);
    return status;
}

/* One way of grouping. *done is 0 where it is none. */
static int make_all(struct work *w, int by_color, int *done)
{
    struct sim_pieces *out = w->out;
    int status = SIM_OK;
    out->normal_error = -1.0;
    out->uv_error = sim_alloc(w->model->n_textures, sizeof *out->uv_error);
    for (uint32_t i = 0; i < w->model->n_textures; i++)
        out->uv_error[i] = -1.0;
    *done = make_groups(w, by_color);
    for (uint32_t i = 0; *done && status == SIM_OK && i < w->groups.n; i++)
        status = make_group(w, i);
    if (status == SIM_OK && *done && out->n_tris == 0)
        status = sim_refuse(w->model->file, 0,
                            "none of its %u triangles has an area on a grid of %g; give --precise, or repair it",
                            w->model->n_tris, w->steps->fine ? w->steps->step / 256.0 : w->steps->step);
    return status;
}

static void measure_places(struct work *w)
{
    double squared = 0.0;
    w->place = sim_alloc(w->model->n_points, sizeof *w->place);
    for (uint32_t i = 0; i < w->model->n_points; i++) {
        double back[3], d[3];
        sim_steps_place(w->place[i], w->steps, w->model->point[i]);
        sim_steps_position(back, w->steps, (const int32_t *)w->place[i]);
        sim_sub(d, back, w->model->point[i]);
        const double off = w->steps->exact ? 0.0 : sim_dot(d, d);
        squared += off;
        w->out->error_max = fmax(w->out->error_max, sqrt(off));
    }
    w->out->error_rms = sqrt(squared / w->model->n_points);
}

/* What of a triangle's material is not drawn, of that which the loader has read. */
static void lose_of(const struct work *w, const struct sim_material *m, const struct sim_paint *paint,
                    struct sim_lost *lost)
{
    const struct zs_rgb none = { 0, 0, 0 };
    if (m->two_sided && !paint->lit && paint->shader != SIM_SHADER_RAW && paint->shader != SIM_SHADER_TEXTURE)
        sim_lose(lost, SIM_LOST_TWO_SIDED, m->name);
    if (m->alpha_mode != SIM_ALPHA_OPAQUE && w->options->opaque)
        sim_lose(lost, SIM_LOST_OPACITY, m->name);
    if (m->power > 0 && !paint->lit)
        sim_lose(lost, SIM_LOST_SPECULAR, m->name);
    if (!same_rgb(m->emission, none) && !paint->lit)
        sim_lose(lost, SIM_LOST_EMISSION, m->name);
}

/* By the first triangle of each material; vertex colours by all. Those left out for having no area count. */
static void count_losses(struct work *w)
{
    const struct sim_model *model = w->model;
    struct sim_lost *lost = w->out->lost;
    uint8_t *seen = sim_alloc(model->n_materials, 1);
    memcpy(lost, model->lost, sizeof w->out->lost);
    for (uint32_t t = 0; t < model->n_tris; t++) {
        const uint32_t n = model->tri_material[t];
        const struct sim_material *m = &model->material[n];
        const struct sim_paint paint = paint_of(w, t);
        if (!(seen[n] & 2) && is_textured(paint.shader) &&
            !(same_rgb(model->rgb[t][0], m->rgb) && same_rgb(model->rgb[t][1], m->rgb) &&
              same_rgb(model->rgb[t][2], m->rgb))) {
            sim_lose(lost, SIM_LOST_VERTEX_COLOR, m->name);
            seen[n] |= 2;
        }
        if (!(seen[n] & 1))
            lose_of(w, m, &paint, lost);
        seen[n] |= 1;
    }
    free(seen);
}

enum sim_form sim_paint_form(const struct sim_paint *paint)
{
    return paint->lit ? SIM_FORM_LIT : paint->alpha_mode == SIM_ALPHA_BLEND ? SIM_FORM_BLEND : SIM_FORM_MATERIAL;
}

uint32_t sim_paint_powers(uint8_t power[128], const struct sim_pieces *pieces)
{
    uint32_t n = 0;
    for (unsigned p = 1; p <= 128; p++)
        for (uint32_t i = 0; i < pieces->n_paints; i++)
            if (pieces->paint[i].power == p) {
                power[n++] = (uint8_t)p;
                break;
            }
    return n;
}

static size_t total(const struct sim_pieces *p, int fine)
{
    struct sim_flash f;
    sim_pieces_flash(&f, p, fine);
    return f.pos + f.pos_lo + f.tri + f.normal + f.face_normal + f.uv + f.rgb + f.cluster + f.bvh +
           (size_t)p->n_pieces * MESH_BYTES;
}

/* Do untextured triangles have more than one colour, so that there is a choice? */
static int has_choice(const struct work *w)
{
    for (uint32_t i = 0; i < w->groups.n; i++)
        if (!w->groups.at[i].same_rgb && !is_textured(w->groups.at[i].paint.shader))
            return 1;
    return 0;
}

int sim_pieces_make(struct sim_pieces *out, const struct sim_model *model, const struct sim_steps *steps,
                    const struct sim_convert_options *o, const uint32_t (*texture_size)[2])
{
    struct sim_pieces by_color = { 0 };
    struct work w = { .model = model, .steps = steps, .options = o, .texture_size = texture_size, .out = out };
    int done = 0;
    memset(out, 0, sizeof *out);
    measure_places(&w);
    by_color.error_max = out->error_max;
    by_color.error_rms = out->error_rms;
    int status = make_all(&w, 0, &done);
    const int choice = status == SIM_OK && has_choice(&w);
    free_groups(&w.groups);
    if (choice) {
        w.out = &by_color;
        status = make_all(&w, 1, &done);
        free_groups(&w.groups);
        if (status == SIM_OK && done && total(&by_color, steps->fine) < total(out, steps->fine)) {
            const struct sim_pieces larger = *out;
            *out = by_color;
            by_color = larger;
        }
        sim_pieces_free(&by_color);
    }
    free(w.place);
    w.out = out;
    if (status == SIM_OK)
        count_losses(&w);
    if (status != SIM_OK)
        sim_pieces_free(out);
    return status;
}

void sim_pieces_flash(struct sim_flash *sum, const struct sim_pieces *pieces, int fine)
{
    memset(sum, 0, sizeof *sum);
    for (uint32_t i = 0; i < pieces->n_pieces; i++) {
        const struct sim_piece *p = &pieces->piece[i];
        sum->pos += 6 * (size_t)p->n_verts;
        sum->pos_lo += fine ? 3 * (size_t)p->n_verts : 0;
        sum->tri += 6 * (size_t)p->n_tris;
        sum->normal += p->normal != NULL ? 6 * (size_t)p->n_verts : 0;
        sum->face_normal += p->face_normal != NULL ? 6 * (size_t)p->n_tris : 0;
        sum->uv += p->uv != NULL ? 4 * (size_t)p->n_verts : 0;
        sum->rgb += (p->vertex_rgb != NULL ? 3 * (size_t)p->n_verts : 0) +
                    (p->face_rgb != NULL ? 3 * (size_t)p->n_tris : 0) +
                    (p->face_raw != NULL ? 2 * (size_t)p->n_tris : 0);
        sum->cluster += 20 * (size_t)p->n_clusters; /* as every ABI lays it out */
        sum->bvh += 16 * (size_t)p->n_nodes;
    }
}

void sim_pieces_free(struct sim_pieces *pieces)
{
    for (uint32_t i = 0; i < pieces->n_pieces; i++) {
        struct sim_piece *p = &pieces->piece[i];
        SIM_FREE(p->fine, p->normal, p->face_normal, p->vertex_rgb, p->face_rgb, p->face_raw, p->uv, p->tri, p->source,
                 p->cluster, p->bvh);
    }
    SIM_FREE(pieces->piece, pieces->paint, pieces->uv_error);
    memset(pieces, 0, sizeof *pieces);
}
