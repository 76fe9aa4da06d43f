/* A display controller from the outside: bytes with their D/C level in, the picture of the glass out.
 *
 * The judge of the panel drivers: written from the controllers' datasheets (each file names its one), knowing nothing
 * of hal/ or firmware/. It follows the whole documented command set, with argument counts, so that other people's
 * streams can be read too. What a controller would not have understood becomes a problem, one sentence with the
 * number of its byte; decoding goes on as the controller would.
 *
 *   struct pm_glass glass;
 *   pm_glass_named(&glass, "st7789:240x240");
 *   struct pm_model *model = pm_new(&glass);
 *   pm_reset(model);
 *   pm_byte(model, 0x11, 0);            a command: D/C low
 *   ...
 *   pm_end(model);
 *   pm_picture(model, rgb, raw);
 *
 * RAM holds noise when power comes on and is not touched by resets, as in the controllers.
 * Not modelled: time (but for pm_elapsed), reading, voltages, gamma, frame rates, RGB and VSYNC interfaces, tearing.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_PANEL_MODEL_H
#define SIM_PANEL_MODEL_H

#include <stddef.h>
#include <stdint.h>

enum pm_controller { PM_ST7789, PM_ILI9341, PM_GC9A01, PM_SSD1351, PM_SSD0323, PM_SSD1306 };
enum pm_format { PM_RGB565, PM_GREY4, PM_MONO };

/* A sheet of glass on a controller, as its module is built. */
struct pm_glass {
    enum pm_controller controller;
    uint16_t width, height; /* px, upright as the module is mounted: ST7789 with MADCTL 00, ILI9341 with 40, GC9A01
                               with 00 after B6 00 20; SSD1351 with A0 74, SSD0323 with A0 52, SSD1306 with A1 C8 */
    int16_t x0, y0;         /* its first column and row, counted as in the controller's RAM; y0 of Solomon's: the COM
                               that its lowest row is on */
    uint8_t inverted;       /* 1: shows the negative unless told to invert (IPS) */
    uint8_t bgr;            /* 1: blue where the controller has red */
    uint8_t mirrored;       /* 1: the controller's first column is on the right */
    uint8_t sequential;     /* SSD1306: 1: rows are on the COM pins in their order, else odd and even in turn */
};

/* "NAME:WxH" of the table of known modules. 1; 0: unknown, *glass is as it was. */
int pm_glass_named(struct pm_glass *glass, const char *name);
/* All of that table: "st7789:240x240, ...". Static storage. */
const char *pm_glass_list(void);
enum pm_format pm_glass_format(const struct pm_glass *glass);

struct pm_model;

/* A module, powered on. malloc'ed, pm_free. NULL: the glass does not fit the RAM, or no memory. */
struct pm_model *pm_new(const struct pm_glass *glass);
void pm_free(struct pm_model *model);

void pm_reset(struct pm_model *model);                             /* RESET is pulled low and released */
void pm_byte(struct pm_model *model, uint8_t byte, int data);      /* data: D/C, 1 high */
void pm_deselect(struct pm_model *model);                          /* chip select goes high */
/* us microseconds pass. From the first call on, a command that comes earlier after a reset or after waking than the
 * datasheet allows is a problem; a stream without times is not held to that. */
void pm_elapsed(struct pm_model *model, uint32_t us);
/* The stream ends: what is unfinished becomes a problem. */
void pm_end(struct pm_model *model);

/* ---- What is seen ------------------------------------------------------------------------------------- */

/* 1: the glass shows its RAM; 0: it is dark. */
int pm_lit(const struct pm_model *model);

/* The glass, [height][width]. rgb: three 8-bit channels (RGB565 by repeating the bits, grey levels * 17, one bit 0 or
 * 255); raw: RGB565, level 0 .. 15, or 0 and 1. Both as seen, black where it is dark. Either may be NULL. */
void pm_picture(const struct pm_model *model, uint8_t *rgb, uint16_t *raw);

/* Contrast or brightness as set; one register, SSD1351: A, B, C and the master's four bits; MIPI DCS: what the
 * controller puts out on its pin for a backlight, 0 where that is not on. It does not change pm_picture. */
struct pm_light {
    uint8_t level[4];
};
struct pm_light pm_light(const struct pm_model *model);

/* A picture of the glass as its viewer sees it who has turned the glass so that pictures sent with `rotate` quarter
 * turns stand upright: with rotate 1 the glass's right column is the viewer's top row. n_bytes a pixel.
 * from: [height][width] of the glass; to: [height][width] for even `rotate`, else [width][height]. */
void pm_view(const struct pm_glass *glass, int rotate, const void *from, void *to, size_t n_bytes);

/* ---- What went over the wire -------------------------------------------------------------------------- */

struct pm_counts {
    uint64_t bytes;        /* all */
    uint64_t command_bytes, data_bytes; /* D/C low and high */
    uint64_t transactions; /* runs of bytes in which D/C stays, chip select stays low and no RESET comes */
    uint64_t commands;     /* commands, with or without arguments */
    uint64_t windows;      /* memory writes before which an address was set */
    uint64_t pixel_bytes;  /* data bytes taken as pixels */
    uint64_t pixels;       /* written into the RAM; those of one-bit and grey panels by the byte: 8 and 2 */
    uint64_t resets;       /* by RESET */
};
const struct pm_counts *pm_counts(const struct pm_model *model);

enum pm_problem_kind {
    PM_UNKNOWN,   /* not a command of this controller */
    PM_COUNT,     /* too few or too many arguments */
    PM_TRUNCATED, /* the stream ends, or RESET comes, inside a command */
    PM_OUTSIDE,   /* data outside a memory write, or a command byte where an argument belongs */
    PM_WINDOW,    /* addresses out of the RAM, or their end before their start */
    PM_ODD,       /* a pixel without all its bytes */
    PM_VALUE,     /* an argument that the datasheet does not allow, or that takes the picture off the glass */
    PM_STATE      /* too early, locked, or asleep */
};
struct pm_problem {
    enum pm_problem_kind kind;
    uint64_t at;    /* byte of the stream, counted from 0; at the end of the stream, its length */
    char text[160]; /* one sentence without a full stop, "byte 17: ..." */
};
/* All problems so far, at most 1000; *problems is the model's, until its next call. Of one cause in a row only the
 * first is kept. */
size_t pm_problems(const struct pm_model *model, const struct pm_problem **problems);

#endif
