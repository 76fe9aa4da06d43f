/* RP2040: core 1 (second.h). It waits in the boot ROM for a vector table, a stack and an entry, word by word through
 * the SIO's FIFOs, each word sent back (RP2040 datasheet, 2.8.2). From then on a word from it in core 0's FIFO means
 * second_call; sleeping and waking are WFE and SEV, whose events go to both cores.
 *
 * Core 1 has a vector table and a stack of its own; no interrupt is enabled on it. A hard fault there is told to core
 * 0, which writes it and stops, as with its own. SIO's divider is each core's own.
 *
 * Core 0's interrupts all have one priority, so none comes between another's lines: calls from core 1 (SIO_0), calls
 * from core 0 itself (PendSV), the end of a transfer.
 *
 * What an emulator cannot tell: how long the ROM takes, and what two cores that want the same bank of RAM cost each
 * other.
 *
 * SPDX-License-Identifier: MIT
 */
#include "second.h"

#include "../parts.h"
#include "../regs.h"
#include "hal.h"

#define PAINT 0xa5a5a5a5u
#define READY_US 2000u  /* from reset to the ROM's first word */
#define ANSWER_US 2000u /* for all six words; the ROM takes a few cycles for each */
#define LOCK 0u         /* which spinlock */

_Static_assert(READY_US + ANSWER_US < SECOND_START_US, "both, and painting");

void SIO_0_Handler(void);
void PendSV_Handler(void);

extern uint32_t __stack1_limit[], __stack1_top[]; /* from pico.ld */

static void (*the_run)(void), (*the_called)(void);
static volatile uint8_t faulted;

/* ---- On core 1 ------------------------------------------------------------------------------------------------ */

static void rest(void)
{
    for (;;)
        __asm__ volatile("wfi");
}

static void fault(void)
{
    faulted = 1;
    second_call();
    rest();
}

static void enter(void)
{
    __asm__ volatile("cpsid i" ::: "memory");
    the_run();
    rest();
}

typedef void (*vector)(void);

/* Exceptions 0 to 15; 2.4.8: VTOR holds bits 8 and up. Without interrupts only faults use it. */
__attribute__((aligned(256))) static const vector vectors[16] = {
    (vector)(uintptr_t)__stack1_top, enter, fault, fault, 0, 0, 0, 0, 0, 0, 0, fault, 0, 0, fault, fault
};

/* ---- On core 0 ------------------------------------------------------------------------------------------------ */

static void drain(void)
{
    while (SIO_FIFO_ST & SIO_FIFO_VLD)
        (void)SIO_FIFO_RD;
}

/* 1: the FIFO's flag has come before the time was up. */
static int comes(uint32_t flag, uint32_t from, uint32_t us)
{
    while (!(SIO_FIFO_ST & flag))
        if (rp2040_us() - from > us)
            return 0;
    return 1;
}

static void reset(void)
{
    REG(PSM_FRCE_OFF + SET_ALIAS) = PSM_PROC1;
    while (!(REG(PSM_FRCE_OFF) & PSM_PROC1)) {
    }
}

/* The six words; from the first one again where another comes back. What is in the FIFO before a 0 is old. */
static int launch(void)
{
    const uint32_t word[] = { 0, 0, 1, (uint32_t)(uintptr_t)vectors, (uint32_t)(uintptr_t)__stack1_top,
                              (uint32_t)(uintptr_t)enter };
    const uint32_t from = rp2040_us();
    for (uint32_t i = 0; i < sizeof word / sizeof word[0];) {
        if (!word[i]) {
            drain();
            __asm__ volatile("sev"); /* it may wait for room */
        }
        if (!comes(SIO_FIFO_RDY, from, ANSWER_US))
            return HAL_ERR_TIMEOUT;
        SIO_FIFO_WR = word[i];
        __asm__ volatile("sev");
        if (!comes(SIO_FIFO_VLD, from, ANSWER_US))
            return HAL_ERR_TIMEOUT;
        i = SIO_FIFO_RD == word[i] ? i + 1u : 0u;
    }
    return HAL_ERR_NONE;
}

int second_start(void (*run)(void), void (*called)(void))
{
    second_stop();
    for (volatile uint32_t *at = __stack1_limit; at < __stack1_top; at++)
        *at = PAINT;
    the_run = run;
    the_called = called;
    faulted = 0;
    drain();
    second_barrier();
    REG(PSM_FRCE_OFF + CLEAR_ALIAS) = PSM_PROC1;
    (void)comes(SIO_FIFO_VLD, rp2040_us(), READY_US); /* the ROM has emptied its FIFO, and says so by a 0 */
    SIO_FIFO_ST = 0;
    NVIC_ICPR = 1u << IRQ_SIO_0;
    const int err = launch();
    if (err) {
        second_stop();
        return err;
    }
    NVIC_ISER = 1u << IRQ_SIO_0; /* the FIFO is as core 1 has left it: it runs, and may have called */
    return HAL_ERR_NONE;
}

void second_stop(void)
{
    NVIC_ICER = 1u << IRQ_SIO_0;
    reset();
    SIO_SPINLOCK(LOCK) = 0;
}

/* Both interrupts: what core 1 has to say of itself, then the caller's own. */
static void call(void)
{
    if (faulted) {
        hal_write("pico: hard fault on core 1\n");
        hal_exit(1);
    }
    const struct rp2040_divider divider = rp2040_divider_save();
    the_called();
    rp2040_divider_restore(divider);
}

void SIO_0_Handler(void)
{
    drain();
    second_barrier();
    call();
}

void PendSV_Handler(void)
{
    call();
}

/* ---- On either ------------------------------------------------------------------------------------------------- */

static int is_core_1(void)
{
    return SIO_CPUID != 0;
}

/* Where the FIFO is full the interrupt is on already. */
void second_call(void)
{
    second_barrier();
    if (!is_core_1())
        SCB_ICSR = SCB_PENDSVSET;
    else if (SIO_FIFO_ST & SIO_FIFO_RDY)
        SIO_FIFO_WR = 0;
}

void second_wake(void)
{
    __asm__ volatile("dmb\n\tsev" ::: "memory");
}

/* An event that has come since the last WFE lets this one return at once (Armv6-M manual, B1.5.17), and so does the end
 * of an interrupt: what is asked before the sleep cannot change unseen. */
void second_sleep(uint32_t most_us)
{
    if (most_us)
        TIMER_ALARM1 = rp2040_us() + most_us; /* its interrupt does nothing more */
    __asm__ volatile("wfe\n\tdmb" ::: "memory");
}

void second_barrier(void)
{
    __asm__ volatile("dmb" ::: "memory");
}

void second_lock(void)
{
    while (!SIO_SPINLOCK(LOCK)) {
    }
    second_barrier();
}

void second_unlock(void)
{
    second_barrier();
    SIO_SPINLOCK(LOCK) = 0;
}

uint32_t second_stack_used(void)
{
    const volatile uint32_t *at = __stack1_limit;
    while (at < __stack1_top && *at == PAINT)
        at++;
    return (uint32_t)((uintptr_t)__stack1_top - (uintptr_t)at);
}
