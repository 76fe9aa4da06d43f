/* zs_texture_check for textures with alpha as well.
 *
 * SPDX-License-Identifier: MIT
 */
#include "support/check.h"
#include "zs_filter.h"

enum zs_flaw zs_alpha_texture_check(const struct zs_texture *x, uint32_t *index)
{
    const struct zs_texel *const format = x && x->texel ? x->format : 0;
    if (format == &zs_texel_4444)
        return zs_texture_flaw(x, 4, 0, index);
    if (format == &zs_texel_pal8a || format == &zs_texel_pal4a)
        return zs_texture_flaw(x, format == &zs_texel_pal8a ? 3 : 2, 1, index);
    return zs_texture_check(x, index);
}
