/* Antialiasing: four samples a pixel. A renderer of twice the panel's width and height draws
 * strips of samples; each strip is averaged, in place, on its way to the panel.
 *
 *     ZS_RENDERER_2X2(screen, 240, 240, 8, 600, 400, ZS_VARYINGS_FLAT);
 *     ...
 *     screen_config.depth = &zs_depth_float;
 *     int err = ZS_INIT(screen);
 *     err = err ? err : zs_supersample_init(&screen_2x2, &screen, &sink);
 *     err = err ? err : zs_camera_perspective(&camera, ZS_DEGREES(45), 2 * 240, 100, 20000);
 *     err = err ? err : zs_render(&screen, &scene, &camera, &screen_2x2.sink);
 *
 * Promise   coverage is exact on the grid of samples: pixel (i, j) of the panel is the average of
 *           samples (2 i, 2 j) .. (2 i + 1, 2 j + 1), each drawn by the top-left rule, at a quarter
 *           and three quarters of the pixel each way. All else that zstrip.h promises holds for
 *           samples.
 * Colour    the average of each RGB565 channel, rounded to nearest, halves up. Four equal samples
 *           stay what they are. Averages are taken of the channels as they are, without gamma.
 * Doubled   the size of the configuration, the height of a perspective camera, viewports, sizes of
 *           zs_lines.h; rectangles and columns of zs_damage.h. Skies, fragment stages and the
 *           resolve hooks of a scene draw samples. Texts and the like are drawn after the average,
 *           by the hooks of struct zs_supersample.
 * RAM       16 bytes for each pixel of a strip (two bytes of colour and two of depth a sample), 24
 *           with two buffers; without samples 4 and 6. A strip of 8 rows of 240 px takes 30,720.
 * Cost      4 times the pixels are drawn, in twice the rows; vertices and culling cost the same.
 *           The average takes 15 instructions for a pixel of the panel on a Cortex-M3. The teapot,
 *           320x240: 4.6 million instructions with one sample, 9.8 with four. Flash: 650 bytes.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_SUPERSAMPLE_H
#define ZS_SUPERSAMPLE_H

#include "zstrip.h"

ZS_C_BEGIN

/* One for each renderer that draws samples; kept by the caller while it does, in its place: sink
 * points to it, not to a copy. So do the renderer and the inner sink stay in theirs. */
struct zs_supersample {
    struct zs_sink sink; /* for zs_render and zs_render_passes; zs_supersample_init sets it */
    const struct zs_resolve *resolve; /* [n_resolves]: drawn over each averaged strip, in px of the
                                         panel, without depth (target.depth is NULL). `changes` is
                                         not called: zs_supersample_invalidate. NULL: none */
    uint32_t n_resolves;
    struct zs_renderer *renderer; /* set by zs_supersample_init, as is: */
    const struct zs_sink *inner;
};

/* A static renderer `name`, as ZS_RENDERER makes it, and a struct zs_supersample `name_2x2`. width,
 * height and strip_h are those of the panel: at most ZS_SIZE_MAX / 2. */
#define ZS_RENDERER_2X2(name, width, height, strip_h, max_tris, max_verts, varyings)               \
    ZS_RENDERER_2X2_BUFFERS(name, width, height, strip_h, max_tris, max_verts, varyings, 1)
#define ZS_RENDERER_2X2_BUFFERS(name, width, height, strip_h, max_tris, max_verts, varyings,       \
                                buffers)                                                           \
    static struct zs_supersample name##_2x2;                                                       \
    ZS_RENDERER_BUFFERS(name, 2 * (width), 2 * (height), 2 * (strip_h), max_tris, max_verts,       \
                        varyings, buffers)

/* Put a supersampler between a renderer and a sink. Give s->sink to zs_render; `inner` then gets
 * strips of half the width and height, whose depth is NULL, in the renderer's own buffers: with
 * two buffers, one is drawn while the other one is sent.
 *
 * s        its fields are set; resolve to NULL.
 * r        set up (zs_init). Call again after another zs_init of it.
 * inner    the user's sink, kept by the caller. Its submit must be given; wait and end may be NULL.
 * Damage   zs_damage_* work on samples: strips and columns are dirty if one of their samples is.
 *          Columns widen outwards to whole pixels; under zs_damage_columns, to ZS_DAMAGE_GRAIN / 2
 *          pixels of the panel, or its end.
 * Return   ZS_OK; ZS_ERR_NULL; ZS_ERR_SEQUENCE (r is not set up); ZS_ERR_SIZE (width, height or
 *          strip height of r is odd): *s is untouched. */
int zs_supersample_init(struct zs_supersample *s, struct zs_renderer *r,
                        const struct zs_sink *inner);

/* Average the strip that zs_frame_strip gave out last, and draw the resolve hooks over it: for
 * programs that own the loop. s->sink does it by itself.
 *
 * strip    in: as zs_frame_strip made it; out: in px of the panel, half as wide and high; depth
 *          is NULL. Not more than once for a strip. Of one with dirty_w 0, only the struct
 *          changes. */
void zs_supersample_strip(const struct zs_supersample *s, struct zs_strip *strip);

/* Tell that the panel no longer shows what was given out, or that what a resolve hook of s draws
 * has changed: zs_invalidate in px of the panel.
 *
 * rect     px of the panel; NULL: all.
 * Return   as zs_invalidate. */
int zs_supersample_invalidate(const struct zs_supersample *s, const struct zs_rect *rect);

ZS_C_END

#endif
