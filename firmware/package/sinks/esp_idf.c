/* Strips through ESP-IDF's esp_lcd: by DMA, so that a strip is drawn while the one before it leaves.
 *
 *   sink_begin(panel_io, panel);      after esp_lcd_new_panel_...
 *   zs_render(&screen, &scene, &camera, &esp_sink);    a renderer with two buffers (ZS_RENDERER_BUFFERS)
 *
 * SPDX-License-Identifier: MIT
 */
#include "esp_lcd_panel_io.h"
#include "esp_lcd_panel_ops.h"
#include "freertos/FreeRTOS.h"
#include "freertos/semphr.h"
#include "zstrip.h"

static esp_lcd_panel_handle_t lcd;
static SemaphoreHandle_t sent;

/* In an interrupt. */
static bool on_sent(esp_lcd_panel_io_handle_t io, esp_lcd_panel_io_event_data_t *data, void *ctx)
{
    (void)io;
    (void)data;
    (void)ctx;
    BaseType_t woken = pdFALSE;
    xSemaphoreGiveFromISR(sent, &woken);
    return woken == pdTRUE;
}

/* A strip's pixels are RGB565, most significant byte first: as SPI panels take them. */
static int send(void *ctx, const struct zs_strip *strip)
{
    (void)ctx;
    (void)xSemaphoreTake(sent, 0); /* of what was sent beside zstrip, or came after its time was over */
    return esp_lcd_panel_draw_bitmap(lcd, strip->x, strip->y, strip->x + strip->w, strip->y + strip->h, strip->px)
               ? -200
               : 0;
}

static int wait(void *ctx)
{
    (void)ctx;
    return xSemaphoreTake(sent, pdMS_TO_TICKS(1000)) == pdTRUE ? 0 : -201;
}

const struct zs_sink esp_sink = { .submit = send, .wait = wait };

void sink_begin(esp_lcd_panel_io_handle_t io, esp_lcd_panel_handle_t panel);
void sink_begin(esp_lcd_panel_io_handle_t io, esp_lcd_panel_handle_t panel)
{
    const esp_lcd_panel_io_callbacks_t callbacks = { .on_color_trans_done = on_sent };
    lcd = panel;
    sent = xSemaphoreCreateBinary();
    esp_lcd_panel_io_register_event_callbacks(io, &callbacks, NULL);
}
