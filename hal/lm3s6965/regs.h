/* LM3S6965: the registers and bits that this HAL uses, each under the chapter of the LM3S6965 data sheet (Texas
 * Instruments) that defines it.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef LM3S6965_REGS_H
#define LM3S6965_REGS_H

#include <stdint.h>

#define REG(address) (*(volatile uint32_t *)(address))

/* Interrupts: numbers */
#define IRQ_SSI0 7u

/* Cortex-M3: nested vectored interrupt controller */
#define NVIC_ISER REG(0xe000e100u)
#define NVIC_ICPR REG(0xe000e280u)

/* System Control */
#define SYS_DID0 REG(0x400fe000u)
#define SYS_LDOPCTL REG(0x400fe034u)
#define SYS_SRCR1 REG(0x400fe044u) /* resets */
#define SYS_RIS REG(0x400fe050u)
#define SYS_MISC REG(0x400fe058u)
#define SYS_RCC REG(0x400fe060u)
#define SYS_RCGC1 REG(0x400fe104u) /* clocks of blocks */
#define SYS_RCGC2 REG(0x400fe108u)
#define DID0_REVISION 0xffffu
#define DID0_A2 0x0002u
#define LDO_2_75V 0x1bu
#define PLL_LOCKED (1u << 6)    /* RIS; MISC: written, clears it */
#define RCC_MOSCDIS (1u << 0)   /* crystal oscillator off */
#define RCC_OSCSRC (3u << 4)    /* 0: from the crystal */
#define RCC_XTAL (15u << 6)
#define RCC_XTAL_8MHZ (14u << 6)
#define RCC_BYPASS (1u << 11)   /* the core runs past the PLL */
#define RCC_PWRDN (1u << 13)    /* PLL off */
#define RCC_USESYSDIV (1u << 22)
#define RCC_SYSDIV (15u << 23)
#define RCC_SYSDIV_4 (3u << 23) /* 200 MHz of the PLL / 4 */
#define BLOCK_UART0 (1u << 0)   /* RCGC1 */
#define BLOCK_SSI0 (1u << 4)    /* RCGC1, SRCR1 */

/* General-Purpose Input/Outputs: ports A to D, and E to G; a pin is 8 * port + number */
#define GPIO(pin) (0x40004000u + 0x1000u * ((pin) / 8u % 4u) + 0x20000u * ((pin) / 32u))
#define GPIO_BIT(pin) (1u << (pin) % 8u)
#define GPIO_LEVEL(pin) REG(GPIO(pin) + 4u * GPIO_BIT(pin)) /* GPIODATA: the address says which bits are meant */
#define GPIO_DIR(pin) REG(GPIO(pin) + 0x400u)
#define GPIO_AFSEL(pin) REG(GPIO(pin) + 0x420u)
#define GPIO_DEN(pin) REG(GPIO(pin) + 0x51cu)
#define GPIO_BLOCK(pin) (1u << (pin) / 8u) /* RCGC2 */

/* Synchronous Serial Interface: SSI0 (PL022) */
#define SSI0_CR0 REG(0x40008000u)
#define SSI0_CR1 REG(0x40008004u)
#define SSI0_DR REG(0x40008008u)
#define SSI0_SR REG(0x4000800cu)
#define SSI0_CPSR REG(0x40008010u)
#define SSI0_IM REG(0x40008014u)
#define SSI_8_BITS 7u       /* CR0 */
#define SSI_SPO (1u << 6)
#define SSI_SPH (1u << 7)
#define SSI_SSE (1u << 1)   /* CR1: on, as master */
#define SSI_TNF (1u << 1)   /* SR: room in the transmit FIFO */
#define SSI_RNE (1u << 2)   /* SR: something in the receive FIFO */
#define SSI_BSY (1u << 4)   /* SR: a byte is on the wire or in the transmit FIFO */
#define SSI_TXIM (1u << 3)  /* IM: transmit FIFO half empty, or more */

/* Universal Asynchronous Receivers/Transmitters: UART0 (PL011) */
#define UART0_DR REG(0x4000c000u)
#define UART0_FR REG(0x4000c018u)
#define UART0_IBRD REG(0x4000c024u)
#define UART0_FBRD REG(0x4000c028u)
#define UART0_LCRH REG(0x4000c02cu)
#define UART0_CTL REG(0x4000c030u)
#define UART_8N1_FIFO 0x70u
#define UART_ON 0x101u      /* TXE, UARTEN */
#define UART_BUSY (1u << 3)
#define UART_TXFF (1u << 5) /* transmit FIFO full */

#endif
