/* A panel on a Linux machine, from user space: D/C, RESET, the backlight and an input through libgpiod, bytes through
 * spidev. Besides hal.h's functions:
 *
 *   static const struct linux_wiring wiring = { "/dev/spidev0.0", 32000000, 0, "GPIO25", "GPIO27", "GPIO18", NULL };
 *   linux_wire(&wiring);
 *   if (hal_init())
 *       puts(linux_why());
 *
 * An ordinary user in the groups gpio and spi may do all of it. Lines are requested once, by hal_init, and held until
 * linux_close: a line that is given back may lose its level.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef LINUX_H
#define LINUX_H

#include <stdint.h>
#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A line is named
 *   NAME        as the machine's device tree names it ("GPIO25"); there must be one of that name;
 *   CHIP:LINE   CHIP a number, "gpiochip0", a path or the chip's label, LINE its number there or its name;
 *   NULL        where there is none. The panel needs D/C. */
struct linux_wiring {
    const char *spi;           /* "/dev/spidev0.0": SPI 0, chip select 0 */
    uint32_t hz;               /* of its clock, > 0; the controller takes what it has next below */
    uint8_t mode;              /* 0, or 3 for modules without a CS pin */
    const char *dc, *reset;    /* outputs; RESET is active low */
    const char *backlight;     /* output, high is light */
    const char *te;            /* input whose rising edges are waited for: tearing effect, or a button */
};

/* What hal_init is to open. wiring and its strings are borrowed for the life of the process. */
void linux_wire(const struct linux_wiring *wiring);

/* Why hal_init, the bus or a function here failed last: one sentence with its cure. Static storage; not while data
 * is out. "" before any failure. */
const char *linux_why(void);

/* Wait for the next rising edge of the input; edges from before the call do not count.
 * Blocks  at most so many ms; a signal that is handled ends it early.
 * Return  1: an edge; 0: none; HAL_ERR_STATE: there is no input; HAL_ERR_BUS. */
int linux_wait_edge(uint32_t ms);

/* What went over the wire since hal_init, panel_init's bytes included. Not while data is out. */
struct linux_sent {
    uint64_t bytes, messages; /* messages: ioctls */
    uint64_t us;              /* spent in them */
    uint64_t last_from, last_to; /* hal_ticks of the last command or data */
};
struct linux_sent linux_sent(void);

/* Wait for data that is out, put the light out, give lines and devices back. hal_exit does it too. Again: no effect. */
void linux_close(void);

/* Say what hal_init would open, by looking only: nothing is requested, nothing is sent. (libgpiod itself opens a chip's
 * device for reading and writing; lines stay as they are.)
 * Return  HAL_ERR_NONE; else the code that hal_init would return, linux_why says why of the first thing that failed. */
int linux_describe(FILE *to);

/* All lines of all chips that this user may look at, one a line, with their names and who holds them. */
void linux_list_lines(FILE *to);

#ifdef __cplusplus
}
#endif

#endif
