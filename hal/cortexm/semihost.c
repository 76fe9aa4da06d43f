/* Text and the end of a program, by semihosting (Arm, "Semihosting for AArch32 and AArch64"): operation in r0, its
 * argument in r1, bkpt 0xab.
 *
 * SPDX-License-Identifier: MIT
 */
#include "hal.h"

#define SYS_WRITE0 0x04u
#define SYS_EXIT 0x18u
#define EXIT_OK 0x20026u     /* ADP_Stopped_ApplicationExit */
#define EXIT_FAILED 0x20023u /* ADP_Stopped_RunTimeErrorUnknown */

void HardFault_Handler(void);

static void semihost(uint32_t operation, uint32_t argument)
{
    register uint32_t r0 __asm__("r0") = operation;
    register uint32_t r1 __asm__("r1") = argument;
    __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
}

void hal_exit(int status)
{
    semihost(SYS_EXIT, status ? EXIT_FAILED : EXIT_OK);
    for (;;) {
    }
}

void hal_write(const char *text)
{
    semihost(SYS_WRITE0, (uint32_t)text);
}

void HardFault_Handler(void)
{
    hal_write("hard fault\n");
    hal_exit(1);
}
