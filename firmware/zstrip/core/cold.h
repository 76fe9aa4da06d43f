/* Included first by files all of whose functions run seldom: they are compiled for size whatever
 * the rest is compiled for. For a function in another file: ZS_RARE.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_COLD_H
#define ZS_COLD_H

#include "zs_config.h" /* before the pragma: ZS_FOR_SIZE is of the whole program */

#if defined(__GNUC__) && !defined(__clang__) && defined(__OPTIMIZE__)
#pragma GCC optimize("Os")
#endif

#endif
