/* truth SCENE FRAMES STEP OUT: frames 0, STEP, 2 STEP ... of a demo scene at 240x240 as the host draws them, in strips
 * of another height, from other pools, to OUT_0.bin, OUT_1.bin ...: RGB565, most significant byte first.
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scenes.h"

#define SIDE 240
#define ROWS 17
#define POOL 20000

static int save(void *ctx, const struct zs_strip *s)
{
    return fwrite(s->px, 1, s->n_bytes, ctx) != s->n_bytes;
}

static int draw(const struct demo *d, uint32_t t, const char *stem, unsigned number)
{
    static struct zs_renderer renderer;
    static struct demo_frame frame;
    ZS_ARENA(arena, ZS_ARENA_BYTES(SIDE, SIDE, ROWS, POOL, POOL, ZS_ATTRS_MAX, 1));
    const struct zs_config config = { SIDE, SIDE, ROWS, POOL, POOL, ZS_ATTRS_MAX, 1, 8, 16, 0, d->depth };
    char path[4096];
    (void)snprintf(path, sizeof path, "%s_%u.bin", stem, number);
    FILE *out = fopen(path, "wb");
    const struct zs_sink sink = { save, 0, out };
    int err = out ? zs_init(&renderer, &config, arena, sizeof arena) : 1;
    d->pose(&frame, t, SIDE, SIDE);
    err = err ? err : zs_render(&renderer, &frame.scene, &frame.camera, &sink);
    if (out)
        err |= fclose(out);
    return err;
}

int main(int argc, char **argv)
{
    if (argc != 5)
        return 2;
    const uint32_t frames = (uint32_t)atoi(argv[2]), step = (uint32_t)atoi(argv[3]);
    for (uint32_t i = 0; i < n_demos; i++)
        for (uint32_t k = 0; !strcmp(demos[i]->name, argv[1]) && k < frames; k++)
            if (draw(demos[i], k * step, argv[4], k))
                return 1;
    return 0;
}
