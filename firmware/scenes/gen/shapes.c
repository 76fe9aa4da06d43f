/* A cube with a colour a side, and a smooth torus knot.
 *
 * SPDX-License-Identifier: MIT
 */
#include "gen.h"

#define CUBE 8192 /* half an edge, steps */

#define KNOT_RINGS 96
#define KNOT_SIDES 11
#define KNOT_TORUS 8000 /* steps: radius of the torus' middle circle ... */
#define KNOT_RADIUS 4000 /* ... of the torus on which the knot winds ... */
#define KNOT_TUBE 1850  /* ... and of the tube itself */

static void cube(void)
{
    static const struct gen_rgb colors[6] = {
        { 238, 82, 83 },  { 255, 159, 67 }, { 254, 211, 48 },
        { 32, 191, 107 }, { 69, 170, 242 }, { 165, 94, 234 },
    };
    struct gen_mesh *m = gen_begin("cube");
    for (uint32_t i = 0; i < 8; i++)
        gen_vert(m, i & 1u ? CUBE : -CUBE, i & 2u ? CUBE : -CUBE, i & 4u ? CUBE : -CUBE);
    gen_quad(m, 1, 3, 7, 5, colors[0]); /* +x */
    gen_quad(m, 0, 4, 6, 2, colors[1]);
    gen_quad(m, 2, 6, 7, 3, colors[2]); /* +y */
    gen_quad(m, 0, 1, 5, 4, colors[3]);
    gen_quad(m, 4, 5, 7, 6, colors[4]); /* +z */
    gen_quad(m, 0, 2, 3, 1, colors[5]);
    gen_write(m, GEN_FACE_NORMAL | GEN_FACE_RGB, 65536);
}

/* (2, 3) torus knot: turns twice around the axis and three times around the tube of a torus. The
 * torus' normal is at right angles to the curve that lies on it: a frame that closes by itself. */
static void knot(void)
{
    struct gen_mesh *m = gen_begin("knot");
    for (int64_t i = 0; i < KNOT_RINGS; i++) {
        const int64_t t = gen_div(i * 65536, KNOT_RINGS);
        const int64_t c2 = gen_cos(2 * t), s2 = gen_sin(2 * t);
        const int64_t c3 = gen_cos(3 * t), s3 = gen_sin(3 * t);
        const int64_t from_axis = KNOT_TORUS + gen_div(KNOT_RADIUS * c3, GEN_Q30);
        /* all q30 but the middle: steps * 2^16 */
        const int64_t middle[3] = { gen_div(from_axis * c2, 16384), gen_div(from_axis * s2, 16384),
                                    gen_div(KNOT_RADIUS * s3, 16384) };
        int64_t normal[3] = { gen_div(c3 * c2, GEN_Q30), gen_div(c3 * s2, GEN_Q30), s3 };
        int64_t tangent[3] = {
            -2 * from_axis * s2 - 3 * gen_div(KNOT_RADIUS * s3, GEN_Q30) * c2,
            2 * from_axis * c2 - 3 * gen_div(KNOT_RADIUS * s3, GEN_Q30) * s2,
            3 * KNOT_RADIUS * c3,
        };
        int64_t side[3];
        gen_unit(tangent, (int64_t)1 << 29);
        gen_unit(normal, (int64_t)1 << 29);
        gen_cross(side, tangent, normal);
        gen_unit(normal, GEN_Q30);
        gen_unit(side, GEN_Q30);
        for (int64_t k = 0; k < KNOT_SIDES; k++) {
            /* half a side further in every other ring: rounder at the same count */
            const int64_t a = gen_div((2 * k + (i & 1)) * 32768, KNOT_SIDES);
            int64_t pos[3], out[3];
            for (int j = 0; j < 3; j++) {
                out[j] = gen_div(gen_cos(a) * normal[j] + gen_sin(a) * side[j], GEN_Q30);
                pos[j] = gen_div(middle[j] + gen_div(out[j] * KNOT_TUBE, 16384), 65536);
            }
            gen_vert_normal(m, pos, out, gen_hue(2 * t));
        }
    }
    const struct gen_rgb white = { 255, 255, 255 };
    for (uint32_t i = 0; i < KNOT_RINGS; i++) {
        const uint32_t now = i * KNOT_SIDES, next = (i + 1) % KNOT_RINGS * KNOT_SIDES;
        for (uint32_t k = 0; k < KNOT_SIDES; k++) {
            const uint32_t j = (k + 1) % KNOT_SIDES;
            if (i & 1u) {
                gen_tri(m, now + k, now + j, next + j, white);
                gen_tri(m, now + k, next + j, next + k, white);
            } else {
                gen_tri(m, now + k, now + j, next + k, white);
                gen_tri(m, now + j, next + j, next + k, white);
            }
        }
    }
    gen_write(m, GEN_NORMAL | GEN_VERTEX_RGB, 65536);
}

void gen_shapes(void)
{
    cube();
    knot();
}
