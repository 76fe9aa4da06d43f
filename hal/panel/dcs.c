/* Scripts of the MIPI Display Command Set, which the TFT controllers share.
 *
 * SPDX-License-Identifier: MIT
 */
#include "panel_type.h"

const uint8_t panel_dcs_wake[] = { 1, 0x11, 0 }, panel_dcs_sleep[] = { 1, 0x10, 0 };
const uint8_t panel_dcs_te[] = { 2, 0x35, 0x00, 0 }; /* TEON, once a picture and not once a line */
