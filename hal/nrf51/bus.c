/* nRF51822: the panel's bus. Nothing leaves by itself: data sends, and wait has nothing to wait for. The wire is in
 * spi.c or words.c, the verbs in spi_bus.c.
 *
 * SPDX-License-Identifier: MIT
 */
#include "hal.h"
#include "parts.h"
#include "spi_bus.h"

int spi_wire_begin(const uint8_t *bytes, uint32_t n)
{
    spi_wire_select();
    const int err = spi_wire_send(bytes, n, 1);
    if (err)
        spi_wire_release();
    else
        spi_bus_end(HAL_ERR_NONE);
    return err;
}

void spi_wire_sleep(const volatile uint8_t *running)
{
    (void)running;
}

void spi_wire_overdue(void)
{
}

void spi_wire_pause_us(uint32_t us)
{
    nrf51_pause_us(us);
}

void nrf51_bus_start(void)
{
    nrf51_wire_start();
    spi_bus_start();
}
