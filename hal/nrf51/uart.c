/* nRF51822: text, and the words of a panel's stream, by the UART; polled, without flow control.
 *
 * QEMU's UART knows neither pins nor baud: that they are right is not tested.
 *
 * SPDX-License-Identifier: MIT
 */
#include "hal.h"
#include "parts.h"
#include "pins.h"
#include "regs.h"

#define SPINS 20000u /* of some eight cycles: ten milliseconds for a byte, which takes one at 9600 baud */
#define TEXT 0x1000u /* the word of a character */

static uint8_t ready;

void nrf51_uart_start(void)
{
    GPIO_OUTSET = 1u << PIN_TEXT; /* idle is high */
    GPIO_PIN_CNF(PIN_TEXT) = GPIO_OUTPUT;
    UART_PSELTXD = PIN_TEXT; /* pins and baud before ENABLE; the other pins are not connected after reset */
    UART_BAUDRATE = UART_BAUD(TEXT_BAUD);
    UART_ENABLE = UART_ENABLED;
    UART_STARTTX = 1;
    ready = 1;
}

static int send_byte(uint32_t byte)
{
    UART_TXDRDY = 0;
    UART_TXD = byte;
    for (uint32_t i = 0; i < SPINS; i++)
        if (UART_TXDRDY)
            return HAL_ERR_NONE;
    return HAL_ERR_TIMEOUT;
}

int nrf51_uart_word(uint32_t word)
{
    const int err = send_byte(word & 0xffu);
    return err ? err : send_byte(word >> 8);
}

void hal_write(const char *text)
{
    if (!ready)
        return;
    for (; *text; text++) /* a character that does not go is lost */
        (void)(PANEL_ON_UART ? nrf51_uart_word(TEXT | (uint8_t)*text) : send_byte((uint8_t)*text));
}
