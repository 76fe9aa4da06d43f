/* Lists of accelerators for tests: all, and all but one.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef FAST_LISTS_H
#define FAST_LISTS_H

#include "prng.h"
#include "zs_fast.h"

extern const struct zs_fast *const fast_all[]; /* the last one NULL */

/* Bits of a list. */
enum fast_bit {
    FAST_BATCH = 1, FAST_TOUCH = 2, FAST_TILES = 4, FAST_CLUSTERS = 8, FAST_EDGES = 16, /* of the frame */
    FAST_ALL = (1 << 14) - 1
};

/* How many accelerators there are, their names, and the list that lacks one of them; k < fast_count(). Static storage. */
unsigned fast_count(void);
const char *fast_name(unsigned k);
const struct zs_fast *const *fast_without(unsigned k);
/* A list by bits: accelerator k is in it where bit k is set. Static storage, overwritten by the next call but seven. */
const struct zs_fast *const *fast_of(unsigned bits);
/* Any list of all that there can be, by one number. */
const struct zs_fast *const *fast_any(struct prng *p);

#endif
