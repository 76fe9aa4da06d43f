/* The little that is needed of libgpiod, whose versions 1 and 2 have little more in common than opening a chip:
 * gpio_v1.c, gpio_v2.c. The build takes one of them. gpio.c finds lines with it.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef LINUX_GPIO_H
#define LINUX_GPIO_H

#include <stdint.h>
#include <stdio.h>

#define GPIO_TEXT 64 /* bytes of a name, its NUL included; the kernel's have 32 */

/* ---- libgpiod: all return -1 with errno where they fail ------------------------------------------------ */

struct gpio_info {
    char name[GPIO_TEXT];     /* "" where it has none */
    char consumer[GPIO_TEXT]; /* who holds it; "" where nobody said */
    int used;                 /* flag: somebody does */
};

/* NULL becomes "". */
static inline void gpio_copy(char to[GPIO_TEXT], const char *from)
{
    (void)snprintf(to, GPIO_TEXT, "%s", from ? from : "");
}

/* A chip, to look at. NULL with errno. */
void *gpio_chip_open(const char *path);
void gpio_chip_close(void *chip);
int gpio_chip_look(void *chip, char label[GPIO_TEXT], uint32_t *n_lines);
int gpio_line_look(void *chip, uint32_t offset, struct gpio_info *info);

/* A line that is held. All zero: none. */
struct gpio_line {
    void *chip, *held; /* libgpiod's */
    uint32_t offset;
};

enum gpio_use { GPIO_LOW, GPIO_HIGH, GPIO_EDGES }; /* an output at a level, or an input whose rising edges count */

int gpio_request(struct gpio_line *line, const char *path, uint32_t offset, enum gpio_use use, const char *consumer);
int gpio_set(struct gpio_line *line, int level);
/* Take one edge, waiting for it at most ms. 1; 0: none came; -1, with EINTR after a signal. */
int gpio_edge(struct gpio_line *line, uint32_t ms);
/* Harmless on none. */
void gpio_release(struct gpio_line *line);

/* ---- gpio.c ---------------------------------------------------------------------------------------------- */

/* Where a line is. */
struct gpio_place {
    char path[GPIO_TEXT]; /* "/dev/gpiochip0" */
    char label[GPIO_TEXT];
    uint32_t offset;
    struct gpio_info info;
};

/* Find a line by what struct linux_wiring says. what: "D/C", for the sentence. HAL_ERR_NONE; HAL_ERR_ARG: there is no
 * such line; HAL_ERR_BUS: it could not be looked for. */
int gpio_find(struct gpio_place *place, const char *what, const char *text);

/* The sentence for one that somebody holds. HAL_ERR_BUS. */
int gpio_refuse_held(const struct gpio_place *place, const char *what);

/* Request a line that was found. HAL_ERR_NONE; HAL_ERR_BUS. */
int gpio_take(struct gpio_line *line, const struct gpio_place *place, const char *what, enum gpio_use use);

#endif
