/* A stub: the part of a library that zstrip's example names, over the display of stub.h.
 *
 * SPDX-License-Identifier: MIT
 */
#pragma once
#include "../device.h"
struct display_buffer_descriptor {
    uint32_t buf_size;
    uint16_t width, height, pitch;
    bool frame_incomplete;
};
int display_write(const struct device *d, const uint16_t x, const uint16_t y,
                  const struct display_buffer_descriptor *what, const void *px);
int display_blanking_off(const struct device *d);
