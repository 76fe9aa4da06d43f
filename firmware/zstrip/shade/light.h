/* Light. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_SHADE_LIGHT_H
#define ZS_SHADE_LIGHT_H

#include "core/fx.h"
#include "zstrip.h"

/* Intensity of a unit normal in mesh space, uq16_16, below 3. */
uint32_t zs_light_intensity(const struct zs_renderer *r, const zs_q1_15 n[3]);
/* The unit normal of a face in mesh space: the mesh's, or the product of two edges; 0 0 0 without area. */
void zs_light_face_normal(zs_q1_15 out[3], const struct zs_mesh *mesh, uint32_t t);
/* A channel under an intensity, saturated: uq0_16 where 65535 is full. c * 257 * intensity / 2^16, nearest. */
static inline uint32_t zs_light_channel(uint8_t c, uint32_t intensity)
{
    const uint32_t part = c * intensity;                          /* < 2^25.6 */
    const uint32_t lit = (part + ((part + 0x8000u) >> 8)) >> 8;   /* 256 part and part, < 2^18 */
    return lit > 65535u ? 65535u : lit;
}

#endif
