/* A stub: the part of a library that zstrip's example names, over the display of stub.h.
 *
 * SPDX-License-Identifier: MIT
 */
#pragma once
#include "../pico/stdlib.h"
enum gpio_function { GPIO_FUNC_SPI = 1 };
enum { GPIO_OUT = 1 };
void gpio_put(uint pin, bool level);
void gpio_init(uint pin);
void gpio_set_dir(uint pin, bool out);
void gpio_set_function(uint pin, enum gpio_function function);
