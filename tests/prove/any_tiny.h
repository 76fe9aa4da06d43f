/* A triangle with its first corner at (x, y) and the others up to ZS_TINY away, any keys.
 *
 * SPDX-License-Identifier: MIT
 */
static void any_tiny(struct zs_vertex pool[3], struct zs_tri *tri, int32_t x, int32_t y)
{
    pool[0].x = x;
    pool[0].y = y;
    for (int k = 0; k < 3; k++)
        pool[k].d = any_u32(0, UINT32_MAX);
    for (int k = 1; k < 3; k++) {
        pool[k].x = x + any_i32(-ZS_TINY, ZS_TINY - 1);
        pool[k].y = y + any_i32(0, ZS_TINY - 1);
        tri->v[k] = (uint16_t)k;
    }
}
