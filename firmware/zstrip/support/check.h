/* Checks that more than one file needs. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_SUPPORT_CHECK_H
#define ZS_SUPPORT_CHECK_H

#include "zs_check.h"

/* zs_texture_check for a format that is known: texels of 2^log2_bits bits, 2 .. 4 (0: it is not
 * known), which are colours or, if `palette`, numbers in a palette. */
enum zs_flaw zs_texture_flaw(const struct zs_texture *x, uint32_t log2_bits, int palette,
                             uint32_t *index);

#endif
