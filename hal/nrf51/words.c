/* nRF51822 without SPI: what would go over the panel's wire leaves by the UART, as the words that `zsim panel --decode`
 * reads: a byte with its D/C level, or a mark.
 *
 * SPDX-License-Identifier: MIT
 */
#include "hal.h"
#include "parts.h"
#include "pins.h"
#include "spi_bus.h"

#if PANEL_ON_UART

#define RESET_US 10000u
#define DATA 0x100u     /* D/C is high */
#define RESET 0x200u    /* RESET was pulled */
#define DESELECT 0x800u /* CS went high */

void nrf51_wire_start(void)
{
}

void spi_wire_select(void)
{
}

void spi_wire_release(void)
{
    (void)nrf51_uart_word(DESELECT);
}

int spi_wire_send(const uint8_t *bytes, uint32_t n, int is_data)
{
    int err = HAL_ERR_NONE;
    for (uint32_t i = 0; !err && i < n; i++)
        err = nrf51_uart_word(is_data ? DATA | bytes[i] : bytes[i]);
    return err;
}

void spi_wire_reset(void)
{
    (void)nrf51_uart_word(RESET);
    nrf51_pause_us(RESET_US);
}

#endif
