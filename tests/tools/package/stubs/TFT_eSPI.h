/* A stub: the part of a library that zstrip's example names, over the display of stub.h.
 *
 * SPDX-License-Identifier: MIT
 */
#pragma once
#include "Arduino.h"
class TFT_eSPI {
    bool swap = false;
  public:
    void init() {}
    void setSwapBytes(bool on) { swap = on; }
    int16_t width() { return STUB_W; }
    int16_t height() { return STUB_H_PX; }
    void pushImage(int32_t x, int32_t y, int32_t w, int32_t h, uint16_t *data) { stub_put(x, y, w, h, data, swap); }
};
