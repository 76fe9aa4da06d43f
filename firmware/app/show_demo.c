/* The show of the demo scene that the compiler's -DSHOW_DEMO=teapot names; with -DSHOW_PIECE=1 of that showpiece.
 *
 * SPDX-License-Identifier: MIT
 */
#include "show.h"
#include "sizes.h"

#define JOIN(a, b) a##b
#define OF(prefix, name) JOIN(prefix, name)
#define SHOW_SIZED(...) SHOW(__VA_ARGS__)

#if SHOW_PIECE
#include "pieces.h"
#define IT OF(piece_, SHOW_DEMO).demo
#else
#define IT OF(demo_, SHOW_DEMO)
#endif

#if SHOW_CORES == 2
SHOW_SIZED(IT, OF(SIZES_2_, SHOW_DEMO));
#else
SHOW_SIZED(IT, OF(SIZES_, SHOW_DEMO));
#endif
