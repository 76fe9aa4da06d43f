/* What the hierarchical depth buffer takes: scenes under the depth buffer, alone and with the scene's accelerators,
 * without and with `tiles` among them, and under zs_method_hiz. One line of CSV a scene; instructions of the second
 * frame. Strips of 24 rows, one buffer, pools that take the scene in one pass. Every picture must be the same.
 *
 * SPDX-License-Identifier: MIT
 */
#include "hal.h"
#include "report.h"
#include "scenes.h"
#include "zs_method.h"
#include "zstrip.h"

#define W 320
#define H 240
#define ROWS 24
#define ARENA_BYTES (2u << 20)
#define FAST_MAX 16u

ZS_ARENA(arena, ARENA_BYTES);
static struct zs_renderer renderer;
static struct demo_frame frame;

static const struct way {
    const char *name;
    const struct zs_method *method;
    uint8_t fast; /* 1: with the scene's accelerators */
    uint8_t tiles; /* 1: `tiles` is one of them */
} ways[] = { { "alone", 0, 0, 0 },
             { "without tiles", 0, 1, 0 },
             { "with tiles", 0, 1, 1 },
             { "hiz alone", &zs_method_hiz, 0, 0 },
             { "hiz", &zs_method_hiz, 1, 0 },
             { "hiz corner", &zs_method_hiz_corner, 1, 0 },
             { "hiz vertex", &zs_method_hiz_vertex, 1, 0 } };
#define WAYS (sizeof ways / sizeof ways[0])

/* The accelerators of a scene for a way; the last one NULL. */
static const struct zs_fast *const *list_of(const struct demo *d, const struct way *way)
{
    static const struct zs_fast *list[FAST_MAX + 1u];
    uint32_t n = 0;
    for (const struct zs_fast *const *at = d->fast; way->fast && *at && n < FAST_MAX; at++)
        if (way->tiles || *at != &zs_fast_tiles)
            list[n++] = *at;
    list[n] = 0;
    return list;
}

static int draw(const struct demo *d, const struct way *way, uint64_t *instructions, uint64_t *picture)
{
    const struct zs_config c = { .width = W, .height = H, .strip_h = ROWS, .max_tris = 4000, .max_verts = 8000,
                                 .varyings = (uint8_t)d->varyings, .depth = d->depth, .fast = list_of(d, way),
                                 .method = way->method };
    const struct zs_sink hash = { .submit = report_hash, .ctx = picture }, drop = { .submit = report_drop };
    int err = zs_init(&renderer, &c, arena, sizeof arena);
    *picture = REPORT_HASH;
    err = err ? err : zs_render(&renderer, &frame.scene, &frame.camera, &hash);
    const uint64_t start = hal_ticks();
    err = err ? err : zs_render(&renderer, &frame.scene, &frame.camera, &drop);
    *instructions = (hal_ticks() - start) * hal_tick_instructions();
    return err;
}

int main(void)
{
    static const struct demo *const scenes[] = { &demo_layers_ftb, &demo_layers_mixed, &demo_layers_btf,
                                                 &demo_crowd_ftb,  &demo_corridor,     &demo_mesh,
                                                 &demo_city,       &demo_teapot };
    int failed = 0;
    if (hal_init())
        hal_exit(1);
    hal_write("scene");
    for (uint32_t m = 0; m < WAYS; m++) {
        hal_write(",");
        hal_write(ways[m].name);
    }
    hal_write("\n");
    for (uint32_t k = 0; k < sizeof scenes / sizeof scenes[0]; k++) {
        uint64_t first = 0, picture, instructions;
        scenes[k]->pose(&frame, scenes[k]->frames / 3u, W, H);
        hal_write(scenes[k]->name);
        for (uint32_t m = 0; m < WAYS; m++) {
            const int err = draw(scenes[k], &ways[m], &instructions, &picture);
            first = m ? first : picture;
            failed |= err || picture != first;
            report_field(instructions);
            if (err || picture != first)
                hal_write(err ? " FAILED" : " DIFFERS");
        }
        hal_write("\n");
    }
    hal_exit(failed);
}
