/* A frame of a showpiece (firmware/scenes/pieces).
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_PIECE_FRAME_H
#define SIM_PIECE_FRAME_H

#include "frame.h"
#include "pieces.h"

/* As sim_frame_render_to, of what piece->demo.pose has filled. config has the piece's method. */
int sim_piece_render(struct sim_frame *frame, const struct piece *piece, const struct demo_frame *f,
                     const struct zs_config *config, const char *what, const struct zs_sink *to);

#endif
