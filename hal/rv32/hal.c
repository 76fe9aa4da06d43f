/* QEMU's 32-bit RISC-V virt board for benches: text by semihosting, minstret as instruction counter, no panel
 * (hal/null's bus).
 *
 * Semihosting (RISC-V, "RISC-V Semihosting"): operation in a0, its argument in a1, and an ebreak between two shifts of
 * the zero register; none of the three compressed, and all in one page. With -icount shift=0 QEMU's minstret (The
 * RISC-V Instruction Set Manual, volume II, 3.1.10) is exact.
 *
 * SPDX-License-Identifier: MIT
 */
#include "hal.h"
#include "null.h"
#include "semihosting.h"

/* CSRs are an extension of their own, and what the board is compiled for is without it. */
#define READ_CSR(name, to) \
    __asm__ volatile(".option push\n.option arch, +zicsr\ncsrr %0, " #name "\n.option pop" : "=r"(to))

void Trap_Handler(void);

static uint64_t start;

void semihosting_call(uint32_t operation, uint32_t argument)
{
    register uint32_t a0 __asm__("a0") = operation;
    register uint32_t a1 __asm__("a1") = argument;
    __asm__ volatile(".option push\n.option norvc\n.balign 16\n"
                     "slli zero, zero, 0x1f\nebreak\nsrai zero, zero, 7\n.option pop" : "+r"(a0) : "r"(a1) : "memory");
}

/* A fault: an instruction that rv32imc does not have, above all. Nothing here enables interrupts. */
void Trap_Handler(void)
{
    uint32_t word[2]; /* volume II, 3.1.14 and 3.1.15 */
    char text[] = "trap: mcause 00000000, mepc 00000000\n";
    READ_CSR(mcause, word[0]);
    READ_CSR(mepc, word[1]);
    for (uint32_t i = 0; i < 8; i++) {
        text[13u + i] = "0123456789abcdef"[word[0] >> (28u - 4u * i) & 15u];
        text[28u + i] = "0123456789abcdef"[word[1] >> (28u - 4u * i) & 15u];
    }
    hal_write(text);
    hal_exit(1);
}

static uint64_t minstret(void)
{
    uint32_t high, low, again;
    do { /* a carry between the reads is seen and read again */
        READ_CSR(minstreth, high);
        READ_CSR(minstret, low);
        READ_CSR(minstreth, again);
    } while (high != again);
    return (uint64_t)high << 32 | low;
}

int hal_init(void)
{
    if (!start)
        start = minstret();
    null_bus_start();
    return HAL_ERR_NONE;
}

uint64_t hal_ticks(void)
{
    return minstret() - start;
}

uint32_t hal_tick_hz(void)
{
    return 0; /* under -icount time is instructions */
}

uint32_t hal_tick_instructions(void)
{
    return 1;
}

void hal_backlight(uint8_t level)
{
    (void)level;
}
