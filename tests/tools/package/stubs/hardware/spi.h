/* A stub: the part of a library that zstrip's example names, over the display of stub.h.
 *
 * SPDX-License-Identifier: MIT
 */
#pragma once
#include "../pico/stdlib.h"
typedef struct { volatile uint32_t dr; } spi_hw_t;
typedef struct spi_inst spi_inst_t;
extern spi_inst_t *const stub_spi;
#define spi0 stub_spi
uint spi_init(spi_inst_t *spi, uint hz);
int spi_write_blocking(spi_inst_t *spi, const uint8_t *from, size_t n);
bool spi_is_busy(const spi_inst_t *spi);
spi_hw_t *spi_get_hw(spi_inst_t *spi);
uint spi_get_dreq(spi_inst_t *spi, bool is_tx);
