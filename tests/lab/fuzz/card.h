/* A mesh and a texture as they might lie on a card: a header, then arrays one after another, all in this
 * machine's byte order. The reader believes nothing but what it needs to allocate memory.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef TESTS_FUZZ_CARD_H
#define TESTS_FUZZ_CARD_H

#include <stddef.h>
#include <stdint.h>

#include "zs_check.h"
#include "zstrip.h"

/* Arrays that a header's bits name, in the order of the file: X(bit, field of struct zs_mesh, count).
 * pos and tri come before them; palette and texels follow. */
#define CARD_ARRAYS(X) \
    X(1, pos_lo, n_verts) \
    X(2, normal, n_verts) \
    X(4, face_normal, n_tris) \
    X(8, vertex_rgb, n_verts) \
    X(16, face_rgb, n_tris) \
    X(32, face_raw, n_tris) \
    X(64, uv, n_verts) \
    X(128, cluster, n_clusters)

struct card_header {
    uint32_t n_verts, n_tris, n_clusters;
    zs_uq16_16 scale;
    int16_t center[3];
    uint16_t radius;
    uint8_t arrays; /* bits of CARD_ARRAYS */
    uint8_t uv_bits;
    uint8_t texel;  /* of kind_texels; beyond them: no texture format */
    uint8_t log2_w, log2_h, clamp;
    uint16_t n_colors;
    /* how to look at it */
    zs_turn yaw;
    int16_t pitch;
    uint8_t distance, depth, look, state; /* look: bits of enum card_look; state: 0 none */
};
_Static_assert(sizeof(struct card_header) == 40, "no padding in a file");

enum card_look { CARD_ORTHOGRAPHIC = 1, CARD_CULL = 6, CARD_NEAR = 8, CARD_SMALL = 16, CARD_STRIPS = 96 };

/* What a reader has memory for. Above, and up to 65535 vertices, counts are taken modulo these; with more
 * vertices nothing is read: zs_mesh_check and zs_frame_begin must refuse it unread. */
#define CARD_VERTS 512u
#define CARD_TRIS 256u
#define CARD_CLUSTERS 256u
#define CARD_TEXELS_LOG2 13 /* log2_h is cut to it where both are in range */
#define CARD_BYTES_MAX 65536u

#endif
