/* A bus that takes everything and sends it nowhere: here go D/C, the SPI and its DMA. Boards without a panel link it.
 *
 * SPDX-License-Identifier: MIT
 */
#include "hal.h"
#include "null.h"

#include <stddef.h>

static uint8_t ready, busy; /* flags */

static int command(struct hal_bus *bus, uint8_t code, const uint8_t *args, uint32_t n)
{
    (void)bus;
    (void)code;
    if (n && !args)
        return HAL_ERR_ARG;
    return !ready || busy ? HAL_ERR_STATE : HAL_ERR_NONE;
}

static int data(struct hal_bus *bus, const uint8_t *bytes, uint32_t n)
{
    (void)bus;
    if (!bytes || !n)
        return HAL_ERR_ARG;
    if (!ready || busy)
        return HAL_ERR_STATE;
    busy = 1; /* begin the transfer; where it ends, busy = 0 and hooks.done */
    return HAL_ERR_NONE;
}

static int wait(struct hal_bus *bus)
{
    if (busy && bus->hooks.done)
        bus->hooks.done(bus->hooks.ctx);
    busy = 0; /* while the transfer runs: hooks.idle, or WFI */
    return HAL_ERR_NONE;
}

static int reset(struct hal_bus *bus)
{
    (void)bus;
    return busy ? HAL_ERR_STATE : HAL_ERR_NONE;
}

static void delay(struct hal_bus *bus, uint32_t us)
{
    (void)bus;
    (void)us;
}

static struct hal_bus the_bus = { .command = command, .data = data, .wait = wait, .reset = reset, .delay = delay };

struct hal_bus *hal_bus(void)
{
    return &the_bus;
}

void null_bus_start(void)
{
    ready = 1;
}
