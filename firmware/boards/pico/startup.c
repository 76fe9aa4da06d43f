/* Raspberry Pi Pico: vectors and the way to main.
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdint.h>

#include "../startup.h"

void NMI_Handler(void) WEAK;
void HardFault_Handler(void) WEAK;
void SVC_Handler(void) WEAK;
void PendSV_Handler(void) WEAK;
void SysTick_Handler(void) WEAK;
void TIMER_0_Handler(void) WEAK;
void TIMER_1_Handler(void) WEAK;
void DMA_0_Handler(void) WEAK;
void SIO_0_Handler(void) WEAK;

typedef void (*vector)(void);

/* Exceptions 0 to 15, then interrupts 0 to 25 (RP2040 datasheet, 2.3.2). 256-byte aligned by pico.ld. */
__attribute__((section(".vectors"), used)) static const vector vectors[16 + 26] = {
    (vector)(uintptr_t)__stack_top, Reset_Handler, NMI_Handler, HardFault_Handler,
    0, 0, 0, 0, 0, 0, 0, SVC_Handler, 0, 0, PendSV_Handler, SysTick_Handler,
    TIMER_0_Handler, TIMER_1_Handler, Default_Handler, Default_Handler, Default_Handler, Default_Handler,
    Default_Handler, Default_Handler, Default_Handler, Default_Handler, Default_Handler, DMA_0_Handler,
    Default_Handler, Default_Handler, Default_Handler, SIO_0_Handler, Default_Handler, Default_Handler,
    Default_Handler, Default_Handler, Default_Handler, Default_Handler, Default_Handler, Default_Handler,
    Default_Handler, Default_Handler
};

void Default_Handler(void)
{
    for (;;) {
    }
}

/* Runs from flash, and calls nothing before all code is where it runs: volatile keeps the loops from becoming
 * memcpy and memset, which are among what is copied. */
void Reset_Handler(void)
{
    const uint32_t *from = __data_load;
    for (volatile uint32_t *at = __data_start; at < __data_end; at++)
        *at = *from++;
    for (volatile uint32_t *at = __bss_start; at < __bss_end; at++)
        *at = 0;
    main_start();
}
