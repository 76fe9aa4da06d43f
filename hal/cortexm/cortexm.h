/* What HALs of Cortex-M boards share; each board.mk names the files that it takes.
 *
 *   systick.c   hal_ticks, from SysTick on the core's clock, extended to 64 bits by its interrupt
 *   semihost.c  hal_write, hal_exit and the hard fault, by semihosting: QEMU, or a debugger that offers it. Without
 *               either, the first call is a fault
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef CORTEXM_H
#define CORTEXM_H

/* Start SysTick; hal_ticks counts from here. Blocks for a few cycles. */
void cortexm_ticks_start(void);

#endif
