/* What the parts of the panel model share. Not for users.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_INSIDE_H
#define SIM_INSIDE_H

#include "panel_model.h"

/* A controller. Colours are 0xRRGGBB, grey levels 0 .. 15, one bit 0 or 1: `value` below. */
struct pm_type {
    const char *name;
    uint16_t ram_w, ram_h; /* px */
    enum pm_format format;
    uint32_t reset_us;  /* from RESET to the first command */
    size_t state_bytes; /* of its registers, zeroed */
    void (*reset)(struct pm_model *m);
    void (*byte)(struct pm_model *m, uint8_t byte, int data);
    void (*end)(struct pm_model *m, const char *how); /* "the stream ends", "RESET comes": inside of what? */
    int (*lit)(const struct pm_model *m);
    uint32_t (*seen)(const struct pm_model *m, int x, int y); /* value at a pixel of the glass, lit */
    struct pm_light (*light)(const struct pm_model *m);
    const void *of; /* what else those functions know it by: its dcs_type or solomon_type */
};

extern const struct pm_type pm_type_st7789, pm_type_ili9341, pm_type_gc9a01, pm_type_ssd1351, pm_type_ssd0323,
    pm_type_ssd1306;

struct pm_model {
    struct pm_glass glass;
    const struct pm_type *type;
    void *state;    /* the type's */
    uint32_t *ram;  /* [ram_h][ram_w] values */
    struct pm_counts counts;
    struct pm_problem *problem;
    size_t n_problems, room;
    uint64_t at;      /* number of the byte that is being taken */
    int level;        /* D/C of the last byte; -1: a run begins with the next one */
    int timed;        /* pm_elapsed was called */
    uint32_t owed_us;       /* to pass before the next command */
    uint32_t sleep_owed_us; /* MIPI DCS: and before the next SLPIN or SLPOUT */
};

/* Note a problem at a byte; "byte N: " is put before the sentence. */
void pm_note(struct pm_model *m, enum pm_problem_kind kind, uint64_t at, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* Note it where a window's ends, of n columns or rows, are not in order or reach beyond them: "WHAT from ..." */
void pm_check_window(struct pm_model *m, uint64_t at, const char *what, int start, int end, int n);

/* A command byte begins: counts it, and checks that it is not too early. */
void pm_command_begins(struct pm_model *m, const char *name);

uint32_t *pm_ram_at(struct pm_model *m, int x, int y); /* x, y inside the RAM */
uint32_t pm_ram_get(const struct pm_model *m, int x, int y);

#endif
