/* RP2040: 12 MHz crystal to 125 MHz, and a 1 MHz timer. Sections of the RP2040 datasheet beside each step.
 *
 * What an emulator cannot tell: that the crystal is stable, that the PLL locks, that the order of the steps has no
 * glitch. They are the datasheet's.
 *
 * SPDX-License-Identifier: MIT
 */
#include "parts.h"
#include "regs.h"

void TIMER_1_Handler(void);

#define XOSC_MHZ 12u
#define XOSC_DELAY (4u * XOSC_MHZ * 1000u / 256u) /* 4 ms in 256 crystal cycles (2.16.3); boards differ from 1 ms up */

#define PLL_FBDIV 125u                          /* VCO: 12 MHz * 125 = 1500 MHz (750 .. 1600, 2.18.2) */
#define PLL_POSTDIV (6u << 16 | 2u << 12)       /* / 6 / 2 = 125 MHz */

void rp2040_restart(uint32_t blocks)
{
    REG(RESETS_RESET + SET_ALIAS) = blocks;
    REG(RESETS_RESET + CLEAR_ALIAS) = blocks;
    while ((RESETS_RESET_DONE & blocks) != blocks) {
    }
}

static void crystal_start(void)
{
    XOSC_STARTUP = XOSC_DELAY;
    XOSC_CTRL = XOSC_ON;
    while (!(XOSC_STATUS & XOSC_STABLE)) {
    }
}

/* 2.18.3: VCO first, post dividers when it has locked. */
static void pll_start(void)
{
    rp2040_restart(RESET_PLL_SYS);
    PLL_SYS_CS = 1; /* REFDIV */
    PLL_SYS_FBDIV = PLL_FBDIV;
    PLL_SYS_PWR = PLL_DSMPD | PLL_POSTDIVPD;
    while (!(PLL_SYS_CS & PLL_LOCK)) {
    }
    PLL_SYS_PRIM = PLL_POSTDIV;
    PLL_SYS_PWR = PLL_DSMPD;
}

void rp2040_clocks_start(void)
{
    crystal_start();
    /* 2.15.3.2: away from the PLL before that is touched, by the multiplexer that has no glitches; the other one,
     * AUXSRC, is moved while it is not in use */
    REG(CLK_SYS_CTRL + CLEAR_ALIAS) = CLK_SYS_AUX;
    while (!(CLK_SYS_SELECTED & CLK_SYS_ON_REF)) {
    }
    CLK_REF_CTRL = CLK_REF_XOSC;
    while (!(CLK_REF_SELECTED & 1u << CLK_REF_XOSC)) {
    }
    pll_start();
    CLK_SYS_DIV = CLK_DIV_1;
    REG(CLK_SYS_CTRL) = 0; /* AUXSRC: PLL_SYS */
    REG(CLK_SYS_CTRL + SET_ALIAS) = CLK_SYS_AUX;
    while (!(CLK_SYS_SELECTED & CLK_SYS_ON_AUX)) {
    }
    CLK_PERI_CTRL = CLK_PERI_ENABLE;
    WATCHDOG_TICK = TICK_ENABLE | XOSC_MHZ; /* 4.7.2: clk_ref cycles to a tick */
    rp2040_restart(RESET_IO_BANK0 | RESET_PADS_BANK0 | RESET_DMA | RESET_SPI0 | RESET_UART0 | RESET_PWM | RESET_TIMER);
    TIMER_INTE = 1u << 0 | 1u << 1;
    NVIC_ICPR = 1u << IRQ_TIMER_1;
    NVIC_ISER = 1u << IRQ_TIMER_1;
}

uint32_t rp2040_us(void)
{
    return TIMER_RAWL;
}

void TIMER_1_Handler(void)
{
    TIMER_INTR = 1u << 1;
}

/* The alarm only wakes; the clock is asked. It fires on equality, so one that is set too late never does: the clock is
 * asked after it is set, and then says that the time is up. */
void rp2040_pause_us(uint32_t us)
{
    const uint32_t start = rp2040_us();
    for (;;) {
        __asm__ volatile("cpsid i" ::: "memory");
        TIMER_ALARM1 = start + us + 1u; /* one more than asked for: the first tick may come at once */
        const int more = rp2040_us() - start <= us;
        if (more)
            __asm__ volatile("wfi" ::: "memory");
        __asm__ volatile("cpsie i" ::: "memory");
        if (!more)
            return;
    }
}
