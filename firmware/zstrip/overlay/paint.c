/* Runs and boxes of one colour.
 *
 * SPDX-License-Identifier: MIT
 */
#include "overlay/items.h"

void zs_paint_run(uint16_t *out, int32_t n, const struct zs_paint *paint)
{
    if (paint->rest == 0) {
        zs_fill_run(out, paint->wire, (uint32_t)n);
        return;
    }
    const struct zs_paint p = *paint;
    for (uint16_t *const end = out + n; out != end; out++)
        *out = zs_paint_over(&p, *out);
}

void zs_paint_box(const struct zs_target *t, struct zs_box box, const struct zs_paint *paint)
{
    if (!zs_box_clip(&box, t) || paint->rest == 64u)
        return;
    for (int32_t y = box.y0; y < box.y1; y++)
        zs_paint_run(zs_pixel(t, box.x0, y), box.x1 - box.x0, paint);
}
