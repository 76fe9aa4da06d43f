/* How much of the stack was used: a pattern, and how far down it is gone. For cores whose stack grows downwards; the
 * linker script says where it lies.
 *
 * SPDX-License-Identifier: MIT
 */
#include "hal.h"

#define PAINT 0xa5a5a5a5u
#ifdef __riscv
#define READ_SP "mv %0, sp"
#else /* Arm */
#define READ_SP "mov %0, sp"
#endif

extern uint32_t __stack_limit[], __stack_top[]; /* from the linker script */

void hal_stack_paint(void)
{
    volatile uint32_t *sp; /* an interrupt that comes now only unpaints what it used */
    __asm__ volatile(READ_SP : "=r"(sp));
    for (volatile uint32_t *at = __stack_limit; at < sp; at++)
        *at = PAINT;
}

uint32_t hal_stack_used(void)
{
    const volatile uint32_t *at = __stack_limit;
    while (at < __stack_top && *at == PAINT)
        at++;
    return (uint32_t)((uintptr_t)__stack_top - (uintptr_t)at);
}
