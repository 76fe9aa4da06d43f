/* Large blocks that are used again: new pages for each frame take longer than the frame.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_KEPT_H
#define SIM_KEPT_H

#include <stddef.h>

/* A block of that many bytes, of any value, aligned to 4 bytes; NULL where there is no memory. It ends where its memory
 * ends, and AddressSanitizer sees reads and writes before it, behind it and after it is given back. */
void *sim_kept(size_t bytes);

/* Give a block of sim_kept's back, or one of malloc's, which is freed, or NULL. */
void sim_kept_end(void *block);

#endif
