/* The state of the small proofs, and any small triangle: a corner at (x, y), the others up to ZS_TINY away, any keys.
 *
 * SPDX-License-Identifier: MIT
 */
#define COORD_LO (-ZS_GUARD_SUBPX - 1)
#define COORD_HI (ZS_GUARD_SUBPX + 1 + ZS_SIZE_MAX * ZS_SUBPX_HALF)

static struct zs_renderer renderer;
static struct zs_job job;
static struct zs_vertex pool[3];
static struct zs_tri tri;

static void any_tiny(int32_t x, int32_t y)
{
    pool[0].x = x;
    pool[0].y = y;
    for (int k = 0; k < 3; k++)
        pool[k].d = any_u32(0, UINT32_MAX);
    for (int k = 1; k < 3; k++) {
        pool[k].x = x + any_i32(-ZS_TINY, ZS_TINY - 1);
        pool[k].y = y + any_i32(0, ZS_TINY - 1);
        tri.v[k] = (uint16_t)k;
    }
}
