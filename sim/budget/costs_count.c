/* Counting by looking on. Instances are copied, with materials and textures, so that what they name is ours: each of
 * our structs begins with the renderer's and knows the one that it stands for, and so do accelerators of their shaders
 * and texel formats. Rows and spans are found here, from a triangle's corners, whatever way it is drawn; their pixels
 * must be as many as the renderer says.
 *
 * SPDX-License-Identifier: MIT
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/rows.h"
#include "costs.h"
#include "frame.h"
#include "core/assemble.h"
#include "core/job.h"
#include "core/method.h"
#include "core/fast.h"
#include "core/xform.h"
#include "fast/parts.h"
#include "method/order.h"
#include "method/raycast.h"
#include "shade/texture.h"
#include "shader_table.h"
#include "sim.h"
#include "zs_blend.h"
#include "zs_filter.h"
#include "zs_lights.h"
#include "zs_method.h"
#include "zs_shader.h"
#include "zs_shadow.h"

#define SIM_COST_NAME(name, stage, what) { #name, stage, what },
const struct sim_cost_name sim_cost_names[SIM_COST_N] = { SIM_COSTS(SIM_COST_NAME) };

enum kind { KIND_SOLID, KIND_SMOOTH, KIND_TEXTURE };

struct our_shader {
    struct zs_shader shader;
    const struct zs_shader *of;
    enum kind kind;
    enum sim_cost vertex, face;
    const struct zs_shader *like; /* the shader whose stages an effect's are made of; NULL: this is none */
    int shines, blends;           /* flags: it has highlights; it is blended */
    int effect; /* flag: what the stages do not know; drawn in the general way, and its work counted */
    int begins; /* flag: how its runs begin is in what its vertices take */
    int own;    /* flag: leaves pixels out, and takes as long for them */
    struct sim_effect_work work;
};
struct our_texel {
    struct zs_texel texel;
    const struct zs_texel *of;
    const struct zs_fast_texel *fast_of; /* NULL: the list has none for it */
    enum sim_cost fetch, won;
};
struct our_fast {
    struct zs_fast fast;
    const struct zs_fast *of; /* NULL: the list has none for the shader */
};
struct thing { /* an instance's copies */
    struct our_shader shader;
    struct our_texel texel;
    struct our_fast fast;      /* of the shader ... */
    struct zs_fast texel_fast; /* ... and of the texel format */
    struct zs_fast_texel texel_hooks;
    union { /* as the shader takes it */
        struct zs_material material;
        struct zs_blend blend;
        struct zs_lit_material lit;
        struct zs_shadowed_material shadowed;
        struct zs_shadowed_lit shadowed_lit;
    } as;
    struct zs_texture texture;
};

struct shape {
    double rows, spans, px;
    int tilted; /* flag: keys differ */
    double edges, divided, divided64; /* edges taken up; of these, where a core without a divider divides; in 64 bits */
};

/* The frame in hand: callbacks that get texels alone know of no other way to it. */
static struct {
    struct zs_depth depth;
    const struct zs_depth *of;
    double *n;
    struct zs_renderer *r;
    uint64_t tested;  /* pixels found here */
    double setups;    /* counted here */
    uint32_t band_end, walks, checksum;
    const struct zs_fast_batch *batch_of; /* what `batch` stands for */
    struct zs_fast_batch batch;
    struct zs_fast batch_fast;
    struct binned { /* what it was handed, in the first walk, [0], and in the others */
        double instances, tris, boxed;
        double gathered; /* of tris: of meshes that were not transformed at once */
    } binned[2];
    uint32_t unpacked, band; /* when it met a full pool: vertices not packed yet, the band's end */
    const struct zs_job *job; /* whose run is coloured; NULL: none */
    const struct zs_shader *own; /* its shader, while it has another's stages called */
    uint8_t wide, huge; /* flags, of the triangle that was set up last: how its planes are found */
    uint8_t linear;    /* flag: keys are linear on the screen in this view */
    uint8_t lit;       /* flag: the small triangle in hand is drawn lit */
    uint8_t testing;   /* flag: the piece in hand is tested */
    uint8_t untouched;     /* flag: a triangle of this strip was drawn on untouched pixels */
    uint8_t tiles;     /* flag: triangles are asked what they hide */
    struct shape shape;  /* of the triangle that was set up last */
    zs_piece_fn *piece;  /* what on_piece stands for */
    struct zs_vertex cover[3]; /* the last triangle that hides others */
    double before[SIM_COST_N]; /* counts when the strip in hand began */
    double slowest[2][SIM_CORES]; /* what the slowest strip takes of what is counted while it is drawn: of strips that
                                     begin with a walk over the scene, [1], and of the others */
    struct zs_method method; /* ours, where the configuration has another than the depth buffer's ... */
    const struct zs_method *method_of; /* ... and what it stands for; NULL: the depth buffer */
    zs_piece_fn *method_span;          /* what on_method_span stands for */
    const struct zs_tri *method_tri;   /* the triangle whose rows it was handed last, and its last row */
    int32_t method_row;
    uint32_t sorted;                   /* zs_stats.sorted when a list was made last */
    uint32_t walk;     /* number of the walk, and of ... */
    uint32_t instance; /* ... the instance in hand, UINT32_MAX: none */
} now;

static struct our_shader *shader_of(const struct zs_shader *shader)
{
    return (struct our_shader *)(uintptr_t)shader;
}

static struct our_texel *texel_of(const struct zs_texel *texel)
{
    return (struct our_texel *)(uintptr_t)texel;
}

/* Of the shader in hand. */
static const struct our_fast *fast_of(const struct zs_job *job)
{
    return (const struct our_fast *)(const void *)job->fast;
}

/* ---- A triangle's rows in a strip --------------------------------------------------------------- */

/* The first sample at or beyond an edge from a to b, at the middle of a row; exact. */
static int32_t column(const struct zs_vertex *a, const struct zs_vertex *b, int32_t row)
{
    const int64_t dy = b->y - a->y, at = (int64_t)row * ZS_SUBPX_ONE + ZS_SUBPX_HALF - a->y;
    const int64_t top = (int64_t)(b->x - a->x) * at + (int64_t)(a->x - ZS_SUBPX_HALF) * dy, by = dy * ZS_SUBPX_ONE;
    return (int32_t)(top >= 0 ? (top + by - 1) / by : -(-top / by));
}

/* Rows of the edge from a down to b in [row, end), cut ZS_CUT_ROWS at a time from `first` on, as zs_edges_cut does
 * it. */
static void look_edge(struct shape *s, const struct zs_vertex *a, const struct zs_vertex *b, int32_t first, int32_t row,
                      int32_t end)
{
    const int32_t dx = b->x - a->x, dy = b->y - a->y;
    while (row < end) {
        const int below = row * ZS_SUBPX_ONE + ZS_SUBPX_HALF - a->y >= ZS_SUBPX_ONE, wide = dy >= 128 * ZS_SUBPX_ONE;
        s->edges++;
        s->divided += (zs_abs32(dx) > dy) + (below && !wide);
        s->divided64 += below && wide;
        row += ZS_CUT_ROWS - (row - first) % ZS_CUT_ROWS;
    }
}

static void look(struct shape *s, const struct zs_job *job)
{
    const struct zs_vertex *v[3];
    int32_t lo[2] = { INT32_MAX, INT32_MAX }, hi[2] = { INT32_MIN, INT32_MIN };
    memset(s, 0, sizeof *s);
    for (int k = 0; k < 3; k++) {
        v[k] = &job->r->vert[job->tri->v[k]];
        lo[0] = zs_min32(lo[0], v[k]->x);
        lo[1] = zs_min32(lo[1], v[k]->y);
        hi[0] = zs_max32(hi[0], v[k]->x);
        hi[1] = zs_max32(hi[1], v[k]->y);
    }
    s->tilted = v[0]->d != v[1]->d || v[0]->d != v[2]->d;
    const int32_t first = zs_max32(zs_first_sample(lo[1]), job->y0);
    const int32_t end = zs_min32(zs_first_sample(hi[1]), job->y1);
    for (int k = 0; k < 3; k++) {
        const struct zs_vertex *a = v[k], *b = v[(k + 1) % 3];
        const int down = a->y <= b->y;
        look_edge(s, down ? a : b, down ? b : a, first, zs_max32(first, zs_first_sample(down ? a->y : b->y)),
                  zs_min32(end, zs_first_sample(down ? b->y : a->y)));
    }
    for (int32_t row = first; row < end; row++) {
        int32_t x[2], n = 0;
        for (int k = 0; k < 3 && n < 2; k++) {
            const struct zs_vertex *a = v[k], *b = v[(k + 1) % 3];
            if (a->y > b->y) {
                const struct zs_vertex *t = a;
                a = b;
                b = t;
            }
            if (zs_first_sample(a->y) <= row && row < zs_first_sample(b->y))
                x[n++] = column(a, b, row);
        }
        s->rows++;
        if (n < 2)
            continue;
        const int32_t from = zs_max32(zs_min32(x[0], x[1]), 0), to = zs_min32(zs_max32(x[0], x[1]), job->width);
        if (from < to) {
            s->spans++;
            s->px += to - from;
        }
    }
}

/* ---- Looking on --------------------------------------------------------------------------------- */

/* The renderer that a stage is called by. */
static const struct zs_renderer *renderer_of(const struct zs_shading *s)
{
    return (const struct zs_renderer *)(const void *)((const char *)s - offsetof(struct zs_renderer, shading));
}

static void on_vertex(const struct zs_shading *shading, uint32_t v, uint16_t *out)
{
    struct our_shader *s = shader_of(shading->instance->material->shader);
    now.n[s->vertex]++;
    now.n[SIM_COST_lit_shine] += s->vertex == SIM_COST_lit_vertex && s->shines;
    s->work.vertices++;
    s->of->vertex(shading, v, out);
}

/* Strips all of whose rows lie in [row, end). */
static int32_t strips_within(const struct zs_renderer *r, int32_t row, int32_t end)
{
    const int32_t h = r->config.strip_h, height = r->config.height;
    const int32_t first = zs_max32((zs_max32(row, 0) + h - 1) / h, r->strip);
    const int32_t last = zs_min32(end >= height ? (height + h - 1) / h : end / h, r->draw_end);
    return last > first ? last - first : 0;
}

/* Has a triangle left bounds behind, as fast/tiles.c finds them? Those of a triangle that shares an edge with it are
 * found for both at once. */
static void count_cover(const struct zs_renderer *r)
{
    if (!r->large || !r->cover_known) /* else cover_next is not set yet */
        return;
    const struct zs_cover *last = &r->cover[!r->cover_next], *before = &r->cover[r->cover_next];
    if (memcmp(last->v, now.cover, sizeof now.cover) == 0)
        return;
    memcpy(now.cover, last->v, sizeof now.cover);
    now.n[SIM_COST_bound]++;
    const int32_t both = strips_within(r, last->done[0], last->done[1]);
    double strips = strips_within(r, zs_first_sample(last->v[0].y), zs_first_sample(last->v[2].y));
    if (both > 0 && last->done[0] == before->done[0] && last->done[1] == before->done[1])
        strips -= both; /* counted with the one before */
    now.n[SIM_COST_bound_strip] += strips;
}

/* An instance that is walked: the first that is seen of it. */
static void count_instance(const struct zs_renderer *r)
{
    if (now.instance == r->xform.number && now.walk == r->stats.passes)
        return;
    now.instance = r->xform.number;
    now.walk = r->stats.passes;
    now.n[SIM_COST_instance_asked] += r->large;
}

/* Is a triangle of the instance in hand 128 px wide or high? In a mesh that is transformed at once. */
static int is_large(const struct zs_renderer *r, uint32_t t)
{
    const uint16_t *index = r->xform.instance->mesh->tri[t];
    const struct zs_vertex *v = r->vert + r->vert_base;
    int32_t lo[2] = { INT32_MAX, INT32_MAX }, hi[2] = { INT32_MIN, INT32_MIN };
    for (int k = 0; k < 3; k++) {
        if (v[index[k]].d >= ZS_D_OUT)
            return 0; /* cut */
        lo[0] = zs_min32(lo[0], v[index[k]].x);
        lo[1] = zs_min32(lo[1], v[index[k]].y);
        hi[0] = zs_max32(hi[0], v[index[k]].x);
        hi[1] = zs_max32(hi[1], v[index[k]].y);
    }
    return hi[0] - lo[0] >= 2 * ZS_TINY || hi[1] - lo[1] >= 2 * ZS_TINY;
}

#define ASKED_WIDTH 160 /* frames up to so wide, meshes up to so many triangles: each triangle is asked what it hides */
#define ASKED_TRIS 40

static int all_asked(uint32_t width, const struct zs_mesh *mesh)
{
    return now.tiles && width <= ASKED_WIDTH && mesh->n_tris <= ASKED_TRIS;
}

static uint16_t on_face(const struct zs_shading *shading, uint32_t t)
{
    const struct zs_renderer *r = renderer_of(shading);
    struct our_shader *s = shader_of(r->xform.instance->material->shader);
    s->work.faces++;
    count_cover(r);
    if (now.tiles && r->direct && !all_asked(r->config.width, r->xform.instance->mesh) && is_large(r, t))
        now.n[SIM_COST_tri_asked]++;
    now.n[SIM_COST_tri_bin]++;
    if (s->face == SIM_COST_face_flat && r->xform.instance->mesh->face_normal)
        now.n[SIM_COST_face_flat_given]++;
    else if (s->face != SIM_COST_N)
        now.n[s->face]++;
    return s->of->face ? s->of->face(shading, t) : 0u;
}

static uint32_t on_depth_vertex(const struct zs_view *view, int32_t z, uint32_t rcp, int32_t lz)
{
    const struct zs_renderer *r = now.r;
    const enum sim_cost cost = !view->perspective              ? SIM_COST_vertex_ortho
                               : now.of == &zs_depth_recip     ? SIM_COST_vertex_recip
                               : now.of == &zs_depth_linear    ? SIM_COST_vertex_linear
                                                               : SIM_COST_vertex;
    now.n[cost]++;
    if (r->xform.clip_depth || r->xform.clip_guard)
        now.n[SIM_COST_vertex_test]++;
    if (r->xform.instance->mesh->pos_lo)
        now.n[SIM_COST_vertex_fine]++;
    count_instance(r);
    return now.of->vertex(view, z, rcp, lz);
}

static int on_planes(struct zs_job *job);

static int on_setup(struct zs_view *view, const struct zs_camera *camera, uint32_t bits)
{
    now.r = (struct zs_renderer *)(void *)((char *)view - offsetof(struct zs_renderer, view));
    const int err = now.of->setup(view, camera, bits);
    now.linear = view->screen_linear;
    if (now.depth.planes == on_planes)
        view->screen_linear = 0; /* all triangles that are set up come by on_planes */
    now.tiles = now.r->tiles != NULL;
    return err;
}

static uint32_t tested(void)
{
    return now.r->stats.pixels_tested;
}

static uint32_t written(void)
{
    return now.r->stats.pixels_written;
}

/* How planes are found over the triangle in hand (plane.c). */
static void look_plane(const struct zs_job *job)
{
    now.wide = !job->geom.tiny;
    now.huge = !job->geom.rcp;
}

/* A triangle that is set up the general way. plain: of one colour by an effect; such small ones are in no probe, and
 * count as larger ones. */
static void count_setup(const struct shape *s, int plain)
{
    now.setups++;
    now.tested += (uint64_t)s->px;
    now.n[SIM_COST_setup]++;
    now.n[SIM_COST_setup_wide] += now.wide || plain;
    if (now.r->depth) {
        now.n[SIM_COST_plane_wide] += now.huge && s->tilted; /* its key */
        now.n[SIM_COST_tilt] += s->tilted && !now.huge;
    }
    now.n[SIM_COST_row] += s->rows;
    now.n[now.wide ? SIM_COST_edge : SIM_COST_edge_tiny] += s->edges;
    now.n[SIM_COST_edge_div] += s->divided;
    now.n[SIM_COST_edge_div64] += s->divided64;
}

/* Highlights on a texture: of the triangle that has been set up. */
static int has_gloss(const struct zs_job *job, const struct our_shader *s)
{
    return s->of == &zs_shade_texture_gloss && (job->c[3].base | job->c[3].gx | job->c[3].gy) != 0;
}

static void count_start(const struct zs_job *job, const struct our_shader *s)
{
    const int affine = job->sub_log2 == ZS_AFFINE;
    if (s->kind == KIND_SMOOTH)
        now.n[affine ? SIM_COST_start_smooth : SIM_COST_start_smooth_w]++;
    else if (s->kind == KIND_TEXTURE)
        now.n[affine ? SIM_COST_start_texture : SIM_COST_start_texture_w]++;
    if (s->kind == KIND_TEXTURE && s->of->n_varyings >= 3)
        now.n[SIM_COST_start_light]++;
    now.n[SIM_COST_gloss_start] += has_gloss(job, s);
    if (s->kind != KIND_SOLID && now.wide)
        now.n[now.huge ? SIM_COST_plane_wide : SIM_COST_plane_mid] += s->of->n_varyings + !affine;
}

static void on_start(struct zs_job *job)
{
    const struct our_shader *s = shader_of(job->shader);
    s->of->start(job);
    count_start(job, s);
}

/* What tests the pieces of its rows. */
static zs_piece_fn *tester(const struct zs_job *job)
{
    const struct our_shader *s = shader_of(job->shader);
    const struct zs_fast *of = fast_of(job)->of;
    return of && of->span ? of->span : s->of->span ? s->of->span : zs_rows_test;
}

/* A row by what tests the shader's pieces; not by on_span. */
ZS_ALWAYS_INLINE void row_tested(struct zs_job *job, const struct zs_row *row)
{
    tester(job)(job, row, row->i0, row->i1, row->key + zs_wrap_mul(job->key.gx, row->i0), job->key.gx);
}

/* Linear keys, no state, no pixel untouched: an accelerator draws rows itself, or they are tested and have runs
 * coloured. */
static int on_rows(struct zs_job *job)
{
    const struct our_shader *s = shader_of(job->shader);
    const struct zs_fast *of = fast_of(job)->of;
    const struct shape *shape = &now.shape;
    const double runs = now.n[SIM_COST_run];
    const uint32_t before = written();
    if (!of || !of->rows || !of->rows(job))
        zs_rows_walk(job, row_tested, 0);
    const double won = written() - before;
    const int affine = job->sub_log2 == ZS_AFFINE && (s->kind == KIND_SMOOTH ||
                                                      (job->sampler.direct && job->sampler.unlit));
    if (s->kind == KIND_SOLID && !s->like) {
        now.n[SIM_COST_span_solid] += shape->spans;
        now.n[SIM_COST_px_solid] += shape->px;
        now.n[SIM_COST_won_solid] += won;
    } else if (!affine || runs < now.n[SIM_COST_run]) {
        now.n[SIM_COST_span_runs] += shape->spans;
        now.n[SIM_COST_px_runs] += shape->px;
        now.n[SIM_COST_won_runs] += won;
    } else if (s->kind == KIND_SMOOTH) {
        now.n[SIM_COST_span_smooth] += shape->spans;
        now.n[SIM_COST_px_smooth] += shape->px;
        now.n[SIM_COST_won_smooth] += won;
    } else {
        now.n[SIM_COST_span_direct] += shape->spans;
        now.n[SIM_COST_px_direct] += shape->px;
        now.n[texel_of(job->sampler.texture->format)->won] += won;
    }
    return 1;
}

/* Is each pixel's key found by itself? */
static int pixelwise(void)
{
    return !now.linear && now.of == &zs_depth_linear;
}

/* A piece of a row, or all of one, of an instance without a state. */
static void on_span(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1, uint32_t sum, uint32_t gx)
{
    const struct our_shader *s = shader_of(job->shader);
    const uint32_t before = written();
    now.testing = 1;
    tester(job)(job, row, i0, i1, sum, gx);
    now.testing = 0;
    const double won = written() - before;
    if (pixelwise()) { /* a piece a pixel; on_planes counts them */
        now.n[SIM_COST_won_runs] += won;
        return;
    }
    const int solid = s->kind == KIND_SOLID && !s->like;
    now.n[SIM_COST_piece]++;
    now.n[solid ? SIM_COST_px_solid : SIM_COST_px_runs] += i1 - i0;
    now.n[solid ? SIM_COST_won_solid : SIM_COST_won_runs] += won;
}

/* A piece of a row of an instance with a state, whose keys are not linear. */
static void on_piece(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1, uint32_t sum, uint32_t gx)
{
    now.n[SIM_COST_piece]++;
    now.n[SIM_COST_px_state] += i1 - i0;
    now.piece(job, row, i0, i1, sum, gx);
}

/* ---- Other methods than the depth buffer -------------------------------------------------------- */

static int is_method(const struct zs_method *method)
{
    return now.method_of == method;
}

static int is_order(void)
{
    return is_method(&zs_method_depthsort) || is_method(&zs_method_coverage);
}

static int is_hiz(void)
{
    return is_method(&zs_method_hiz) || is_method(&zs_method_hiz_corner) || is_method(&zs_method_hiz_vertex);
}

/* A row of a triangle, or a piece of one, before the method has chosen pixels of it. */
static void on_method_span(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1, uint32_t sum,
                           uint32_t gx)
{
    if (!is_hiz() && (job->tri != now.method_tri || row->y < now.method_row)) { /* hiz: by on_planes */
        look(&now.shape, job);
        look_plane(job);
        count_setup(&now.shape, 0);
    }
    now.method_tri = job->tri;
    now.method_row = row->y;
    if (is_method(&zs_method_painter))
        now.n[SIM_COST_span_painter]++;
    else if (is_hiz())
        now.n[SIM_COST_span_tiles]++;
    else if (is_method(&zs_method_raycast)) {
        now.n[SIM_COST_span_ray]++;
        now.n[SIM_COST_px_ray] += i1 - i0;
    } else {
        const int near_first = is_method(&zs_method_coverage);
        now.n[near_first ? SIM_COST_span_covered : SIM_COST_span_sorted]++;
        if (near_first)
            now.n[SIM_COST_word_covered] += ((i1 - 1) >> 5) - (i0 >> 5) + 1;
    }
    now.method_span(job, row, i0, i1, sum, gx);
}

/* The method says no to mappings by their address. */
static int on_method_begin(struct zs_renderer *r)
{
    r->config.depth = now.of;
    const int err = now.method_of->begin(r);
    r->config.depth = &now.depth;
    now.method_span = r->span;
    r->span = on_method_span;
    return err;
}

/* What the method's own state has counted since the last time. */
static void count_state(struct zs_renderer *r)
{
    if (is_order()) {
        struct zs_order *o = r->method_state;
        now.n[SIM_COST_pair_boxes] += o->pair_boxes;
        now.n[SIM_COST_pair_row] += o->pair_rows;
        o->pair_boxes = o->pair_rows = 0;
    } else if (is_method(&zs_method_raycast)) {
        struct zs_rays *s = r->method_state;
        now.n[SIM_COST_ray_box] += s->boxes;
        now.n[SIM_COST_ray_tri] += s->boxed;
        now.n[SIM_COST_ray_edges] += s->edges;
        s->boxes = s->boxed = s->edges = 0;
    }
}

static uint16_t on_method_list(struct zs_renderer *r)
{
    const uint16_t list = now.method_of->list(r);
    if (r->method_state) /* not where a strip is left out */
        count_state(r);
    const double n = r->stats.sorted - now.sorted;
    now.method_tri = NULL;
    now.sorted = r->stats.sorted;
    if (n > 1.0)
        now.n[SIM_COST_sorted_log] += n * log2(n);
    return list;
}

/* Of the depth mapping, for rays and for triangles that they have hit. */
static int on_ray_planes(struct zs_job *job)
{
    now.n[SIM_COST_ray_plane]++;
    return now.of->planes(job);
}

static void on_ray_row(struct zs_job *job, const struct zs_row *row)
{
    now.n[SIM_COST_ray_curved]++;
    now.of->row(job, row);
}

static void copy_method(struct zs_config *config)
{
    if (!config->method || config->method == &zs_method_transparent)
        return; /* the depth buffer's stages */
    now.method_of = config->method;
    now.method = *config->method;
    now.method.begin = on_method_begin;
    now.method.list = on_method_list;
    config->method = &now.method;
    if (is_hiz()) /* set-ups are found by on_planes */
        return;
    now.depth.planes = now.of->planes ? on_ray_planes : NULL;
    if (now.of->row)
        now.depth.row = on_ray_row;
}

/* What the statistics say that methods did so far. */
static void count_method(void)
{
    const struct zs_stats *s = &now.r->stats;
    double *n = now.n;
    n[SIM_COST_sorted] = s->sorted;
    if (!now.method_of)
        return;
    n[SIM_COST_pair] = s->pairs;
    n[SIM_COST_setup_order] = is_order() ? s->tris_setup : 0;
    n[SIM_COST_tile] = s->tiles_tested;
    n[SIM_COST_tile_triangle] = is_hiz() ? s->tris_setup + s->tris_hidden : 0;
    n[SIM_COST_px_tile_hidden] = s->pixels_hidden;
    n[SIM_COST_tile_px_untested] = is_hiz() ? s->pixels_untested : 0;
    n[SIM_COST_ray] = s->rays;
}

#define LONG_PART 32.0 /* px of a part in the runs that effects were measured in */

/* A run of an effect, of n pixels of a row: what begins it, beyond what it was in the long runs that were measured. */
static void count_begin(const struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to)
{
    const struct our_shader *s = shader_of(job->shader);
    const int perspective = job->sub_log2 != ZS_AFFINE;
    const int log2 = s->kind == KIND_SMOOTH && perspective ? (int)job->sub_log2 : 5;
    const double parts = ((to - 1 - row->x0) >> log2) - ((from - row->x0) >> log2) + 1;
    const double more = parts - (to - from) / LONG_PART;
    if (more > 0.0 && !s->begins && s->kind == KIND_SMOOTH && perspective)
        now.n[SIM_COST_run_smooth_part] += more;
}

/* A run of an effect. */
static void count_effect(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to)
{
    struct our_shader *s = shader_of(job->shader);
    s->work.px += to - from;
    s->work.runs++;
    now.n[SIM_COST_run]++;
    now.n[SIM_COST_won_runs] += to - from;
    count_begin(job, row, from, to);
    now.job = job;
    now.own = job->shader;
    s->of->run(job, row, from, to);
    now.job = NULL;
}

#define NO_OCTAVES INT32_MIN /* job->w64_scale, where a triangle's keys lie in one */

static void on_fetch(const struct zs_texture *t, uint16_t *out, int32_t n, const struct zs_walk *walk);
static int is_added(const struct zs_shader *of);

/* Texels that a format's other function has fetched, or that are taken to be. */
static void count_alpha_texels(const struct zs_job *job, int32_t n)
{
    if (job->sampler.texture->format->fetch == on_fetch)
        return; /* it counts them */
    now.n[SIM_COST_fetch]++;
    now.n[SIM_COST_fetch_565_px] += n;
    now.n[SIM_COST_fetch_group] += job->sub_log2 != ZS_AFFINE;
    if (job->sampler.unlit)
        return;
    now.n[SIM_COST_shine]++;
    now.n[SIM_COST_shine_px] += n;
}

static void on_run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to)
{
    struct our_shader *s = shader_of(job->shader);
    const int untouched = job->split & ZS_SPLIT_TOUCH && !now.testing, texels = s->kind == KIND_TEXTURE;
    if (s->effect) {
        count_effect(job, row, from, to);
        return;
    }
    const int plain = now.method_of && !is_hiz();
    now.n[is_method(&zs_method_coverage) ? SIM_COST_run_covered : plain ? SIM_COST_run_plain : SIM_COST_run]++;
    now.n[SIM_COST_run_untouched] += untouched;
    if (untouched)
        now.n[SIM_COST_px_untouched] += to - from;
    if (untouched && job->w64_scale != NO_OCTAVES)
        now.n[SIM_COST_piece]++;
    if (job->depth_state)
        now.n[SIM_COST_won_runs] += to - from;
    if (s->kind == KIND_SOLID)
        now.n[plain ? SIM_COST_run_plain_px : untouched ? SIM_COST_fill_px : SIM_COST_run_solid_px] += to - from;
    if (s->kind == KIND_SMOOTH) {
        now.n[SIM_COST_run_smooth_px] += to - from;
        if (job->sub_log2 != ZS_AFFINE)
            now.n[SIM_COST_run_smooth_part] +=
                ((to - 1 - row->x0) >> job->sub_log2) - ((from - row->x0) >> job->sub_log2) + 1;
    }
    if (has_gloss(job, s))
        now.n[SIM_COST_gloss_px] += to - from;
    if (s->of->span) {
        now.n[s->blends ? SIM_COST_blend_px : SIM_COST_cutout_px] += to - from;
        now.n[SIM_COST_add_px] += is_added(s->of) ? to - from : 0;
        now.n[!s->blends ? SIM_COST_cutout_run : texels ? SIM_COST_blend_texel_run : SIM_COST_blend_run]++;
    }
    if (s->of->span && texels)
        count_alpha_texels(job, to - from);
    now.job = job;
    now.own = job->shader;
    s->of->run(job, row, from, to);
    now.job = NULL;
}

/* A piece of a row of an effect that tests depth in its own way. */
static void on_own_span(struct zs_job *job, const struct zs_row *row, int32_t i0, int32_t i1, uint32_t sum,
                        uint32_t step)
{
    struct our_shader *s = shader_of(job->shader);
    const uint32_t before = written();
    const double runs = s->work.runs, px = s->work.px, before_won = now.n[SIM_COST_won_runs];
    now.job = job;
    now.own = job->shader;
    s->of->span(job, row, i0, i1, sum, step);
    now.job = NULL;
    const uint32_t won = written() - before;
    now.n[job->depth_state ? SIM_COST_px_state : SIM_COST_px_runs] += i1 - i0;
    now.n[SIM_COST_won_runs] = before_won + won;
    s->work.px = px + (s->own ? (double)(i1 - i0) : (double)won);
    now.n[SIM_COST_run] += s->own; /* its pattern */
    if (won > 0 && s->work.runs == runs) { /* it has not called run */
        s->work.runs++;
        count_begin(job, row, i0, i1);
    }
}

static void on_light(uint16_t *out, int32_t n, uint32_t level, uint32_t step)
{
    now.n[SIM_COST_shine]++;
    now.n[SIM_COST_shine_px] += n;
    zs_shade_texture_flat.light(out, n, level, step);
}

/* A triangle that may be drawn in one go. */
static int on_draw(struct zs_job *job)
{
    const struct our_shader *s = shader_of(job->shader);
    const uint32_t setups = now.r->stats.tris_setup, px = tested(), before = written();
    now.lit = 0;
    if (!fast_of(job)->of->draw(job))
        return 0;
    if (now.r->stats.tris_setup == setups)
        return 1;
    now.setups++;
    struct shape shape;
    look(&shape, job);
    now.n[SIM_COST_edge_small_div] += shape.divided;
    if (tested() == px) {
        now.n[SIM_COST_setup_small_empty]++;
        return 1;
    }
    now.tested += (uint64_t)shape.px;
    const int texel = s->kind == KIND_TEXTURE;
    const struct zs_material *material = job->r->scene->instance[job->tri->instance].material;
    now.n[texel ? SIM_COST_setup_small_texel : SIM_COST_setup_small]++;
    now.n[SIM_COST_tilt_small] += shape.tilted;
    now.n[texel ? SIM_COST_row_small_texel : SIM_COST_row_small] += shape.rows;
    now.n[texel ? SIM_COST_span_small_texel : SIM_COST_span_small] += shape.spans;
    now.n[texel ? SIM_COST_px_small_texel : SIM_COST_px_small] += shape.px;
    now.n[texel ? texel_of(material->texture->format)->won : SIM_COST_won_small] += written() - before;
    if (now.lit) {
        now.n[SIM_COST_setup_small_lit]++;
        now.n[SIM_COST_span_small_lit] += shape.spans;
        now.n[SIM_COST_won_small_lit] += written() - before;
    }
    return 1;
}

/* A triangle that has been set up, before its rows are drawn. on_rows counts those of linear keys, without a state and
 * on pixels that were drawn on before. */
static int on_planes(struct zs_job *job)
{
    const struct shape *shape = &now.shape;
    look(&now.shape, job);
    look_plane(job);
    count_setup(shape, shader_of(job->shader)->effect && shader_of(job->shader)->kind == KIND_SOLID);
    job->w64_scale = NO_OCTAVES;
    const int linear = now.linear || now.of->planes(job);
    if (shader_of(job->shader)->effect) {
        now.n[SIM_COST_span_runs] += shape->spans;
        if (shader_of(job->shader)->shader.span == NULL)
            now.n[job->depth_state ? SIM_COST_px_state : SIM_COST_px_runs] += shape->px;
    } else if (job->split & ZS_SPLIT_TOUCH) {
        now.untouched = 1;
        now.n[SIM_COST_setup_untouched]++;
        now.n[SIM_COST_setup_octaves] += job->w64_scale != NO_OCTAVES;
        now.n[SIM_COST_row_untouched] += shape->spans;
    } else if (linear && job->depth_state) {
        now.n[SIM_COST_span_runs] += shape->spans;
        now.n[SIM_COST_px_state] += shape->px;
    } else if (pixelwise()) {
        now.n[SIM_COST_setup_linear]++;
        now.n[SIM_COST_span_linear] += shape->spans;
        now.n[SIM_COST_px_linear] += shape->px;
    } else if (!linear) {
        now.n[SIM_COST_setup_octaves]++;
    }
    return linear;
}

/* A row whose keys are not linear. */
static void on_row(struct zs_job *job, const struct zs_row *row)
{
    if (job->depth_state && !pixelwise() && job->piece != on_piece) {
        now.piece = job->piece;
        job->piece = on_piece;
    }
    now.of->row(job, row);
}

/* Texels that are lit by another name than on_light. */
static void count_gloss_lit(int32_t n)
{
    if (!now.job || now.job->sampler.unlit || shader_of(now.own)->of != &zs_shade_texture_gloss)
        return;
    now.n[SIM_COST_shine]++;
    now.n[SIM_COST_shine_px] += n;
}

static void on_fetch(const struct zs_texture *t, uint16_t *out, int32_t n, const struct zs_walk *walk)
{
    const struct our_texel *x = texel_of(t->format);
    const int divided = now.job && now.job->sub_log2 != ZS_AFFINE;
    if (n == 1 && t->clamp && !divided) { /* one of a part that goes beyond the border */
        now.n[SIM_COST_fetch_single]++;
    } else {
        now.n[SIM_COST_fetch]++;
        now.n[x->fetch] += n;
        now.n[SIM_COST_fetch_clamped] += t->clamp != 0;
        if (divided)
            now.n[n > 1 ? SIM_COST_fetch_group : SIM_COST_fetch_one]++;
    }
    count_gloss_lit(n);
    x->of->fetch(t, out, n, walk);
}

static void on_gather(const struct zs_texture *t, uint16_t *out, int32_t n, const uint32_t *at)
{
    count_gloss_lit(n);
    now.n[SIM_COST_divide]++;
    now.n[SIM_COST_divide_px] += n;
    texel_of(t->format)->fast_of->gather(t, out, n, at);
}

static void on_small_lit(struct zs_job *job, const struct zs_texture *t, struct zs_texel_rows *rows)
{
    now.lit = 1;
    texel_of(t->format)->fast_of->small_lit(job, t, rows);
}

/* ---- Walks -------------------------------------------------------------------------------------- */

static void on_needs(struct zs_renderer *r, const struct zs_bounds *b)
{
    now.binned[!r->counting].instances++;
    now.batch_of->needs(r, b);
}

/* Triangles of [from, end) that are looked at: not those of parts that do not reach the band. */
static uint32_t looked_at(const struct zs_renderer *r, uint32_t from, uint32_t end)
{
    uint32_t n, all = 0;
    if (!r->parts_tris)
        return end - from;
    for (; from < end && (n = zs_parts_next(r, &from, end, UINT32_MAX)) > 0; from += n)
        all += n;
    return all;
}

static uint32_t on_bin(struct zs_renderer *r, uint32_t from, uint32_t end, uint32_t *outcome, uint32_t *piece)
{
    struct binned *b = &now.binned[!r->counting];
    const uint32_t before = outcome[ZS_OUTCOME_DRAWN] + outcome[ZS_OUTCOME_OFFSCREEN] + outcome[ZS_OUTCOME_EMPTY];
    const uint32_t reached = now.batch_of->bin(r, from, end, outcome, piece), looked = looked_at(r, from, reached);
    b->tris += looked;
    b->gathered += r->direct ? 0 : looked;
    b->boxed += outcome[ZS_OUTCOME_DRAWN] + outcome[ZS_OUTCOME_OFFSCREEN] + outcome[ZS_OUTCOME_EMPTY] - before;
    if (r->parts_tris && (r->counting || r->noting))
        now.n[SIM_COST_tri_noted] += looked;
    now.unpacked = r->n_verts - r->vert_packed;
    now.band = r->band_end;
    return reached;
}

/* Room has been made: all vertices are packed where the band has lost strips. */
static void on_full(struct zs_renderer *r, uint32_t t)
{
    now.n[SIM_COST_vertex_packed] += r->band_end < now.band ? r->config.max_verts : now.unpacked;
    now.batch_of->full(r, t);
}

static void copy_batch(const struct zs_fast *const *list)
{
    while (list && *list && !(*list)->batch)
        list++;
    if (!list || !*list)
        return;
    now.batch_of = (*list)->batch;
    now.batch = *now.batch_of;
    now.batch.needs = on_needs;
    now.batch.bin = on_bin;
    now.batch.full = on_full;
    now.batch_fast.batch = &now.batch;
}

/* How often all walks do what the first one does. */
static double walks_of(double first, double others)
{
    return first > 0.0 ? 1.0 + others / first : now.walks;
}

/* ---- Copies ------------------------------------------------------------------------------------- */

static int is_added(const struct zs_shader *of)
{
    return of == &zs_add_smooth || of == &zs_add_texture || of == &zs_add_texture_flat || of == &zs_add_texture_smooth;
}

/* The opaque shader of a blending one with varyings; NULL: it is none. */
static const struct zs_shader *opaque(const struct zs_shader *of)
{
    return of == &zs_blend_smooth || of == &zs_add_smooth                     ? &zs_shade_smooth
           : of == &zs_blend_texture || of == &zs_add_texture                 ? &zs_shade_texture
           : of == &zs_blend_texture_flat || of == &zs_add_texture_flat       ? &zs_shade_texture_flat
           : of == &zs_blend_texture_smooth || of == &zs_add_texture_smooth ? &zs_shade_texture_smooth
                                                                                : NULL;
}

/* The shader that an effect's is made of; NULL: it is none that is known. */
static const struct zs_shader *like(const struct zs_shader *of)
{
    return of == &zs_shade_lit_face                                             ? &zs_shade_flat
           : of == &zs_shade_lit                                                ? &zs_shade_smooth
           : of == &zs_shade_cutout                                             ? &zs_shade_texture
           : of == &zs_shade_cutout_flat                                        ? &zs_shade_texture_flat
           : of == &zs_shade_cutout_smooth || of == &zs_shade_texture_gloss ? &zs_shade_texture_smooth
                                                                                : opaque(of);
}

const struct zs_shader *sim_costs_plain(const struct zs_shader *of)
{
    return like(of);
}

static int is_lit(const struct zs_shader *of)
{
    return of == &zs_shade_lit_face || of == &zs_shade_lit || of == &zs_shade_texture_gloss;
}

/* An opaque effect whose texels come as those of zs_shade_texture do, by which it is drawn to be counted. */
static int is_like_texture(const struct zs_shader *of)
{
    const struct zs_shader *const like[] = {
        &zs_shade_bilinear,        &zs_shade_bilinear_flat,         &zs_shade_bilinear_smooth,
        &zs_shade_mipmap,          &zs_shade_mipmap_flat,           &zs_shade_mipmap_smooth,
        &zs_shade_mipmap_bilinear, &zs_shade_mipmap_bilinear_flat,  &zs_shade_mipmap_bilinear_smooth,
        &zs_shade_texture_lit
    };
    for (size_t i = 0; i < sizeof like / sizeof like[0]; i++)
        if (of == like[i])
            return 1;
    return 0;
}

/* Its work is counted. Where texels are fetched in the general way, those are counted as a texture's. */
static void copy_effect(struct our_shader *s, const struct sim_shader_row *row, const struct zs_texture *texture)
{
    const struct zs_shader *of = s->of;
    const int has_varyings = row != NULL && row->vertex != NULL && of->n_varyings > 0, textured = texture != NULL;
    s->kind = !has_varyings ? KIND_SOLID : textured ? KIND_TEXTURE : KIND_SMOOTH;
    s->begins = !has_varyings || sim_effects_begin_runs(row);
    s->work.fetched = s->kind == KIND_TEXTURE && (!s->begins || is_like_texture(of)) &&
                      (texture->format == &zs_texel_565 || texture->format == &zs_texel_pal8 ||
                       texture->format == &zs_texel_pal4);
    if (s->work.fetched && is_like_texture(of)) {
        s->of = of = &zs_shade_texture;
        s->shader = *of;
        s->shader.vertex = on_vertex;
        s->shader.face = on_face;
        s->shader.start = on_start;
        s->shader.run = on_run;
    }
    s->vertex = textured ? SIM_COST_attr_texture : SIM_COST_light_smooth;
    s->own = row != NULL && strncmp(row->name, "zs_stipple", 10) == 0;
    s->face = row != NULL && row->is_flat ? SIM_COST_face_flat : SIM_COST_N;
    s->shader.light = of->light;
    s->shader.span = of->span != NULL ? on_own_span : NULL;
}

static void copy_shader(struct our_shader *s, const struct zs_shader *of, const struct zs_texture *texture)
{
    const struct sim_shader_row *row = sim_shader_row_of(of);
    s->blends = opaque(of) != NULL;
    s->like = like(of);
    const struct zs_shader *plain = s->like ? s->like : of;
    const int is_texture = plain == &zs_shade_texture || plain == &zs_shade_texture_flat ||
                           plain == &zs_shade_texture_smooth;
    s->effect = !s->like && (row == NULL || row->effect != NULL);
    s->shader = *of;
    s->of = of;
    s->kind = is_texture ? KIND_TEXTURE : plain == &zs_shade_smooth ? KIND_SMOOTH : KIND_SOLID;
    s->vertex = of == &zs_shade_lit                 ? SIM_COST_lit_vertex
                : of == &zs_shade_texture_gloss     ? SIM_COST_gloss_vertex
                : plain == &zs_shade_smooth         ? SIM_COST_light_smooth
                : plain == &zs_shade_texture_smooth ? SIM_COST_light_texture
                                                    : SIM_COST_attr_texture;
    s->face = of == &zs_shade_lit_face                                         ? SIM_COST_lit_face
              : plain == &zs_shade_flat || plain == &zs_shade_texture_flat ? SIM_COST_face_flat
                                                                               : SIM_COST_N;
    s->shader.vertex = of->vertex ? on_vertex : NULL;
    s->shader.face = on_face;
    s->shader.start = of->start ? on_start : NULL;
    s->shader.run = on_run;
    s->shader.light = of->light ? on_light : NULL;
    s->shader.span = of->span;
    if (s->effect)
        copy_effect(s, row, texture);
}

static void copy_texel(struct our_texel *x, const struct zs_texel *of)
{
    x->texel = *of;
    x->of = of;
    x->fetch = of == &zs_texel_565 ? SIM_COST_fetch_565_px : of == &zs_texel_pal8 ? SIM_COST_fetch_pal8_px :
        SIM_COST_fetch_pal4_px;
    x->won = of == &zs_texel_565 ? SIM_COST_won_565 : of == &zs_texel_pal8 ? SIM_COST_won_pal8 : SIM_COST_won_pal4;
    x->texel.fetch = on_fetch;
}

/* The accelerator of a shader, or of a texel format; NULL: the list has none. */
static const struct zs_fast *listed(const struct zs_fast *const *list, const struct zs_shader *shader,
                                    const struct zs_texel *format)
{
    for (; list && *list; list++)
        if ((shader && (*list)->shader == shader) || (format && (*list)->format == format))
            return *list;
    return NULL;
}

static void copy_fast(struct thing *t, const struct zs_fast *const *list)
{
    const struct zs_fast *of = listed(list, t->shader.of, NULL);
    if (of)
        t->fast.fast = *of;
    t->fast.of = of;
    t->fast.fast.shader = &t->shader.shader;
    t->fast.fast.draw = of && of->draw ? on_draw : NULL;
    t->fast.fast.rows = on_rows;
    t->fast.fast.span = on_span;
    if (!t->texel.of || !(of = listed(list, NULL, t->texel.of)))
        return;
    t->texel.fast_of = of->texel;
    t->texel_hooks = *of->texel;
    t->texel_hooks.gather = on_gather;
    t->texel_hooks.small_lit = on_small_lit;
    t->texel_fast.format = &t->texel.texel;
    t->texel_fast.texel = &t->texel_hooks;
}

static void copy(struct zs_instance *in, struct thing *t, const struct zs_fast *const *list)
{
    const struct zs_texture *texture = in->material->texture;
    const struct sim_shader_row *row = sim_shader_row_of(in->material->shader);
    memcpy(&t->as, in->material, sim_shader_material_bytes(row != NULL ? row->material : SIM_MATERIAL_PLAIN));
    copy_shader(&t->shader, in->material->shader, texture);
    t->shader.shines = is_lit(in->material->shader) && t->as.lit.shine;
    t->as.material.shader = &t->shader.shader;
    in->material = &t->as.material;
    if (t->shader.effect && !t->shader.work.fetched)
        return;
    if (texture && texture->format) {
        t->texture = *texture;
        copy_texel(&t->texel, texture->format);
        t->texture.format = &t->texel.texel;
        t->as.material.texture = &t->texture;
    }
    if (t->shader.effect)
        return;
    copy_fast(t, list);
}

/* Accelerators of the frame, and those of n things. */
static const struct zs_fast **list_of(const struct zs_fast *const *list, const struct thing *things, size_t n)
{
    size_t room = 2u * n + 2u, k = 0;
    for (const struct zs_fast *const *at = list; at && *at; at++)
        room++;
    const struct zs_fast **out = sim_alloc(room, sizeof *out);
    if (now.batch_of)
        out[k++] = &now.batch_fast; /* in place of the list's: the first is used */
    for (; list && *list; list++)
        if (!(*list)->shader && !(*list)->format)
            out[k++] = *list;
    for (size_t i = 0; i < n; i++) {
        if (!things[i].shader.effect)
            out[k++] = &things[i].fast.fast;
        if (things[i].texel.fast_of)
            out[k++] = &things[i].texel_fast;
    }
    return out;
}

/* ---- The frame ---------------------------------------------------------------------------------- */

/* Triangles that are wide enough to hide others: they are looked at for that, once a frame, drawn or not. */
static void count_bounds(const struct zs_strip *strip)
{
    const struct zs_renderer *r = now.r;
    for (uint32_t t = 0; r->large && t < r->n_tris; t++) {
        const struct zs_vertex *a = &r->vert[r->tri[t].v[0]], *b = &r->vert[r->tri[t].v[1]], *c =
            &r->vert[r->tri[t].v[2]];
        const int32_t x0 = zs_min32(zs_min32(a->x, b->x), c->x), x1 = zs_max32(zs_max32(a->x, b->x), c->x);
        const int32_t y0 = zs_min32(zs_min32(a->y, b->y), c->y), y1 = zs_max32(zs_max32(a->y, b->y), c->y);
        now.n[SIM_COST_cover] += zs_min32(zs_first_sample(x1), strip->w) - zs_max32(zs_first_sample(x0), 0) >=
            2 << ZS_TILE_LOG2 &&
                                 zs_first_sample(y0) < strip->y + strip->h && zs_first_sample(y1) > strip->y &&
                                 (zs_first_sample(y0) >= strip->y || strip->y == 0); /* once a frame */
    }
}

/* What was counted since the strip before. */
static void weigh_strip(int walked)
{
    for (int c = 0; c < SIM_CORES; c++) {
        double sum = 0.0;
        for (int k = 0; k < SIM_COST_N; k++)
            sum += (now.n[k] - now.before[k]) * sim_cost_of((enum sim_core)c, (enum sim_cost)k);
        if (now.slowest[walked][c] < sum)
            now.slowest[walked][c] = sum;
    }
    memcpy(now.before, now.n, sizeof now.before);
}

static int on_submit(void *ctx, const struct zs_strip *strip)
{
    (void)ctx;
    const int walked = strip->y / now.r->config.strip_h >= (int)now.band_end;
    now.walks += (uint32_t)walked;
    now.band_end = now.r->band_end;
    count_bounds(strip);
    if (now.untouched && now.r->untouched_left)
        now.n[SIM_COST_row_clear] += strip->h;
    now.untouched = 0;
    count_method();
    weigh_strip(walked);
    for (uint32_t i = 0; i < strip->n_bytes; i++)
        now.checksum = (now.checksum ^ strip->px[i]) * 16777619u;
    return 0;
}

static int on_wait(void *ctx)
{
    (void)ctx;
    return 0;
}

/* What the renderer's own statistics say. */
static void count_frame(const struct zs_config *config, const struct zs_stats *s)
{
    double *n = now.n;
    const double walks = now.walks, walked = s->instances_in - s->instances_culled;
    n[SIM_COST_frame] = 1;
    n[SIM_COST_strip] = s->strips;
    n[SIM_COST_clear_px] = (double)config->width * config->height - s->pixels_untested;
    if (now.of->span)
        n[SIM_COST_clear_px] /= 2.0; /* the colour alone */
    n[SIM_COST_instance] = walked * walks_of(now.binned[0].instances, now.binned[1].instances);
    n[SIM_COST_instance_culled] = walks * s->instances_culled;
    n[SIM_COST_vertex_out] =
        s->verts_transformed - (n[SIM_COST_vertex] + n[SIM_COST_vertex_recip] + n[SIM_COST_vertex_linear] +
                                                     n[SIM_COST_vertex_ortho]);
    if (n[SIM_COST_vertex_out] < 0) /* clipping projects too */
        n[SIM_COST_vertex_out] = 0;
    n[SIM_COST_tri] = (s->tris_in - s->tris_frustum) * walks_of(now.binned[0].tris, now.binned[1].tris);
    n[SIM_COST_tri_looked] = now.binned[0].gathered + now.binned[1].gathered;
    n[SIM_COST_tri_box] = (s->tris_drawn + s->tris_offscreen + s->tris_empty) *
                          walks_of(now.binned[0].boxed, now.binned[1].boxed);
    n[SIM_COST_tri_clip] = walks * s->tris_clipped;
    n[SIM_COST_tri_hidden] = s->tris_hidden;
    n[SIM_COST_setup_empty] += s->tris_setup - now.setups;
    n[SIM_COST_instance_asked] += walks * s->instances_hidden;
}

/* Meshes whose triangles are all asked what they hide: of those that were walked, on average. */
static void count_asked(const struct zs_scene *scene, const struct zs_config *config, const struct zs_stats *s)
{
    double n = 0.0;
    for (size_t i = 0; i < scene->n_instances; i++)
        if (all_asked(config->width, scene->instance[i].mesh))
            n += scene->instance[i].mesh->n_tris;
    if (s->instances_in > 0)
        now.n[SIM_COST_tri_asked] += n * now.walks * (1.0 - (double)s->instances_culled / s->instances_in);
}

/* The slowest strip: what was counted while strips were drawn, each one's share of what is the same in all of them, and
 * in those that begin with a walk, a walk's share of the rest. */
static void find_worst(struct sim_counted *out)
{
    for (int c = 0; c < SIM_CORES; c++) {
        const enum sim_core core = (enum sim_core)c;
        double all = 0.0;
        for (int k = 0; k < SIM_COST_N; k++)
            all += (out->n[k] - now.before[k]) * sim_cost_of(core, (enum sim_cost)k);
        const double strips = out->n[SIM_COST_strip] * sim_cost_of(core, SIM_COST_strip) +
                              out->n[SIM_COST_clear_px] * sim_cost_of(core, SIM_COST_clear_px);
        const double walk = now.slowest[1][c] + (all - strips) / now.walks;
        out->worst[c] = strips / out->stats.strips + (walk > now.slowest[0][c] ? walk : now.slowest[0][c]);
    }
}

/* What effects take: their shaders, and hooks over what is drawn. */
static void count_effects(struct sim_counted *out, const struct zs_scene *scene, const struct thing *things,
                          const struct sim_frame *frame)
{
    const double all = (double)frame->width * frame->height;
    double drawn = 0.0;
    for (size_t i = 0; scene->n_resolves > 0 && frame->key != NULL && i < all; i++)
        drawn += frame->key[i] != ZS_DEPTH_CLEAR;
    for (uint32_t i = 0; i < scene->n_instances; i++)
        if (things[i].shader.effect)
            sim_effects_add(out, scene->instance[i].material, &things[i].shader.work);
        else if (is_lit(scene->instance[i].material->shader))
            sim_effects_add_lamps(out, scene->instance[i].material, &things[i].shader.work);
    for (uint32_t i = 0; i < scene->n_resolves; i++)
        sim_effects_add_hook(out, &scene->resolve[i], drawn, all);
}

int sim_costs_count(struct sim_counted *out, const struct zs_scene *scene, const struct zs_camera *camera,
                    const struct zs_config *config)
{
    struct zs_scene ours = *scene;
    struct zs_config with = *config;
    struct sim_frame frame;
    const size_t n = scene->n_instances;
    struct zs_instance *instance = sim_alloc(n + 1u, sizeof *instance);
    struct thing *things = sim_alloc(n + 1u, sizeof *things);
    const struct zs_sink sink = { .submit = on_submit, .wait = on_wait };
    memset(out, 0, sizeof *out);
    memset(&now, 0, sizeof now);
    now.n = out->n;
    now.of = config->depth;
    now.depth = *config->depth;
    now.depth.setup = on_setup;
    now.depth.vertex = on_depth_vertex;
    now.depth.planes = on_planes;
    now.depth.row = on_row;
    now.checksum = 2166136261u;
    now.instance = UINT32_MAX;
    with.depth = &now.depth;
    for (size_t i = 0; i < n; i++) {
        instance[i] = scene->instance[i];
        copy(&instance[i], &things[i], config->fast);
    }
    copy_batch(config->fast);
    for (size_t i = 0; i < n && !with.method; i++)
        if (scene->instance[i].material->shader->layer) {
            with.method = &zs_method_transparent;
            with.max_tris = with.max_tris < 2 ? 2 : with.max_tris; /* its least pools */
            with.max_verts = with.max_verts < 6 ? 6 : with.max_verts;
        }
    copy_method(&with);
    const struct zs_fast **fast = list_of(config->fast, things, n);
    with.fast = fast;
    ours.instance = instance;
    int err = sim_frame_render_to(&frame, &ours, camera, &with, NULL, &sink);
    if (err == ZS_OK) {
        out->stats = frame.stats;
        out->checksum = now.checksum;
        count_frame(config, &frame.stats);
        count_asked(scene, config, &frame.stats);
        if (now.walks > 0 && frame.stats.strips > 0)
            find_worst(out);
        count_effects(out, scene, things, &frame);
        if (now.tested != frame.stats.pixels_tested)
            err = SIM_FRAME_BROKEN;
    }
    sim_frame_free(&frame);
    free(fast);
    free(instance);
    free(things);
    return err;
}
