/* Fog: surfaces fade into a colour with their distance.
 *
 *     static struct zs_fog fog = { .color = ZS_RGB565(0x8090a0), .start = 2000, .end = 9000 };
 *     static const struct zs_resolve hook = { .draw = zs_fog_draw, .changes = zs_fog_changes,
 *                                             .ctx = &fog };
 *     ...
 *     err = zs_fog_set(&fog, &config, &camera);
 *     scene.resolve = &hook, scene.n_resolves = 1;
 *
 * It is mixed in when a strip has been drawn, by the keys of its depth buffer. So it costs the same
 * whatever is drawn, takes any shader, and needs a mapping with depth memory. Put its hook before
 * those of overlays. Keys that an instance does not write or that it moves (struct zs_depth_state)
 * are taken as they are. In a frame of passes, all keys count as those of the camera given here.
 * Fog behind transparent layers, and fog in a mirror: zs_pass.early lets it come before the layers
 * or the mirror's pass, and struct zs_layered (zs_blend.h) gives layers fog of their own.
 *
 * Distance is that along the view axis, as of the planes near and far.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_FOG_H
#define ZS_FOG_H

#include "zstrip.h"

ZS_C_BEGIN

enum zs_fog_curve {
    ZS_FOG_LINEAR = 0,     /* none up to start, full from end on */
    ZS_FOG_EXPONENTIAL = 1 /* none up to start, then 1 - exp(-t), t = (distance - start) / (end -
                              start): at end, 1 / e of the surface's colour is left */
};

enum zs_fog_sky {
    ZS_FOG_SKY = 1,     /* where nothing was drawn: the fog's colour; else what there is */
    ZS_FOG_WINDOWS = 2, /* the hook comes before a pass with zs_mask_window: the key 65534 is where
                           nothing was drawn */
    ZS_FOG_MASKED = 4   /* the hook is that of a pass with zs_mask_window: the key 0 is beside the
                           windows, and left as it is */
};

#define ZS_FOG_LEVELS 64u

/* 152 bytes. The fields of the first part are the caller's, 0 where they are not read. */
struct zs_fog {
    uint16_t color;     /* RGB565 */
    uint8_t curve;      /* enum zs_fog_curve */
    uint8_t sky;        /* enum zs_fog_sky, or-ed */
    int32_t start, end; /* world units from the eye, any sign; start < end */

    uint16_t from[ZS_FOG_LEVELS + 2u]; /* the least key of each level, and the end; by zs_fog_set */
    uint32_t before[2];                /* a hash of the above, in the last frame */
};

/* Compute the keys at which the fog grows by 1/64, from the mapping itself. Call it again when a
 * field of fog, the camera's projection or planes, or the configuration changes.
 *
 * config   the renderer's: mapping, depth bits and frame size are read.
 * camera   that of the scene; its place does not matter.
 * Error    of a pixel's fog, against that of the distance its key stands for: 1/128 (rounding to
 *          64ths) and the change of fog over 0.03 of a bucket of the depth mapping, and over
 *          2^-28 R of the distance, where it is full R times as far away as near. Then mixed to
 *          the nearest code.
 * Cost     14,000 instructions on a Cortex-M3, exponential 37,000; 564 bytes of stack.
 * Return   ZS_OK; ZS_ERR_NULL; ZS_ERR_RANGE (start, end or curve; or an orthographic camera
 *          whose sub-pixels are too fine for what is as far away as the end); ZS_ERR_DEPTH (the
 *          mapping has no depth memory, or cannot take this camera); ZS_ERR_CAMERA, ZS_ERR_NEAR,
 *          as zs_frame_begin: fog is untouched, but for what the caller set. */
ZS_NODISCARD int zs_fog_set(struct zs_fog *fog, const struct zs_config *config,
                            const struct zs_camera *camera);

/* The functions of a struct zs_resolve; ctx is the struct zs_fog. Cost of drawing, Cortex-M3: 22 to
 * 26 instructions a pixel, 14 where nothing was drawn. 1.2 KB of flash. */
void zs_fog_draw(void *ctx, const struct zs_target *target);
int zs_fog_changes(void *ctx, struct zs_rect *rect); /* all, when it is no longer the same fog;
                                    a struct zs_fog for each renderer with zs_damage_track */

/* Give a layer (zs_blend.h) fog of its own, at each pixel by its key before a depth state moves it;
 * a hook sees the keys of what is behind a layer. Drawn under the depth buffer, zs_method_hiz and
 * zs_method_transparent; other methods draw without it. zs_layer_door needs none, as it writes
 * keys.
 * layer  set (zs_layered_set)
 * fog    set (zs_fog_set); kept; NULL: no fog again. With zs_layer_add the fog is black: it takes
 *        light away. */
struct zs_layered;
void zs_layered_fog(struct zs_layered *layer, const struct zs_fog *fog);

ZS_C_END

#endif
