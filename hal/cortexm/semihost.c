/* Semihosting on a Cortex-M (Arm, "Semihosting for AArch32 and AArch64"): operation in r0, its argument in r1,
 * bkpt 0xab. A hard fault says so, and ends the program.
 *
 * SPDX-License-Identifier: MIT
 */
#include "hal.h"
#include "semihosting.h"

void HardFault_Handler(void);

void semihosting_call(uint32_t operation, uint32_t argument)
{
    register uint32_t r0 __asm__("r0") = operation;
    register uint32_t r1 __asm__("r1") = argument;
    __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
}

void HardFault_Handler(void)
{
    hal_write("hard fault\n");
    hal_exit(1);
}
