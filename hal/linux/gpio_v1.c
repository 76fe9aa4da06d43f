/* libgpiod 1.x (written for 1.6). A line belongs to its chip, which stays open as long as the line is held.
 *
 * SPDX-License-Identifier: MIT
 */
#include <errno.h>
#include <gpiod.h>

#include "gpio.h"

void *gpio_chip_open(const char *path)
{
    return gpiod_chip_open(path);
}

void gpio_chip_close(void *chip)
{
    gpiod_chip_close(chip);
}

int gpio_chip_look(void *chip, char label[GPIO_TEXT], uint32_t *n_lines)
{
    gpio_copy(label, gpiod_chip_label(chip));
    *n_lines = gpiod_chip_num_lines(chip);
    return 0;
}

int gpio_line_look(void *chip, uint32_t offset, struct gpio_info *info)
{
    struct gpiod_line *line = gpiod_chip_get_line(chip, offset);
    if (!line)
        return -1;
    gpio_copy(info->name, gpiod_line_name(line));
    gpio_copy(info->consumer, gpiod_line_consumer(line));
    info->used = gpiod_line_is_used(line);
    return 0;
}

int gpio_request(struct gpio_line *line, const char *path, uint32_t offset, enum gpio_use use, const char *consumer)
{
    struct gpiod_chip *chip = gpiod_chip_open(path);
    struct gpiod_line *held = chip ? gpiod_chip_get_line(chip, offset) : NULL;
    int err = -1;
    if (held)
        err = use == GPIO_EDGES ? gpiod_line_request_rising_edge_events(held, consumer)
                                : gpiod_line_request_output(held, consumer, use == GPIO_HIGH);
    if (err) {
        const int why = errno;
        if (chip)
            gpiod_chip_close(chip);
        errno = why;
        return -1;
    }
    *line = (struct gpio_line){ chip, held, offset };
    return 0;
}

int gpio_set(struct gpio_line *line, int level)
{
    return gpiod_line_set_value(line->held, level);
}

int gpio_edge(struct gpio_line *line, uint32_t ms)
{
    const struct timespec timeout = { (time_t)(ms / 1000u), (long)(ms % 1000u) * 1000000 };
    struct gpiod_line_event event;
    const int came = gpiod_line_event_wait(line->held, &timeout);
    return came > 0 && gpiod_line_event_read(line->held, &event) ? -1 : came;
}

void gpio_release(struct gpio_line *line)
{
    if (line->chip)
        gpiod_chip_close(line->chip); /* its line with it */
    *line = (struct gpio_line){ 0 };
}
