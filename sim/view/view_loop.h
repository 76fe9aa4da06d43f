/* The window, from when it is opened to when it is closed.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_VIEW_VIEW_LOOP_H
#define SIM_VIEW_VIEW_LOOP_H

#include "words.h"

/* Show what the words draw, which name a model or --scene, and --out. SIM_OK: it was closed; SIM_REFUSED, SIM_USAGE,
 * said why. */
int view_loop(const struct view_words *words);

#endif
