/* A stub: the part of a library that zstrip's example names, over the display of stub.h.
 *
 * SPDX-License-Identifier: MIT
 */
#pragma once
#include "../stub.h"
typedef int BaseType_t;
typedef uint32_t TickType_t;
#define pdFALSE 0
#define pdTRUE 1
#define pdMS_TO_TICKS(ms) ((TickType_t)(ms))
