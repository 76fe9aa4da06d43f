/* --panel of `zsim render` and `zsim demo`: strips through a panel's driver and bus into the model of its controller,
 * and what is seen on the glass then.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_PANEL_FRAME_H
#define SIM_PANEL_FRAME_H

#include "image.h"
#include "option_table.h"
#include "panel.h"
#include "panel_bus.h"
#include "zstrip.h"

struct sim_panel_wish {
    const char *name; /* "st7789:240x240"; NULL: no panel */
    int turns;        /* quarter turns clockwise */
    int invert, bgr;  /* flags, of glass and driver alike */
    int has_turns;    /* flag: turns were asked for */
};

/* Rows of an option table: a wish, of its name in a struct. about: what --help says of --panel, before the list of
 * panels. */
#define SIM_PANEL_OPTIONS(type, wish, about)                                                                         \
    { "--panel", SIM_OPTION_TEXT, offsetof(type, wish.name), .value = "NAME:WxH", .help = about,                     \
      .list = pm_glass_list },                                                                                       \
    { "--rotate", SIM_OPTION_CHOICE, offsetof(type, wish.turns), offsetof(type, wish.has_turns),                     \
      .words = "0|90|180|270", .help = "degrees that the picture is turned clockwise on the glass (0)" },            \
    { "--invert", SIM_OPTION_FLAG, offsetof(type, wish.invert),                                                      \
      .help = "the glass shows negatives until it is told to invert, as most IPS glass does; its driver tells it" }, \
    { "--bgr", SIM_OPTION_FLAG, offsetof(type, wish.bgr),                                                            \
      .help = "the glass has blue where the controller has red; its driver makes up for it" }

struct sim_panel_frame {
    struct pm_glass glass;
    struct pm_model *model;
    struct sim_panel_bus bus;
    struct panel panel;
    void *scratch;
    struct pm_counts setup; /* what panel_init took */
    int err;                /* of the driver or bus, where a strip could not be sent */
};

/* The glass of a wish that has a name. SIM_OK; SIM_REFUSED, said why about `file`, here and below. */
int sim_panel_glass(const struct sim_panel_wish *wish, const char *file, struct pm_glass *glass);

/* The driver's config too. */
int sim_panel_config(const struct sim_panel_wish *wish, const char *file, struct panel_config *config,
                     struct pm_glass *glass);

/* The frame for a wish: size becomes that of its panel's picture, where it has a name; has_size: it was given, and must
 * be that one. strip: rows, which the panel must take. SIM_OK, *glass is only set where there is a name; SIM_USAGE: the
 * rest of a wish without a name; SIM_REFUSED. */
int sim_panel_take(const struct sim_panel_wish *wish, const char *file, int has_size, long size[2], long strip,
                   struct pm_glass *glass);

#define SIM_PANEL_HZ 62500000 /* what ST7789 and GC9A01 take on short wires */

/* The clock of its wire where none is asked for: `fastest`, or what its datasheet allows. Hz */
long sim_panel_hz(const char *name, long fastest);

/* Set a panel up for strips of `rows` rows. SIM_OK; SIM_REFUSED, said why. sim_panel_free in either case. */
int sim_panel_begin(struct sim_panel_frame *p, const struct sim_panel_wish *wish, const char *file, uint32_t rows);
void sim_panel_free(struct sim_panel_frame *p);

/* A sink whose strips go to the panel; ctx is p. */
struct zs_sink sim_panel_sink(struct sim_panel_frame *p);

/* Did the controller understand all of it? SIM_OK; SIM_REFUSED with the model's first sentence. */
int sim_panel_check(const struct sim_panel_frame *p, const struct sim_panel_wish *wish, const char *file);

/* What the viewer sees of glass that is turned by quarter turns. sim_picture_free. */
void sim_panel_picture(struct sim_picture *p, const struct pm_model *model, const struct pm_glass *glass, int turns);

#endif
