/* The table of all showpieces.
 *
 * SPDX-License-Identifier: MIT
 */
#include "pieces.h"

const struct piece *const pieces[] = { &piece_stilllife, &piece_cockpit, &piece_forest };
const uint32_t n_pieces = sizeof pieces / sizeof pieces[0];
