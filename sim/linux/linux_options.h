/* The command line of zstrip-linux.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_LINUX_OPTIONS_H
#define SIM_LINUX_OPTIONS_H

#include "model.h"
#include "panel_frame.h"

/* Strings point into argv; NULL: not given. */
struct linux_options {
    struct sim_panel_wish panel;
    const char *spi, *dc, *reset, *backlight, *te; /* as in struct linux_wiring */
    const char *scene, *model;                     /* one of them */
    long speed;                                    /* Hz */
    long mode;                                     /* of SPI */
    long frames, step;                             /* frames 0: for ever, by the clock */
    long strip, subpixel;
    long size[2];                                  /* px, of the picture */
    struct sim_limits limits;                      /* of loading the model */
    int has_speed, has_step;
    int partial, stats, dry_run, help;             /* flags */
};

/* Fill *o. SIM_OK; SIM_USAGE, SIM_REFUSED, said why. With o->help nothing else counts. */
int linux_options_parse(struct linux_options *o, int argc, char **argv);

/* To stdout. */
void linux_options_help(void);

#endif
