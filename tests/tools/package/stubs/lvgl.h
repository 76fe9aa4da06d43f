/* A stub: the part of a library that zstrip's example names, over the display of stub.h.
 *
 * SPDX-License-Identifier: MIT
 */
#pragma once
#include "stub.h"
typedef struct { int32_t x1, y1, x2, y2; } lv_area_t;
typedef struct { uint32_t stride; } lv_image_header_t;
typedef struct { lv_image_header_t header; uint8_t *data; } lv_draw_buf_t;
typedef enum { LV_COLOR_FORMAT_RGB565 = 0x12, LV_COLOR_FORMAT_ARGB8888 = 0x10 } lv_color_format_t;
typedef struct {
    lv_draw_buf_t *draw_buf;
    lv_area_t buf_area;
    lv_color_format_t color_format;
    lv_area_t _clip_area;
} lv_layer_t;
void *lv_draw_layer_alloc_buf(lv_layer_t *layer); /* NULL: no memory */
typedef struct lv_obj lv_obj_t;
typedef struct { lv_layer_t *layer; lv_obj_t *target; void *user; } lv_event_t;
typedef void (*lv_event_cb_t)(lv_event_t *e);
typedef enum { LV_EVENT_DRAW_MAIN = 1 } lv_event_code_t;
lv_obj_t *lv_obj_create(lv_obj_t *parent);
void lv_obj_remove_style_all(lv_obj_t *obj);
void lv_obj_set_size(lv_obj_t *obj, int32_t w, int32_t h);
void *lv_obj_add_event_cb(lv_obj_t *obj, lv_event_cb_t cb, lv_event_code_t code, void *user);
void lv_obj_get_coords(const lv_obj_t *obj, lv_area_t *at);
static inline void *lv_event_get_user_data(lv_event_t *e) { return e->user; }
static inline lv_layer_t *lv_event_get_layer(lv_event_t *e) { return e->layer; }
static inline lv_obj_t *lv_event_get_target_obj(lv_event_t *e) { return e->target; }
