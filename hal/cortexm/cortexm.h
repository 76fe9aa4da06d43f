/* What HALs of Cortex-M boards share; each board.mk names the files that it takes.
 *
 *   systick.c   hal_ticks, from SysTick on the core's clock, extended to 64 bits by its interrupt; pauses
 *   semihost.c  semihosting and the hard fault: with hal/semihosting/semihosting.c, hal_write and hal_exit. For QEMU,
 *               or a debugger that offers it; without either, the first call is a fault
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef CORTEXM_H
#define CORTEXM_H

#include <stdint.h>

/* Start SysTick; hal_ticks counts from here. Blocks for a few cycles. */
void cortexm_ticks_start(void);

/* Let at least so many microseconds pass, by hal_tick_hz, whole MHz. Before cortexm_ticks_start: nothing. Blocks. */
void cortexm_pause_us(uint32_t us);

/* Sleep until an interrupt, unless the flag is 0. Interrupts are off from the question to the sleep, so that the one
 * that clears it cannot come between; one that is pending ends the sleep (Armv6-M manual, B1.5.18; Armv7-M, B1.5.19)
 * and runs as soon as they are on. */
static inline void cortexm_sleep_while(const volatile uint8_t *flag)
{
    __asm__ volatile("cpsid i" ::: "memory");
    if (*flag)
        __asm__ volatile("wfi" ::: "memory");
    __asm__ volatile("cpsie i" ::: "memory");
}

#endif
