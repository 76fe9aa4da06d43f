/* Random lengths.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_PRNG_LOG_H
#define SIM_PRNG_LOG_H

#include <math.h>

#include "prng.h"

/* lo <= x < hi, all magnitudes equally likely; 0 < lo < hi. */
static inline double prng_real_log(struct prng *p, double lo, double hi)
{
    return lo * pow(hi / lo, prng_real(p, 0, 1));
}

#endif
