/* The pico-sdk: a DMA that is done when it has been asked once whether it is.
 *
 * SPDX-License-Identifier: MIT
 */
#include "hardware/dma.h"
#include "hardware/gpio.h"
#include "hardware/spi.h"
#include "run_bus.h"

struct spi_inst {
    spi_hw_t hw;
};
static spi_inst_t the_spi;
spi_inst_t *const stub_spi = &the_spi;
extern struct hal_bus pico_bus;
void pico_bus_init(void);
static int dc;
static bool running;

void sleep_us(uint64_t us)
{
    (void)us;
}
void gpio_put(uint pin, bool level)
{
    if (pin == 20)
        dc = level;
    if (pin == 17)
        stub_deselected = level;
}
void gpio_init(uint pin)
{
    (void)pin;
}
void gpio_set_dir(uint pin, bool out)
{
    (void)pin;
    (void)out;
}
void gpio_set_function(uint pin, enum gpio_function function)
{
    (void)pin;
    (void)function;
}
uint spi_init(spi_inst_t *spi, uint hz)
{
    (void)spi;
    return hz;
}
int spi_write_blocking(spi_inst_t *spi, const uint8_t *from, size_t n)
{
    (void)spi;
    stub_wire(from, (uint32_t)n, dc);
    return (int)n;
}
bool spi_is_busy(const spi_inst_t *spi)
{
    (void)spi;
    return false;
}
spi_hw_t *spi_get_hw(spi_inst_t *spi)
{
    return &spi->hw;
}
uint spi_get_dreq(spi_inst_t *spi, bool is_tx)
{
    (void)spi;
    return is_tx ? 16 : 17;
}
int dma_claim_unused_channel(bool required)
{
    return required ? 3 : -1;
}
dma_channel_config dma_channel_get_default_config(uint channel)
{
    return (dma_channel_config){ channel };
}
void channel_config_set_transfer_data_size(dma_channel_config *c, enum dma_channel_transfer_size size)
{
    c->ctrl = size;
}
void channel_config_set_dreq(dma_channel_config *c, uint dreq)
{
    c->ctrl += dreq;
}
void dma_channel_configure(uint channel, const dma_channel_config *config, volatile void *to, const volatile void *from,
                           uint transfers, bool trigger)
{
    (void)config;
    if (channel == 3 && to == &the_spi.hw.dr && trigger)
        stub_wire((const uint8_t *)(uintptr_t)from, transfers, dc);
    running = true;
}
bool dma_channel_is_busy(uint channel) /* when it is asked for the first time after it began */
{
    const bool was = channel == 3 && running;
    running = false;
    return was;
}

int main(int argc, char **argv)
{
    pico_bus_init();
    return argc < 2 || keeps_hal_h(&pico_bus) || run(&pico_bus, argv[1]);
}
