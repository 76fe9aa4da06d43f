/* STM32F405: the panel's wire (spi_bus.h). SPI1 carries it; pixels go by DMA2, which ends in an interrupt; commands are
 * polled.
 *
 * Frames of 8 bits, for pixels too: their more significant byte comes first in memory and on the wire; frames of 16
 * bits would swap the two, and this DMA has no swap. SPI1 sends without gaps if the DMA brings a byte in 32 cycles of
 * the core. It sends only: the bidirectional mode receives nothing, so that nothing overruns.
 *
 * A transfer ends in one of two interrupts, of equal priority, so that neither comes between the other's lines: the
 * DMA's, which then sees the last two bytes leave (0.4 us at 42 MHz), or TIM5's, when twice the transfer's time and a
 * millisecond have passed. After a failure SPI1 is reset: whatever it held is gone.
 *
 * DMA2 reads SRAM and flash. It does not reach the 64 KB of CCM at 0x10000000 (RM0090, 2.1): pixels there fail with
 * HAL_ERR_BUS.
 *
 * What an emulator cannot tell: QEMU's netduinoplus2 has no DMA, its SPI1 is never busy and its pins go nowhere.
 * Pictures are taken there from images with -DSPI_DMA=0, which poll. Of the DMA, tests see that it is told what the
 * manual wants, that TIM5 ends what never ends, and, with a stream of their own, what its interrupt does; not that the
 * real one sends, that SPI1 has no gaps, that waiting for TXE and BSY ends when the last bit is out, or what edges and
 * slew the pins have.
 *
 * SPDX-License-Identifier: MIT
 */
#include "hal.h"

#include "cortexm.h"
#include "parts.h"
#include "pins.h"
#include "regs.h"
#include "spi_bus.h"

#define RESET_US 10000u

#define DIVIDER_BITS                                                                                        \
    (SPI_DIVIDER == 2 ? 0u : SPI_DIVIDER == 4 ? 1u : SPI_DIVIDER == 8 ? 2u : SPI_DIVIDER == 16 ? 3u         \
     : SPI_DIVIDER == 32 ? 4u : SPI_DIVIDER == 64 ? 5u : SPI_DIVIDER == 128 ? 6u : 7u)
_Static_assert(SPI_DIVIDER == 2 << DIVIDER_BITS, "SPI_DIVIDER: 2, 4, 8, 16, 32, 64, 128 or 256");
_Static_assert(PIN_SCK == PA5 || PIN_SCK == PB3, "PIN_SCK: PA5 or PB3");
_Static_assert(PIN_MOSI == PA7 || PIN_MOSI == PB5, "PIN_MOSI: PA7 or PB5");

#define SPI_SET_UP                                                                             \
    (SPI_ON | SPI_MASTER | SPI_SELECTED | SPI_SEND_ONLY | SPI_BR(DIVIDER_BITS) |               \
     (SPI_MODE == 3 ? SPI_CPOL | SPI_CPHA : 0u))
#define STREAM_SET_UP                                                                          \
    (DMA_CHANNEL(3u) | DMA_PRIORITY_HIGH | DMA_MEMORY_STEPS | DMA_TO_PERIPHERAL | DMA_COMPLETE_IRQ | DMA_ERROR_IRQ)
#define DEADLINE_HZ 1000000u

typedef void (*handler)(void);
void DMA2_Stream3_Handler(void);
void TIM5_Handler(void);

/* From IRQ 0 on; the others are never enabled. */
__attribute__((section(".device_vectors"), used)) static const handler device_vectors[IRQ_DMA2_STREAM3 + 1u] = {
    [IRQ_TIM5] = TIM5_Handler, [IRQ_DMA2_STREAM3] = DMA2_Stream3_Handler
};

static const uint8_t *next;       /* what the DMA has not been given yet */
static uint32_t left;             /* bytes of it */

/* ---- SPI1 ---------------------------------------------------------------------------------------------- */

static void spi_start(void)
{
    RCC_APB2RSTR |= RCC_SPI1;
    RCC_APB2RSTR &= ~RCC_SPI1;
    SPI1_CR2 = 0;
    SPI1_CR1 = SPI_SET_UP;
}

/* Until the last bit is out. 28.3.8: first TXE, as BSY rises some cycles after a byte was written. */
static int drain(void)
{
    return spi_becomes(&SPI1_SR, SPI_ROOM, SPI_ROOM) && spi_becomes(&SPI1_SR, SPI_BUSY, 0) ? HAL_ERR_NONE
                                                                                           : HAL_ERR_TIMEOUT;
}

static int put_all(const uint8_t *bytes, uint32_t n)
{
    return spi_write(&SPI1_DR, &SPI1_SR, SPI_ROOM, bytes, n) ? drain() : HAL_ERR_TIMEOUT;
}

int spi_wire_send(const uint8_t *bytes, uint32_t n, int is_data)
{
    stm32f4_pin_set(PIN_DC, is_data);
    const int err = put_all(bytes, n);
    if (err)
        spi_start();
    return err;
}

void spi_wire_select(void)
{
    stm32f4_pin_set(PIN_CS, 0);
}

void spi_wire_release(void)
{
    stm32f4_pin_set(PIN_CS, 1);
    stm32f4_pin_set(PIN_DC, 1);
}

/* ---- A transfer by DMA -------------------------------------------------------------------------------------- */

/* 10.3.17: a stream is off before it is set up, and all its flags are cleared. */
static void stream_stop(void)
{
    DMA_S3CR = 0;
    (void)spi_becomes(&DMA_S3CR, DMA_EN, 0);
    DMA_LIFCR = DMA_S3_FLAGS;
}

/* The next piece: the DMA counts to 65535. Bytes to bytes, without its FIFO. */
static void stream_start(void)
{
    const uint32_t n = left < DMA_ITEMS_MAX ? left : DMA_ITEMS_MAX;
    stream_stop();
    DMA_S3PAR = (uint32_t)(uintptr_t)&SPI1_DR;
    DMA_S3M0AR = (uint32_t)(uintptr_t)next;
    DMA_S3NDTR = n;
    DMA_S3FCR = 0;
    DMA_S3CR = STREAM_SET_UP;
    DMA_S3CR = STREAM_SET_UP | DMA_EN;
    next += n;
    left -= n;
}

/* 18.3.10: TIM5 counts up once and stops, with its interrupt. */
static void deadline_set(uint32_t us)
{
    TIM5_ARR = us;
    TIM5_EGR = TIM_UPDATE; /* counts from 0 */
    TIM5_SR = 0;
    TIM5_CR1 = TIM_ONE_PULSE | TIM_NO_UPDATE_BY_UG | TIM_ON;
}

static void deadline_clear(void)
{
    TIM5_CR1 = TIM_ONE_PULSE | TIM_NO_UPDATE_BY_UG;
    TIM5_SR = 0;
}

static void end(int err)
{
    deadline_clear();
    SPI1_CR2 = 0;
    if (err) {
        stream_stop();
        spi_start();
    }
    spi_bus_end(err);
}

void DMA2_Stream3_Handler(void)
{
    const uint32_t flags = DMA_LISR;
    DMA_LIFCR = flags & DMA_S3_FLAGS;
    if (!spi_bus_running()) /* TIM5 ended it while this interrupt was pending */
        return;
    if (flags & DMA_S3_ERROR) /* 10.3.18: the stream has stopped there */
        end(HAL_ERR_BUS);
    else if (flags & DMA_S3_COMPLETE && left)
        stream_start();
    else if (flags & DMA_S3_COMPLETE)
        end(drain());
}

void TIM5_Handler(void)
{
    const uint32_t flags = DMA_LISR, due = TIM5_SR & TIM_UPDATE;
    TIM5_SR = 0;
    if (!due || /* it was of the transfer before, after which the hook `done` began this one */
        !spi_bus_running() || flags & DMA_S3_ERROR || (flags & DMA_S3_COMPLETE && !left)) /* ended, or about to be */
        return;
    end(HAL_ERR_TIMEOUT);
}

/* Twice the time of n bytes on the wire and a millisecond. */
static uint32_t deadline_us(uint32_t n)
{
    return 1000u + (uint32_t)((uint64_t)n * (16u * SPI_DIVIDER) / (stm32f4_clocks.apb2 / 1000000u));
}

/* ---- The wire ------------------------------------------------------------------------------------------------- */

static int begin_by_dma(const uint8_t *bytes, uint32_t n)
{
    next = bytes;
    left = n;
    deadline_set(deadline_us(n));
    stream_start();
    SPI1_CR2 = SPI_DMA_TX;
    return HAL_ERR_NONE;
}

static int send_at_once(const uint8_t *bytes, uint32_t n)
{
    spi_bus_end(spi_wire_send(bytes, n, 1));
    return HAL_ERR_NONE;
}

int spi_wire_begin(const uint8_t *bytes, uint32_t n)
{
    spi_wire_select();
    return SPI_DMA ? begin_by_dma(bytes, n) : send_at_once(bytes, n);
}

void spi_wire_sleep(const volatile uint8_t *running)
{
    cortexm_sleep_while(running);
}

void spi_wire_overdue(void)
{
}

void spi_wire_reset(void)
{
    stm32f4_pin_set(PIN_RESET, 0);
    cortexm_pause_us(RESET_US);
    stm32f4_pin_set(PIN_RESET, 1);
}

void spi_wire_pause_us(uint32_t us)
{
    cortexm_pause_us(us);
}

void stm32f4_bus_start(void)
{
    stm32f4_pin_output(PIN_CS);
    stm32f4_pin_output(PIN_DC);
    stm32f4_pin_output(PIN_RESET);
    spi_start();
    stm32f4_pin_alternate(PIN_SCK, AF_SPI1);
    stm32f4_pin_alternate(PIN_MOSI, AF_SPI1);
    TIM5_PSC = stm32f4_clocks.timers / DEADLINE_HZ - 1u;
    TIM5_DIER = TIM_UPDATE;
    deadline_clear();
    NVIC_ISER(IRQ_TIM5) = NVIC_BIT(IRQ_TIM5);
    NVIC_ISER(IRQ_DMA2_STREAM3) = NVIC_BIT(IRQ_DMA2_STREAM3);
    spi_bus_start();
}
