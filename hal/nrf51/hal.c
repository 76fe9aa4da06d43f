/* micro:bit v1 (nRF51822 at 16 MHz): clock, ticks of TIMER0, the light. Text is in uart.c, the panel's bus in bus.c,
 * the wiring in pins.h.
 *
 * TIMER0 counts microseconds in 32 bits. Its interrupt, each 36 minutes, counts the halves of its range: the counter's
 * top bit tells whether there was a half since. So nothing depends on when, or how often, it comes, and it may be late
 * by a half. tests/boards/microbit.sh takes it beyond 32 bits in QEMU. Not tested: a late interrupt, the crystal.
 *
 * SPDX-License-Identifier: MIT
 */
#include "hal.h"

#include "board.h"
#include "parts.h"
#include "pins.h"
#include "regs.h"

#define SPINS 10000u /* of some eight cycles: five milliseconds. The crystal takes one */
#define HALF 0x80000000u
#define ALARM_US 16u /* nearer ones are waited for without sleep */

void TIMER0_Handler(void);

static volatile uint32_t halves; /* of TIMER0's range, whole ones */

typedef void (*vector)(void);
__attribute__((section(".device_vectors"), used)) static const vector device_vectors[IRQ_TIMER0 + 1] = {
    [IRQ_TIMER0] = TIMER0_Handler
};

/* ---- Clock and ticks ------------------------------------------------------------------------------------------ */

/* From the RC oscillator, some per cent off, to the crystal. Where that does not start, the show goes on without. */
static void clock_start(void)
{
    CLOCK_HFCLKSTARTED = 0;
    CLOCK_HFCLKSTART = 1;
    for (uint32_t i = 0; i < SPINS && !CLOCK_HFCLKSTARTED; i++) {
    }
}

static void ticks_start(void)
{
    TIMER_BITMODE = TIMER_32_BITS;
    TIMER_PRESCALER = TIMER_1_MHZ;
    TIMER_CC(0) = HALF;
    TIMER_CC(1) = 0;
    TIMER_INTENSET = TIMER_ON_COMPARE(0) | TIMER_ON_COMPARE(1) | TIMER_ON_COMPARE(3);
    NVIC_ISER = 1u << IRQ_TIMER0;
    TIMER_START = 1;
}

static uint32_t counter(void)
{
    TIMER_CAPTURE(2) = 1;
    return TIMER_CC(2);
}

/* How many halves there were when `low` was read, soon after there were `before`: odd with the top bit, else even. */
static uint32_t halves_at(uint32_t before, uint32_t low)
{
    return before + ((before ^ low / HALF) & 1u);
}

void TIMER0_Handler(void)
{
    TIMER_COMPARE(0) = 0;
    TIMER_COMPARE(1) = 0;
    TIMER_COMPARE(3) = 0; /* has ended a sleep */
    halves = halves_at(halves, counter());
}

uint64_t hal_ticks(void)
{
    uint32_t before, low;
    do { /* the interrupt between the two reads is seen and both are read again */
        before = halves;
        low = counter();
    } while (before != halves);
    return (uint64_t)(halves_at(before, low) / 2u) << 32 | low;
}

/* Interrupts are off from the question to the sleep, so that the alarm cannot come between; one that is pending ends
 * the sleep (Armv6-M manual, B1.5.18) and runs as soon as they are on. */
void nrf51_pause_us(uint32_t us)
{
    const uint64_t until = hal_ticks() + us + 1u; /* this tick has begun already */
    TIMER_CC(3) = (uint32_t)until;
    while (hal_ticks() < until) {
        __asm__ volatile("cpsid i" ::: "memory");
        if (hal_ticks() + ALARM_US < until)
            __asm__ volatile("wfi" ::: "memory");
        __asm__ volatile("cpsie i" ::: "memory");
    }
}

uint32_t hal_tick_hz(void)
{
    return 1000000u;
}

uint32_t hal_tick_instructions(void)
{
    return 0; /* in QEMU with -icount shift=0: 1000 */
}

/* ---- The board ---------------------------------------------------------------------------------------------- */

const char board_fault[] = "microbit: hard fault\n";

int board_start(void)
{
    clock_start();
    ticks_start();
    nrf51_uart_start();
    nrf51_bus_start();
    hal_backlight(0);
    GPIO_DIRSET = 1u << PIN_BACKLIGHT;
    return HAL_ERR_NONE;
}

void board_flush(void)
{
}

void hal_backlight(uint8_t level)
{
    if (level)
        GPIO_OUTSET = 1u << PIN_BACKLIGHT;
    else
        GPIO_OUTCLR = 1u << PIN_BACKLIGHT;
}
