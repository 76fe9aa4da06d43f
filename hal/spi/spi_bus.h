/* A panel's bus over SPI: the verbs of struct hal_bus, what they refuse and what they remember, once for all boards
 * whose processor has the panel to itself. A board gives the wire below, calls spi_bus_start in hal_init, and links
 * spi_bus.c.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SPI_BUS_H
#define SPI_BUS_H

#include <stdint.h>

/* ---- What spi_bus.c gives a board ---------------------------------------------------------------------------- */

/* The wire is up: from here on the bus answers. */
void spi_bus_start(void);

/* What spi_wire_begin began has ended, the last bit included; err: enum hal_err. Releases the panel and calls the hook
 * `done`. Once for each, from the interrupt that sees the end, or before spi_wire_begin returns. */
void spi_bus_end(int err);

/* 1 from spi_wire_begin until spi_bus_end. ISR-safe. */
int spi_bus_running(void);

#define SPI_SPINS 20000u /* looks at a register of some eight cycles each: a millisecond or three, for microseconds */

/* Wait until the bits of `mask` in a register are `value`. Return 0: they never were. */
static inline int spi_becomes(const volatile uint32_t *reg, uint32_t mask, uint32_t value)
{
    for (uint32_t i = 0; i < SPI_SPINS; i++)
        if ((*reg & mask) == value)
            return 1;
    return 0;
}

/* Write n bytes to a block's data register, each when the bit `room` of its status is 1. Return 0: it never was. */
static inline int spi_write(volatile uint32_t *data, const volatile uint32_t *status, uint32_t room,
                            const uint8_t *bytes, uint32_t n)
{
    for (; n; n--) {
        if (!spi_becomes(status, room, room))
            return 0;
        *data = *bytes++;
    }
    return 1;
}

/* ---- What a board gives spi_bus.c ----------------------------------------------------------------------------- */

/* CS low, ready for spi_wire_send. */
void spi_wire_select(void);

/* CS high, and D/C high. */
void spi_wire_release(void);

/* Send n >= 1 bytes, D/C low or high (is_data), until the last bit is out.
 * Return HAL_ERR_NONE; HAL_ERR_TIMEOUT: the block was reset, whatever it held is gone. */
int spi_wire_send(const uint8_t *bytes, uint32_t n, int is_data);

/* CS low, D/C high, and begin to send n >= 1 bytes. D/C is high already.
 * Return HAL_ERR_NONE: spi_bus_end comes, or has come; else enum hal_err: the panel is released, spi_bus_end does not
 * come. */
int spi_wire_begin(const uint8_t *bytes, uint32_t n);

/* Sleep until an interrupt, or not at all, while *running; for wait without the hook `idle`. */
void spi_wire_sleep(const volatile uint8_t *running);

/* Called again and again by wait: end what is past its time, where no interrupt does. */
void spi_wire_overdue(void);

/* RESET low for 10 ms (controllers want 10 us; modules may have a capacitor on the line), and high; or nothing, where a
 * board has no such line. */
void spi_wire_reset(void);

/* Let at least so many microseconds pass. */
void spi_wire_pause_us(uint32_t us);

#endif
