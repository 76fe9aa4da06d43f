/* What hal_init calls of bus.c.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef NULL_H
#define NULL_H

/* From here on the bus answers; before it is HAL_ERR_STATE. */
void null_bus_start(void);

#endif
