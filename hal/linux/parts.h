/* What the files of this HAL know of each other.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef LINUX_PARTS_H
#define LINUX_PARTS_H

#include <stdint.h>

#include "gpio.h"
#include "linux.h"

/* hal.c: keep a sentence for linux_why. Returns err. */
int linux_fail(int err, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* hal.c: a line that is held refused to be set or read, errno says why. HAL_ERR_BUS. */
int linux_fail_line(const char *what);

/* hal.c: let some time pass. */
void linux_pause_us(uint32_t us);

/* dev.c: the device node after `last` ("": the first) in /dev, by number, whose name is the prefix with digits and dots
 * behind it; symbolic links are passed over. 1; 0: there is no other. */
#define DEV_NAME 32
int linux_next_device(const char *prefix, const char *last, char next[DEV_NAME]);

/* dev.c: why this user may not open it, EACCES or EPERM, and whose group could. what: before the path. HAL_ERR_BUS. */
int linux_refuse_access(const char *what, const char *path, int why);

/* spi.c. Functions return HAL_ERR_NONE, HAL_ERR_BUS or HAL_ERR_TIMEOUT, with a sentence. */
int linux_spi_open(const struct linux_wiring *wiring);
void linux_spi_close(void);
int linux_spi_send(const uint8_t *bytes, uint32_t n);
uint32_t linux_spi_limit(void); /* bytes that a message may have */
struct linux_sent linux_spi_sent(void);
int linux_spi_look(const struct linux_wiring *wiring); /* could it be opened? */

/* bus.c: from start on the bus answers, until stop; reset may hold no line. HAL_ERR_NONE; HAL_ERR_BUS: no thread. */
int linux_bus_start(struct gpio_line *dc, struct gpio_line *reset);
void linux_bus_stop(void);

#endif
