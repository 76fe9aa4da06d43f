/* Ticks of the core's clock: SysTick counts 24 bits down, its interrupt counts the wraps (about 15 instructions each).
 *
 * SPDX-License-Identifier: MIT
 */
#include "cortexm.h"
#include "hal.h"

#define SYST_CSR (*(volatile uint32_t *)0xe000e010u)
#define SYST_RVR (*(volatile uint32_t *)0xe000e014u)
#define SYST_CVR (*(volatile uint32_t *)0xe000e018u)
#define SYST_ON 7u /* the core's clock, interrupt, enable */
#define SYST_ENABLE 1u
#define SYST_TOP 0x00ffffffu
#define SCB_ICSR (*(volatile uint32_t *)0xe000ed04u)
#define SCB_SYST_PENDING (1u << 26)

void SysTick_Handler(void);

static volatile uint32_t wraps;

void SysTick_Handler(void)
{
    wraps++;
}

void cortexm_ticks_start(void)
{
    SYST_RVR = SYST_TOP;
    SYST_CVR = 0;
    SYST_CSR = SYST_ON;
    while (SYST_CVR == 0) { /* the first reload */
    }
    wraps = 0;
}

/* A round begins at 0, where the interrupt becomes pending (Armv7-M manual, B3.3.1). One that is not counted yet, as
 * its interrupt comes this moment or interrupts are off, is counted here. */
uint64_t hal_ticks(void)
{
    uint32_t before, into, pending;
    do { /* the interrupt between the reads is seen and all are read again */
        before = wraps;
        into = (0u - SYST_CVR) & SYST_TOP;
        pending = SCB_ICSR & SCB_SYST_PENDING;
    } while (before != wraps);
    return ((uint64_t)before + (pending && into <= SYST_TOP / 2u)) * (SYST_TOP + 1u) + into;
}

void cortexm_pause_us(uint32_t us)
{
    if (!(SYST_CSR & SYST_ENABLE))
        return;
    const uint64_t ticks = (uint64_t)us * (hal_tick_hz() / 1000000u), from = hal_ticks();
    while (hal_ticks() - from <= ticks) { /* one more than asked for: the first one has begun already */
    }
}
