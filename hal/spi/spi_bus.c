/* A panel's bus over SPI: see spi_bus.h.
 *
 * SPDX-License-Identifier: MIT
 */
#include "spi_bus.h"

#include "hal.h"

static struct hal_bus the_bus;

static uint8_t ready;             /* spi_bus_start was called */
static uint8_t begun;             /* from data until wait */
static volatile uint8_t running;  /* from data until spi_bus_end */
static volatile int16_t outcome;  /* enum hal_err, of the transfer that has ended */

void spi_bus_end(int err)
{
    spi_wire_release();
    outcome = (int16_t)err;
    running = 0;
    if (the_bus.hooks.done)
        the_bus.hooks.done(the_bus.hooks.ctx);
}

int spi_bus_running(void)
{
    return running;
}

static int command(struct hal_bus *bus, uint8_t code, const uint8_t *args, uint32_t n)
{
    (void)bus;
    if (n && !args)
        return HAL_ERR_ARG;
    if (!ready || begun)
        return HAL_ERR_STATE;
    spi_wire_select();
    int err = spi_wire_send(&code, 1, 0);
    if (!err && n)
        err = spi_wire_send(args, n, 1);
    spi_wire_release();
    return err;
}

static int data(struct hal_bus *bus, const uint8_t *bytes, uint32_t n)
{
    (void)bus;
    if (!bytes || !n)
        return HAL_ERR_ARG;
    if (!ready || begun)
        return HAL_ERR_STATE;
    begun = running = 1;
    const int err = spi_wire_begin(bytes, n);
    if (err)
        begun = running = 0; /* nothing was taken over: no done, no wait */
    return err;
}

static int wait(struct hal_bus *bus)
{
    if (!begun)
        return HAL_ERR_NONE;
    while (running) {
        if (bus->hooks.idle)
            bus->hooks.idle(bus->hooks.ctx);
        else
            spi_wire_sleep(&running);
        spi_wire_overdue();
    }
    begun = 0;
    return outcome;
}

static int reset(struct hal_bus *bus)
{
    (void)bus;
    if (!ready || begun)
        return HAL_ERR_STATE;
    spi_wire_reset();
    return HAL_ERR_NONE;
}

static void delay(struct hal_bus *bus, uint32_t us)
{
    (void)bus;
    if (ready)
        spi_wire_pause_us(us);
}

static struct hal_bus the_bus = { .command = command, .data = data, .wait = wait, .reset = reset, .delay = delay };

struct hal_bus *hal_bus(void)
{
    return &the_bus;
}

void spi_bus_start(void)
{
    ready = 1;
}
