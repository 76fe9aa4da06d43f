/* Faults on a bus. Everything else goes through as it is, in the order in which it came.
 *
 * SPDX-License-Identifier: MIT
 */
#include "fault.h"

#include <stddef.h>

#define LATE_CALLS 1000

static struct hal_fault *of(struct hal_bus *bus)
{
    struct hal_fault *fault = (struct hal_fault *)(void *)bus; /* bus is its first member */
    fault->under->hooks = bus->hooks;
    return fault;
}

/* Is it this verb's turn to fail? */
static int strikes(struct hal_fault *fault)
{
    if (fault->at > 1) {
        fault->at--;
        return 0;
    }
    if (!fault->times)
        return 0;
    if (fault->times != HAL_FAULT_EVER)
        fault->times--;
    fault->n_hit++;
    return 1;
}

static int command(struct hal_bus *bus, uint8_t code, const uint8_t *args, uint32_t n)
{
    struct hal_fault *fault = of(bus);
    if (fault->out)
        return HAL_ERR_STATE;
    if (fault->kind != HAL_FAULT_COMMAND || !strikes(fault))
        return fault->under->command(fault->under, code, args, n);
    (void)fault->under->command(fault->under, code, args, n / 2u);
    return HAL_ERR_BUS;
}

/* Send all of it and wait here. hooks.done is for the whole transfer: our wait calls it. */
static int send(struct hal_bus *under, const uint8_t *bytes, uint32_t n)
{
    under->hooks.done = NULL;
    const int err = n ? under->data(under, bytes, n) : HAL_ERR_NONE;
    return err ? err : under->wait(under);
}

static int lose(struct hal_fault *fault, const uint8_t *bytes, uint32_t n)
{
    const uint32_t half = n / 2u & ~1u;
    int err = send(fault->under, bytes, half);
    if (!err)
        err = fault->under->reset(fault->under);
    return err ? err : send(fault->under, bytes + half, n - half);
}

static int data(struct hal_bus *bus, const uint8_t *bytes, uint32_t n)
{
    struct hal_fault *fault = of(bus);
    if (!bytes || !n)
        return HAL_ERR_ARG;
    if (fault->out)
        return HAL_ERR_STATE;
    int err = HAL_ERR_NONE;
    fault->result = HAL_ERR_NONE;
    fault->late = fault->own = fault->twice = 0;
    if (fault->kind < HAL_FAULT_REFUSE || fault->kind > HAL_FAULT_LOST || !strikes(fault)) {
        err = fault->under->data(fault->under, bytes, n);
    } else if (fault->kind == HAL_FAULT_REFUSE) {
        return HAL_ERR_BUS;
    } else if (fault->kind == HAL_FAULT_CUT) {
        (void)send(fault->under, bytes, n / 2u & ~1u);
        fault->result = HAL_ERR_BUS;
        fault->own = 1;
    } else if (fault->kind == HAL_FAULT_STUCK) {
        fault->result = HAL_ERR_TIMEOUT;
        fault->own = 1;
    } else if (fault->kind == HAL_FAULT_LATE) {
        err = fault->under->data(fault->under, bytes, n);
        fault->late = 1;
    } else if (fault->kind == HAL_FAULT_TWICE) {
        err = fault->under->data(fault->under, bytes, n);
        fault->twice = 1;
    } else {
        err = lose(fault, bytes, n);
        fault->own = 1;
    }
    fault->out = !err;
    return err;
}

static int wait(struct hal_bus *bus)
{
    struct hal_fault *fault = of(bus);
    if (!fault->out)
        return fault->under->wait(fault->under);
    for (int i = 0; fault->late && bus->hooks.idle && i < LATE_CALLS; i++)
        bus->hooks.idle(bus->hooks.ctx);
    fault->out = fault->late = 0;
    const int err = fault->under->wait(fault->under);
    if ((fault->own || fault->twice) && bus->hooks.done)
        bus->hooks.done(bus->hooks.ctx);
    return fault->result ? fault->result : err;
}

static int reset(struct hal_bus *bus)
{
    struct hal_fault *fault = of(bus);
    if (fault->out)
        return HAL_ERR_STATE;
    if (fault->kind == HAL_FAULT_DEAD && strikes(fault))
        return HAL_ERR_TIMEOUT;
    return fault->under->reset(fault->under);
}

static void delay(struct hal_bus *bus, uint32_t us)
{
    struct hal_fault *fault = of(bus);
    fault->under->delay(fault->under, us);
}

void hal_fault_init(struct hal_fault *fault, struct hal_bus *under)
{
    const struct hal_fault clean = { { command, data, wait, reset, delay, { 0 } }, under, HAL_FAULT_NONE, 0, 0, 0,
                                     0, 0, 0, 0, HAL_ERR_NONE };
    *fault = clean;
}

void hal_fault_set(struct hal_fault *fault, enum hal_fault_kind kind, uint32_t n, uint32_t times)
{
    fault->kind = kind;
    fault->at = n;
    fault->times = n ? times : 0u;
}
