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
    FAST_COUNT = 14, FAST_ALL = (1 << FAST_COUNT) - 1
};

/* How many accelerators there are, their names, and the list that lacks one of them; k < fast_count(). Static storage,
 * as fast_of's. */
unsigned fast_count(void);
const char *fast_name(unsigned k);
const struct zs_fast *const *fast_without(unsigned k);
/* A list by bits: accelerator k is in it where bit k is set. Static storage, overwritten by the next call but seven. */
const struct zs_fast *const *fast_of(unsigned bits);
/* Any list of all that there can be, by one number. */
const struct zs_fast *const *fast_any(struct prng *p);

/* The same list, of copies that count: fast_used[k] is how often accelerator k did its part, fast_at_once how many
 * triangles in strips were drawn before they were set up. Both begin at 0. Static storage, overwritten by the next
 * call. */
const struct zs_fast *const *fast_counting(const struct zs_fast *const *list);
extern uint32_t fast_used[FAST_COUNT], fast_at_once;

#endif
