/* Included first by files whose functions run once a frame or more seldom: they are compiled for size whatever the
 * rest is compiled for. A file that is read for a model (check.c) and the paths of triangles that are cut (clip.c) too.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_COLD_H
#define ZS_COLD_H

#if defined(__GNUC__) && !defined(__clang__) && defined(__OPTIMIZE__)
#pragma GCC optimize("Os")
#endif

#endif
