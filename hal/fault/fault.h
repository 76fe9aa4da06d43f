/* A bus that makes another one fail, on purpose and on time: what a driver, a sink and a frame loop are tested with.
 *
 *   struct hal_fault bad;
 *   hal_fault_init(&bad, hal_bus());
 *   panel_init(&panel, &config, &bad.bus, ...);
 *   hal_fault_set(&bad, HAL_FAULT_CUT, 7, 1);   the seventh data transfer from now on loses its second half
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef HAL_FAULT_H
#define HAL_FAULT_H

#include "hal.h"

#ifdef __cplusplus
extern "C" {
#endif

enum hal_fault_kind {
    HAL_FAULT_NONE,
    /* at the nth data transfer: */
    HAL_FAULT_REFUSE, /* data returns HAL_ERR_BUS; nothing reaches the panel */
    HAL_FAULT_CUT,    /* the first half reaches the panel, then wait returns HAL_ERR_BUS */
    HAL_FAULT_STUCK,  /* nothing reaches the panel, wait returns HAL_ERR_TIMEOUT */
    HAL_FAULT_LATE,   /* all is well, but wait calls hooks.idle a thousand times first */
    HAL_FAULT_TWICE,  /* all is well, but its end is told twice: hooks.done is called once more from wait */
    HAL_FAULT_LOST,   /* the panel is reset in the middle of it, as by a dip of its supply; nobody is told */
    /* at the nth command: */
    HAL_FAULT_COMMAND, /* the command byte and the first half of its arguments arrive; HAL_ERR_BUS */
    /* at the nth reset: */
    HAL_FAULT_DEAD     /* the panel never becomes ready: HAL_ERR_TIMEOUT */
};

#define HAL_FAULT_EVER UINT32_MAX

struct hal_fault {
    struct hal_bus bus;   /* what the panel is given; its hooks are passed on */
    struct hal_bus *under;
    enum hal_fault_kind kind;
    uint32_t at, times;   /* verbs of the kind to go; how many fail from then on */
    uint32_t n_hit;       /* that failed so far */
    uint8_t out, late;    /* flags: data was begun and not yet waited for; that wait is a late one */
    uint8_t twice;        /* flag: that wait tells of the end once more */
    uint8_t own;          /* flag: that wait calls hooks.done, as the bus below was not given the whole transfer */
    int result;           /* what that wait will return, where this bus decides */
};

/* A bus over another one, without faults yet. Both are borrowed as long as the bus is used. */
void hal_fault_init(struct hal_fault *fault, struct hal_bus *under);

/* From the nth (from 1) verb of the kind from now on, let times of them fail (HAL_FAULT_EVER: all). Replaces what was
 * set before. */
void hal_fault_set(struct hal_fault *fault, enum hal_fault_kind kind, uint32_t n, uint32_t times);

#ifdef __cplusplus
}
#endif

#endif
