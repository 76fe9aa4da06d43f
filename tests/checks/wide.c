/* wide.h on an emulated board. Ends with status 0 where all is right.
 *
 * SPDX-License-Identifier: MIT
 */
#include "hal.h"
#include "../lib/products.h"

#define RANDOM_PAIRS 100000u

static void put_hex(uint32_t v)
{
    char digit[2] = { 0 };
    for (int k = 28; k >= 0; k -= 4) {
        digit[0] = "0123456789abcdef"[v >> k & 15u];
        hal_write(digit);
    }
    hal_write(" ");
}

int main(void)
{
    uint32_t wrong[2];
    if (hal_init())
        hal_exit(2);
    const int right = wide_right(RANDOM_PAIRS, wrong);
    if (!right) {
        hal_write("wrong: ");
        put_hex(wrong[0]);
        put_hex(wrong[1]);
        hal_write("\n");
    }
    hal_exit(!right);
}
