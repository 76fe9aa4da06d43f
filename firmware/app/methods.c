/* Methods of hidden-surface removal side by side: frame 0 of some scenes by each of them, a line of CSV each. Strips of
 * 24 rows, one buffer, pools that take the scene in one set; the checksum is FNV-1a, 64 bits, over the frame's bytes.
 *
 * Lines: method,scene,instructions,arena,sorted,splits,rays,checksum
 *
 * SPDX-License-Identifier: MIT
 */
#include "hal.h"
#include "number.h"
#include "report.h"
#include "scenes.h"
#include "zs_method.h"
#include "zstrip.h"

#ifndef ARENA_BYTES
#define ARENA_BYTES (3u << 20)
#endif
#ifndef CYCLES_A_TICK
#define CYCLES_A_TICK 0 /* where ticks do not count instructions: 125 on the Pico, whose cycles are printed then */
#endif

ZS_ARENA(arena, ARENA_BYTES);
static struct zs_renderer renderer;
static struct demo_frame frame;

static const struct {
    const char *name;
    const struct zs_method *method;
    const struct zs_depth *depth; /* NULL: the scene's */
    int records;                  /* flag: it keeps records of its own in the triangle pool */
} methods[] = {
#define ROW(name_, depth_, tris_, verts_, records_) { #name_, &zs_method_##name_, depth_, records_ },
    { "zbuffer", 0, 0, 0 },
    ZS_METHOD_EACH(ROW)
#undef ROW
};

static uint16_t pool_of(uint32_t wanted, uint16_t least)
{
    return (uint16_t)(wanted < least ? least : wanted > ZS_POOL_MAX ? ZS_POOL_MAX : wanted);
}

/* Draw a frame. Return an enum zs_err; *instructions: what it took, 0 where this machine does not count. */
static int draw(const struct zs_config *c, uint64_t *instructions, uint64_t *checksum)
{
    const struct zs_sink drop = { .submit = report_drop }, hash = { .submit = report_hash, .ctx = checksum };
    int err = zs_init(&renderer, c, arena, sizeof arena);
    *checksum = REPORT_HASH;
    if (!err && !CYCLES_A_TICK) /* slow machines draw each frame once */
        err = zs_render(&renderer, &frame.scene, &frame.camera, &hash);
    const uint64_t start = hal_ticks();
    if (!err)
        err = zs_render(&renderer, &frame.scene, &frame.camera, &drop);
    const uint32_t a_tick = hal_tick_instructions();
    *instructions = (hal_ticks() - start) * (a_tick ? a_tick : CYCLES_A_TICK);
    return err;
}

/* Pools of a scene in one set; where there is no memory for them, smaller ones, which take more walks. */
static void pools(struct zs_config *c, uint32_t tris, uint32_t verts)
{
    do {
        c->max_tris = pool_of(tris, 2);
        c->max_verts = pool_of(verts, 6);
        tris = tris * 7u / 8u;
        verts = verts * 7u / 8u;
    } while (zs_arena_bytes(c) > sizeof arena && tris > 4u);
}

static int measure(const struct demo *d, uint32_t m)
{
    struct zs_config c = { .width = d->width, .height = d->height, .strip_h = 24, .varyings = (uint8_t)d->varyings,
                           .buffers = 1,
                           .depth = methods[m].depth ? methods[m].depth : d->depth,
                           .fast = d->fast, .method = methods[m].method };
    uint64_t instructions, checksum;
    char room[HEX_CHARS];
    d->pose(&frame, 0, d->width, d->height);
    pools(&c, 10000, 30000);
    int err = draw(&c, &instructions, &checksum);
    const struct zs_stats *s = zs_frame_stats(&renderer);
    pools(&c, methods[m].records ? s->max_tris_used * 5 / 2 + 64 : s->max_tris_used, s->max_verts_used);
    err = err ? err : draw(&c, &instructions, &checksum);
    hal_write(methods[m].name);
    hal_write(",");
    hal_write(d->name);
    report_field(instructions);
    report_field(zs_arena_bytes(&c));
    report_field(s->sorted);
    report_field(s->splits);
    report_field(s->rays);
    hal_write(",");
    hal_write(number_hex(room, checksum));
    hal_write(err ? ",failed\n" : "\n");
    return err != 0;
}

int main(void)
{
    static const struct demo *const scenes[] = { &demo_cubes, &demo_city, &demo_corridor, &demo_layers_btf };
    int failed = 0;
    if (hal_init())
        hal_exit(1);
    hal_write("method,scene,instructions,arena,sorted,splits,rays,checksum\n");
    for (uint32_t i = 0; i < sizeof scenes / sizeof scenes[0]; i++)
        for (uint32_t m = 0; m < sizeof methods / sizeof methods[0]; m++)
            if (!CYCLES_A_TICK || i == 0 || methods[m].method != &zs_method_raycast)
                failed |= measure(scenes[i], m);
    hal_exit(failed);
}
