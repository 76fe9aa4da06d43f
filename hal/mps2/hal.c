/* QEMU's mps2-an385 (Cortex-M3): text by semihosting, SysTick as instruction counter, no panel.
 *
 * With -icount shift=0 an instruction takes one virtual nanosecond, and SysTick on the 25 MHz system
 * clock counts 40 of them a tick. The 24-bit counter wraps every 671 million instructions; its interrupt
 * counts the wraps (about 15 instructions each).
 *
 * Semihosting (Arm, "Semihosting for AArch32 and AArch64"): operation in r0, its argument in r1, bkpt 0xab.
 *
 * SPDX-License-Identifier: MIT
 */
#include "hal.h"

#define SYST_CSR (*(volatile uint32_t *)0xe000e010u)
#define SYST_RVR (*(volatile uint32_t *)0xe000e014u)
#define SYST_CVR (*(volatile uint32_t *)0xe000e018u)
#define SYST_ON 7u            /* system clock, interrupt, enable */
#define SYST_TOP 0x00ffffffu

#ifndef HAL_TICK_INSTRUCTIONS_X2
#define HAL_TICK_INSTRUCTIONS_X2 80u /* 2 * 1 GHz / 25 MHz; another board of QEMU's has its own */
#endif

#define SYS_WRITE0 0x04u
#define SYS_EXIT 0x18u
#define EXIT_OK 0x20026u      /* ADP_Stopped_ApplicationExit */
#define EXIT_FAILED 0x20023u  /* ADP_Stopped_RunTimeErrorUnknown */

#define PAINT 0xa5a5a5a5u

extern uint32_t __stack_limit[], __stack_top[]; /* from the linker script */

void SysTick_Handler(void);
void HardFault_Handler(void);

static volatile uint32_t wraps;
static uint8_t ready, busy; /* flags */

static void semihost(uint32_t operation, uint32_t argument)
{
    register uint32_t r0 __asm__("r0") = operation;
    register uint32_t r1 __asm__("r1") = argument;
    __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
}

void SysTick_Handler(void)
{
    wraps++;
}

void HardFault_Handler(void)
{
    hal_write("mps2: hard fault\n");
    hal_exit(1);
}

int hal_init(void)
{
    if (ready)
        return HAL_OK;
    SYST_RVR = SYST_TOP;
    SYST_CVR = 0;
    SYST_CSR = SYST_ON;
    while (SYST_CVR == 0) {
    }
    wraps = 0;
    ready = 1;
    return HAL_OK;
}

void hal_exit(int status)
{
    semihost(SYS_EXIT, status ? EXIT_FAILED : EXIT_OK);
    for (;;) {
    }
}

void hal_write(const char *text)
{
    semihost(SYS_WRITE0, (uint32_t)text);
}

uint64_t hal_ticks(void)
{
    uint32_t before, down;
    do { /* a wrap between the two reads is seen and read again */
        before = wraps;
        down = SYST_CVR;
    } while (before != wraps);
    return (uint64_t)before * (SYST_TOP + 1u) + (SYST_TOP - down);
}

uint32_t hal_tick_hz(void)
{
    return 0; /* under -icount time is instructions */
}

uint32_t hal_tick_instructions(void)
{
    return (HAL_TICK_INSTRUCTIONS_X2 + 1u) / 2u;
}

/* ---- The bus: no panel ------------------------------------------------------------------------------ */

static int command(struct hal_bus *bus, uint8_t code, const uint8_t *args, uint32_t n)
{
    (void)bus;
    (void)code;
    if (n && !args)
        return HAL_ERR_ARG;
    return !ready || busy ? HAL_ERR_STATE : HAL_OK;
}

static int data(struct hal_bus *bus, const uint8_t *bytes, uint32_t n)
{
    (void)bus;
    if (!bytes || !n)
        return HAL_ERR_ARG;
    if (!ready || busy)
        return HAL_ERR_STATE;
    busy = 1;
    return HAL_OK;
}

static int wait(struct hal_bus *bus)
{
    if (busy && bus->hooks.done)
        bus->hooks.done(bus->hooks.ctx);
    busy = 0;
    return HAL_OK;
}

static int reset(struct hal_bus *bus)
{
    (void)bus;
    return busy ? HAL_ERR_STATE : HAL_OK;
}

static void delay(struct hal_bus *bus, uint32_t us)
{
    (void)bus;
    (void)us;
}

static struct hal_bus the_bus = { command, data, wait, reset, delay, { 0 } };

struct hal_bus *hal_bus(void)
{
    return &the_bus;
}

void hal_backlight(uint8_t level)
{
    (void)level;
}

void hal_stack_paint(void)
{
    volatile uint32_t *sp; /* an interrupt that comes now only unpaints what it used */
    __asm__ volatile("mov %0, sp" : "=r"(sp));
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
