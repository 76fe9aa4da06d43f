/* On the emulated Pico: division by the RP2040's divider against libgcc's own, and the panel's bus. Lines of
 * "ok NAME" and "FAILED NAME"; tests/boards/pico.sh compares what went over the wire.
 *
 * SPDX-License-Identifier: MIT
 */
#include "hal.h"

#include <stddef.h>

#include "../bus_checks.h"
#include "../../../hal/rp2040/parts.h"

#define NVIC_ISPR REG(0xe000e200u)

/* libgcc's functions under other names. The mod functions return two registers: quotient low, remainder high. */
int32_t libgcc___aeabi_idiv(int32_t n, int32_t d);
uint32_t libgcc___aeabi_uidiv(uint32_t n, uint32_t d);
uint64_t libgcc___aeabi_idivmod(int32_t n, int32_t d);
uint64_t libgcc___aeabi_uidivmod(uint32_t n, uint32_t d);
int32_t __aeabi_idiv(int32_t n, int32_t d);
uint32_t __aeabi_uidiv(uint32_t n, uint32_t d);
uint64_t __aeabi_idivmod(int32_t n, int32_t d);
uint64_t __aeabi_uidivmod(uint32_t n, uint32_t d);
int libgcc___aeabi_idiv0(int result);

#define RANDOM_PAIRS 20000

static uint32_t random_state = 1;
static volatile uint32_t done_calls, idle_calls, done_quotient;
static volatile uint32_t seven = 7; /* not known to the compiler */

int libgcc___aeabi_idiv0(int result)
{
    return result;
}

static uint32_t next(void)
{
    random_state ^= random_state << 13;
    random_state ^= random_state >> 17;
    random_state ^= random_state << 5;
    return random_state;
}

/* ---- Division ------------------------------------------------------------------------------------------------ */

static int same(uint32_t n, uint32_t d)
{
    const int32_t sn = (int32_t)n, sd = (int32_t)d;
    return __aeabi_uidiv(n, d) == libgcc___aeabi_uidiv(n, d) && __aeabi_idiv(sn, sd) == libgcc___aeabi_idiv(sn, sd) &&
           __aeabi_uidivmod(n, d) == libgcc___aeabi_uidivmod(n, d) &&
           __aeabi_idivmod(sn, sd) == libgcc___aeabi_idivmod(sn, sd);
}

static void division(void)
{
    static const uint32_t edge[] = { 0, 1, 2, 3, 7, 10, 255, 256, 65535, 65536, 0x7ffffffe, 0x7fffffff, 0x80000000,
                                     0x80000001, 0xffff0000, 0xfffffff9, 0xfffffffe, 0xffffffff };
    const uint32_t edges = sizeof edge / sizeof edge[0];
    int good = 1;
    for (uint32_t i = 0; i < edges * edges; i++)
        good &= same(edge[i / edges], edge[i % edges]);
    verdict("pico_division_edges_as_libgcc", good);
    for (int i = 0; i < RANDOM_PAIRS; i++) {
        const uint32_t n = next();
        good &= same(n, next() >> (next() & 31u));
    }
    verdict("pico_division_random_as_libgcc", good);
}

/* ---- The bus ---------------------------------------------------------------------------------------------- */

static _Alignas(4) uint8_t bytes[4096];

static struct hal_bus *next_on; /* `done` begins another transfer on it, as the deadline of the last comes late */
static int next_is_wrong;

static void done(void *ctx)
{
    (void)ctx;
    struct hal_bus *const bus = next_on;
    next_on = NULL;
    if (bus) {
        next_is_wrong = bus->wait(bus) != HAL_ERR_NONE;
        next_is_wrong |= bus->data(bus, bytes, 512) != HAL_ERR_NONE;
        NVIC_ISPR = 1u << IRQ_TIMER_0;
    } else {
        next_is_wrong |= DMA_TRANS_COUNT(CHANNEL_PANEL) != 0;
    }
    done_calls = done_calls + 1;
    done_quotient = 1000u / seven;
}

static void idle(void *ctx)
{
    (void)ctx;
    idle_calls = idle_calls + 1;
}

/* Divisions go on while a hook divides in the interrupt, which comes at any of their instructions. */
static void hooks(struct hal_bus *bus)
{
    int good = 1;
    bus->hooks.done = done;
    bus->hooks.idle = idle;
    for (uint32_t i = 1; i <= 200; i++) {
        const uint32_t before = done_calls, n = next() | 0x80000000u, d = n >> 8 & 0xfffu;
        const uint64_t want = libgcc___aeabi_uidivmod(n, d);
        const uint64_t signed_want = libgcc___aeabi_idivmod((int32_t)n, (int32_t)d);
        good &= bus->data(bus, bytes, 100u) == HAL_ERR_NONE;
        for (uint32_t k = next() & 63u; k; k--)
            __asm__ volatile("nop");
        while (done_calls == before) {
            good &= __aeabi_uidivmod(n, d) == want && __aeabi_idivmod((int32_t)n, (int32_t)d) == signed_want;
        }
        good &= bus->wait(bus) == HAL_ERR_NONE && done_calls == before + 1u && done_quotient == 142;
    }
    verdict("pico_done_hook_may_divide", good);
    const uint32_t before = idle_calls;
    good = bus->data(bus, bytes, 512) == HAL_ERR_NONE && bus->wait(bus) == HAL_ERR_NONE && idle_calls > before;
    verdict("pico_idle_hook_waits", good);
    done_calls = 0;
    next_on = bus;
    next_is_wrong = 0;
    good = bus->data(bus, bytes, 100) == HAL_ERR_NONE;
    while (done_calls < 2) {
    }
    verdict("pico_late_deadline", good && bus->wait(bus) == HAL_ERR_NONE && !next_is_wrong && done_calls == 2);
    bus->hooks.done = NULL;
    bus->hooks.idle = NULL;
}

/* What the wire is to show, told apart by a reset: a command, a command with arguments, pixels in even and odd numbers
 * and from an odd address. */
static void wire(struct hal_bus *bus)
{
    static const uint8_t args[3] = { 0x81, 0x00, 0xfe };
    static const _Alignas(2) uint8_t px[8] = { 0x11, 0x22, 0x33, 0x44, 0x55, 0x66, 0x77, 0x88 };
    int good = bus->reset(bus) == HAL_ERR_NONE;
    good &= bus->command(bus, 0x2c, NULL, 0) == HAL_ERR_NONE && bus->command(bus, 0x36, args, 3) == HAL_ERR_NONE;
    good &= bus->data(bus, px, 6) == HAL_ERR_NONE && bus->wait(bus) == HAL_ERR_NONE;
    good &= bus->data(bus, px, 5) == HAL_ERR_NONE && bus->wait(bus) == HAL_ERR_NONE;
    good &= bus->data(bus, px + 1, 4) == HAL_ERR_NONE && bus->wait(bus) == HAL_ERR_NONE;
    good &= bus->data(bus, px, 1) == HAL_ERR_NONE && bus->wait(bus) == HAL_ERR_NONE;
    verdict("pico_bus_sends", good);
}

static void clock(struct hal_bus *bus)
{
    const uint64_t from = hal_ticks();
    bus->delay(bus, 250);
    const uint64_t took = hal_ticks() - from;
    verdict("pico_delay_and_ticks", hal_tick_hz() == 1000000u && took >= 250u && took < 260u);
}

int main(void)
{
    struct hal_bus *bus = hal_bus();
    const int early = bus->command(bus, 0, NULL, 0);
    bus->delay(bus, 10);
    if (hal_init() || hal_init())
        hal_exit(1);
    verdict("pico_bus_before_init", early == HAL_ERR_STATE);
    division();
    verdict("pico_bus_refuses", bus_refuses(bus, bytes));
    hooks(bus);
    clock(bus);
    wire(bus);
    hal_exit(0);
}
