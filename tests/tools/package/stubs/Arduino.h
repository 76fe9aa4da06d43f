/* A stub: the part of a library that zstrip's example names, over the display of stub.h.
 *
 * SPDX-License-Identifier: MIT
 */
#pragma once
#include "stub.h"
struct stub_serial {
    void begin(long) {}
    void println(const char *text);
};
extern stub_serial Serial;
