/* What zs_damage_track saves: scenes drawn whole, then again with nothing changed, then with their last instance moved,
 * by strips and by columns as well (zs_damage_columns). One line of CSV a scene; instructions. Strips of 16 rows, one
 * buffer, pools that take the scene in one pass.
 *
 * SPDX-License-Identifier: MIT
 */
#include "hal.h"
#include "report.h"
#include "scenes.h"
#include "zs_damage.h"
#include "zstrip.h"

#define ROWS 16
#define STILL_MAX 50u /* a still frame may take a full one's instructions divided by this */
#define ARENA_BYTES (3u << 20)

ZS_ARENA(arena, ARENA_BYTES);
static uint32_t memory[ZS_DAMAGE_WORDS(DEMO_INSTANCES_MAX, 240, ROWS)];
static struct zs_renderer renderer;
static struct demo_frame frame;

static int count(void *ctx, const struct zs_strip *strip)
{
    *(uint32_t *)ctx += (uint32_t)strip->dirty_w * strip->h;
    return 0;
}

/* Draw; add instructions, strips that were drawn and pixels that were sent to the line, unless it is quiet. */
static int draw(uint64_t *instructions, uint32_t *sent, int quiet)
{
    const struct zs_sink sink = { .submit = count, .ctx = sent };
    *sent = 0;
    const uint64_t start = hal_ticks();
    const int err = zs_render(&renderer, &frame.scene, &frame.camera, &sink);
    const struct zs_stats *stats = zs_frame_stats(&renderer);
    *instructions = (hal_ticks() - start) * hal_tick_instructions();
    if (!quiet) {
        report_field(*instructions);
        report_field(stats->strips - stats->strips_skipped);
        report_field(*sent);
    }
    return err;
}

static void move(int32_t by)
{
    frame.instance[frame.scene.n_instances - 1u].pose.pos[0] += by;
}

static int wrong(const char *what)
{
    hal_write("# FAILED, the line above: ");
    hal_write(what);
    hal_write("\n");
    return 1;
}

static int measure(const struct demo *d)
{
    struct zs_config c = { .width = d->width, .height = d->height, .strip_h = ROWS, .varyings = (uint8_t)d->varyings,
                           .buffers = 1, .subpixel_bits = 8, .depth_bits = 16, .depth = d->depth, .fast = d->fast };
    uint64_t full, first, still, moved, part;
    uint32_t all, sent;
    d->pose(&frame, 0, d->width, d->height);
    report_pools(&c, &frame.scene);
    hal_write(d->name);
    int err = zs_init(&renderer, &c, arena, sizeof arena);
    err = err ? err : draw(&full, &all, 0);
    err = err ? err : zs_damage_track(&renderer, memory, DEMO_INSTANCES_MAX);
    err = err ? err : draw(&first, &sent, 0);
    err = err ? err : draw(&still, &sent, 0);
    move(200);
    err = err ? err : draw(&moved, &sent, 0);
    err = err ? err : zs_damage_columns(&renderer, 1);
    move(1); /* its columns become known */
    err = err ? err : draw(&part, &sent, 1);
    move(-201);
    err = err ? err : draw(&part, &sent, 0);
    if (err) {
        hal_write(",# ");
        hal_write(zs_error_string(err));
    }
    hal_write("\n");
    if (err || still * STILL_MAX > full)
        return wrong("a still frame takes more than a fiftieth of a full one");
    if (part * 20u > moved * 21u)
        return wrong("by columns, one moved thing takes 5 % more than by strips");
    if (sent * 20u < all && part * 5u > full * 2u)
        return wrong("one small thing that moved takes more than two fifths of a full frame");
    return 0;
}

int main(void)
{
    static const struct demo *const scenes[] = { &demo_teapot, &demo_cubes, &demo_city, &demo_globe, &demo_mesh,
                                                 &demo_layers_ftb };
    int failed = 0;
    if (hal_init())
        hal_exit(1);
    hal_write(
        "scene,full,strips,pixels,first,strips,pixels,still,strips,pixels,moved,strips,pixels,columns,strips,pixels\n");
    for (uint32_t i = 0; i < sizeof scenes / sizeof scenes[0]; i++)
        failed += measure(scenes[i]);
    hal_exit(failed != 0);
}
