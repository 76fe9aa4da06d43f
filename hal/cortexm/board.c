/* hal_init, hal_exit and hard faults: see board.h.
 *
 * SPDX-License-Identifier: MIT
 */
#include "board.h"

#include "hal.h"

uint8_t board_ready;

void HardFault_Handler(void);

int hal_init(void)
{
    if (board_ready)
        return HAL_ERR_NONE;
    const int err = board_start();
    board_ready = !err;
    return err;
}

void hal_exit(int status)
{
    (void)status;
    board_flush();
    __asm__ volatile("cpsid i");
    for (;;)
        __asm__ volatile("wfi");
}

void HardFault_Handler(void)
{
    hal_write(board_fault);
    hal_exit(1);
}
