/* nRF51822: the registers and bits that this HAL uses, each under the chapter of the nRF51 Series Reference Manual
 * (v3.0) that defines it. A peripheral's tasks are started by writing 1; its events read 1 until 0 is written.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef NRF51_REGS_H
#define NRF51_REGS_H

#include <stdint.h>

#define REG(address) (*(volatile uint32_t *)(address))
#define NOT_CONNECTED 0xffffffffu /* PSEL...: no pin */

/* "Clock management (CLOCK)" */
#define CLOCK_HFCLKSTART REG(0x40000000u)
#define CLOCK_HFCLKSTARTED REG(0x40000100u)

/* "Universal Asynchronous Receiver/Transmitter (UART)" */
#define UART_STARTTX REG(0x40002008u)
#define UART_TXDRDY REG(0x4000211cu)
#define UART_ENABLE REG(0x40002500u)
#define UART_PSELTXD REG(0x4000250cu)
#define UART_TXD REG(0x4000251cu)
#define UART_BAUDRATE REG(0x40002524u)
#define UART_ENABLED 4u
/* The table of BAUDRATE gives baud * 2^32 / 16 MHz, rounded to its upper 20 bits */
#define UART_BAUD(baud) ((uint32_t)((((uint64_t)(baud) << 32) / 16000000u + 0x800u) & 0xfffff000u))

/* "Serial Peripheral Interface (SPI) Master": SPI0, SPI1. Includers of this part have pins.h */
#define SPI(offset) REG(0x40003000u + 0x1000u * SPI_INSTANCE + (offset))
#define SPI_READY SPI(0x108u)
#define SPI_ENABLE SPI(0x500u)
#define SPI_PSELSCK SPI(0x508u)
#define SPI_PSELMOSI SPI(0x50cu)
#define SPI_PSELMISO SPI(0x510u)
#define SPI_RXD SPI(0x518u)
#define SPI_TXD SPI(0x51cu)
#define SPI_FREQUENCY SPI(0x524u)
#define SPI_CONFIG SPI(0x554u)
#define SPI_ENABLED 1u
#define SPI_CPHA (1u << 1) /* CONFIG; 0 is mode 0, high bit first */
#define SPI_CPOL (1u << 2)

/* "Timer/counter (TIMER)": TIMER0, the one with 32 bits. n is a CC register */
#define TIMER_START REG(0x40008000u)
#define TIMER_CAPTURE(n) REG(0x40008040u + 4u * (n))
#define TIMER_COMPARE(n) REG(0x40008140u + 4u * (n))
#define TIMER_INTENSET REG(0x40008304u)
#define TIMER_BITMODE REG(0x40008508u)
#define TIMER_PRESCALER REG(0x40008510u)
#define TIMER_CC(n) REG(0x40008540u + 4u * (n))
#define TIMER_32_BITS 3u
#define TIMER_1_MHZ 4u /* 16 MHz / 2^4 */
#define TIMER_ON_COMPARE(n) (1u << (16u + (n))) /* INTENSET */

/* "General-Purpose Input/Output (GPIO)" */
#define GPIO_OUTSET REG(0x50000508u)
#define GPIO_OUTCLR REG(0x5000050cu)
#define GPIO_DIRSET REG(0x50000518u)
#define GPIO_PIN_CNF(pin) REG(0x50000700u + 4u * (pin))
#define GPIO_OUTPUT 3u           /* PIN_CNF: output, input buffer off, no pull, standard drive */
#define GPIO_HIGH_DRIVE (3u << 8) /* H0H1 */

/* "Instantiation": a peripheral's interrupt is bits 12 .. 16 of its address. Armv6-M manual, B3.4: NVIC */
#define IRQ_TIMER0 8u
#define NVIC_ISER REG(0xe000e100u)

#endif
