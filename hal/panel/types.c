/* All controllers in one table. A program that names it links every one.
 *
 * SPDX-License-Identifier: MIT
 */
#include "panel.h"

const struct panel_type *const panel_types[] = { &panel_st7789,  &panel_ili9341, &panel_gc9a01,
                                                 &panel_ssd1351, &panel_ssd0323, &panel_ssd1306 };
const uint32_t n_panel_types = sizeof panel_types / sizeof *panel_types;
