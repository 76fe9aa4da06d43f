/* C++'s memory for meshoptimizer, by the names that C++ has for it: there is no C++ library.
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdlib.h>

#include "sim.h"

void *web_new(size_t bytes) __asm__("_Znwm");
void web_delete(void *block) __asm__("_ZdlPv");

void *web_new(size_t bytes)
{
    return sim_grow(NULL, bytes, 1);
}

void web_delete(void *block)
{
    free(block);
}
