/* zstrip's strips through Arduino_GFX. Choose bus, pins and display as in that library's own examples. */
#include <Arduino_GFX_Library.h>
#include <zstrip.h>

#include "spinning_cube.h"

static Arduino_DataBus *bus = create_default_Arduino_DataBus();
static Arduino_GFX *gfx = new Arduino_ST7789(bus, DF_GFX_RST, 0 /* rotation */, true /* IPS */, 240, 240);

/* "Be": RGB565, most significant byte first, as a strip has it. */
static int send(void *ctx, const struct zs_strip *strip)
{
    (void)ctx;
    gfx->draw16bitBeRGBBitmap(strip->x, strip->y, (uint16_t *)strip->px, strip->w, strip->h);
    return 0;
}

void setup()
{
    Serial.begin(115200);
    gfx->begin();
    const int err = cube_begin(240, 240);
    if (err)
        Serial.println(zs_error_string(err));
}

void loop()
{
    static uint32_t frame;
    static const struct zs_sink sink = { send, nullptr, nullptr, nullptr };
    cube_draw(frame++, &sink);
}
