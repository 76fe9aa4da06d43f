/* nRF51822: the panel's bus. Nothing leaves by itself: data sends, and wait has nothing to wait for. The wire is in
 * spi.c or words.c.
 *
 * SPDX-License-Identifier: MIT
 */
#include "hal.h"
#include "parts.h"

#define RESET_US 10000u /* controllers want 10 us; modules may have a capacitor on the line */

static uint8_t ready; /* nrf51_bus_start was called */
static uint8_t begun; /* from data until wait */

static int command(struct hal_bus *bus, uint8_t code, const uint8_t *args, uint32_t n)
{
    (void)bus;
    if (n && !args)
        return HAL_ERR_ARG;
    if (!ready || begun)
        return HAL_ERR_STATE;
    nrf51_wire_select();
    int err = nrf51_wire_send(&code, 1, 0);
    if (!err && n)
        err = nrf51_wire_send(args, n, 1);
    nrf51_wire_release();
    return err;
}

static int data(struct hal_bus *bus, const uint8_t *bytes, uint32_t n)
{
    if (!bytes || !n)
        return HAL_ERR_ARG;
    if (!ready || begun)
        return HAL_ERR_STATE;
    nrf51_wire_select();
    const int err = nrf51_wire_send(bytes, n, 1);
    nrf51_wire_release();
    if (err)
        return err; /* nothing was taken over: no done, no wait */
    begun = 1;
    if (bus->hooks.done)
        bus->hooks.done(bus->hooks.ctx);
    return HAL_OK;
}

static int wait(struct hal_bus *bus)
{
    (void)bus;
    begun = 0;
    return HAL_OK;
}

static void delay(struct hal_bus *bus, uint32_t us)
{
    (void)bus;
    if (ready)
        nrf51_pause_us(us);
}

static int reset(struct hal_bus *bus)
{
    (void)bus;
    if (!ready || begun)
        return HAL_ERR_STATE;
    nrf51_wire_reset(1);
    nrf51_pause_us(RESET_US);
    nrf51_wire_reset(0);
    return HAL_OK;
}

static struct hal_bus the_bus = { command, data, wait, reset, delay, { 0 } };

struct hal_bus *hal_bus(void)
{
    return &the_bus;
}

void nrf51_bus_start(void)
{
    nrf51_wire_start();
    ready = 1;
}
