/* What frame.c and frame_threads.c share.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_FRAME_INSIDE_H
#define SIM_FRAME_INSIDE_H

#include "frame.h"

/* An arena of exactly the bytes that a configuration asks for, at the end of its block, so that AddressSanitizer sees a
 * step beyond it. *block: for free. Ends the program where there is no memory. */
void *sim_frame_arena(size_t bytes, void **block);

#endif
