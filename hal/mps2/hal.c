/* QEMU's Cortex-M boards for benches: text by semihosting, SysTick as instruction counter, no panel (hal/null's bus).
 *
 * With -icount shift=0 an instruction takes one virtual nanosecond; SysTick on the 25 MHz system clock of the MPS2
 * boards counts 40 of them a tick; another board of QEMU's has its own number, or 0: it is no whole one.
 *
 * SPDX-License-Identifier: MIT
 */
#include "cortexm.h"
#include "hal.h"
#include "null.h"

#ifndef HAL_TICK_INSTRUCTIONS
#define HAL_TICK_INSTRUCTIONS 40u /* 1 GHz / 25 MHz */
#endif

static uint8_t ready;

int hal_init(void)
{
    if (!ready)
        cortexm_ticks_start();
    ready = 1;
    null_bus_start();
    return HAL_ERR_NONE;
}

uint32_t hal_tick_hz(void)
{
    return 0; /* under -icount time is instructions */
}

uint32_t hal_tick_instructions(void)
{
    return HAL_TICK_INSTRUCTIONS;
}

void hal_backlight(uint8_t level)
{
    (void)level;
}
