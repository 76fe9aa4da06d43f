/* ESP-IDF: a transfer that is done when it is waited for.
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdio.h>
#include <stdlib.h>

#include "esp_lcd_panel_ops.h"
#include "freertos/FreeRTOS.h"
#include "freertos/semphr.h"
#include "spinning_cube.h"

extern const struct zs_sink esp_sink;
void sink_begin(esp_lcd_panel_io_handle_t io, esp_lcd_panel_handle_t panel);
static esp_lcd_panel_io_color_trans_done_cb_t done;
static int out; /* what was drawn last, until it is waited for */

esp_err_t esp_lcd_panel_draw_bitmap(esp_lcd_panel_handle_t panel, int x0, int y0, int x1, int y1, const void *px)
{
    (void)panel;
    if (out++) {
        fprintf(stderr, "a strip is sent before the last one is out\n");
        exit(1);
    }
    stub_put(x0, y0, x1 - x0, y1 - y0, px, 0);
    return 0;
}
esp_err_t esp_lcd_panel_io_register_event_callbacks(esp_lcd_panel_io_handle_t io,
                                                    const esp_lcd_panel_io_callbacks_t *callbacks, void *ctx)
{
    (void)io;
    (void)ctx;
    done = callbacks->on_color_trans_done;
    return 0;
}
SemaphoreHandle_t xSemaphoreCreateBinary(void)
{
    static struct { int count; } one;
    return (SemaphoreHandle_t)(void *)&one;
}
BaseType_t xSemaphoreTake(SemaphoreHandle_t s, TickType_t ticks)
{
    if (ticks && !s->count) {
        done(NULL, NULL, NULL);
        out = 0;
    }
    return s->count ? s->count = 0, pdTRUE : pdFALSE;
}
BaseType_t xSemaphoreGiveFromISR(SemaphoreHandle_t s, BaseType_t *woken)
{
    s->count = 1;
    *woken = pdFALSE;
    return pdTRUE;
}

int main(int argc, char **argv)
{
    static const uint16_t black[4];
    sink_begin(NULL, NULL);
    esp_lcd_panel_draw_bitmap(NULL, 0, 0, 2, 2, black); /* the program's own */
    done(NULL, NULL, NULL);
    out = 0;
    return argc < 2 || cube_begin(240, 240) || cube_draw(0, &esp_sink) || stub_write(argv[1]);
}
