/* Frames on record: every scene's pixels and keys, bit for bit, as tests/records/scenes.txt has them; by the core
 * alone, by the accelerators that the scene names, and by all. The same table as scene_sums.sh holds boards to.
 *
 * SPDX-License-Identifier: MIT
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "fast_lists.h"
#include "frame.h"
#include "frame_sum.h"
#include "scenes.h"

#define FILE_NAME "tests/records/scenes.txt" /* NAME FRAME BITS PIXELS KEYS, a line; from the project's folder */

static const struct demo *demo_of(const char *name)
{
    for (uint32_t d = 0; d < n_demos; d++)
        if (!strcmp(demos[d]->name, name))
            return demos[d];
    return NULL;
}

static void scenes_on_record(void **state)
{
    static struct demo_frame f;
    char name[32];
    unsigned number, bits, lines = 0, wrong = 0;
    unsigned long long pixels, keys;
    FILE *file = fopen(FILE_NAME, "r");
    assert_non_null(file);
    while (fscanf(file, "%31s %u %u %llx %llx", name, &number, &bits, &pixels, &keys) == 5) {
        const struct demo *d = demo_of(name);
        struct zs_config c;
        assert_non_null(d);
        const struct zs_fast *const *const lists[] = { NULL, d->fast, fast_all };
        sim_frame_config(&c, d->width, d->height, (uint8_t)d->varyings);
        c.depth = d->depth;
        c.subpixel_bits = (uint8_t)bits;
        d->pose(&f, number, d->width, d->height);
        for (int k = 0; k < 3; k++) {
            struct sim_frame frame;
            c.fast = lists[k];
            assert_int_equal(sim_frame_render(&frame, &f.scene, &f.camera, &c, NULL), ZS_OK);
            const size_t n = (size_t)d->width * d->height;
            if (frame_sum(frame.rgb565, n) != pixels || frame_sum(frame.key, n) != keys) {
                print_message("%s, frame %u, %u sub-pixel bits, %s: not as on record\n", name, number, bits,
                              k == 0 ? "the core" : k == 1 ? "its accelerators" : "all accelerators");
                wrong++;
            }
            sim_frame_free(&frame);
        }
        lines++;
    }
    (void)fclose(file);
    assert_true(lines >= 2 * n_demos);
    assert_int_equal(wrong, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(scenes_on_record) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
