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
HAL_StatusTypeDef HAL_SPI_Transmit_DMA(SPI_HandleTypeDef *spi, uint8_t *bytes, uint16_t n)
{
    stub_wire(bytes, n, dc);
    stm32_bus.hooks.ctx = spi;
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
}
uint32_t HAL_GetTick(void)
{
    return 0;
}
void HAL_Delay(uint32_t ms)
{
    (void)ms;
}
static void idle(void *spi) /* the interrupt comes while it is waited for */
{
    HAL_SPI_TxCpltCallback(spi);
}

int main(int argc, char **argv)
{
    stm32_bus.hooks.idle = idle;
    return argc < 2 || run(&stm32_bus, argv[1]);
}
