/* A program on a PC: text to stdout, ticks of the C library's clock. What a panel would get goes to the file that
 * HAL_STREAM names in the environment, for `zsim panel --full --decode`; without it, to nowhere. Crueller than
 * hardware: bytes that change while they are borrowed are an error.
 *
 * SPDX-License-Identifier: MIT
 */
#include "hal.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static const uint8_t *out; /* what is being sent; NULL: nothing is */
static uint32_t n_out, out_sum;
static uint8_t ready;
static FILE *stream; /* NULL: none */

static uint32_t fnv1a(const uint8_t *at, uint32_t n)
{
    uint32_t sum = 2166136261u;
    for (uint32_t i = 0; i < n; i++)
        sum = (sum ^ at[i]) * 16777619u;
    return sum;
}

/* A word of the stream: a byte with its D/C level, or a mark. */
enum { DATA = 0x100, RESET = 0x200, DESELECT = 0x800 };
static void record(uint32_t word)
{
    if (stream) {
        putc((int)(word & 255u), stream);
        putc((int)(word >> 8), stream);
    }
}

static void record_data(const uint8_t *at, uint32_t n)
{
    for (uint32_t i = 0; i < n; i++)
        record(DATA | at[i]);
    record(DESELECT);
}

int hal_init(void)
{
    const char *name = getenv("HAL_STREAM");
    if (name && !stream) {
        stream = fopen(name, "wb");
        if (!stream) {
            perror(name);
            return HAL_ERR_BUS;
        }
    }
    ready = 1;
    return HAL_ERR_NONE;
}

void hal_exit(int status)
{
    fflush(stdout);
    int lost = stream && ferror(stream);
    lost |= stream && fclose(stream) != 0;
    if (lost)
        fputs("HAL_STREAM: the file could not be written\n", stderr);
    exit(lost ? 1 : status);
}

void hal_write(const char *text)
{
    fputs(text, stdout);
}

uint64_t hal_ticks(void)
{
    return (uint64_t)clock();
}

uint32_t hal_tick_hz(void)
{
    return (uint32_t)CLOCKS_PER_SEC;
}

uint32_t hal_tick_instructions(void)
{
    return 0;
}

/* ---- The bus ------------------------------------------------------------------------------------------ */

/* Why a call is refused: for its arguments, or for what it comes after. */
static int refusal(int bad_argument)
{
    return bad_argument ? HAL_ERR_ARG : !ready || out ? HAL_ERR_STATE : HAL_ERR_NONE;
}

static int command(struct hal_bus *bus, uint8_t code, const uint8_t *args, uint32_t n)
{
    (void)bus;
    const int err = refusal(n && !args);
    if (!err) {
        record(code);
        record_data(args, n);
    }
    return err;
}

static int data(struct hal_bus *bus, const uint8_t *bytes, uint32_t n)
{
    (void)bus;
    const int err = refusal(!bytes || !n);
    if (err)
        return err;
    out = bytes;
    n_out = n;
    out_sum = fnv1a(out, n_out);
    return HAL_ERR_NONE;
}

static int wait(struct hal_bus *bus)
{
    if (!out)
        return HAL_ERR_NONE;
    const int same = fnv1a(out, n_out) == out_sum;
    record_data(out, n_out);
    out = NULL;
    if (bus->hooks.done)
        bus->hooks.done(bus->hooks.ctx);
    return same ? HAL_ERR_NONE : HAL_ERR_CHANGED;
}

static int reset(struct hal_bus *bus)
{
    (void)bus;
    if (!out)
        record(RESET);
    return out ? HAL_ERR_STATE : HAL_ERR_NONE;
}

static void delay(struct hal_bus *bus, uint32_t us)
{
    (void)bus;
    (void)us;
}

static struct hal_bus the_bus = { .command = command, .data = data, .wait = wait, .reset = reset, .delay = delay };

struct hal_bus *hal_bus(void)
{
    return &the_bus;
}

void hal_backlight(uint8_t level)
{
    (void)level;
}

void hal_stack_paint(void)
{
}

uint32_t hal_stack_used(void)
{
    return 0;
}
