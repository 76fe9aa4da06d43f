/* Random scenes: see random_scenes.h.
 *
 * SPDX-License-Identifier: MIT
 */
#include "random_scenes.h"

#include <stdlib.h>
#include <string.h>

#include "frame.h"
#include "prng_log.h"
#include "sim.h"

#define VERTS 256
#define TRIS 400
#define SIZE 12000 /* mesh steps from the middle */

struct sim_scatter_mesh {
    struct zs_mesh mesh;
    int16_t pos[VERTS][3];
    uint8_t pos_lo[VERTS][3];
    zs_q1_15 normal[VERTS][3];
    int16_t uv[VERTS][2];
    struct zs_rgb vertex_rgb[VERTS], face_rgb[TRIS];
    uint16_t face_raw[TRIS];
    uint16_t tri[TRIS][3];
};

void sim_scatter_alloc(struct sim_scatter *s)
{
    memset(s, 0, sizeof *s);
    s->mesh = sim_alloc(SCATTER_MESHES, sizeof *s->mesh);
    s->texel = sim_alloc(256 * 256, sizeof *s->texel);
    s->number = sim_alloc(64 * 32, sizeof *s->number);
}

void sim_scatter_free(struct sim_scatter *s)
{
    free(s->mesh);
    free(s->texel);
    free(s->number);
    memset(s, 0, sizeof *s);
}

/* ---- Meshes --------------------------------------------------------------------------------- */

static uint16_t add_vertex(struct sim_scatter_mesh *m, struct prng *r, double x, double y,
                           double z)
{
    const uint32_t v = m->mesh.n_verts++;
    const double at[3] = { x, y, z };
    int32_t dir[3];
    zs_q2_30 unit[3] = { 0, 0, ZS_Q30_ONE };
    for (int c = 0; c < 3; c++) {
        const double p = at[c] > 16000 ? 16000 : at[c] < -16000 ? -16000 : at[c];
        m->pos[v][c] = (int16_t)floor(p);
        m->pos_lo[v][c] = (uint8_t)((p - floor(p)) * 256);
        dir[c] = (int32_t)p + prng_range(r, -SIZE / 4, SIZE / 4);
    }
    (void)zs_unit(unit, dir);
    for (int c = 0; c < 3; c++)
        m->normal[v][c] = (zs_q1_15)(unit[c] / 32768 > 32767 ? 32767 : unit[c] / 32768);
    for (int c = 0; c < 2; c++)
        m->uv[v][c] = (int16_t)(at[c] / SIZE * 4096 + at[2] / SIZE * 1000);
    return (uint16_t)v;
}

static void add_tri(struct sim_scatter_mesh *m, uint32_t a, uint32_t b, uint32_t c)
{
    uint16_t *t = m->tri[m->mesh.n_tris++];
    t[0] = (uint16_t)a;
    t[1] = (uint16_t)b;
    t[2] = (uint16_t)c;
}

static void soup(struct sim_scatter_mesh *m, struct prng *r)
{
    const uint32_t n = 3 + prng_pick(r, 60);
    for (uint32_t k = 0; k < n; k++) {
        const double size = prng_real_log(r, SIZE / 500.0, SIZE);
        double first[3], at[3];
        for (int c = 0; c < 3; c++)
            first[c] = prng_real(r, -SIZE, SIZE);
        for (int v = 0; v < 3; v++) {
            for (int c = 0; c < 3; c++)
                at[c] = first[c] + prng_real(r, -size, size);
            (void)add_vertex(m, r, at[0], at[1], at[2]);
        }
        add_tri(m, 3 * k, 3 * k + 1, 3 * k + 2);
        const uint32_t again = prng_pick(r, 10);
        if (again < 2) /* the same once more */
            add_tri(m, 3 * k + again, 3 * k + (1 + again) % 3, 3 * k + (2 + again) % 3);
    }
}

static void box(struct sim_scatter_mesh *m, struct prng *r)
{
    static const uint16_t faces[12][3] = { { 4, 5, 7 }, { 4, 7, 6 }, { 1, 0, 2 }, { 1, 2, 3 },
                                           { 5, 1, 3 }, { 5, 3, 7 }, { 0, 4, 6 }, { 0, 6, 2 },
                                           { 6, 7, 3 }, { 6, 3, 2 }, { 0, 1, 5 }, { 0, 5, 4 } };
    double half[3];
    for (int c = 0; c < 3; c++)
        half[c] = prng_real_log(r, SIZE / 50.0, SIZE);
    for (int v = 0; v < 8; v++)
        (void)add_vertex(m, r, v & 1 ? half[0] : -half[0], v & 2 ? half[1] : -half[1],
                         v & 4 ? half[2] : -half[2]);
    for (int t = 0; t < 12; t++)
        add_tri(m, faces[t][0], faces[t][1], faces[t][2]);
}

static void ball(struct sim_scatter_mesh *m, struct prng *r)
{
    const uint32_t rings = 3 + prng_pick(r, 8), sectors = 3 + prng_pick(r, 12);
    const int bumpy = (int)prng_pick(r, 2);
    const double bump = bumpy ? prng_real(r, 0, 0.2) : 0;
    for (uint32_t y = 0; y <= rings; y++)
        for (uint32_t x = 0; x < sectors; x++) {
            const double up = 3.14159265 * (0.5 - (double)y / rings),
                         round = 6.2831853 * x / sectors;
            const double size = SIZE * (1 + bump * prng_real(r, -1, 1));
            (void)add_vertex(m, r, size * cos(up) * cos(round), size * sin(up),
                             -size * cos(up) * sin(round));
        }
    for (uint32_t y = 0; y < rings; y++)
        for (uint32_t x = 0; x < sectors; x++) {
            const uint32_t a = y * sectors + x, b = y * sectors + (x + 1) % sectors;
            add_tri(m, a, a + sectors, b + sectors);
            add_tri(m, a, b + sectors, b);
        }
}

static void ribbon(struct sim_scatter_mesh *m, struct prng *r)
{
    const uint32_t n = 4 + prng_pick(r, 100);
    const double width = prng_real_log(r, SIZE / 300.0, SIZE / 2.0);
    double at[3] = { -SIZE, 0, 0 };
    for (uint32_t k = 0; k < n; k++) {
        at[0] += 2.0 * SIZE / n * prng_real(r, 0.3, 1.6);
        at[1] += prng_real(r, -width, width) / 2;
        at[2] += prng_real(r, -width, width);
        (void)add_vertex(m, r, at[0], at[1] + (k % 2 ? width : -width) / 2, at[2]);
        if (k >= 2)
            add_tri(m, k % 2 ? k - 1 : k - 2, k % 2 ? k - 2 : k - 1, k);
    }
}

static void ground(struct sim_scatter_mesh *m, struct prng *r)
{
    const uint32_t n = 1 + prng_pick(r, 12);
    const double bump = SIZE * 0.1 * prng_pick(r, 2), jitter = 0.8 * SIZE / n;
    for (uint32_t z = 0; z <= n; z++)
        for (uint32_t x = 0; x <= n; x++) {
            const double jx = x && x < n ? jitter : 0, jz = z && z < n ? jitter : 0;
            const double off_x = prng_real(r, -jx, jx), off_z = prng_real(r, -jz, jz);
            const double up = prng_real(r, -bump, bump);
            (void)add_vertex(m, r, SIZE * (2.0 * x / n - 1) + off_x, up,
                             SIZE * (2.0 * z / n - 1) + off_z);
        }
    for (uint32_t z = 0; z < n; z++)
        for (uint32_t x = 0; x < n; x++) {
            const uint32_t a = z * (n + 1) + x, b = a + n + 1;
            add_tri(m, a, b, a + 1);
            add_tri(m, a + 1, b, b + 1);
        }
}

static struct zs_rgb random_rgb(struct prng *r)
{
    const uint64_t bits = prng_next(r);
    const struct zs_rgb c = { (uint8_t)bits, (uint8_t)(bits >> 8), (uint8_t)(bits >> 16) };
    return c;
}

static void bound(struct sim_scatter_mesh *m)
{
    double most = 0;
    for (uint32_t v = 0; v < m->mesh.n_verts; v++) {
        double square = 0;
        for (int c = 0; c < 3; c++)
            square += (m->pos[v][c] + 1.0) * (m->pos[v][c] + 1.0);
        most = fmax(most, square);
    }
    m->mesh.radius = (uint16_t)(sqrt(most) + 3);
}

static void mesh_make(struct sim_scatter_mesh *m, struct prng *r)
{
    static void (*const kinds[])(struct sim_scatter_mesh *,
                                 struct prng *) = { soup, box, ball, ribbon, ground };
    memset(&m->mesh, 0, sizeof m->mesh);
    kinds[prng_pick(r, 5)](m, r);
    for (uint32_t v = 0; v < m->mesh.n_verts; v++)
        m->vertex_rgb[v] = random_rgb(r);
    for (uint32_t t = 0; t < m->mesh.n_tris; t++) {
        m->face_rgb[t] = random_rgb(r);
        m->face_raw[t] = (uint16_t)prng_next(r);
    }
    bound(m);
    m->mesh.scale = ZS_Q16_ONE;
    m->mesh.pos = (const int16_t(*)[3])m->pos;
    m->mesh.pos_lo = (const uint8_t(*)[3])m->pos_lo;
    m->mesh.normal = (const zs_q1_15(*)[3])m->normal;
    m->mesh.uv = (const int16_t(*)[2])m->uv;
    m->mesh.uv_bits = 12;
    m->mesh.tri = (const uint16_t(*)[3])m->tri;
    m->mesh.vertex_rgb = prng_pick(r, 4) ? m->vertex_rgb : NULL;
    m->mesh.face_rgb = prng_pick(r, 4) ? m->face_rgb : NULL;
    m->mesh.face_raw = prng_pick(r, 4) ? m->face_raw : NULL;
}

/* ---- What they look like -------------------------------------------------------------------- */

static void textures_make(struct sim_scatter *s, struct prng *r)
{
    for (int i = 0; i < 256 * 256; i++)
        s->texel[i] = (uint16_t)prng_next(r);
    for (int i = 0; i < 64 * 32; i++)
        s->number[i] = (uint8_t)prng_pick(r, 16);
    for (int i = 0; i < 16; i++)
        s->palette[i] = (uint16_t)prng_next(r);
    const struct zs_texture all[SCATTER_TEXTURES] = {
        { .format = &zs_texel_565, .texel = s->texel, .log2_w = 8, .log2_h = 8 },
        { .format = &zs_texel_pal8, .texel = s->number, .palette = s->palette, .n_colors = 16, .log2_w = 6, .log2_h = 5,
          .clamp = ZS_CLAMP_U | ZS_CLAMP_V },
        { .format = &zs_texel_565, .texel = s->texel, .log2_w = 5, .log2_h = 9, .clamp = ZS_CLAMP_U }
    };
    memcpy(s->texture, all, sizeof all);
}

static void material_make(struct sim_scatter *s, struct prng *r, struct zs_material *m)
{
    static const struct zs_shader *const shaders[] = {
        &zs_shade_raw,    &zs_shade_flat,    &zs_shade_smooth,       &zs_shade_flat,
        &zs_shade_smooth, &zs_shade_texture, &zs_shade_texture_flat, &zs_shade_texture_smooth
    };
    const uint32_t shader = prng_pick(r, 8);
    memset(m, 0, sizeof *m);
    m->shader = shaders[shader];
    m->rgb = random_rgb(r);
    m->cull = (uint8_t)(prng_pick(r, 3)   ? ZS_CULL_BACK
                        : prng_pick(r, 2) ? ZS_CULL_NONE
                                                : ZS_CULL_FRONT);
    if (shader >= 5) {
        m->texture = &s->texture[prng_pick(r, SCATTER_TEXTURES)];
        s->textured = 1;
    }
}

static void light_make(struct zs_light *light, struct prng *r)
{
    int32_t dir[3];
    for (int c = 0; c < 3; c++)
        dir[c] = prng_range(r, c < 2 ? -99 : 1, 99);
    (void)zs_unit(light->dir, dir);
    light->ambient = prng_pick(r, ZS_Q16_ONE + 1);
    light->diffuse = prng_pick(r, ZS_Q16_ONE + 1);
}

/* ---- Where they stand ----------------------------------------------------------------------- */

struct lens {                        /* world units and pixels */
    double near, far, focal, height; /* height: orthographic, of the frame */
};

static void camera_make(struct sim_scatter *s, struct prng *r, struct lens *lens)
{
    int32_t up[3], eye[3], dir[3];
    struct zs_camera *c = &s->camera;
    const int ortho = prng_pick(r, 7) == 0;
    const double near = floor(prng_real_log(r, 500, 5000));
    const double far = floor(near * prng_real_log(r, 10, 5000));
    for (int k = 0; k < 3; k++) {
        up[k] = k == 1 ? 100 : prng_range(r, -20, 20);
        eye[k] = prng_range(r, -100000, 100000);
        dir[k] = prng_range(r, -99, 99);
    }
    dir[2] = dir[2] < 0 ? dir[2] - 30 : dir[2] + 30; /* not along up */
    (void)zs_camera_perspective(c, 8192, s->config.height, 1, 2);
    (void)zs_camera_look_along(c, eye, dir, up);
    lens->near = near;
    lens->far = far;
    lens->focal = s->config.width * prng_real_log(r, 0.4, 3);
    lens->height = floor(far * prng_real_log(r, 0.05, 1));
    c->projection = (uint8_t)(ortho ? ZS_ORTHOGRAPHIC : ZS_PERSPECTIVE);
    c->z_near = (zs_q48_16)(near * 65536);
    c->z_far = (zs_q48_16)(far * 65536);
    c->focal = (zs_uq32_32)(lens->focal * 4294967296.0);
    c->height = (zs_q48_16)(lens->height * 65536);
}

/* A mapping that the camera can take, and bits that reach to far. */
static void depth_make(struct sim_scatter *s, struct prng *r, const struct lens *lens)
{
    static const struct zs_depth *const mappings[] = { &zs_depth_recip, &zs_depth_linear,
                                                       &zs_depth_float, &zs_depth_e3m13,
                                                       &zs_depth_e4m12, &zs_depth_e5m11 };
    s->config.depth = s->camera.projection == ZS_ORTHOGRAPHIC ? &zs_depth_linear
                                                              : mappings[prng_pick(r, 6)];
    s->config.depth_bits = (uint8_t)(prng_pick(r, 3) ? 16 : prng_range(r, 8, 15));
    if (s->config.depth == &zs_depth_e3m13) /* its last key stands for 2^(4 + bits) near */
        while (ldexp(lens->near, 4 + s->config.depth_bits) < lens->far * 2)
            s->config.depth_bits++;
}

static void place(struct sim_scatter *s, struct prng *r, const struct lens *lens,
                  struct zs_instance *in)
{
    const struct zs_camera *c = &s->camera;
    const int ortho = c->projection == ZS_ORTHOGRAPHIC;
    const double z = prng_real_log(r, lens->near * 0.4, lens->far * 1.2);
    const double px = ortho ? lens->height / s->config.height : z / lens->focal; /* world units */
    const double size = fmin(prng_real_log(r, 0.3, 2.0 * s->config.width) * px, lens->far);
    const double right = prng_real(r, -0.8, 0.8), up = prng_real(r, -0.8, 0.8);
    const double at[3] = { right * s->config.width * px, up * s->config.height * px, -z };
    const uint64_t turns = prng_next(r);
    zs_pose_identity(&in->pose);
    zs_pose_turn(&in->pose, (zs_turn)turns, (zs_turn)(turns >> 16), (zs_turn)(turns >> 32));
    for (int k = 0; k < 3; k++) {
        double p = c->pos[k];
        for (int a = 0; a < 3; a++)
            p += at[a] * (double)c->rot[3 * a + k] / 1073741824.0;
        in->pose.pos[k] = (int32_t)fmin(fmax(p, -5e8), 5e8);
    }
    const double scale = fmin(fmax(size / SIZE * 65536, 1), 32767.0 * 65536);
    in->pose.scale = (zs_uq16_16)scale;
}

void sim_scatter_make(struct sim_scatter *s, uint64_t seed, uint16_t width, uint16_t height)
{
    struct prng r = { seed };
    struct lens lens;
    sim_frame_config(&s->config, width, height, ZS_VARYINGS_TEXTURE_SMOOTH);
    s->textured = 0;
    textures_make(s, &r);
    for (int n = 0; n < SCATTER_MESHES; n++)
        mesh_make(&s->mesh[n], &r);
    camera_make(s, &r, &lens);
    depth_make(s, &r, &lens);
    s->scene.instance = s->instance;
    s->scene.n_instances = 3 + prng_pick(&r, SCATTER_INSTANCES - 2);
    s->scene.background = (uint16_t)prng_next(&r);
    light_make(&s->scene.light, &r);
    for (uint32_t n = 0; n < s->scene.n_instances; n++) {
        memset(&s->instance[n], 0, sizeof s->instance[n]);
        material_make(s, &r, &s->material[n]);
        s->instance[n].mesh = &s->mesh[prng_pick(&r, SCATTER_MESHES)].mesh;
        s->instance[n].material = &s->material[n];
        place(s, &r, &lens, &s->instance[n]);
    }
    s->config.strip_h = (uint16_t)prng_range(&r, 1, height);
    if (prng_pick(&r, 2)) {
        s->config.max_tris = (uint16_t)prng_range(&r, 20, 2000);
        s->config.max_verts = (uint16_t)prng_range(&r, 20, 2000);
    }
}
