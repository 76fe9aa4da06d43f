/* STM32F405 at 168 MHz: text by USART6, ticks of the core's clock by SysTick, backlight by PWM of TIM3. The panel's bus
 * is in bus.c, the wiring in pins.h.
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
#define SPINS 100000u /* a few ms, for a character of 87 us */

#define PWM_HZ 1000000u
#define PWM_PERIOD 255u /* ticks of 1 us: 3.9 kHz */
#define PWM_CHANNEL (PIN_BACKLIGHT >= PC6 ? (uint32_t)PIN_BACKLIGHT - PC6 : (uint32_t)PIN_BACKLIGHT - PB0 + 2u)

_Static_assert(PIN_BACKLIGHT == PB0 || PIN_BACKLIGHT == PB1 || (PIN_BACKLIGHT >= PC7 && PIN_BACKLIGHT <= PC9),
               "PIN_BACKLIGHT: PB0, PB1, PC7, PC8 or PC9");



/* ---- Text ------------------------------------------------------------------------------------------------- */

static void text_start(void)
{
    USART6_BRR = (stm32f4_clocks.apb2 + BAUD / 2u) / BAUD; /* 30.3.4: with 16 samples a bit, clock / baud */
    USART6_CR1 = USART_ON;
    stm32f4_pin_alternate(PIN_TEXT, AF_USART6);
}

static void text_wait(uint32_t flag)
{
    for (uint32_t i = 0; i < SPINS && !(USART6_SR & flag); i++) {
    }
}

/* 87 us a character. */
void hal_write(const char *text)
{
    for (; board_ready && *text; text++) {
        text_wait(USART_ROOM);
        USART6_DR = (uint8_t)*text;
    }
}

/* ---- The board ---------------------------------------------------------------------------------------------- */

static void light_start(void)
{
    TIM3_PSC = stm32f4_clocks.timers / PWM_HZ - 1u;
    TIM3_ARR = PWM_PERIOD - 1u;
    TIM3_CCMR(PWM_CHANNEL) = TIM_PWM(PWM_CHANNEL);
    hal_backlight(0);
    TIM3_EGR = TIM_UPDATE; /* 18.4.11: loads the prescaler */
    TIM3_CCER = TIM_OUTPUT(PWM_CHANNEL);
    TIM3_CR1 = TIM_PRELOAD | TIM_ON;
    stm32f4_pin_alternate(PIN_BACKLIGHT, AF_TIM3);
}

const char board_fault[] = "stm32f405: hard fault\n";

int board_start(void)
{
    stm32f4_clocks_start();
    cortexm_ticks_start();
    text_start();
    light_start();
    stm32f4_bus_start();
    return HAL_ERR_NONE;
}

void board_flush(void)
{
    text_wait(USART_SENT);
}

uint32_t hal_tick_hz(void)
{
    return stm32f4_clocks.core;
}

uint32_t hal_tick_instructions(void)
{
    return 0;
}

void hal_backlight(uint8_t level)
{
    TIM3_CCR(PWM_CHANNEL) = level; /* 255 is beyond ARR: always on */
}
