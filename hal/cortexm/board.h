/* What hal_init, hal_exit and a hard fault are on every Cortex-M board with text of its own, and what its HAL gives
 * board.c for them.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef CORTEXM_BOARD_H
#define CORTEXM_BOARD_H

#include <stdint.h>

/* ---- What board.c gives a board --------------------------------------------------------------------------------- */

extern uint8_t board_ready; /* 1: hal_init has succeeded */

/* ---- What a board gives board.c --------------------------------------------------------------------------------- */

/* The line that hal_write gets on a hard fault. */
extern const char board_fault[];

/* Everything that hal_init starts, once. Return HAL_ERR_NONE, or why it failed: hal_init may be called again. */
int board_start(void);

/* Wait until all text is out, the last bit included. Also called before board_start. */
void board_flush(void);

#endif
