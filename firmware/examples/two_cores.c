/* One frame by two cores, each with a renderer of its own: each bins a part of the triangles and takes over the other's
 * (zs_share.h); then each draws every other strip. Here one core does the work of both, in turn: on a board each runs
 * its half of the loops, and waits for the other where a comment says so (firmware/app/pair.c is that for a Pico).
 *
 * SPDX-License-Identifier: MIT
 */
#include "examples.h"
#include "icosahedron.h"
#include "zs_fast.h"
#include "zs_share.h"

enum { ROWS = 8 };
ZS_RENDERER(first, EXAMPLE_W, EXAMPLE_H, ROWS, 24, 16, ZS_VARYINGS_FLAT); /* the same numbers, as each bins for both */
ZS_RENDERER(second, EXAMPLE_W, EXAMPLE_H, ROWS, 24, 16, ZS_VARYINGS_FLAT);
static struct zs_share share;

static const struct zs_fast *const fast[] = { ZS_FAST_FRAME, ZS_FAST_FLAT, ZS_FAST_END };
static const struct zs_material orange = { .shader = &zs_shade_flat, .rgb = ZS_RGB(0xff8020) };

int example_two_cores(uint32_t t, const struct zs_sink *sink)
{
    struct zs_renderer *const core[2] = { &first, &second };
    struct zs_instance instance = { .mesh = &icosahedron, .material = &orange };
    const struct zs_scene scene = { .instance = &instance, .n_instances = 1, .background = ZS_RGB565(0x000050) };
    struct zs_camera camera;
    struct zs_strip strip;
    first_config.depth = second_config.depth = &zs_depth_float;
    first_config.fast = second_config.fast = fast;
    int err = icosahedron_turn(&instance.pose, &camera, t);
    err = err ? err : ZS_INIT(first);
    err = err ? err : ZS_INIT(second);
    zs_share_set(&share, core[0], core[1], 32768); /* half of the triangles each */
    for (uint32_t k = 0; !err && k < 2; k++)
        err = zs_frame_begin(core[k], &scene, &camera);
    if (err)
        return err;
    for (uint32_t step = 0; step < ZS_SHARE_STEPS; step++)
        for (uint32_t k = 0; k < 2; k++) /* behind each step, both wait until both are through with it */
            (void)zs_share_step(&share, k, step);
    for (uint32_t n = 0; !err && n < EXAMPLE_H / ROWS; n++) {
        (void)zs_frame_skip(core[1u - n % 2u]);
        (void)zs_frame_strip(core[n % 2u], &strip); /* strips are sent in their order, by one core */
        err = sink->submit(sink->ctx, &strip);
        err = err || !sink->wait ? err : sink->wait(sink->ctx);
    }
    (void)zs_frame_end(core[0]);
    (void)zs_frame_end(core[1]);
    const int last = sink->end ? sink->end(sink->ctx) : ZS_OK;
    return err ? err : last;
}
