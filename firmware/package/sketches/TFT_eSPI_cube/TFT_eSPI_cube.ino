/* zstrip's strips through TFT_eSPI, whose User_Setup.h knows the display and its pins. */
#include <TFT_eSPI.h>
#include <zstrip.h>

#include "spinning_cube.h"

static TFT_eSPI tft;

/* A strip's pixels are RGB565, most significant byte first: as the display takes them, so that nothing is swapped. */
static int send(void *ctx, const struct zs_strip *strip)
{
    (void)ctx;
    tft.pushImage(strip->x, strip->y, strip->w, strip->h, (uint16_t *)strip->px);
    return 0;
}

void setup()
{
    Serial.begin(115200);
    tft.init();
    tft.setSwapBytes(false);
    const int err = cube_begin(tft.width() < 240 ? tft.width() : 240, tft.height() < 240 ? tft.height() : 240);
    if (err)
        Serial.println(zs_error_string(err));
}

void loop()
{
    static uint32_t frame;
    static const struct zs_sink sink = { send, nullptr, nullptr, nullptr };
    cube_draw(frame++, &sink);
}
