/* What a depth mapping costs: bench scenes at 96x72 under each, one line of CSV a scene and mapping. Small enough
 * for a part with 16 KB of RAM, so that an Armv6-M core without CLZ and an Armv7-M core do the same work.
 *
 * SPDX-License-Identifier: MIT
 */
#include "hal.h"
#include "report.h"
#include "scenes.h"
#include "zstrip.h"

#define W 96
#define H 72
#define ROWS 8
#define TRIS 160
#define VERTS 160

ZS_ARENA(arena, ZS_ARENA_BYTES(W, H, ROWS, TRIS, VERTS, ZS_VARYINGS_FLAT, 1));
static struct zs_renderer renderer;
static struct demo_frame frame;

static const struct {
    const char *name;
    const struct zs_depth *depth;
} mappings[] = { { "recip", &zs_depth_recip },   { "linear", &zs_depth_linear }, { "e3m13", &zs_depth_e3m13 },
                 { "e4m12", &zs_depth_e4m12 }, { "e5m11", &zs_depth_e5m11 } };

static int draw(const struct demo *d, uint32_t m)
{
    const struct zs_config config = { .width = W, .height = H, .strip_h = ROWS, .max_tris = TRIS, .max_verts = VERTS,
                                      .varyings = ZS_VARYINGS_FLAT, .buffers = 1, .subpixel_bits = 8, .depth_bits = 16,
                                      .depth = mappings[m].depth, .fast = d->fast };
    const struct zs_sink sink = { .submit = report_drop };
    int err = zs_init(&renderer, &config, arena, sizeof arena);
    d->pose(&frame, 0, W, H);
    const uint64_t start = hal_ticks();
    err = err ? err : zs_render(&renderer, &frame.scene, &frame.camera, &sink);
    const uint64_t ticks = hal_ticks() - start;
    hal_write(d->name);
    hal_write(",");
    hal_write(err ? zs_error_string(err) : mappings[m].name);
    report_field(ticks);
    report_field(zs_frame_stats(&renderer)->pixels_tested);
    report_field(zs_frame_stats(&renderer)->tris_setup);
    hal_write("\n");
    return err;
}

int main(void)
{
    static const struct demo *const scenes[] = { &demo_layers_mixed, &demo_corridor, &demo_mesh };
    int failed = 0;
    if (hal_init())
        hal_exit(1);
    for (uint32_t i = 0; i < sizeof scenes / sizeof scenes[0]; i++)
        for (uint32_t m = 0; m < sizeof mappings / sizeof mappings[0]; m++)
            failed |= draw(scenes[i], m);
    hal_exit(failed != 0);
}
