/* What looks (sim/lab/looks.h) take: a line of CSV each: name, instructions of a frame, checksum of it.
 * tests/lab/looks.sh runs it.
 *
 * SPDX-License-Identifier: MIT
 */
#include "looks.h"
#include "hal.h"
#include "report.h"
#include "zs_fast.h"

#ifndef CYCLES_A_TICK
#define CYCLES_A_TICK 0 /* where ticks do not count instructions: 125 on the Pico, whose cycles are printed then */
#endif

ZS_ARENA(arena, 2u << 20);
static struct zs_renderer renderer;

static int measure(const struct look *look, int err)
{
    static const struct zs_fast *const all[] = { ZS_FAST_ALL, ZS_FAST_END };
    const struct zs_config c = { .width = look->w, .height = look->h, .strip_h = LOOK_STRIP, .max_tris = LOOK_TRIS,
                                 .max_verts = LOOK_VERTS, .varyings = look->varyings, .buffers = 1,
                                 .method = look->method, .depth = &zs_depth_float, .fast = all };
    uint64_t sum = REPORT_HASH;
    const struct zs_sink hash = { .submit = report_hash, .ctx = &sum }, drop = { .submit = report_drop };
    err = err ? err : zs_init(&renderer, &c, arena, sizeof arena);
    err = err ? err : look_draw(look, &renderer, &hash);
    const uint64_t start = hal_ticks();
    err = err ? err : look_draw(look, &renderer, &drop);
    const uint32_t a_tick = hal_tick_instructions();
    const uint64_t taken = (hal_ticks() - start) * (a_tick ? a_tick : CYCLES_A_TICK);
    hal_write(err ? "# FAILED: " : "");
    hal_write(look->name);
    hal_write(err ? zs_error_string(err) : "");
    report_field(taken);
    report_field(sum);
    hal_write("\n");
    return err != 0;
}

int main(void)
{
    struct look look;
    int failed = 0, err;
    if (hal_init())
        hal_exit(1);
    for (uint32_t i = 0; look_make(&look, i, &err); i++)
        failed |= measure(&look, err);
    hal_exit(failed);
}
