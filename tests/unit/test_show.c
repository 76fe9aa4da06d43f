/* firmware/app/show.h: rows of a strip and memory for the panel's conversion, on a one-bit panel.
 *
 * SPDX-License-Identifier: MIT
 */
#define SHOW_WIDTH 128
#define SHOW_HEIGHT 64
#define SHOW_PIXEL_BITS 1

#include "cases.h"

#include "panel.h"
#include "show.h"

SHOW(demo_cubes, 30, 60, 300, 200, 3);

/* A page is eight rows high: a scene that asks for 60 rows gets 64, and memory for them. */
static void strips_are_pages(void **state)
{
    (void)state;
    const struct panel_config config = { .type = &panel_ssd1306, .width = 128, .height = 64 };
    assert_int_equal(show.rows, 64);
    assert_int_equal(show.rows % panel_grain(&config).y, 0);
    assert_int_equal(show.scratch_bytes, panel_scratch_bytes(&config, SHOW_WIDTH * 64u));
    assert_int_equal(show.arena_bytes, ZS_ARENA_BYTES(SHOW_WIDTH, SHOW_HEIGHT, 64, 300, 200, 3, 2));
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(strips_are_pages) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
