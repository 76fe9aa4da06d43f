/* What can be known exactly of triangles: see exact_cases.h. Of layers: exact_layers.c.
 *
 * SPDX-License-Identifier: MIT
 */
#include "exact_cases.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "frame.h"
#include "error_bound.h"
#include "grid.h"
#include "one.h"
#include "prng_log.h"
#include "reference.h"
#include "sim.h"
#include "scene_reference.h"

#define EXACT_Z 32768 /* world units; focal length 128 px */
#define FAR_LOG2 6    /* far is EXACT_Z * 2^6, near EXACT_Z / 2 */
#define W 320
#define H 240
#define GUARD (8188 * 256)
#define MESH_VERTS 2200
#define MESH_TRIS 4200

const char *const sim_exact_mapping[SIM_EXACT_MAPPINGS] = { "recip", "linear",
                                                            "e3m13", "e4m12",
                                                            "e5m11", "linear, orthographic" };

const struct zs_depth *const sim_exact_depth[SIM_EXACT_MAPPINGS] = {
    &zs_depth_recip, &zs_depth_linear, &zs_depth_e3m13,
    &zs_depth_e4m12, &zs_depth_e5m11,  &zs_depth_linear
};

/* A mesh whose steps are 256 world units, so that a step is a pixel at EXACT_Z, and pos_lo 1/256
 * px. */
struct board {
    struct sim_one one;
    int16_t pos[MESH_VERTS][3];
    uint8_t pos_lo[MESH_VERTS][3];
    int16_t uv[MESH_VERTS][2];
    uint16_t tri[MESH_TRIS][3], raw[MESH_TRIS];
    int32_t x[MESH_VERTS], y[MESH_VERTS]; /* on the screen, 1/256 px, y down */
    int far_log2[MESH_VERTS];             /* distance, EXACT_Z * 2^this; orthographic: any z */
    int32_t z[MESH_VERTS];
};

static void board_open(struct board *b, int mapping)
{
    sim_one_open(&b->one, W, H);
    b->one.mesh.pos = (const int16_t(*)[3])b->pos;
    b->one.mesh.pos_lo = (const uint8_t(*)[3])b->pos_lo;
    b->one.mesh.tri = (const uint16_t(*)[3])b->tri;
    b->one.mesh.uv = (const int16_t(*)[2])b->uv;
    b->one.mesh.uv_bits = 12;
    b->one.mesh.face_raw = b->raw;
    b->one.mesh.scale = 256 * ZS_Q16_ONE;
    b->one.mesh.radius = 57000;
    b->one.material.cull = ZS_CULL_NONE;
    b->one.config.depth = sim_exact_depth[mapping];
    b->one.config.max_tris = 16;
    b->one.config.max_verts = 40;
    if (mapping == 5)
        (void)zs_camera_orthographic(&b->one.camera, H * 256, EXACT_Z / 2, EXACT_Z << FAR_LOG2);
    else
        (void)zs_camera_perspective(&b->one.camera, 8192, H, EXACT_Z / 2, EXACT_Z << FAR_LOG2);
    b->one.camera.focal = (zs_uq32_32)(EXACT_Z / 256) << 32;
}

/* A corner at a place on the screen, 1/256 px from its middle, y down; |x|, |y| times 2^far_log2
 * below 2^23. With an orthographic camera it stands at the distance z, else at EXACT_Z *
 * 2^far_log2. */
static uint32_t board_vertex(struct board *b, int32_t x, int32_t y, int far_log2, int32_t z)
{
    const uint32_t v = b->one.mesh.n_verts++;
    const int ortho = b->one.camera.projection == ZS_ORTHOGRAPHIC, up = ortho ? 0 : far_log2;
    const int32_t fine[3] = { x * (1 << up), -y * (1 << up),
                              -(ortho ? z : EXACT_Z * (1 << far_log2)) };
    for (int c = 0; c < 3; c++) {
        b->pos[v][c] = (int16_t)(fine[c] >> 8);
        b->pos_lo[v][c] = (uint8_t)(fine[c] & 255);
    }
    b->x[v] = x + W * 128;
    b->y[v] = y + H * 128;
    b->far_log2[v] = far_log2;
    b->z[v] = z;
    return v;
}

static void board_tri(struct board *b, uint32_t a, uint32_t c, uint32_t d)
{
    const uint32_t t = b->one.mesh.n_tris++;
    b->tri[t][0] = (uint16_t)a;
    b->tri[t][1] = (uint16_t)c;
    b->tri[t][2] = (uint16_t)d;
    b->raw[t] = (uint16_t)(t + 1);
}

int sim_exact_refuse(int err)
{
    return sim_refuse(NULL, 0, "a scene of the accuracy checks could not be drawn: %s",
                      zs_error_string(err));
}

/* ---- Whole numbers -------------------------------------------------------------------------- */

struct edges {                   /* of the first triangle, positive inside */
    int64_t at[3], dx[3], dy[3]; /* at the sample of pixel (0, 0), a pixel right, a pixel down */
    int in_zero[3];              /* a top or left edge: samples on it are inside */
    int64_t area;                /* twice, > 0; 0: none */
};

static void edges_make(struct edges *e, const struct board *b)
{
    const int32_t *x = b->x, *y = b->y;
    const int64_t cross = (int64_t)(x[1] - x[0]) * (y[2] - y[0]) -
                          (int64_t)(x[2] - x[0]) * (y[1] - y[0]);
    const int turned = cross < 0; /* counter-clockwise on the screen */
    e->area = turned ? -cross : cross;
    for (int k = 0; k < 3; k++) {
        const int from = turned ? (k + 2) % 3 : (k + 1) % 3,
                  to = turned ? (k + 1) % 3 : (k + 2) % 3;
        const int64_t dx = x[to] - x[from], dy = y[to] - y[from];
        e->at[k] = dx * (128 - y[from]) - dy * (128 - x[from]); /* |.| < 2^45 */
        e->dx[k] = -dy * 256;
        e->dy[k] = dx * 256;
        e->in_zero[k] = dy < 0 || (dy == 0 && dx > 0); /* left: upwards; top: to the right */
    }
}

/* Weights of the corners; their sum is the area. 1: the sample is covered. */
static int edges_at(const struct edges *e, int i, int j, int64_t w[3])
{
    int in = e->area > 0;
    for (int k = 0; k < 3; k++) {
        w[k] = e->at[k] + e->dx[k] * i + e->dy[k] * j;
        in &= w[k] > 0 || (w[k] == 0 && e->in_zero[k]);
    }
    return in;
}

/* ---- Triangles ------------------------------------------------------------------------------ */

enum shape { AROUND, TINY, SLIVER, HUGE_ONE, STEEP, ON_SAMPLES, BESIDE, STRAIGHT, FLAT, SHAPES };

static int32_t corner(struct prng *r, enum shape shape, int32_t size, int32_t first, int k)
{
    const int32_t half = size * 128, shift = (int32_t)prng_pick(r, 8);
    switch (shape) {
    case TINY: return k ? first + prng_range(r, -900, 900) : prng_range(r, -half, half);
    case HUGE_ONE:
    case STEEP: return prng_range(r, -GUARD, GUARD) / (1 << shift);
    case ON_SAMPLES: return prng_range(r, -size / 2 - 2, size / 2 + 2) * 256 + 128;
    case BESIDE: return prng_range(r, -size / 2 - 2, size / 2 + 2) * 256 + 127 + shift % 3;
    default: return prng_range(r, -2 * half, 2 * half);
    }
}

static void triangle_make(struct board *b, struct prng *r, int ratio_log2)
{
    const enum shape shape = (enum shape)prng_pick(r, SHAPES);
    int32_t x[3], y[3];
    for (int k = 0; k < 3; k++) {
        x[k] = corner(r, shape, W, x[0], k);
        y[k] = corner(r, shape, H, y[0], k);
    }
    if (shape == SLIVER || shape == STEEP) {
        const int64_t along = prng_range(r, 0, 65536);
        x[2] = x[0] + (int32_t)((x[1] - x[0]) * along / 65536) + prng_range(r, -2, 2);
        y[2] = y[0] + (int32_t)((y[1] - y[0]) * along / 65536) + prng_range(r, -2, 2);
    }
    if (shape == STRAIGHT)
        x[1] = x[0];
    if (shape == STRAIGHT && prng_pick(r, 2))
        y[2] = y[0];
    if (shape == FLAT)
        y[1] = y[0] + prng_range(r, -400, 400);
    const int least = (int)prng_pick(r, (uint32_t)(FAR_LOG2 - ratio_log2));
    b->one.mesh.n_verts = b->one.mesh.n_tris = 0;
    for (int k = 0; k < 3; k++) {
        int far = least + (k == 0   ? ratio_log2
                           : k == 1 ? 0
                                    : (int)prng_pick(r, (uint32_t)ratio_log2 + 1));
        int32_t at[2] = { x[k], y[k] };
        for (int c = 0; c < 2; c++) { /* the mesh ends at 32767 px of its own */
            const int32_t most = (32767 * 256 >> far) < GUARD ? 32767 * 256 >> far : GUARD;
            at[c] = at[c] > most ? most : at[c] < -most ? -most : at[c];
        }
        (void)board_vertex(b, at[0], at[1], far,
                           prng_range(r, EXACT_Z / 2, EXACT_Z << FAR_LOG2));
    }
    board_tri(b, 0, 1, 2);
}

static double exact_key(const struct board *b, const struct ref_depth *depth,
                        const struct ref_camera *camera, const int64_t w[3], int64_t area)
{
    long double sum = 0;
    for (int k = 0; k < 3; k++)
        sum += camera->orthographic ? (long double)w[k] * b->z[k]
                                    : ldexpl((long double)w[k], -b->far_log2[k]);
    const long double z = camera->orthographic ? sum / area : area / sum * EXACT_Z;
    return ref_exact_key(depth, camera, (double)z);
}

static void compare_triangle(struct sim_exact_triangles *out, const struct board *b,
                             const struct sim_frame *f, int mapping)
{
    const struct ref_depth depth = { sim_reference_mapping(b->one.config.depth, &b->one.camera),
                                     b->one.config.depth_bits };
    const double top = ldexp(1, b->one.config.depth_bits) - 2;
    struct ref_camera camera;
    struct edges e;
    sim_reference_camera(&camera, &b->one.camera);
    edges_make(&e, b);
    for (int j = 0; j < H; j++)
        for (int i = 0; i < W; i++) {
            int64_t w[3];
            const uint16_t key = f->key[j * W + i];
            const int want = edges_at(&e, i, j, w), got = key != ZS_DEPTH_CLEAR;
            out->wrong += want != got;
            if (!want || !got)
                continue;
            const double exact = fmin(exact_key(b, &depth, &camera, w, e.area), top);
            out->keys[mapping]++;
            out->key_worst[mapping] = fmax(out->key_worst[mapping], fabs(key - exact));
        }
    out->pixels += (uint64_t)W * H;
}

int sim_exact_triangles(struct sim_exact_triangles *out, uint64_t seed, uint32_t n)
{
    struct board *b = sim_alloc(1, sizeof *b);
    int err = ZS_OK;
    memset(out, 0, sizeof *out);
    for (uint32_t k = 0; k < n && !err; k++) {
        struct prng r = { seed + k };
        struct sim_frame f;
        const int mapping = (int)(k % SIM_EXACT_MAPPINGS);
        board_open(b, mapping);
        b->one.config.depth_bits = (uint8_t)(prng_pick(&r, 2) ? 16 : prng_range(&r, 8, 16));
        b->one.config.strip_h = (uint16_t)prng_range(&r, 8, H);
        triangle_make(b, &r, (int)prng_pick(&r, FAR_LOG2));
        err = sim_frame_render(&f, &b->one.scene, &b->one.camera, &b->one.config, NULL);
        if (!err)
            compare_triangle(out, b, &f, mapping);
        sim_frame_free(&f);
        out->triangles++;
        sim_progress("exact triangles", k, n);
    }
    sim_progress_end();
    free(b);
    return err ? sim_exact_refuse(err) : SIM_OK;
}

/* ---- Shared edges --------------------------------------------------------------------------- */

static int64_t turn(const struct board *b, uint32_t a, uint32_t c, uint32_t d)
{
    return (int64_t)(b->x[c] - b->x[a]) * (b->y[d] - b->y[a]) -
           (int64_t)(b->x[d] - b->x[a]) * (b->y[c] - b->y[a]);
}

static void fill_grid(struct board *b, struct prng *r, const int32_t box[4])
{
    static struct grid g;
    const int nx = prng_range(r, 1, GRID_MAX), ny = prng_range(r, 1, GRID_MAX);
    grid_make(&g, r, box, nx, ny);
    for (uint32_t v = 0; v < g.n_corners; v++)
        (void)board_vertex(b, g.at[v][0], g.at[v][1], 0, EXACT_Z);
    for (uint32_t t = 0; t < g.n_tris; t++)
        board_tri(b, g.tri[t][0], g.tri[t][1], g.tri[t][2]);
}

static void fill_fan(struct board *b, struct prng *r, const int32_t box[4], int steps)
{
    const int32_t corner_at[4][2] = {
        { box[0], box[1] }, { box[2], box[1] }, { box[2], box[3] }, { box[0], box[3] }
    };
    const int n = prng_range(r, 1, steps);
    const uint32_t rim = 4 * (uint32_t)n;
    const int32_t hub_x = prng_range(r, box[0], box[2]),
                  hub_y = prng_range(r, box[1], box[3]);
    (void)board_vertex(b, hub_x, hub_y, 0, EXACT_Z);
    for (int s = 0; s < 4; s++)
        for (int k = 0; k < n; k++) {
            const int32_t *p = corner_at[s], *q = corner_at[(s + 1) % 4];
            (void)board_vertex(b, p[0] + (int32_t)((int64_t)(q[0] - p[0]) * k / n),
                               p[1] + (int32_t)((int64_t)(q[1] - p[1]) * k / n), 0, EXACT_Z);
        }
    for (uint32_t k = 0; k < rim; k++)
        board_tri(b, 0, 1 + k, 1 + (k + 1) % rim);
}

/* Two triangles, and points dropped into them one after another: slivers without end. */
static void fill_dropped(struct board *b, struct prng *r, const int32_t box[4])
{
    for (int k = 0; k < 4; k++)
        (void)board_vertex(b, box[k == 1 || k == 2 ? 2 : 0], box[k >= 2 ? 3 : 1], 0, EXACT_Z);
    board_tri(b, 0, 1, 2);
    board_tri(b, 0, 2, 3);
    for (int n = prng_range(r, 1, 1000); n > 0; n--) {
        const uint32_t at = prng_pick(r, b->one.mesh.n_tris);
        const uint32_t v[3] = { b->tri[at][0], b->tri[at][1], b->tri[at][2] };
        double u = prng_real(r, 0, 1), s = prng_real(r, 0, 1);
        if (u + s > 1) {
            u = 1 - u;
            s = 1 - s;
        }
        const int32_t x = (int32_t)(b->x[v[0]] + u * (b->x[v[1]] - b->x[v[0]]) +
                                    s * (b->x[v[2]] - b->x[v[0]])) -
                          W * 128;
        const int32_t y = (int32_t)(b->y[v[0]] + u * (b->y[v[1]] - b->y[v[0]]) +
                                    s * (b->y[v[2]] - b->y[v[0]])) -
                          H * 128;
        const uint32_t q = board_vertex(b, x, y, 0, EXACT_Z);
        const int64_t whole = turn(b, v[0], v[1], v[2]),
                      parts[3] = { turn(b, v[0], v[1], q), turn(b, v[1], v[2], q),
                                   turn(b, v[2], v[0], q) };
        if (llabs(parts[0]) + llabs(parts[1]) + llabs(parts[2]) != llabs(whole) || !parts[0] ||
            !parts[1] || !parts[2]) {
            b->one.mesh
                .n_verts--; /* rounded out of it, or onto its outline: that would be a T-junction */
            continue;
        }
        b->tri[at][2] = (uint16_t)q;
        board_tri(b, v[1], v[2], q);
        board_tri(b, v[2], v[0], q);
    }
}

/* Return 1 where there may be triangles thinner than a sub-pixel. */
static int fill_make(struct board *b, struct prng *r, const int32_t box[4])
{
    const uint32_t kind = prng_pick(r, 4);
    b->one.mesh.n_verts = b->one.mesh.n_tris = 0;
    if (kind == 0)
        fill_grid(b, r, box);
    else if (kind == 3)
        fill_dropped(b, r, box);
    else
        fill_fan(b, r, box, kind == 1 ? 20 : 200);
    return kind > 1;
}

/* The scene as it is and, per instance, with its triangles in reverse; each draws over what was
 * there, whatever the depth. */
struct last_wins {
    struct zs_instance *instance;
    struct zs_mesh *mesh;
    struct zs_material *material;
    uint16_t (*tri)[3], *raw;
};

static const struct zs_depth_state over = { .func = ZS_DEPTH_LESS_EQUAL,
                                            .read_only = 1 }; /* nothing is written, so all pass */

static void last_wins_fill(struct last_wins *l, const struct zs_scene *scene, uint32_t n_tris,
                           int reverse)
{
    const uint32_t n = scene->n_instances;
    uint32_t at = 0, number = 0;
    for (uint32_t k = 0; k < n; k++) {
        const uint32_t from = reverse ? n - 1 - k : k;
        const struct zs_mesh *m = scene->instance[from].mesh;
        l->instance[k] = scene->instance[from];
        l->material[k] = *scene->instance[from].material;
        l->material[k].shader = &zs_shade_raw;
        l->mesh[k] = *m;
        l->mesh[k].tri = (const uint16_t(*)[3])(l->tri + at);
        l->mesh[k].face_raw = l->raw + at;
        l->mesh[k].cluster = NULL;
        l->instance[k].mesh = &l->mesh[k];
        l->instance[k].material = &l->material[k];
        l->instance[k].depth_state = &over;
        for (uint32_t t = 0; t < m->n_tris; t++, at++, number++) {
            memcpy(l->tri[at], m->tri[reverse ? m->n_tris - 1 - t : t], sizeof l->tri[0]);
            l->raw[at] = (uint16_t)(reverse ? n_tris - number : number + 1);
        }
    }
}

int sim_exact_double_hits(uint64_t *out, const struct zs_scene *scene,
                          const struct zs_camera *camera, uint16_t width, uint16_t height)
{
    const uint32_t n = scene->n_instances;
    uint32_t n_tris = 0;
    for (uint32_t k = 0; k < n; k++)
        n_tris += scene->instance[k].mesh->n_tris;
    struct last_wins l = { sim_alloc(n, sizeof *l.instance), sim_alloc(n, sizeof *l.mesh),
                           sim_alloc(n, sizeof *l.material), sim_alloc(n_tris, sizeof *l.tri),
                           sim_alloc(n_tris, sizeof *l.raw) };
    struct zs_scene both = *scene;
    struct zs_config config;
    struct sim_frame f[2];
    int err = ZS_OK;
    both.instance = l.instance;
    both.background = 0;
    sim_frame_config(&config, width, height, ZS_VARYINGS_FLAT);
    config.depth = camera->projection == ZS_ORTHOGRAPHIC ? &zs_depth_linear : &zs_depth_recip;
    memset(f, 0, sizeof f);
    *out = 0;
    for (int reverse = 0; reverse < 2 && !err; reverse++) {
        last_wins_fill(&l, scene, n_tris, reverse);
        err = sim_frame_render(&f[reverse], &both, camera, &config, NULL);
    }
    for (size_t i = 0; i < (size_t)width * height && !err; i++)
        *out += f[0].rgb565[i] != f[1].rgb565[i];
    for (int reverse = 0; reverse < 2; reverse++)
        sim_frame_free(&f[reverse]);
    free(l.instance);
    free(l.mesh);
    free(l.material);
    free(l.tri);
    free(l.raw);
    return err ? sim_exact_refuse(err) : SIM_OK;
}

/* Facing: pixels are those whose samples lie in the box. */
static void count_facing(struct sim_exact_edges *out, const struct sim_frame *f,
                         const int32_t box[4])
{
    for (int j = 0; j < H; j++)
        for (int i = 0; i < W; i++) {
            const int32_t x = (i - W / 2) * 256 + 128, y = (j - H / 2) * 256 + 128;
            const int want = x >= box[0] && x < box[2] && y >= box[1] && y < box[3];
            const int got = f->key[j * W + i] != ZS_DEPTH_CLEAR;
            out->pixels += (uint64_t)want;
            out->cracks += want && !got;
            out->beyond += got && !want;
        }
}

/* The rectangle that a tilted mesh fills, as two triangles; *n of them. */
static struct ref_triangle *outline_make(struct board *b, const int32_t box[4], size_t *n)
{
    b->one.mesh.n_verts = b->one.mesh.n_tris = 0;
    for (int k = 0; k < 4; k++) {
        const uint32_t v = board_vertex(b, box[k == 1 || k == 2 ? 2 : 0], box[k >= 2 ? 3 : 1], 0,
                                        EXACT_Z);
        b->pos[v][2] = b->pos_lo[v][2] = 0; /* as draw_edges has it */
    }
    board_tri(b, 0, 1, 2);
    board_tri(b, 0, 2, 3);
    return sim_reference_triangles(&b->one.scene, &b->one.camera, n);
}

/* Tilted: a crack is a pixel that is missing though the reference draws it and all around it;
 * beyond is one that is drawn further than a sub-pixel outside. */
static int count_tilted(struct sim_exact_edges *out, struct board *b, const struct sim_frame *f,
                        const int32_t box[4])
{
    uint32_t *id = sim_alloc((size_t)W * H, sizeof *id);
    struct ref_image truth = { .id = id };
    struct ref_camera camera;
    const struct ref_depth depth = { REF_DEPTH_RECIP, 16 };
    size_t n;
    struct ref_triangle *tri = outline_make(b, box, &n);
    sim_reference_camera(&camera, &b->one.camera);
    const struct sim_judge judge = { tri, &camera, NULL,      &depth,
                                     W,   H,       1.0 / 256, sim_judge_unit(tri, n, &camera) };
    const int err = ref_render(tri, n, &camera, NULL, &depth, 0, W, H, &truth, NULL, NULL);
    for (int j = 1; j < H - 1 && !err; j++)
        for (int i = 1; i < W - 1; i++) {
            const uint32_t *at = id + j * W + i;
            const int got = f->key[j * W + i] != ZS_DEPTH_CLEAR;
            int around = 0;
            for (int k = 0; k < 9; k++)
                around += at[(k / 3 - 1) * W + k % 3 - 1] != 0;
            out->pixels += around == 9;
            out->cracks += around == 9 && !got;
            out->beyond += got && !*at && sim_judge_pixel(&judge, 1, 0, i, j) == SIM_WRONG &&
                           sim_judge_pixel(&judge, 2, 0, i, j) == SIM_WRONG;
        }
    free(tri);
    free(id);
    return err ? sim_exact_refuse(ZS_ERR_RANGE) : SIM_OK;
}

static int draw_edges(struct sim_exact_edges *out, struct board *b, uint64_t seed)
{
    struct prng r = { seed };
    struct sim_frame f;
    uint64_t twice;
    const int tilted = (int)(seed % 2);
    const int to_guard = prng_pick(&r, 4) == 0;
    int32_t box[4]; /* left, top, right, bottom */
    for (int k = 0; k < 4; k++) {
        const int32_t reach = to_guard ? GUARD : prng_range(&r, 20, (k % 2 ? H : W) * 140);
        box[k] = k < 2 ? -reach : reach;
    }
    board_open(b, 0);
    b->one.config.max_tris = b->one.config.max_verts = MESH_TRIS + 200;
    b->one.config.strip_h = (uint16_t)prng_range(&r, 1, H);
    const int slivers = fill_make(b, &r, box);
    if (tilted) {
        for (uint32_t v = 0; v < b->one.mesh.n_verts; v++) /* around the middle of the mesh */
            b->pos[v][2] = b->pos_lo[v][2] = 0;
        b->one.camera.z_near = (zs_q48_16)prng_range(&r, 2000, 30000) * 65536;
        b->one.instance.pose.pos[2] = -prng_range(&r, 1000, 3 * EXACT_Z);
        const int32_t yaw = prng_range(&r, -12000, 12000),
                      pitch = prng_range(&r, -12000, 12000);
        zs_pose_turn(&b->one.instance.pose, (zs_turn)yaw, (zs_turn)pitch, (zs_turn)prng_next(&r));
    }
    int err = sim_frame_render(&f, &b->one.scene, &b->one.camera, &b->one.config, NULL);
    if (err)
        return sim_exact_refuse(err);
    err = sim_exact_double_hits(&twice, &b->one.scene, &b->one.camera, W, H);
    out->double_hits += tilted && slivers ? 0 : twice; /* snapping may fold them over each other */
    out->meshes++;
    if (!err && tilted)
        err = count_tilted(out, b, &f, box);
    else if (!err)
        count_facing(out, &f, box);
    sim_frame_free(&f);
    return err;
}

int sim_exact_edges(struct sim_exact_edges *out, uint64_t seed, uint32_t n)
{
    struct board *b = sim_alloc(1, sizeof *b);
    int status = SIM_OK;
    memset(out, 0, sizeof *out);
    for (uint32_t k = 0; k < n && status == SIM_OK; k++) {
        status = draw_edges(out, b, seed + k);
        sim_progress("shared edges", k, n);
    }
    sim_progress_end();
    free(b);
    return status;
}

/* ---- Texels --------------------------------------------------------------------------------- */

static void compare_texels(struct sim_exact_texels *out, const struct board *b,
                           const struct sim_frame *f)
{
    struct edges e;
    edges_make(&e, b);
    for (int j = 0; j < H; j++)
        for (int i = 0; i < W; i++) {
            int64_t w[3];
            if (!edges_at(&e, i, j, w) || f->key[j * W + i] == ZS_DEPTH_CLEAR)
                continue;
            for (int axis = 0; axis < 2; axis++) {
                __int128 sum = 0, weight = 0; /* w / z, exactly */
                for (int k = 0; k < 3; k++) {
                    const __int128 part = (__int128)w[k] << (FAR_LOG2 - b->far_log2[k]);
                    sum += part * b->uv[k][axis];
                    weight += part;
                }
                const long double at = (long double)sum / (long double)weight /
                                       16; /* 2^-12 repeats of 256 */
                const uint32_t taken = axis ? f->rgb565[j * W + i] >> 8
                                            : f->rgb565[j * W + i] & 255u;
                const uint32_t right = (uint32_t)((int64_t)floorl(at) & 255);
                const uint32_t off = (right - taken) & 255u;
                const long double from_middle = at - taken - 0.5L;
                const long double outside = fabsl(from_middle -
                                                  256 * floorl(from_middle / 256 + 0.5L)) -
                                            0.5L;
                out->coordinates++;
                out->differ += off != 0;
                out->far += off > 1 && off < 255;
                out->worst = fmax(out->worst, (double)outside);
            }
        }
}

int sim_exact_texels(struct sim_exact_texels *out, uint64_t seed, uint32_t n, uint32_t ratio)
{
    struct board *b = sim_alloc(1, sizeof *b);
    uint16_t *numbers = sim_alloc(65536, sizeof *numbers);
    const struct zs_texture texture = { .format = &zs_texel_565, .texel = numbers, .log2_w = 8, .log2_h = 8 };
    int ratio_log2 = 0, err = ZS_OK;
    while (1u << ratio_log2 < ratio)
        ratio_log2++;
    for (uint32_t i = 0; i < 65536; i++)
        numbers[i] = (uint16_t)i;
    memset(out, 0, sizeof *out);
    for (uint32_t k = 0; k < n && !err; k++) {
        struct prng r = { seed + k };
        struct sim_frame f;
        board_open(b, (int)(k % SIM_EXACT_MAPPINGS) % 5);
        triangle_make(b, &r, ratio_log2);
        b->one.material.shader = &zs_shade_texture;
        b->one.material.texture = &texture;
        const int32_t span = (int32_t)prng_real_log(&r, 16, 32768); /* a texel to eight repeats */
        for (int v = 0; v < 3; v++)
            for (int axis = 0; axis < 2; axis++)
                b->uv[v][axis] = (int16_t)prng_range(&r, -span, span - 1);
        err = sim_frame_render(&f, &b->one.scene, &b->one.camera, &b->one.config, NULL);
        if (!err)
            compare_texels(out, b, &f);
        sim_frame_free(&f);
        sim_progress("texels", k, n);
    }
    sim_progress_end();
    free(b);
    free(numbers);
    return err ? sim_exact_refuse(err) : SIM_OK;
}
