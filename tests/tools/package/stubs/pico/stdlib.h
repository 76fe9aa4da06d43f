/* A stub: the part of a library that zstrip's example names, over the display of stub.h.
 *
 * SPDX-License-Identifier: MIT
 */
#pragma once
#include "../stub.h"
typedef unsigned int uint;
void sleep_us(uint64_t us);
static inline void tight_loop_contents(void) {}
