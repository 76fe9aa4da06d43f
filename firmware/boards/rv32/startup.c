/* 32-bit RISC-V in machine mode: from the reset to main.
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdint.h>

#define PAINT 0xa5a5a5a5u /* what hal/stack/stack.c looks for */

/* From sections.ld. */
extern uint32_t __data_load[], __data_start[], __data_end[], __bss_start[], __bss_end[];
extern uint32_t __stack_limit[], __stack_top[];

int main(void);
void Reset_Handler(void);
void start(void);
void Default_Handler(void);
void Trap_Handler(void) __attribute__((weak, alias("Default_Handler"))); /* a HAL may define it */

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
    const uint32_t *from = __data_load;
    for (uint32_t *at = __data_start; at < __data_end; at++)
        *at = *from++;
    for (uint32_t *at = __bss_start; at < __bss_end; at++)
        *at = 0;
    uint32_t *sp;
    __asm__ volatile("mv %0, sp" : "=r"(sp));
    for (volatile uint32_t *at = __stack_limit; at < sp; at++)
        *at = PAINT;
    (void)main();
    Default_Handler();
}
