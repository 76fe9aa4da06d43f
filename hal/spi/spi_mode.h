/* The mode of a panel's SPI, for boards that can choose: SPI_MODE, 0 or 3.
 *
 * Both clock data in on the rising edge. Modules without a CS pin want 3; after a transfer that was broken off they no
 * longer know where bytes begin, until panel_init resets them.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SPI_MODE_H
#define SPI_MODE_H

#ifndef SPI_MODE
#define SPI_MODE 0
#endif

_Static_assert(SPI_MODE == 0 || SPI_MODE == 3, "SPI_MODE: 0 or 3");

#endif
