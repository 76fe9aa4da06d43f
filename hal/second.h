/* A second core that shares all memory with the first: started, stopped, woken, called. Not part of hal.h: only boards
 * whose board.mk names BOARD_SECOND have it (hal/rp2040), and only images built with CORES=2 link it.
 *
 * The first core is the one that hal_init was called on. It owns the board: hal.h is for it alone, but for hal_ticks,
 * which either core may call, in interrupts too. What one core has written before second_barrier, second_wake or
 * second_call, the other one sees after the barrier, wake or call that tells it so.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SECOND_H
#define SECOND_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Reset the second core and let it run. First core; after hal_init; also when it runs already, which ends that.
 *
 * run      called on the second core, on a stack of its own, interrupts off. Where it returns the core sleeps for ever.
 * called   called on the first core after second_call, in an interrupt that never comes between the lines of another
 *          interrupt of this HAL, hooks.done among them, nor they between its lines. May begin transfers: the bus's
 *          command, data and (after done) wait.
 * Blocks   some microseconds; at most SECOND_START_US.
 * Return   HAL_ERR_NONE; HAL_ERR_TIMEOUT: it did not answer, and is held in reset. */
#define SECOND_START_US 20000u
int second_start(void (*run)(void), void (*called)(void));

/* Hold the second core in reset, whatever it is at, and give its lock back. First core. Blocks a moment. */
void second_stop(void);

/* Let the first core call `called` soon. Either core, not from an interrupt. Several calls may become one; one that
 * nobody asked for may come at the start. */
void second_call(void);

/* End the other core's second_sleep, or else its next one. Either core, also from an interrupt. */
void second_wake(void);

/* Sleep until the other core's second_wake, or an interrupt, or for no reason: ask in a loop.
 * most_us  first core: no longer than so many us, 10 or more; 0, and the second core: as long as it takes. */
void second_sleep(uint32_t most_us);

/* Between what is written for the other core and the flag that says so; between seeing the flag and reading. */
void second_barrier(void);

/* One lock between the cores, for a few lines. Not from an interrupt; not twice. Blocks while the other one has it: for
 * ever, if it stops there. */
void second_lock(void);
void second_unlock(void);

/* Bytes of the second core's stack, counted from its top, that have been touched since second_start. Either core. */
uint32_t second_stack_used(void);

#ifdef __cplusplus
}
#endif

#endif
