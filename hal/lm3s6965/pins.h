/* Where the OLED hangs on an LM3S6965EVB (its user's manual: OLED display), and how fast its wire is. Each name can be
 * set on the command line, for another panel at the board's pads: make firmware DEFINES='-DSPI_DIVIDER=4' ...
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef LM3S6965_PINS_H
#define LM3S6965_PINS_H

/* GPIO pins: 8 * port + number, port A is 0. Those of SSI0 and UART0 are the chip's. */
#define PIN_TEXT 1 /* A1, UART0 TX: 115200 baud, 8N1; the board's USB has its other end */
#define PIN_SCK 2  /* A2 */
#define PIN_MOSI 5 /* A5 */
#ifndef PIN_CS
#define PIN_CS 3 /* A3, OLEDCSn */
#endif
#ifndef PIN_DC
#define PIN_DC 23 /* C7, OLEDDC */
#endif
#ifndef PIN_POWER
#define PIN_POWER 22 /* C6, EN+15V: high starts the converter for the glass, on boards that have one */
#endif
#ifndef PIN_CARD
#define PIN_CARD 24 /* D0, CARDCSn: the card socket on the same wires; stays high */
#endif

/* SCK is 50 MHz / SPI_DIVIDER: even, 2 .. 254. An SSD0323 takes 4 MHz: 14 is 3.57 MHz. */
#ifndef SPI_DIVIDER
#define SPI_DIVIDER 14
#endif

#endif
