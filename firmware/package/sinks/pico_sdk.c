/* A panel's bus on the pico-sdk: hardware_spi and hardware_dma, wired as boards of zstrip's own are. The rest is
 * pico_bus_init(), panel_init(&panel, &config, &pico_bus, NULL, 0) and panel_send.
 *
 * SPDX-License-Identifier: MIT
 */
#include "hal.h"
#include "hardware/dma.h"
#include "hardware/gpio.h"
#include "hardware/spi.h"
#include "pico/stdlib.h"

enum { SCK = 18, MOSI = 19, CS = 17, DC = 20, RESET = 21, HZ = 62500000 };

static int channel; /* of the DMA */
static int busy;    /* from data to wait */

static int command(struct hal_bus *bus, uint8_t code, const uint8_t *args, uint32_t n)
{
    (void)bus;
    if (n && !args)
        return HAL_ERR_ARG;
    if (busy)
        return HAL_ERR_STATE;
    gpio_put(DC, false);
    gpio_put(CS, false);
    (void)spi_write_blocking(spi0, &code, 1);
    gpio_put(DC, true);
    if (n)
        (void)spi_write_blocking(spi0, args, n);
    gpio_put(CS, true);
    return HAL_ERR_NONE;
}

static int data(struct hal_bus *bus, const uint8_t *bytes, uint32_t n)
{
    (void)bus;
    if (!bytes || !n)
        return HAL_ERR_ARG;
    if (busy)
        return HAL_ERR_STATE;
    busy = 1;
    gpio_put(DC, true);
    gpio_put(CS, false);
    dma_channel_config config = dma_channel_get_default_config((uint)channel);
    channel_config_set_transfer_data_size(&config, DMA_SIZE_8);
    channel_config_set_dreq(&config, spi_get_dreq(spi0, true));
    dma_channel_configure((uint)channel, &config, &spi_get_hw(spi0)->dr, bytes, n, true);
    return HAL_ERR_NONE;
}

static int wait(struct hal_bus *bus)
{
    if (!busy)
        return HAL_ERR_NONE;
    while (dma_channel_is_busy((uint)channel))
        if (bus->hooks.idle)
            bus->hooks.idle(bus->hooks.ctx);
    while (spi_is_busy(spi0))
        tight_loop_contents();
    gpio_put(CS, true);
    busy = 0;
    if (bus->hooks.done)
        bus->hooks.done(bus->hooks.ctx);
    return HAL_ERR_NONE;
}

static void delay(struct hal_bus *bus, uint32_t us)
{
    (void)bus;
    sleep_us(us);
}

static int reset(struct hal_bus *bus)
{
    if (busy)
        return HAL_ERR_STATE;
    gpio_put(RESET, false);
    delay(bus, 100);
    gpio_put(RESET, true);
    delay(bus, 100);
    return HAL_ERR_NONE;
}

struct hal_bus pico_bus = { .command = command, .data = data, .wait = wait, .reset = reset, .delay = delay };

void pico_bus_init(void);
void pico_bus_init(void)
{
    (void)spi_init(spi0, HZ);
    gpio_set_function(SCK, GPIO_FUNC_SPI);
    gpio_set_function(MOSI, GPIO_FUNC_SPI);
    for (uint pin = CS; pin <= RESET; pin++)
        if (pin == CS || pin == DC || pin == RESET) {
            gpio_init(pin);
            gpio_set_dir(pin, GPIO_OUT);
            gpio_put(pin, true);
        }
    channel = dma_claim_unused_channel(true);
}
