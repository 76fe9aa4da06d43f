/* STM32F405: from the 16 MHz RC oscillator (HSI), on which a reset starts it, to 168 MHz; clocks of the blocks that are
 * used; pins. Sections of RM0090 beside each step.
 *
 * The RC oscillator, not the crystal: that differs from board to board (8, 12, 25 MHz), and a wrong guess runs the part
 * beyond its limits. It is within 1 % at room temperature, which a panel and a UART take; ticks are as exact.
 * Where the PLL does not lock, or the switch to it is not confirmed, all stays at 16 MHz, and hal_tick_hz says so.
 *
 * What an emulator cannot tell: that the PLL locks; wait states, caches and what they cost; the switch itself. QEMU's
 * netduinoplus2 has none of these registers (they read 0, so that the PLL never locks); its test checks what is written
 * before the switch. Its SysTick runs at 168 MHz all the same, so that a second of hal_tick_hz takes 16/168 of one
 * there.
 *
 * SPDX-License-Identifier: MIT
 */
#include "parts.h"
#include "pins.h"
#include "regs.h"

#define HSI_HZ 16000000u
#define PLL_HZ 168000000u

/* 7.3.2: 16 MHz / 8 = 2 MHz into the VCO, which the manual recommends; * 168 = 336 MHz; / 2 = 168 MHz, / 7 = 48 MHz */
#define PLL (RCC_PLL_M(8u) | RCC_PLL_N(168u) | RCC_PLL_P(2u) | RCC_PLL_Q(7u))
_Static_assert(HSI_HZ / 8u * 168u / 2u == PLL_HZ, "the PLL's factors");

#define SPINS 20000u /* some 10 ms at 16 MHz; the PLL locks within 0.3 ms (datasheet, PLL characteristics) */

struct stm32f4_clocks stm32f4_clocks = { HSI_HZ, HSI_HZ, HSI_HZ };

static int becomes(volatile const uint32_t *reg, uint32_t mask, uint32_t value)
{
    for (uint32_t i = 0; i < SPINS; i++)
        if ((*reg & mask) == value)
            return 1;
    return 0;
}

/* 7.3.2: the PLL is set up while it is off. A boot loader may have left it on, and the core on it. */
static void back_to_hsi(void)
{
    RCC_CR |= RCC_HSI_ON;
    (void)becomes(&RCC_CR, RCC_HSI_READY, RCC_HSI_READY);
    RCC_CFGR = 0;
    (void)becomes(&RCC_CFGR, RCC_STATUS_MASK, 0);
    RCC_CR &= ~RCC_PLL_ON;
    (void)becomes(&RCC_CR, RCC_PLL_READY, 0);
}

/* 3.5.1: five wait states above 150 MHz at 2.7 V and more, set before the clock and read back. The regulator's scale is
 * that for 168 MHz from reset on (5.4.1). 7.3.3: APB1 to 42 MHz and APB2 to 84 MHz at most, set before, too. */
static int speed_up(void)
{
    back_to_hsi();
    RCC_PLLCFGR = (RCC_PLLCFGR & RCC_PLL_RESERVED) | PLL; /* source: HSI */
    RCC_CR |= RCC_PLL_ON;
    FLASH_ACR = FLASH_WAIT_STATES(5u) | FLASH_PREFETCH | FLASH_CODE_CACHE | FLASH_DATA_CACHE;
    RCC_CFGR = RCC_APB1_BY_4 | RCC_APB2_BY_2;
    if (!becomes(&FLASH_ACR, FLASH_WAIT_MASK, FLASH_WAIT_STATES(5u)) ||
        !becomes(&RCC_CR, RCC_PLL_READY, RCC_PLL_READY))
        return 0;
    RCC_CFGR = RCC_APB1_BY_4 | RCC_APB2_BY_2 | RCC_ON_PLL;
    return becomes(&RCC_CFGR, RCC_STATUS_MASK, RCC_STATUS_PLL);
}

void stm32f4_clocks_start(void)
{
    if (speed_up()) /* 7.2: timers of a divided APB1 run at twice its clock */
        stm32f4_clocks = (struct stm32f4_clocks){ PLL_HZ, PLL_HZ / 2u, PLL_HZ / 2u };
    else
        RCC_CFGR = 0;
    RCC_AHB1ENR |= RCC_GPIOS | RCC_DMA2;
    RCC_APB1ENR |= RCC_TIM3 | RCC_TIM5;
    RCC_APB2ENR |= RCC_USART6 | RCC_SPI1;
    (void)RCC_APB2ENR; /* errata ES0182, "Delay after an RCC peripheral clock enabling": read back before use */
}

/* ---- Pins ------------------------------------------------------------------------------------------------- */

static void set_field(volatile uint32_t *reg, uint32_t shift, uint32_t mask, uint32_t value)
{
    *reg = (*reg & ~(mask << shift)) | value << shift;
}

/* Quick edges also where few come: the panel's select falls some 50 ns before its first clock. */
static void set_mode(uint32_t pin, uint32_t mode)
{
    set_field(&GPIO_OSPEEDR(pin / 16u), pin % 16u * 2u, 3u, GPIO_QUICK);
    set_field(&GPIO_MODER(pin / 16u), pin % 16u * 2u, 3u, mode);
}

void stm32f4_pin_alternate(uint32_t pin, uint32_t function)
{
    set_field(&GPIO_AFR(pin / 16u, pin % 16u / 8u), pin % 8u * 4u, 15u, function);
    set_mode(pin, GPIO_ALTERNATE);
}

void stm32f4_pin_output(uint32_t pin)
{
    stm32f4_pin_set(pin, 1);
    set_mode(pin, GPIO_OUTPUT);
}

void stm32f4_pin_set(uint32_t pin, int high)
{
    GPIO_BSRR(pin / 16u) = 1u << (pin % 16u + (high ? 0u : 16u));
}
