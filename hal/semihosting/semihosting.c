/* hal_write and hal_exit by semihosting: see semihosting.h. Operations and their arguments are the same for Arm
 * ("Semihosting for AArch32 and AArch64") and RISC-V ("RISC-V Semihosting").
 *
 * SPDX-License-Identifier: MIT
 */
#include "semihosting.h"

#include "hal.h"

#define SYS_WRITE0 0x04u
#define SYS_EXIT 0x18u
#define EXIT_OK 0x20026u     /* ADP_Stopped_ApplicationExit */
#define EXIT_FAILED 0x20023u /* ADP_Stopped_RunTimeErrorUnknown */

void hal_exit(int status)
{
    semihosting_call(SYS_EXIT, status ? EXIT_FAILED : EXIT_OK);
    for (;;) {
    }
}

void hal_write(const char *text)
{
    semihosting_call(SYS_WRITE0, (uint32_t)text);
}
