/* A panel on a bus: strips through its driver.
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdio.h>

#include "hal.h"
#include "panel.h"
#include "spinning_cube.h"
#include "stub.h"

static struct panel panel;
static int stub_deselected;     /* level of CS */
static void (*hardware)(void);  /* what happens while a program waits */
static uint32_t n_idle, n_done;

static void idles(void *ctx)
{
    (void)ctx;
    n_idle++;
    if (hardware)
        hardware();
}

static void ends(void *ctx)
{
    (void)ctx;
    n_done++;
}

/* What hal.h says of a bus while data is out, and of its hooks. Return 0: it does so. */
static int keeps_hal_h(struct hal_bus *bus)
{
    static const uint8_t px[4];
    bus->hooks.idle = idles;
    bus->hooks.done = ends;
    int good = bus->wait(bus) == HAL_ERR_NONE && n_done == 0; /* nothing is out */
    good &= bus->data(bus, px, 0) == HAL_ERR_ARG && bus->data(bus, NULL, 4) == HAL_ERR_ARG;
    for (uint32_t k = 1; k <= 2; k++) {
        good &= bus->data(bus, px, sizeof px) == HAL_ERR_NONE && !stub_deselected && n_done == k - 1;
        good &= bus->data(bus, px, sizeof px) == HAL_ERR_STATE && bus->command(bus, 0, NULL, 0) == HAL_ERR_STATE;
        good &= bus->reset(bus) == HAL_ERR_STATE;
        good &= bus->wait(bus) == HAL_ERR_NONE && stub_deselected && n_done == k && n_idle >= k;
        good &= bus->wait(bus) == HAL_ERR_NONE && n_done == k; /* nothing is out any more */
    }
    if (!good)
        fprintf(stderr, "the bus does not do what hal.h says\n");
    return !good;
}

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
