/* LVGL: the screen in parts of 37 rows and, in the middle, 100 columns by themselves.
 *
 * SPDX-License-Identifier: MIT
 */
#include <lvgl.h>

#include "spinning_cube.h"

struct lvgl_view {
    struct zs_renderer *renderer;
    int32_t rows;
    int (*open)(void);
};
lv_obj_t *lvgl_view_create(lv_obj_t *parent, struct lvgl_view *view, int32_t w, int32_t h);
static lv_event_cb_t draws;
static void *user;

lv_obj_t *lv_obj_create(lv_obj_t *parent)
{
    return parent;
}
void lv_obj_remove_style_all(lv_obj_t *obj)
{
    (void)obj;
}
void lv_obj_set_size(lv_obj_t *obj, int32_t w, int32_t h)
{
    (void)obj;
    (void)w;
    (void)h;
}
void *lv_obj_add_event_cb(lv_obj_t *obj, lv_event_cb_t cb, lv_event_code_t code, void *of)
{
    (void)obj;
    (void)code;
    draws = cb;
    user = of;
    return NULL;
}
void lv_obj_get_coords(const lv_obj_t *obj, lv_area_t *at)
{
    (void)obj;
    *at = (lv_area_t){ 0, 0, 239, 239 };
}

static lv_draw_buf_t buffer, *room = &buffer; /* NULL: no memory */
void *lv_draw_layer_alloc_buf(lv_layer_t *layer)
{
    if (!layer->draw_buf)
        layer->draw_buf = room;
    return layer->draw_buf ? layer->draw_buf->data : NULL;
}

/* Layers come without a buffer. One that gets none, or is of another format, is left as it is. */
static void part(lv_area_t area)
{
    static uint8_t memory[240 * 240 * 2];
    const int32_t w = area.x2 - area.x1 + 1, h = area.y2 - area.y1 + 1;
    buffer = (lv_draw_buf_t){ { (uint32_t)w * 2u }, memory };
    lv_layer_t layer = { NULL, area, LV_COLOR_FORMAT_RGB565, area };
    lv_event_t e = { &layer, NULL, user };
    draws(&e);
    room = NULL;
    layer.draw_buf = NULL;
    draws(&e);
    room = &buffer;
    buffer.data = memory + 1; /* where a wrong one would be seen */
    layer.color_format = LV_COLOR_FORMAT_ARGB8888;
    draws(&e);
    stub_put(area.x1, area.y1, w, h, memory, 1);
}
static int next(void)
{
    return cube_open(0);
}

int main(int argc, char **argv)
{
    static struct lvgl_view view = { 0, CUBE_ROWS, next };
    view.renderer = cube_renderer();
    if (argc < 2 || cube_begin(240, 240))
        return 1;
    lvgl_view_create(NULL, &view, 240, 240);
    for (int32_t y = 0; y < 240; y += 37)
        part((lv_area_t){ 0, y, 239, y + 36 < 240 ? y + 36 : 239 });
    part((lv_area_t){ 70, 50, 169, 149 });
    return stub_write(argv[1]);
}
