/* What frame.c and frame_threads.c share.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_FRAME_INSIDE_H
#define SIM_FRAME_INSIDE_H

#include "frame.h"

/* An arena of exactly the bytes that a configuration asks for, full of what is no zero; for sim_kept_end. Ends the
 * program where there is no memory. */
void *sim_frame_arena(size_t bytes);

#endif
