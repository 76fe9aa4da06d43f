/* depth_linear.c.
 *
 * SPDX-License-Identifier: MIT
 */
#include "prove.h"

#include "core/pipeline.h"

#include "depth/linear.c"

static struct zs_view view;

/* near at both ends of its range and at the middle, far by octave of what it is beyond near */
static void any_view(int perspective, uint32_t bits, int64_t z_near, int k)
{
    struct zs_camera camera;
    view.perspective = (uint8_t)perspective;
    view.z_near = perspective ? any_i32(256, 1 << 30) : any_i32(-(1 << 30), 1 << 30);
    view.shift = any_i32(-34, 30);
    camera.z_near = z_near;
    camera.z_far = any_i64(z_near + (int64_t)OCTAVE_LO(k), z_near + (int64_t)OCTAVE_HI(k));
    (void)linear_setup(&view, &camera, bits);
}

/* PROVE linear_orthographic: near at both ends of its range and 0, far beyond it by 1 .. 2^60 by octave, 8 and 16 bits,
 * every shift of units -34 .. 30, every z of a frame */
void linear_orthographic(void)
{
    static const int64_t near[3] = { -((int64_t)1 << 45), 0, (int64_t)1 << 45 };
    for (uint32_t bits = 8; bits <= 16; bits += 8)
        for (int i = 0; i < 3; i++)
            for (int k = 0; k < 60; k++) {
                any_view(0, bits, near[i], k);
                (void)linear_vertex(&view, any_i32(-(1 << 30), 1 << 30), 0, 0);
            }
}

/* PROVE linear_perspective: w of a pixel, 64 bits by octave and 0; scales of every triangle; every shift of the mapping that
 * its set-up gives, 8 .. 16 bits */
void linear_perspective(void)
{
    view.perspective = 1;
    view.z_near = any_i32(256, 1 << 30);
    view.key_mul = any_u32(1u << 30, 0x7fffffffu);
    view.key_shift = any_i32(-40, 128);
    view.key_top = any_u32(255u << 16, 65535u << 16);
    for (int scale = 9; scale <= 9 + 15; scale++)
        for (int k = 0; k < 64; k++)
            (void)pixel_key(&view, any_u64(OCTAVE_LO(k), OCTAVE_HI(k)), scale);
    (void)pixel_key(&view, 0, 9);
    (void)linear_inverse(&view, any_u32(256, 1u << 30));
    (void)linear_key(&view, any_u32(256, 1u << 30));
}
