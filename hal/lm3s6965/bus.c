/* LM3S6965: the panel's wire (spi_bus.h). SSI0 carries it. Pixels leave by its interrupt, four bytes (9 us) at a time,
 * while the program goes on: some 85 instructions each. Commands are polled. The part has no DMA.
 *
 * A transfer ends in the interrupt that finds nothing left to send, which sees the last bytes leave (five of them,
 * 11 us), or in wait, when twice its time and a millisecond have passed. After a failure SSI0 is reset: whatever it
 * held is gone.
 *
 * SSI0 receives as it sends. On the part what is received could be left alone; QEMU's stops sending when eight bytes
 * have not been taken out.
 *
 * The board gives the processor no line to the panel's RESET: a panel is reset with the board.
 *
 * What QEMU cannot tell: its SSI0 has no speed and no modes (a byte is out as soon as it is written, so that one
 * interrupt sends all), its panel has no power and no select. The converter on C6 is in the later boards' schematic;
 * on earlier ones, whose glass is fed by the controller, nothing hangs there.
 *
 * SPDX-License-Identifier: MIT
 */
#include "hal.h"

#include "cortexm.h"
#include "parts.h"
#include "pins.h"
#include "regs.h"
#include "spi_bus.h"

#define TICKS_A_US (CLOCK_HZ / 1000000u)

_Static_assert(SPI_DIVIDER >= 2 && SPI_DIVIDER <= 254 && SPI_DIVIDER % 2 == 0, "SPI_DIVIDER: even, 2 to 254");

void SSI0_Handler(void);

static uint64_t deadline; /* of the transfer, in ticks */
static const uint8_t *volatile next; /* to be sent, and how many */
static volatile uint32_t left;

/* ---- Pins and SSI0 ------------------------------------------------------------------------------------------- */

static void set(uint32_t pin, int high)
{
    GPIO_LEVEL(pin) = high ? GPIO_BIT(pin) : 0u;
}

/* High from its first moment: a pin is driven from DEN on. */
static void output(uint32_t pin)
{
    GPIO_DIR(pin) |= GPIO_BIT(pin);
    set(pin, 1);
    GPIO_DEN(pin) |= GPIO_BIT(pin);
}

/* SPI mode 3, which has no gaps between bytes: SCK rests high, data is clocked in on its rising edge. */
static void spi_start(void)
{
    SYS_SRCR1 |= BLOCK_SSI0;
    SYS_SRCR1 &= ~BLOCK_SSI0;
    SSI0_CPSR = SPI_DIVIDER;
    SSI0_CR0 = SSI_8_BITS | SSI_SPO | SSI_SPH;
    SSI0_CR1 = SSI_SSE;
}

static void put(uint8_t byte)
{
    SSI0_DR = byte;
    while (SSI0_SR & SSI_RNE)
        (void)SSI0_DR;
}

/* Until the last bit is out. */
static int drain(void)
{
    return spi_becomes(&SSI0_SR, SSI_BSY, 0) ? HAL_ERR_NONE : HAL_ERR_TIMEOUT;
}

static int put_all(const uint8_t *bytes, uint32_t n)
{
    for (uint32_t i = 0; i < n; i++) {
        if (!spi_becomes(&SSI0_SR, SSI_TNF, SSI_TNF))
            return HAL_ERR_TIMEOUT;
        put(bytes[i]);
    }
    return drain();
}

int spi_wire_send(const uint8_t *bytes, uint32_t n, int is_data)
{
    set(PIN_DC, is_data);
    const int err = put_all(bytes, n);
    if (err)
        spi_start();
    return err;
}

void spi_wire_select(void)
{
    set(PIN_CS, 0);
}

void spi_wire_release(void)
{
    set(PIN_CS, 1);
    set(PIN_DC, 1);
}

/* ---- The end of a transfer ----------------------------------------------------------------------------------- */

static void end(int err)
{
    SSI0_IM = 0;
    if (err)
        spi_start();
    spi_bus_end(err);
}

void SSI0_Handler(void)
{
    const uint8_t *at = next;
    uint32_t n = left;
    if (!spi_bus_running()) /* wait ended it while this interrupt was pending */
        return;
    if (!n) {
        end(drain());
        return;
    }
    for (; n && SSI0_SR & SSI_TNF; n--)
        put(*at++);
    next = at;
    left = n;
}

__attribute__((section(".device_vectors"), used)) static void (*const vectors[IRQ_SSI0 + 1])(void) = {
    [IRQ_SSI0] = SSI0_Handler
};

/* ---- The wire ------------------------------------------------------------------------------------------------- */

int spi_wire_begin(const uint8_t *bytes, uint32_t n)
{
    deadline = hal_ticks() + 1000u * TICKS_A_US + 16u * SPI_DIVIDER * (uint64_t)n;
    next = bytes;
    left = n;
    spi_wire_select();
    SSI0_IM = SSI_TXIM; /* the FIFO is empty: the interrupt comes at once */
    return HAL_ERR_NONE;
}

/* The interrupts that send come every 9 us: there is nothing to gain by sleeping. */
void spi_wire_sleep(const volatile uint8_t *running)
{
    (void)running;
}

void spi_wire_overdue(void)
{
    if (hal_ticks() <= deadline)
        return;
    __asm__ volatile("cpsid i" ::: "memory");
    if (spi_bus_running())
        end(HAL_ERR_TIMEOUT);
    __asm__ volatile("cpsie i" ::: "memory");
}

void spi_wire_reset(void)
{
}

void spi_wire_pause_us(uint32_t us)
{
    cortexm_pause_us(us);
}

void lm3s6965_bus_start(void)
{
    output(PIN_CARD);
    output(PIN_CS);
    output(PIN_DC);
    output(PIN_POWER);
    GPIO_AFSEL(PIN_SCK) |= GPIO_BIT(PIN_SCK) | GPIO_BIT(PIN_MOSI);
    GPIO_DEN(PIN_SCK) |= GPIO_BIT(PIN_SCK) | GPIO_BIT(PIN_MOSI);
    spi_start();
    NVIC_ICPR = 1u << IRQ_SSI0;
    NVIC_ISER = 1u << IRQ_SSI0;
    spi_bus_start();
}
