/* STM32F405: the registers and bits that this HAL uses, each under the section of the reference manual (RM0090) that
 * defines it.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef STM32F4_REGS_H
#define STM32F4_REGS_H

#include <stdint.h>

#define REG(address) (*(volatile uint32_t *)(address))

/* 3.9: flash interface */
#define FLASH_ACR REG(0x40023c00u)
#define FLASH_WAIT_STATES(n) (n)
#define FLASH_WAIT_MASK 7u
#define FLASH_PREFETCH (1u << 8)
#define FLASH_CODE_CACHE (1u << 9)
#define FLASH_DATA_CACHE (1u << 10)

/* 7.3: reset and clock control */
#define RCC_CR REG(0x40023800u)
#define RCC_PLLCFGR REG(0x40023804u)
#define RCC_CFGR REG(0x40023808u)
#define RCC_APB2RSTR REG(0x40023824u)
#define RCC_AHB1ENR REG(0x40023830u)
#define RCC_APB1ENR REG(0x40023840u)
#define RCC_APB2ENR REG(0x40023844u)
#define RCC_HSI_ON (1u << 0)
#define RCC_HSI_READY (1u << 1)
#define RCC_PLL_ON (1u << 24)
#define RCC_PLL_READY (1u << 25)
#define RCC_PLL_RESERVED 0xf0bc8000u
#define RCC_PLL_M(n) (n)
#define RCC_PLL_N(n) ((n) << 6)
#define RCC_PLL_P(n) (((n) / 2u - 1u) << 16)
#define RCC_PLL_Q(n) ((n) << 24)
#define RCC_ON_PLL (2u << 0)      /* CFGR: SW */
#define RCC_STATUS_MASK (3u << 2) /* SWS: what the system clock comes from; 0 is HSI */
#define RCC_STATUS_PLL (2u << 2)
#define RCC_APB1_BY_4 (5u << 10)
#define RCC_APB2_BY_2 (4u << 13)
#define RCC_GPIOS 0xfu            /* AHB1: ports A to D */
#define RCC_DMA2 (1u << 22)       /* AHB1 */
#define RCC_TIM3 (1u << 1)        /* APB1 */
#define RCC_TIM5 (1u << 3)
#define RCC_USART6 (1u << 5)      /* APB2 */
#define RCC_SPI1 (1u << 12)

/* 8.4: GPIO. port 0 is A */
#define GPIO_MODER(port) REG(0x40020000u + 0x400u * (port))
#define GPIO_OSPEEDR(port) REG(0x40020008u + 0x400u * (port))
#define GPIO_BSRR(port) REG(0x40020018u + 0x400u * (port))
#define GPIO_AFR(port, high) REG(0x40020020u + 0x400u * (port) + 4u * (high))
#define GPIO_OUTPUT 1u
#define GPIO_ALTERNATE 2u
#define GPIO_QUICK 2u /* OSPEEDR: 50 MHz into 40 pF (datasheet, I/O AC characteristics) */
/* Alternate functions: datasheet, table "Alternate function mapping" */
#define AF_TIM3 2u
#define AF_SPI1 5u
#define AF_USART6 8u

/* 10.5: DMA2, stream 3; 10.3.3: its channel 3 is SPI1_TX. A test has registers of its own */
#ifndef DMA2
#define DMA2 0x40026400u
#endif
#define DMA_LISR REG(DMA2 + 0x00u)
#define DMA_LIFCR REG(DMA2 + 0x08u)
#define DMA_S3CR REG(DMA2 + 0x58u)
#define DMA_S3NDTR REG(DMA2 + 0x5cu)
#define DMA_S3PAR REG(DMA2 + 0x60u)
#define DMA_S3M0AR REG(DMA2 + 0x64u)
#define DMA_S3FCR REG(DMA2 + 0x6cu)
#define DMA_S3_FLAGS (0x3du << 22) /* of LISR and LIFCR */
#define DMA_S3_ERROR (1u << 25)    /* TEIF3 */
#define DMA_S3_COMPLETE (1u << 27) /* TCIF3 */
#define DMA_CHANNEL(n) ((n) << 25)
#define DMA_PRIORITY_HIGH (2u << 16)
#define DMA_MEMORY_STEPS (1u << 10)
#define DMA_TO_PERIPHERAL (1u << 6)
#define DMA_COMPLETE_IRQ (1u << 4)
#define DMA_ERROR_IRQ (1u << 2)
#define DMA_EN 1u
#define DMA_ITEMS_MAX 65535u /* of NDTR */

/* 12.1.3: interrupt numbers; Armv7-M manual, B3.4 */
#define IRQ_TIM5 50u
#define IRQ_DMA2_STREAM3 59u
#define NVIC_ISER(irq) REG(0xe000e100u + 4u * ((irq) / 32u))
#define NVIC_BIT(irq) (1u << (irq) % 32u)

/* 18.4: TIM3, channels 0 to 3 (the manual's 1 to 4), and TIM5 */
#define TIM3_CR1 REG(0x40000400u)
#define TIM3_EGR REG(0x40000414u)
#define TIM3_CCMR(channel) REG(0x40000418u + 4u * ((channel) / 2u))
#define TIM3_CCER REG(0x40000420u)
#define TIM3_PSC REG(0x40000428u)
#define TIM3_ARR REG(0x4000042cu)
#define TIM3_CCR(channel) REG(0x40000434u + 4u * (channel))
#define TIM5_CR1 REG(0x40000c00u)
#define TIM5_DIER REG(0x40000c0cu)
#define TIM5_SR REG(0x40000c10u)
#define TIM5_EGR REG(0x40000c14u)
#define TIM5_PSC REG(0x40000c28u)
#define TIM5_ARR REG(0x40000c2cu)
#define TIM_ON 1u            /* CR1 */
#define TIM_NO_UPDATE_BY_UG 4u
#define TIM_ONE_PULSE 8u
#define TIM_PRELOAD (1u << 7)
#define TIM_UPDATE 1u        /* DIER, SR, EGR */
#define TIM_PWM(channel) (0x68u << 8u * ((channel) % 2u)) /* CCMR: PWM mode 1, preloaded */
#define TIM_OUTPUT(channel) (1u << 4u * (channel))        /* CCER */

/* 28.5: SPI1 */
#define SPI1_CR1 REG(0x40013000u)
#define SPI1_CR2 REG(0x40013004u)
#define SPI1_SR REG(0x40013008u)
#define SPI1_DR REG(0x4001300cu)
#define SPI_CPHA (1u << 0)
#define SPI_CPOL (1u << 1)
#define SPI_MASTER (1u << 2)
#define SPI_BR(n) ((n) << 3)
#define SPI_ON (1u << 6)
#define SPI_SELECTED (3u << 8)  /* SSM, SSI: its own NSS input is high, whatever pins say */
#define SPI_SEND_ONLY (3u << 14) /* BIDIMODE, BIDIOE */
#define SPI_DMA_TX (1u << 1)    /* CR2 */
#define SPI_ROOM (1u << 1)      /* SR: TXE */
#define SPI_BUSY (1u << 7)

/* 30.6: USART6 */
#define USART6_SR REG(0x40011400u)
#define USART6_DR REG(0x40011404u)
#define USART6_BRR REG(0x40011408u)
#define USART6_CR1 REG(0x4001140cu)
#define USART_ROOM (1u << 7) /* SR: TXE */
#define USART_SENT (1u << 6) /* SR: TC, the last bit included */
#define USART_ON (1u << 13 | 1u << 3)

#endif
