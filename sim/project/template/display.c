/* The panel of @NAME@: what it is, and how strips of the picture reach it. zstrip/hal/hal.h and
 * zstrip/hal/panel/panel.h explain the functions. Wiring: zstrip/hal/@HAL@.
 */
#include "display.h"
#include "hal.h"
#include "panel.h"
@INCLUDES@
static const struct panel_config glass = { @GLASS@ };
static struct panel panel;
@SCRATCH@
static int send(void *ctx, const struct zs_strip *strip)
{
    const struct panel_rect rect = { strip->x, strip->y, strip->w, strip->h };
    return panel_send(ctx, &rect, strip->px, 0);
}

static int wait(void *ctx)
{
    return panel_wait(ctx);
}

static int light(void *ctx)
{
    (void)ctx;
    hal_backlight(255);
    return 0;
}

const struct zs_sink display_sink = { .submit = send, .wait = wait, .end = light, .ctx = &panel };

int display_open(void)
{
@WIRE@    const int err = hal_init();
    return err ? err : panel_init(&panel, &glass, hal_bus(), @SCRATCH_ARGS@);
}

void display_close(int err)
{
    if (err) {
        hal_write(err > -100 ? zs_error_string(err) : panel_strerror(err));
        hal_write("\n");
@WHY@    }
    hal_exit(err != 0);
}
