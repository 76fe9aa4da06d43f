/* Errors in words.
 *
 * SPDX-License-Identifier: MIT
 */
#include "panel.h"

const char *panel_strerror(int err)
{
    switch (err) {
    case HAL_ERR_NONE: return "no error";
    case HAL_ERR_STATE: return "hal_init is missing, or a transfer is still out";
    case HAL_ERR_ARG: return "a pointer is NULL or odd, or the stride is too small or odd";
    case HAL_ERR_CHANGED: return "borrowed pixels were written to";
    case HAL_ERR_BUS: return "the bus failed";
    case HAL_ERR_TIMEOUT: return "the bus did not end in its time";
    case HAL_ERR_BUSY: return "another user keeps the bus";
    case PANEL_ERR_SIZE: return "this controller has no glass of that size at that offset";
    case PANEL_ERR_ROTATE: return "rotation is not 0 to 3";
    case PANEL_ERR_RECT: return "the rectangle is empty or reaches beyond the picture";
    case PANEL_ERR_GRAIN: return "the rectangle's edges are not multiples of the panel's grain";
    case PANEL_ERR_SCRATCH: return "scratch is too small or not 4-byte aligned";
    case PANEL_ERR_STATE: return "the panel is asleep or not set up";
    default: return "unknown error";
    }
}
