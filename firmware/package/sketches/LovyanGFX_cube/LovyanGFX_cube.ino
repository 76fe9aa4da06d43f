/* zstrip's strips through LovyanGFX, by DMA. A renderer of two buffers (ZS_RENDERER_BUFFERS, 7.7 KB more here) draws
 * the next strip while one leaves; with one, as here, each is waited for. */
#define LGFX_AUTODETECT
#include <LovyanGFX.hpp>
#include <LGFX_AUTODETECT.hpp>
#include <zstrip.h>

#include "spinning_cube.h"

static LGFX lcd;

/* lgfx::swap565_t: RGB565, most significant byte first, as a strip has it. */
static int send(void *ctx, const struct zs_strip *strip)
{
    (void)ctx;
    lcd.pushImageDMA(strip->x, strip->y, strip->w, strip->h, (const lgfx::swap565_t *)strip->px);
    return 0;
}

static int wait(void *ctx)
{
    (void)ctx;
    lcd.waitDMA();
    return 0;
}

void setup()
{
    Serial.begin(115200);
    lcd.init();
    lcd.startWrite();
    const int err = cube_begin(lcd.width() < 240 ? lcd.width() : 240, lcd.height() < 240 ? lcd.height() : 240);
    if (err)
        Serial.println(zs_error_string(err));
}

void loop()
{
    static uint32_t frame;
    static const struct zs_sink sink = { send, wait, nullptr, nullptr };
    cube_draw(frame++, &sink);
}
