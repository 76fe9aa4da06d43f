/* What `zsim demo` is asked for.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_DEMO_OPTIONS_H
#define SIM_DEMO_OPTIONS_H

#include "accelerator_names.h"
#include "demo_frame.h"
#include "false_colors.h"
#include "method_names.h"
#include "option_table.h"
#include "panel_frame.h"
#include "scenes.h"

struct sim_demo_request {
    const char *out, *scenes;           /* folder; names with commas between, or NULL for all */
    long size[2], strip, subpixel;      /* size: a panel's picture's; without has_size, the scene's own */
    double orbit[3];                    /* degrees to the right, degrees up, distance; without has_orbit, none */
    long start, step, frames;           /* frames start, start + step ...; at most so many of each scene, 0: all */
    const char *fast_names;             /* NULL: all */
    const char *moving;                 /* NULL: no moving picture */
    long delay;                         /* of its frames, ms */
    struct sim_fast fast;               /* accelerators, which it names */
    enum sim_show show;
    int method;                         /* of sim_methods */
    struct sim_panel_wish panel;
    int has_size, has_orbit, raw, help; /* flags */
};

struct sim_demo_size {
    uint16_t width, height;
};

extern const struct sim_demo_request sim_demo_usual;

/* Fill in what the arguments after "demo" say; after --help nothing is looked at. Return enum sim_status, said why. */
int sim_demo_parse(struct sim_demo_request *rq, int argc, char **argv);

/* Where the camera stands, beside where it would. */
struct sim_orbit sim_demo_orbit(const struct sim_demo_request *rq);

/* Print --help. */
void sim_demo_help(void);

/* 1: a scene is asked for. */
int sim_demo_wanted(const struct sim_demo_request *rq, const struct demo *demo);

/* The size of its frames, px; how many are drawn; and which frame of the animation the k-th of them is. */
struct sim_demo_size sim_demo_size_of(const struct sim_demo_request *rq, const struct demo *demo);
uint32_t sim_demo_frames(const struct sim_demo_request *rq, const struct demo *demo);
uint32_t sim_demo_frame_number(const struct sim_demo_request *rq, uint32_t k);

#endif
