/* Solomon Systech's OLED controllers: SSD1351, SSD0323, SSD1306. Not for users.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_SOLOMON_H
#define SIM_SOLOMON_H

#include "inside.h"

struct solomon_command {
    uint8_t code, last; /* codes from .. to */
    const char *name;
    uint8_t n_args;
};

struct solomon_type {
    const struct solomon_command *command;
    size_t n_commands;
    uint8_t args_low;    /* 1: arguments come with D/C low, and data goes into the RAM at any time */
    uint8_t coms;        /* rows that it can drive */
    uint8_t turns_whole; /* 1: a reversed scan counts from the last COM; 0: from the last of the multiplex ratio */
    void (*run)(struct pm_model *m, uint8_t code, const uint8_t *args); /* a command with all its arguments */
    void (*data)(struct pm_model *m, uint8_t byte);                     /* a byte into the RAM */
};

enum solomon_show { SHOW_RAM, SHOW_ALL, SHOW_NONE, SHOW_NEGATIVE };

struct solomon {
    const struct solomon_command *now; /* whose arguments come, or which came last; NULL: none, or unknown */
    uint64_t now_at;
    uint8_t code;
    unsigned n_args;
    uint8_t arg[64];
    uint8_t any, told;      /* flags: a command came; data that went nowhere was told of */
    uint8_t writing, moved; /* flags: data goes into the RAM; an address was set since the last data */
    uint8_t on;
    enum solomon_show show;
    uint8_t x0, x1, y0, y1; /* window, in columns and rows (SSD1306: pages) */
    int x, y;               /* of the next byte or pixel */
    uint8_t downwards;      /* flag: the address steps rows first */
    uint8_t remap;          /* A0's argument; SSD1306: 1 where columns are remapped */
    uint8_t reversed;       /* flag: the scan goes from the last COM to the first */
    uint8_t split;          /* flag: odd and even COMs on different sides */
    uint8_t sides;          /* flag: and the sides changed over */
    uint8_t start, offset, rows; /* start line, display offset, multiplex ratio */
    struct pm_light light;
    uint8_t part[3];
    unsigned n_part;
    uint8_t locked;         /* SSD1351: 1 commands of FDh B1h, 2 all */
    uint8_t paged, pump;    /* SSD1306: page addressing; charge pump on */
    uint8_t fill;           /* SSD0323: rectangles are filled */
};

/* After RESET the window is all of so many columns and rows (or pages), and all COMs are driven. */
void solomon_reset(struct pm_model *m, int columns, int rows);
void solomon_byte(struct pm_model *m, uint8_t byte, int data);
void solomon_end(struct pm_model *m, const char *how);
int solomon_lit(const struct pm_model *m);
struct pm_light solomon_light(const struct pm_model *m);

/* The row of RAM that a row of the glass shows, -1 for none; the glass is soldered for COMs that are split or not.
 * Modules here are soldered so that the reversed scan has row 0 on top. */
int solomon_ram_row(const struct pm_model *m, int glass_row, int split_as_wired);

/* What is shown for a value of the RAM, whose largest is `all`. */
uint32_t solomon_shown(const struct pm_model *m, uint32_t value, uint32_t all);

/* Note that the last command's argument is wrong: "COMMAND 0xNN what". */
void solomon_wrong(struct pm_model *m, const char *what, unsigned argument);

/* Switch between what is shown (0xA4 to 0xA7, by the lowest two bits), and on or off (0xAE, 0xAF). Return 0: the
 * command is another one. */
int solomon_switch(struct solomon *s, uint8_t code, const enum solomon_show shows[4]);

/* Set a window's two ends, with checks; and step the address inside of it. */
void solomon_window(struct pm_model *m, int is_row, uint8_t from, uint8_t to, int limit);
void solomon_step(struct solomon *s);

#endif
