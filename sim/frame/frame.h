/* A whole frame from the renderer, the way a board gets it: strips through a sink.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_FRAME_H
#define SIM_FRAME_H

#include "zstrip.h"

struct sim_frame {
    uint16_t width, height;
    uint16_t *rgb565;      /* [height][width], values in the host's byte order */
    uint16_t *key;         /* [height][width], depth keys; ZS_DEPTH_CLEAR: nothing drawn. Without keys all are 0,
                              until sim_frame_cover */
    int no_depth, no_keys; /* flags: there was no depth memory; or none that held keys */
    struct zs_stats stats; /* of the frame */
    uint32_t arena_bytes;
};

/* A sound configuration: strips of 16 rows, two buffers, 8 sub-pixel bits, 16-bit float depth,
 * all accelerators, and pools that are as large as they may be. attrs: ZS_VARYINGS_FLAT or ZS_VARYINGS_SMOOTH. */
void sim_frame_config(struct zs_config *config, uint16_t width, uint16_t height, uint8_t attrs);

/* 1: the method or mapping leaves no depth keys to look at. */
int sim_frame_no_keys(const struct zs_config *config);

/* Draw a frame through zs_render into buffers of its own. The arena is filled with rubbish first,
 * colours are fetched as late as the sink's contract allows, and a strip that changes before that
 * is an error.
 *
 * frame   any state; on ZS_OK it owns memory (sim_frame_free), else it is empty.
 * what    names the job to sim_progress, or NULL for silence.
 * Return  ZS_OK, an enum zs_err, or SIM_FRAME_BROKEN. */
int sim_frame_render(struct sim_frame *frame, const struct zs_scene *scene,
                     const struct zs_camera *camera, const struct zs_config *config,
                     const char *what);
void sim_frame_free(struct sim_frame *frame);

/* The same, and every strip goes to another sink too: its submit is called from the frame's and borrows the strip
 * until its wait, called from the frame's. A negative return of it ends the frame and is returned. to may be NULL. */
int sim_frame_render_to(struct sim_frame *frame, const struct zs_scene *scene, const struct zs_camera *camera,
                        const struct zs_config *config, const char *what, const struct zs_sink *to);

/* The same for what is not one scene in one pass: draw is called once, with a renderer that is set up by config and a
 * sink for strips of a frame of width x height. It returns ZS_OK or an error. */
struct sim_drawing {
    int (*draw)(void *ctx, struct zs_renderer *r, const struct zs_sink *sink);
    void *ctx;
    uint16_t width, height; /* px, of the frame that the sink gets */
    int no_keys;            /* flag: its strips have no depth keys */
};
int sim_frame_render_by(struct sim_frame *frame, const struct sim_drawing *drawing, const struct zs_config *config,
                        const char *what, const struct zs_sink *to);

/* The same by n threads, each of which draws a share of the strips, or, where triangles are many beside the pixels, of
 * the triangles, by a renderer and an arena of its own. Of the statistics triangles are counted once, vertices, set-ups
 * and pixels are the sum, passes and pools the largest; arena_bytes are one arena's. The time is that of drawing,
 * without setting arenas up. */
#define SIM_THREADS_MAX 64
struct sim_frame_time {
    double wall, busiest; /* seconds: on the clock; of the processor, of the thread that took most */
    uint32_t parts;       /* that the triangles were drawn in; 0: strips were shared out */
};
int sim_frame_render_threads(struct sim_frame *frame, const struct zs_scene *scene, const struct zs_camera *camera,
                             const struct zs_config *config, uint32_t n,
                             struct sim_frame_time *time);

#define SIM_FRAME_BROKEN (-101) /* strips came out of order, too early or with holes */

/* The number + 1 of the triangle that is seen at every pixel, counted through the scene's instances
 * in order; 0 where there is none. id: [height][width]. Two frames in raw colours (one up to 65,535
 * triangles) with the same geometry, camera and profile. Return as sim_frame_render. */
int sim_frame_ids(uint32_t *id, const struct zs_scene *scene, const struct zs_camera *camera,
                  const struct zs_config *config);

/* For a frame without keys: keys of pixels on which nothing was drawn become ZS_DEPTH_CLEAR. id: of the same
 * frame, by sim_frame_ids. */
void sim_frame_cover(struct sim_frame *frame, const uint32_t *id);

/* Pixels of a frame that something was drawn on. */
uint32_t sim_frame_visible(const struct sim_frame *frame);

#endif
