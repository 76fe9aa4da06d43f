/* Where the panel is wired to an STM32F405, and how fast its wire is. The one file to change for another wiring; each
 * name can also be set on the command line: make firmware BOARD=stm32f405 DEFINES='-DPIN_RESET=PB1 -DSPI_DIVIDER=4' ...
 *
 *                     STM32F405   Pyboard v1.1   Feather STM32F405
 *   SCL (SCK)         PA5         X6             A1
 *   SDA (MOSI)        PA7         X8             A3
 *   CS                PA4         X5             A0
 *   DC                PA6         X7             A2
 *   RES               PC4         X11            A4
 *   BL                PC7         Y2             D5
 *   text, 115200 baud PC6         Y1             D6
 *
 * A Netduino Plus 2 has SPI2 on its header (D13, D11), and no pin of SPI1: this HAL does not drive a panel there.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef STM32F4_PINS_H
#define STM32F4_PINS_H

/* Sixteen to a port. */
enum stm32f4_pin {
    PA0, PA1, PA2, PA3, PA4, PA5, PA6, PA7, PA8, PA9, PA10, PA11, PA12, PA13, PA14, PA15,
    PB0, PB1, PB2, PB3, PB4, PB5, PB6, PB7, PB8, PB9, PB10, PB11, PB12, PB13, PB14, PB15,
    PC0, PC1, PC2, PC3, PC4, PC5, PC6, PC7, PC8, PC9, PC10, PC11, PC12, PC13, PC14, PC15,
    PD0, PD1, PD2
};

/* SCK and MOSI must be pins of SPI1: SCK PA5 or PB3, MOSI PA7 or PB5. CS, DC and RESET may be any. */
#ifndef PIN_SCK
#define PIN_SCK PA5
#endif
#ifndef PIN_MOSI
#define PIN_MOSI PA7
#endif
#ifndef PIN_CS
#define PIN_CS PA4
#endif
#ifndef PIN_DC
#define PIN_DC PA6
#endif
#ifndef PIN_RESET
#define PIN_RESET PC4
#endif
#ifndef PIN_BACKLIGHT
#define PIN_BACKLIGHT PC7 /* TIM3: PB0, PB1, PC7, PC8 or PC9 */
#endif
#define PIN_TEXT PC6 /* USART6 TX; 115200 baud, 8N1 */

/* SCK is 84 MHz / SPI_DIVIDER: 2, 4, 8 .. 256. 2 is 42 MHz, which ST7789 and GC9A01 glasses take on short wires; take 4
 * on long ones. Datasheets allow SSD1351 20 MHz (8), ILI9341 and SSD1306 10 MHz (16; many an ILI9341 takes 4),
 * SSD0323 4 MHz (32). */
#ifndef SPI_DIVIDER
#define SPI_DIVIDER 2
#endif

#include "spi_mode.h" /* SPI_MODE: 0 or 3 */

/* 0: pixels are written by the core, as commands are. For emulators without the DMA; nothing is drawn meanwhile. */
#ifndef SPI_DMA
#define SPI_DMA 1
#endif

#endif
