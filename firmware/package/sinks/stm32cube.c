/* A panel's bus on STM32Cube's HAL: SPI by DMA, two GPIOs. CubeMX makes hspi1 (8 bits, mode 0, TX DMA) and the pins
 * PANEL_DC, PANEL_CS and PANEL_RESET; the rest is panel_init(&panel, &config, &stm32_bus, NULL, 0) and panel_send.
 *
 * SPDX-License-Identifier: MIT
 */
#include "hal.h"
#include "main.h" /* CubeMX's: the HAL, hspi1, the pins */

#define PART 0xfffeu /* bytes: the DMA counts to 65535 */

extern SPI_HandleTypeDef hspi1;
extern struct hal_bus stm32_bus;
static const uint8_t *next;    /* what has not been begun yet */
static volatile uint32_t left; /* bytes of it */
static volatile uint8_t busy, failed;

static int begin_part(void)
{
    const uint32_t n = left < PART ? left : PART;
    const uint8_t *from = next;
    next += n;
    left -= n;
    return HAL_SPI_Transmit_DMA(&hspi1, (uint8_t *)from, (uint16_t)n) == HAL_OK;
}

/* All is out, or it has failed: the panel lets go of the bus. Mostly in an interrupt. */
static void end(int bad)
{
    HAL_GPIO_WritePin(PANEL_CS_GPIO_Port, PANEL_CS_Pin, GPIO_PIN_SET);
    left = 0;
    failed = (uint8_t)bad;
    busy = 0;
    if (stm32_bus.hooks.done)
        stm32_bus.hooks.done(stm32_bus.hooks.ctx);
}

void HAL_SPI_TxCpltCallback(SPI_HandleTypeDef *spi)
{
    if (spi != &hspi1 || !busy)
        return;
    if (!left)
        end(0);
    else if (!begin_part())
        end(1);
}

void HAL_SPI_ErrorCallback(SPI_HandleTypeDef *spi)
{
    if (spi == &hspi1 && busy)
        end(1);
}

static int data(struct hal_bus *bus, const uint8_t *bytes, uint32_t n)
{
    (void)bus;
    if (!bytes || !n)
        return HAL_ERR_ARG;
    if (busy)
        return HAL_ERR_STATE;
#if defined(__DCACHE_PRESENT) && __DCACHE_PRESENT
    SCB_CleanDCache_by_Addr((uint32_t *)((uintptr_t)bytes & ~(uintptr_t)31u),
                            (int32_t)(n + ((uintptr_t)bytes & 31u)));
#endif
    HAL_GPIO_WritePin(PANEL_DC_GPIO_Port, PANEL_DC_Pin, GPIO_PIN_SET);
    HAL_GPIO_WritePin(PANEL_CS_GPIO_Port, PANEL_CS_Pin, GPIO_PIN_RESET);
    next = bytes;
    left = n;
    failed = 0;
    busy = 1; /* before it begins: two bytes may be out before begin_part returns */
    if (begin_part())
        return HAL_ERR_NONE;
    busy = 0;
    HAL_GPIO_WritePin(PANEL_CS_GPIO_Port, PANEL_CS_Pin, GPIO_PIN_SET);
    return HAL_ERR_BUS;
}

static int wait(struct hal_bus *bus)
{
    const uint32_t from = HAL_GetTick();
    while (busy && HAL_GetTick() - from < 1000u)
        if (bus->hooks.idle)
            bus->hooks.idle(bus->hooks.ctx);
    if (busy) {
        (void)HAL_SPI_Abort(&hspi1);
        if (busy)
            end(0);
        return HAL_ERR_TIMEOUT;
    }
    const int bad = failed;
    failed = 0;
    return bad ? HAL_ERR_BUS : HAL_ERR_NONE;
}

static int command(struct hal_bus *bus, uint8_t code, const uint8_t *args, uint32_t n)
{
    (void)bus;
    if (n && !args)
        return HAL_ERR_ARG;
    if (busy)
        return HAL_ERR_STATE;
    HAL_GPIO_WritePin(PANEL_DC_GPIO_Port, PANEL_DC_Pin, GPIO_PIN_RESET);
    HAL_GPIO_WritePin(PANEL_CS_GPIO_Port, PANEL_CS_Pin, GPIO_PIN_RESET);
    int bad = HAL_SPI_Transmit(&hspi1, &code, 1, 100) != HAL_OK;
    HAL_GPIO_WritePin(PANEL_DC_GPIO_Port, PANEL_DC_Pin, GPIO_PIN_SET);
    if (n)
        bad |= HAL_SPI_Transmit(&hspi1, (uint8_t *)args, (uint16_t)n, 100) != HAL_OK;
    HAL_GPIO_WritePin(PANEL_CS_GPIO_Port, PANEL_CS_Pin, GPIO_PIN_SET);
    return bad ? HAL_ERR_BUS : HAL_ERR_NONE;
}

static void delay(struct hal_bus *bus, uint32_t us)
{
    (void)bus;
    HAL_Delay((us + 999u) / 1000u);
}

static int reset(struct hal_bus *bus)
{
    if (busy)
        return HAL_ERR_STATE;
    HAL_GPIO_WritePin(PANEL_RESET_GPIO_Port, PANEL_RESET_Pin, GPIO_PIN_RESET);
    delay(bus, 1000);
    HAL_GPIO_WritePin(PANEL_RESET_GPIO_Port, PANEL_RESET_Pin, GPIO_PIN_SET);
    delay(bus, 1000);
    return HAL_ERR_NONE;
}

struct hal_bus stm32_bus = { .command = command, .data = data, .wait = wait, .reset = reset, .delay = delay };
