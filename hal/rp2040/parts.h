/* What the files of this HAL know of each other.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef RP2040_PARTS_H
#define RP2040_PARTS_H

#include <stdint.h>

#define CLOCK_HZ 125000000u /* clk_sys and clk_peri */

#define CHANNEL_PANEL 0u /* DMA channels */
#define CHANNEL_TEXT 1u

/* Clocks from the crystal, timer running, blocks that are used out of reset. */
void rp2040_clocks_start(void);

/* Reset blocks (RESET_*, or-ed) and take them out of reset again. */
void rp2040_restart(uint32_t blocks);

/* Pins, SPI0 and DMA of the panel's bus. */
void rp2040_bus_start(void);

/* Microseconds of the 1 MHz timer, modulo 2^32. */
uint32_t rp2040_us(void);

/* Sleep for at least so many microseconds. Interrupts are on afterwards. */
void rp2040_pause_us(uint32_t us);

#endif
