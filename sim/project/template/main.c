/* @MODEL@ turns on a panel, with a frame counter.
 *
 * display.h has the panel, and the size of the picture; the other headers explain the functions of the renderer. TRIS
 * and VERTS are memory: more is quicker, until RAM ends, and no pixel changes.
 */
#include "display.h"
#include "model.h"
#include "zs_fast.h"
#include "zs_overlay.h"

#define TRIS @TRIS@ /* triangles at a time; the model has MODEL_TRIANGLES */
#define VERTS @VERTS@
ZS_RENDERER_BUFFERS(screen, W, H, ROWS, TRIS, VERTS, MODEL_VARYINGS, BUFFERS);
static struct zs_instance instance[MODEL_INSTANCES]; /* the model, turned */

int main(void)
{
    static const int32_t middle[3] = MODEL_MIDDLE;
    static const struct zs_fast *const fast[] = { MODEL_FAST, ZS_FAST_END };
    static char text[] = "000";
    static const struct zs_item counter = { .kind = &zs_item_text, .x = 4, .y = 4, .color = 0xffff, .text = text };
    static struct zs_overlay overlay = { .item = &counter, .n = 1 };
    static const struct zs_resolve hook = { .draw = zs_overlay_draw, .ctx = &overlay };
    const struct zs_scene scene = { .instance = instance, .n_instances = MODEL_INSTANCES,
@LIGHT@                                    .background = ZS_RGB565(0x0a143c), .resolve = &hook, .n_resolves = 1 };
    struct zs_camera camera;
    screen_config.depth = &zs_depth_float;
    screen_config.fast = fast;
#ifdef MODEL_METHOD /* it is transparent in places */
    screen_config.method = MODEL_METHOD;
#endif
    int err = display_open();
    err = err ? err : ZS_INIT(screen);
    err = err ? err : zs_camera_perspective(&camera, ZS_DEGREES(45), W < H ? W : H, MODEL_RADIUS, 5 * MODEL_RADIUS);
    err = err ? err : zs_camera_orbit(&camera, middle, 3 * MODEL_RADIUS, ZS_DEGREES(22), ZS_PITCH(19));

    for (uint32_t t = 0; !err && (t == 0 || t != FRAMES); t++) {
        for (uint32_t i = 0; i < MODEL_INSTANCES; i++) {
            instance[i] = model_instance[i];
            zs_pose_turn(&instance[i].pose, (zs_turn)(t * (65536 / 48)), 0, 0); /* 48 frames a turn */
        }
        for (uint32_t i = 0, n = t; i < 3; i++, n /= 10)
            text[2 - i] = (char)('0' + n % 10);
        err = zs_render(&screen, &scene, &camera, &display_sink);
    }
    display_close(err);
}
