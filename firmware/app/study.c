/* The runs of `zsim study time` or `memory` on a board: a line "run,checksum,instructions" each (cycles, on the Pico).
 * The checksum is FNV-1a, 64 bits, over the frame's bytes as they leave; zsim refuses counts of a frame that is not its
 * own. On this machine instructions are 0, and callgrind counts study_frame.
 *
 * study_settings.h is what `zsim study NAME --settings` printed. A run of another build (reciprocals, sub-spans:
 * zs_config.h) is left to that build.
 *
 * SPDX-License-Identifier: MIT
 */
#include "hal.h"
#include "number.h"
#include "report.h"
#include "scenes.h"
#include "zs_method.h"
#include "zstrip.h"

#ifndef STUDY_ARENA
#define STUDY_ARENA (3u << 20)
#endif
#ifndef STUDY_TICK
#define STUDY_TICK hal_tick_instructions() /* what a tick is worth; on the Pico 125 cycles */
#endif
#ifndef STUDY_SHORT
#define STUDY_SHORT 0 /* 1: only runs with 8 sub-pixel bits and keys of 16 bits */
#endif

struct setting {
    uint32_t run;
    const struct demo *demo;
    uint16_t strip_h, max_tris, max_verts;
    uint8_t buffers, subpixel_bits, depth_bits;
    const struct zs_depth *depth;
    const struct zs_method *method; /* 0: the depth buffer */
    uint8_t recip_steps, coarse_log2, bound_log2; /* of the build */
};

static const struct setting setting[] = {
#include "study_settings.h"
};

ZS_ARENA(arena, STUDY_ARENA);
static struct zs_renderer renderer;
static struct demo_frame frame;

/* What is counted, by its name where callgrind counts: not static. */
int study_frame(void);
__attribute__((noinline)) int study_frame(void)
{
    const struct zs_sink nowhere = { .submit = report_drop };
    return zs_render(&renderer, &frame.scene, &frame.camera, &nowhere);
}

static int measure(const struct setting *s)
{
    const struct demo *d = s->demo;
    const struct zs_config config = {
        .width = d->width, .height = d->height, .strip_h = s->strip_h, .max_tris = s->max_tris,
        .max_verts = s->max_verts, .varyings = (uint8_t)d->varyings, .buffers = s->buffers,
        .subpixel_bits = s->subpixel_bits, .depth_bits = s->depth_bits, .depth = s->depth,
        .method = s->method, .fast = d->fast
    };
    char room[NUMBER_CHARS], hex[HEX_CHARS];
    uint64_t checksum = REPORT_HASH, ticks = 0;
    const struct zs_sink to_sum = { .submit = report_hash, .ctx = &checksum };
    d->pose(&frame, 0, d->width, d->height);
    int err = zs_init(&renderer, &config, arena, sizeof arena);
    if (!err)
        err = zs_render(&renderer, &frame.scene, &frame.camera, &to_sum);
    if (!err) {
        const uint64_t start = hal_ticks();
        err = study_frame();
        ticks = hal_ticks() - start;
    }
    hal_write(number_text(room, s->run));
    hal_write(",");
    hal_write(err ? zs_error_string(err) : number_hex(hex, checksum));
    hal_write(",");
    hal_write(number_text(room, ticks * STUDY_TICK));
    hal_write("\n");
    return err;
}

int main(void)
{
    int failed = 0;
    if (hal_init())
        hal_exit(1);
    for (uint32_t i = 0; i < sizeof setting / sizeof setting[0]; i++)
        if (setting[i].recip_steps == ZS_RECIP_STEPS && setting[i].coarse_log2 == ZS_TEXEL_COARSE_LOG2 &&
            setting[i].bound_log2 == ZS_SPAN_BOUND_LOG2 &&
            (!STUDY_SHORT || (setting[i].subpixel_bits == 8 && setting[i].depth_bits == 16)))
            failed |= measure(&setting[i]);
    hal_write(failed ? "# failed\n" : "# ok\n");
    hal_exit(failed != 0);
}
