/* Stellaris LM3S6965EVB (Cortex-M3 at 50 MHz): clocks, text by UART0. Ticks and stack are hal/cortexm's, the panel's
 * bus is in bus.c, the wiring in pins.h.
 *
 * Ticks are the core's clock. The panel is an OLED: no backlight.
 *
 * What QEMU cannot tell: that the crystal is stable, that the PLL locks, that the UART is on and its rate right. Of the
 * clocks it has the divider alone. Steps and waits are the data sheet's, and those that the maker's library makes.
 *
 * SPDX-License-Identifier: MIT
 */
#include "hal.h"

#include "board.h"
#include "cortexm.h"
#include "parts.h"
#include "pins.h"
#include "regs.h"

#define BAUD 115200u
#define BAUD_64 ((CLOCK_HZ * 4u + BAUD / 2u) / BAUD) /* divider in 1/64: clock / (16 baud) */

#define CRYSTAL_SPINS 100000u /* of at least three cycles of at most 15.6 MHz: 19 ms */
#define SETTLE_SPINS 16u      /* cycles for a new divider or source to take effect */
#define LOCK_SPINS 32768u     /* the PLL takes half a millisecond */



/* ---- Clocks --------------------------------------------------------------------------------------------------- */

static void spin(uint32_t n)
{
    while (n--)
        __asm__ volatile("");
}

static int pll_locked(void)
{
    for (uint32_t i = 0; i < LOCK_SPINS; i++)
        if (SYS_RIS & PLL_LOCKED)
            return HAL_ERR_NONE;
    return HAL_ERR_TIMEOUT;
}

/* System Control, initialization: past the PLL, crystal and PLL on, divider, when it has locked through it. The PLL is
 * switched off before, in case another program has left it on: it tells that it has locked once. */
static int clocks_start(void)
{
    if ((SYS_DID0 & DID0_REVISION) == DID0_A2)
        SYS_LDOPCTL = LDO_2_75V; /* of this revision the PLL wants it */
    uint32_t rcc = (SYS_RCC | RCC_BYPASS | RCC_PWRDN) & ~(RCC_USESYSDIV | RCC_MOSCDIS);
    SYS_RCC = rcc;
    spin(CRYSTAL_SPINS);
    SYS_MISC = PLL_LOCKED;
    rcc = (rcc & ~(RCC_XTAL | RCC_OSCSRC | RCC_PWRDN)) | RCC_XTAL_8MHZ;
    SYS_RCC = rcc;
    spin(SETTLE_SPINS);
    rcc = (rcc & ~RCC_SYSDIV) | RCC_SYSDIV_4 | RCC_USESYSDIV;
    SYS_RCC = rcc;
    if (pll_locked())
        return HAL_ERR_TIMEOUT;
    SYS_RCC = rcc & ~RCC_BYPASS;
    spin(SETTLE_SPINS);
    SYS_RCGC1 |= BLOCK_UART0 | BLOCK_SSI0;
    SYS_RCGC2 |= GPIO_BLOCK(PIN_TEXT) | GPIO_BLOCK(PIN_SCK) | GPIO_BLOCK(PIN_CS) | GPIO_BLOCK(PIN_DC) |
                 GPIO_BLOCK(PIN_POWER) | GPIO_BLOCK(PIN_CARD);
    spin(SETTLE_SPINS); /* three cycles before a block is touched */
    return HAL_ERR_NONE;
}

/* ---- Text ----------------------------------------------------------------------------------------------------- */

static void text_start(void)
{
    UART0_IBRD = BAUD_64 / 64u;
    UART0_FBRD = BAUD_64 % 64u;
    UART0_LCRH = UART_8N1_FIFO;
    UART0_CTL = UART_ON;
    GPIO_AFSEL(PIN_TEXT) |= GPIO_BIT(PIN_TEXT);
    GPIO_DEN(PIN_TEXT) |= GPIO_BIT(PIN_TEXT);
}

/* 87 us a character, less the sixteen that the FIFO takes; there is nothing that could stop the UART. */
void hal_write(const char *text)
{
    for (; board_ready && *text; text++) {
        while (UART0_FR & UART_TXFF) {
        }
        UART0_DR = (uint8_t)*text;
    }
}

/* ---- The board ------------------------------------------------------------------------------------------------ */

const char board_fault[] = "lm3s6965: hard fault\n";

int board_start(void)
{
    const int err = clocks_start();
    if (err)
        return err;
    cortexm_ticks_start();
    text_start();
    lm3s6965_bus_start();
    return HAL_ERR_NONE;
}

void board_flush(void)
{
    while (board_ready && UART0_FR & UART_BUSY) {
    }
}

uint32_t hal_tick_hz(void)
{
    return CLOCK_HZ;
}

uint32_t hal_tick_instructions(void)
{
    return 0;
}

void hal_backlight(uint8_t level)
{
    (void)level;
}
