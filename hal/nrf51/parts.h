/* What the files of this HAL know of each other.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef NRF51_PARTS_H
#define NRF51_PARTS_H

#include <stdint.h>

/* ---- hal.c ------------------------------------------------------------------------------------------------- */

/* Sleep for at least so many microseconds. Interrupts are on afterwards. */
void nrf51_pause_us(uint32_t us);

/* ---- uart.c ------------------------------------------------------------------------------------------------ */

void nrf51_uart_start(void);

/* Send a word of a stream that `zsim panel --decode` reads, low byte first. HAL_ERR_NONE; HAL_ERR_TIMEOUT. */
int nrf51_uart_word(uint32_t word);

/* ---- The panel's wire (spi_bus.h): spi.c, or words.c with PANEL_ON_UART------------------------------------------- */

void nrf51_wire_start(void);

/* ---- bus.c ------------------------------------------------------------------------------------------------- */

/* The wire is up; from here on the bus answers. */
void nrf51_bus_start(void);

#endif
