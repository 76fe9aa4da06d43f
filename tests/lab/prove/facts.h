/* What facts.c, facts_more.c and facts_drawn.c share.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef FACTS_H
#define FACTS_H

#include <stdint.h>

void tell(const char *name, uint64_t n, int good, const char *what);
void facts_more(uint64_t count);
void facts_drawn(uint64_t count);

#endif
