/* RP2040: the registers and bits that this HAL uses, each under the section of the RP2040 datasheet that defines it.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef RP2040_REGS_H
#define RP2040_REGS_H

#include <stdint.h>

#define REG(address) (*(volatile uint32_t *)(address))

/* 2.1.2: a write to the alias sets or clears bits of a register of the peripherals below 0xd0000000 */
#define SET_ALIAS 0x2000u
#define CLEAR_ALIAS 0x3000u

/* 2.3.1.7: SIO */
#define SIO_CPUID REG(0xd0000000u)
#define SIO_GPIO_OUT_SET REG(0xd0000014u)
#define SIO_GPIO_OUT_CLR REG(0xd0000018u)
#define SIO_GPIO_OE_SET REG(0xd0000024u)
#define SIO_DIV_UDIVIDEND REG(0xd0000060u)
#define SIO_DIV_UDIVISOR REG(0xd0000064u)
#define SIO_DIV_QUOTIENT REG(0xd0000070u)
#define SIO_DIV_REMAINDER REG(0xd0000074u)
#define SIO_DIV_CSR REG(0xd0000078u)
#define SIO_DIV_READY 1u
#define SIO_FIFO_ST REG(0xd0000050u) /* each core sees its own side of the two FIFOs; a write clears the errors */
#define SIO_FIFO_WR REG(0xd0000054u)
#define SIO_FIFO_RD REG(0xd0000058u)
#define SIO_FIFO_VLD (1u << 0) /* there is a word to read */
#define SIO_FIFO_RDY (1u << 1) /* there is room to write */
#define SIO_SPINLOCK(n) REG(0xd0000100u + 4u * (n)) /* not 0 where the read takes it; any write gives it back */

/* 2.3.2: interrupt numbers */
#define IRQ_TIMER_0 0u
#define IRQ_TIMER_1 1u
#define IRQ_DMA_0 11u
#define IRQ_SIO_0 15u /* core 0's; on while its FIFO holds a word */

/* 2.4.8: Cortex-M0+ */
#define NVIC_ISER REG(0xe000e100u)
#define NVIC_ICER REG(0xe000e180u)
#define NVIC_ICPR REG(0xe000e280u)
#define SCB_ICSR REG(0xe000ed04u)
#define SCB_PENDSVSET (1u << 28)

/* 2.5.7: DMA. n is a channel */
#define DMA_READ_ADDR(n) REG(0x50000000u + 0x40u * (n))
#define DMA_WRITE_ADDR(n) REG(0x50000004u + 0x40u * (n))
#define DMA_TRANS_COUNT(n) REG(0x50000008u + 0x40u * (n))
#define DMA_CTRL_TRIG(n) REG(0x5000000cu + 0x40u * (n))
#define DMA_CTRL(n) REG(0x50000010u + 0x40u * (n)) /* AL1_CTRL: the same, does not start the channel */
#define DMA_INTE0 REG(0x50000404u)
#define DMA_INTS0 REG(0x5000040cu)
#define DMA_CHAN_ABORT REG(0x50000444u)
#define DMA_EN (1u << 0)
#define DMA_HALFWORDS (1u << 2) /* DATA_SIZE; 0 is bytes */
#define DMA_INCR_READ (1u << 4)
#define DMA_CHAIN_TO(n) ((n) << 11) /* to itself: to none */
#define DMA_TREQ(n) ((n) << 15)
#define DMA_BSWAP (1u << 22)
#define DMA_BUSY (1u << 24)
#define DMA_WRITE_ERROR (1u << 29)
#define DMA_READ_ERROR (1u << 30)
#define DREQ_SPI0_TX 16u /* 2.5.3.1 */
#define DREQ_UART0_TX 20u

/* 2.13.5: power-on state machine */
#define PSM_FRCE_OFF 0x40010004u
#define PSM_PROC1 (1u << 16)

/* 2.14.3: resets */
#define RESETS_RESET 0x4000c000u
#define RESETS_RESET_DONE REG(0x4000c008u)
#define RESET_DMA (1u << 2)
#define RESET_IO_BANK0 (1u << 5)
#define RESET_PADS_BANK0 (1u << 8)
#define RESET_PLL_SYS (1u << 12)
#define RESET_PWM (1u << 14)
#define RESET_SPI0 (1u << 16)
#define RESET_TIMER (1u << 21)
#define RESET_UART0 (1u << 22)

/* 2.15.7: clocks */
#define CLK_REF_CTRL REG(0x40008030u)
#define CLK_REF_SELECTED REG(0x40008038u)
#define CLK_SYS_CTRL 0x4000803cu
#define CLK_SYS_DIV REG(0x40008040u)
#define CLK_SYS_SELECTED REG(0x40008044u)
#define CLK_PERI_CTRL REG(0x40008048u)
#define CLK_REF_XOSC 2u
#define CLK_SYS_AUX 1u /* SRC; 0 is clk_ref */
#define CLK_SYS_ON_REF 1u
#define CLK_SYS_ON_AUX 2u
#define CLK_DIV_1 0x100u
#define CLK_PERI_ENABLE (1u << 11) /* with AUXSRC 0: clk_sys */

/* 2.16.7: crystal oscillator */
#define XOSC_CTRL REG(0x40024000u)
#define XOSC_STATUS REG(0x40024004u)
#define XOSC_STARTUP REG(0x4002400cu)
#define XOSC_ON 0x00fabaa0u /* ENABLE fab, FREQ_RANGE aa0: 1 .. 15 MHz */
#define XOSC_STABLE (1u << 31)

/* 2.18.4: PLL */
#define PLL_SYS_CS REG(0x40028000u)
#define PLL_SYS_PWR REG(0x40028004u)
#define PLL_SYS_FBDIV REG(0x40028008u)
#define PLL_SYS_PRIM REG(0x4002800cu)
#define PLL_LOCK (1u << 31)
#define PLL_DSMPD (1u << 2) /* PWR: a set bit switches off. The modulator is not used */
#define PLL_POSTDIVPD (1u << 3)

/* 2.19.6: GPIO functions (IO_BANK0) and pads */
#define GPIO_CTRL(pin) REG(0x40014004u + 8u * (pin))
#define PAD_CTRL(pin) REG(0x4001c004u + 4u * (pin))
#define FUNC_SPI 1u
#define FUNC_UART 2u
#define FUNC_PWM 4u
#define FUNC_SIO 5u
#define PAD_QUICK 0x63u /* input on, 8 mA, Schmitt trigger, fast slew, no pull */

/* 4.2.8: UART0 (PL011) */
#define UART0_DR REG(0x40034000u)
#define UART0_FR REG(0x40034018u)
#define UART0_IBRD REG(0x40034024u)
#define UART0_FBRD REG(0x40034028u)
#define UART0_LCR_H REG(0x4003402cu)
#define UART0_CR REG(0x40034030u)
#define UART0_DMACR REG(0x40034048u)
#define UART_8N1_FIFO 0x70u
#define UART_ON 0x101u /* TXE, UARTEN */
#define UART_BUSY (1u << 3)
#define UART_TXDMAE (1u << 1)

/* 4.4.4: SPI0 (PL022) */
#define SPI0_CR0 REG(0x4003c000u)
#define SPI0_CR1 REG(0x4003c004u)
#define SPI0_DR REG(0x4003c008u)
#define SPI0_SR REG(0x4003c00cu)
#define SPI0_CPSR REG(0x4003c010u)
#define SPI0_DMACR REG(0x4003c024u)
#define SPI_DSS(bits) ((bits) - 1u) /* CR0: bits a word */
#define SPI_SPO (1u << 6)
#define SPI_SPH (1u << 7)
#define SPI_SSE (1u << 1)           /* CR1: on, as master */
#define SPI_TNF (1u << 1)           /* SR: room in the transmit FIFO */
#define SPI_BSY (1u << 4)           /* SR: a word is on the wire or in the transmit FIFO */
#define SPI_TXDMAE (1u << 1)

/* 4.5.3: PWM. n is a slice */
#define PWM_CSR(n) REG(0x40050000u + 0x14u * (n))
#define PWM_DIV(n) REG(0x40050004u + 0x14u * (n))
#define PWM_CC(n) REG(0x4005000cu + 0x14u * (n))
#define PWM_TOP(n) REG(0x40050010u + 0x14u * (n))

/* 4.6.5: timer, 1 MHz */
#define TIMER_ALARM0 REG(0x40054010u)
#define TIMER_ALARM1 REG(0x40054014u)
#define TIMER_ARMED REG(0x40054020u)
#define TIMER_RAWH REG(0x40054024u)
#define TIMER_RAWL REG(0x40054028u)
#define TIMER_INTR REG(0x40054034u)
#define TIMER_INTE REG(0x40054038u)

/* 4.7.6: watchdog; its tick is the timer's too */
#define WATCHDOG_TICK REG(0x4005802cu)
#define TICK_ENABLE (1u << 9)

#endif
