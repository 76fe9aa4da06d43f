/* What the files of this HAL know of each other.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef STM32F4_PARTS_H
#define STM32F4_PARTS_H

#include <stdint.h>

/* How fast what runs: see clocks.c. Hz. */
struct stm32f4_clocks {
    uint32_t core;   /* and SysTick */
    uint32_t apb2;   /* SPI1, USART6 */
    uint32_t timers; /* TIM3, TIM5 */
};
extern struct stm32f4_clocks stm32f4_clocks;

/* 168 MHz if the PLL locks, clocks of what is used on. */
void stm32f4_clocks_start(void);

/* Put a pin (pins.h) to an alternate function, 0 .. 15, with edges for 42 MHz. */
void stm32f4_pin_alternate(uint32_t pin, uint32_t function);

/* Make a pin an output that is high; it does not pulse. */
void stm32f4_pin_output(uint32_t pin);

void stm32f4_pin_set(uint32_t pin, int high);

/* Pins, SPI1, DMA and deadline of the panel's bus. */
void stm32f4_bus_start(void);

#endif
