/* A group as pieces: place its corners on the grid, join what is equal, cut in two until no piece has more than 65535
 * vertices, sort each piece.
 *
 * SPDX-License-Identifier: MIT
 */
#include "mesh_work.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cluster.h"
#include "hierarchy.h"
#include "sim.h"
#include "vec.h"

#define PIECE_VERTS_MAX 65535u
#define STACK_MAX 64
#define TEXELS_OFF_MAX 0.5
#define DEGREES (180.0 / 3.14159265358979323846)

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

int sim_group_cut(struct work *w, uint32_t group)
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
