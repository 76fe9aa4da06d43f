/* Skies: an image around the eye.
 *
 * A pixel's direction is x right + y up - f back, in world axes; x and y count from the middle of
 * the viewport. Its yaw and pitch are found at every 16th column, and interpolated between. So a
 * pixel does not depend on how a row is cut into calls. Along a row, yaw is c + atan((x - x0) / m),
 * m the distance of the row's ray from the pole's axis, px. A group of 16 that spans the angle d, t
 * from its foot, is off by tan(t) d^2 / 4, which is sin(t) 16 d / 4 px. Groups that span more than
 * 1/64 turn (low focal lengths, and pixels near a pole) are found pixel by pixel: at most 0.4 px.
 *
 * Angles are in 2^-32 turn. Arc tangent and length are interpolated in tables of 64 steps. The
 * first is off by (1/64)^2 / 8 * 0.65 radians, 2^-18.2 turn, 2^-19 for the table's rounding and
 * 2^-18.6 for the quotient's;
 * the second by 2^-15 of the length, which changes a pitch by at most 2^-18.6 turn. All that is
 * below 2^-16.5 turn.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/fx.h"
#include "core/usual.h"
#include "shade/texture.h"
#include "zs_environment.h"

#define GROUP 16
#define FINE ((uint32_t)1 << 26) /* 1/64 turn */
#define QUARTER ((uint32_t)1 << 30)

/* atan(i / 64), 2^-18 turn. */
static const uint16_t arc[65] = {
    0,     652,   1303,  1954,  2604,  3253,  3900,  4545,  5188,  5829,  6467,  7101,  7733,
    8361,  8985,  9605,  10221, 10832, 11439, 12040, 12637, 13228, 13814, 14394, 14968, 15537,
    16100, 16656, 17206, 17750, 18288, 18819, 19344, 19862, 20374, 20879, 21378, 21870, 22355,
    22834, 23306, 23771, 24230, 24682, 25128, 25568, 26001, 26427, 26848, 27262, 27670, 28072,
    28467, 28857, 29241, 29619, 29991, 30357, 30718, 31073, 31423, 31767, 32106, 32439, 32768,
};
/* sqrt(1 + (i / 64)^2) - 1, 2^-17. */
static const uint16_t longer[65] = {
    0,     16,    64,    144,   256,   399,   575,   782,   1020,  1290,  1590,  1922,  2284,
    2677,  3099,  3552,  4034,  4545,  5085,  5654,  6251,  6876,  7528,  8207,  8913,  9645,
    10403, 11187, 11995, 12828, 13686, 14567, 15471, 16398, 17348, 18320, 19313, 20328, 21363,
    22419, 23494, 24589, 25704, 26837, 27988, 29157, 30344, 31547, 32768, 34005, 35258, 36526,
    37810, 39109, 40423, 41751, 43092, 44448, 45816, 47198, 48593, 49999, 51418, 52849, 54292,
};

struct ray {
    uint32_t yaw;  /* from -z to the right, +x */
    int32_t pitch; /* up: > 0 */
};

/* Return table[r / 2^25], interpolated, * 2^16. 0 <= r <= 2^31 */
static uint32_t between(const uint16_t table[65], uint32_t r)
{
    const uint32_t i = r >> 25, part = r << 7 >> 16;
    return i == 64 ? (uint32_t)table[64] << 16
                   : ((uint32_t)table[i] << 16) + (uint32_t)(table[i + 1] - table[i]) * part;
}

/* The place of (x, y) in its octant. */
struct octant {
    uint32_t most;  /* the larger of |x| and |y| */
    uint32_t ratio; /* the lesser one over it, * 2^31; off by 2^-16 */
};

/* Return the angle of (x, y), counter-clockwise from +x. |x|, |y| < 2^30.5 */
static uint32_t angle_of(int32_t x, int32_t y, struct octant *of)
{
    const uint32_t ax = zs_size32(x), ay = zs_size32(y);
    const uint32_t most = zs_maxu32(zs_maxu32(ax, ay), 1u), least = zs_minu32(ax, ay);
    const int32_t lz = zs_clz32(most);
    const uint32_t r = zs_umulh(least << lz, zs_recip16(most << lz));
    of->most = most;
    of->ratio = r >> 31 ? 1u << 31 : r;
    uint32_t angle = between(arc, of->ratio) >> 2;
    angle = ay > ax ? QUARTER - angle : angle;
    angle = x < 0 ? 2u * QUARTER - angle : angle;
    return y < 0 ? 0u - angle : angle;
}

/* Return a column's or row's distance from the viewport's middle, |.| < 2^29. Far outside of the
 * viewport it stays the same. half: 1/2 px */
static int32_t side_of(const struct zs_sky *sky, int32_t half)
{
    return zs_max32(zs_min32(half, sky->reach), -sky->reach) * sky->step;
}

/* Find the direction of column x of a row. Components are q2_30 * 2^-32 of a length below 2^30.4.
 * For a focal length of at least 1/64 of the viewport's width and height, it is at least 2^20. */
static struct ray look(const struct zs_sky *sky, const int64_t row[3], int32_t x)
{
    const int32_t at = side_of(sky, 2 * x + 1 - sky->width);
    int32_t v[3];
    struct octant of;
    struct ray ray;
    for (int k = 0; k < 3; k++)
        v[k] = (int32_t)((row[k] + zs_mul_ss(sky->rot[k], at)) >> 32);
    ray.yaw = angle_of(-v[2], v[0], &of);
    const uint32_t flat = of.most + (zs_umulh(of.most, between(longer, of.ratio)) >> 1);
    ray.pitch = (int32_t)angle_of((int32_t)flat, v[1], &of);
    return ray;
}

/* Return the row of the image at a pitch, uq0_32; may be outside of it. */
static int64_t down(const struct zs_sky *sky, int32_t pitch)
{
    return ((int64_t)sky->top * 65536 - pitch) * sky->down >> 16; /* |.| < 2^31.6 * 2^26 / 2^16 */
}

static uint32_t held(int64_t v)
{
    return v < 0 ? 0u : v > UINT32_MAX ? UINT32_MAX : (uint32_t)v;
}

static void fetch(const struct zs_sky *sky, uint16_t *out, int32_t n, struct zs_walk walk)
{
    if (!sky->texture->log2_w)
        walk.u = walk.du = 0;
    if (!sky->texture->log2_h)
        walk.v = walk.dv = 0;
    sky->texture->format->fetch(sky->texture, out, n, &walk);
}

/* A group of columns, and the rays of its first one and of the next group's. */
struct group {
    int32_t from;
    int32_t log2; /* of its columns */
    struct ray ray[2];
};

/* Colour columns [x, end) of a group. Return 0 if it is too coarse for that. */
static int group_draw(const struct zs_sky *sky, const struct group *g, uint16_t *out, int32_t x,
                      int32_t end)
{
    const struct ray *const a = &g->ray[0], *const b = &g->ray[1];
    const uint32_t turn = b->yaw - a->yaw, fine = FINE << (4 - g->log2);
    if (turn + fine > 2u * fine || (uint32_t)b->pitch - (uint32_t)a->pitch + fine > 2u * fine)
        return 0;
    const int64_t first = down(sky, a->pitch), last = down(sky, b->pitch);
    const int64_t dv = (last - first) >> g->log2;
    const uint32_t du = (uint32_t)((int32_t)turn >> g->log2), skip = (uint32_t)(x - g->from);
    int64_t at = first + dv * skip;
    struct zs_walk walk = { a->yaw + 2u * QUARTER + du * skip, (uint32_t)at, du, (uint32_t)dv };
    if (!((uint64_t)(first | last) >> 32)) { /* inside the image */
        fetch(sky, out, end - x, walk);
        return 1;
    }
    for (; x < end; x++, at += dv, walk.u += du) {
        walk.v = held(at);
        fetch(sky, out++, 1, walk);
    }
    return 1;
}

/* The same for a group that is too coarse: in groups of 4, or pixel by pixel. */
static ZS_NOINLINE void group_divide(const struct zs_sky *sky, const int64_t row[3], uint16_t *out,
                                     int32_t x, int32_t end)
{
    struct group part = { .log2 = 2 };
    while (x < end) {
        part.from = x & -4;
        part.ray[0] = look(sky, row, part.from);
        part.ray[1] = look(sky, row, part.from + 4);
        const int32_t to = zs_min32(part.from + 4, end);
        if (!group_draw(sky, &part, out, x, to))
            for (int32_t i = x; i < to; i++) {
                const struct ray one = look(sky, row, i);
                const struct zs_walk walk = { one.yaw + 2u * QUARTER, held(down(sky, one.pitch)), 0,
                                              0 };
                fetch(sky, out + i - x, 1, walk);
            }
        out += to - x;
        x = to;
    }
}

static void fill(void *ctx, uint16_t *out, uint16_t px, uint16_t py, uint16_t n)
{
    const struct zs_sky *const sky = ctx;
    int32_t x = px - sky->x;
    const int32_t end = x + n, y = side_of(sky, sky->height - 1 - 2 * (py - sky->y));
    int64_t row[3];
    struct group g = { .log2 = 4 };
    for (int k = 0; k < 3; k++) /* |.| < 2^59 + 2^60 */
        row[k] = zs_mul_ss(sky->rot[3 + k], y) - zs_mul_ss(sky->rot[6 + k], sky->focal);
    g.ray[1] = look(sky, row, x & -GROUP);
    while (x < end) {
        g.from = x & -GROUP;
        const int32_t to = zs_min32(g.from + GROUP, end);
        g.ray[0] = g.ray[1];
        g.ray[1] = look(sky, row, g.from + GROUP);
        if (!group_draw(sky, &g, out, x, to))
            group_divide(sky, row, out, x, to);
        out += to - x;
        x = to;
    }
}

int zs_sky_panorama(struct zs_sky *sky, const struct zs_texture *image, int16_t top, int16_t bottom)
{
    const int32_t span = top - bottom;
    if (!sky || !image || !image->format || !image->texel ||
        (image->format->colors_max && !image->palette))
        return ZS_ERR_NULL;
    if (image->log2_w > ZS_TEXTURE_LOG2_MAX || image->log2_h > ZS_TEXTURE_LOG2_MAX ||
        image->log2_w + image->format->log2_bits < 3)
        return ZS_ERR_TEXTURE;
    if (span < 64 || top > 16384 || bottom < -16384)
        return ZS_ERR_RANGE;
    sky->texture = image;
    sky->top = top;
    sky->down = (int32_t)(0xffffffffu / (uint32_t)span); /* <= 2^26 */
    sky->background.fill = fill;
    sky->background.ctx = sky;
    return ZS_OK;
}

/* Return the channel of entry k of n, which goes from a to b. */
static uint32_t mixed(uint32_t a, uint32_t b, uint32_t k, uint32_t n)
{
    return (a * (n - k) + b * k + n / 2u) / n;
}

void zs_sky_gradient(struct zs_sky_gradient *sky, const struct zs_rgb color[4])
{
    const uint32_t half = ZS_SKY_COLORS / 2u, last = half - 1u;
    for (uint32_t k = 0; k < ZS_SKY_COLORS; k++) {
        const struct zs_rgb *const a = &color[k / half * 2u], *const b = a + 1;
        const uint32_t i = k % half;
        sky->color[k] = zs_rgb565((uint8_t)mixed(a->r, b->r, i, last),
                                  (uint8_t)mixed(a->g, b->g, i, last),
                                  (uint8_t)mixed(a->b, b->b, i, last));
    }
    sky->image = (struct zs_texture){ .format = &zs_texel_565,
                                      .texel = sky->color,
                                      .log2_h = ZS_SKY_COLORS_LOG2 };
    (void)zs_sky_panorama(&sky->sky, &sky->image, 16384, -16384);
}

void zs_sky_look(struct zs_sky *sky, const struct zs_camera *camera, const struct zs_rect *viewport,
                 const struct zs_mirror *mirror)
{
    const zs_q2_30 *const rot = zs_usual_rotation(camera->rot);
    for (int k = 0; k < 9; k++)
        sky->rot[k] = rot[k];
    for (int k = 0; k < 9 && mirror; k += 3)
        mirror->ops->direction(mirror, sky->rot + k);
    sky->x = (int16_t)viewport->x;
    sky->y = (int16_t)viewport->y;
    sky->width = (int16_t)viewport->w;
    sky->height = (int16_t)viewport->h;
    /* In 2^-n of 1/2 px: focal length and 2 * reach are below 2^30, one of them is at least 2^29 */
    const uint64_t most = (uint64_t)1 << 55; /* of a camera that is not refused */
    const uint64_t focal = (camera->focal < most ? camera->focal : most) << 1; /* uq32_32, 1/2 px */
    sky->reach = 4 * zs_max32(sky->width, sky->height) + 2 * GROUP; /* < 2^15 */
    const uint64_t side = (uint64_t)(uint32_t)sky->reach << 33;
    const int32_t lz = zs_clz64(focal > side ? focal : side); /* 7 .. 25 */
    sky->focal = zs_max32((int32_t)(focal << lz >> 34), 1);
    sky->step = (int32_t)(1u << (lz - 2));
    if (camera->projection == ZS_ORTHOGRAPHIC) { /* one direction */
        sky->focal = 1 << 29;
        sky->step = 0;
    }
}
