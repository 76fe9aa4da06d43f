/* Smooth shading on an RP2040: rows of zs_fast_smooth with colours and keys in the interpolators,
 * which step all four of them. A pixel takes 16 cycles in place of 24, a row 64 in place of 115:
 * 0.35 of 8.4 million cycles in scene teapot. 460 bytes.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/fast.h"
#include "core/fx.h"
#include "fast/lanes.h"

/* Lanes: red and green; blue and, above it, the key. */
#if ZS_RP2040
#define PIXEL                                                                                      \
    ZS_LANES_POP_1(r7)                                                                             \
    ZS_LANES_POP_0(r3)                                                                             \
    "orrs r3, r7\n\tlsrs r7, #16\n\t"                                                              \
    "ldrh r2, [r4, r5]\n\tcmp r7, r2\n\tbcs 4f\n\t"                                                \
    "rev16 r3, r3\n\tstrh r7, [r4, r5]\n\tstrh r3, [r6, r5]\n"
#else
#define PIXEL pixel

static int pixel(struct zs_lanes *lanes, const struct zs_lanes_walk *w, uint16_t *depth,
                 uint16_t *color)
{
    (void)w;
    const uint32_t key = zs_lanes_pop(&lanes[1]), red_green = zs_lanes_pop(&lanes[0]);
    if (key >> 16 >= *depth)
        return 0;
    *depth = (uint16_t)(key >> 16);
    *color = zs_wire16((uint16_t)(red_green | key));
    return 1;
}
#endif
ZS_LANES_ROWS(rows, PIXEL, "")

void zs_lanes_smooth_rows(struct zs_job *job)
{
    const struct zs_plane *const c = job->c, *const key = &job->key;
    const struct zs_plane *const planes[4] = { &c[0], &c[1], &c[2], key };
    const int32_t above = job->row - 1;
    ZS_LANES(lanes);
    zs_plane_origin(&job->geom, &job->key);
    zs_lanes_set(&lanes[0], 0, 16, 11, 15, &c[0], above);
    zs_lanes_set(&lanes[0], 1, 21, 5, 10, &c[1], above);
    zs_lanes_set(&lanes[1], 0, 27, 0, 4, &c[2], above);
    zs_lanes_set(&lanes[1], 1, 0, 16, 31, key, above);
    lanes[0].base[2] = lanes[1].base[2] = 0;
    zs_lanes_draw(job, lanes, planes, 0, rows);
}
