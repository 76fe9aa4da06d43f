/* On QEMU's LM3S6965EVB: the panel's bus where nothing is drawn. Lines of "ok NAME" and "FAILED NAME". QEMU's SSI0
 * sends at once; with interrupts off it does not begin, which is as near as it gets to a wire that takes its time.
 *
 * SPDX-License-Identifier: MIT
 */
#include "hal.h"

#include <stddef.h>

#include "bus_checks.h"

#define TICKS_A_US 50u

static _Alignas(4) uint8_t bytes[512];
static volatile uint32_t done_calls, idle_calls;

static void interrupts(int on)
{
    if (on)
        __asm__ volatile("cpsie i" ::: "memory");
    else
        __asm__ volatile("cpsid i" ::: "memory");
}

static void done(void *ctx)
{
    (void)ctx;
    done_calls = done_calls + 1;
}

/* Lets the transfer go on when it has been called some times. */
static void idle(void *ctx)
{
    (void)ctx;
    idle_calls = idle_calls + 1;
    interrupts(idle_calls >= 5);
}

static void hooks(struct hal_bus *bus)
{
    bus->hooks.done = done;
    int good = bus->data(bus, bytes, 511) == HAL_ERR_NONE;
    good &= done_calls == 1; /* the interrupt has run */
    good &= bus->wait(bus) == HAL_ERR_NONE && done_calls == 1;
    verdict("lm3s6965_pixels_leave_by_interrupt", good);
    bus->hooks.idle = idle;
    interrupts(0);
    good = bus->data(bus, bytes, 512) == HAL_ERR_NONE && done_calls == 1;
    good &= bus->wait(bus) == HAL_ERR_NONE && idle_calls == 5 && done_calls == 2;
    verdict("lm3s6965_idle_hook_waits", good);
    bus->hooks.idle = NULL;
}

/* An interrupt that does not come: 512 bytes take 1.15 ms, they get twice that and 1 ms. The interrupt is pending when
 * it is let in at last, and has nothing more to do. */
static void timeout(struct hal_bus *bus)
{
    done_calls = 0;
    const uint64_t from = hal_ticks();
    interrupts(0);
    int good = bus->data(bus, bytes, 512) == HAL_ERR_NONE && bus->wait(bus) == HAL_ERR_TIMEOUT;
    const uint64_t took = hal_ticks() - from;
    good &= took > 3200u * TICKS_A_US && took < 3500u * TICKS_A_US && done_calls == 1;
    verdict("lm3s6965_breaks_off", good);
    good = bus->command(bus, 0xe3, NULL, 0) == HAL_ERR_NONE && bus->data(bus, bytes, 512) == HAL_ERR_NONE;
    good &= bus->wait(bus) == HAL_ERR_NONE && done_calls == 2;
    verdict("lm3s6965_goes_on_after_that", good);
}

/* QEMU takes 1 ns for an instruction: of 200,000 the core's clock is 50 MHz if they are 10,000 ticks. */
static void clock(struct hal_bus *bus)
{
    uint64_t from = hal_ticks();
    bus->delay(bus, 250);
    uint64_t took = hal_ticks() - from;
    int good = hal_tick_hz() == TICKS_A_US * 1000000u && took >= 250u * TICKS_A_US && took < 260u * TICKS_A_US;
    from = hal_ticks();
    uint32_t n = 100000u;
    __asm__ volatile("1: subs %0, #1\n bne 1b" : "+r"(n) : : "cc");
    took = hal_ticks() - from;
    good &= took >= 10000u && took < 10010u;
    verdict("lm3s6965_delay_and_ticks", good);
}

int main(void)
{
    struct hal_bus *bus = hal_bus();
    const int early = bus->data(bus, bytes, 2) == HAL_ERR_STATE && bus->command(bus, 0xe3, NULL, 0) == HAL_ERR_STATE;
    bus->delay(bus, 10);
    const int good = hal_init() == HAL_ERR_NONE && hal_init() == HAL_ERR_NONE && hal_bus() == bus;
    verdict("lm3s6965_begins_with_hal_init", early && good);
    verdict("lm3s6965_bus_refuses", bus_refuses(bus, bytes));
    hooks(bus);
    timeout(bus);
    clock(bus);
    hal_write("end\n");
    hal_exit(0);
}
