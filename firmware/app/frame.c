/* One frame of one scene, frame 0, for tests/boards/profile.sh to count: strips of 24 rows, one buffer, pools that take
 * the scene in one pass, as the bench's one-pass frames. FRAME_DEMO=mesh names the scene.
 *
 * SPDX-License-Identifier: MIT
 */
#include "hal.h"
#include "report.h"
#include "scenes.h"
#include "zstrip.h"

#define ARENA_BYTES (3u << 20)
#define OF_NAME_(name) demo_##name
#define OF_NAME(name) OF_NAME_(name)

ZS_ARENA(arena, ARENA_BYTES);
static struct zs_renderer renderer;
static struct demo_frame frame;

int main(void)
{
    const struct demo *d = &OF_NAME(FRAME_DEMO);
    struct zs_config c = { .width = d->width, .height = d->height, .strip_h = 24, .varyings = (uint8_t)d->varyings,
                           .buffers = 1, .subpixel_bits = 8, .depth_bits = 16, .depth = d->depth, .fast = d->fast };
    const struct zs_sink sink = { .submit = report_drop };
    if (hal_init())
        hal_exit(1);
    d->pose(&frame, 0, d->width, d->height);
    report_pools(&c, &frame.scene);
    int err = zs_init(&renderer, &c, arena, sizeof arena);
    if (!err)
        err = zs_render(&renderer, &frame.scene, &frame.camera, &sink);
    hal_exit(err != 0);
}
