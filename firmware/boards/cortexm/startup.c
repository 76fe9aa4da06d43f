/* Cortex-M boards: vectors and the way to main. A board's linker script says where memory is and includes sections.ld.
 *
 * A HAL that uses device interrupts puts its handlers, from IRQ 0 on, into a const array in section ".device_vectors".
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdint.h>

#include "../startup.h"

#define SCB_VTOR (*(volatile uint32_t *)0xe000ed08u)

void NMI_Handler(void) WEAK;
void HardFault_Handler(void) WEAK; /* the other faults are not enabled and end here too */
void SVC_Handler(void) WEAK;
void PendSV_Handler(void) WEAK;
void SysTick_Handler(void) WEAK;

typedef void (*vector)(void);

/* Exceptions 0 to 15; the device's interrupts follow. */
__attribute__((section(".vectors"), used)) static const vector vectors[16] = {
    (vector)(uintptr_t)__stack_top, Reset_Handler, NMI_Handler, HardFault_Handler,
    0, 0, 0, 0, 0, 0, 0, SVC_Handler, 0, 0, PendSV_Handler, SysTick_Handler
};

void Default_Handler(void)
{
    for (;;) {
    }
}

/* Naked of locals on purpose: everything below the stack pointer is painted. VTOR (Armv7-M has it, Armv6-M need not): a
 * boot loader that jumps here may have left its own vectors at 0 (STM32's, after dfu-util's :leave). */
void Reset_Handler(void)
{
#if __ARM_ARCH >= 7
    SCB_VTOR = (uint32_t)(uintptr_t)vectors;
#endif
    memory_start();
    main_start();
}
