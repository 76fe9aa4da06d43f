/* The picture itself, through a sink of this file.
 *
 * SPDX-License-Identifier: MIT
 */
#include "spinning_cube.h"
#include "stub.h"

static int send(void *ctx, const struct zs_strip *s)
{
    (void)ctx;
    stub_put(s->x, s->y, s->w, s->h, s->px, 0);
    return 0;
}

int main(int argc, char **argv)
{
    const struct zs_sink sink = { .submit = send };
    return argc < 2 || cube_begin(240, 240) || cube_draw(0, &sink) || stub_write(argv[1]);
}
