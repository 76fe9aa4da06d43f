/* Lists of accelerators for tests.
 *
 * SPDX-License-Identifier: MIT
 */
#include "fast_lists.h"

#include <assert.h>
#include <stddef.h>

const struct zs_fast *const fast_all[] = { ZS_FAST_ALL, ZS_FAST_END };

static const struct {
    const struct zs_fast *fast;
    const char *name;
} known[] = {
    { &zs_fast_batch, "batch" }, { &zs_fast_touch, "touch" }, { &zs_fast_tiles, "tiles" },
    { &zs_fast_clusters, "clusters" }, { &zs_fast_edges, "edges" }, { &zs_fast_raw, "raw" }, { &zs_fast_flat, "flat" },
    { &zs_fast_smooth, "smooth" }, { &zs_fast_texture, "texture" }, { &zs_fast_texture_flat, "texture_flat" },
    { &zs_fast_texture_smooth, "texture_smooth" }, { &zs_fast_565, "565" }, { &zs_fast_pal8, "pal8" },
    { &zs_fast_pal4, "pal4" },
};
#define KNOWN (sizeof known / sizeof known[0])

static_assert(KNOWN + 1 == sizeof fast_all / sizeof fast_all[0], "all that ZS_FAST_ALL names");
static_assert(FAST_ALL == (1 << KNOWN) - 1, "a bit each");

unsigned fast_count(void)
{
    return (unsigned)KNOWN;
}

const char *fast_name(unsigned k)
{
    return known[k].name;
}

const struct zs_fast *const *fast_of(unsigned bits)
{
    static const struct zs_fast *list[8][KNOWN + 1];
    static unsigned next;
    const struct zs_fast **const out = list[next++ % 8u], **at = out;
    for (unsigned k = 0; k < KNOWN; k++)
        if (bits >> k & 1u)
            *at++ = known[k].fast;
    *at = NULL;
    return out;
}

const struct zs_fast *const *fast_without(unsigned k)
{
    return fast_of(~(1u << k));
}

const struct zs_fast *const *fast_any(struct prng *p)
{
    return fast_of(prng_pick(p, FAST_ALL + 1));
}
