/* A mesh of four corners and two triangles, on which shaders are counted.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef TESTS_LAB_CARD_H
#define TESTS_LAB_CARD_H

#include "zstrip.h"

static const uint16_t card_tri[2][3] = { { 0, 1, 2 }, { 0, 2, 3 } };
/* Corners in order around it; normals of the corners, of which the first two are the triangles' too. */
#define CARD(pos_, normal_, uv_, uv_bits_, radius_) \
    { .pos = (pos_), .tri = card_tri, .normal = (normal_), .face_normal = (normal_), .uv = (uv_), \
      .uv_bits = (uv_bits_), .n_verts = 4, .n_tris = 2, .radius = (radius_) }

#endif
