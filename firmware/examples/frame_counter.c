/* A number over the picture, by a resolve hook. The hook says where it draws otherwise than before, so that
 * zs_damage_track has only that rectangle drawn again while the scene stands still.
 *
 * SPDX-License-Identifier: MIT
 */
#include "examples.h"
#include "zs_damage.h"

ZS_RENDERER(screen, EXAMPLE_W, EXAMPLE_H, 8, 8, 8, ZS_VARYINGS_FLAT);
static uint32_t track[ZS_DAMAGE_WORDS(0, EXAMPLE_H, 8)];

/* ---- The counter: three digits of 3 x 5 pixels, the last at the right edge -------------------------------------- */

enum { TOP = 1, LEFT = EXAMPLE_W - 13 };
static const uint16_t digit[10] = { /* rows from the top, three bits each, the leftmost highest */
    075557, 026227, 071747, 071717, 055711, 074717, 074757, 071244, 075757, 075717
};

struct counter { uint32_t shown, before; };

static void counter_draw(void *ctx, const struct zs_target *to)
{
    const struct counter *c = (const struct counter *)ctx;
    for (int y = 0; y < 5; y++)
        for (int x = 0; x < 11; x++) {
            const uint32_t place = x < 3 ? 100u : x < 7 ? 10u : 1u;
            const int bit = x % 4 < 3 && digit[c->shown / place % 10u] >> (3 * (4 - y) + 2 - x % 4) & 1;
            if (bit && TOP + y >= to->y0 && TOP + y < to->y1 && LEFT + x >= to->x0 && LEFT + x < to->x1)
                to->color[(uint32_t)(TOP + y - to->y0) * to->pitch + (uint32_t)(LEFT + x)] = 0xffff;
        }
}

static int counter_changes(void *ctx, struct zs_rect *rect)
{
    struct counter *c = (struct counter *)ctx;
    const int changed = c->shown != c->before;
    *rect = (struct zs_rect){ .x = LEFT, .y = TOP, .w = 11, .h = 5 };
    c->before = c->shown;
    return changed;
}

/* ---- Frames ---------------------------------------------------------------------------------------------------- */

int example_frame_counter(uint32_t t, const struct zs_sink *sink)
{
    static struct counter counter;
    static const struct zs_resolve hook = { .draw = counter_draw, .changes = counter_changes, .ctx = &counter };
    const struct zs_scene scene = { .background = ZS_RGB565(0x000050), .resolve = &hook, .n_resolves = 1 };
    struct zs_camera camera;
    int err = zs_camera_orthographic(&camera, 24, 1, 100);
    if (!err && t == 0) {
        screen_config.depth = &zs_depth_linear;
        err = ZS_INIT(screen);
        err = err ? err : zs_damage_track(&screen, track, 0);
        err = err ? err : zs_damage_columns(&screen, 1);
    }
    counter.shown = t;
    return err ? err : zs_render(&screen, &scene, &camera, sink);
}
