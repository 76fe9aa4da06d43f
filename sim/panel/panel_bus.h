/* A bus that ends in the model of a panel: the simulator's HAL. Crueller than hardware: data is taken as late as the
 * contract allows, and bytes that changed until then are an error; so is any other verb while data is out. Time
 * passes by delay alone, so a driver that does not wait for its controller is found out.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_PANEL_BUS_H
#define SIM_PANEL_BUS_H

#include "hal.h"
#include "panel_model.h"

struct sim_panel_bus {
    struct hal_bus bus; /* hand this to panel_init */
    struct pm_model *model;
    const uint8_t *out; /* data that is out; NULL: none */
    uint32_t n_out, sum;
};

/* A bus to a model, which stays the caller's. Hooks are empty and may be set. */
void sim_panel_bus_init(struct sim_panel_bus *bus, struct pm_model *model);

#endif
