/* STM32Cube: a DMA that is done when it is waited for.
 *
 * SPDX-License-Identifier: MIT
 */
#include "main.h"
#include "run_bus.h"

SPI_HandleTypeDef hspi1;
GPIO_TypeDef stub_port;
extern struct hal_bus stm32_bus;
static int dc;

HAL_StatusTypeDef HAL_SPI_Transmit(SPI_HandleTypeDef *spi, uint8_t *bytes, uint16_t n, uint32_t timeout)
{
    (void)spi;
    (void)timeout;
    stub_wire(bytes, n, dc);
    return HAL_OK;
}
static enum { USUAL, AT_ONCE, REFUSES, NEVER, FAILS, FAILS_LATER } way; /* of a transfer by DMA */
static uint32_t ticks, parts;
HAL_StatusTypeDef HAL_SPI_Transmit_DMA(SPI_HandleTypeDef *spi, uint8_t *bytes, uint16_t n)
{
    if (way == REFUSES || (way == FAILS_LATER && parts++))
        return HAL_BUSY;
    stub_wire(bytes, n, dc);
    if (way == AT_ONCE)
        HAL_SPI_TxCpltCallback(spi);
    return HAL_OK;
}
HAL_StatusTypeDef HAL_SPI_Abort(SPI_HandleTypeDef *spi)
{
    (void)spi;
    return HAL_OK;
}
void HAL_GPIO_WritePin(GPIO_TypeDef *port, uint16_t pin, GPIO_PinState state)
{
    (void)port;
    if (pin == PANEL_DC_Pin)
        dc = state;
    if (pin == PANEL_CS_Pin)
        stub_deselected = state;
}
uint32_t HAL_GetTick(void)
{
    return ticks;
}
void HAL_Delay(uint32_t ms)
{
    (void)ms;
}
static void interrupt(void) /* it comes while it is waited for */
{
    ticks += 100;
    if (way == FAILS)
        HAL_SPI_ErrorCallback(&hspi1);
    else if (way != NEVER)
        HAL_SPI_TxCpltCallback(&hspi1);
}

/* Transfers that end before they have begun, that fail, and that never end: the panel lets go of the bus. */
static int ends_well(void)
{
    static const uint8_t px[100000];
    static const struct {
        int way, data, wait;
    } of[] = { { AT_ONCE, HAL_ERR_NONE, HAL_ERR_NONE }, { REFUSES, HAL_ERR_BUS, HAL_ERR_NONE },
               { NEVER, HAL_ERR_NONE, HAL_ERR_TIMEOUT }, { FAILS, HAL_ERR_NONE, HAL_ERR_BUS },
               { FAILS_LATER, HAL_ERR_NONE, HAL_ERR_BUS }, { USUAL, HAL_ERR_NONE, HAL_ERR_NONE } };
    int good = 1;
    for (uint32_t k = 0; k < sizeof of / sizeof of[0]; k++) {
        way = of[k].way;
        n_done = 0;
        good &= stm32_bus.data(&stm32_bus, px, sizeof px) == of[k].data;
        good &= stm32_bus.wait(&stm32_bus) == of[k].wait && stub_deselected && n_done == !of[k].data;
        if (!good) {
            fprintf(stderr, "a transfer of way %d does not end well\n", way);
            break;
        }
    }
    return !good;
}

int main(int argc, char **argv)
{
    hardware = interrupt;
    return argc < 2 || keeps_hal_h(&stm32_bus) || ends_well() || run(&stm32_bus, argv[1]);
}
