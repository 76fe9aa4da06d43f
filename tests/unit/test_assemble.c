/* Assembly (core/assemble.c): areas, facing and boxes against sums of 128 bits and a look at every sample; each
 * triangle has one outcome, with its reason.
 *
 * SPDX-License-Identifier: MIT
 */
#include <string.h>

#include "cases.h"
#include "internals.h"
#include "picture.h"

typedef __int128 wide;

static struct zs_vertex vertex_make(struct prng *p, int32_t most)
{
    return (struct zs_vertex){ .x = prng_range(p, -most, most), .y = prng_range(p, -most, most) };
}

/* Areas anywhere in the guard band, and what facing says of them. */
static int area_case(uint64_t seed)
{
    struct prng p = { seed };
    for (int t = 0; t < 200; t++) {
        const int32_t most = 1 << prng_range(&p, 1, 21);
        const struct zs_vertex a = vertex_make(&p, most), b = vertex_make(&p, most), c = vertex_make(&p, most);
        const wide want = (wide)a.x * b.y - (wide)b.x * a.y + (wide)b.x * c.y - (wide)c.x * b.y + (wide)c.x * a.y -
                          (wide)a.x * c.y;
        const int64_t area = zs_assemble_area(&a, &b, &c);
        CASE_CHECK(area == want && zs_assemble_area(&a, &c, &b) == -want && zs_assemble_area(&b, &c, &a) == want);
        /* y points down: a front face, counter-clockwise seen from outside, has a negative area */
        CASE_CHECK(zs_assemble_culled(area, ZS_CULL_BACK) == (area > 0));
        CASE_CHECK(zs_assemble_culled(area, ZS_CULL_FRONT) == (area < 0));
        CASE_CHECK(!zs_assemble_culled(area, ZS_CULL_NONE));
    }
    return 1;
}

static unsigned outcome[ZS_OUTCOMES];

/* The box of three vertices, sample by sample; the top vertex first, in the same order round. */
static int box_case(uint64_t seed)
{
    struct prng p = { seed };
    static struct zs_renderer r;
    for (int t = 0; t < 100; t++) {
        r.walk_x = (uint16_t)prng_range(&p, 0, 9);
        r.walk_end = (uint16_t)prng_range(&p, r.walk_x + 1, 20);
        r.walk_y = (uint16_t)prng_range(&p, 0, 9);
        r.walk_y_end = (uint16_t)prng_range(&p, r.walk_y + 1, 20);
        struct zs_vertex v[3];
        const int32_t off[2] = { prng_range(&p, -1500, 5000), prng_range(&p, -1500, 5000) };
        const int32_t step = 1 << prng_range(&p, 0, 7), side = prng_range(&p, 0, 4000) / step;
        for (int k = 0; k < 3; k++)
            v[k] = (struct zs_vertex){ .x = off[0] + step * prng_range(&p, 0, side),
                                       .y = off[1] + step * prng_range(&p, 0, side) };
        int32_t low[2] = { INT32_MAX, INT32_MAX }, high[2] = { INT32_MIN, INT32_MIN };
        for (int k = 0; k < 3; k++) {
            low[0] = v[k].x < low[0] ? v[k].x : low[0];
            low[1] = v[k].y < low[1] ? v[k].y : low[1];
            high[0] = v[k].x > high[0] ? v[k].x : high[0];
            high[1] = v[k].y > high[1] ? v[k].y : high[1];
        }
        /* a sample is at the middle of its pixel; a pixel is in [low, high) */
        int any = 0, seen = 0, rows[2] = { 99, -99 };
        for (int32_t y = -20; y < 60; y++)
            for (int32_t x = -20; x < 60; x++) {
                if (y * 256 + 128 >= low[1] && y * 256 + 128 < high[1]) {
                    rows[0] = y < rows[0] ? y : rows[0];
                    rows[1] = y + 1;
                    if (x * 256 + 128 >= low[0] && x * 256 + 128 < high[0]) {
                        any = 1;
                        seen |= x >= r.walk_x && x < r.walk_end && y >= r.walk_y && y < r.walk_y_end;
                    }
                }
            }
        struct zs_candidate at = { { 0, 1, 2 }, 0, 0 };
        const enum zs_outcome got = zs_assemble_box(&r, v, &at);
        CASE_CHECK(any || got != ZS_OUTCOME_DRAWN);
        CASE_CHECK((got == ZS_OUTCOME_DRAWN) == seen);
        CASE_CHECK(got == ZS_OUTCOME_DRAWN || got == ZS_OUTCOME_OFFSCREEN || (got == ZS_OUTCOME_EMPTY && !any));
        if (seen)
            CASE_CHECK(at.y0 == rows[0] && at.y1 == rows[1]);
        const uint32_t *s = at.slot;
        CASE_CHECK(s[0] < 3 && s[1] == (s[0] + 1) % 3 && s[2] == (s[0] + 2) % 3);
        for (int k = 1; k < 3; k++)
            CASE_CHECK(v[s[0]].y < v[s[k]].y || (v[s[0]].y == v[s[k]].y && v[s[0]].x <= v[s[k]].x));
        outcome[got]++;
    }
    return 1;
}

/* One triangle each, and the count that it goes to. Pixels of a view of 32 x 32 at the distance PIXEL_Z; a step of the
 * mesh is 1/256 px. */
#define PX(v) ((int16_t)((v) * 256))
static const struct one {
    const char *what;
    int16_t pos[3][3];
    uint16_t index[3];
    uint8_t cull;
    size_t count; /* in struct zs_stats */
} ones[] = {
    { "in view", { { PX(-8), PX(8), -PIXEL_Z }, { PX(-8), PX(-8), -PIXEL_Z }, { PX(8), 0, -PIXEL_Z } }, { 0, 1, 2 },
      ZS_CULL_BACK, offsetof(struct zs_stats, tris_drawn) },
    { "its back", { { PX(-8), PX(8), -PIXEL_Z }, { PX(8), 0, -PIXEL_Z }, { PX(-8), PX(-8), -PIXEL_Z } }, { 0, 1, 2 },
      ZS_CULL_BACK, offsetof(struct zs_stats, tris_facing) },
    { "its front", { { PX(-8), PX(8), -PIXEL_Z }, { PX(-8), PX(-8), -PIXEL_Z }, { PX(8), 0, -PIXEL_Z } }, { 0, 1, 2 },
      ZS_CULL_FRONT, offsetof(struct zs_stats, tris_facing) },
    { "a line", { { 0, 0, -PIXEL_Z }, { PX(4), PX(4), -PIXEL_Z }, { PX(8), PX(8), -PIXEL_Z } }, { 0, 1, 2 },
      ZS_CULL_NONE, offsetof(struct zs_stats, tris_zero) },
    { "a point, out of view", { { PX(99), 0, -PIXEL_Z }, { 0, 0, 0 }, { 0, 0, 0 } }, { 0, 0, 0 }, ZS_CULL_NONE,
      offsetof(struct zs_stats, tris_zero) },
    { "no such vertex", { { 0, 0, -PIXEL_Z }, { 0, 0, 0 }, { 0, 0, 0 } }, { 0, 1, 3 }, ZS_CULL_NONE,
      offsetof(struct zs_stats, tris_index) },
    { "before near", { { PX(-8), PX(8), 300 }, { PX(-8), PX(-8), 300 }, { PX(8), 0, 300 } }, { 0, 1, 2 },
      ZS_CULL_NONE, offsetof(struct zs_stats, tris_near) },
    { "beside the frame", { { PX(20), PX(8), -PIXEL_Z }, { PX(20), PX(-8), -PIXEL_Z }, { PX(40), 0, -PIXEL_Z } },
      { 0, 1, 2 }, ZS_CULL_NONE, offsetof(struct zs_stats, tris_offscreen) },
    { "between samples", { { 140, 140, -PIXEL_Z }, { 200, 150, -PIXEL_Z }, { 160, 250, -PIXEL_Z } }, { 0, 1, 2 },
      ZS_CULL_NONE, offsetof(struct zs_stats, tris_empty) },
};

static void each_has_its_reason(void **state)
{
    (void)state;
    for (uint32_t k = 0; k < sizeof ones / sizeof *ones; k++) {
        static struct lone l;
        lone_set(&l, ones[k].pos, 3, ZS_Q16_ONE);
        memcpy(l.tri[0], ones[k].index, sizeof l.tri[0]);
        l.material.cull = ones[k].cull;
        const struct zs_camera camera = pixel_camera(32, 0);
        const struct zs_config c = lone_config(32, 32, &zs_depth_linear);
        struct picture p = picture_draw(&c, &l.scene, &camera);
        assert_int_equal(p.err, ZS_OK);
        uint32_t is;
        memcpy(&is, (const char *)&p.stats + ones[k].count, sizeof is);
        if (is != 1 || p.stats.tris_in != 1 || !stats_add_up(&p.stats))
            fail_msg("%s: %u", ones[k].what, is);
        picture_free(&p);
    }
}

static const struct CMUnitTest tests[] = {
    CASES_TEST(areas_and_facing, area_case, 1000),
    CASES_COUNTS(boxes, box_case, 1500, { "boxes in view", &outcome[ZS_OUTCOME_DRAWN], 10000 },
                 { "beside it", &outcome[ZS_OUTCOME_OFFSCREEN], 10000 },
                 { "between samples", &outcome[ZS_OUTCOME_EMPTY], 1000 }),
    cmocka_unit_test(each_has_its_reason),
};
CASES_MAIN(tests)
