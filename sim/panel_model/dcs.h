/* Controllers with the MIPI display command set: ST7789, ILI9341, GC9A01. Not for users.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_DCS_H
#define SIM_DCS_H

#include "inside.h"

struct dcs_command {
    uint8_t code;
    const char *name;    /* of the datasheet */
    uint8_t least, most; /* arguments */
};

#define DCS_KEPT 6 /* argument bytes of a command that registers keep */

/* What differs between them. */
struct dcs_type {
    const struct dcs_command *command; /* its own, beside those that all have */
    size_t n_commands;
    uint8_t bits_12;           /* 1: takes 12-bit pixels */
    void (*defaults)(uint8_t reg[256][DCS_KEPT]); /* of its own registers; may be NULL */
    uint8_t (*madctl)(const uint8_t reg[256][DCS_KEPT]); /* as it works after its own bits */
    int (*inverts)(const uint8_t reg[256][DCS_KEPT]);    /* 1: its own bits swap INVON and INVOFF; may be NULL */
    /* Which line of the RAM a row of gates shows, -1 for none; which column a source line shows. May be NULL. */
    int (*line)(const uint8_t reg[256][DCS_KEPT], int row, int rows);
    int (*column)(const uint8_t reg[256][DCS_KEPT], int column, int columns);
    int (*little_endian)(const uint8_t reg[256][DCS_KEPT]);
    int (*drops_excess)(const uint8_t reg[256][DCS_KEPT]); /* 1: pixels beyond the window's end do not wrap */
    /* Checks of its own when a command is complete: a sentence, or NULL. */
    const char *(*wrong)(uint8_t code, const uint8_t reg[256][DCS_KEPT]);
};

struct dcs {
    const struct dcs_type *type;
    const struct dcs_command *now; /* whose arguments come; NULL: none, or one that is not known */
    uint64_t now_at;               /* byte of that command */
    unsigned n_args;
    uint8_t any;                   /* flag: a command came since the reset */
    uint8_t reg[256][DCS_KEPT];    /* arguments by command */
    uint8_t awake, on, inverse, idle, partial, scrolling; /* flags */
    uint8_t writing;               /* flag: data goes into the RAM */
    uint8_t told;                  /* flag: of data that went nowhere since the last command */
    uint8_t moved;                 /* flag: an address was set since the last memory write */
    uint8_t part[3];               /* of a pixel */
    unsigned n_part;
    uint8_t nibble;                /* flag: 12 bits: the second half of part[0] is left over */
    int column, page;              /* of the next pixel */
    uint8_t full;                  /* flag: the window's end was passed and excess is dropped */
};

/* The functions of a pm_type. */
void dcs_reset(struct pm_model *m);
void dcs_byte(struct pm_model *m, uint8_t byte, int data);
void dcs_end(struct pm_model *m, const char *how);
int dcs_lit(const struct pm_model *m);
uint32_t dcs_seen(const struct pm_model *m, int x, int y);
struct pm_light dcs_light(const struct pm_model *m);

/* What follows a pm_type's reset_us: their state, these functions, and the dcs_type. */
#define DCS_MODEL(type) sizeof(struct dcs), dcs_reset, dcs_byte, dcs_end, dcs_lit, dcs_seen, dcs_light, &type

#endif
