/* What probes cost: every scene of probes.h, one line of CSV each. Instructions where ticks count them, else the ticks
 * of one frame; the checksum is FNV-1a, 32 bits, over the frame's bytes as they leave, so that whoever counts what was
 * done in the same frame elsewhere knows that it is the same. COSTS_FEW=1: of those that tell much
 * the same half, and no checksum, for slow machines.
 *
 * SPDX-License-Identifier: MIT
 */
#include "hal.h"
#include "number.h"
#include "probes.h"
#include "report.h"
#include "zs_method.h" /* probes draw by all methods */

#ifndef COSTS_FEW
#define COSTS_FEW 0
#endif

ZS_ARENA(arena, PROBE_ARENA_BYTES);
static struct zs_renderer renderer;
static struct probe probe;

static int hash(void *ctx, const struct zs_strip *s)
{
    uint32_t *sum = ctx, h = *sum;
    for (uint32_t i = 0; i < s->n_bytes; i++)
        h = (h ^ s->px[i]) * 16777619u;
    *sum = h;
    return 0;
}

static int draw(const struct zs_sink *sink)
{
    return zs_render(&renderer, &probe.frame.scene, &probe.frame.camera, sink);
}

static int measure(uint32_t i)
{
    uint32_t sum = 2166136261u;
    const struct zs_sink summing = { .submit = hash, .ctx = &sum }, nowhere = { .submit = report_drop };
    int err = zs_init(&renderer, &probe.config, arena, sizeof arena);
    if (!COSTS_FEW)
        err = err ? err : draw(&summing);
    const uint64_t start = hal_ticks();
    err = err ? err : draw(&nowhere);
    const uint64_t ticks = hal_ticks() - start;
    char room[NUMBER_CHARS];
    hal_write(number_text(room, i));
    hal_write(",");
    hal_write(probe.name);
    report_field(hal_tick_instructions() ? ticks * hal_tick_instructions() : ticks);
    report_field(COSTS_FEW ? 0u : sum);
    if (err) {
        hal_write(",error: ");
        hal_write(zs_error_string(err));
    }
    hal_write("\n");
    return err != 0;
}

int main(void)
{
    int failed = 0;
    if (hal_init())
        hal_exit(1);
    hal_write(hal_tick_instructions() ? "probe,name,instructions,checksum\n" : "probe,name,ticks,checksum\n");
    for (uint32_t i = 0; probe_make(&probe, i); i++)
        if (!COSTS_FEW || !probe.common || i * 2654435761u >> 31) /* half of them, in no order */
            failed += measure(i);
    hal_write(failed ? "# failed\n" : "# ok\n");
    hal_exit(failed != 0);
}
