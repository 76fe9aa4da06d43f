/* Lines of one pixel's width, exact and clipped.
 *
 * Along the axis on which the line is longer, L >= 0 steps, its pixel at step i is round(M i / L)
 * away on the other axis, M <= L, halves away from the end at i = 0. That end is the left or upper
 * one, so that both directions give the same pixels. Clipping chooses a range of i and computes the
 * remainder there: pixels do not depend on the strip.
 *
 * SPDX-License-Identifier: MIT
 */
#include "overlay/items.h"

struct line {
    int32_t a, b;         /* its first pixel along the longer and the shorter axis */
    uint32_t along, away; /* L, M: <= 2^15 */
    int32_t side;         /* 1 or -1: to which side it goes on the shorter axis */
};

/* Return the first step at which the line is k pixels away, 1 <= k <= M: the least i with
 * 2 M i + L >= 2 L k. */
static uint32_t step_at(const struct line *l, int32_t k)
{
    const uint32_t least = l->along * (2u * (uint32_t)k - 1u); /* < 2^31 */
    return (least + 2u * l->away - 1u) / (2u * l->away);
}

/* Find the steps [*from, *to) of which a is in [a0, a1) and b in [b0, b1). Return 0 if there is
 * none. */
static int steps(const struct line *l, int32_t a0, int32_t a1, int32_t b0, int32_t b1,
                 uint32_t *from, uint32_t *to)
{
    const int32_t k0 = l->side > 0 ? b0 - l->b : l->b - b1 + 1;
    const int32_t k1 = l->side > 0 ? b1 - l->b : l->b - b0 + 1; /* away by [k0, k1) */
    const int32_t end = zs_min32((int32_t)l->along + 1, a1 - l->a);
    if (k1 <= 0 || k0 > (int32_t)l->away || end <= 0)
        return 0;
    *from = k0 > 0 ? step_at(l, k0) : 0u;
    *to = k1 <= (int32_t)l->away ? step_at(l, k1) : l->along + 1u;
    *from = zs_maxu32(*from, (uint32_t)zs_max32(a0 - l->a, 0));
    *to = zs_minu32(*to, (uint32_t)end);
    return *from < *to;
}

void zs_paint_line(const struct zs_target *t, int32_t x, int32_t y, int32_t x_end, int32_t y_end,
                   const struct zs_paint *paint)
{
    const int32_t dx = x_end - x, dy = y_end - y;
    const int flat = zs_abs32(dx) >= zs_abs32(dy);
    const int back = flat ? dx < 0 : dy < 0;
    const int32_t x0 = back ? x_end : x, y0 = back ? y_end : y;
    const struct line l = { flat ? x0 : y0, flat ? y0 : x0, zs_size32(flat ? dx : dy),
                            zs_size32(flat ? dy : dx), ((flat ? dy : dx) < 0) == back ? 1 : -1 };
    uint32_t i, end;
    if (paint->rest == 64u || !(flat ? steps(&l, t->x0, t->x1, t->y0, t->y1, &i, &end)
                                     : steps(&l, t->y0, t->y1, t->x0, t->x1, &i, &end)))
        return;
    const uint32_t most = l.along ? 2u * l.along : 1u, add = 2u * l.away;
    const uint32_t sum = add * i + l.along; /* <= 2^31 + 2^15 */
    uint32_t rest = sum % most;
    const int32_t a = l.a + (int32_t)i, b = l.b + l.side * (int32_t)(sum / most);
    const int32_t right = flat ? 1 : (int32_t)t->pitch, down = flat ? (int32_t)t->pitch : 1;
    const int32_t aside = l.side * down;
    uint16_t *at = flat ? zs_pixel(t, a, b) : zs_pixel(t, b, a);
    for (;;) {
        *at = zs_paint_over(paint, *at);
        if (++i == end)
            return;
        at += right;
        rest += add;
        if (rest >= most) {
            rest -= most;
            at += aside;
        }
    }
}
