/* A panel on a bus: strips through its driver.
 *
 * SPDX-License-Identifier: MIT
 */
#include "hal.h"
#include "panel.h"
#include "spinning_cube.h"
#include "stub.h"

static struct panel panel;

static int send(void *ctx, const struct zs_strip *s)
{
    const struct panel_rect rect = { s->x, s->y, s->w, s->h };
    return panel_send(ctx, &rect, s->px, 0);
}

static int wait(void *ctx)
{
    return panel_wait(ctx);
}

static int run(struct hal_bus *bus, const char *file)
{
    static const struct panel_config config = { .type = &panel_st7789, .width = 240, .height = 240 };
    const struct zs_sink sink = { .submit = send, .wait = wait, .ctx = &panel };
    return panel_init(&panel, &config, bus, NULL, 0) || cube_begin(240, 240) || cube_draw(0, &sink) || stub_write(file);
}
