/* A 3D picture as an LVGL 9 object: drawn into whatever part of the screen LVGL draws, its partial draw buffers
 * included. It needs LVGL's software renderer in LVGL's own thread (LV_USE_OS is LV_OS_NONE), and is seen on a display
 * of RGB565 alone, where neither the object nor what it lies in is drawn as a layer of another format (opacity, blend
 * mode, transform).
 *
 *   static struct lvgl_view view = { &screen, 16, open };    open: zs_frame_begin of what is to be seen
 *   lv_obj_t *obj = lvgl_view_create(lv_screen_active(), &view, 240, 240);
 *   lv_obj_invalidate(obj);     for the next frame
 *
 * SPDX-License-Identifier: MIT
 */
#include <lvgl.h>

#include "zstrip.h"

#if defined(LV_USE_OS) && LV_USE_OS
#error "zstrip's lvgl.c needs LV_USE_OS LV_OS_NONE: LVGL's drawing threads could fill what it has drawn"
#endif

struct lvgl_view {
    struct zs_renderer *renderer;
    int32_t rows;      /* of its strips */
    int (*open)(void); /* zs_frame_begin of what is to be seen now; called for each part */
};

/* Copy the rows and columns of a strip that lie in the layer; LVGL's pixels have the least significant byte first. */
static void copy_strip(const lv_layer_t *layer, const lv_area_t *at, const struct zs_strip *s)
{
    const lv_area_t *clip = &layer->_clip_area, *buffer = &layer->buf_area;
    for (int32_t row = 0; row < s->h; row++) {
        const int32_t y = at->y1 + s->y + row;
        if (y < clip->y1 || y > clip->y2)
            continue;
        uint8_t *to = layer->draw_buf->data + (uint32_t)(y - buffer->y1) * layer->draw_buf->header.stride;
        for (int32_t x = clip->x1 > at->x1 ? clip->x1 : at->x1; x <= clip->x2 && x < at->x1 + s->w; x++) {
            const uint8_t *from = s->px + 2u * ((uint32_t)row * s->w + (uint32_t)(x - at->x1));
            to[2 * (x - buffer->x1)] = from[1];
            to[2 * (x - buffer->x1) + 1] = from[0];
        }
    }
}

static void draw(lv_event_t *e)
{
    struct lvgl_view *view = lv_event_get_user_data(e);
    lv_layer_t *layer = lv_event_get_layer(e);
    lv_area_t at;
    struct zs_strip strip;
    lv_obj_get_coords(lv_event_get_target_obj(e), &at);
    if (!lv_draw_layer_alloc_buf(layer) || layer->color_format != LV_COLOR_FORMAT_RGB565 || view->open())
        return;
    for (int32_t y = at.y1; y <= layer->_clip_area.y2;) { /* strips above the part are left out, undrawn */
        const int above = y + view->rows <= layer->_clip_area.y1;
        if ((above ? zs_frame_skip(view->renderer) : zs_frame_strip(view->renderer, &strip)) != 1)
            break;
        if (!above)
            copy_strip(layer, &at, &strip);
        y += view->rows;
    }
    (void)zs_frame_end(view->renderer);
}

lv_obj_t *lvgl_view_create(lv_obj_t *parent, struct lvgl_view *view, int32_t w, int32_t h);
lv_obj_t *lvgl_view_create(lv_obj_t *parent, struct lvgl_view *view, int32_t w, int32_t h)
{
    lv_obj_t *obj = lv_obj_create(parent);
    lv_obj_remove_style_all(obj);
    lv_obj_set_size(obj, w, h);
    lv_obj_add_event_cb(obj, draw, LV_EVENT_DRAW_MAIN, view);
    return obj;
}
