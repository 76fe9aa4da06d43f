/* Frames of the demo scenes, of showpieces (firmware/scenes/pieces) as well.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_DEMO_FRAME_H
#define SIM_DEMO_FRAME_H

#include "frame.h"
#include "method_names.h"
#include "pieces.h"

/* All that can be drawn: demo and bench scenes, then showpieces, then a user's own scene, where there is one. */
uint32_t sim_demo_count(void);
const struct demo *sim_demo_at(uint32_t i);
const char *sim_demo_name(const struct demo *demo);  /* what it is asked for by: its name, or an own scene's file */
const struct demo *sim_demo_named(const char *name); /* NULL: there is none */

/* From here on *demo, which is borrowed, is the user's own scene. name: its file. */
void sim_demo_own(const struct demo *demo, const char *name);
int sim_demo_is_own(const struct demo *demo);

/* The piece that a scene is; NULL: a scene without effects. */
const struct piece *sim_demo_piece(const struct demo *demo);

/* Where a camera stands, beside where it would: angles in radians about the middle of what is there, up by pitch, and
 * its distance as a factor. */
struct sim_orbit {
    double yaw, pitch, distance;
};
#define SIM_ORBIT_HOME { 0.0, 0.0, 1.0 }
#define SIM_ORBIT_LEAST 0.1 /* distances that zsim takes */
#define SIM_ORBIT_MOST 8.0

/* Fill *f as demo->pose does, and move its camera: of a piece before what depends on it, as mirrors do. */
void sim_demo_pose(struct demo_frame *f, const struct demo *demo, uint32_t t, uint16_t w, uint16_t h,
                   const struct sim_orbit *by);

/* The method of that number, of sim_methods, or the one that a piece needs. */
void sim_demo_method(struct zs_config *config, const struct demo *demo, int method);

/* As sim_frame_render_to, of what demo->pose has filled, in passes where the scene has some. config has its method. */
int sim_demo_render(struct sim_frame *frame, const struct demo *demo, const struct demo_frame *f,
                    const struct zs_config *config, const char *what, const struct zs_sink *to);

#endif
