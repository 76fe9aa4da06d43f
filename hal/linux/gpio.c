/* Lines by name, by label or by number, and the sentences for those that cannot be had.
 *
 * SPDX-License-Identifier: MIT
 */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hal.h"
#include "parts.h"

#define CHIPS "gpiochip" /* how the kernel's nodes are called, before their number */

/* A walk over the chips of this machine, those that cannot be opened left out. All zero at first. */
struct walk {
    char name[DEV_NAME], path[GPIO_TEXT], label[GPIO_TEXT];
    void *chip;       /* open until the next step */
    uint32_t n_lines;
    int denied;       /* errno of the first one that could not be opened, and its path */
    char denied_path[GPIO_TEXT];
};

static void path_of(char path[GPIO_TEXT], const char *name)
{
    (void)snprintf(path, GPIO_TEXT, "/dev/%s", name);
}

/* 1: w->chip is open; 0: there are no more. */
static int step(struct walk *w)
{
    if (w->chip)
        gpio_chip_close(w->chip);
    w->chip = NULL;
    for (char last[DEV_NAME]; (void)strcpy(last, w->name), linux_next_device(CHIPS, last, w->name);) {
        path_of(w->path, w->name);
        w->chip = gpio_chip_open(w->path);
        if (w->chip && !gpio_chip_look(w->chip, w->label, &w->n_lines))
            return 1;
        if (!w->denied) {
            w->denied = errno;
            (void)strcpy(w->denied_path, w->path);
        }
        if (w->chip)
            gpio_chip_close(w->chip);
        w->chip = NULL;
    }
    return 0;
}

static void end(struct walk *w)
{
    if (w->chip)
        gpio_chip_close(w->chip);
    w->chip = NULL;
}

/* ---- Sentences ------------------------------------------------------------------------------------------- */

static int refuse_chip(const char *what, const char *path, int why)
{
    char first[DEV_NAME], before[GPIO_TEXT];
    (void)snprintf(before, sizeof before, "%s: ", what);
    if (why == EACCES || why == EPERM)
        return linux_refuse_access(before, path, why);
    if (why == ENOENT && !linux_next_device(CHIPS, "", first))
        return linux_fail(HAL_ERR_BUS, "%s: there is no %s, and no GPIO chip at all in /dev; this kernel has no GPIO "
                          "driver for this machine, or no GPIO character device", what, path);
    if (why == ENOENT)
        return linux_fail(HAL_ERR_ARG, "%s: there is no %s; name a chip that there is", what, path);
    if (why == ENOTTY || why == ENODEV || why == ENXIO)
        return linux_fail(HAL_ERR_ARG, "%s: %s is no GPIO chip, or one whose driver was taken away; name one that "
                          "there is", what, path);
    return linux_fail(HAL_ERR_BUS, "%s: %s cannot be used as a GPIO chip: %s; name another one", what, path,
                      strerror(why));
}

/* ---- By name ----------------------------------------------------------------------------------------------- */

/* Lines of that name on the chip that the walk is at, from `*offset` on. 1: *offset is one. */
static int named_line(struct walk *w, const char *name, uint32_t *offset, struct gpio_info *info)
{
    for (; name[0] && *offset < w->n_lines; ++*offset) /* lines without a name have "" */
        if (!gpio_line_look(w->chip, *offset, info) && !strcmp(info->name, name))
            return 1;
    return 0;
}

static void put_place(struct gpio_place *place, const struct walk *w, uint32_t offset, const struct gpio_info *info)
{
    (void)strcpy(place->path, w->path);
    (void)strcpy(place->label, w->label);
    place->offset = offset;
    place->info = *info;
}

/* How many lines of all chips have the name; *place is the first of them, *other the second. */
static int find_name(struct gpio_place *place, struct gpio_place *other, struct walk *w, const char *name)
{
    int n = 0;
    while (step(w)) {
        struct gpio_info info;
        for (uint32_t at = 0; named_line(w, name, &at, &info); at++)
            if (n++ < 2)
                put_place(n == 1 ? place : other, w, at, &info);
    }
    return n;
}

/* ---- CHIP:LINE ------------------------------------------------------------------------------------------- */

static int is_number(const char *text)
{
    return text[0] != '\0' && text[strspn(text, "0123456789")] == '\0' && strlen(text) < 9;
}

/* Open the chip that is called so by path, name, number or label. */
static int open_chip(struct walk *w, const char *what, const char *called)
{
    if (called[0] == '/')
        (void)snprintf(w->path, sizeof w->path, "%s", called);
    else if (is_number(called))
        (void)snprintf(w->path, sizeof w->path, "/dev/" CHIPS "%.8s", called);
    else if (!strncmp(called, CHIPS, strlen(CHIPS)) && is_number(called + strlen(CHIPS)))
        (void)snprintf(w->path, sizeof w->path, "/dev/%.16s", called);
    else {
        while (step(w))
            if (!strcmp(w->label, called))
                return HAL_ERR_NONE;
        if (w->denied)
            return refuse_chip(what, w->denied_path, w->denied);
        return linux_fail(HAL_ERR_ARG, "%s: no GPIO chip here is labelled '%s'; name one that there is", what, called);
    }
    w->chip = gpio_chip_open(w->path);
    if (!w->chip || gpio_chip_look(w->chip, w->label, &w->n_lines))
        return refuse_chip(what, w->path, errno);
    return HAL_ERR_NONE;
}

static int find_numbered(struct gpio_place *place, struct walk *w, const char *what, const char *chip, const char *line)
{
    struct gpio_info info;
    uint32_t offset = 0;
    int err = open_chip(w, what, chip);
    if (err)
        return err;
    if (!is_number(line)) {
        if (!named_line(w, line, &offset, &info))
            return linux_fail(HAL_ERR_ARG, "%s: %s [%s] has no line '%s'; give one of its numbers or names", what,
                              w->path, w->label, line);
    } else {
        offset = (uint32_t)strtoul(line, NULL, 10);
        if (offset >= w->n_lines)
            return linux_fail(HAL_ERR_ARG, "%s: %s [%s] has lines 0 to %u, not %u; give one of them", what, w->path,
                              w->label, (unsigned)w->n_lines - 1u, (unsigned)offset);
        if (gpio_line_look(w->chip, offset, &info))
            return refuse_chip(what, w->path, errno);
    }
    put_place(place, w, offset, &info);
    return HAL_ERR_NONE;
}

/* ---- What gpio.h and linux.h offer -------------------------------------------------------------------------- */

static int find(struct gpio_place *place, struct walk *w, const char *what, const char *text)
{
    char chip[GPIO_TEXT];
    struct gpio_place other;
    const char *colon = strrchr(text, ':');
    const int n = find_name(place, &other, w, text);
    if (n == 1)
        return HAL_ERR_NONE;
    if (n > 1)
        return linux_fail(HAL_ERR_ARG, "%s: %d lines here are named '%s'; say which: %s:%u, %s:%u", what, n, text,
                          place->path, (unsigned)place->offset, other.path, (unsigned)other.offset);
    if (colon && (size_t)(colon - text) < sizeof chip) {
        (void)snprintf(chip, sizeof chip, "%.*s", (int)(colon - text), text);
        *w = (struct walk){ 0 };
        return find_numbered(place, w, what, chip, colon + 1);
    }
    if (w->denied)
        return refuse_chip(what, w->denied_path, w->denied);
    if (!linux_next_device(CHIPS, "", chip))
        return refuse_chip(what, "/dev/" CHIPS "0", ENOENT);
    return linux_fail(HAL_ERR_ARG, "%s: no line here is named '%s'; give the name of one that there is, or CHIP:LINE, "
                      "such as gpiochip0:25", what, text);
}

int gpio_find(struct gpio_place *place, const char *what, const char *text)
{
    struct walk w = { 0 };
    const int err = find(place, &w, what, text);
    end(&w);
    return err;
}

int gpio_refuse_held(const struct gpio_place *place, const char *what)
{
    const char *named = place->info.name, *holder = place->info.consumer;
    return linux_fail(HAL_ERR_BUS, "%s: line %s:%u%s%s is held by %s; stop that program or driver, or wire another "
                      "line", what, place->path, (unsigned)place->offset, named[0] ? ", " : "", named,
                      holder[0] ? holder : "someone who gave no name");
}

int gpio_take(struct gpio_line *line, const struct gpio_place *place, const char *what, enum gpio_use use)
{
    const char *named = place->info.name;
    char consumer[GPIO_TEXT];
    (void)snprintf(consumer, sizeof consumer, "zstrip %s", what);
    if (!gpio_request(line, place->path, place->offset, use, consumer))
        return HAL_ERR_NONE;
    const int why = errno;
    if (why == EBUSY)
        return gpio_refuse_held(place, what);
    if (why == EACCES || why == EPERM || why == ENOENT)
        return refuse_chip(what, place->path, why);
    return linux_fail(HAL_ERR_BUS, "%s: line %s:%u%s%s cannot be had as an %s: %s; wire another line", what,
                      place->path, (unsigned)place->offset, named[0] ? ", " : "", named,
                      use == GPIO_EDGES ? "input with edges" : "output", strerror(why));
}

void linux_list_lines(FILE *to)
{
    struct walk w = { 0 };
    while (step(&w)) {
        (void)fprintf(to, "%s [%s], %u lines\n", w.path, w.label, (unsigned)w.n_lines);
        for (uint32_t at = 0; at < w.n_lines; at++) {
            struct gpio_info info;
            if (gpio_line_look(w.chip, at, &info))
                continue;
            const char *holder = info.consumer[0] ? info.consumer : "?";
            (void)fprintf(to, "  %s:%-3u %-24s %s%s\n", w.name, (unsigned)at, info.name[0] ? info.name : "-",
                          info.used ? "held by " : "free", info.used ? holder : "");
        }
    }
    if (w.denied)
        (void)fprintf(to, "%s: %s\n", w.denied_path, strerror(w.denied));
}
