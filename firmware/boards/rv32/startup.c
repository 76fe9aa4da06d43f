/* 32-bit RISC-V in machine mode: from the reset to main.
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdint.h>

#include "../startup.h"

void start(void);
void Trap_Handler(void) WEAK; /* a HAL may define it */

void Default_Handler(void)
{
    for (;;) {
    }
}

/* The first instruction of the image: there is no stack yet. */
__attribute__((naked, section(".vectors"))) void Reset_Handler(void)
{
    __asm__ volatile(".option push\n"
                     ".option arch, +zicsr\n"
                     "la sp, __stack_top\n"
                     "la t0, trap_entry\n"
                     "csrw mtvec, t0\n"
                     "j start\n"
                     ".option pop\n"
                     ".balign 4\n" /* mtvec's low bits are its mode */
                     "trap_entry: j Trap_Handler");
}

/* Naked of locals on purpose: everything below the stack pointer is painted. */
void start(void)
{
    memory_start();
    uint32_t *sp;
    __asm__ volatile("mv %0, sp" : "=r"(sp));
    for (volatile uint32_t *at = __stack_limit; at < sp; at++)
        *at = PAINT;
    (void)main();
    Default_Handler();
}
