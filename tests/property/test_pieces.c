/* Showpieces: two frames of each as tests/records/pieces.txt has them, bit for bit, in strips of any height, from pools
 * and accelerators of any kind. The same table as scene_sums.sh holds boards to. And that they are pictures: of many
 * colours, none black, another one in each frame, and the last one leads to the first.
 *
 * SPDX-License-Identifier: MIT
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "fast_lists.h"
#include "frame_sum.h"
#include "demo_frame.h"

#define FILE_NAME "tests/records/pieces.txt" /* NAME FRAME BITS PIXELS KEYS, a line; from the project's folder */

static const struct piece *piece_of(const char *name)
{
    for (uint32_t i = 0; i < n_pieces; i++)
        if (!strcmp(pieces[i]->demo.name, name))
            return pieces[i];
    return NULL;
}

static void draw(struct sim_frame *frame, const struct piece *piece, uint32_t t, const struct zs_config *c)
{
    static struct demo_frame f;
    piece->demo.pose(&f, t, c->width, c->height);
    assert_int_equal(sim_demo_render(frame, &piece->demo, &f, c, NULL, NULL), ZS_OK);
}

static void config_of(struct zs_config *c, const struct piece *piece, uint16_t w, uint16_t h)
{
    sim_frame_config(c, w, h, (uint8_t)piece->demo.varyings);
    c->depth = piece->demo.depth;
    c->fast = piece->demo.fast;
    c->method = piece->method;
}

static void pieces_on_record(void **state)
{
    static const struct {
        uint16_t strip_h, max_tris, max_verts;
    } part[3] = { { 24, ZS_POOL_MAX, ZS_POOL_MAX }, { 7, 1500, 1500 }, { 240, 900, 2000 } };
    char name[32];
    unsigned number, bits, lines = 0, wrong = 0;
    unsigned long long pixels, keys;
    FILE *file = fopen(FILE_NAME, "r");
    (void)state;
    assert_non_null(file);
    while (fscanf(file, "%31s %u %u %llx %llx", name, &number, &bits, &pixels, &keys) == 5) {
        const struct piece *piece = piece_of(name);
        assert_non_null(piece);
        const struct zs_fast *const *const lists[3] = { piece->demo.fast, NULL, fast_all };
        for (int k = 0; k < 3; k++) {
            struct sim_frame frame;
            struct zs_config c;
            config_of(&c, piece, piece->demo.width, piece->demo.height);
            c.subpixel_bits = (uint8_t)bits;
            c.strip_h = part[k].strip_h;
            c.max_tris = part[k].max_tris;
            c.max_verts = part[k].max_verts;
            c.fast = lists[k];
            draw(&frame, piece, number, &c);
            const size_t n = (size_t)c.width * c.height;
            if (frame_sum(frame.rgb565, n) != pixels || frame_sum(frame.key, n) != keys) {
                print_message("%s, frame %u, %u sub-pixel bits, strips of %u rows: not as on record\n", name, number,
                              bits, (unsigned)c.strip_h);
                wrong++;
            }
            sim_frame_free(&frame);
        }
        lines++;
    }
    (void)fclose(file);
    assert_int_equal(lines, 2 * n_pieces);
    assert_int_equal(wrong, 0);
}

static uint32_t count_colors(const uint16_t *px, size_t n)
{
    static uint8_t seen[65536];
    uint32_t colors = 0;
    memset(seen, 0, sizeof seen);
    for (size_t i = 0; i < n; i++) {
        colors += !seen[px[i]];
        seen[px[i]] = 1;
    }
    return colors;
}

/* The mean difference of two pictures' greens, 1/64 code. */
static uint32_t apart(const uint16_t *a, const uint16_t *b, size_t n)
{
    uint64_t sum = 0;
    for (size_t i = 0; i < n; i++)
        sum += (uint64_t)abs((a[i] >> 5 & 63) - (b[i] >> 5 & 63));
    return (uint32_t)(sum * 64u / n);
}

/* Sizes that they were not composed for; the animation closes: the step from the last frame to the first is one like
 * the others. */
static void pieces_move_at_any_size(void **state)
{
    static const uint16_t size[2][2] = { { 96, 72 }, { 60, 100 } };
    (void)state;
    for (uint32_t i = 0; i < n_pieces; i++)
        for (int k = 0; k < 2; k++) {
            const uint32_t last = pieces[i]->demo.frames - 1u, at[4] = { last, 0, 1, last / 2u };
            const size_t n = (size_t)size[k][0] * size[k][1];
            struct sim_frame frame[4];
            for (int j = 0; j < 4; j++) {
                struct zs_config c;
                config_of(&c, pieces[i], size[k][0], size[k][1]);
                draw(&frame[j], pieces[i], at[j], &c);
            }
            assert_true(count_colors(frame[1].rgb565, n) > 300);
            const uint32_t closing = apart(frame[0].rgb565, frame[1].rgb565, n);
            const uint32_t step = apart(frame[1].rgb565, frame[2].rgb565, n);
            assert_true(step > 0 && closing > 0);
            assert_true(closing * 5u < step * 6u && step * 5u < closing * 6u);
            assert_true(apart(frame[1].rgb565, frame[3].rgb565, n) > step);
            for (int j = 0; j < 4; j++)
                sim_frame_free(&frame[j]);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(pieces_on_record),
                                        cmocka_unit_test(pieces_move_at_any_size) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
