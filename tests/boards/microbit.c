/* On QEMU's micro:bit: ticks beyond the timer's 32 bits, pauses, and the rules of the panel's bus. Lines of "ok NAME"
 * and "FAILED NAME"; tests/boards/microbit.sh compares what went over the wire.
 *
 * SPDX-License-Identifier: MIT
 */
#include "hal.h"

#include <stddef.h>

#define QUARTER 0x40000000u /* of the timer's range, in its ticks: microseconds */
#define SLACK 60u           /* ticks that a pause may take more: alarm, and what QEMU needs to see it */

static uint32_t done_calls;

static void verdict(const char *name, int good)
{
    hal_write(good ? "ok microbit_" : "FAILED microbit_");
    hal_write(name);
    hal_write(good ? "\n" : ": see microbit.c\n");
}

static void done(void *ctx)
{
    *(uint32_t *)ctx += 1u;
}

/* Pauses take what they should. */
static int pauses(const uint32_t *us, uint32_t n)
{
    struct hal_bus *bus = hal_bus();
    int good = 1;
    for (uint32_t i = 0; i < n; i++) {
        const uint64_t from = hal_ticks();
        bus->delay(bus, us[i]);
        const uint64_t took = hal_ticks() - from;
        good &= took >= us[i] && took <= (uint64_t)us[i] + SLACK;
    }
    return good;
}

static void time_passes(void)
{
    static const uint32_t brief[] = { 0, 1, 15, 16, 17, 18, 100, 65535, 65536 };
    static const uint32_t longer[] = { QUARTER, QUARTER, QUARTER, QUARTER, QUARTER, QUARTER / 2u, 0xffffffffu,
                                       QUARTER };
    verdict("pauses", pauses(brief, sizeof brief / sizeof brief[0]));
    verdict("ticks_pass_32_bits", pauses(longer, sizeof longer / sizeof longer[0]) && hal_ticks() >> 32 == 2u);
}

static void bus_rules(void)
{
    static const uint8_t bytes[] = { 0x11, 0x22, 0x33, 0x44, 0x55, 0x66 };
    struct hal_bus *bus = hal_bus();
    bus->hooks.ctx = &done_calls;
    bus->hooks.done = done;
    hal_write("wire\n");
    verdict("bus_refuses_nothing_to_send",
            bus->data(bus, NULL, 4) == HAL_ERR_ARG && bus->data(bus, bytes, 0) == HAL_ERR_ARG &&
            bus->command(bus, 0x2c, NULL, 1) == HAL_ERR_ARG && done_calls == 0);
    verdict("bus_resets", bus->reset(bus) == HAL_ERR_NONE);
    verdict("bus_sends", bus->command(bus, 0x2c, NULL, 0) == HAL_ERR_NONE &&
                             bus->command(bus, 0x36, bytes, 2) == HAL_ERR_NONE &&
            bus->data(bus, bytes, 6) == HAL_ERR_NONE && done_calls == 1);
    verdict("bus_holds_to_wait", bus->data(bus, bytes, 2) == HAL_ERR_STATE && bus->reset(bus) == HAL_ERR_STATE &&
            bus->command(bus, 0x29, NULL, 0) == HAL_ERR_STATE && done_calls == 1);
    verdict("bus_waits", bus->wait(bus) == HAL_ERR_NONE && bus->wait(bus) == HAL_ERR_NONE &&
            bus->data(bus, bytes + 1, 1) == HAL_ERR_NONE && bus->wait(bus) == HAL_ERR_NONE && done_calls == 2);
}

int main(void)
{
    struct hal_bus *bus = hal_bus();
    const int early = bus->command(bus, 0x29, NULL, 0) == HAL_ERR_STATE && bus->reset(bus) == HAL_ERR_STATE &&
                      bus->wait(bus) == HAL_ERR_NONE;
    hal_write("too early\n");
    bus->delay(bus, 10);
    const int started = hal_init() == HAL_ERR_NONE && hal_init() == HAL_ERR_NONE;
    verdict("bus_wants_hal_init", early && started && hal_bus() == bus);
    verdict("ticks_are_microseconds", hal_tick_hz() == 1000000u && hal_tick_instructions() == 0);
    bus_rules();
    time_passes();
    (void)*(volatile uint32_t *)(uintptr_t)(0x20000001u + (done_calls & 2u)); /* not aligned: a fault */
    hal_exit(0);
}
