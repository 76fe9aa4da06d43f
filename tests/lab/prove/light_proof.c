/* light.c and the products of rotation.c.
 *
 * SPDX-License-Identifier: MIT
 */
#include "prove.h"

#include "../../lib/internals.h"

#include "shade/light.c"

static struct zs_shading shading;
static struct zs_light light;

#define CELL (1 << 28)
#define REACH 7 /* cells: 1.75 * 2^30 is more than sqrt 3 * 2^30 */

static int64_t least(int cell) /* of a cell's magnitudes, in cells */
{
    return cell < 0 ? -cell - 1 : cell;
}

static void normal_under(int x, int y, int z)
{
    const zs_q1_15 n[3] = { (zs_q1_15)any_i32(-32768, 32767), (zs_q1_15)any_i32(-32768, 32767),
                            (zs_q1_15)any_i32(-32768, 32767) };
    shading.dir[0] = any_i32(x * CELL, x * CELL + CELL);
    shading.dir[1] = any_i32(y * CELL, y * CELL + CELL);
    shading.dir[2] = any_i32(z * CELL, z * CELL + CELL);
    (void)zs_light_intensity(&shading, n);
}

/* PROVE intensity -eva-min-loop-unroll=3: every light no longer than sqrt 3, in cells of 1/4 (those that touch its
 * ball); every normal of 16 bits; every ambient and diffuse */
void intensity(void)
{
    shading.light = &light;
    light.ambient = (uint16_t)any_u32(0, 65535);
    light.diffuse = (uint16_t)any_u32(0, 65535);
    for (int x = -REACH; x < REACH; x++)
        for (int y = -REACH; y < REACH; y++)
            for (int z = -REACH; z < REACH; z++)
                if (least(x) * least(x) + least(y) * least(y) + least(z) * least(z) <= 3 * 16)
                    normal_under(x, y, z);
}

/* PROVE channel: every channel of 8 bits, every intensity below 3 */
void channel(void)
{
    ASSERT(zs_light_channel((uint8_t)any_u32(0, 255), any_u32(0, 3 << 16)) <= 65535u);
}
