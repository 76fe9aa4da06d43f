/* On the emulated Pico, with sweep.mjs: the interrupt that ends a transfer comes at each instruction from its beginning
 * to the sleep in wait; the timer wraps at each moment of one. Lines of "ok NAME" and "FAILED NAME".
 *
 * SPDX-License-Identifier: MIT
 */
#include "hal.h"

#include "../bus_checks.h"

#define PLACES 110u /* more instructions than there are from the start of a transfer to the sleep */

/* What the emulator does to the next transfer, `place` instructions after its start. */
enum sweep {
    SWEEP_NONE,
    SWEEP_DONE,     /* the DMA's interrupt comes */
    SWEEP_TIMEOUT,  /* words stop, the timer's interrupt comes */
    SWEEP_BOTH,     /* the DMA's and the timer's */
    SWEEP_SPURIOUS, /* the DMA's, of a transfer that goes on */
    SWEEP_WRAP,     /* the low word of the timer is 0 place * 8 ns after sweep_next */
    SWEEP_KINDS
};

void sweep_next(enum sweep kind, uint32_t place); /* the emulator stops there */

static volatile uint32_t done_calls;
static _Alignas(4) uint8_t px[64];

__attribute__((noipa)) void sweep_next(enum sweep kind, uint32_t place)
{
    __asm__ volatile("" ::"r"(kind), "r"(place) : "memory");
}

static void done(void *ctx)
{
    (void)ctx;
    done_calls = done_calls + 1u;
}

static void idle(void *ctx)
{
    (void)ctx;
}

/* One swept transfer and a good one. 1: both said what they should. */
static int round_of(struct hal_bus *bus, enum sweep kind, uint32_t place)
{
    const uint32_t before = done_calls, n = kind == SWEEP_TIMEOUT || kind == SWEEP_SPURIOUS ? 64 : 2;
    sweep_next(kind, place);
    int good = bus->data(bus, px, n) == HAL_ERR_NONE;
    good &= bus->wait(bus) == (kind == SWEEP_TIMEOUT ? HAL_ERR_TIMEOUT : HAL_ERR_NONE);
    good &= done_calls == before + 1u;
    sweep_next(SWEEP_NONE, 0);
    good &= bus->command(bus, 0x2c, px, 1) == HAL_ERR_NONE;
    good &= bus->data(bus, px, 6) == HAL_ERR_NONE && bus->wait(bus) == HAL_ERR_NONE && done_calls == before + 2u;
    return good;
}

/* A pause, ticks and a deadline of about a millisecond across the wrap. */
static int across_the_wrap(struct hal_bus *bus)
{
    int good = 1;
    for (uint32_t place = 1; place < 80; place++) { /* between any two reads of the timer */
        sweep_next(SWEEP_WRAP, place);
        const uint64_t one = hal_ticks(), two = hal_ticks();
        good &= two >= one && two - one < 3u;
    }
    sweep_next(SWEEP_WRAP, 16000); /* 128 us ahead */
    uint64_t last = hal_ticks();
    const uint64_t from = last;
    while (last - from < 200u) { /* never backwards, nor by leaps */
        const uint64_t now = hal_ticks();
        good &= now >= last && now - last < 3u;
        last = now;
    }
    sweep_next(SWEEP_WRAP, 16000);
    const uint64_t paused = hal_ticks();
    bus->delay(bus, 250);
    good &= hal_ticks() - paused >= 250u && hal_ticks() - paused < 260u;
    sweep_next(SWEEP_WRAP, 64000); /* 512 us ahead, the deadline is at 1030 */
    sweep_next(SWEEP_TIMEOUT, 1000000); /* words stop, and the timer's own interrupt is waited for */
    const uint64_t begun = hal_ticks();
    good &= bus->data(bus, px, 64) == HAL_ERR_NONE && bus->wait(bus) == HAL_ERR_TIMEOUT;
    good &= hal_ticks() - begun >= 1000u && hal_ticks() - begun < 1100u;
    sweep_next(SWEEP_NONE, 0);
    return good;
}

int main(void)
{
    static const char *const names[SWEEP_KINDS] = {
        "", "pico_done_at_any_instruction", "pico_timeout_at_any_instruction",
        "pico_done_and_timeout_at_any_instruction", "pico_spurious_interrupt_at_any_instruction",
        "pico_timer_wraps_at_any_moment"
    };
    if (hal_init())
        hal_exit(1);
    for (uint32_t i = 0; i < sizeof px; i++)
        px[i] = (uint8_t)(i + 1u);
    struct hal_bus *bus = hal_bus();
    bus->hooks.done = done;
    for (enum sweep kind = SWEEP_DONE; kind < SWEEP_KINDS; kind++) {
        int good = 1;
        for (uint32_t n = 0; n < 2u * PLACES; n++) {
            bus->hooks.idle = n & 1u ? idle : 0;
            good &= round_of(bus, kind, n / 2u);
        }
        verdict(names[kind], good);
    }
    bus->hooks.idle = 0;
    verdict("pico_ticks_and_deadlines_across_a_wrap", across_the_wrap(bus));
    hal_exit(0);
}
