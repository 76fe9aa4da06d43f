/* The HAL that does nothing, correctly: copy it to begin a port. Compiles anywhere.
 *
 * SPDX-License-Identifier: MIT
 */
#include "hal.h"

static uint8_t ready, busy; /* flags */

int hal_init(void)
{
    ready = 1;
    return HAL_OK;
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

uint32_t hal_tick_instructions(void)
{
    return 0;
}

int hal_strip_send(const struct hal_strip *strip)
{
    if (!strip || !strip->px || !strip->n_bytes)
        return HAL_ERR_ARG;
    if (!ready || busy)
        return HAL_ERR_STATE;
    busy = 1;
    return HAL_OK;
}

int hal_strip_wait(void)
{
    busy = 0;
    return HAL_OK;
}

void hal_stack_paint(void)
{
}

uint32_t hal_stack_used(void)
{
    return 0;
}
