/* xform.c: rows of the matrix, projection, outcodes.
 *
 * SPDX-License-Identifier: MIT
 */
#include "prove.h"

#include "../../lib/internals.h"

#include "core/xform.c"

static struct zs_renderer renderer;

static uint32_t any_depth(const struct zs_view *view, int32_t z, uint32_t rcp, int32_t lz)
{
    (void)view;
    (void)z;
    (void)rcp;
    (void)lz;
    return any_u32(0, UINT32_MAX);
}

/* PROVE matrix_rows: every element |m| <= 2^30 + 1, in halves by sign and size; every shift 0 .. 29; every t below 2^60
 * with t / 2^shift below 2^30 */
void matrix_rows(void)
{
    for (int shift = 0; shift <= SHIFT_MAX; shift++)
        for (int half = 0; half < 4; half++) {
            int32_t row[ZS_ROW_WORDS];
            const int32_t lo = half & 1 ? 1 << 29 : 0, hi = half & 1 ? (1 << 30) + 1 : 1 << 29;
            const int32_t from = half & 2 ? -hi : lo, to = half & 2 ? -lo : hi;
            for (int j = 0; j < 3; j++)
                row[j] = any_i32(from, to);
            const int64_t t = ((int64_t)1 << (30 + shift)) - 1;
            row_set(row, any_i64(-t, t), shift);
            for (int j = 0; j < 3; j++)
                ASSERT(row[ZS_ROW_HIGH + j] <= (1 << (30 - row[ZS_ROW_S])) + 1);
        }
}

/* PROVE fine_positions: positions in 1/256 steps, every shift 0 .. 29, elements as matrix_rows leaves them */
void fine_positions(void)
{
    for (int shift = 0; shift <= SHIFT_MAX; shift++) {
        const int32_t s = shift < SPLIT_MAX ? shift : SPLIT_MAX, high = (1 << (30 - s)) + 1;
        const int16_t pos[3] = { (int16_t)any_i32(-32768, 32767), (int16_t)any_i32(-32768, 32767),
                                 (int16_t)any_i32(-32768, 32767) };
        const uint8_t low[3] = { (uint8_t)any_u32(0, 255), (uint8_t)any_u32(0, 255), (uint8_t)any_u32(0, 255) };
        int32_t row[ZS_ROW_WORDS];
        for (int j = 0; j < 3; j++) {
            row[ZS_ROW_HIGH + j] = any_i32(-high, high);
            row[ZS_ROW_LOW + j] = any_i32(-(1 << 14), 1 << 14);
        }
        row[ZS_ROW_T_LOW] = any_i32(-(1 << 28), (1 << 28) + (1 << 15));
        row[ZS_ROW_T_HIGH] = any_i32(-(1 << 30), 1 << 30);
        row[ZS_ROW_S] = s;
        row[ZS_ROW_S2] = shift - s;
        (void)zs_xform_fine(row, pos, low);
    }
}

static void any_view(int perspective, int32_t snap)
{
    struct zs_view *view = &renderer.view;
    const int32_t scale_bits = perspective ? any_i32(8, 31) : any_i32(0, 40);
    view->perspective = (uint8_t)perspective;
    view->z_near = perspective ? any_i32(256, 1 << 30) : any_i32(-(1 << 30), 1 << 30);
    view->z_far = any_i32(-(1 << 30), 1 << 30);
    view->scale_bits = scale_bits;
    view->snap = snap;
    view->cx = any_i32(ZS_SUBPX_HALF, ZS_SIZE_MAX * ZS_SUBPX_HALF);
    view->cy = any_i32(ZS_SUBPX_HALF, ZS_SIZE_MAX * ZS_SUBPX_HALF);
    view->guard = perspective ? (uint64_t)ZS_GUARD_SUBPX
                              : any_u64((uint64_t)ZS_GUARD_SUBPX, (uint64_t)ZS_GUARD_SUBPX << 40);
}

static void projected(int32_t z_lo, int32_t z_hi)
{
    static const struct zs_depth depth = { .vertex = any_depth };
    const struct zs_point p = { { any_i32(INT32_MIN, INT32_MAX), any_i32(INT32_MIN, INT32_MAX), any_i32(z_lo, z_hi) } };
    struct zs_vertex out;
    renderer.view.depth = &depth;
    if (zs_xform_project(&renderer, &p, &out)) {
        const int32_t most = ZS_GUARD_SUBPX + 1 + ZS_SIZE_MAX * ZS_SUBPX_HALF;
        ASSERT(out.x <= most && out.x >= -most && out.y <= most && out.y >= -most);
    }
    (void)zs_xform_outcode(&renderer.view, &p);
}

/* PROVE project_perspective -eva-split-return-function=zs_xform_project_at:0:1,zs_xform_project:0:1: x', y' of 32 bits,
 * any; z of 256 .. 2^30 by octave and all below; every scale_bits 8 .. 31, sub-pixel bits 4 and 8, frames of every
 * size */
void project_perspective(void)
{
    for (int32_t snap = 0; snap <= 4; snap += 4) {
        any_view(1, snap);
        projected(INT32_MIN, 255);
        for (int k = 8; k < 30; k++)
            projected((int32_t)OCTAVE_LO(k), (int32_t)OCTAVE_HI(k));
        projected(1 << 30, 1 << 30);
    }
}

/* PROVE project_orthographic -eva-split-return-function=zs_xform_project_at:0:1,zs_xform_project:0:1: x', y', z of 32
 * bits, any; every scale_bits 0 .. 40, sub-pixel bits 4 and 8 */
void project_orthographic(void)
{
    for (int32_t snap = 0; snap <= 4; snap += 4) {
        any_view(0, snap);
        projected(-(1 << 30) - 1, (1 << 30) + 1);
    }
}
