/* What of zsim needs libraries that the engine does without. Nothing is drawn otherwise than zsim draws it: what would
 * be is refused.
 *
 * SPDX-License-Identifier: MIT
 */
#include "image.h"
#include "sim.h"

int sim_image_load(struct sim_image *out, const char *path, int as_it_is)
{
    (void)as_it_is;
    *out = (struct sim_image){ 0 };
    return sim_refuse(path, 0, "pictures from files are for zsim on a desktop");
}
