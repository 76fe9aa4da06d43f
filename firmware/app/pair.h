/* Two renderers draw each frame together, one on each core (hal/second.h): each bins a part of the scene (zs_share.h),
 * and draws whichever strip is next when it has a buffer free. A sink gets all strips in their order, and the picture
 * is the one that one renderer draws, bit for bit.
 *
 * All of the sink's calls come in an interrupt of the first core: a strip is begun as soon as the one before it is out
 * and it is drawn, whatever that core is drawing itself. Each of the sink's transfers must end in pair_arrived, after
 * submit has returned: hooks.done of a bus with DMA. A panel's hooks.lock and hooks.unlock (hal.h) come in that
 * interrupt too, and must not block. Where the second core does not start, or stops (but in the few lines that hold
 * second.h's lock), the first one draws alone.
 *
 * One pair in a program; static storage, 2.5 KB but for the arenas. All functions but pair_arrived are for the first
 * core, and not for interrupts.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef PAIR_H
#define PAIR_H

#include "zstrip.h"

#define PAIR_ERR_STOPPED (-141)   /* the second core got no further; it is in reset now */
#define PAIR_PATIENCE_US 2000000u /* after so long with nothing drawn and nothing sent, in the middle of a frame */

/* Set both renderers up and start the second core.
 *
 * config  of either, copied. arena: one for each, `bytes` of them, as for zs_init.
 * sink    copied. submit begins a transfer; wait is called after pair_arrived alone, and must not block. end is not
 *         called: strips of a frame leave while the next one is drawn.
 * Return  ZS_OK, also where the second core did not start: pair_alone; zs_init's errors. */
int pair_init(const struct zs_config *config, uint32_t *const arena[2], uint32_t bytes, const struct zs_sink *sink);

/* Draw a frame. Its last strips may be out, or wait for it, when this returns; they go on leaving.
 *
 * scene, camera  borrowed until the return, read by both cores.
 * Return  ZS_OK; zs_frame_begin's errors; an error of the sink, also for a strip of the frame before; PAIR_ERR_STOPPED.
 *         After an error nothing is out, and the rest of the frame is dropped. */
int pair_frame(const struct zs_scene *scene, const struct zs_camera *camera);

/* Wait until every strip is out. Return ZS_OK, or the sink's error. */
int pair_flush(void);

/* What the sink has begun has ended, well or not. From an interrupt. */
void pair_arrived(void);

/* 1: the first core draws alone. */
int pair_alone(void);

/* Ticks (hal_ticks) that a core (0, 1) has spent on drawing since pair_init, interrupts and waiting not counted. */
uint64_t pair_ticks(uint32_t core);

/* Ticks that the first core has waited for buffers, the sink and the other core. */
uint64_t pair_waited(void);

/* Of the first core's renderer: it draws a share of the strips. */
const struct zs_stats *pair_stats(void);

#endif
