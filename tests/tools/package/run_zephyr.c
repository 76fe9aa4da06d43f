/* Zephyr.
 *
 * SPDX-License-Identifier: MIT
 */
#include <errno.h>

#include <zephyr/drivers/display.h>

#include "spinning_cube.h"

const struct device stub_display;
const struct zs_sink *zephyr_sink(void);

int display_write(const struct device *d, const uint16_t x, const uint16_t y,
                  const struct display_buffer_descriptor *what, const void *px)
{
    if (d != &stub_display || what->pitch != what->width || what->buf_size != 2u * what->width * what->height)
        return -22;
    stub_put(x, y, what->width, what->height, px, 0);
    return 0;
}
int display_blanking_off(const struct device *d)
{
    static int calls; /* a driver that can, then one that cannot */
    return d != &stub_display ? -EINVAL : calls++ ? -ENOSYS : 0;
}

int main(int argc, char **argv)
{
    const struct zs_sink *sink = zephyr_sink();
    return argc < 2 || !sink || !zephyr_sink() || cube_begin(240, 240) || cube_draw(0, sink) || stub_write(argv[1]);
}
