/* Where the panel is wired to a micro:bit v1, and how fast its wire is. The one file to change for another wiring; each
 * name can also be set on the command line: make firmware DEFINES='-DPIN_RESET=2 -DSPI_MHZ=4' ...
 *
 * Numbers are the nRF51's, P0.n. The edge connector counts otherwise:
 *
 *   edge    0   1   2   3   4   5   6   7   8   9  10  11  12  13  14  15  16  19  20
 *   P0.     3   2   1   4   5  17  12  11  18  10   6  26  20  23  22  21  16   0  30
 *
 * 3, 4, 6, 7, 9 and 10 have LEDs on them, 5 and 11 buttons, 19 and 20 the sensors' I2C; 12 is reserved.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef NRF51_PINS_H
#define NRF51_PINS_H

#ifndef PIN_SCK
#define PIN_SCK 23 /* edge 13 */
#endif
#ifndef PIN_MOSI
#define PIN_MOSI 21 /* edge 15 */
#endif
#ifndef PIN_CS
#define PIN_CS 16 /* edge 16 */
#endif
#ifndef PIN_DC
#define PIN_DC 18 /* edge 8 */
#endif
#ifndef PIN_RESET
#define PIN_RESET 22 /* edge 14: MISO, which nothing here reads */
#endif
#ifndef PIN_BACKLIGHT
#define PIN_BACKLIGHT 3 /* edge 0, a ring; switched. A pin gives 5 mA at most: a larger light wants a transistor */
#endif

/* Text: to the chip that is the micro:bit's USB, where a PC sees a serial port; 8N1. */
#ifndef PIN_TEXT
#define PIN_TEXT 24
#endif
#ifndef TEXT_BAUD
#define TEXT_BAUD 115200
#endif

/* 0 or 1. SPI0 has its registers in common with the I2C that is TWI0, SPI1 with TWI1: a program that reads the sensors
 * wants the other one for that. */
#ifndef SPI_INSTANCE
#define SPI_INSTANCE 0
#endif

/* SCK: 8, 4, 2 or 1 MHz. ILI9341, SSD1351 and SSD1306 take 8, SSD0323 4. */
#ifndef SPI_MHZ
#define SPI_MHZ 8
#endif

#include "spi_mode.h" /* SPI_MODE: 0 or 3 */

/* 1: no SPI. What would go over the panel's wire leaves with the text, as the words that `zsim panel --decode` reads:
 * for QEMU, which models no SPI, and for a desk without a panel. At 115200 baud 0.2 ms a byte of the wire. */
#ifndef PANEL_ON_UART
#define PANEL_ON_UART 0
#endif

#endif
