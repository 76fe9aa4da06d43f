/* The accelerators of zs_fast.h and their names, for those who take one by its name or number.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_ACCELERATOR_TABLE_H
#define SIM_ACCELERATOR_TABLE_H

#include "zs_fast.h"

#define ACCELERATOR_ROW(name) { &zs_fast_##name, #name },
static const struct {
    const struct zs_fast *fast;
    const char *name;
} known[] = { ZS_FAST_EACH(ACCELERATOR_ROW) };
#define KNOWN (sizeof known / sizeof known[0])

#endif
