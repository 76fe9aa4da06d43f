/* A stub: the part of a library that zstrip's example names, over the display of stub.h.
 *
 * SPDX-License-Identifier: MIT
 */
#pragma once
#include "Arduino.h"
#define DF_GFX_RST 8
class Arduino_DataBus {};
inline Arduino_DataBus *create_default_Arduino_DataBus() { return new Arduino_DataBus; }
class Arduino_GFX {
  public:
    virtual ~Arduino_GFX() {}
    bool begin() { return true; }
    virtual void draw16bitBeRGBBitmap(int16_t x, int16_t y, uint16_t *bitmap, int16_t w, int16_t h)
    {
        stub_put(x, y, w, h, bitmap, 0);
    }
};
class Arduino_ST7789 : public Arduino_GFX {
  public:
    Arduino_ST7789(Arduino_DataBus *, int8_t, uint8_t, bool, int16_t, int16_t) {}
};
