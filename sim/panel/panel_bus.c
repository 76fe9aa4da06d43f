/* The five verbs. Chip select is low for one verb's bytes.
 *
 * SPDX-License-Identifier: MIT
 */
#include "panel_bus.h"

#include <stddef.h>
#include <string.h>

static uint32_t fnv1a(const uint8_t *at, uint32_t n)
{
    uint32_t sum = 2166136261u;
    for (uint32_t i = 0; i < n; i++)
        sum = (sum ^ at[i]) * 16777619u;
    return sum;
}

static struct sim_panel_bus *of(struct hal_bus *bus)
{
    return (struct sim_panel_bus *)(void *)bus;
}

static int command(struct hal_bus *bus, uint8_t code, const uint8_t *args, uint32_t n)
{
    struct sim_panel_bus *b = of(bus);
    if (n > 0 && args == NULL)
        return HAL_ERR_ARG;
    if (b->out != NULL)
        return HAL_ERR_STATE;
    pm_byte(b->model, code, 0);
    for (uint32_t i = 0; i < n; i++)
        pm_byte(b->model, args[i], 1);
    pm_deselect(b->model);
    return HAL_ERR_NONE;
}

static int data(struct hal_bus *bus, const uint8_t *bytes, uint32_t n)
{
    struct sim_panel_bus *b = of(bus);
    if (bytes == NULL || n == 0 || (uintptr_t)bytes % 2u != 0)
        return HAL_ERR_ARG;
    if (b->out != NULL)
        return HAL_ERR_STATE;
    b->out = bytes;
    b->n_out = n;
    b->sum = fnv1a(bytes, n);
    return HAL_ERR_NONE;
}

static int wait(struct hal_bus *bus)
{
    struct sim_panel_bus *b = of(bus);
    if (b->out == NULL)
        return HAL_ERR_NONE;
    if (bus->hooks.idle != NULL)
        bus->hooks.idle(bus->hooks.ctx);
    const int same = fnv1a(b->out, b->n_out) == b->sum;
    for (uint32_t i = 0; i < b->n_out; i++)
        pm_byte(b->model, b->out[i], 1);
    pm_deselect(b->model);
    b->out = NULL;
    if (bus->hooks.done != NULL)
        bus->hooks.done(bus->hooks.ctx);
    return same ? HAL_ERR_NONE : HAL_ERR_CHANGED;
}

static int reset(struct hal_bus *bus)
{
    struct sim_panel_bus *b = of(bus);
    if (b->out != NULL)
        return HAL_ERR_STATE;
    pm_reset(b->model);
    return HAL_ERR_NONE;
}

static void delay(struct hal_bus *bus, uint32_t us)
{
    pm_elapsed(of(bus)->model, us);
}

void sim_panel_bus_init(struct sim_panel_bus *bus, struct pm_model *model)
{
    static const struct hal_bus verbs = { command, data, wait, reset, delay, { 0 } };
    memset(bus, 0, sizeof *bus);
    bus->bus = verbs;
    bus->model = model;
    pm_elapsed(model, 0); /* the model is held to the times of its datasheet from here on */
}
