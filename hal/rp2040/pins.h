/* Where the panel is wired to a Raspberry Pi Pico, and how fast its wire is. The one file to change for another
 * wiring; each name can also be set on the command line: make firmware DEFINES='-DPIN_RESET=14 -DSPI_DIVIDER=4' ...
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef RP2040_PINS_H
#define RP2040_PINS_H

/* GPIO numbers. SCK and MOSI must be pins of SPI0: SCK 2, 6, 18 or 22, MOSI 3, 7, 19 or 23 (datasheet, 1.4.3). The
 * others may be any. */
#ifndef PIN_SCK
#define PIN_SCK 18
#endif
#ifndef PIN_MOSI
#define PIN_MOSI 19
#endif
#ifndef PIN_CS
#define PIN_CS 17
#endif
#ifndef PIN_DC
#define PIN_DC 20
#endif
#ifndef PIN_RESET
#define PIN_RESET 21
#endif
#ifndef PIN_BACKLIGHT
#define PIN_BACKLIGHT 22
#endif
#ifndef PIN_TEXT
#define PIN_TEXT 0 /* UART0 TX: 0, 12, 16 or 28; 115200 baud, 8N1 */
#endif

/* SCK is 125 MHz / SPI_DIVIDER: even, 2 .. 254. 2 is 62.5 MHz, which ST7789 and GC9A01 glasses take on short wires;
 * take 4 on long ones. Datasheets allow SSD1351 20 MHz (8), ILI9341 and SSD1306 10 MHz (14; many an ILI9341 takes
 * 4), SSD0323 4 MHz (32). */
#ifndef SPI_DIVIDER
#define SPI_DIVIDER 2
#endif

#include "spi_mode.h" /* SPI_MODE: 0 or 3 */

#endif
