/* The HAL that does nothing, correctly: copy it to begin a port (bus.c is the panel's side of it). Compiles anywhere.
 *
 * SPDX-License-Identifier: MIT
 */
#include "hal.h"
#include "null.h"

int hal_init(void)
{
    null_bus_start();
    return HAL_ERR_NONE;
}

void hal_exit(int status)
{
    (void)status;
    for (;;) {
    }
}

void hal_write(const char *text)
{
    (void)text;
}

uint64_t hal_ticks(void)
{
    return 0;
}

uint32_t hal_tick_hz(void)
{
    return 0;
}

uint32_t hal_tick_instructions(void)
{
    return 0;
}

void hal_backlight(uint8_t level)
{
    (void)level;
}

void hal_stack_paint(void)
{
}

uint32_t hal_stack_used(void)
{
    return 0;
}
