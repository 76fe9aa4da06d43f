/* @MODEL@ turns on a panel, with a frame counter.
 *
 * Wiring: zstrip/hal/@HAL@. What may be changed first stands above main; each function is explained in the header that
 * is included for it. ROWS, TRIS and VERTS are memory: more is quicker, until RAM ends, and no pixel changes.
 */
#include "hal.h"
#include "model.h"
#include "panel.h"
#include "zs_fast.h"
#include "zs_overlay.h"
@INCLUDES@
#define W @W@
#define H @H@
#define ROWS @ROWS@ /* of a strip */
#define TRIS @TRIS@ /* triangles at a time; the model has MODEL_TRIANGLES */
#define VERTS @VERTS@
#ifndef FRAMES
#define FRAMES 0 /* to draw; 0: for ever */
#endif
ZS_RENDERER_BUFFERS(screen, W, H, ROWS, TRIS, VERTS, MODEL_VARYINGS, @BUFFERS@);

static const struct panel_config glass = { @GLASS@ };
static struct panel panel;
static struct zs_instance instance[MODEL_INSTANCES]; /* the model, turned */
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

/* Three digits of n. */
static void write_number(char *text, uint32_t n)
{
    for (int i = 2; i >= 0; i--, n /= 10)
        text[i] = (char)('0' + n % 10);
}

int main(void)
{
    static const int32_t middle[3] = MODEL_MIDDLE;
    static const struct zs_fast *const fast[] = { MODEL_FAST, ZS_FAST_END };
    static char text[] = "000";
    static const struct zs_item counter = { .kind = &zs_item_text, .x = 4, .y = 4, .color = 0xffff, .text = text };
    static struct zs_overlay overlay = { .item = &counter, .n = 1 };
    static const struct zs_resolve hook = { .draw = zs_overlay_draw, .ctx = &overlay };
    const struct zs_scene scene = { .instance = instance, .n_instances = MODEL_INSTANCES,
                                    .background = ZS_RGB565(0x0a143c), .resolve = &hook, .n_resolves = 1 };
    const struct zs_sink sink = { .submit = send, .wait = wait, .ctx = &panel };
    struct zs_camera camera;
@WIRE@    screen_config.depth = &zs_depth_float;
    screen_config.fast = fast;
#ifdef MODEL_METHOD /* it is transparent in places */
    screen_config.method = MODEL_METHOD;
#endif
    int err = hal_init();
    err = err ? err : panel_init(&panel, &glass, hal_bus(), @SCRATCH_ARGS@);
    err = err ? err : ZS_INIT(screen);
    err = err ? err : zs_camera_perspective(&camera, ZS_DEGREES(45), W < H ? W : H, MODEL_RADIUS, 5 * MODEL_RADIUS);
    err = err ? err : zs_camera_orbit(&camera, middle, 3 * MODEL_RADIUS, ZS_DEGREES(22), ZS_PITCH(19));
    for (uint32_t t = 0; !err && (t == 0 || t != FRAMES); t++) {
        for (uint32_t i = 0; i < MODEL_INSTANCES; i++) {
            instance[i] = model_instance[i];
            zs_pose_turn(&instance[i].pose, (zs_turn)(t * (65536 / 48)), 0, 0); /* 48 frames a turn */
        }
        write_number(text, t);
        err = zs_render(&screen, &scene, &camera, &sink);
        hal_backlight(255);
    }
    if (err) {
        hal_write(err > -100 ? zs_error_string(err) : panel_strerror(err));
        hal_write("\n");
    }
    hal_exit(err != 0);
}
