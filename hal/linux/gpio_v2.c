/* libgpiod 2.x (written for 2.2). A request lives without its chip.
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
    struct gpiod_chip_info *info = gpiod_chip_get_info(chip);
    if (!info)
        return -1;
    gpio_copy(label, gpiod_chip_info_get_label(info));
    *n_lines = (uint32_t)gpiod_chip_info_get_num_lines(info);
    gpiod_chip_info_free(info);
    return 0;
}

int gpio_line_look(void *chip, uint32_t offset, struct gpio_info *info)
{
    struct gpiod_line_info *line = gpiod_chip_get_line_info(chip, offset);
    if (!line)
        return -1;
    gpio_copy(info->name, gpiod_line_info_get_name(line));
    gpio_copy(info->consumer, gpiod_line_info_get_consumer(line));
    info->used = gpiod_line_info_is_used(line);
    gpiod_line_info_free(line);
    return 0;
}

/* What a request is made of; each may be missing where there was no memory. */
struct wish {
    struct gpiod_line_settings *settings;
    struct gpiod_line_config *lines;
    struct gpiod_request_config *request;
};

static int fill(struct wish *w, uint32_t offset, enum gpio_use use, const char *consumer)
{
    const unsigned int at = offset;
    if (!w->settings || !w->lines || !w->request)
        return -1;
    gpiod_request_config_set_consumer(w->request, consumer);
    int err = gpiod_line_settings_set_direction(w->settings, use == GPIO_EDGES ? GPIOD_LINE_DIRECTION_INPUT
                                                                               : GPIOD_LINE_DIRECTION_OUTPUT);
    if (!err && use == GPIO_EDGES)
        err = gpiod_line_settings_set_edge_detection(w->settings, GPIOD_LINE_EDGE_RISING);
    if (!err && use != GPIO_EDGES)
        err = gpiod_line_settings_set_output_value(w->settings, use == GPIO_HIGH ? GPIOD_LINE_VALUE_ACTIVE
                                                                                 : GPIOD_LINE_VALUE_INACTIVE);
    return err ? err : gpiod_line_config_add_line_settings(w->lines, &at, 1, w->settings);
}

static struct gpiod_line_request *request(struct gpiod_chip *chip, uint32_t offset, enum gpio_use use,
                                          const char *consumer)
{
    struct wish w = { gpiod_line_settings_new(), gpiod_line_config_new(), gpiod_request_config_new() };
    struct gpiod_line_request *held =
        fill(&w, offset, use, consumer) ? NULL : gpiod_chip_request_lines(chip, w.request, w.lines);
    const int why = errno;
    if (w.request)
        gpiod_request_config_free(w.request);
    if (w.lines)
        gpiod_line_config_free(w.lines);
    if (w.settings)
        gpiod_line_settings_free(w.settings);
    errno = why;
    return held;
}

int gpio_request(struct gpio_line *line, const char *path, uint32_t offset, enum gpio_use use, const char *consumer)
{
    struct gpiod_chip *chip = gpiod_chip_open(path);
    if (!chip)
        return -1;
    struct gpiod_line_request *held = request(chip, offset, use, consumer);
    const int why = errno;
    gpiod_chip_close(chip);
    errno = why;
    if (!held)
        return -1;
    *line = (struct gpio_line){ NULL, held, offset };
    return 0;
}

int gpio_set(struct gpio_line *line, int level)
{
    return gpiod_line_request_set_value(line->held, line->offset,
                                        level ? GPIOD_LINE_VALUE_ACTIVE : GPIOD_LINE_VALUE_INACTIVE);
}

int gpio_edge(struct gpio_line *line, uint32_t ms)
{
    const int came = gpiod_line_request_wait_edge_events(line->held, (int64_t)ms * 1000000);
    if (came <= 0)
        return came;
    struct gpiod_edge_event_buffer *event = gpiod_edge_event_buffer_new(1);
    if (!event)
        return -1;
    const int n = gpiod_line_request_read_edge_events(line->held, event, 1);
    const int why = errno;
    gpiod_edge_event_buffer_free(event);
    errno = why;
    return n < 0 ? -1 : 1;
}

void gpio_release(struct gpio_line *line)
{
    if (line->held)
        gpiod_line_request_release(line->held);
    *line = (struct gpio_line){ 0 };
}
