/* RP2040: the panel's wire (spi_bus.h). SPI0 carries it; pixels go by DMA, which ends in an interrupt; commands are
 * polled.
 *
 * A transfer ends in one of two interrupts, of equal priority, so that neither comes between the other's lines: the
 * DMA's, which then sees the last words leave the FIFO (nine of them, 2.3 us at 62.5 MHz), or the timer's, when twice
 * the transfer's time and a millisecond have passed. After a failure SPI0 is reset: whatever it held is gone.
 *
 * SPI0 receives as it sends, into a FIFO that nobody reads. When that is full, words are dropped and a flag is set,
 * both without any effect on sending (PL022 manual, 2.4.3): it is left alone.
 *
 * What an emulator cannot tell: a bus error of the DMA, edges and slew of the pins, errata RP2040-E13. With SPI_MODE 0
 * the PL022 rests for about two cycles of SCK after each word (its manual, 2.4.9); with 3 it does not.
 *
 * SPDX-License-Identifier: MIT
 */
#include "hal.h"

#include "cortexm.h"
#include "parts.h"
#include "pins.h"
#include "regs.h"
#include "spi_bus.h"

#define BIT(pin) (1u << (pin))
#define CHANNEL_BIT (1u << CHANNEL_PANEL)
#define CHANNEL_ERRORS (DMA_READ_ERROR | DMA_WRITE_ERROR)
#define CHANNEL_CTRL (DMA_EN | DMA_INCR_READ | DMA_CHAIN_TO(CHANNEL_PANEL) | DMA_TREQ(DREQ_SPI0_TX))

#define RESET_US 10000u

_Static_assert(SPI_DIVIDER >= 2 && SPI_DIVIDER <= 254 && SPI_DIVIDER % 2 == 0, "SPI_DIVIDER: even, 2 to 254");

void DMA_0_Handler(void);
void TIMER_0_Handler(void);

/* ---- SPI0 ---------------------------------------------------------------------------------------------- */

/* Word length may only change while SPI0 is off and idle (PL022 manual, 3.3.1). */
static void set_bits(uint32_t bits)
{
    SPI0_CR1 = 0;
    SPI0_CR0 = SPI_DSS(bits) | (SPI_MODE == 3 ? SPI_SPO | SPI_SPH : 0u);
    SPI0_CR1 = SPI_SSE;
}

static void spi_start(void)
{
    rp2040_restart(RESET_SPI0);
    SPI0_CPSR = SPI_DIVIDER;
    SPI0_DMACR = SPI_TXDMAE;
    set_bits(8);
}

/* Until the last bit is out. */
static int drain(void)
{
    return spi_becomes(&SPI0_SR, SPI_BSY, 0) ? HAL_ERR_NONE : HAL_ERR_TIMEOUT;
}

static int put_all(const uint8_t *bytes, uint32_t n)
{
    return spi_write(&SPI0_DR, &SPI0_SR, SPI_TNF, bytes, n) ? drain() : HAL_ERR_TIMEOUT;
}

int spi_wire_send(const uint8_t *bytes, uint32_t n, int is_data)
{
    if (is_data)
        SIO_GPIO_OUT_SET = BIT(PIN_DC);
    else
        SIO_GPIO_OUT_CLR = BIT(PIN_DC);
    const int err = put_all(bytes, n);
    if (err)
        spi_start();
    return err;
}

/* In mode 3 words stay at 8 bits, since there are no gaps to save. SCK rests high there, and falls as SPI0 goes off: to
 * a module without CS that would be a bit. */
static void select_panel(uint32_t bits)
{
    if (SPI_MODE == 0)
        set_bits(bits);
    SIO_GPIO_OUT_CLR = BIT(PIN_CS);
}

void spi_wire_select(void)
{
    select_panel(8);
}

void spi_wire_release(void)
{
    SIO_GPIO_OUT_SET = BIT(PIN_CS) | BIT(PIN_DC);
}

/* ---- The end of a transfer ----------------------------------------------------------------------------------- */

/* The hook `done` may divide. */
static void end(int err)
{
    TIMER_ARMED = 1; /* disarms alarm 0 */
    TIMER_INTR = 1;  /* it may have come since; the hook `done` may begin the next transfer */
    if (err)
        spi_start();
    const struct rp2040_divider divider = rp2040_divider_save();
    spi_bus_end(err);
    rp2040_divider_restore(divider);
}

/* Errata RP2040-E13: an abort can raise the channel's interrupt, so that is masked meanwhile and cleared. */
static void abort_channel(void)
{
    DMA_INTE0 = 0;
    DMA_CHAN_ABORT = CHANNEL_BIT;
    (void)spi_becomes(&DMA_CHAN_ABORT, CHANNEL_BIT, 0);
    DMA_INTS0 = CHANNEL_BIT;
    DMA_INTE0 = CHANNEL_BIT;
}

void DMA_0_Handler(void)
{
    const uint32_t mine = DMA_INTS0 & CHANNEL_BIT;
    DMA_INTS0 = CHANNEL_BIT;
    if (!mine || !spi_bus_running()) /* the timer ended it while this interrupt was pending */
        return;
    if (DMA_CTRL(CHANNEL_PANEL) & CHANNEL_ERRORS) { /* 2.5.7: the channel has stopped there */
        DMA_CTRL(CHANNEL_PANEL) = CHANNEL_ERRORS;   /* cleared by writing ones; the channel is off */
        end(HAL_ERR_BUS);
    } else {
        end(drain());
    }
}

void TIMER_0_Handler(void)
{
    const uint32_t due = TIMER_INTR & 1u;
    TIMER_INTR = 1;
    /* It was of the transfer before; or this one has ended, or is about to: both came while interrupts were off */
    if (!due || !spi_bus_running() || DMA_INTS0 & CHANNEL_BIT)
        return;
    abort_channel();
    end(HAL_ERR_TIMEOUT);
}

/* ---- The wire ------------------------------------------------------------------------------------------------- */

/* Twice the time of n bytes on the wire and a millisecond. */
static uint32_t deadline_us(uint32_t n)
{
    return 1000u + (uint32_t)((uint64_t)n * (16u * SPI_DIVIDER) / (CLOCK_HZ / 1000000u));
}

int spi_wire_begin(const uint8_t *bytes, uint32_t n)
{
    /* words of 16 bits travel with the fewest gaps; their bytes are swapped, as SPI sends the high one first */
    const int words = SPI_MODE == 0 && !((n | (uintptr_t)bytes) & 1u);
    select_panel(words ? 16 : 8);
    DMA_READ_ADDR(CHANNEL_PANEL) = (uint32_t)(uintptr_t)bytes;
    DMA_WRITE_ADDR(CHANNEL_PANEL) = (uint32_t)(uintptr_t)&SPI0_DR;
    DMA_TRANS_COUNT(CHANNEL_PANEL) = words ? n / 2u : n;
    TIMER_ALARM0 = rp2040_us() + deadline_us(n); /* writing arms it */
    DMA_CTRL_TRIG(CHANNEL_PANEL) = words ? CHANNEL_CTRL | DMA_HALFWORDS | DMA_BSWAP : CHANNEL_CTRL;
    return HAL_ERR_NONE;
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
    SIO_GPIO_OUT_CLR = BIT(PIN_RESET);
    rp2040_pause_us(RESET_US);
    SIO_GPIO_OUT_SET = BIT(PIN_RESET);
}

void spi_wire_pause_us(uint32_t us)
{
    rp2040_pause_us(us);
}

void rp2040_bus_start(void)
{
    const uint32_t outputs = BIT(PIN_CS) | BIT(PIN_DC) | BIT(PIN_RESET);
    SIO_GPIO_OUT_SET = outputs; /* high before they are driven: no pulse on CS or RESET */
    SIO_GPIO_OE_SET = outputs;
    GPIO_CTRL(PIN_CS) = FUNC_SIO;
    GPIO_CTRL(PIN_DC) = FUNC_SIO;
    GPIO_CTRL(PIN_RESET) = FUNC_SIO;
    spi_start();
    PAD_CTRL(PIN_SCK) = PAD_QUICK;
    PAD_CTRL(PIN_MOSI) = PAD_QUICK;
    GPIO_CTRL(PIN_SCK) = FUNC_SPI;
    GPIO_CTRL(PIN_MOSI) = FUNC_SPI;
    DMA_INTE0 = CHANNEL_BIT;
    NVIC_ICPR = 1u << IRQ_DMA_0 | 1u << IRQ_TIMER_0;
    NVIC_ISER = 1u << IRQ_DMA_0 | 1u << IRQ_TIMER_0;
    spi_bus_start();
}
