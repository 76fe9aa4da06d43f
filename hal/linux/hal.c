/* Linux: the wiring, opened and given back; time, text, the backlight.
 *
 * SPDX-License-Identifier: MIT
 */
#define _POSIX_C_SOURCE 200809L
#include "hal.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "parts.h"

#define HZ 1000000u

enum { DC, RESET, BACKLIGHT, TE, N_LINES };
static const struct {
    const char *what;
    enum gpio_use use;
} role[N_LINES] = { { "D/C", GPIO_HIGH }, { "RESET", GPIO_HIGH }, { "backlight", GPIO_LOW }, { "TE", GPIO_EDGES } };

static const struct linux_wiring *wiring;
static struct gpio_line line[N_LINES];
static uint64_t start; /* us */
static uint8_t ready;
static char why[512];

int linux_fail(int err, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    (void)vsnprintf(why, sizeof why, format, args);
    va_end(args);
    return err;
}

int linux_fail_line(const char *what)
{
    return linux_fail(HAL_ERR_BUS, "%s: its line answers no more: %s; load its chip's driver again and start anew",
                      what, strerror(errno));
}

const char *linux_why(void)
{
    return why;
}

/* ---- Time ------------------------------------------------------------------------------------------------------- */

static uint64_t now_us(void)
{
    struct timespec t;
    (void)clock_gettime(CLOCK_MONOTONIC, &t);
    return (uint64_t)t.tv_sec * 1000000u + (uint64_t)t.tv_nsec / 1000u;
}

void linux_pause_us(uint32_t us)
{
    struct timespec left = { (time_t)(us / 1000000u), (long)(us % 1000000u) * 1000 };
    while (nanosleep(&left, &left) && errno == EINTR) {
    }
}

uint64_t hal_ticks(void)
{
    return now_us() - start;
}

uint32_t hal_tick_hz(void)
{
    return HZ;
}

uint32_t hal_tick_instructions(void)
{
    return 0;
}

/* ---- The wiring -------------------------------------------------------------------------------------------------- */

void linux_wire(const struct linux_wiring *to)
{
    wiring = to;
}

static const char *named(int i)
{
    const char *const text[N_LINES] = { wiring->dc, wiring->reset, wiring->backlight, wiring->te };
    return text[i];
}

static int check_wiring(void)
{
    if (!wiring)
        return linux_fail(HAL_ERR_STATE, "nothing is wired; call linux_wire first");
    if (!wiring->spi || !wiring->hz || (wiring->mode != 0 && wiring->mode != 3) || !wiring->dc)
        return linux_fail(HAL_ERR_ARG, "a panel needs a spidev, a clock above 0 Hz, SPI mode 0 or 3, and a D/C line");
    return HAL_ERR_NONE;
}

/* Where all lines are; each of them another. */
static int find_lines(struct gpio_place place[N_LINES])
{
    for (int i = 0; i < N_LINES; i++) {
        const int err = named(i) ? gpio_find(&place[i], role[i].what, named(i)) : HAL_ERR_NONE;
        if (err)
            return err;
        for (int k = 0; named(i) && k < i; k++)
            if (named(k) && place[k].offset == place[i].offset && !strcmp(place[k].path, place[i].path))
                return linux_fail(HAL_ERR_ARG, "%s and %s are both line %s:%u; give each its own", role[k].what,
                                  role[i].what, place[i].path, (unsigned)place[i].offset);
    }
    return HAL_ERR_NONE;
}

static void release_lines(void)
{
    for (int i = 0; i < N_LINES; i++)
        gpio_release(&line[i]);
}

/* The device first: what it is refused for leaves the lines untouched. */
static int open_all(void)
{
    struct gpio_place place[N_LINES];
    int err = find_lines(place);
    err = err ? err : linux_spi_open(wiring);
    for (int i = 0; i < N_LINES && !err; i++)
        if (named(i))
            err = gpio_take(&line[i], &place[i], role[i].what, role[i].use);
    return err ? err : linux_bus_start(&line[DC], &line[RESET]);
}

int hal_init(void)
{
    if (ready)
        return HAL_ERR_NONE;
    start = now_us();
    int err = check_wiring();
    if (err)
        return err;
    err = open_all();
    if (err) {
        release_lines();
        linux_spi_close();
    }
    ready = !err;
    return err;
}

void linux_close(void)
{
    if (!ready)
        return;
    ready = 0;
    linux_bus_stop();
    if (line[BACKLIGHT].held)
        (void)gpio_set(&line[BACKLIGHT], 0);
    release_lines();
    linux_spi_close();
}

int linux_describe(FILE *to)
{
    struct gpio_place place[N_LINES];
    int err = check_wiring();
    if (err)
        return err;
    err = find_lines(place);
    for (int i = 0; i < N_LINES && !err; i++) {
        const struct gpio_place *p = &place[i];
        if (!named(i))
            (void)fprintf(to, "%-10s none\n", role[i].what);
        else
            (void)fprintf(to, "%-10s %s:%u [%s] %s, %s%s\n", role[i].what, p->path, (unsigned)p->offset, p->label,
                          p->info.name[0] ? p->info.name : "-", p->info.used ? "held by " : "free",
                          !p->info.used ? "" : p->info.consumer[0] ? p->info.consumer : "?");
    }
    (void)fprintf(to, "%-10s %s, mode %u, %lu Hz, messages of up to %lu bytes\n", "SPI", wiring->spi, wiring->mode,
                  (unsigned long)wiring->hz, (unsigned long)linux_spi_limit());
    err = err ? err : linux_spi_look(wiring);
    for (int i = 0; i < N_LINES && !err; i++)
        if (named(i) && place[i].info.used)
            err = gpio_refuse_held(&place[i], role[i].what);
    return err;
}

int linux_wait_edge(uint32_t ms)
{
    int came;
    if (!ready || !line[TE].held)
        return HAL_ERR_STATE;
    do /* what came before */
        came = gpio_edge(&line[TE], 0);
    while (came > 0);
    if (!came)
        came = gpio_edge(&line[TE], ms);
    if (came < 0 && errno != EINTR)
        return linux_fail_line(role[TE].what);
    return came > 0;
}

struct linux_sent linux_sent(void)
{
    return linux_spi_sent();
}

/* ---- The rest of hal.h ------------------------------------------------------------------------------------------- */

void hal_exit(int status)
{
    linux_close();
    (void)fflush(stdout);
    exit(status);
}

void hal_write(const char *text)
{
    (void)fputs(text, stdout);
}

void hal_backlight(uint8_t level)
{
    if (ready && line[BACKLIGHT].held)
        (void)gpio_set(&line[BACKLIGHT], level > 0);
}

void hal_stack_paint(void)
{
}

uint32_t hal_stack_used(void)
{
    return 0;
}
