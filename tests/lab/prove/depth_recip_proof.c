/* depth/recip.c.
 *
 * SPDX-License-Identifier: MIT
 */
#include "prove.h"

#include "../../lib/internals.h"

#include "depth/recip.c"

/* PROVE recip_keys: every near and far of the camera, 8 .. 16 bits, every z of a frame by octave */
void recip_keys(void)
{
    for (uint32_t bits = 8; bits <= 16; bits++) {
        struct zs_view view;
        struct zs_camera camera;
        view.perspective = 1;
        view.z_near = any_i32(256, 1 << 30);
        camera.z_near = any_i64(1, (int64_t)1 << 45);
        camera.z_far = any_i64(2, (int64_t)1 << 60);
        if (zs_recip_setup(&view, &camera, bits))
            continue;
        for (int k = 8; k <= 30; k++)
            ASSERT(zs_recip_vertex(&view, any_i32((int32_t)OCTAVE_LO(k), (int32_t)OCTAVE_HI(k)),
                                any_u32(1u << 31, UINT32_MAX), 31 - k) <= view.key_top);
        (void)zs_recip_inverse(&view, any_u32(0, UINT32_MAX));
    }
}
