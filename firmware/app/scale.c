/* How a frame's instructions grow: series of scenes in which one quantity grows and all else stays, a line of CSV each.
 *
 *   triangles  a ball of 112 to 99,904 triangles over a third of 320x240 (half of them turned away); a jittered sheet
 *              of 98 to 99,458 over all of it (none turned away). Above 65,534 drawn triangles the pools take passes
 *   pixels     bench scenes in 64x64 to 1024x1024, x is their product
 *   strips     bench scenes at 320x240 in 1 to 240 strips
 *   passes     20,000 triangles of the sheet with pools for all of them down to a hundredth; x is the passes it took
 *   depth      1 to 64 layers that fill 320x240, front to back, back to front and mixed, as they are drawn and
 *              ("tested") without what spares the first of them clear and depth test, so that all are drawn alike; 1 to
 *              64 balls of 480 triangles behind each other, each as large on the screen as the first, the same orders,
 *              within one octave of the depth mapping: none costs more than another for where it lies
 *
 *   ram        bench scenes with pools that are filled up to what fits into so many KB together with everything else,
 *              from 8 to 128 KB; x is KB. Triangles and vertices get shares as large as all of them need
 *
 * 8 sub-pixel bits, the default depth, one strip buffer, strips of 24 rows but for `strips` and `ram`, pools as large
 * as can be. The checksum is FNV-1a, 64 bits, over the frame's bytes as they leave: the same on every machine.
 *
 * SPDX-License-Identifier: MIT
 */
#include "bench.h"
#include "hal.h"
#include "number.h"
#include "report.h"
#include "scenes.h"
#include "zstrip.h"

#define ARENA_BYTES (2700u << 10)
#define TRIS_MAX 100000u
#define VERTS_MAX 50400u
#define LAYERS_MAX 64u

ZS_ARENA(arena, ARENA_BYTES);
static struct zs_renderer renderer;
static struct demo_frame frame;
static int16_t position[VERTS_MAX][3];
static uint16_t triangle[TRIS_MAX][3];
static uint16_t color[TRIS_MAX];
static struct zs_mesh mesh = { .pos = (const int16_t (*)[3])position, .tri = (const uint16_t (*)[3])triangle,
                               .face_raw = color };
static struct zs_instance layer[LAYERS_MAX];
static struct zs_scene scene; /* what is drawn, through frame.camera */

/* ---- Lines --------------------------------------------------------------------------------- */

static struct zs_config config_of(const struct demo *like, uint16_t w, uint16_t h, uint16_t rows)
{
    const struct zs_config c = { .width = w, .height = h, .strip_h = rows, .max_tris = ZS_POOL_MAX,
                                 .max_verts = ZS_POOL_MAX, .varyings = (uint8_t)like->varyings, .buffers = 1,
                                 .subpixel_bits = 8, .depth_bits = 16, .depth = like->depth, .fast = like->fast };
    return c;
}

/* Draw the scene and write its line; x 0: the passes that it took. Return 1 where it cannot be drawn. */
static int point(const char *series, const char *name, uint32_t x, const struct zs_config *c)
{
    uint64_t sum = REPORT_HASH;
    const struct zs_sink look = { .submit = report_hash, .ctx = &sum }, nowhere = { .submit = report_drop };
    char hex[HEX_CHARS];
    int err = zs_init(&renderer, c, arena, sizeof arena);
    err = err ? err : zs_render(&renderer, &scene, &frame.camera, &look);
    const uint64_t start = hal_ticks();
    err = err ? err : zs_render(&renderer, &scene, &frame.camera, &nowhere);
    const uint64_t n = (hal_ticks() - start) * hal_tick_instructions();
    const struct zs_stats *s = zs_frame_stats(&renderer);
    hal_write(series);
    hal_write(",");
    hal_write(name);
    report_field(x ? x : s->passes);
    if (err) {
        hal_write(",error: ");
        hal_write(zs_error_string(err));
        hal_write("\n");
        return 1;
    }
    report_field(s->passes);
    report_field(s->tris_in);
    report_field(s->tris_drawn);
    report_field(s->tris_setup);
    report_field(s->verts_transformed);
    report_field(s->pixels_tested);
    hal_write(",");
    hal_write(number_hex(hex, sum));
    report_field(n);
    hal_write("\n");
    return 0;
}

/* ---- Triangles ----------------------------------------------------------------------------- */

static void put_vertex(int64_t x, int64_t y, int64_t z)
{
    int16_t *p = position[mesh.n_verts++];
    p[0] = (int16_t)x;
    p[1] = (int16_t)y;
    p[2] = (int16_t)z;
}

static void put_triangle(uint32_t a, uint32_t b, uint32_t c)
{
    uint16_t *t = triangle[mesh.n_tris];
    color[mesh.n_tris] = (uint16_t)(mesh.n_tris * 40503u); /* neighbours differ */
    mesh.n_tris++;
    t[0] = (uint16_t)a;
    t[1] = (uint16_t)b;
    t[2] = (uint16_t)c;
}

static int64_t times(int64_t r, zs_q2_30 unit)
{
    return (r * unit + (ZS_Q30_ONE >> 1)) >> 30;
}

#define BALL_STEPS 28000

/* n x n cells: n (n - 1) + 2 vertices, 2 n (n - 1) triangles. */
static void ball(uint32_t n)
{
    mesh.n_verts = mesh.n_tris = 0;
    mesh.scale = BENCH_BUMPY_SCALE;
    mesh.radius = BALL_STEPS + 2;
    put_vertex(0, BALL_STEPS, 0);
    for (uint32_t j = 1; j < n; j++) {
        const zs_turn polar = (zs_turn)(j * 32768u / n);
        for (uint32_t i = 0; i < n; i++) {
            const zs_turn around = (zs_turn)(i * 65536u / n);
            const int64_t flat = times(BALL_STEPS, zs_sin(polar));
            put_vertex(times(flat, zs_sin(around)), times(BALL_STEPS, zs_cos(polar)), times(flat, zs_cos(around)));
        }
    }
    put_vertex(0, -BALL_STEPS, 0);
    for (uint32_t j = 0; j < n; j++) {
        const uint32_t up = j ? 1 + (j - 1) * n : 0, low = 1 + j * n;
        for (uint32_t i = 0; i < n; i++) {
            const uint32_t k = (i + 1) % n;
            if (j == 0) {
                put_triangle(up, low + i, low + k);
            } else {
                if (j < n - 1)
                    put_triangle(up + i, low + i, low + k);
                put_triangle(up + i, j < n - 1 ? low + k : low, up + k);
            }
        }
    }
}

static int32_t jitter(uint32_t a, uint32_t b, uint32_t seed, int32_t most)
{
    uint32_t h = (a * 0x9e3779b1u) ^ (b * 0x85ebca77u) ^ (seed * 0xc2b2ae3du);
    h = (h ^ h >> 15) * 0x2c1b3c6du;
    h = (h ^ h >> 13) * 0x297a2d39u;
    return (int32_t)((h ^ h >> 16) % (2u * (uint32_t)most + 1u)) - most;
}

/* n x n cells over 310x232 px, corners moved by up to a fifth of a cell: (n + 1)^2 vertices, 2 n^2 triangles. */
static void sheet(uint32_t n)
{
    const int32_t cells = (int32_t)n, w = 310 * BENCH_STEPS_PX, h = 232 * BENCH_STEPS_PX;
    mesh.n_verts = mesh.n_tris = 0;
    mesh.scale = BENCH_SHEET_SCALE;
    mesh.radius = 40000;
    for (uint32_t j = 0; j <= n; j++)
        for (uint32_t i = 0; i <= n; i++)
            put_vertex((int32_t)i * w / cells - w / 2 + (i % n ? jitter(i, j, 1, w / cells / 5) : 0),
                       h / 2 - (int32_t)j * h / cells + (j % n ? jitter(i, j, 2, h / cells / 5) : 0), 0);
    for (uint32_t j = 0; j < n; j++)
        for (uint32_t i = 0; i < n; i++) {
            const uint32_t a = j * (n + 1) + i, c = a + n + 1;
            put_triangle(a, c, c + 1);
            put_triangle(a, c + 1, a + 1);
        }
}

static int triangles(void)
{
    static const uint8_t cells[2][11] = { { 8, 11, 16, 23, 32, 50, 71, 100, 159, 181, 224 },
                                          { 7, 10, 16, 22, 32, 50, 71, 100, 158, 181, 223 } };
    int failed = 0;
    for (uint32_t s = 0; s < 2; s++)
        for (uint32_t k = 0; k < sizeof cells[0]; k++) {
            const struct demo *like = s ? &demo_sheet : &demo_mesh;
            like->pose(&frame, 0, 320, 240);
            (s ? sheet : ball)(cells[s][k]);
            frame.instance[0].mesh = &mesh;
            scene = frame.scene;
            const struct zs_config c = config_of(like, 320, 240, 24);
            failed += point("triangles", s ? "sheet" : "ball", mesh.n_tris, &c);
        }
    return failed;
}

/* ---- Pixels and strips ----------------------------------------------------------------------- */

static const struct demo *const samples[] = { &demo_mesh, &demo_mesh_tex, &demo_layers_mixed, &demo_sheet, &demo_hall };
#define SAMPLES (sizeof samples / sizeof samples[0])

static int pixels(void)
{
    static const uint16_t sides[] = { 64, 96, 128, 192, 256, 384, 512, 768, 1024 };
    int failed = 0;
    for (uint32_t s = 0; s < SAMPLES; s++)
        for (uint32_t k = 0; k < sizeof sides / sizeof sides[0]; k++) {
            samples[s]->pose(&frame, 0, sides[k], sides[k]);
            scene = frame.scene;
            const struct zs_config c = config_of(samples[s], sides[k], sides[k], 24);
            failed += point("pixels", samples[s]->name, (uint32_t)sides[k] * sides[k], &c);
        }
    return failed;
}

static int strips(void)
{
    static const uint16_t counts[] = { 1, 2, 3, 5, 10, 15, 30, 60, 120, 240 };
    int failed = 0;
    for (uint32_t s = 0; s < SAMPLES; s++)
        for (uint32_t k = 0; k < sizeof counts / sizeof counts[0]; k++) {
            samples[s]->pose(&frame, 0, 320, 240);
            scene = frame.scene;
            const struct zs_config c = config_of(samples[s], 320, 240, (uint16_t)(240u / counts[k]));
            failed += point("strips", samples[s]->name, counts[k], &c);
        }
    return failed;
}

/* ---- Pools ----------------------------------------------------------------------------------- */

static int passes(void)
{
    static const uint8_t parts[] = { 1, 2, 3, 5, 8, 12, 20, 30, 50, 100 };
    int failed = 0;
    demo_sheet.pose(&frame, 0, 320, 240);
    sheet(100);
    frame.instance[0].mesh = &mesh;
    scene = frame.scene;
    for (uint32_t k = 0; k < sizeof parts; k++) {
        struct zs_config c = config_of(&demo_sheet, 320, 240, 24);
        c.max_tris = (uint16_t)(20000u / parts[k]);
        c.max_verts = (uint16_t)(10201u / parts[k]);
        failed += point("passes", "sheet", 0, &c);
    }
    return failed;
}

/* ---- Depth complexity ------------------------------------------------------------------------ */

#define FIRST 13421772u /* uq16_16: the scale that puts the first layer at 1500 bench units */

static uint32_t reversed(uint32_t i, uint32_t n)
{
    uint32_t out = 0;
    for (uint32_t bit = 1; bit < n; bit <<= 1)
        out = out << 1 | !!(i & bit);
    return out;
}

/* Of the bench's ball: front halves begin at 2,106 bench units, an octave at 2,048. */
#define BALL_FIRST (ZS_Q16_ONE * 36u / 25u)

/* n copies of instances of a frame, each somewhat farther and larger than the one before, so that they look the same:
 * layers by 3.5 %, balls by 0.6 %, the last of which ends at 3,900 bench units, and the octave at 4,096. Materials
 * repeat. */
static void stack(uint32_t n, uint32_t order, const struct demo *like)
{
    const int balls = like == &demo_mesh;
    like->pose(&frame, 0, 320, 240);
    scene = frame.scene;
    scene.instance = layer;
    scene.n_instances = n;
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t place = order == 0 ? i : order == 1 ? n - 1 - i : reversed(i, n);
        uint32_t scale = balls ? BALL_FIRST : ZS_Q16_ONE;
        for (uint32_t k = 0; k < place; k++)
            scale += scale * (balls ? 6u : 35u) / 1000u; /* below 9 * 2^16 */
        layer[i] = frame.instance[balls ? 0 : place % 8];
        if (balls) {
            layer[i].mesh = &mesh;
            for (int k = 0; k < 3; k++)
                layer[i].pose.pos[k] = (int32_t)((int64_t)layer[i].pose.pos[k] * scale >> 16);
            layer[i].pose.scale = scale;
        } else {
            layer[i].pose.scale = (zs_uq16_16)((uint64_t)FIRST * scale >> 16);
        }
    }
}

static int depths(void)
{
    static const char *const names[3][3] = {
        { "layers front to back", "layers back to front", "layers mixed" },
        { "layers tested front to back", "layers tested back to front", "layers tested mixed" },
        { "balls front to back", "balls back to front", "balls mixed" }
    };
    const struct zs_fast *tested[8]; /* the layers' list without zs_fast_touch */
    uint32_t kept = 0;
    for (const struct zs_fast *const *at = demo_layers_ftb.fast; *at && kept < 7; at++)
        if (ZS_NO_FAST || *at != &zs_fast_touch)
            tested[kept++] = *at;
    tested[kept] = 0;
    int failed = 0;
    ball(16);
    for (uint32_t s = 0; s < 3; s++)
        for (uint32_t order = 0; order < 3; order++)
            for (uint32_t n = 1; n <= LAYERS_MAX; n *= 2) {
                const struct demo *like = s == 2 ? &demo_mesh : &demo_layers_ftb;
                stack(n, order, like);
                struct zs_config c = config_of(like, 320, 240, 24);
                if (s == 1)
                    c.fast = tested;
                failed += point("depth", names[s][order], n, &c);
            }
    return failed;
}

/* ---- RAM ------------------------------------------------------------------------------------- */

#define RESERVE 4608u /* for renderer, scene state and stack, as in the bench */

static int ram(void)
{
    static const uint8_t kb[] = { 8, 10, 12, 14, 16, 20, 24, 28, 32, 40, 48, 56, 64, 80, 96, 112, 128 };
    static const struct {
        const char *name;
        const struct demo *of;
        uint16_t width, height, rows;
    } lines[] = { { "relief 160x128 by 4", &demo_relief, 160, 128, 4 },
                  { "relief by 8", &demo_relief, 320, 240, 8 },
                  { "relief by 24", &demo_relief, 320, 240, 24 },
                  { "relief_tex by 8", &demo_relief_tex, 320, 240, 8 },
                  { "relief_tex by 24", &demo_relief_tex, 320, 240, 24 },
                  { "sheet by 8", &demo_sheet, 320, 240, 8 },
                  { "sheet by 24", &demo_sheet, 320, 240, 24 } };
    int failed = 0;
    for (uint32_t i = 0; i < sizeof lines / sizeof lines[0]; i++) {
        const uint16_t w = lines[i].width, h = lines[i].height, rows = lines[i].rows;
        const struct zs_sink nowhere = { .submit = report_drop };
        struct zs_config c = config_of(lines[i].of, w, h, rows);
        lines[i].of->pose(&frame, 0, w, h);
        scene = frame.scene;
        int err = zs_init(&renderer, &c, arena, sizeof arena);
        err = err ? err : zs_render(&renderer, &scene, &frame.camera, &nowhere);
        const struct zs_stats *s = zs_frame_stats(&renderer);
        const uint32_t tris = s->max_tris_used, verts = s->max_verts_used;
        const uint32_t whole = ZS_TRI_BYTES(tris) + ZS_VERT_BYTES(verts, c.varyings);
        const uint32_t strips = ZS_ARENA_BYTES(w, h, rows, 0, 0, 0, 1) + RESERVE + 8u; /* 8: pools are rounded up */
        failed += err != 0;
        for (uint32_t k = 0; k < sizeof kb && !err; k++) {
            const uint32_t left = kb[k] * 1024u - strips, part = left < whole ? left : whole;
            if (kb[k] * 1024u < strips + 256u)
                continue;
            c.max_tris = (uint16_t)((uint64_t)tris * part / whole);
            c.max_verts = (uint16_t)((uint64_t)verts * part / whole);
            failed += point("ram", lines[i].name, kb[k], &c);
        }
    }
    return failed;
}

int main(void)
{
    if (hal_init())
        hal_exit(1);
    hal_write("series,scene,x,passes,tris_in,drawn,setups,verts,fragments,checksum,instructions\n");
    const int failed = triangles() + pixels() + strips() + passes() + depths() + ram();
    hal_write(failed ? "# failed\n" : "# ok\n");
    hal_exit(failed != 0);
}
