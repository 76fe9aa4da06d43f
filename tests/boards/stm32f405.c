/* The panel's bus of hal/stm32f4 on QEMU, which has no DMA: it is built with the registers of DMA2 in RAM, and what the
 * stream does with them is done here, while the bus waits: bytes go where it was told to, then its interrupt comes.
 * Lines of "ok NAME" and "FAILED NAME"; tests/boards/stm32f405.sh compares what went over the wire.
 *
 * SPDX-License-Identifier: MIT
 */
#include "hal.h"

#include <stddef.h>

#include "cortexm.h"

#include "bus_checks.h"

#define REG(address) (*(volatile uint32_t *)(address))
#define LISR REG(DMA2 + 0x00u)
#define LIFCR REG(DMA2 + 0x08u)
#define S3CR REG(DMA2 + 0x58u)
#define S3NDTR REG(DMA2 + 0x5cu)
#define S3PAR REG(DMA2 + 0x60u)
#define S3M0AR REG(DMA2 + 0x64u)
#define S3FCR REG(DMA2 + 0x6cu)
#define ERROR (1u << 25)
#define COMPLETE (1u << 27)
#define SPI1_CR2 REG(0x40013004u)
#define SPI1_DR 0x4001300cu
#define NVIC_ISPR1 REG(0xe000e204u)
#define SCB_VTOR REG(0xe000ed08u)
#define NVIC_STIR REG(0xe000ef00u)
#define IRQ_TIM5 50u
#define IRQ_DMA2_STREAM3 59u
/* Channel 3, priority high, byte to byte, steps in memory, to the peripheral; interrupts of end and error; on */
#define STARTED (3u << 25 | 2u << 16 | 1u << 10 | 1u << 6 | 1u << 4 | 1u << 2 | 1u)

#define LONG 70000u /* bytes: more than the DMA counts */

static uint8_t bytes[LONG];
static enum { WORKS, BREAKS, HANGS } stream;
static volatile uint32_t done_calls, done_in, idle_calls; /* done_in: number of the exception */
static uint32_t starts, moved, wrong;

/* What stream 3 does when it is on and SPI1 asks. */
static void stream_runs(void)
{
    LISR &= ~LIFCR;
    LIFCR = 0;
    if (!(S3CR & 1u) || stream == HANGS)
        return;
    wrong += S3CR != STARTED || S3PAR != SPI1_DR || S3FCR != 0 || SPI1_CR2 != 2u || LISR != 0 || !S3NDTR;
    starts++;
    const volatile uint8_t *from = (const volatile uint8_t *)S3M0AR;
    for (; S3NDTR && stream == WORKS; S3NDTR--, moved++)
        REG(SPI1_DR) = *from++;
    LISR = stream == WORKS ? COMPLETE : ERROR;
    S3CR &= ~1u;
    NVIC_STIR = IRQ_DMA2_STREAM3;
    __asm__ volatile("dsb\n isb" ::: "memory");
}

static void idle(void *ctx)
{
    (void)ctx;
    idle_calls++;
    stream_runs();
}

static struct hal_bus *next_on; /* `done` begins another transfer on it, as TIM5's interrupt comes late */

static void done(void *ctx)
{
    (void)ctx;
    struct hal_bus *const bus = next_on;
    next_on = NULL;
    if (bus) {
        wrong += bus->wait(bus) != HAL_ERR_NONE || bus->data(bus, bytes, 2) != HAL_ERR_NONE;
        LISR &= ~LIFCR; /* as the DMA does at once */
        LIFCR = 0;
        NVIC_STIR = IRQ_TIM5;
    }
    uint32_t number;
    __asm__ volatile("mrs %0, ipsr" : "=r"(number));
    done_calls++;
    done_in = number;
}

/* Send n bytes; what wait says. done must have come once, from the interrupt irq. */
static int send(struct hal_bus *bus, uint32_t n, uint32_t irq)
{
    done_calls = starts = moved = 0;
    const int err = bus->data(bus, bytes, n) ? HAL_ERR_ARG : bus->wait(bus);
    return done_calls == 1 && done_in == 16u + irq ? err : HAL_ERR_STATE;
}

static void refusals(struct hal_bus *bus)
{
    int good = bus->data(bus, bytes, 2) == HAL_ERR_STATE && bus->command(bus, 1, NULL, 0) == HAL_ERR_STATE;
    good &= bus->reset(bus) == HAL_ERR_STATE && bus->wait(bus) == HAL_ERR_NONE;
    bus->delay(bus, 10);
    good &= bus->data(bus, NULL, 4) == HAL_ERR_ARG && bus->data(bus, bytes, 0) == HAL_ERR_ARG;
    good &= bus->command(bus, 1, NULL, 1) == HAL_ERR_ARG;
    good &= hal_init() == HAL_ERR_NONE && hal_init() == HAL_ERR_NONE;
    verdict("stm32f405_refuses_before_init", good);
}

static void transfers(struct hal_bus *bus)
{
    static const uint8_t args[] = { 0x81, 0x00, 0xfe };
    int good = bus->command(bus, 0x2c, NULL, 0) == HAL_ERR_NONE && bus->command(bus, 0x36, args, 3) == HAL_ERR_NONE;
    good &= send(bus, 5, IRQ_DMA2_STREAM3) == HAL_ERR_NONE && starts == 1 && bus->wait(bus) == HAL_ERR_NONE;
    good &= bus->data(bus, bytes, 1) == HAL_ERR_NONE && bus->data(bus, bytes, 1) == HAL_ERR_STATE;
    good &= bus->command(bus, 1, NULL, 0) == HAL_ERR_STATE && bus->reset(bus) == HAL_ERR_STATE;
    good &= bus->wait(bus) == HAL_ERR_NONE;
    verdict("stm32f405_transfers", good);
}

static void failures(struct hal_bus *bus)
{
    stream = BREAKS;
    verdict("stm32f405_dma_error", send(bus, 9, IRQ_DMA2_STREAM3) == HAL_ERR_BUS && !(S3CR & 1u));
    stream = HANGS;
    verdict("stm32f405_dma_hangs", send(bus, 9, IRQ_TIM5) == HAL_ERR_TIMEOUT && !(S3CR & 1u));
    bus->hooks.idle = NULL; /* asleep until the deadline */
    verdict("stm32f405_sleeps_to_the_deadline", send(bus, 9, IRQ_TIM5) == HAL_ERR_TIMEOUT);
    bus->hooks.idle = idle;
    stream = WORKS;
    verdict("stm32f405_works_after_failures", send(bus, 3, IRQ_DMA2_STREAM3) == HAL_ERR_NONE);
}

/* So many turns of two instructions: 1 ns each in QEMU. */
static void spin(uint32_t turns)
{
    __asm__ volatile("1: subs %0, #1\n bne 1b" : "+r"(turns) : : "cc", "memory");
}

/* End and deadline come while interrupts are off: the deadline, which is served first, leaves it to the end. */
static void both_at_once(struct hal_bus *bus)
{
    done_calls = 0;
    int good = bus->data(bus, bytes, 2) == HAL_ERR_NONE;
    __asm__ volatile("cpsid i" ::: "memory");
    stream_runs();
    for (uint32_t i = 0; i < 10000u && !(NVIC_ISPR1 >> (IRQ_TIM5 - 32u) & 1u); i++)
        spin(1000); /* a read is slow where it is followed */
    good &= NVIC_ISPR1 >> (IRQ_TIM5 - 32u) & 1u && !done_calls;
    __asm__ volatile("cpsie i" ::: "memory");
    good &= bus->wait(bus) == HAL_ERR_NONE && done_calls == 1 && done_in == 16u + IRQ_DMA2_STREAM3;
    verdict("stm32f405_end_and_deadline_at_once", good);
}

/* The deadline's interrupt of one transfer comes when the next one has begun, which it leaves alone. */
static void late_deadline(struct hal_bus *bus)
{
    done_calls = 0;
    next_on = bus;
    int good = bus->data(bus, bytes, 2) == HAL_ERR_NONE;
    stream_runs();
    __asm__ volatile("isb" ::: "memory");
    good &= bus->wait(bus) == HAL_ERR_NONE && done_calls == 2 && done_in == 16u + IRQ_DMA2_STREAM3;
    verdict("stm32f405_late_deadline", good);
}

/* In two pieces. */
static void long_one(struct hal_bus *bus)
{
    const int err = send(bus, LONG, IRQ_DMA2_STREAM3);
    verdict("stm32f405_long_transfer",
            err == HAL_ERR_NONE && starts == 2 && moved == LONG && S3M0AR == (uint32_t)bytes + 65535u);
}

/* 110 million instructions without interrupts are 18.48 million ticks, more than SysTick counts to: the wrap that could
 * not be counted is in them all the same. (QEMU: 1 ns an instruction, 168 MHz.) */
static void uncounted_wrap(void)
{
    const uint64_t from = hal_ticks();
    __asm__ volatile("cpsid i" ::: "memory");
    spin(55000000u);
    const uint64_t off = hal_ticks();
    __asm__ volatile("cpsie i\n isb" ::: "memory");
    const uint64_t on = hal_ticks();
    verdict("stm32f405_ticks_count_a_wrap_without_interrupts",
            off - from > 18479000u && off - from < 18481000u && on > off && on - off < 1000u);
}

static void times(struct hal_bus *bus)
{
    const uint64_t from = hal_ticks();
    bus->delay(bus, 1000);
    const uint64_t took = hal_ticks() - from;
    verdict("stm32f405_delay", took >= hal_tick_hz() / 1000u && took < hal_tick_hz() / 500u);
}

int main(void)
{
    struct hal_bus *bus = hal_bus();
    for (uint32_t i = 0; i < LONG; i++)
        bytes[i] = (uint8_t)(17u * (i + 1u));
    refusals(bus);
    verdict("stm32f405_vectors_are_its_own", SCB_VTOR == 0x08000000u);
    bus->hooks.idle = idle;
    bus->hooks.done = done;
    transfers(bus);
    failures(bus);
    both_at_once(bus);
    late_deadline(bus);
    times(bus);
    uncounted_wrap();
    long_one(bus);
    verdict("stm32f405_dma_is_told_right", wrong == 0 && idle_calls > 5);
    hal_write("the end\n");
    hal_exit(0);
}
