/* The display behind the stubs.
 *
 * SPDX-License-Identifier: MIT
 */
#include "stub.h"

#include <stdio.h>
#include <stdlib.h>

static uint8_t frame[STUB_W * STUB_H_PX * 2];

void stub_put(int x, int y, int w, int h, const void *px, int swapped)
{
    const uint8_t *from = px;
    if (x < 0 || y < 0 || w < 1 || h < 1 || x + w > STUB_W || y + h > STUB_H_PX) {
        fprintf(stderr, "a rectangle outside of the display: %d %d %d %d\n", x, y, w, h);
        exit(1);
    }
    for (int row = 0; row < h; row++)
        for (int i = 0; i < 2 * w; i++)
            frame[2 * ((y + row) * STUB_W + x) + (swapped ? i ^ 1 : i)] = from[2 * row * w + i];
}

int stub_write(const char *file)
{
    FILE *f = fopen(file, "wb");
    return !f || fwrite(frame, 1, sizeof frame, f) != sizeof frame || fclose(f) != 0;
}

void stub_wire(const uint8_t *bytes, uint32_t n, int data)
{
    static uint8_t window[4], command;
    static uint32_t at, n_window;
    if (!data) {
        command = bytes[0];
        n_window = 0;
        if (command == 0x2c)
            at = (uint32_t)(window[0] << 8 | window[1]) * STUB_W * 2;
        return;
    }
    for (uint32_t i = 0; i < n; i++)
        if (command == 0x2b) /* rows of the window */
            window[n_window++ & 3u] = bytes[i];
        else if (command == 0x2c && at < sizeof frame)
            frame[at++] = bytes[i];
}
