/* A program on a PC: text to stdout, ticks of the C library's clock, strips to nowhere. Crueller than
 * hardware: a strip that changes while it is borrowed is an error.
 *
 * SPDX-License-Identifier: MIT
 */
#include "hal.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static struct hal_strip out; /* px is NULL: none is out */
static uint32_t out_sum;
static uint8_t ready;

static uint32_t fnv1a(const uint8_t *at, uint32_t n)
{
    uint32_t sum = 2166136261u;
    for (uint32_t i = 0; i < n; i++)
        sum = (sum ^ at[i]) * 16777619u;
    return sum;
}

int hal_init(void)
{
    ready = 1;
    return HAL_OK;
}

void hal_exit(int status)
{
    fflush(stdout);
    exit(status);
}

void hal_write(const char *text)
{
    fputs(text, stdout);
}

uint64_t hal_ticks(void)
{
    return (uint64_t)clock();
}

uint32_t hal_tick_instructions(void)
{
    return 0;
}

int hal_strip_send(const struct hal_strip *strip)
{
    if (!strip || !strip->px || !strip->n_bytes)
        return HAL_ERR_ARG;
    if (!ready || out.px)
        return HAL_ERR_STATE;
    out = *strip;
    out_sum = fnv1a(out.px, out.n_bytes);
    return HAL_OK;
}

int hal_strip_wait(void)
{
    const int same = !out.px || fnv1a(out.px, out.n_bytes) == out_sum;
    out.px = NULL;
    return same ? HAL_OK : HAL_ERR_CHANGED;
}

void hal_stack_paint(void)
{
}

uint32_t hal_stack_used(void)
{
    return 0;
}
