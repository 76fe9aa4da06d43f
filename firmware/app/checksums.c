/* Checksums of frames: every scene of demos[], demo scenes at three frames, bench scenes at frame 0, with 8 and with 4
 * sub-pixel bits. A frame is a function of scene and profile, so they are every machine's.
 *
 * A line after each band of eight rows: scene,frame,sub-pixel bits,rows so far,pixels,keys. pixels is FNV-1a, 64 bits,
 * over the bytes as they leave; keys the same over the depth keys, most significant byte first. The line whose rows are
 * the frame's height has the frame's; the first line that differs names the band that does.
 *
 * What a board has memory for is given by the compiler's -D; none of it changes a checksum:
 *   SUMS_ROWS     rows of a strip
 *   SUMS_ARENA    bytes; what strips leave of it is for pools
 *   SUMS_SCENE    one scene, and its meshes alone in the image; SUMS_SCENES: SUMS_ONE(scene) for each of several;
 *                 without them all that fall on
 *   SUMS_PART     of SUMS_PARTS
 *   SUMS_PIECES   1: two frames of each showpiece instead
 *   SUMS_PIXELS   SUMS_BAND(scene, frame, bits, y) once or more: of each such band its pixels instead, a line of
 *                 scene,frame,bits,x,y,pixel,key each
 *
 * SPDX-License-Identifier: MIT
 */
#include "hal.h"
#include "line.h"
#include "scenes.h"
#include "zstrip.h"
#if SUMS_PIECES
#include "pieces.h"
#endif

#ifndef SUMS_ROWS
#define SUMS_ROWS 24
#endif
#ifndef SUMS_ARENA
#define SUMS_ARENA (3u << 20)
#endif
#ifdef SUMS_SCENE
#define SUMS_SCENES SUMS_ONE(SUMS_SCENE)
#endif
#ifndef SUMS_PARTS
#define SUMS_PARTS 1u
#define SUMS_PART 0u
#endif

#define BAND 8u /* rows */
#define FNV_BASIS 0xcbf29ce484222325u

ZS_ARENA(arena, SUMS_ARENA);
static struct zs_renderer renderer;
static struct demo_frame frame;

/* One frame of a scene, and of it one band's pixels or (y < 0) all bands' checksums. */
struct look {
    const struct demo *demo;
    uint32_t frame;
    uint8_t bits;
    int32_t y;
};

struct sums {
    const struct look *look;
    uint64_t pixels, keys;
};

/* ---- Fields of a line -------------------------------------------------------------------------------------------- */

static void put_field(uint64_t v)
{
    put(",");
    put_number(v);
}

/* The last digits of v in base 16. */
static void put_hex(uint64_t v, uint32_t digits)
{
    char room[HEX_CHARS];
    put(",");
    put(number_hex(room, v) + 16u - digits);
}

static void put_look(const struct look *k)
{
    put(k->demo->name);
    put_field(k->frame);
    put_field(k->bits);
}

/* ---- Sinks ------------------------------------------------------------------------------------------------------ */

/* sum, and one byte more. The product with the prime 2^40 + 0x1b3 is put together from 32-bit ones: Armv6-M has no
 * other, and the compiler's helper would take longer than the drawing. */
static uint64_t fnv1a(uint64_t sum, uint32_t byte)
{
    const uint32_t low = (uint32_t)sum ^ byte, high = (uint32_t)(sum >> 32);
    const uint32_t a = (low & 0xffffu) * 0x1b3u, b = (low >> 16) * 0x1b3u + (a >> 16);
    return (uint64_t)(high * 0x1b3u + (low << 8) + (b >> 16)) << 32 | (b << 16 | (a & 0xffffu));
}

static uint64_t fnv1a_bytes(uint64_t sum, const uint8_t *at, uint32_t n)
{
    for (uint32_t i = 0; i < n; i++)
        sum = fnv1a(sum, at[i]);
    return sum;
}

static uint64_t fnv1a_keys(uint64_t sum, const uint16_t *key, uint32_t n)
{
    for (uint32_t i = 0; i < n; i++)
        sum = fnv1a(fnv1a(sum, key[i] >> 8), key[i] & 255u);
    return sum;
}

/* Row by row, so that bands end where they do whatever the strips' height. */
static int sum_up(void *ctx, const struct zs_strip *s)
{
    struct sums *sums = ctx;
    for (uint32_t row = 0; row < s->h; row++) {
        const uint32_t rows = s->y + row + 1u;
        sums->pixels = fnv1a_bytes(sums->pixels, s->px + row * s->w * 2u, s->w * 2u);
        sums->keys = fnv1a_keys(sums->keys, s->depth + row * s->w, s->w);
        if (rows % BAND && rows != sums->look->demo->height)
            continue;
        put_look(sums->look);
        put_field(rows);
        put_hex(sums->pixels, 16);
        put_hex(sums->keys, 16);
        put_end();
    }
    return 0;
}

static int print_pixels(void *ctx, const struct zs_strip *s)
{
    const struct look *look = ((const struct sums *)ctx)->look;
    const uint32_t first = (uint32_t)look->y;
    for (uint32_t i = 0; i < (uint32_t)s->w * s->h; i++) {
        const uint32_t y = s->y + i / s->w;
        if (y < first || y >= first + BAND)
            continue;
        put_look(look);
        put_field(i % s->w);
        put_field(y);
        put_hex((uint32_t)s->px[2u * i] << 8 | s->px[2u * i + 1u], 4);
        put_hex(s->depth[i], 4);
        put_end();
    }
    return 0;
}

/* ---- Frames ----------------------------------------------------------------------------------------------------- */

#if SUMS_PIECES
static struct zs_pass_memory memory[PIECE_PASSES_MAX];

static const struct piece *piece_of(const struct demo *d)
{
    return (const struct piece *)d; /* its first member */
}

static int render(const struct demo *d, const struct zs_sink *sink)
{
    return piece_render(&renderer, piece_of(d), &frame.scene, &frame.camera, memory, sink);
}
#define METHOD_OF(d) piece_of(d)->method
#else
static int render(const struct demo *d, const struct zs_sink *sink)
{
    (void)d;
    return zs_render(&renderer, &frame.scene, &frame.camera, sink);
}
#define METHOD_OF(d) NULL
#endif

/* As many triangles as vertices, in all that strips leave. */
static int configure(const struct demo *d, uint8_t bits)
{
    const uint32_t strips = ZS_ARENA_BYTES(d->width, d->height, SUMS_ROWS, 0, 0, 0, 1) + 8u; /* 8: pools round up */
    const uint32_t fit = strips < SUMS_ARENA ? (SUMS_ARENA - strips) / (ZS_TRI_BYTES(1) + 16u + 2u * d->varyings) : 0;
    const uint16_t pool = (uint16_t)(fit < ZS_POOL_MAX ? fit : ZS_POOL_MAX);
    const struct zs_config config = { .width = d->width, .height = d->height, .strip_h = SUMS_ROWS, .max_tris = pool,
                                      .max_verts = pool, .varyings = (uint8_t)d->varyings, .buffers = 1,
                                      .subpixel_bits = bits, .depth_bits = 16, .depth = d->depth, .fast = d->fast,
                                      .method = METHOD_OF(d) };
    return zs_init(&renderer, &config, arena, sizeof arena);
}

static int draw(const struct look *k)
{
    struct sums sums = { k, FNV_BASIS, FNV_BASIS };
    const struct zs_sink sink = { .submit = k->y < 0 ? sum_up : print_pixels, .ctx = &sums };
    int err = configure(k->demo, k->bits);
    k->demo->pose(&frame, k->frame, k->demo->width, k->demo->height);
    err = err ? err : render(k->demo, &sink);
    if (err) {
        put_look(k);
        put(",error: ");
        put(zs_error_string(err));
        put_end();
    }
    return err;
}

#ifdef SUMS_PIXELS
#if SUMS_PIECES
#define SUMS_BAND(scene, frame, bits, y) { &piece_##scene.demo, frame, bits, y },
#else
#define SUMS_BAND(scene, frame, bits, y) { &demo_##scene, frame, bits, y },
#endif

static int run(void)
{
    static const struct look looks[] = { SUMS_PIXELS };
    int err = 0;
    for (uint32_t i = 0; i < sizeof looks / sizeof looks[0]; i++)
        err |= draw(&looks[i]);
    return err;
}
#elif SUMS_PIECES
static int run(void)
{
    int err = 0;
    for (uint32_t i = 0; i < n_pieces; i++) {
        const struct look looks[] = { { &pieces[i]->demo, 0, 8, -1 },
                                      { &pieces[i]->demo, pieces[i]->demo.frames * 2u / 3u, 4, -1 } };
        err |= draw(&looks[0]) | draw(&looks[1]);
    }
    return err;
}
#else
static int frames_of(const struct demo *d)
{
    const struct look looks[] = { { d, 0, 8, -1 }, { d, d->frames / 3u, 8, -1 },
                                  { d, d->frames * 2u / 3u, 4, -1 } };
    int err = 0;
    for (uint32_t i = 0; i < 3u; i += d->bench ? 2u : 1u) /* a bench scene has one frame */
        err |= draw(&looks[i]);
    return err;
}

static int run(void)
{
    int err = 0;
#ifdef SUMS_SCENES
#define JOIN(a, b) a##b
#define OF(prefix, name) JOIN(prefix, name)
#define SUMS_ONE(scene) &OF(demo_, scene),
    static const struct demo *const some[] = { SUMS_SCENES };
    for (uint32_t i = 0; i < sizeof some / sizeof some[0]; i++)
        err |= frames_of(some[i]);
#else
    for (uint32_t i = SUMS_PART; i < n_demos; i += SUMS_PARTS)
        err |= frames_of(demos[i]);
#endif
    return err;
}
#endif

int main(void)
{
    if (hal_init())
        hal_exit(1);
    hal_exit(run() != 0);
}
