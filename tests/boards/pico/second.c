/* On the emulated Pico: the second core, as hal/second.h has it. Lines of "ok NAME" and "FAILED NAME".
 *
 * SPDX-License-Identifier: MIT
 */
#include "second.h"

#include "hal.h"

#include "../bus_checks.h"

#define ROUNDS 2000u

static volatile uint32_t job, turn, seen, rounds, calls, sum, done, quotients;

/* Divides: what it interrupts divides too. */
static void called(void)
{
    calls = calls + 1u;
    quotients = 1000u / calls;
}

static void add(void)
{
    for (uint32_t i = 0; i < ROUNDS; i++) {
        second_lock();
        sum = sum + 1u;
        second_unlock();
    }
}

/* Sleep until it is this core's turn, and let it be the other's: a wake that is lost is a sleep without an end. */
static void pass_on(uint32_t core)
{
    for (uint32_t i = 0; i < ROUNDS; i++) {
        while (turn != core)
            second_sleep(0);
        second_barrier();
        seen = seen + 1u;
        second_barrier();
        turn = 1u - core;
        second_wake();
    }
}

static void run(void)
{
    for (uint32_t last = 0;;) {
        while (job == last)
            second_sleep(0);
        last = job;
        if (last == 1)
            pass_on(1);
        else if (last == 2)
            add();
        else
            for (uint32_t i = 0; i < ROUNDS; i++) {
                const uint32_t before = calls;
                second_call();
                while (calls == before) {
                }
            }
        second_barrier();
        done = last;
        second_wake();
    }
}

static void begin(uint32_t what)
{
    second_barrier();
    job = what;
    second_wake();
}

static void end(uint32_t what)
{
    while (done != what)
        second_sleep(1000);
}

int main(void)
{
    if (hal_init())
        hal_exit(1);
    int good = second_start(run, called) == HAL_ERR_NONE;
    verdict("second_starts", good);

    begin(1);
    pass_on(0);
    end(1);
    verdict("second_loses_no_wake", seen == 2u * ROUNDS);

    begin(2);
    add();
    end(2);
    verdict("second_lock_is_one", sum == 2u * ROUNDS);

    begin(3);
    good = 1;
    while (done != 3) { /* interrupted at every place of a division */
        const uint32_t n = 0xfffffff0u - rounds, d = (rounds & 1023u) + 3u, q = n / d;
        good &= n - q * d < d;
        rounds = rounds + 1u;
    }
    verdict("second_call_may_divide", good && calls == ROUNDS && quotients == 0);

    const uint32_t before = calls;
    second_call();
    second_barrier();
    verdict("second_call_of_the_first", calls == before + 1u);

    const uint64_t from = hal_ticks();
    second_sleep(0); /* an event may be left */
    for (int i = 0; i < 4; i++)
        second_sleep(500);
    const uint64_t took = hal_ticks() - from;
    verdict("second_sleep_ends", took >= 500u && took < 3000u);

    /* stopped anywhere, the lock in its hands or not */
    good = 1;
    for (uint32_t i = 0; i < 20; i++) {
        sum = done = job = 0;
        good &= second_start(run, called) == HAL_ERR_NONE;
        begin(2);
        for (volatile uint32_t wait = 10u + i; wait; wait = wait - 1u) {
        }
        second_stop();
        second_lock();
        second_unlock();
    }
    sum = done = job = 0;
    good &= second_start(run, called) == HAL_ERR_NONE;
    begin(2);
    end(2);
    verdict("second_starts_again", good && sum == ROUNDS && second_stack_used() > 0 && second_stack_used() < 512);
    hal_exit(0);
}
