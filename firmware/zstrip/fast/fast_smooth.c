/* Smooth shading: depth test and colours in one loop, for affine triangles whose keys do not
 * saturate; the others are walked by fast/less.c. What it is worth: zs_fast.h.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/fast.h"
#include "core/fx.h"
#include "fast/lanes.h"
#include "fast/less.h"
#include "fast/set_up.h"
#include "shade/persp.h"
#include "zs_fast.h"

/* Draw an affine triangle whose keys do not saturate. */
static ZS_NOINLINE void affine_rows(struct zs_job *job)
{
    const int32_t width = job->width;
    const struct zs_plane *const c = job->c;
    uint32_t by_key = job->key.gx, by_red = c[0].gx, by_green = c[1].gx, by_blue = c[2].gx;
    uint32_t tested = 0;
    int32_t written = 0, y = job->row, at = (y - job->y0) * job->pitch;
    zs_plane_origin(&job->geom, &job->key);
    for (;;) {
        for (const struct zs_cut *cut = job->cut; y < job->cut_end; cut++, y++, at += job->pitch) {
            const int32_t i0 = zs_max32(cut->x0, 0), n = zs_min32(cut->x1, width) - i0;
            if (n <= 0)
                continue;
            uint32_t sum = zs_plane_at(&job->key, i0, y), red = zs_plane_at(&c[0], i0, y),
                     green = zs_plane_at(&c[1], i0, y), blue = zs_plane_at(&c[2], i0, y);
            uint16_t *depth = job->depth + at + i0, *color = job->color + at + i0;
            const uint16_t *end = depth + n;
            tested += (uint32_t)n;
            do {
                ZS_HIGH_REGISTER(by_key);
                ZS_HIGH_REGISTER(by_red);
                ZS_HIGH_REGISTER(by_green);
                ZS_HIGH_REGISTER(by_blue);
                ZS_HIGH_REGISTER(end);
                if (sum >> 16 < *depth) {
                    *depth = (uint16_t)zs_high(sum);
                    *color = zs_smooth_pack(red, green, blue);
                    if (ZS_STATS)
                        written++;
                }
                depth++;
                color++;
                sum += by_key;
                red += by_red;
                green += by_green;
                blue += by_blue;
            } while (depth != end);
        }
        if (y >= job->row_end)
            break;
        zs_edges_cut(job, y);
    }
    job->r->stats.pixels_tested += tested;
    zs_rows_written(job, written);
}

static int smooth_rows(struct zs_job *job)
{
    if (job->sub_log2 != ZS_AFFINE || job->saturates)
        return zs_fast_less_rows(job);
    if (ZS_LANES_USED)
        zs_lanes_smooth_rows(job);
    else
        affine_rows(job);
    return 1;
}

const struct zs_fast zs_fast_smooth = {
    ZS_SET_UP_SMOOTH .shader = &zs_shade_smooth,
    .draw = ZS_LANES_USED && ZS_SET_UP ? zs_lanes_smooth_draw : 0, .rows = smooth_rows,
    .span = ZS_LANES_USED ? zs_lanes_smooth_span : zs_fast_less
};
