/* Frames of one size as an animated PNG or a GIF that repeats for ever, or as an MP4.
 *
 * Both hold, of each frame, the smallest rectangle that has changed. A PNG is lossless; programs that do not know
 * animated ones show its first frame. A GIF has one palette of 256 colours, chosen from up to 16 of the frames.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_MOVING_PICTURE_H
#define SIM_MOVING_PICTURE_H

#include <stdint.h>
#include <stdio.h>

#include "output_file.h"

#define SIM_MOVING_SIDE_MAX 65535 /* px */

/* Frames, which are borrowed. All fields count. */
struct sim_moving {
    uint32_t width, height; /* px, 1 .. SIM_MOVING_SIDE_MAX */
    uint32_t n_frames;      /* at least 1 */
    uint32_t delay_ms;      /* of a frame, 10 .. 65535; a GIF rounds it to 10 ms */
    uint8_t *const *frame;  /* [n_frames], each [height][width][3] */
};

/* Write to an open stream. name is for messages. SIM_OK; SIM_REFUSED, said why. */
int sim_moving_png(FILE *f, const char *name, const struct sim_moving *m);
int sim_moving_gif(FILE *f, const char *name, const struct sim_moving *m);

/* An MP4 of all frames, once, in place of the file at path. Its codec loses some of the colours. */
int sim_moving_mp4(const char *path, const char *name, const struct sim_moving *m);

/* The same into an open output, which the caller ends: a GIF or an MP4 where its name ends so. */
int sim_moving_write(const struct sim_output *out, const struct sim_moving *m);

/* The same into a file, whole or not at all. */
int sim_moving_save(const char *path, const struct sim_moving *m);

#endif
