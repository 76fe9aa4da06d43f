/* Stress case 28: one checksum a scene, the same for every compiler, level and machine.
 *
 * Integers only, no tables of numbers: everything is procedural. Prints "name fnv1a" a line, FNV-1a
 * over the frame's wire bytes and its depth keys; tests/records/checksums.txt has the lines. Each is
 * drawn twice, by the core alone and with all accelerators: where the two differ, that is said and is
 * an error. With an argument, a folder, it also writes each frame there as a PPM, to be looked at
 * before a golden is changed.
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdio.h>

#include "shapes.h"
#include "zs_fast.h"

#define W 120
#define H 90
#define STRIP 11
#define TRIS 2500
#define VERTS 1500

ZS_ARENA(arena, ZS_ARENA_BYTES(W, H, STRIP, TRIS, VERTS, ZS_VARYINGS_SMOOTH, 2));

static struct shape shapes[2];
static int16_t uv[2][SHAPE_VERTS][2];
static uint16_t direct[32 * 64];
static uint8_t byte[64 * 16], nibble[32 * 32 / 2];
static uint16_t colors[256];

struct page {
    const char *name;
    struct zs_config config;
    struct zs_material material[5];
    struct zs_instance instance[5];
    struct zs_scene scene;
    struct zs_camera camera;
};

static void add(struct page *p, const struct shape *s, const struct zs_shader *shader, int32_t x,
                int32_t y, int32_t z, uint8_t cull)
{
    const uint32_t n = p->scene.n_instances++;
    const struct zs_material material = { .shader = shader, .rgb = { 230, 140, 250 }, .cull = cull };
    p->material[n] = material;
    p->instance[n].mesh = &s->mesh;
    p->instance[n].material = &p->material[n];
    zs_pose_identity(&p->instance[n].pose);
    zs_pose_turn(&p->instance[n].pose, (zs_turn)(n * 7001u), (zs_turn)(n * 3003u),
                 (zs_turn)(n * 911u));
    p->instance[n].pose.pos[0] = x;
    p->instance[n].pose.pos[1] = y;
    p->instance[n].pose.pos[2] = z;
    p->scene.instance = p->instance;
}

static void look_from(struct page *p, int32_t x, int32_t y, int32_t z)
{
    const int32_t eye[3] = { x, y, z }, at[3] = { 0, 0, 0 }, up[3] = { 0, 1, 0 };
    (void)zs_camera_look_at(&p->camera, eye, at, up);
}

static void begin(struct page *p, const char *name, const struct zs_depth *depth)
{
    const struct page none = { 0 };
    static const struct zs_fast *const fast[] = { ZS_FAST_ALL, ZS_FAST_END };
    const struct zs_config config = {
        .width = W, .height = H, .strip_h = STRIP, .max_tris = TRIS, .max_verts = VERTS, .varyings = ZS_VARYINGS_SMOOTH,
        .buffers = 1, .subpixel_bits = 8, .depth_bits = 16, .depth = depth, .fast = fast
    };
    const int32_t light[3] = { 3, 5, 4 };
    *p = none;
    p->name = name;
    p->config = config;
    (void)zs_unit(p->scene.light.dir, light);
    p->scene.light.ambient = ZS_Q16_ONE / 5;
    p->scene.light.diffuse = ZS_Q16_ONE * 4 / 5;
    p->scene.background = 0x10a4;
    (void)zs_camera_perspective(&p->camera, 9000, H, 60, 60000);
}

/* ---- Textures -------------------------------------------------------------------------------- */

static const struct zs_texture texture_565 = { .format = &zs_texel_565, .texel = direct, .log2_w = 6, .log2_h = 5 };
static const struct zs_texture texture_pal8 = { .format = &zs_texel_pal8, .texel = byte, .palette = colors,
                                                .n_colors = 256, .log2_w = 4, .log2_h = 6, .clamp = ZS_CLAMP_U };
static const struct zs_texture texture_pal4 = { .format = &zs_texel_pal4, .texel = nibble, .palette = colors,
                                                .n_colors = 16, .log2_w = 5, .log2_h = 5 };
static const struct zs_texture texture_line = { .format = &zs_texel_565, .texel = direct, .log2_w = 6, .log2_h = 0,
                                                .clamp = ZS_CLAMP_V };

static void make_textures(void)
{
    struct prng dice = { 77 };
    for (uint32_t i = 0; i < 32u * 64u; i++)
        direct[i] = (uint16_t)((i & 63u) * 1040u + (i >> 6) * 33u);
    for (uint32_t i = 0; i < sizeof byte; i++)
        byte[i] = (uint8_t)((i & 15u) * 9u + (i >> 4) * 3u);
    for (uint32_t i = 0; i < sizeof nibble; i++)
        nibble[i] = (uint8_t)prng_next(&dice);
    for (uint32_t i = 0; i < 256u; i++)
        colors[i] = (uint16_t)prng_next(&dice);
}

/* Cover the page's instance n, drawn from shapes[shape], and let it meet depth by a state or NULL.
 * Coordinates are the position's: ten repeats to 20480 steps. */
static void cover(struct page *p, uint32_t n, uint32_t shape, const struct zs_texture *texture,
                  const struct zs_depth_state *state)
{
    struct zs_mesh *mesh = &shapes[shape].mesh;
    for (uint32_t v = 0; v < mesh->n_verts; v++) {
        uv[shape][v][0] = (int16_t)(mesh->pos[v][0] + mesh->pos[v][1] / 2);
        uv[shape][v][1] = (int16_t)(mesh->pos[v][2] - mesh->pos[v][1] / 2);
    }
    mesh->uv = (const int16_t (*)[2])uv[shape];
    mesh->uv_bits = 11;
    p->material[n].texture = texture;
    p->instance[n].depth_state = state;
}

/* ---- Scenes ---------------------------------------------------------------------------------- */

static void page_flat(struct page *p)
{
    begin(p, "flat", &zs_depth_recip);
    shape_sphere(&shapes[0], 14, 20, 3000);
    shape_torus(&shapes[1], 24, 12, 4200, 1200);
    add(p, &shapes[0], &zs_shade_flat, 0, 0, 0, ZS_CULL_BACK);
    add(p, &shapes[1], &zs_shade_flat, 500, 0, 0, ZS_CULL_BACK);
    add(p, &shapes[0], &zs_shade_raw, 3500, 900, -2000, ZS_CULL_NONE);
    look_from(p, 2000, 5000, 12000);
}

static void page_smooth(struct page *p)
{
    page_flat(p);
    p->name = "smooth";
    p->config.buffers = 2;
    p->material[0].shader = p->material[1].shader = &zs_shade_smooth;
    look_from(p, -6000, 7000, 8000);
}

static void page_clipped(struct page *p, const char *name, const struct zs_depth *depth)
{
    begin(p, name, depth);
    shape_ground(&shapes[0], 16, 20000, 700, 7);
    shape_sphere(&shapes[1], 9, 12, 1800);
    add(p, &shapes[0], &zs_shade_smooth, 0, -900, 0, ZS_CULL_NONE);
    add(p, &shapes[1], &zs_shade_smooth, 0, 200, 0, ZS_CULL_NONE);
    /* near opens it: see below */
    add(p, &shapes[1], &zs_shade_flat, 3505, 858, 5191, ZS_CULL_NONE);
    zs_pose_turn(&p->instance[0].pose, 0, 0, 0);
    look_from(p, 2000, 900, 6000);
    p->camera.z_near = (zs_q48_16)700 * 65536; /* the eye is inside the second sphere */
    p->camera.z_far = (zs_q48_16)19000 * 65536;
}

static void page_clipped_recip(struct page *p)
{
    page_clipped(p, "clipped", &zs_depth_recip);
}

static void page_small_pools(struct page *p)
{
    page_clipped(p, "clipped, small pools", &zs_depth_recip);
    p->config.max_tris = 5;
    p->config.max_verts = 7;
    p->config.strip_h = 3;
}

static void page_clipped_linear(struct page *p)
{
    page_clipped(p, "clipped, linear keys", &zs_depth_linear);
    p->config.depth_bits = 12;
}

static void page_ortho(struct page *p)
{
    begin(p, "orthographic", &zs_depth_linear);
    shape_soup(&shapes[0], 200, 5000, 3);
    shape_torus(&shapes[1], 20, 10, 4200, 1200);
    (void)zs_camera_orthographic(&p->camera, 11000, 6000, 14000);
    look_from(p, 4000, 5000, 8000);
    add(p, &shapes[1], &zs_shade_smooth, 0, 0, 0, ZS_CULL_NONE);
    add(p, &shapes[0], &zs_shade_flat, 0, 0, 0, ZS_CULL_NONE);
}

static void page_coarse(struct page *p)
{
    page_flat(p);
    p->name = "4 sub-pixel bits, 8 bits of depth";
    p->config.subpixel_bits = 4;
    p->config.depth_bits = 8;
    p->camera.z_near = (zs_q48_16)4000 * 65536;
    p->config.max_tris = 100;
    p->config.max_verts = 90;
}

static void page_coarse_linear(struct page *p)
{
    page_clipped(p, "4 sub-pixel bits, linear keys", &zs_depth_linear);
    p->config.subpixel_bits = 4;
}

/* Fine positions, scales that are no powers of two, a pose composed a hundred times, an orbiting
 * eye. */
static void page_composed(struct page *p)
{
    begin(p, "composed", &zs_depth_recip);
    shape_torus(&shapes[0], 26, 12, 90, 37);
    shapes[0].mesh.pos_lo = (const uint8_t (*)[3])shapes[0].pos_lo;
    shapes[0].mesh.scale = 1234567;
    add(p, &shapes[0], &zs_shade_smooth, 100, -50, 33, ZS_CULL_BACK);
    add(p, &shapes[0], &zs_shade_flat, -700, 250, -133, ZS_CULL_BACK);
    p->instance[1].pose.scale = 51234;
    const int32_t axis[3] = { 1, -2, 3 }, at[3] = { 0, 0, 0 };
    for (uint32_t n = 0; n < 100; n++)
        (void)zs_pose_rotate(&p->instance[0].pose, axis, (zs_turn)(n * 777u));
    (void)zs_camera_orbit(&p->camera, at, 5000, 40000, 5000);
}

static void page_textured(struct page *p)
{
    page_flat(p);
    p->name = "textured, e3m13 keys";
    p->config.depth = &zs_depth_e3m13;
    p->material[0].shader = &zs_shade_texture;
    p->material[1].shader = &zs_shade_texture_flat;
    p->material[2].shader = &zs_shade_texture_smooth;
    cover(p, 0, 0, &texture_565, 0);
    cover(p, 1, 1, &texture_pal8, 0);
    cover(p, 2, 0, &texture_pal4, 0);
}

/* Sub-spans of all lengths, planes through near, coordinates far beyond a clamped texture. */
static void page_textured_clipped(struct page *p)
{
    page_clipped(p, "textured, clipped, e4m12 keys", &zs_depth_e4m12);
    p->material[0].shader = &zs_shade_texture_smooth;
    p->material[1].shader = &zs_shade_texture;
    p->material[2].shader = &zs_shade_texture_flat;
    cover(p, 0, 0, &texture_pal8, 0);
    cover(p, 1, 1, &texture_pal4, 0);
    cover(p, 2, 1, &texture_line, 0);
}

static void page_textured_small_pools(struct page *p)
{
    page_textured_clipped(p);
    p->name = "textured, small pools";
    p->config.max_tris = 5;
    p->config.max_verts = 7;
    p->config.strip_h = 3;
}

static void page_textured_linear(struct page *p)
{
    page_textured_clipped(p);
    p->name = "textured, clipped, linear keys";
    p->config.depth = &zs_depth_linear;
}

static void page_textured_ortho(struct page *p)
{
    page_ortho(p);
    p->name = "textured, orthographic";
    p->material[0].shader = &zs_shade_texture_smooth;
    p->material[1].shader = &zs_shade_texture;
    cover(p, 0, 1, &texture_565, 0);
    cover(p, 1, 0, &texture_pal4, 0);
}

/* A ball and the ground, again where they are: equal, before what is there without a key of its own,
 * and moved by its slope. */
static void page_states(struct page *p)
{
    static const struct zs_depth_state later = { .func = ZS_DEPTH_LESS_EQUAL }, lent = { .read_only = 1, .bias = -400 };
    static const struct zs_depth_state leans = { .bias = 40, .slope_bias = -300 };
    page_clipped(p, "depth states, e5m11 keys", &zs_depth_e5m11);
    p->scene.n_instances = 1;
    add(p, &shapes[1], &zs_shade_flat, 0, 200, 0, ZS_CULL_NONE);
    add(p, &shapes[1], &zs_shade_texture, 0, 200, 0, ZS_CULL_NONE);
    add(p, &shapes[1], &zs_shade_raw, 600, -1200, 0, ZS_CULL_NONE);
    add(p, &shapes[0], &zs_shade_smooth, 0, -880, 0, ZS_CULL_NONE);
    p->instance[2].pose = p->instance[1].pose;
    p->instance[4].pose = p->instance[0].pose;
    cover(p, 2, 1, &texture_565, &later);
    p->instance[3].depth_state = &lent;
    p->instance[4].depth_state = &leans;
}

static void page_coarse_float(struct page *p)
{
    page_textured_clipped(p);
    p->name = "textured, 4 sub-pixel bits, 8 bits of e5m11";
    p->config.depth = &zs_depth_e5m11;
    p->config.subpixel_bits = 4;
    p->config.depth_bits = 8;
}

typedef void page_fn(struct page *p);
static page_fn *const pages[] = { page_flat, page_smooth, page_clipped_recip, page_small_pools,
                                  page_clipped_linear, page_ortho, page_coarse, page_coarse_linear,
                                  page_composed, page_textured, page_textured_clipped,
                                  page_textured_small_pools, page_textured_linear,
                                  page_textured_ortho, page_states, page_coarse_float };
#define N_PAGES (sizeof pages / sizeof pages[0])

/* ---- Drawing --------------------------------------------------------------------------------- */

struct sum {
    uint32_t hash;
    FILE *ppm;
};

static void hash_byte(struct sum *s, uint32_t byte)
{
    s->hash = (s->hash ^ byte) * 16777619u;
}

static void write_pixel(FILE *f, uint32_t c)
{
    fputc((int)((c >> 11) * 255u / 31u), f);
    fputc((int)((c >> 5 & 63u) * 255u / 63u), f);
    fputc((int)((c & 31u) * 255u / 31u), f);
}

/* All colours in the frame's order, then all keys: whatever the strips are. */
static int draw(struct page *p, struct sum *s)
{
    static struct zs_renderer r;
    static uint16_t keys[W * H];
    int err = zs_init(&r, &p->config, arena, sizeof arena);
    if (!err)
        err = zs_frame_begin(&r, &p->scene, &p->camera);
    struct zs_strip strip;
    while (!err && zs_frame_strip(&r, &strip) == 1) {
        for (uint32_t i = 0; i < (uint32_t)strip.w * strip.h; i++) {
            const uint8_t *px = &strip.px[2 * i];
            keys[(uint32_t)strip.y * W + i] = strip.depth[i];
            hash_byte(s, px[0]);
            hash_byte(s, px[1]);
            if (s->ppm)
                write_pixel(s->ppm, (uint32_t)px[0] << 8 | px[1]);
        }
    }
    if (!err)
        err = zs_frame_end(&r);
    for (uint32_t i = 0; i < W * H && !err; i++) {
        hash_byte(s, keys[i] >> 8);
        hash_byte(s, keys[i] & 255u);
    }
    return err;
}

static FILE *open_ppm(const char *folder, unsigned n)
{
    char path[512];
    if (!folder)
        return NULL;
    snprintf(path, sizeof path, "%s/checksum-%u.ppm", folder, n);
    FILE *f = fopen(path, "wb");
    if (f)
        fprintf(f, "P6\n%d %d\n255\n", W, H);
    return f;
}

static const struct zs_fast *const fast[] = { ZS_FAST_ALL, ZS_FAST_END };

int main(int argc, char **argv)
{
    static struct page page;
    int bad = 0;
    make_textures();
    for (unsigned n = 0; n < N_PAGES; n++) {
        pages[n](&page);
        struct sum s = { 2166136261u, open_ppm(argc > 1 ? argv[1] : NULL, n) }, with = { 2166136261u, NULL };
        int err = draw(&page, &s);
        if (s.ppm)
            fclose(s.ppm);
        page.config.fast = fast;
        err = err ? err : draw(&page, &with);
        if (err) {
            printf("%s: %s\n", page.name, zs_error_string(err));
            bad = 1;
        } else if (with.hash != s.hash) {
            printf("%s: %08lx by the core, %08lx with accelerators\n", page.name, (unsigned long)s.hash,
                   (unsigned long)with.hash);
            bad = 1;
        } else {
            printf("%08lx  %s\n", (unsigned long)s.hash, page.name);
        }
    }
    return bad;
}
