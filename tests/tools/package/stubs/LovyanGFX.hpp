/* A stub: the part of a library that zstrip's example names, over the display of stub.h.
 *
 * SPDX-License-Identifier: MIT
 */
#pragma once
#include "Arduino.h"
namespace lgfx {
struct swap565_t {
    uint16_t raw;
};
}
class LGFX {
    int out = 0; /* begun, and not waited for */
  public:
    bool init() { return true; }
    void startWrite() {}
    int32_t width() { return STUB_W; }
    int32_t height() { return STUB_H_PX; }
    template <typename T> void pushImageDMA(int32_t x, int32_t y, int32_t w, int32_t h, const T *data)
    {
        static_assert(sizeof(T) == 2, "");
        if (out++)
            stub_put(-1, 0, 0, 0, nullptr, 0);
        stub_put(x, y, w, h, data, 0);
    }
    void waitDMA() { out = 0; }
};
