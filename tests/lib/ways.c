/* See ways.h.
 *
 * SPDX-License-Identifier: MIT
 */
#include "ways.h"

#include "picture.h"

int ways_alike(uint64_t seed, const struct ways *of)
{
    static struct world w;
    struct prng p = { seed };
    world_make(&w, &p, 0);
    if (of->more)
        of->more(&w, &p);
    struct zs_config c = { .width = (uint16_t)prng_range(&p, 1, of->width),
                           .height = (uint16_t)prng_range(&p, 1, of->height),
                           .max_tris = 4000, .max_verts = 8000, .varyings = ZS_VARYINGS_MAX,
                           .depth = of->ortho && w.camera.projection ? of->ortho : of->depth };
    c.method = of->method[of->method[1] && prng_pick(&p, 2) ? 1 : 0];
    c.strip_h = c.height;
    struct picture whole = picture_draw(&c, &w.scene, &w.camera);
    picture_any_way(&p, &c, 2, 6);
    struct picture other = picture_draw(&c, &w.scene, &w.camera);
    world_free(&w);
    if (of->again)
        *of->again += other.stats.passes > other.stats.strips;
    if (of->splits)
        *of->splits += whole.stats.splits;
    return picture_alike(&whole, &other, "another way");
}
