/* What the boards' ways from the reset to main have in common.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef BOARDS_STARTUP_H
#define BOARDS_STARTUP_H

#include <stdint.h>

#define PAINT 0xa5a5a5a5u /* what hal/stack/stack.c looks for */

/* From the linker script. */
extern uint32_t __data_load[], __data_start[], __data_end[], __bss_start[], __bss_end[];
extern uint32_t __stack_limit[], __stack_top[];

int main(void);
void Reset_Handler(void);
void Default_Handler(void);

/* Weak: the HAL defines those that it uses. */
#define WEAK __attribute__((weak, alias("Default_Handler")))

#define INLINE static inline __attribute__((always_inline))

/* Copy what has values, clear the rest. Not for code that still has to be copied itself: a compiler may make memcpy and
 * memset of it. */
INLINE void memory_start(void)
{
    const uint32_t *from = __data_load;
    for (uint32_t *at = __data_start; at < __data_end; at++)
        *at = *from++;
    for (uint32_t *at = __bss_start; at < __bss_end; at++)
        *at = 0;
}

/* Paint everything below the stack pointer, and run the program. Its caller has no locals. */
INLINE void main_start(void)
{
    uint32_t *sp;
#if defined(__riscv)
    __asm__ volatile("mv %0, sp" : "=r"(sp));
#else
    __asm__ volatile("mov %0, sp" : "=r"(sp));
#endif
    for (volatile uint32_t *at = __stack_limit; at < sp; at++)
        *at = PAINT;
    (void)main();
    Default_Handler();
}

#endif
