/* A stub: the part of a library that zstrip's example names, over the display of stub.h.
 *
 * SPDX-License-Identifier: MIT
 */
#pragma once
#include "stub.h"
typedef enum { HAL_OK, HAL_ERROR, HAL_BUSY, HAL_TIMEOUT } HAL_StatusTypeDef;
typedef struct { int unused; } SPI_HandleTypeDef;
typedef struct { int level; } GPIO_TypeDef;
typedef enum { GPIO_PIN_RESET, GPIO_PIN_SET } GPIO_PinState;
extern GPIO_TypeDef stub_port;
#define PANEL_DC_GPIO_Port (&stub_port)
#define PANEL_CS_GPIO_Port (&stub_port)
#define PANEL_RESET_GPIO_Port (&stub_port)
#define PANEL_DC_Pin 1
#define PANEL_CS_Pin 2
#define PANEL_RESET_Pin 4
HAL_StatusTypeDef HAL_SPI_Transmit(SPI_HandleTypeDef *spi, uint8_t *data, uint16_t n, uint32_t timeout);
HAL_StatusTypeDef HAL_SPI_Transmit_DMA(SPI_HandleTypeDef *spi, uint8_t *data, uint16_t n);
HAL_StatusTypeDef HAL_SPI_Abort(SPI_HandleTypeDef *spi);
void HAL_SPI_TxCpltCallback(SPI_HandleTypeDef *spi);
void HAL_SPI_ErrorCallback(SPI_HandleTypeDef *spi);
void HAL_GPIO_WritePin(GPIO_TypeDef *port, uint16_t pin, GPIO_PinState state);
uint32_t HAL_GetTick(void);
void HAL_Delay(uint32_t ms);
