/* What the files of this HAL know of each other.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef LM3S6965_PARTS_H
#define LM3S6965_PARTS_H

#include <stdint.h>

#define CLOCK_HZ 50000000u /* core, SSI0, UART0 and SysTick */

/* Pins, SSI0 and interrupt of the panel's bus. After the clocks of their blocks. */
void lm3s6965_bus_start(void);

#endif
