/* Files whose functions all run seldom include this header first. They are then compiled for size,
 * even if the rest is compiled for speed. ZS_RARE does the same for a single function.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_COLD_H
#define ZS_COLD_H

#include "zs_config.h" /* before the pragma: ZS_FOR_SIZE must be that of the whole program */

#if defined(__GNUC__) && !defined(__clang__) && defined(__OPTIMIZE__)
#pragma GCC optimize("Os")
#endif

#endif
