/* A probe is a grid of triangles in up to three layers, made from where its corners are to be on the screen and how far
 * away: sizes, depths and covered pixels are what the table says, whatever the lens. Layers are the same mesh, scaled
 * about the eye: the same picture, farther away.
 *
 * SPDX-License-Identifier: MIT
 */
#include "probes.h"

#include "stage.h"

#define LENGTH(a) (sizeof(a) / sizeof *(a))
#define W 128
#define H 96
#define TEX_LOG2 6u
#define TEX (1u << TEX_LOG2)

enum shade { RAW, RAW_FACES, FLAT, FLAT_GIVEN, SMOOTH, TEX_565, TEX_PAL8, TEX_PAL4, TEX_FLAT_565, TEX_FLAT_PAL,
             TEX_FLAT_PAL_200, TEX_SMOOTH_565, TEX_SMOOTH_PAL, SHADES };
static const char *const shade_name[SHADES] = {
    "raw", "raw_faces", "flat", "flat_given", "smooth", "tex_565", "tex_pal8", "tex_pal4", "tex_flat_565",
        "tex_flat_pal",
    "tex_flat_pal200", "tex_smooth_565", "tex_smooth_pal"
};

enum flag {
    AWAY = 1,      /* triangles turn their backs */
    BARE = 2,      /* vertices alone */
    NEAR_CUT = 4,  /* near lies within */
    STATE = 8,
    FINE = 16,     /* pos_lo */
    BESIDE = 32,   /* all triangles are to the left of the picture but for one column */
    BEHIND_US = 64, /* instances behind the eye too */
    SMALL_POOL = 128,
    ORTHO = 256,
    WALL = 512,    /* one large layer before the others */
    CLAMP = 1024,  /* textures end at their borders */
    DENSE = 2048,  /* 12 texels to a px: too many in a triangle for 15 bits */
    SPARSE = 4096, /* triangles in every other cell: vertices are shared by fewer */
    SCREEN = 8192, /* a wall before the others that fills the picture: instances are hidden */
    CROSS = 16384  /* layers at the same distance, every other one turned upside down: tilted ones intersect */
};

/* What to draw. Sizes in px; depths in units of which near has 4096. */
struct plan {
    uint8_t shade, nx, ny, layers;
    int8_t order;           /* 1 front to back, -1 back to front */
    uint8_t depth;          /* of depths[] */
    uint16_t cell;          /* q12_4 px */
    uint16_t z0, z1;        /* at the left top and right bottom of the grid */
    uint16_t flags, width, height, strip;
    uint8_t bend;           /* 0: light and colours change little over a triangle; 1: much */
    uint16_t tall;          /* 64ths of a cell's width that it is high, 0: 64 */
    uint8_t method;         /* of methods[]; 0: the depth buffer */
};

static int16_t pos[PROBE_VERTS][3];
static uint8_t pos_lo[PROBE_VERTS][3];
static uint16_t tri[PROBE_TRIS][3];
static zs_q1_15 normal[PROBE_VERTS][3], face_normal[PROBE_TRIS][3];
static uint16_t face_raw[PROBE_TRIS];
static int16_t uv[PROBE_VERTS][2];
static uint16_t texel_565[TEX * TEX], palette[200];
static uint8_t texel_pal8[TEX * TEX], texel_pal4[TEX * TEX / 2];
static struct zs_mesh mesh, wall;
static struct zs_material material, plain;
static struct zs_texture texture;
static const struct zs_depth_state state = { .read_only = 1, .bias = -2 };
static const struct zs_depth *const depths[] = { &zs_depth_float, &zs_depth_recip, &zs_depth_linear };
static const struct zs_shader *const shaders[SHADES] = {
    &zs_shade_raw, &zs_shade_raw, &zs_shade_flat, &zs_shade_flat, &zs_shade_smooth, &zs_shade_texture,
        &zs_shade_texture,
    &zs_shade_texture, &zs_shade_texture_flat, &zs_shade_texture_flat, &zs_shade_texture_flat, &zs_shade_texture_smooth,
    &zs_shade_texture_smooth
};
static const struct zs_fast *const fast[] = { ZS_FAST_ALL, ZS_FAST_END };
static const struct {
    const char *name;
    const struct zs_method *method;
    const struct zs_depth *depth; /* NULL: the plan's */
} methods[] = {
#define ROW(name_, depth_, ...) { "_" #name_, &zs_method_##name_, depth_ },
    { "", 0, 0 },
    ZS_METHOD_EACH(ROW)
#undef ROW
};

static uint32_t dice;
static uint32_t roll(uint32_t n) /* 0 .. n - 1, n < 2^16 */
{
    dice = dice * 1664525u + 1013904223u;
    return (dice >> 16) * n >> 16;
}

/* ---- Arrays ------------------------------------------------------------------------------------- */

static void textures_make(void)
{
    for (uint32_t i = 0; i < TEX * TEX; i++) {
        const uint32_t x = i % TEX, y = i / TEX;
        texel_565[i] = (uint16_t)((x >> 1) << 11 | (x ^ y) << 5 | y >> 1);
        texel_pal8[i] = (uint8_t)((x * 3u + y * 5u) % 16u);
        texel_pal4[i / 2u] = (uint8_t)(texel_pal4[i / 2u] << 4 | (x + y) % 16u);
    }
    for (uint32_t i = 0; i < LENGTH(palette); i++)
        palette[i] = (uint16_t)(i * 2654435761u >> 16);
}

/* The vertex at a place on the screen, q_4 px, and a distance. */
static void vertex_put(uint32_t v, const struct plan *p, int32_t x_q4, int32_t y_q4, int32_t z)
{
    const int32_t focal = p->width * 16, from_x = x_q4 - p->width * 8, from_y = y_q4 - p->height * 8;
    const int32_t far = p->flags & ORTHO ? 8192 : z;
    pos[v][0] = (int16_t)(from_x * far / focal);
    pos[v][1] = (int16_t)(-from_y * far / focal);
    pos[v][2] = (int16_t)-z;
    for (int k = 0; k < 3; k++)
        pos_lo[v][k] = (uint8_t)roll(256);
    const int32_t n[3] = { (int32_t)roll(p->bend ? 8000u : 600u) - (p->bend ? 4000 : 300),
                           (int32_t)roll(p->bend ? 8000u : 600u) - (p->bend ? 4000 : 300), 8000 };
    zs_q2_30 unit[3];
    (void)zs_unit(unit, n);
    for (int k = 0; k < 3; k++)
        normal[v][k] = (zs_q1_15)(unit[k] >> 15 > 32767 ? 32767 : unit[k] >> 15);
    const int32_t times = p->flags & DENSE ? 96 : p->flags & CLAMP ? 3 : 8, from = p->flags & CLAMP ? 100 : 0;
    uv[v][0] = (int16_t)(x_q4 * times / 8 + from); /* a texel a px: 64 * 16 to the repeat; clamped: most within */
    uv[v][1] = (int16_t)(y_q4 * times / 8 + from);
}

static void mesh_fields(struct zs_mesh *m, const struct plan *p)
{
    static const struct zs_mesh none = { .pos = pos, .scale = ZS_Q16_ONE };
    *m = none;
    m->tri = (const uint16_t (*)[3])tri;
    m->normal = (const zs_q1_15 (*)[3])normal;
    m->uv = (const int16_t (*)[2])uv;
    m->uv_bits = 10;
    if (p->shade == FLAT_GIVEN || p->shade == TEX_FLAT_PAL)
        m->face_normal = (const zs_q1_15 (*)[3])face_normal;
    if (p->shade == RAW_FACES)
        m->face_raw = face_raw;
    if (p->flags & FINE)
        m->pos_lo = (const uint8_t (*)[3])pos_lo;
}

static void sphere(struct zs_mesh *m)
{
    int32_t lo[3] = { 32767, 32767, 32767 }, hi[3] = { -32768, -32768, -32768 }, r = 0;
    for (uint32_t v = 0; v < m->n_verts; v++)
        for (int k = 0; k < 3; k++) {
            lo[k] = pos[v][k] < lo[k] ? pos[v][k] : lo[k];
            hi[k] = pos[v][k] > hi[k] ? pos[v][k] : hi[k];
        }
    for (int k = 0; k < 3; k++) {
        m->center[k] = (int16_t)((lo[k] + hi[k]) / 2);
        r += (hi[k] - lo[k] + 1) / 2 + 2;
    }
    m->radius = (uint16_t)(r < 65535 ? r : 65535); /* more than the diagonal */
}

static void grid_make(const struct plan *p)
{
    const int32_t cell = p->cell, left = (p->width * 16 - p->nx * cell) / 2 - (p->flags & BESIDE ?
                                                                               p->width * 8 + p->nx * cell / 2 - cell :
                                                                                   0);
    const int32_t high = p->tall ? cell * p->tall / 64 : cell, top = (p->height * 16 - p->ny * high) / 2;
    uint32_t v = 0, t = 0;
    for (int32_t j = 0; j <= p->ny; j++)
        for (int32_t i = 0; i <= p->nx; i++, v++) {
            const int32_t step = cell * 5 / 8 > 1 ? cell * 5 / 8 : 1, rise = high * 5 / 8 > 1 ? high * 5 / 8 : 1;
            const int32_t x = left + i * cell + (int32_t)roll((uint32_t)step) - step / 2;
            const int32_t y = top + j * high + (int32_t)roll((uint32_t)rise) - rise / 2;
            const int32_t s = (256 * i / p->nx + 512 * j / p->ny) / 3; /* 0 .. 256 */
            vertex_put(v, p, x, y, (int32_t)p->z0 * p->z1 / ((p->z1 * (256 - s) + p->z0 * s) / 256));
        }
    for (uint32_t j = 0; j < p->ny && !(p->flags & BARE); j++)
        for (uint32_t i = 0; i < p->nx; i++)
            for (uint32_t k = 0; k < 2 && !(p->flags & SPARSE && (i + j) % 2u); k++, t++) {
                const uint32_t a = j * (p->nx + 1u) + i, b = a + p->nx + 1u;
                const uint32_t turn = p->flags & AWAY ? 1u : 0u;
                tri[t][0] = (uint16_t)(k ? a + 1u : a);
                tri[t][1 + turn] = (uint16_t)b;
                tri[t][2 - turn] = (uint16_t)(k ? b + 1u : a + 1u);
                for (int c = 0; c < 3; c++)
                    face_normal[t][c] = normal[a][c];
                face_raw[t] = (uint16_t)(t * 97u);
            }
    mesh_fields(&mesh, p);
    mesh.n_verts = v;
    mesh.n_tris = t;
    sphere(&mesh);
}

/* ---- The camera --------------------------------------------------------------------------------- */

static void lens(struct demo_frame *f, const struct plan *p)
{
    struct zs_camera *c = &f->camera;
    stage_unturned(c);
    c->projection = p->flags & ORTHO ? ZS_ORTHOGRAPHIC : ZS_PERSPECTIVE;
    c->focal = (zs_uq32_32)p->width << 32;
    c->height = (zs_q48_16)(8192 * p->height / p->width) << 16;
    c->z_near = (zs_q48_16)(p->flags & NEAR_CUT ? 9000 : 4096) << 16;
    c->z_far = (zs_q48_16)400000 << 16;
}

static void instances(struct demo_frame *f, const struct plan *p)
{
    if (p->flags & SCREEN) {
        static const uint16_t two[2][3] = { { 0, 1, 2 }, { 2, 1, 3 } };
        static int16_t corner[4][3];
        for (int k = 0; k < 4; k++) {
            corner[k][0] = (int16_t)(k & 2 ? 6000 : -6000);
            corner[k][1] = (int16_t)(k & 1 ? -4000 : 4000);
            corner[k][2] = -5000;
        }
        mesh_fields(&wall, p);
        wall.pos = (const int16_t (*)[3])corner;
        wall.tri = two;
        wall.n_verts = 4;
        wall.n_tris = 2;
        wall.radius = 9000;
        plain.shader = &zs_shade_raw;
        stage_put(f, &wall, &plain, 0, 0, 0, ZS_Q16_ONE);
    }
    if (p->flags & WALL) { /* the grid's corners, nearer */
        const uint32_t n = (uint32_t)p->nx + 1u, last = (uint32_t)p->ny * n;
        static uint16_t two[2][3];
        two[0][0] = 0;
        two[0][1] = (uint16_t)last;
        two[0][2] = two[1][0] = (uint16_t)(n - 1u);
        two[1][1] = (uint16_t)last;
        two[1][2] = (uint16_t)(last + n - 1u);
        wall = mesh;
        wall.tri = (const uint16_t (*)[3])two;
        wall.n_tris = 2;
        plain.shader = &zs_shade_raw;
        stage_put(f, &wall, &plain, 0, 0, 0, ZS_Q16_ONE * 4u / 5u);
    }
    for (uint32_t k = 0; k < p->layers; k++) {
        const uint32_t away = p->flags & CROSS ? 0u : p->order > 0 ? k : p->layers - 1u - k;
        struct zs_pose *pose = stage_put(f, &mesh, &material, 0, 0, 0, ZS_Q16_ONE + ZS_Q16_ONE / 16u * away);
        if (p->flags & CROSS && k & 1u)
            for (int i = 0; i < 6; i++)
                pose->rot[i] = -pose->rot[i];
        f->instance[f->scene.n_instances - 1u].depth_state = p->flags & STATE ? &state : 0;
        if (p->flags & BEHIND_US)
            stage_put(f, &mesh, &material, 0, 0, 200000, ZS_Q16_ONE);
    }
}

/* ---- The table ---------------------------------------------------------------------------------- */

static const struct plan base = { RAW, 8, 6, 1, 1, 0, 80, 11000, 12000, 0, W, H, 24, 0 };

/* Other methods than the depth buffer: each draws the same plans. */
static int method_plan(struct plan *p, uint32_t i)
{
    static const struct plan some[] = {
        { RAW, 24, 20, 1, 1, 0, 34, 11000, 12000, 0, W, H, 24, 0 },
        { RAW, 16, 12, 3, 1, 0, 70, 11000, 12000, 0, W, H, 24, 0 },
        { RAW, 16, 12, 3, -1, 0, 70, 11000, 11200, 0, W, H, 24, 0 },
        { RAW, 8, 6, 3, -1, 0, 160, 11000, 12000, 0, W, H, 24, 0 },
        { RAW, 4, 3, 3, 1, 0, 420, 11000, 12000, 0, W, H, 12, 0 },
        { RAW, 1, 1, 3, -1, 0, 1900, 11000, 12000, 0, W, H, 24, 0 },
        { RAW, 1, 1, 3, -1, 0, 1900, 11000, 12000, 0, W, H, 6, 0 },
        { RAW, 16, 12, 1, 1, 0, 100, 4300, 30000, 0, W, H, 24, 0 },
        { RAW, 2, 2, 2, 1, 0, 900, 8000, 16000, CROSS, W, H, 24, 0 },
        { RAW, 8, 6, 2, 1, 0, 160, 9000, 14000, CROSS, W, H, 24, 0 },
        { RAW, 1, 1, 2, 1, 0, 1600, 9000, 14000, CROSS, W, H, 16, 0 },
        { RAW, 4, 4, 2, 1, 0, 300, 6000, 20000, CROSS, W, H, 48, 0 },
        { RAW, 24, 3, 1, 1, 0, 40, 11000, 12000, 0, W, H, 24, 0, 640 },
        { RAW, 24, 20, 1, 1, 0, 100, 11000, 11300, SMALL_POOL, W, H, 24, 0 },
        { FLAT, 16, 12, 2, 1, 0, 70, 11000, 12000, 0, W, H, 24, 0 },
        { SMOOTH, 8, 6, 2, -1, 0, 160, 11000, 12000, 0, W, H, 24, 0 },
        { SMOOTH, 2, 2, 2, 1, 0, 900, 7000, 14000, 0, W, H, 24, 1 },
        { SMOOTH, 4, 4, 2, 1, 0, 300, 9000, 14000, CROSS, W, H, 24, 1 },
        { TEX_565, 8, 6, 2, 1, 0, 160, 11000, 12000, 0, W, H, 24, 0 },
        { TEX_565, 2, 2, 2, -1, 0, 900, 7000, 14000, 0, W, H, 24, 0 },
        { TEX_SMOOTH_PAL, 4, 3, 2, 1, 0, 300, 9000, 13000, CROSS, W, H, 24, 0 },
        { RAW, 24, 20, 1, 1, 0, 12, 11000, 12000, SPARSE, W, H, 48, 0 },
        { RAW, 1, 1, 3, 1, 0, 16000, 11000, 12000, 0, 320, 48, 24, 0 },
    };
    const uint32_t n = LENGTH(some);
    if (i >= n * (LENGTH(methods) - 1u))
        return 0;
    *p = some[i % n];
    p->method = (uint8_t)(1u + i / n);
    return 1;
}

/* Plans in order: each family takes its share of i. Return 0: i lies beyond. */
static int plan_of(struct plan *p, uint32_t i)
{
    static const struct {
        uint8_t nx, ny;
        uint16_t cell;
    } size[] = { { 24, 20, 18 }, { 24, 20, 34 }, { 16, 12, 70 }, { 8, 6, 160 }, { 4, 3, 420 }, { 1, 1, 1900 } };
    static const struct {
        uint16_t z0, z1;
    } tilt[] = { { 15000, 9500 }, { 7000, 9400 }, { 4300, 30000 }, { 17000, 8100 } };
    static const struct {
        uint16_t z0, z1;
    } gentle[] = { { 10000, 10300 }, { 10000, 11500 }, { 12000, 9000 }, { 5000, 26000 } };
    static const struct {
        uint8_t nx, ny;
        uint16_t tall, cell;
    } slim[] = { { 24, 2, 2560, 12 }, { 24, 3, 640, 40 }, { 12, 2, 320, 130 }, { 2, 20, 16, 700 }, { 6, 20, 16, 300 },
                 { 1, 1, 640, 150 }, { 1, 20, 1, 1600 }, { 2, 20, 2, 800 }, { 1, 10, 4, 1700 } };
    static const uint16_t strips[] = { 2, 4, 8, 16, 48 };
    /* wide ones, drawn where nothing was: all of the picture or a part, before each other and behind, in bands */
    static const struct plan broad[] = {
        { RAW, 1, 1, 1, 1, 0, 3600, 11000, 12000, 0, 320, 48, 24, 0 },
        { RAW, 1, 1, 1, 1, 0, 16000, 11000, 12000, 0, 320, 48, 24, 0 },
        { RAW, 1, 1, 1, 1, 0, 16000, 11000, 12000, 0, 320, 96, 8, 0 },
        { RAW, 1, 1, 3, -1, 0, 16000, 11000, 12000, 0, 320, 48, 24, 0 },
        { RAW, 1, 1, 3, 1, 0, 16000, 11000, 12000, 0, 320, 48, 16, 0 },
        { RAW, 1, 1, 3, -1, 0, 4000, 11000, 12000, 0, 320, 48, 8, 0 },
        { RAW, 1, 1, 3, 1, 0, 4000, 11000, 12000, 0, 320, 48, 24, 0 },
        { RAW, 1, 3, 1, 1, 0, 4800, 11000, 12000, 0, 320, 48, 24, 0, 3 },
        { RAW, 1, 4, 2, 1, 0, 4000, 11000, 12000, 0, 320, 48, 16, 0, 4 },
        { RAW, 1, 1, 1, 1, 0, 16000, 6000, 12500, 0, 320, 48, 24, 0 },
        { RAW, 2, 1, 2, 1, 0, 3000, 7000, 15000, 0, 320, 48, 8, 0 },
        { RAW, 1, 1, 1, 1, 1, 16000, 11000, 12000, 0, 320, 48, 24, 0 },
        { RAW, 3, 2, 1, 1, 0, 2200, 11000, 12000, 0, 320, 96, 40, 0 },
    };
    static const struct plan single[] = {
        { RAW, 24, 20, 1, 1, 0, 40, 11000, 12000, BARE, W, H, 24, 0 },
        { RAW, 24, 20, 3, 1, 0, 40, 11000, 12000, BARE, W, H, 24, 0 },
        { RAW, 24, 20, 3, 1, 0, 40, 11000, 12000, BARE | FINE, W, H, 24, 0 },
        { RAW, 24, 20, 3, 1, 1, 40, 11000, 12000, BARE, W, H, 24, 0 },
        { RAW, 24, 20, 3, 1, 2, 40, 11000, 12000, BARE, W, H, 24, 0 },
        { RAW, 24, 20, 3, 1, 2, 40, 11000, 12000, AWAY | ORTHO, W, H, 24, 0 },
        { RAW, 24, 20, 1, 1, 2, 60, 11000, 12000, ORTHO, W, H, 24, 0 },
        { FLAT_GIVEN, 12, 12, 2, 1, 2, 100, 9000, 14000, ORTHO, W, H, 24, 0 },
        { SMOOTH, 12, 12, 2, 1, 2, 100, 9000, 14000, ORTHO, W, H, 24, 0 },
        { TEX_565, 4, 3, 2, 1, 2, 300, 9000, 14000, ORTHO, W, H, 24, 0 },
        { RAW, 24, 20, 3, 1, 0, 40, 4200, 30000, BARE | NEAR_CUT, W, H, 24, 0 },
        { RAW, 24, 20, 1, 1, 0, 60, 9800, 12000, BARE | NEAR_CUT, W, H, 24, 0 },
        { RAW, 24, 20, 3, 1, 0, 40, 11000, 12000, AWAY, W, H, 24, 0 },
        { RAW, 24, 20, 3, 1, 0, 60, 11000, 12000, AWAY, W, H, 24, 0 },
        { RAW, 24, 20, 3, 1, 0, 1, 11000, 12000, 0, W, H, 24, 0 },
        { RAW, 24, 20, 3, 1, 0, 3, 11000, 12000, 0, W, H, 24, 0 },
        { RAW, 24, 20, 3, 1, 0, 6, 11000, 12000, 0, W, H, 24, 0 },
        { RAW, 24, 20, 3, 1, 0, 9, 11000, 12000, 0, W, H, 24, 0 },
        { RAW, 24, 12, 2, 1, 0, 100, 11000, 12000, BESIDE, W, H, 24, 0 },
        { FLAT, 12, 12, 2, 1, 0, 100, 11000, 12000, BESIDE, W, H, 24, 0 },
        { RAW, 24, 20, 1, 1, 0, 60, 4300, 30000, NEAR_CUT, W, H, 24, 0 },
        { RAW, 8, 6, 1, 1, 0, 250, 6000, 20000, NEAR_CUT, W, H, 24, 0 },
        { SMOOTH, 8, 6, 1, 1, 0, 250, 6000, 20000, NEAR_CUT, W, H, 24, 0 },
        { TEX_SMOOTH_565, 8, 6, 2, 1, 0, 250, 6000, 20000, NEAR_CUT, W, H, 24, 0 },
        { TEX_565, 2, 2, 1, 1, 0, 900, 6000, 20000, NEAR_CUT, W, H, 24, 0 },
        { FLAT, 2, 2, 2, 1, 0, 900, 6000, 20000, NEAR_CUT, W, H, 24, 0 },
        { RAW, 1, 1, 1, 1, 0, 32, 11000, 12000, BEHIND_US, W, H, 24, 0 },
        { RAW, 1, 1, 3, 1, 0, 32, 11000, 12000, BEHIND_US, W, H, 24, 0 },
        { RAW, 1, 1, 3, 1, 0, 32, 11000, 12000, 0, W, H, 24, 0 },
        { RAW, 1, 1, 1, 1, 0, 32, 11000, 12000, AWAY, 64, 48, 24, 0 },
        { RAW, 1, 1, 1, 1, 0, 32, 11000, 12000, AWAY, 240, 96, 24, 0 },
        { RAW, 1, 1, 1, 1, 0, 32, 11000, 12000, AWAY, 240, 96, 4, 0 },
        { RAW, 16, 12, 3, 1, 0, 100, 11000, 12000, WALL, W, H, 24, 0 },
        { FLAT, 24, 20, 2, 1, 0, 70, 11000, 12000, WALL, W, H, 24, 0 },
        { SMOOTH, 16, 12, 2, 1, 0, 100, 11000, 12000, WALL, W, H, 24, 0 },
        { RAW, 16, 12, 2, 1, 0, 80, 11000, 12000, SMALL_POOL, W, H, 24, 0 },
        { FLAT, 16, 12, 1, 1, 0, 80, 11000, 12000, SMALL_POOL, W, H, 24, 0 },
        { SMOOTH, 16, 12, 2, 1, 0, 80, 11000, 12000, SMALL_POOL, W, H, 24, 0 },
        { TEX_SMOOTH_PAL, 16, 12, 1, 1, 0, 80, 11000, 12000, SMALL_POOL, W, H, 24, 0 },
        { RAW, 24, 20, 3, 1, 0, 60, 11000, 12000, SMALL_POOL, W, H, 8, 0 },
        { RAW, 24, 20, 2, 1, 0, 60, 11000, 12000, SMALL_POOL | AWAY, W, H, 8, 0 },
        { FLAT, 24, 20, 2, 1, 0, 70, 11000, 12000, SMALL_POOL, W, H, 16, 0 },
        { RAW, 24, 20, 1, 1, 0, 70, 11000, 12000, SMALL_POOL, W, H, 4, 0 },
        { SMOOTH, 24, 20, 1, 1, 0, 70, 11000, 12000, SMALL_POOL, W, H, 12, 0 },
        { RAW, 24, 20, 3, 1, 0, 70, 11000, 12000, SMALL_POOL | SPARSE, W, H, 16, 0 },
        { RAW, 8, 6, 2, 1, 0, 160, 11000, 12000, STATE, W, H, 24, 0 },
        { SMOOTH, 8, 6, 2, 1, 0, 160, 11000, 12000, STATE, W, H, 24, 0 },
        { TEX_565, 8, 6, 2, 1, 0, 160, 11000, 12000, STATE, W, H, 24, 0 },
        { TEX_565, 1, 1, 2, 1, 0, 1200, 11000, 12000, STATE, W, H, 24, 0 },
        { TEX_PAL8, 2, 2, 2, 1, 0, 600, 7000, 14000, STATE, W, H, 24, 0 },
        { TEX_PAL8, 6, 5, 2, 1, 0, 200, 7000, 14000, STATE, W, H, 24, 0 },
        { TEX_565, 6, 5, 1, 1, 0, 250, 11000, 11100, CLAMP | DENSE, W, H, 24, 0 },
        { TEX_PAL4, 1, 1, 1, 1, 0, 1700, 11000, 11000, CLAMP | DENSE, W, H, 24, 0 },
        { RAW, 1, 1, 3, -1, 0, 3600, 11000, 12000, 0, 240, H, 8, 0 },
        { RAW, 1, 1, 3, -1, 0, 3600, 11000, 12000, 0, 240, H, 4, 0 },
        { RAW, 1, 1, 3, -1, 0, 3600, 7000, 16000, 0, 240, H, 8, 0 },
        { RAW, 1, 1, 3, 1, 0, 3600, 11000, 12000, 0, 240, H, 4, 0 },
        { FLAT_GIVEN, 2, 1, 3, -1, 0, 2400, 11000, 12000, 0, 240, H, 4, 0 },
        { FLAT_GIVEN, 2, 1, 3, -1, 0, 2400, 6000, 21000, 0, 240, H, 4, 0 },
        { SMOOTH, 1, 1, 3, -1, 0, 3600, 11000, 12000, 0, 240, H, 4, 0 },
        { SMOOTH, 1, 1, 2, -1, 0, 3600, 6000, 21000, 0, 240, H, 4, 1 },
        { TEX_565, 1, 1, 2, -1, 0, 3600, 11000, 11100, 0, 240, H, 4, 0 },
        { TEX_SMOOTH_565, 1, 1, 2, -1, 0, 3600, 8000, 18000, 0, 240, H, 8, 0 },
        { RAW, 1, 20, 1, 1, 0, 3600, 11000, 12000, 0, 240, H, 24, 0, 1 },
        { FLAT_GIVEN, 24, 2, 1, 1, 0, 24, 11000, 12000, 0, W, H, 24, 0, 1600 },
        { RAW, 2, 20, 3, 1, 0, 500, 11000, 12000, 0, W, H, 24, 0, 2 },
        { RAW, 8, 20, 3, 1, 0, 200, 11000, 12000, 0, W, H, 24, 0, 4 },
        { RAW, 24, 20, 1, 1, 0, 60, 11000, 12000, 0, W, H, 24, 0, 8 },
        { RAW, 24, 20, 3, 1, 0, 8, 11000, 12000, 0, W, H, 24, 0, 512 },
        { RAW, 24, 20, 3, 1, 0, 30, 11000, 12000, 0, W, H, 24, 0, 20 },
        { SMOOTH, 8, 20, 2, 1, 0, 200, 11000, 12000, 0, W, H, 24, 0, 4 },
        { SMOOTH, 24, 20, 1, 1, 0, 8, 11000, 12000, 0, W, H, 24, 0, 512 },
        { RAW, 24, 20, 2, 1, 0, 34, 11000, 12000, SPARSE, W, H, 48, 0 },
        { FLAT_GIVEN, 24, 20, 2, 1, 0, 34, 11000, 12000, SPARSE, W, H, 48, 0 },
        { SMOOTH, 24, 20, 2, 1, 0, 34, 11000, 12000, SPARSE, W, H, 48, 0 },
        { SMOOTH, 24, 20, 1, 1, 0, 12, 11000, 12000, SPARSE, W, H, 48, 0 },
        { TEX_565, 24, 20, 2, 1, 0, 34, 11000, 12000, SPARSE, W, H, 48, 0 },
        { TEX_565, 24, 20, 1, 1, 0, 12, 11000, 12000, SPARSE, W, H, 48, 0 },
        { TEX_SMOOTH_565, 24, 20, 2, 1, 0, 34, 11000, 12000, SPARSE, W, H, 48, 0 },
        { TEX_SMOOTH_565, 24, 20, 1, 1, 0, 12, 11000, 12000, SPARSE, W, H, 48, 0 },
        { RAW, 16, 12, 3, 1, 0, 320, 11000, 12000, WALL, 320, H, 24, 0 },
        { RAW, 24, 20, 2, 1, 0, 64, 11000, 12000, WALL, 320, H, 8, 0 },
        { FLAT_GIVEN, 3, 2, 3, 1, 0, 1500, 11000, 12000, WALL, 320, H, 8, 0 },
        { RAW, 1, 1, 3, 1, 0, 12000, 11000, 12000, WALL, 320, 48, 8, 0 },
        { RAW, 1, 1, 3, 1, 0, 12000, 11000, 12000, WALL, 320, 48, 24, 0 },
        { RAW, 1, 1, 3, -1, 0, 12000, 11000, 12000, 0, 320, 96, 4, 0 },
        { RAW, 1, 1, 1, 1, 0, 12000, 11000, 12000, SCREEN, 320, 48, 24, 0 },
        { RAW, 4, 3, 3, 1, 0, 160, 11000, 12000, SCREEN, 320, 48, 24, 0 },
        { RAW, 4, 3, 3, -1, 0, 160, 11000, 12000, SCREEN, 320, 96, 8, 0 },
        { SMOOTH, 8, 6, 3, 1, 0, 160, 11000, 12000, SCREEN, W, H, 24, 0 },
        { RAW, 24, 20, 3, 1, 0, 12, 11000, 11000, 0, W, H, 24, 0 },
        { RAW, 24, 20, 3, 1, 0, 9, 11000, 11000, 0, W, H, 24, 0, 128 },
        { RAW, 24, 20, 1, 1, 0, 24, 11000, 12000, 0, W, H, 4, 0, 160 },
        { RAW, 1, 1, 1, 1, 0, 32, 11000, 12000, AWAY, 320, H, 24, 0 },
        { RAW, 2, 2, 3, 1, 0, 1600, 11000, 12000, AWAY, W, H, 24, 0 },
        { RAW, 2, 2, 3, 1, 0, 1600, 11000, 12000, AWAY, 240, H, 24, 0 },
    };
    *p = base;
    /* shading by size: lit, overdrawn from either side */
    uint32_t n = SHADES * LENGTH(size) * 3u;
    if (i < n) {
        const uint32_t s = i / 3u % LENGTH(size);
        p->shade = (uint8_t)(i / 3u / LENGTH(size));
        p->nx = size[s].nx;
        p->ny = size[s].ny;
        p->cell = size[s].cell;
        p->layers = i % 3u ? 3u : 1u;
        p->order = i % 3u == 2u ? -1 : 1;
        return 1;
    }
    i -= n;
    n = SHADES * 4u * LENGTH(tilt); /* by tilt: keys over octaves, colours and texels in perspective */
    if (i < n) {
        const uint32_t s = 1u + i % 4u, t = i / 4u % LENGTH(tilt);
        p->shade = (uint8_t)(i / 4u / LENGTH(tilt));
        p->nx = size[s].nx;
        p->ny = size[s].ny;
        p->cell = size[s].cell;
        p->z0 = tilt[t].z0;
        p->z1 = tilt[t].z1;
        p->bend = (uint8_t)(i & 1u);
        p->layers = 2;
        p->order = t & 1u ? -1 : 1;
        return 1;
    }
    i -= n;
    static const uint8_t some[] = { RAW, FLAT, SMOOTH, TEX_565, TEX_SMOOTH_PAL };
    n = LENGTH(some) * 4u * 2u; /* other depth mappings */
    if (i < n) {
        const uint32_t s = 1u + i % 4u;
        p->shade = some[i / 8u];
        p->nx = size[s].nx;
        p->ny = size[s].ny;
        p->cell = size[s].cell;
        p->depth = (uint8_t)(1u + i / 4u % 2u);
        p->layers = 2;
        p->order = i & 1u ? -1 : 1;
        if (i & 2u) {
            p->z0 = 7000;
            p->z1 = 13000;
        }
        return 1;
    }
    i -= n;
    n = LENGTH(some) * LENGTH(slim); /* tall and flat ones: rows without a pixel, rows of many */
    if (i < n) {
        p->shade = some[i / LENGTH(slim)];
        p->nx = slim[i % LENGTH(slim)].nx;
        p->ny = slim[i % LENGTH(slim)].ny;
        p->cell = slim[i % LENGTH(slim)].cell;
        p->tall = slim[i % LENGTH(slim)].tall;
        return 1;
    }
    i -= n;
    n = (SHADES - SMOOTH) * LENGTH(gentle) * 2u; /* large ones in perspective, near to affine and less so */
    if (i < n) {
        p->shade = (uint8_t)(SMOOTH + i / 2u / LENGTH(gentle));
        p->z0 = gentle[i / 2u % LENGTH(gentle)].z0;
        p->z1 = gentle[i / 2u % LENGTH(gentle)].z1;
        p->nx = p->ny = i & 1u ? 2 : 1;
        p->cell = i & 1u ? 900 : 1900;
        p->strip = i & 1u ? 24 : 16;
        p->layers = i & 1u ? 2 : 1;
        p->order = -1;
        return 1;
    }
    i -= n;
    static const uint8_t ends[] = { TEX_565, TEX_PAL4, TEX_FLAT_PAL_200, TEX_SMOOTH_PAL };
    n = LENGTH(ends) * LENGTH(gentle) * 4u; /* textures that end, and dense ones */
    if (i < n) {
        p->shade = ends[i / 4u / LENGTH(gentle)];
        p->z0 = gentle[i / 4u % LENGTH(gentle)].z0;
        p->z1 = gentle[i / 4u % LENGTH(gentle)].z1;
        p->flags = i & 1u ? CLAMP : DENSE;
        p->nx = i & 2u ? 6 : 1;
        p->ny = i & 2u ? 5 : 1;
        p->cell = i & 2u ? 250 : 1700;
        return 1;
    }
    i -= n;
    n = LENGTH(some) * LENGTH(strips); /* strip heights */
    if (i < n) {
        p->shade = some[i / LENGTH(strips)];
        p->strip = strips[i % LENGTH(strips)];
        p->nx = 12;
        p->ny = 9;
        p->cell = 120;
        p->layers = 2;
        return 1;
    }
    i -= n;
    n = LENGTH(some) * LENGTH(size) * 2u; /* level ones: keys that do not differ */
    if (i < n) {
        const uint32_t s = i / 2u % LENGTH(size);
        p->shade = some[i / 2u / LENGTH(size)];
        p->nx = size[s].nx;
        p->ny = size[s].ny;
        p->cell = size[s].cell;
        p->z0 = p->z1 = 11000;
        p->layers = i & 1u ? 3u : 1u;
        p->order = -1;
        return 1;
    }
    i -= n;
    static const uint8_t broad_some[] = { RAW, FLAT_GIVEN, SMOOTH, TEX_565, TEX_SMOOTH_PAL };
    n = LENGTH(broad_some) * LENGTH(broad);
    if (i < n) {
        *p = broad[i % LENGTH(broad)];
        p->shade = broad_some[i / LENGTH(broad)];
        return 1;
    }
    i -= n;
    if (i < LENGTH(single)) {
        *p = single[i];
        return 1;
    }
    i -= (uint32_t)LENGTH(single);
    return method_plan(p, i);
}

/* ---- Probes ------------------------------------------------------------------------------------- */

static uint32_t put_text(char *to, uint32_t at, const char *text)
{
    while (*text && at + 1u < PROBE_NAME_CHARS)
        to[at++] = *text++;
    return at;
}

static uint32_t put_number(char *to, uint32_t at, const char *before, uint32_t v)
{
    char digits[8];
    uint32_t n = 0;
    at = put_text(to, at, before);
    do {
        digits[n++] = (char)('0' + v % 10u);
        v /= 10u;
    } while (v && n < sizeof digits);
    while (n && at + 1u < PROBE_NAME_CHARS)
        to[at++] = digits[--n];
    return at;
}

static void name_make(char *to, const struct plan *p)
{
    static const char *const depth_name[] = { "", "_recip", "_linear" };
    static const char *const flag_name[] = { "_away", "_bare", "_near", "_state", "_fine", "_beside", "_behind",
                                             "_pools", "_ortho", "_wall", "_clamp", "_dense", "_sparse", "_screen",
                                             "_cross" };
    uint32_t at = put_text(to, 0, shade_name[p->shade]);
    at = put_text(to, at, methods[p->method].name);
    at = put_text(to, at, depth_name[p->depth]);
    for (uint32_t k = 0; k < LENGTH(flag_name); k++)
        if (p->flags >> k & 1u)
            at = put_text(to, at, flag_name[k]);
    at = put_number(to, at, "_c", p->cell);
    at = put_number(to, at, p->order > 0 ? "_f" : "_b", p->layers);
    at = put_number(to, at, "_z", p->z1 * 10u / p->z0);
    at = put_number(to, at, "_s", p->strip);
    to[at] = '\0';
}

static void texture_choose(const struct plan *p)
{
    static const struct zs_texture square = { .log2_w = TEX_LOG2, .log2_h = TEX_LOG2 };
    const uint32_t s = p->shade;
    material.texture = s >= TEX_565 ? &texture : 0;
    texture = square;
    texture.palette = palette;
    texture.clamp = p->flags & CLAMP ? ZS_CLAMP_U | ZS_CLAMP_V : 0;
    texture.n_colors = s == TEX_FLAT_PAL_200 ? 200 : 16;
    texture.format = &zs_texel_pal8;
    texture.texel = texel_pal8;
    if (s == TEX_565 || s == TEX_FLAT_565 || s == TEX_SMOOTH_565) {
        texture.format = &zs_texel_565;
        texture.texel = texel_565;
    } else if (s == TEX_PAL4) {
        texture.format = &zs_texel_pal4;
        texture.texel = texel_pal4;
    }
}

int probe_make(struct probe *p, uint32_t i)
{
    static const struct zs_rgb black = { 0, 0, 0 }, grey = { 200, 180, 160 };
    static const uint8_t words[SHADES] = { 0, 0, 0, 0, 3, 2, 2, 2, 2, 2, 2, 3, 3 };
    struct plan plan;
    if (!plan_of(&plan, i))
        return 0;
    if (!palette[1])
        textures_make();
    p->common = i < SHADES * 34u; /* plan_of's first two families */
    dice = i * 977u + 5u;
    name_make(p->name, &plan);
    grid_make(&plan);
    material.shader = shaders[plan.shade];
    material.rgb = plain.rgb = grey;
    texture_choose(&plan);
    stage_open(&p->frame, black);
    stage_light(&p->frame, 2, 3, 6, 25, 75);
    lens(&p->frame, &plan);
    instances(&p->frame, &plan);
    struct zs_config *c = &p->config;
    const int few = plan.flags & SMALL_POOL;
    c->width = plan.width;
    c->height = plan.height;
    c->strip_h = plan.strip;
    c->max_tris = (uint16_t)(few ? 200u : PROBE_LAYERS * PROBE_TRIS + 64u);
    c->max_verts = (uint16_t)(few ? 200u : PROBE_LAYERS * PROBE_VERTS + 64u);
    c->varyings = words[plan.shade];
    c->buffers = 1;
    c->subpixel_bits = 8;
    c->depth_bits = 16;
    c->depth = methods[plan.method].depth ? methods[plan.method].depth : depths[plan.depth];
    c->method = methods[plan.method].method;
    if (c->method == &zs_method_raycast && i & 1u) /* none over, for planes that are kept */
        c->max_verts = (uint16_t)(plan.layers * mesh.n_verts);
    c->fast = fast;
    return 1;
}
