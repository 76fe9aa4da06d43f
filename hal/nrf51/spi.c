/* nRF51822: the panel's wire by SPI, polled: the part has no DMA for it.
 *
 * TXD and RXD have two places each: while a byte is on the wire the next one waits in TXD, so that SCK goes on while
 * the processor turns round. READY comes for each byte when it is in RXD, and for the byte after it only when that was
 * read (chapter "SPI Master"): RXD is read, and READY cleared before that, lest the next one be cleared too.
 *
 * Never run on silicon. QEMU has no SPI, but tells what is read and written: tests/boards/spi_log.mjs holds that
 * against the rules above and rebuilds the picture. That the part follows those rules, how pins and SCK look, errata:
 * not tested.
 *
 * SPDX-License-Identifier: MIT
 */
#include "hal.h"
#include "parts.h"
#include "pins.h"
#include "regs.h"
#include "spi_bus.h"

#if !PANEL_ON_UART

#define RESET_US 10000u
#define BIT(pin) (1u << (pin))
#define SPINS 2000u /* of some eight cycles: a millisecond for a byte, which takes eight microseconds at 1 MHz */

_Static_assert(SPI_INSTANCE == 0 || SPI_INSTANCE == 1, "SPI_INSTANCE: 0 or 1");
_Static_assert(SPI_MHZ == 8 || SPI_MHZ == 4 || SPI_MHZ == 2 || SPI_MHZ == 1, "SPI_MHZ: 8, 4, 2 or 1");

/* Off and on again: bytes that wait are gone, what came in is read away. */
static void restart(void)
{
    SPI_ENABLE = 0;
    SPI_ENABLE = SPI_ENABLED;
    (void)SPI_RXD;
    (void)SPI_RXD;
    SPI_READY = 0;
}

void nrf51_wire_start(void)
{
    const uint32_t high = BIT(PIN_CS) | BIT(PIN_DC) | BIT(PIN_RESET);
    GPIO_OUTSET = SPI_MODE == 3 ? high | BIT(PIN_SCK) : high; /* before they are driven: no pulse on any of them */
    GPIO_PIN_CNF(PIN_CS) = GPIO_OUTPUT;
    GPIO_PIN_CNF(PIN_DC) = GPIO_OUTPUT;
    GPIO_PIN_CNF(PIN_RESET) = GPIO_OUTPUT;
    GPIO_PIN_CNF(PIN_SCK) = GPIO_OUTPUT | GPIO_HIGH_DRIVE;
    GPIO_PIN_CNF(PIN_MOSI) = GPIO_OUTPUT | GPIO_HIGH_DRIVE;
    SPI_PSELSCK = PIN_SCK;
    SPI_PSELMOSI = PIN_MOSI;
    SPI_PSELMISO = NOT_CONNECTED;
    SPI_FREQUENCY = (uint32_t)SPI_MHZ << 28;
    SPI_CONFIG = SPI_MODE == 3 ? SPI_CPOL | SPI_CPHA : 0u;
    restart();
}

void spi_wire_select(void)
{
    GPIO_OUTCLR = BIT(PIN_CS);
}

void spi_wire_release(void)
{
    GPIO_OUTSET = BIT(PIN_CS);
}

static int wait_for_ready(void)
{
    for (uint32_t i = 0; i < SPINS; i++)
        if (SPI_READY)
            return HAL_ERR_NONE;
    restart();
    return HAL_ERR_TIMEOUT;
}

int spi_wire_send(const uint8_t *bytes, uint32_t n, int is_data)
{
    if (is_data)
        GPIO_OUTSET = BIT(PIN_DC);
    else
        GPIO_OUTCLR = BIT(PIN_DC);
    SPI_TXD = bytes[0];
    for (uint32_t i = 1; i <= n; i++) {
        if (i < n)
            SPI_TXD = bytes[i];
        if (wait_for_ready())
            return HAL_ERR_TIMEOUT;
        SPI_READY = 0;
        (void)SPI_RXD;
    }
    return HAL_ERR_NONE;
}

void spi_wire_reset(void)
{
    GPIO_OUTCLR = BIT(PIN_RESET);
    nrf51_pause_us(RESET_US);
    GPIO_OUTSET = BIT(PIN_RESET);
}

#endif
