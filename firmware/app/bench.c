/* The bench: every scene of demos[], frame 0, in several configurations, one line of CSV each.
 *
 *   one-pass  strips of 24 rows, one buffer, pools of just the size that takes the scene in one pass
 *   one-strip the same as a single strip of all rows
 *   64k-24, 64k-16, 64k-8   two strip buffers of so many rows, and pools that are filled up to what fits
 *             into 64 KB together with everything else: renderer, scene state, stack
 *   48k-24 .. (relief_tex at 240x240), 16k-8 .. (relief and relief_tex at 160x128, one buffer)   the same for less
 *             memory
 *
 * The checksum is FNV-1a, 64 bits, over the frame's bytes as they leave. All of a scene in one size must agree,
 * and so must every machine's. Pools are chosen from counts alone, so that all machines draw the same
 * configurations.
 *
 * With BENCH_FAST=1: one-pass strips of 24 rows with pools for everything, with all accelerators of the scene's list
 * (`all`), with none (`none`), and then with each of the list left out, named after it.
 *
 * With BENCH_POOLS, { name, max_tris, max_verts } of each scene's one-pass line: these once more, for an emulator that
 * counts what bench_frame takes from its call to its return; instructions are 0. Where BENCH_ARENA does not hold the
 * pools they are cut, and take passes.
 *
 * After the frame of the checksum, BENCH_RUNS more (2) are counted, of bars of memory BENCH_BAR_RUNS; 0: instructions
 * are 0.
 *
 * SPDX-License-Identifier: MIT
 */
#include "hal.h"
#include "number.h"
#include "report.h"
#include "scenes.h"
#include "zstrip.h"

#ifndef BENCH_FAST
#define BENCH_FAST 0
#endif
#ifdef BENCH_POOLS
#define BENCH_COUNTED 1
#else
#define BENCH_COUNTED 0
#define BENCH_POOLS { 0, 0, 0 }
#endif
#ifndef BENCH_RUNS
#define BENCH_RUNS 2
#endif
#ifndef BENCH_BAR_RUNS
#define BENCH_BAR_RUNS BENCH_RUNS
#endif
#define RESERVE 4608u /* of a RAM bar, for renderer, scene state and stack; checked where the stack is known */
#ifndef BENCH_ARENA
#define BENCH_ARENA (3u << 20)
#endif

ZS_ARENA(arena, BENCH_ARENA);
static struct zs_renderer renderer;
static struct demo_frame frame;

struct result {
    struct zs_stats stats;
    uint64_t instructions; /* the least of the runs; 0: this machine does not count them */
    uint64_t spread;       /* most minus least of the runs, instructions */
    uint64_t checksum;
    uint32_t stack;        /* bytes from the stack's top; 0: unknown */
    int err;
};

/* ---- Text ---------------------------------------------------------------------------------- */

static void put_number(uint64_t v)
{
    char room[NUMBER_CHARS];
    hal_write(number_text(room, v));
}

static void put_hex(uint64_t v)
{
    char room[HEX_CHARS];
    hal_write(number_hex(room, v));
}

/* n / d with one digit after the point, nearest. */
static void put_ratio(uint64_t n, uint64_t d)
{
    const uint64_t tenths = d ? (n * 10u + d / 2u) / d : 0u;
    report_field(tenths / 10u);
    hal_write(".");
    put_number(tenths % 10u);
}

/* ---- Sinks --------------------------------------------------------------------------------- */

static int send(void *ctx, const struct zs_strip *s)
{
    struct hal_bus *bus = ctx;
    return bus->data(bus, s->px, s->n_bytes);
}

static int wait(void *ctx)
{
    struct hal_bus *bus = ctx;
    return bus->wait(bus);
}

/* ---- Runs ---------------------------------------------------------------------------------- */

static uint16_t pool_of(uint64_t wanted, uint16_t least)
{
    return (uint16_t)(wanted < least ? least : wanted > ZS_POOL_MAX ? ZS_POOL_MAX : wanted);
}

static void fill_config(struct zs_config *c, const struct demo *d, uint16_t rows, uint8_t buffers,
                        uint32_t tris, uint32_t verts)
{
    c->width = d->width;
    c->height = d->height;
    c->strip_h = rows;
    c->max_tris = pool_of(tris, 1);
    c->max_verts = pool_of(verts, 3);
    c->varyings = (uint8_t)d->varyings;
    c->buffers = buffers;
    c->subpixel_bits = 8;
    c->depth_bits = 16;
    c->depth = d->depth;
    c->fast = d->fast;
    c->method = 0;
}

static int configure(struct zs_config *c, const struct demo *d, uint16_t rows, uint8_t buffers,
                     uint32_t tris, uint32_t verts)
{
    fill_config(c, d, rows, buffers, tris, verts);
    return zs_init(&renderer, c, arena, sizeof arena);
}

/* One frame to nowhere; its statistics stay in the renderer. */
static int draw(void)
{
    const struct zs_sink sink = { .submit = send, .wait = wait, .ctx = hal_bus() };
    return zs_render(&renderer, &frame.scene, &frame.camera, &sink);
}

static uint64_t measure(int *err)
{
    const uint64_t start = hal_ticks();
    *err = draw();
    return (hal_ticks() - start) * hal_tick_instructions();
}

/* A frame for its checksum, then some for their instructions, the last one for its stack too. */
static void run(struct result *out, int runs)
{
    uint64_t least = 0, most = 0;
    out->checksum = REPORT_HASH;
    const struct zs_sink sink = { .submit = report_hash, .ctx = &out->checksum };
    out->err = zs_render(&renderer, &frame.scene, &frame.camera, &sink);
    for (int i = 0; i < runs && !out->err; i++) {
        hal_stack_paint();
        const uint64_t n = measure(&out->err);
        least = i && least < n ? least : n;
        most = most > n ? most : n;
    }
    if (out->err)
        return;
    out->stack = runs ? hal_stack_used() : 0;
    out->instructions = least;
    out->spread = most - least;
    out->stats = *zs_frame_stats(&renderer);
}

/* ---- Lines --------------------------------------------------------------------------------- */

static uint32_t statics(void)
{
    return (uint32_t)(sizeof renderer + sizeof frame);
}

static void line(const struct demo *d, const char *variant, const struct zs_config *c,
                 const struct result *r)
{
    const uint32_t bytes = zs_arena_bytes(c);
    hal_write(d->name);
    hal_write(",");
    hal_write(variant);
    if (r->err) {
        hal_write(",error: ");
        hal_write(zs_error_string(r->err));
        hal_write("\n");
        return;
    }
    report_field(c->max_tris);
    report_field(c->max_verts);
    report_field(r->stats.passes);
    report_field(r->stats.tris_in);
    report_field(r->stats.tris_drawn);
    report_field(r->stats.tris_setup);
    report_field(r->stats.verts_transformed);
    report_field(r->stats.pixels_tested);
    report_field(bytes);
    hal_write(",");
    put_hex(r->checksum);
    report_field(r->instructions);
    put_ratio(r->instructions, r->stats.tris_in);
    put_ratio(r->instructions, r->stats.pixels_tested);
    report_field(r->stack);
    report_field(bytes + statics() + r->stack);
    hal_write("\n");
}

/* Everything that a scene can put into the pools; clipping adds some. */
static void ample(uint32_t *tris, uint32_t *verts)
{
    *tris = *verts = 256u;
    for (uint32_t i = 0; i < frame.scene.n_instances; i++) {
        *tris += frame.scene.instance[i].mesh->n_tris;
        *verts += frame.scene.instance[i].mesh->n_verts;
    }
}

/* Find the least pools that take the scene in one pass. Return 0, or an error. */
static int one_pass(struct zs_config *c, const struct demo *d)
{
    uint32_t tris, verts;
    ample(&tris, &verts);
    int err = configure(c, d, 24, 1, tris, verts);
    if (!err)
        err = draw();
    if (err)
        return err;
    const struct zs_stats s = *zs_frame_stats(&renderer);
    /* fewer places than the meshes have vertices may evict one that comes again: grow until none does */
    for (uint32_t v = s.max_verts_used; v < verts; v += v / 16u + 1u) {
        err = configure(c, d, 24, 1, s.max_tris_used, v);
        if (!err)
            err = draw();
        if (err || zs_frame_stats(&renderer)->passes == 1u)
            return err;
    }
    return configure(c, d, 24, 1, tris, verts);
}

/* Every run of every configuration must agree. Return 1 and say so where one does not. */
static int disagrees(const struct result *r, uint64_t checksum)
{
    const char *why = 0;
    if (r->err)
        why = "error";
    else if (r->checksum != checksum)
        why = "its checksum differs from the one-pass frame's";
    else if (r->spread > hal_tick_instructions()) /* a run begins at any instruction of a tick */
        why = "its runs took different numbers of instructions";
    else if (statics() + r->stack > RESERVE)
        why = "renderer, scene state and stack exceed their reserve";
    if (!why)
        return 0;
    hal_write("# FAILED, the line above: ");
    hal_write(why);
    hal_write("\n");
    return 1;
}

/* ---- Accelerators ---------------------------------------------------------------------------- */

#define FAST_MAX 16 /* of a scene */

#define ROW(name) { &zs_fast_##name, #name },
static const struct {
    const struct zs_fast *fast;
    const char *name;
} accelerators[] = { ZS_FAST_EACH(ROW) };

static const char *fast_name(const struct zs_fast *fast)
{
    for (uint32_t i = 0; i < sizeof accelerators / sizeof accelerators[0]; i++)
        if (accelerators[i].fast == fast)
            return accelerators[i].name;
    return "error: an accelerator without a name";
}

/* Return 1 where the frame went wrong or is another one than *checksum; 0 there takes it from this frame. */
static int fast_variant(const struct demo *d, const char *name, const struct zs_fast *const *fast, uint64_t *checksum)
{
    struct zs_config c;
    struct result r = { 0 };
    uint32_t tris, verts;
    ample(&tris, &verts);
    fill_config(&c, d, 24, 1, tris, verts);
    c.fast = fast;
    r.err = zs_init(&renderer, &c, arena, sizeof arena);
    if (!r.err)
        run(&r, BENCH_RUNS);
    if (!*checksum)
        *checksum = r.checksum;
    line(d, name, &c, &r);
    return disagrees(&r, *checksum);
}

/* What each accelerator is worth. Return the number of configurations that failed. */
static int fast_worth(const struct demo *d)
{
    const struct zs_fast *without[FAST_MAX] = { 0 };
    uint64_t checksum = 0;
    uint32_t n = 0;
    d->pose(&frame, 0, d->width, d->height);
    int failed = fast_variant(d, "all", d->fast, &checksum) + fast_variant(d, "none", 0, &checksum);
    while (d->fast && d->fast[n])
        n++;
    for (uint32_t left_out = 0; left_out < n && n < FAST_MAX; left_out++) {
        uint32_t kept = 0;
        for (uint32_t i = 0; i < n; i++)
            if (i != left_out)
                without[kept++] = d->fast[i];
        without[kept] = 0;
        failed += fast_variant(d, fast_name(d->fast[left_out]), without, &checksum);
    }
    return failed + (n >= FAST_MAX);
}

/* ---- All configurations of a scene ----------------------------------------------------------- */

/* Configurations that a bar of RAM leaves: strips, and of the pools as much as fits. */
struct bar {
    const char *name;
    const struct demo *only; /* of one scene; NULL: of all */
    uint32_t ram;            /* bytes, everything counted */
    uint16_t width, height;  /* px; 0: the scene's own */
    uint16_t rows;           /* of a strip */
    uint8_t buffers;
};
static const struct bar bars[] = {
    { "64k-24", 0, 65536u, 0, 0, 24, 2 },
    { "64k-16", 0, 65536u, 0, 0, 16, 2 },
    { "64k-8", 0, 65536u, 0, 0, 8, 2 },
    { "48k-24", &demo_relief_tex, 49152u, 240, 240, 24, 2 },
    { "48k-16", &demo_relief_tex, 49152u, 240, 240, 16, 2 },
    { "48k-8", &demo_relief_tex, 49152u, 240, 240, 8, 2 },
    { "16k-8", &demo_relief, 16384u, 160, 128, 8, 1 },
    { "16k-4", &demo_relief, 16384u, 160, 128, 4, 1 },
    { "16k-8", &demo_relief_tex, 16384u, 160, 128, 8, 1 },
    { "16k-4", &demo_relief_tex, 16384u, 160, 128, 4, 1 },
};

/* most: the pools that take all of the scene. Return 0, or an error: ZS_ERR_ARENA where strips alone are more than the
 * bar. */
static int configure_bar(struct zs_config *c, const struct demo *d, const struct bar *bar, const struct zs_config *most)
{
    const uint32_t whole = ZS_TRI_BYTES(most->max_tris) + ZS_VERT_BYTES(most->max_verts, most->varyings);
    fill_config(c, d, bar->rows, bar->buffers, 1, 3);
    c->width = bar->width ? bar->width : d->width;
    c->height = bar->height ? bar->height : d->height;
    const uint32_t strips = ZS_ARENA_BYTES(c->width, c->height, bar->rows, 0, 0, 0, bar->buffers);
    if (strips + RESERVE + 256u > bar->ram)
        return ZS_ERR_ARENA;
    const uint32_t left = bar->ram - RESERVE - strips - 8u; /* 8: pools are rounded up */
    const uint32_t part = left < whole ? left : whole;
    c->max_tris = pool_of((uint64_t)most->max_tris * part / whole, 1);
    c->max_verts = pool_of((uint64_t)most->max_verts * part / whole, 3);
    return zs_init(&renderer, c, arena, sizeof arena);
}

/* Return the number of configurations that failed. */
static int bench_bars(const struct demo *d, const struct zs_config *most, uint64_t checksum)
{
    struct zs_config c;
    struct result r = { 0 };
    uint32_t width = most->width, height = most->height;
    int failed = 0;
    for (const struct bar *bar = bars; bar < bars + sizeof bars / sizeof bars[0]; bar++) {
        if (bar->only && bar->only != d)
            continue;
        r.err = configure_bar(&c, d, bar, most);
        if (r.err == ZS_ERR_ARENA) {
            hal_write("# ");
            hal_write(d->name);
            hal_write(" does not fit as ");
            hal_write(bar->name);
            hal_write("\n");
            continue;
        }
        const int resized = c.width != width || c.height != height;
        if (resized)
            d->pose(&frame, 0, c.width, c.height);
        width = c.width;
        height = c.height;
        if (!r.err)
            run(&r, BENCH_BAR_RUNS);
        if (resized)
            checksum = r.checksum;
        line(d, bar->name, &c, &r);
        failed += disagrees(&r, checksum);
    }
    return failed;
}

/* Return the number of configurations that failed. */
static int bench(const struct demo *d)
{
    struct zs_config most, one;
    struct result r = { 0 };
    int failed = 0;
    d->pose(&frame, 0, d->width, d->height);
    r.err = one_pass(&most, d);
    if (!r.err)
        run(&r, BENCH_RUNS);
    line(d, "one-pass", &most, &r);
    const uint64_t checksum = r.checksum;
    failed += disagrees(&r, checksum);
    if (r.err)
        return failed;
    r.err = configure(&one, d, d->height, 1, most.max_tris, most.max_verts);
    if (!r.err)
        run(&r, BENCH_RUNS);
    line(d, "one-strip", &one, &r);
    failed += disagrees(&r, checksum);
    if (d == &demo_crowd_ftb || d == &demo_crowd_btf)
        return failed; /* for their order alone; little RAM would take dozens of passes */
    return failed + bench_bars(d, &most, checksum);
}

/* ---- Counted from outside --------------------------------------------------------------------- */

static const struct {
    const char *name;
    uint16_t tris, verts;
} pools[] = { BENCH_POOLS };

static int same(const char *a, const char *b)
{
    while (*a && *a == *b) {
        a++;
        b++;
    }
    return *a == *b;
}

/* What is counted: a frame, drawn and cleared, to nowhere. By its name, so not static. */
int bench_frame(void);
__attribute__((noinline)) int bench_frame(void)
{
    const struct zs_sink sink = { .submit = report_drop };
    return zs_render(&renderer, &frame.scene, &frame.camera, &sink);
}

/* Return the number of configurations that failed. */
static int counted(const struct demo *d)
{
    struct zs_config c;
    struct result r = { 0 };
    uint32_t i = 0;
    while (i + 1u < sizeof pools / sizeof pools[0] && pools[i].name && !same(pools[i].name, d->name))
        i++;
    const uint32_t whole = ZS_TRI_BYTES(pools[i].tris) + ZS_VERT_BYTES(pools[i].verts, d->varyings);
    const uint32_t left = (uint32_t)sizeof arena - ZS_ARENA_BYTES(d->width, d->height, 24, 0, 0, 0, 1) - 8u;
    const uint32_t part = left < whole ? left : whole;
    d->pose(&frame, 0, d->width, d->height);
    r.err = configure(&c, d, 24, 1, (uint32_t)((uint64_t)pools[i].tris * part / whole),
                      (uint32_t)((uint64_t)pools[i].verts * part / whole));
    r.checksum = REPORT_HASH;
    const struct zs_sink sink = { .submit = report_hash, .ctx = &r.checksum };
    if (!r.err)
        r.err = zs_render(&renderer, &frame.scene, &frame.camera, &sink);
    hal_stack_paint();
    if (!r.err)
        r.err = bench_frame();
    r.stack = hal_stack_used();
    r.stats = *zs_frame_stats(&renderer);
    line(d, part == whole ? "one-pass" : "cut", &c, &r);
    return r.err != 0;
}

int main(void)
{
    int failed = 0;
    if (hal_init())
        hal_exit(1);
    hal_write("scene,variant,max_tris,max_verts,passes,tris_in,drawn,setups,verts,fragments,arena,"
              "checksum,instructions,per_tri,per_fragment,stack,ram\n");
    for (uint32_t i = 0; i < n_demos; i++)
        failed += BENCH_COUNTED ? counted(demos[i]) : BENCH_FAST ? fast_worth(demos[i]) : bench(demos[i]);
    hal_write(failed ? "# failed\n" : "# ok: checksums, counts and RAM agree\n");
    hal_exit(failed != 0);
}
