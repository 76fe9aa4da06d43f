/* The textbooks' worked examples of the z-buffer, pixel by pixel. What is expected is worked out by hand.
 *
 * The camera is orthographic: a pixel is 256 world units, and so is one step of an 8-bit key, so that the key of a
 * depth z of 0 .. 255 is z. Less is nearer. Every example is drawn by the depth buffer, alone and with all
 * accelerators, and by the hierarchical one; in one strip and in several.
 *
 * SPDX-License-Identifier: MIT
 */
#include <string.h>

#include "cases.h"
#include "fast_lists.h"
#include "picture.h"
#include "zs_method.h"

#define UNIT 256 /* of a pixel and of a depth step */
#define STEPS 128 /* of a mesh to the same: 255 of them fit 16 bits */
#define FAR 255

/* A polygon of up to four corners: column and row in pixels, and depth. */
struct corner {
    double x, y, z;
};
struct polygon {
    struct corner at[4];
    int n;
    uint8_t rgb[3];
};

#define POLYGONS 3

static int16_t pos[POLYGONS][4][3];
static const uint16_t fan[2][3] = { { 0, 1, 2 }, { 0, 2, 3 } };
static struct zs_mesh mesh[POLYGONS];
static struct zs_material material[POLYGONS];
static struct zs_instance instance[POLYGONS];

/* Draw n polygons of `list` in the order of their numbers in `order`, in one way of six. */
static struct picture drawn(const struct polygon *list, const int *order, uint32_t n, int32_t size, unsigned way)
{
    struct zs_camera camera;
    struct zs_config c = picture_config(size, size, &zs_depth_linear);
    const struct zs_scene scene = { .instance = instance, .n_instances = n };
    assert_int_equal(zs_camera_orthographic(&camera, size * UNIT, 0, FAR * UNIT), ZS_OK);
    for (uint32_t i = 0; i < n; i++) {
        const struct polygon *p = &list[order[i]];
        for (int k = 0; k < p->n; k++) {
            pos[i][k][0] = (int16_t)((p->at[k].x - size / 2.) * STEPS);
            pos[i][k][1] = (int16_t)((size / 2. - p->at[k].y) * STEPS);
            pos[i][k][2] = (int16_t)(-p->at[k].z * STEPS);
        }
        mesh[i] = (struct zs_mesh){ .pos = (const int16_t(*)[3])pos[i], .tri = fan, .n_verts = (uint32_t)p->n,
                                    .n_tris = (uint32_t)p->n - 2u, .scale = UNIT / STEPS * ZS_Q16_ONE,
                                    .radius = 57000 };
        material[i] = (struct zs_material){ .shader = &zs_shade_raw, .rgb = { p->rgb[0], p->rgb[1], p->rgb[2] },
                                            .cull = ZS_CULL_NONE };
        instance[i] = (struct zs_instance){ .mesh = &mesh[i], .material = &material[i] };
    }
    c.depth_bits = 8;
    c.fast = way % 3 == 1 ? fast_all : NULL;
    c.method = way % 3 == 2 ? &zs_method_hiz : NULL;
    c.strip_h = (uint16_t)(way < 3 ? size : 3);
    struct picture is = picture_draw(&c, &scene, &camera);
    assert_int_equal(is.err, ZS_OK);
    return is;
}
#define WAYS 6

#define SIZE 8
#define BACK ZS_DEPTH_CLEAR

/* Compare with 8x8 keys, and with letters of colours: a, b: the polygons; '.': background. */
static void check(const struct polygon *list, const int *order, const uint16_t key[SIZE][SIZE],
                  const char letter[SIZE][SIZE + 1])
{
    for (unsigned way = 0; way < WAYS; way++) {
        struct picture is = drawn(list, order, 2, SIZE, way);
        for (int y = 0; y < SIZE; y++)
            for (int x = 0; x < SIZE; x++) {
                const uint8_t *rgb = letter[y][x] == '.' ? NULL : list[letter[y][x] - 'a'].rgb;
                const uint16_t color = rgb ? zs_rgb565(rgb[0], rgb[1], rgb[2]) : 0;
                if (is.key[y * SIZE + x] != key[y][x] || is.color[y * SIZE + x] != color)
                    fail_msg("way %u, (%d, %d): key %u, not %u; colour %04x, not %04x", way, x, y,
                             is.key[y * SIZE + x], key[y][x], is.color[y * SIZE + x], color);
            }
        picture_free(&is);
    }
}

/* The same for polygons of one depth each: level[0] is the key of each `a`, level[1] of each `b`. */
static void check_levels(const struct polygon *list, const int *order, const uint16_t level[2],
                         const char letter[SIZE][SIZE + 1])
{
    uint16_t key[SIZE][SIZE];
    for (int y = 0; y < SIZE; y++)
        for (int x = 0; x < SIZE; x++)
            key[y][x] = letter[y][x] == '.' ? BACK : level[letter[y][x] - 'a'];
    check(list, order, (const uint16_t(*)[SIZE])key, letter);
}

static const int forth[] = { 0, 1, 2 }, back[] = { 1, 0 };

/* Polygon a: depth 5, pixels x + y <= 6. Polygon b: rows 1 .. 6, x < y, depth 3 at the slanted edge and one more for
 * each pixel to the left, up to 8: 2 + y - x at the pixels' middles. */
static const struct polygon constant_and_slope[2] = {
    { { { 0, 0, 5 }, { 7.5, 0, 5 }, { 0, 7.5, 5 } }, 3, { 255, 0, 0 } },
    { { { 0, .5, 2.5 }, { 6.5, 7, 2.5 }, { 0, 7, 9 } }, 3, { 0, 255, 0 } }
};
static const uint16_t slope_key[SIZE][SIZE] = { { 5, 5, 5, 5, 5, 5, 5, BACK },
                                                { 3, 5, 5, 5, 5, 5, BACK, BACK },
                                                { 4, 3, 5, 5, 5, BACK, BACK, BACK },
                                                { 5, 4, 3, 5, BACK, BACK, BACK, BACK },
                                                { 5, 5, 4, 3, BACK, BACK, BACK, BACK },
                                                { 5, 5, 5, 4, 3, BACK, BACK, BACK },
                                                { 5, 7, 6, 5, 4, 3, BACK, BACK },
                                                { BACK, BACK, BACK, BACK, BACK, BACK, BACK, BACK } };

static void a_constant_5_against_a_slope_of_3_to_8(void **state)
{
    (void)state;
    /* at (0, 3) and (1, 4) both are 5: the first stays */
    static const char a_first[SIZE][SIZE + 1] = { "aaaaaaa.", "baaaaa..", "bbaaa...", "abba....",
                                                  "aabb....", "aabbb...", "abbbbb..", "........" };
    static const char b_first[SIZE][SIZE + 1] = { "aaaaaaa.", "baaaaa..", "bbaaa...", "bbba....",
                                                  "abbb....", "aabbb...", "abbbbb..", "........" };
    check(constant_and_slope, forth, slope_key, a_first);
    check(constant_and_slope, back, slope_key, b_first);
}

/* Squares at 64 and at 127 of 0 .. 255, whichever is drawn first; then two surfaces in one step of the buffer, 0.4
 * apart, of which the first stays although the second is nearer. */
static void an_integer_buffer_with_64_and_127(void **state)
{
    (void)state;
    static const struct polygon far_and_near[2] = {
        { { { 1, 1, 127 }, { 6, 1, 127 }, { 6, 6, 127 }, { 1, 6, 127 } }, 4, { 127, 127, 127 } },
        { { { 3, 3, 64 }, { 8, 3, 64 }, { 8, 8, 64 }, { 3, 8, 64 } }, 4, { 64, 64, 64 } }
    };
    static const char letter[SIZE][SIZE + 1] = { "........", ".aaaaa..", ".aaaaa..", ".aabbbbb",
                                                 ".aabbbbb", ".aabbbbb", "...bbbbb", "...bbbbb" };
    static const uint16_t far_near[2] = { 127, 64 }, same[2] = { 64, 64 };
    check_levels(far_and_near, forth, far_near, letter);
    check_levels(far_and_near, back, far_near, letter);

    struct polygon one_step[2] = { far_and_near[0], far_and_near[1] };
    static const char a_first[SIZE][SIZE + 1] = { "........", ".aaaaa..", ".aaaaa..", ".aaaaabb",
                                                  ".aaaaabb", ".aaaaabb", "...bbbbb", "...bbbbb" };
    for (int k = 0; k < 4; k++) {
        one_step[0].at[k].z = 64.25;
        one_step[1].at[k].z = 63.75;
    }
    check_levels(one_step, forth, same, a_first);
    check_levels(one_step, back, same, letter);
}

/* Surfaces that meet between two columns, 2 + x and 9 - x at pixel x, and in a column, 2 + x and 8 - x. */
static void intersecting_surfaces(void **state)
{
    (void)state;
    struct polygon cross[2] = {
        { { { 0, 0, 1.5 }, { 8, 0, 9.5 }, { 8, 8, 9.5 }, { 0, 8, 1.5 } }, 4, { 255, 0, 0 } },
        { { { 0, 0, 9.5 }, { 8, 0, 1.5 }, { 8, 8, 1.5 }, { 0, 8, 9.5 } }, 4, { 0, 0, 255 } }
    };
    uint16_t key[SIZE][SIZE];
    char letter[SIZE][SIZE + 1];
    static const uint16_t between[SIZE] = { 2, 3, 4, 5, 5, 4, 3, 2 }, within[SIZE] = { 2, 3, 4, 5, 4, 3, 2, 1 };
    for (int y = 0; y < SIZE; y++) {
        memcpy(key[y], between, sizeof between);
        memcpy(letter[y], "aaaabbbb", SIZE + 1);
    }
    check(cross, forth, key, letter);
    check(cross, back, key, letter);

    for (int k = 0; k < 4; k++)
        cross[1].at[k].z -= 1;
    for (int y = 0; y < SIZE; y++)
        memcpy(key[y], within, sizeof within);
    check(cross, forth, key, letter); /* both are 5 in column 3 */
    for (int y = 0; y < SIZE; y++)
        memcpy(letter[y], "aaabbbbb", SIZE + 1);
    check(cross, back, key, letter);
}

/* Triangles at 0.75, 0.5 and 0.25 of the range, coloured with their depths as greys: the picture is the buffer, in
 * all six orders. 191.25, 127.5 and 63.75 are 191, 128 and 64. */
static void three_triangles_in_any_order(void **state)
{
    (void)state;
    enum { N = 12 };
    static const struct polygon triangles[3] = {
        { { { 0, 0, 191.25 }, { 11.5, 0, 191.25 }, { 0, 11.5, 191.25 } }, 3, { 191, 191, 191 } },
        { { { 2, 2, 127.5 }, { 8.5, 2, 127.5 }, { 2, 8.5, 127.5 } }, 3, { 128, 128, 128 } },
        { { { 3, 1, 63.75 }, { 6.5, 1, 63.75 }, { 3, 4.5, 63.75 } }, 3, { 64, 64, 64 } }
    };
    static const int order[6][3] = { { 0, 1, 2 }, { 0, 2, 1 }, { 1, 0, 2 }, { 1, 2, 0 }, { 2, 0, 1 }, { 2, 1, 0 } };
    /* x + y <= 10; x, y >= 2 and x + y <= 9; x >= 3, y >= 1 and x + y <= 6 */
    static const char want[N][N + 1] = { "33333333333.", "3331113333..", "332112223...", "33212223....",
                                         "3322223.....", "332223......", "33223.......", "3323........",
                                         "333.........", "33..........", "3...........", "............" };
    for (int o = 0; o < 6; o++)
        for (unsigned way = 0; way < WAYS; way++) {
            struct picture is = drawn(triangles, order[o], 3, N, way);
            for (int i = 0; i < N * N; i++) {
                const char letter = want[i / N][i % N];
                const uint8_t grey = letter == '1' ? 64 : letter == '2' ? 128 : letter == '3' ? 191 : 0;
                const uint16_t key = letter == '.' ? BACK : grey;
                if (is.key[i] != key || is.color[i] != zs_rgb565(grey, grey, grey))
                    fail_msg("order %d, way %u, (%d, %d): key %u, not %u; colour %04x", o, way, i % N, i / N,
                             is.key[i], key, is.color[i]);
            }
            picture_free(&is);
        }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_constant_5_against_a_slope_of_3_to_8),
    cmocka_unit_test(an_integer_buffer_with_64_and_127),
    cmocka_unit_test(three_triangles_in_any_order),
    cmocka_unit_test(intersecting_surfaces)
};

CASES_MAIN(tests)
