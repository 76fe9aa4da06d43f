/* A sketch, as Arduino runs it: set-up, then one round.
 *
 * SPDX-License-Identifier: MIT
 */
#include "Arduino.h"

#include <cstdio>
#include <cstdlib>

void setup();
void loop();
stub_serial Serial;
void stub_serial::println(const char *text)
{
    std::fprintf(stderr, "%s\n", text);
    std::exit(1);
}

int main(int, char **argv)
{
    setup();
    loop();
    return stub_write(argv[1]);
}
