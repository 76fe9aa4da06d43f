/* `zsim render --panel`: strips through a panel's driver and bus into the model of its controller, and what is seen
 * on the glass then.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_PANEL_FRAME_H
#define SIM_PANEL_FRAME_H

#include "panel.h"
#include "panel_bus.h"
#include "zstrip.h"

struct sim_panel_wish {
    const char *name; /* "st7789:240x240"; NULL: no panel */
    int turns;        /* quarter turns clockwise */
    int invert, bgr;  /* flags, of glass and driver alike */
};

struct sim_panel_frame {
    struct pm_glass glass;
    struct pm_model *model;
    struct sim_panel_bus bus;
    struct panel panel;
    void *scratch;
    struct pm_counts setup; /* what panel_init took */
    int err;                /* of the driver or bus, where a strip could not be sent */
};

/* The panels there are, for help texts: lines of less than 100 columns, all but the first behind `indent` blanks.
 * Static storage. */
const char *sim_panel_list(int indent);

/* The driver's config and the glass for a wish. SIM_OK; SIM_REFUSED, said why about `file`, here and below. */
int sim_panel_of(const struct sim_panel_wish *wish, const char *file, struct panel_config *config,
                 struct pm_glass *glass);

/* Is a strip height one that the panel takes, for a picture of `height` rows? SIM_OK; SIM_REFUSED, said why. */
int sim_panel_check_strip(const struct sim_panel_wish *wish, const char *file, long rows, long height);

/* Set a panel up for strips of `rows` rows. SIM_OK; SIM_REFUSED, said why. sim_panel_free in either case. */
int sim_panel_begin(struct sim_panel_frame *p, const struct sim_panel_wish *wish, const char *file, uint32_t rows);
void sim_panel_free(struct sim_panel_frame *p);

/* A sink whose strips go to the panel; ctx is p. */
struct zs_sink sim_panel_sink(struct sim_panel_frame *p);

/* Did the controller understand all of it? SIM_OK; SIM_REFUSED with the model's first sentence. */
int sim_panel_check(const struct sim_panel_frame *p, const struct sim_panel_wish *wish, const char *file);

/* What the viewer sees, malloc'ed: three 8-bit channels a pixel, rows of the picture from the top. */
uint8_t *sim_panel_picture(const struct sim_panel_frame *p);

#endif
