/* Text and the end of a program by semihosting: what an emulator, or a debugger that offers it, takes from a board.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SEMIHOSTING_H
#define SEMIHOSTING_H

#include <stdint.h>

/* Gives hal_write and hal_exit to a board whose HAL gives this: the processor's own call, an operation and its
 * argument. */
void semihosting_call(uint32_t operation, uint32_t argument);

#endif
