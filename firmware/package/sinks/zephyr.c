/* Strips through Zephyr's display_write, to the devicetree's chosen display. Its driver's RGB565 is what SPI panels
 * take (most significant byte first); where a driver wants the other order, swap in send.
 *
 * SPDX-License-Identifier: MIT
 */
#include <errno.h>

#include <zephyr/device.h>
#include <zephyr/drivers/display.h>

#include "zstrip.h"

static int send(void *ctx, const struct zs_strip *strip)
{
    const struct display_buffer_descriptor what = {
        .buf_size = strip->n_bytes, .width = strip->w, .height = strip->h, .pitch = strip->w
    };
    /* errors of Zephyr are small negative numbers: kept apart from zstrip's */
    const int err = display_write(ctx, strip->x, strip->y, &what, strip->px);
    return err ? -200 + err : 0;
}

/* NULL: there is no display, or it is not ready. */
const struct zs_sink *zephyr_sink(void);
const struct zs_sink *zephyr_sink(void)
{
    static struct zs_sink sink = { .submit = send };
    const struct device *display = DEVICE_DT_GET(DT_CHOSEN(zephyr_display));
    sink.ctx = (void *)display;
    if (!device_is_ready(display))
        return NULL;
    const int err = display_blanking_off(display);
    return err == 0 || err == -ENOSYS ? &sink : NULL; /* -ENOSYS: this display is never blank */
}
