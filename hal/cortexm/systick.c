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
#define SYST_TOP 0x00ffffffu

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

uint64_t hal_ticks(void)
{
    uint32_t before, down;
    do { /* a wrap between the two reads is seen and read again */
        before = wraps;
        down = SYST_CVR;
    } while (before != wraps);
    return (uint64_t)before * (SYST_TOP + 1u) + (SYST_TOP - down);
}
