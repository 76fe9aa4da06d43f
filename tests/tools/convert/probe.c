/* A program around a converted model, NAME m: is it sound, and is it the model that it was made of?
 *
 *     probe check                 zs_mesh_check, zs_texture_check, spheres again by another sum
 *     probe views 0 PLACE         the cameras of all views as options of zsim render, a line each
 *     probe compare 0 PLACE MAP IDS...  draw each view, compare triangle numbers with zsim's of it
 *     probe places 0 PLACE FILE.obj MAP  how far corners are from where the file has them
 *     probe draw N                view N with the model's own shaders, PPM
 *
 * PLACE: five numbers, origin x y z, step, world units to a unit.
 * "wrong: ..." and status 1, or figures and status 0.
 *
 * SPDX-License-Identifier: MIT
 */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "m.h"
#include "zs_method.h"
#include "zs_check.h"

#define W 240
#define H 240
#define ROWS 48
#define N_VIEWS 4
#define FOV 45.0
#define PI 3.14159265358979323846

static void wrong(const char *format, ...)
{
    va_list args;
    va_start(args, format);
    printf("wrong: ");
    vprintf(format, args);
    printf("\n");
    va_end(args);
    exit(1);
}

/* ---- Check ----------------------------------------------------------------------------------- */

/* A vertex, 1/256 step. */
static void vertex(const struct zs_mesh *m, uint32_t v, double out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = m->pos[v][k] + (m->pos_lo ? m->pos_lo[v][k] / 256.0 : 0.0);
}

static void check_cluster(const struct zs_mesh *m, uint32_t i, double *tightest)
{
    const struct zs_cluster *c = &m->cluster[i];
    double most = 0.0;
    if (c->n_tris > 64)
        wrong("cluster %u has %u triangles", i, c->n_tris);
    for (uint32_t t = c->first; t < c->first + c->n_tris; t++)
        for (int k = 0; k < 3; k++) {
            double p[3], squared = 0.0;
            vertex(m, m->tri[t][k], p);
            for (int a = 0; a < 3; a++)
                squared += (p[a] - c->center[a]) * (p[a] - c->center[a]);
            most = fmax(most, sqrt(squared));
        }
    if (most > c->radius)
        wrong("cluster %u: a vertex %g from the middle of a sphere of %u", i, most, c->radius);
    if (c->radius > most + 1.0)
        wrong("cluster %u: a sphere of %u where %g is enough", i, c->radius, most);
    *tightest = fmin(*tightest, c->radius - most);
}

/* A cone, tried: wherever an eye passes the header's test, all triangles must turn their backs. */
static uint32_t try_cone(const struct zs_mesh *m, uint32_t i, uint32_t *state)
{
    const struct zs_cluster *c = &m->cluster[i];
    uint32_t n = 0;
    for (int try = 0; try < 40 && c->cutoff < 127; try++) {
        double d[3], eye[3], length = 0.0, along = 0.0, p[3][3];
        for (int k = 0; k < 3; k++) {
            *state = *state * 1664525u + 1013904223u;
            d[k] = c->axis[k] / 127.0 + ((*state >> 8) / 8388608.0 - 1.0) * 0.6;
        }
        *state = *state * 1664525u + 1013904223u;
        const double far = c->radius * (0.5 + (*state >> 8) / 16777216.0 * 8.0);
        for (int k = 0; k < 3; k++)
            d[k] *= far;
        for (int k = 0; k < 3; k++) {
            eye[k] = c->center[k] - d[k];
            length += d[k] * d[k];
            along += d[k] * c->axis[k] / 127.0;
        }
        if (along < c->cutoff / 127.0 * sqrt(length) + c->radius)
            continue;
        n++;
        for (uint32_t t = c->first; t < c->first + c->n_tris; t++) {
            for (int k = 0; k < 3; k++)
                vertex(m, m->tri[t][k], p[k]);
            double a[3], b[3], side = 0.0;
            for (int k = 0; k < 3; k++) {
                a[k] = p[1][k] - p[0][k];
                b[k] = p[2][k] - p[0][k];
            }
            for (int k = 0; k < 3; k++)
                side += (eye[k] - p[0][k]) *
                        (a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3]);
            if (side > 0.0)
                wrong("cluster %u: triangle %u faces an eye that its cone leaves out", i, t);
        }
    }
    return n;
}

/* Nodes in preorder over all triangles, and spheres that hold them. Return how many. */
static uint32_t check_nodes(const struct zs_mesh *m)
{
    const struct zs_bvh_node *b = m->bvh;
    for (uint32_t i = 0; i < b->skip; i++) {
        const uint32_t end = b[i].skip < b->skip ? b[b[i].skip].first : m->n_tris;
        if (b[i].skip <= i || b[i].skip > b->skip || end < b[i].first || end > m->n_tris)
            wrong("node %u: triangles %u to %u, skip %u", i, b[i].first, end, b[i].skip);
        if (b[i].skip > i + 1 ? b[i + 1].first != b[i].first : end - b[i].first > 8)
            wrong("node %u: its first child begins elsewhere, or a leaf of %u", i, end - b[i].first);
        for (uint32_t t = b[i].first; t < end; t++)
            for (int k = 0; k < 3; k++) {
                const uint32_t v = m->tri[t][k];
                int64_t most = (int64_t)b[i].radius * b[i].radius * 65536;
                for (int a = 0; a < 3; a++) {
                    const int64_t d = (m->pos[v][a] - b[i].center[a]) * 256 + (m->pos_lo ? m->pos_lo[v][a] : 0);
                    most -= d * d;
                }
                if (most < 0)
                    wrong("node %u: vertex %u is outside of its sphere", i, v);
            }
    }
    return b->first == 0 ? b->skip : 0;
}

static void check(void)
{
    uint32_t clusters = 0, tris = 0, verts = 0, tried = 0, state = 1;
    double tightest = INFINITY;
    for (uint32_t i = 0; i < M_INSTANCES; i++) {
        uint32_t at = 0;
        const struct zs_mesh *m = m_instance[i].mesh;
        const enum zs_flaw flaw = zs_mesh_check(m, &at);
        if (m != &m_mesh[i])
            wrong("instance %u has another mesh", i);
        if (flaw != ZS_FLAW_NONE)
            wrong("mesh %u: %s, %u", i, zs_flaw_string(flaw), at);
        if (m->scale != m_mesh[0].scale)
            wrong("mesh %u has a scale of its own", i);
        for (uint32_t k = 0; k < m->n_clusters; k++) {
            check_cluster(m, k, &tightest);
            tried += try_cone(m, k, &state);
        }
        if (!m->cluster)
            wrong("mesh %u has no clusters", i);
        if (m->bvh && !check_nodes(m))
            wrong("mesh %u: the hierarchy does not begin with its first triangle", i);
        clusters += m->n_clusters;
        tris += m->n_tris;
        verts += m->n_verts;
    }
    if (tris != M_TRIANGLES || verts != M_VERTICES)
        wrong("%u triangles, %u vertices", tris, verts);
#ifdef M_TEXTURES
    for (uint32_t i = 0; i < M_TEXTURES; i++) {
        uint32_t at = 0;
        const enum zs_flaw flaw = zs_texture_check(&m_texture[i], &at);
        if (flaw != ZS_FLAW_NONE)
            wrong("texture %u: %s, %u", i, zs_flaw_string(flaw), at);
    }
#endif
    printf(
        "%u clusters, spheres at least %.3g steps larger than needed, %u eyes left out by cones\n",
        clusters, clusters ? tightest : 0.0, tried);
}

/* ---- Views ----------------------------------------------------------------------------------- */

/* Where a view stands, in radii from the middle, and how far its planes are. */
static const struct {
    double eye[3], z_near, z_far;
} views[N_VIEWS] = {
    { { 1.2, 0.9, 2.4 }, 1.5, 4.2 },
    { { -2.0, -1.5, 0.7 }, 1.4, 4.0 },
    { { 0.3, 2.9, -0.2 }, 1.6, 4.2 },
    { { 0.9, 0.5, -0.9 }, 0.15, 3.0 } /* the last is close: it cuts */
};

static const int32_t middle[3] = M_MIDDLE;

static void eye_of(int n, int32_t eye[3])
{
    for (int k = 0; k < 3; k++)
        eye[k] = middle[k] + (int32_t)lrint(views[n].eye[k] * M_RADIUS);
}

static void camera_of(int n, struct zs_camera *c)
{
    static const int32_t up[3] = { 0, 1, 0 };
    int32_t eye[3];
    eye_of(n, eye);
    memset(c, 0, sizeof *c);
    c->projection = ZS_PERSPECTIVE;
    c->focal = (zs_uq32_32)llrint(H / 2.0 / tan(FOV / 2.0 * PI / 180.0) * 4294967296.0);
    c->z_near = llrint(views[n].z_near * M_RADIUS * 65536.0);
    c->z_far = llrint(views[n].z_far * M_RADIUS * 65536.0);
    if (zs_camera_look_at(c, eye, middle, up) != ZS_OK)
        wrong("view %d: the camera was refused", n);
}

/* origin 3, step, unit */
static void print_view(int n, const double place[5])
{
    int32_t eye[3];
    double e[3], at[3];
    eye_of(n, eye);
    for (int k = 0; k < 3; k++) {
        e[k] = place[k] + eye[k] / place[4];
        at[k] = place[k] + middle[k] / place[4];
    }
    printf("--size %dx%d --fov %g --eye %.17g,%.17g,%.17g --at %.17g,%.17g,%.17g --near %.17g "
           "--far %.17g\n",
           W, H, FOV, e[0], e[1], e[2], at[0], at[1], at[2], views[n].z_near * M_RADIUS / place[4],
           views[n].z_far * M_RADIUS / place[4]);
}

/* ---- Drawing --------------------------------------------------------------------------------- */

static uint16_t frame[H][W], keys[H][W];

static int take(void *ctx, const struct zs_strip *s)
{
    (void)ctx;
    for (uint32_t y = 0; y < s->h; y++)
        for (uint32_t x = 0; x < W; x++) {
            const uint8_t *p = s->px + 2u * (y * W + x);
            frame[s->y + y][x] = (uint16_t)(p[0] << 8 | p[1]);
            keys[s->y + y][x] = s->depth[y * W + x];
        }
    return 0;
}

static void render(const struct zs_instance *instance, const struct zs_camera *camera,
                   uint16_t background)
{
    static const struct zs_config config = {
        .width = W, .height = H, .strip_h = ROWS, .max_tris = 20000, .max_verts = 20000, .varyings = M_VARYINGS,
        .buffers = 1, .subpixel_bits = 8, .depth_bits = 16, .depth = &zs_depth_recip
    };
    static struct zs_renderer renderer;
    ZS_ARENA(arena, ZS_ARENA_BYTES(W, H, ROWS, 20000, 20000, M_VARYINGS, 1));
    const struct zs_scene scene = {
        .instance = instance, .n_instances = M_INSTANCES,
        .light = { .dir = { 400000000, 700000000, 700000000 }, .ambient = ZS_Q16_ONE / 4,
                   .diffuse = ZS_Q16_ONE * 3 / 4 },
        .background = background
    };
    const struct zs_sink sink = { .submit = take };
    int err = zs_init(&renderer, &config, arena, sizeof arena);
    err = err ? err : zs_render(&renderer, &scene, camera, &sink);
    if (err)
        wrong("%s", zs_error_string(err));
}

/* Number + 1 of the triangle at each pixel, counted over all meshes in order; 0: none. */
static void number(uint32_t id[H][W], const struct zs_camera *camera)
{
    static struct zs_instance instance[M_INSTANCES];
    static struct zs_mesh mesh[M_INSTANCES];
    static struct zs_material material[M_INSTANCES];
    static uint16_t raw[M_TRIANGLES];
    memset(id, 0, sizeof(uint32_t) * W * H);
    for (int shift = 0; shift < 32; shift += 16) {
        uint32_t first = 0;
        for (uint32_t t = 0; t < M_TRIANGLES; t++)
            raw[t] = (uint16_t)((t + 1) >> shift);
        for (uint32_t i = 0; i < M_INSTANCES; i++) {
            mesh[i] = *m_instance[i].mesh;
            material[i] = *m_instance[i].material;
            instance[i] = m_instance[i];
            mesh[i].face_raw = raw + first;
            material[i].shader = &zs_shade_raw;
            instance[i].mesh = &mesh[i];
            instance[i].material = &material[i];
            first += mesh[i].n_tris;
        }
        render(instance, camera, 0);
        for (int i = 0; i < W * H; i++)
            if (keys[i / W][i % W] != ZS_DEPTH_CLEAR)
                id[i / W][i % W] |= (uint32_t)frame[i / W][i % W] << shift;
    }
}

/* ---- Comparing ------------------------------------------------------------------------------- */

/* A triangle before the camera, world units: x right, y up, z away. */
struct seen {
    double p[3][3];
};

static struct seen see(uint32_t t, const struct zs_camera *c)
{
    struct seen s;
    uint32_t i = 0;
    for (; t >= m_mesh[i].n_tris; i++)
        t -= m_mesh[i].n_tris;
    for (int k = 0; k < 3; k++) {
        double v[3], d[3];
        vertex(&m_mesh[i], m_mesh[i].tri[t][k], v);
        for (int a = 0; a < 3; a++)
            d[a] = v[a] * m_mesh[i].scale / 65536.0 - c->pos[a];
        for (int a = 0; a < 3; a++)
            s.p[k][a] =
                (d[0] * c->rot[3 * a] + d[1] * c->rot[3 * a + 1] + d[2] * c->rot[3 * a + 2]) /
                (double)ZS_Q30_ONE * (a == 2 ? -1.0 : 1.0);
    }
    return s;
}

/* Distance in px from a pixel's middle to the nearest edge of a triangle; `off` world units of
 * error become px where the edge is nearest, and are taken away. */
static double edge_distance(const struct seen *s, const struct zs_camera *c, int x, int y,
                            double off)
{
    const double focal = (double)c->focal / 4294967296.0, z_near = (double)c->z_near / 65536.0;
    double least = INFINITY;
    for (int k = 0; k < 3; k++) {
        double a[3], b[3], d[2], e[2];
        memcpy(a, s->p[k], sizeof a);
        memcpy(b, s->p[(k + 1) % 3], sizeof b);
        if (a[2] < z_near && b[2] < z_near)
            continue;
        for (int side = 0; side < 2; side++) { /* cut before the eye */
            double *from = side ? b : a, *to = side ? a : b;
            if (from[2] < z_near) {
                const double f = (z_near - from[2]) / (to[2] - from[2]);
                for (int i = 0; i < 3; i++)
                    from[i] += f * (to[i] - from[i]);
            }
        }
        const double pa[2] = { W / 2.0 + focal * a[0] / a[2], H / 2.0 - focal * a[1] / a[2] };
        const double pb[2] = { W / 2.0 + focal * b[0] / b[2], H / 2.0 - focal * b[1] / b[2] };
        const double p[2] = { x + 0.5, y + 0.5 };
        for (int i = 0; i < 2; i++) {
            d[i] = pb[i] - pa[i];
            e[i] = p[i] - pa[i];
        }
        const double squared = d[0] * d[0] + d[1] * d[1];
        const double f =
            squared > 0.0 ? fmin(fmax((d[0] * e[0] + d[1] * e[1]) / squared, 0.0), 1.0) : 0.0;
        const double gap = hypot(e[0] - f * d[0], e[1] - f * d[1]) - off * focal / fmin(a[2], b[2]);
        least = fmin(least, gap);
    }
    return least;
}

/* z of a triangle's plane at a pixel, and how much of it an error of `off` may move it. */
static double depth_at(const struct seen *s, const struct zs_camera *c, int x, int y, double off,
                       double *slack)
{
    const double focal = (double)c->focal / 4294967296.0;
    const double ray[3] = { (x + 0.5 - W / 2.0) / focal, -(y + 0.5 - H / 2.0) / focal, 1.0 };
    double a[3], b[3], n[3], along = 0.0, at = 0.0, length = 0.0;
    for (int k = 0; k < 3; k++) {
        a[k] = s->p[1][k] - s->p[0][k];
        b[k] = s->p[2][k] - s->p[0][k];
    }
    for (int k = 0; k < 3; k++) {
        n[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
        along += n[k] * ray[k];
        at += n[k] * s->p[0][k];
        length += n[k] * n[k];
    }
    const double z = at / along;
    const double bucket = z * z / 65535.0 / ((double)c->z_near / 65536.0);
    *slack = 3.0 * (off + z / focal / 256.0) * sqrt(length) / fabs(along) + 2.0 * bucket;
    return z;
}

static uint32_t *load(const char *file, size_t *n)
{
    FILE *f = fopen(file, "rb");
    static uint8_t block[64000000];
    if (!f)
        wrong("no %s", file);
    const size_t bytes = fread(block, 1, sizeof block, f);
    fclose(f);
    *n = bytes / 4;
    uint32_t *v = malloc(bytes + 1);
    for (size_t i = 0; i < *n; i++)
        v[i] = block[4 * i] | (uint32_t)block[4 * i + 1] << 8 | (uint32_t)block[4 * i + 2] << 16 |
               (uint32_t)block[4 * i + 3] << 24;
    return v;
}

/* Number + 1 of the converted triangle of each one in the file; 0: left out. */
static uint32_t *turn_round(const uint32_t *map, size_t n, uint32_t *most)
{
    if (n != M_TRIANGLES)
        wrong("the map has %zu triangles", n);
    *most = 0;
    for (size_t i = 0; i < n; i++)
        *most = map[i] > *most ? map[i] : *most;
    uint32_t *of = calloc(*most + 1, sizeof *of);
    for (size_t i = 0; i < n; i++) {
        if (map[i] == 0 || of[map[i]] != 0)
            wrong("the map names triangle %u twice", map[i]);
        of[map[i]] = (uint32_t)i + 1;
    }
    return of;
}

/* map, of: of the file's triangles and back; most: the last one of `of` */
static void compare(int n, const double place[5], const uint32_t *map, const uint32_t *of, uint32_t most,
                    const char *ids_file)
{
    static uint32_t id[H][W];
    struct zs_camera camera;
    size_t n_ids;
    uint32_t drawn = 0, differ = 0, by_depth = 0;
    uint32_t *was = load(ids_file, &n_ids);
    const double off = place[3] * place[4] * 0.8661 *
                       (m_mesh[0].pos_lo ? 1.0 / 256.0 : 1.0); /* half a cube's diagonal */
    if (n_ids != W * H)
        wrong("%s has %zu pixels", ids_file, n_ids);
    camera_of(n, &camera);
    number(id, &camera);
    for (int i = 0; i < W * H; i++) {
        const int x = i % W, y = i / W;
        const uint32_t a = was[i] <= most ? of[was[i]] : 0, b = id[y][x];
        drawn += b != 0;
        if (b == 0 ? was[i] == 0 : map[b - 1] == was[i])
            continue;
        differ++;
        struct seen sa, sb;
        double gap = INFINITY;
        if (a) {
            sa = see(a - 1, &camera);
            gap = fmin(gap, edge_distance(&sa, &camera, x, y, off));
        }
        if (b) {
            sb = see(b - 1, &camera);
            gap = fmin(gap, edge_distance(&sb, &camera, x, y, off));
        }
        if (gap > 4.0 / 256.0 && a && b) { /* both are there: then they lie equally far */
            double slack[2];
            const double z = depth_at(&sa, &camera, x, y, off, &slack[0]);
            if (fabs(z - depth_at(&sb, &camera, x, y, off, &slack[1])) <= slack[0] + slack[1]) {
                by_depth++;
                continue;
            }
        }
        if (gap > 4.0 / 256.0)
            wrong("pixel %d,%d of view %d shows triangle %u, not %u, and no edge of them is nearer "
                  "than %.3f px",
                  x, y, n, b ? map[b - 1] : 0, was[i], gap);
    }
    printf("%u %u %u\n", drawn, differ, by_depth);
    free(was);
}

static void compare_all(const double place[5], const char *map_file, char **ids_files)
{
    size_t n_map;
    uint32_t most, *map = load(map_file, &n_map), *of = turn_round(map, n_map, &most);
    for (int n = 0; n < N_VIEWS; n++)
        compare(n, place, map, of, most, ids_files[n]);
    free(map);
    free(of);
}

/* ---- Against the file ------------------------------------------------------------------------ */

#define FILE_MAX 1000000

/* An OBJ of v, vt, vn and f, as fans; corners of triangles by numbers from 1, 0: none. */
static double file_v[3][FILE_MAX][3]; /* v, vt, vn */
static int file_tri[FILE_MAX][3][3];  /* triangle, corner, which */

static uint32_t read_obj(const char *name)
{
    FILE *f = fopen(name, "r");
    char line[400];
    int n[3] = { 0, 0, 0 };
    uint32_t n_tris = 0;
    if (!f)
        wrong("no %s", name);
    while (fgets(line, sizeof line, f)) {
        const int kind = line[0] != 'v' ? -1 : line[1] == ' ' ? 0 : line[1] == 't' ? 1 : 2;
        if (kind >= 0)
            n[kind] += sscanf(line + 2, "%lf %lf %lf", &file_v[kind][n[kind] + 1][0],
                              &file_v[kind][n[kind] + 1][1], &file_v[kind][n[kind] + 1][2]) > 1;
        if (line[0] != 'f')
            continue;
        int corner[3][3] = { { 0 } }, k = 0;
        for (char *word = strtok(line + 1, " \n"); word; word = strtok(NULL, " \n"), k++) {
            int c[3] = { 0, 0, 0 };
            if (sscanf(word, "%d/%d/%d", &c[0], &c[1], &c[2]) < 1)
                wrong("%s has a face that this cannot read", name);
            c[0] += c[0] < 0 ? n[0] + 1 : 0;
            memcpy(corner[k > 2 ? 2 : k], c, sizeof c);
            if (k >= 2) {
                memcpy(file_tri[n_tris++], corner, sizeof corner);
                memcpy(corner[1], c, sizeof c);
            }
        }
    }
    fclose(f);
    return n_tris;
}

static void compare_corner(const struct zs_mesh *m, uint32_t v, const int c[3],
                           const double place[5], double worst[3])
{
    double p[3], across = 0.0, along = 0.0;
    vertex(m, v, p);
    for (int k = 0; k < 3; k++)
        worst[0] = fmax(worst[0], fabs(place[k] + place[3] * p[k] - file_v[0][c[0]][k]));
    for (int k = 0; m->uv && k < 2; k++) {
        const double uv = ldexp(m->uv[v][k], -m->uv_bits), given = file_v[1][c[1]][k];
        const double d = uv - (k == 0 ? given : 1.0 - given);
        worst[1] = fmax(worst[1], fabs(d - rint(d))); /* whole pictures do not matter */
    }
    for (int k = 0; m->normal && c[2] && k < 3; k++) {
        const double *given = file_v[2][c[2]];
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        across += pow(m->normal[v][i] * given[j] - m->normal[v][j] * given[i], 2.0);
        along += m->normal[v][k] * given[k];
    }
    if (m->normal && c[2])
        worst[2] = fmax(worst[2], atan2(sqrt(across), along) * 180.0 / PI);
}

/* Prints the largest errors: of a coordinate in model units, of u or v, of a normal in degrees. */
static void places(const double place[5], const char *obj, const char *map_file)
{
    size_t n_map;
    uint32_t *map = load(map_file, &n_map), at = 0;
    const uint32_t n_tris = read_obj(obj);
    double worst[3] = { 0.0, 0.0, 0.0 };
    for (uint32_t i = 0; i < M_INSTANCES; i++)
        for (uint32_t t = 0; t < m_mesh[i].n_tris; t++, at++) {
            if (at >= n_map || map[at] == 0 || map[at] > n_tris)
                wrong("the map ends or names a triangle that is not there");
            for (int k = 0; k < 3; k++)
                compare_corner(&m_mesh[i], m_mesh[i].tri[t][k], file_tri[map[at] - 1][k], place,
                               worst);
        }
    free(map);
    printf("%.9g %.9g %.4f\n", worst[0], worst[1], worst[2]);
}

static void draw(int n)
{
    struct zs_camera camera;
    camera_of(n, &camera);
    render(m_instance, &camera, zs_rgb565(10, 20, 60));
    printf("P6 %d %d 255\n", W, H);
    for (int i = 0; i < W * H; i++) {
        const unsigned c = frame[i / W][i % W];
        putchar((int)((c >> 11) * 255 / 31));
        putchar((int)((c >> 5 & 63) * 255 / 63));
        putchar((int)((c & 31) * 255 / 31));
    }
}

int main(int argc, char **argv)
{
    const char *what = argc > 1 ? argv[1] : "";
    const int n = argc > 2 ? atoi(argv[2]) : 0;
    double place[5] = { 0 };
    for (int i = 0; i < 5 && i + 3 < argc; i++)
        place[i] = strtod(argv[i + 3], NULL);
    if (n < 0 || n >= N_VIEWS)
        wrong("no view %d", n);
    if (strcmp(what, "check") == 0)
        check();
    else if (strcmp(what, "views") == 0 && argc == 8)
        for (int k = 0; k < N_VIEWS; k++)
            print_view(k, place);
    else if (strcmp(what, "compare") == 0 && argc == 9 + N_VIEWS)
        compare_all(place, argv[8], argv + 9);
    else if (strcmp(what, "places") == 0 && argc == 10)
        places(place, argv[8], argv[9]);
    else if (strcmp(what, "draw") == 0 && argc == 3)
        draw(n);
    else
        wrong("probe: no such thing: %s", what);
    return 0;
}
