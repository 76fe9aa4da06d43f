/* Gauges over the picture: a dial with ticks and a needle, a bar, a number. Items are plain data; a program changes
 * their values, and only the rectangle around what changed is drawn again and sent.
 *
 * SPDX-License-Identifier: MIT
 */
#include "examples.h"
#include "zs_damage.h"
#include "zs_overlay.h"

ZS_RENDERER(screen, EXAMPLE_W, EXAMPLE_H, 8, 8, 8, ZS_VARYINGS_FLAT);
static uint32_t track[ZS_DAMAGE_WORDS(0, EXAMPLE_H, 8)];

/* The dial goes from lower left, clockwise, to lower right. */
#define DIAL .x = 15, .y = 16, .from = ZS_DEGREES(-135), .sweep = ZS_DEGREES(270)
enum { RING, TICKS, NEEDLE, BAR, NUMBER, ITEMS };
static char number[3];
/* clang-format off */
static struct zs_item item[ITEMS] = {
    [RING] = { .kind = &zs_item_arc, DIAL, .w = 14, .h = 2, .color = ZS_RGB565(0xff8000), .back = ZS_RGB565(0x404040) },
    [TICKS] = { .kind = &zs_item_ticks, DIAL, .w = 11, .h = 2, .value = 6, .color = ZS_RGB565(0xffffff) },
    [NEEDLE] = { .kind = &zs_item_needle, DIAL, .w = 10, .h = 3, .size = 4, .color = ZS_RGB565(0xff0000) },
    [BAR] = { .kind = &zs_item_bar, .x = 31, .y = 3, .w = 3, .h = 26, .flags = ZS_ITEM_UP, .value = 40000,
              .color = ZS_RGB565(0x00ff00), .back_clear = 128 /* half black */ },
    [NUMBER] = { .kind = &zs_item_text, .x = 36, .y = 12, .color = ZS_RGB565(0xffffff), .text = number },
};
/* clang-format on */
static uint32_t memory[ZS_OVERLAY_WORDS(ITEMS)];
static struct zs_overlay gauges = { .item = item, .n = ITEMS, .memory = memory, .room = ITEMS };

int example_cockpit_gauges(uint32_t t, const struct zs_sink *sink)
{
    static const struct zs_resolve hook = { .draw = zs_overlay_draw, .changes = zs_overlay_changes, .ctx = &gauges };
    const struct zs_scene scene = { .background = ZS_RGB565(0x203860), .resolve = &hook, .n_resolves = 1 };
    struct zs_camera camera;
    int err = zs_camera_orthographic(&camera, 24, 1, 100);
    if (!err && t == 0) {
        screen_config.depth = &zs_depth_linear;
        err = ZS_INIT(screen);
        err = err ? err : zs_damage_track(&screen, track, 0);
        err = err ? err : zs_damage_columns(&screen, 1);
        err = err ? err : zs_overlay_check(&gauges);
    }
    const uint32_t now = (42 + t) % 100;
    item[RING].value = item[NEEDLE].value = (uint16_t)(now * 65535u / 100u);
    number[0] = (char)('0' + now / 10u);
    number[1] = (char)('0' + now % 10u);
    return err ? err : zs_render(&screen, &scene, &camera, sink);
}
