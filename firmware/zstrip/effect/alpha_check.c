/* zs_texture_check for textures with alpha as well: by the format that is stored in the same way.
 *
 * SPDX-License-Identifier: MIT
 */
#include "zs_filter.h"

enum zs_flaw zs_alpha_texture_check(const struct zs_texture *x, uint32_t *index)
{
    if (!x)
        return zs_texture_check(x, index);
    struct zs_texture as = *x;
    if (x->format == &zs_texel_4444)
        as.format = &zs_texel_565;
    if (x->format == &zs_texel_pal8a)
        as.format = &zs_texel_pal8;
    if (x->format == &zs_texel_pal4a)
        as.format = &zs_texel_pal4;
    return zs_texture_check(&as, index);
}
