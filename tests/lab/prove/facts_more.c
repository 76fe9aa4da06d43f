/* The rest of facts.c: turns, the sides and boxes of tiles.c, cones. What needs another file's static functions stands
 * in a file of its own.
 *
 * SPDX-License-Identifier: MIT
 */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "support/pose.c"
#undef EIGHTH
#undef QUARTER

#include "fast/tiles.c"
#undef TILE

#include "fast/clusters.c"

#include "../../../sim/reference/prng.h"
#include "facts.h"

static struct prng prng = { 7 };

static int32_t in(int32_t lo, int32_t hi)
{
    return prng_range(&prng, lo, hi);
}

/* ---- pose.c ------------------------------------------------------------------------------------------ */

/* Every angle: sines to 2^-28 and 2^-53. */
static void sines_all(void)
{
    int good = 1;
    for (uint32_t a = 0; a < 65536u; a++) {
        const long double x = a * 6.283185307179586476925286766559L / 65536;
        q4_60 s, c;
        fine_sin_cos(&s, &c, (zs_turn)a);
        good &= fabsl(ldexpl(s, -60) - sinl(x)) < 0x1p-53L && fabsl(ldexpl(c, -60) - cosl(x)) < 0x1p-53L;
        good &= fabsl(ldexpl(zs_sin((zs_turn)a), -30) - sinl(x)) < 0x1p-28L;
        good &= fabsl(ldexpl(zs_cos((zs_turn)a), -30) - cosl(x)) < 0x1p-28L;
    }
    tell("sines", 65536, good, "angles, every one: zs_sin and zs_cos to 2^-28, those of zs_pose_rotate to 2^-53");
}

/* A matrix orthonormal to 2^-20 or a little less: the rotation, and what it lacks. */
static void nearly_rotation(zs_q2_30 m[9])
{
    struct zs_pose pose;
    zs_pose_identity(&pose);
    zs_pose_turn(&pose, (zs_turn)in(0, 65535), (zs_turn)in(0, 65535), (zs_turn)in(0, 65535));
    const int32_t off = in(0, 3) ? 360 : 500; /* the tolerance is 2^10 of 2^30 for a product of rows */
    for (int e = 0; e < 9; e++)
        m[e] = pose.rot[e] + in(-off, off);
}

/* Axes and poses: no overflow in the correction, unit vectors to 2^-54, a turned rotation to 2^-27. */
static void turns_drawn(uint64_t count)
{
    int good = 1;
    uint64_t n = 0;
    for (uint64_t i = 0; i < count; i++) {
        const int bits = in(0, 31);
        int32_t axis[3] = { (int32_t)prng_next(&prng) >> bits, (int32_t)prng_next(&prng) >> in(bits, 31),
                            (int32_t)prng_next(&prng) >> in(bits, 31) };
        if (in(0, 50) == 0)
            axis[in(0, 2)] = INT32_MIN;
        q4_60 u[3];
        struct zs_pose pose;
        zs_pose_identity(&pose);
        nearly_rotation(pose.rot);
        if (fine_unit(u, axis))
            continue;
        const long double x = axis[0], y = axis[1], z = axis[2], length = sqrtl(x * x + y * y + z * z);
        for (int k = 0; k < 3; k++)
            good &= fabsl(ldexpl(u[k], -60) - axis[k] / length) < 0x1p-53L;
        n += (uint64_t)zs_rotation_ok(pose.rot);
        good &= zs_pose_rotate(&pose, axis, (zs_turn)prng_next(&prng)) == ZS_OK;
        for (int r = 0; r < 3; r++)
            for (int c = 0; c <= r; c++) {
                long double dot = r == c ? -1 : 0;
                for (int k = 0; k < 3; k++)
                    dot += ldexpl(pose.rot[3 * r + k], -30) * ldexpl(pose.rot[3 * c + k], -30);
                good &= fabsl(dot) < 0x1p-26L;
            }
    }
    tell("turns", count, good && n > count / 3 && n < count,
         "poses turned: axes to 2^-53, rotations to 2^-27, no overflow");
}

/* ---- tiles.c ----------------------------------------------------------------------------------------- */

/* Sides of covers never beyond the edge, and inwards of it by little: against 64 bits, in every row of the edge. */
static void sides_drawn(uint64_t count)
{
    int good = 1;
    uint64_t n = 0;
    for (uint64_t i = 0; i < count; i++) {
        const int32_t reach = 1 << in(8, 20), tall = 1 << in(9, 21);
        const struct zs_vertex a = { in(-reach, reach), in(-reach, reach), 0 };
        const struct zs_vertex b = { in(-reach, reach), a.y + in(256, tall), 0 };
        struct zs_cover c;
        memset(&c, 0, sizeof c);
        c.v[0] = a;
        slope(&c, LONG, &a, &b);
        const int32_t first = zs_first_sample(a.y), last = zs_first_sample(b.y);
        for (int k = 0; k < 8 && first < last; k++, n++) {
            const int32_t row = k == 0 ? first : k == 1 ? last - 1 : in(first, last - 1);
            const int64_t dy = b.y - a.y, dx = (int64_t)b.x - a.x,
                          right = (int64_t)(a.x - 128) * dy + ((int64_t)row * 256 + 128 - a.y) * dx;
            const int64_t column = right / (256 * dy) + (right % (256 * dy) > 0);
            const int32_t off = row * 256 + 128 - a.y, most = 2 + (off >> c.shift[LONG]) * 2 / 256 + 1;
            good &= side(&c, LONG, row, 0) >= column && side(&c, LONG, row, 0) <= column + most;
            good &= side(&c, LONG, row, 1) <= column && side(&c, LONG, row, 1) >= column - most;
        }
    }
    tell("sides", n, good, "rows of edges drawn: columns of covers as exact ones or further in, by the slope's error");
}

/* Boxes: every box of tiles and strips in frames of up to 9 tiles and 9 strips, and drawn ones in larger: hidden just
 * where each of its tiles' bounds is nearer. Nothing beyond the bounds is read (ASan). */
static int box_right(struct zs_renderer *r, const uint16_t *bound, int32_t tiles, int32_t x0, int32_t x1, int32_t y0,
                     int32_t y1, uint32_t key)
{
    const int32_t tile = 1 << ZS_TILE_LOG2, h = r->config.strip_h;
    const struct zs_box box = { x0 * tile + in(0, tile - 1), x1 * tile + 1 + in(0, tile - 1), y0 * h + in(0, h - 1),
                                y1 * h + 1 + in(0, h - 1) };
    if (box.x0 >= zs_min32(box.x1, r->config.width) || box.y0 >= zs_min32(box.y1, r->config.height))
        return 1;
    const int hides = zs_hidden_box(r, &box, (key << 16) + 0x2000u);
    int each = 1;
    for (int32_t y = y0; y <= y1 && y < r->n_strips; y++)
        for (int32_t x = x0; x <= x1 && x < tiles; x++)
            each &= bound[y * tiles + x] < key;
    return hides == each;
}

static void boxes_all(uint64_t count)
{
    static struct zs_renderer r;
    static const struct zs_depth depth = { 0 };
    int good = 1;
    uint64_t n = 0;
    for (int32_t size = 0; size < 81 + (int32_t)(count / 1000); size++) {
        const int32_t tiles = size < 81 ? size % 9 + 1 : in(1, 64), strips = size < 81 ? size / 9 + 1 : in(1, 64);
        const int32_t h = in(1, 16);
        memset(&r, 0, sizeof r);
        r.config.width = (uint16_t)((tiles - 1) * (1 << ZS_TILE_LOG2) + in(1, 1 << ZS_TILE_LOG2));
        r.config.strip_h = (uint16_t)h;
        r.config.height = (uint16_t)((strips - 1) * h + in(1, h));
        r.view.depth = &depth;
        r.n_strips = r.draw_end = (uint16_t)strips;
        r.view.key_top = 65535u << 16;
        uint16_t *const bound = r.bound = malloc(ZS_BOUND_BYTES(r.config.width, r.config.height, h));
        const int n_bits = 19 + 31 - zs_clz32((uint32_t)h); /* as frame.c */
        r.strip_mul = (1u << n_bits) / (uint32_t)h + 1u;
        r.strip_shift = (uint8_t)n_bits;
        for (int32_t k = 0; k < tiles * strips; k++)
            bound[k] = (uint16_t)(in(0, 9) ? in(100, 110) : in(0, 65535));
        r.large = 1;
        for (int32_t x0 = 0; x0 < tiles; x0++)
            for (int32_t x1 = x0; x1 < tiles; x1++)
                for (int32_t y0 = 0; y0 < strips; y0++)
                    for (int32_t y1 = y0; y1 < strips; y1++)
                        if (size < 81 || in(0, 400) == 0) {
                            good &= box_right(&r, bound, tiles, x0, x1, y0, y1, (uint32_t)in(98, 130));
                            n++;
                        }
        free(bound);
    }
    tell("boxes", n, good,
         "boxes, every one of frames of up to 9 x 9 tiles, and of larger ones drawn: hidden just where all are");
}

/* ---- clusters.c -------------------------------------------------------------------------------------- */

/* What turned_away says yes to: the eye is behind every triangle that the header's promise allows, by more than the
 * margin, wherever in its sphere. */
static void cones_drawn(uint64_t count)
{
    int good = 1;
    uint64_t yes = 0;
    for (uint64_t i = 0; i < count; i++) {
        struct zs_clusters k;
        struct zs_cluster c;
        struct zs_mesh mesh;
        memset(&k, 0, sizeof k);
        memset(&c, 0, sizeof c);
        memset(&mesh, 0, sizeof mesh);
        long double axis[3], length = 0;
        do {
            for (int j = 0; j < 3; j++)
                c.axis[j] = (int8_t)in(-127, 127);
            length = sqrtl((long double)(c.axis[0] * c.axis[0] + c.axis[1] * c.axis[1] + c.axis[2] * c.axis[2]));
        } while (length > 128 || length < 20);
        c.cutoff = (int8_t)in(0, (int32_t)length - 1);
        c.radius = (uint16_t)in(0, 1 << in(1, 12));
        c.height = (uint16_t)in(1, 65535);
        k.eye_shift = (uint8_t)in(0, 3);
        k.cone = (int8_t)(in(0, 1) * 2 - 1);
        k.margin = (uint32_t)in(0, 1 << in(0, 12));
        k.thin = (uint32_t)in(0, 1 << in(0, 28));
        for (int j = 0; j < 3; j++) {
            c.center[j] = (int16_t)in(-30000, 30000);
            k.eye[j] = k.cone * c.axis[j] * in(0, 128) + in(-2000, 2000);
        }
        if (!turned_away(&k, &mesh, &c))
            continue;
        yes++;
        const long double unit = ldexpl(1, k.eye_shift), margin = k.margin + (long double)k.thin / c.height;
        long double d[3];
        for (int j = 0; j < 3; j++) {
            axis[j] = c.axis[j] / length;
            d[j] = k.cone * (floorl(c.center[j] / unit) + k.eye[j]); /* as it is counted: EYE_OFF is in the margin */
        }
        for (int t = 0; t < 20; t++) { /* a normal that the promise allows: |N - u A| <= u C, at the edge of it */
            long double off[3], size = 0, normal[3], n = 0, h = 0;
            for (int j = 0; j < 3; j++)
                off[j] = in(-1000, 1000);
            for (int j = 0; j < 3; j++)
                size += off[j] * off[j];
            size = sqrtl(size);
            for (int j = 0; j < 3 && size > 0; j++) {
                normal[j] = axis[j] * length + off[j] / size * c.cutoff;
                n += normal[j] * normal[j];
                h += normal[j] * d[j];
            }
            if (size == 0 || n == 0)
                continue;
            good &= h / sqrtl(n) >= c.radius / unit + margin;
        }
    }
    tell("cones", count, good && yes > count / 50,
         "clusters and eyes drawn: those turned away are so by radius and margin");
}

void facts_more(uint64_t count)
{
    sines_all();
    turns_drawn(count);
    sides_drawn(count);
    boxes_all(count);
    cones_drawn(count);
}
