/* How texels are stored: read functions for the loops of shaders and accelerators. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_SHADE_TEXELS_H
#define ZS_SHADE_TEXELS_H

#include "shade/texture.h"

/* Return the RGB565 value of a texel by its index, row * width + column. */
typedef uint16_t zs_read_fn(const void *texel, const uint16_t *palette, uintptr_t at);

ZS_ALWAYS_INLINE uint16_t zs_read_565(const void *texel, const uint16_t *palette, uintptr_t at)
{
    (void)palette;
    return ((const uint16_t *)texel)[at];
}

ZS_ALWAYS_INLINE uint16_t zs_read_pal8(const void *texel, const uint16_t *palette, uintptr_t at)
{
    return palette[((const uint8_t *)texel)[at]];
}

ZS_ALWAYS_INLINE uint16_t zs_read_pal4(const void *texel, const uint16_t *palette, uintptr_t at)
{
    const uint32_t two = ((const uint8_t *)texel)[at >> 1];
    return palette[two >> ((at & 1u) << 2) & 15u];
}

#endif
