/* What the boards' own test programs have in common.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef BUS_CHECKS_H
#define BUS_CHECKS_H

#include <stddef.h>

#include "hal.h"

/* A line, "ok NAME" or "FAILED NAME". */
static inline void verdict(const char *name, int good)
{
    hal_write(good ? "ok " : "FAILED ");
    hal_write(name);
    hal_write("\n");
}

/* Whether a panel's bus refuses what is wrong, and what comes while data is out, and goes on after it. bytes: 512. */
static inline int bus_refuses(struct hal_bus *bus, const uint8_t *bytes)
{
    const uint8_t nop = 0xe3;
    int good = bus->data(bus, NULL, 4) == HAL_ERR_ARG && bus->data(bus, bytes, 0) == HAL_ERR_ARG;
    good &= bus->command(bus, nop, NULL, 1) == HAL_ERR_ARG && bus->wait(bus) == HAL_ERR_NONE;
    good &= bus->data(bus, bytes, 512) == HAL_ERR_NONE && bus->data(bus, bytes, 2) == HAL_ERR_STATE;
    good &= bus->command(bus, nop, NULL, 0) == HAL_ERR_STATE && bus->reset(bus) == HAL_ERR_STATE;
    return good & (bus->wait(bus) == HAL_ERR_NONE && bus->wait(bus) == HAL_ERR_NONE);
}

#endif
