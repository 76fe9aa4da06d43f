/* Raspberry Pi Pico (RP2040 at 125 MHz): text by UART0, ticks of the 1 MHz timer, backlight by PWM. The panel's bus
 * is in bus.c, the wiring in pins.h.
 *
 * Ticks are the timer's microseconds: 64 bits of hardware, no interrupt, no wrap within half a million years.
 *
 * SPDX-License-Identifier: MIT
 */
#include "hal.h"

#include "board.h"
#include "parts.h"
#include "pins.h"
#include "regs.h"

#define BAUD 115200u
#define BAUD_64 ((CLOCK_HZ * 4u + BAUD / 2u) / BAUD) /* divider in 1/64 (4.2.3.2.1): clk_peri / (16 baud) */
#define TEXT_BYTES 256u

#define PWM_SLICE ((PIN_BACKLIGHT >> 1) & 7u) /* 4.5.2: pins share slices; even pins are channel A, odd ones B */
#define PWM_SHIFT ((PIN_BACKLIGHT & 1u) * 16u)
#define PWM_PERIOD 255u                       /* ticks of 1 us: 3.9 kHz */


static char text_out[TEXT_BYTES]; /* the DMA reads here while its channel is busy */

/* ---- Text ------------------------------------------------------------------------------------------------- */

static void text_start(void)
{
    UART0_IBRD = BAUD_64 / 64u;
    UART0_FBRD = BAUD_64 % 64u;
    UART0_LCR_H = UART_8N1_FIFO;
    UART0_DMACR = UART_TXDMAE;
    UART0_CR = UART_ON;
    GPIO_CTRL(PIN_TEXT) = FUNC_UART;
}

static void text_wait(void)
{
    while (DMA_CTRL(CHANNEL_TEXT) & DMA_BUSY) {
    }
}

/* The text before must have gone; 87 us a character. A line that is written whole goes by itself. */
void hal_write(const char *text)
{
    while (board_ready && *text) {
        uint32_t n = 0;
        text_wait();
        for (; n < TEXT_BYTES && *text; n++)
            text_out[n] = *text++;
        __asm__ volatile("" ::: "memory"); /* written before the DMA begins */
        DMA_READ_ADDR(CHANNEL_TEXT) = (uint32_t)(uintptr_t)text_out;
        DMA_WRITE_ADDR(CHANNEL_TEXT) = (uint32_t)(uintptr_t)&UART0_DR;
        DMA_TRANS_COUNT(CHANNEL_TEXT) = n;
        DMA_CTRL_TRIG(CHANNEL_TEXT) = DMA_EN | DMA_INCR_READ | DMA_CHAIN_TO(CHANNEL_TEXT) | DMA_TREQ(DREQ_UART0_TX);
    }
}

/* ---- The board ---------------------------------------------------------------------------------------------- */

const char board_fault[] = "pico: hard fault\n";

int board_start(void)
{
    rp2040_clocks_start();
    text_start();
    rp2040_bus_start();
    PWM_DIV(PWM_SLICE) = (CLOCK_HZ / 1000000u) << 4;
    PWM_TOP(PWM_SLICE) = PWM_PERIOD - 1u;
    hal_backlight(0);
    PWM_CSR(PWM_SLICE) = 1;
    GPIO_CTRL(PIN_BACKLIGHT) = FUNC_PWM;
    return HAL_ERR_NONE;
}

void board_flush(void)
{
    text_wait();
    while (UART0_FR & UART_BUSY) {
    }
}

uint64_t hal_ticks(void)
{
    uint32_t high, low;
    do { /* a carry between the two reads is seen and read again */
        high = TIMER_RAWH;
        low = TIMER_RAWL;
    } while (high != TIMER_RAWH);
    return (uint64_t)high << 32 | low;
}

uint32_t hal_tick_hz(void)
{
    return 1000000u;
}

uint32_t hal_tick_instructions(void)
{
    return 0;
}

void hal_backlight(uint8_t level)
{
    PWM_CC(PWM_SLICE) = (uint32_t)level << PWM_SHIFT; /* 255 is beyond TOP: always on */
}
