/* What the files of this HAL know of each other.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef RP2040_PARTS_H
#define RP2040_PARTS_H

#include <stdint.h>

#include "regs.h"

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

/* The divider of the core that this runs on, as an interrupt finds it: between a division's operands and its result
 * perhaps. What is called between save and restore may divide; it must not draw, as a triangle may be in the
 * interpolators (zstrip/arch/lanes.h). Datasheet, 2.3.1.5: results are written last, quotient after remainder. */
struct rp2040_divider {
    uint32_t dividend, divisor, remainder, quotient;
};
static inline struct rp2040_divider rp2040_divider_save(void)
{
    while (!(SIO_DIV_CSR & SIO_DIV_READY)) {
    }
    const uint32_t dividend = SIO_DIV_UDIVIDEND, divisor = SIO_DIV_UDIVISOR;
    const uint32_t remainder = SIO_DIV_REMAINDER, quotient = SIO_DIV_QUOTIENT;
    return (struct rp2040_divider){ dividend, divisor, remainder, quotient };
}
static inline void rp2040_divider_restore(struct rp2040_divider d)
{
    SIO_DIV_UDIVIDEND = d.dividend;
    SIO_DIV_UDIVISOR = d.divisor;
    SIO_DIV_REMAINDER = d.remainder;
    SIO_DIV_QUOTIENT = d.quotient;
}

#endif
