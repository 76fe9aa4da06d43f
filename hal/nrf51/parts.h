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

/* Send a word of a stream that `zsim panel --decode` reads, low byte first. HAL_OK; HAL_ERR_TIMEOUT. */
int nrf51_uart_word(uint32_t word);

/* ---- The panel's wire: spi.c, or words.c with PANEL_ON_UART ------------------------------------------------- */

void nrf51_wire_start(void);
void nrf51_wire_select(void);
/* Send n bytes and wait until they are out. HAL_OK; HAL_ERR_TIMEOUT: what was left in the peripheral is gone. */
int nrf51_wire_send(const uint8_t *bytes, uint32_t n, int is_data);
void nrf51_wire_release(void);
/* RESET low, and high again. */
void nrf51_wire_reset(int pulled);

/* ---- bus.c ------------------------------------------------------------------------------------------------- */

/* The wire is up; from here on the bus answers. */
void nrf51_bus_start(void);

#endif
