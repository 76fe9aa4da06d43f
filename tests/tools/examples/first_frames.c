/* Frame 0 of each program of firmware/examples, a line of CSV each: its name, instructions with its set-up, and a
 * checksum of its strips. For tests/tools/examples.sh.
 *
 * SPDX-License-Identifier: MIT
 */
#include "examples.h"

#include "hal.h"
#include "report.h"

#define EXAMPLE(name) { #name, example_##name },

static const struct {
    const char *name;
    int (*draw)(uint32_t, const struct zs_sink *);
} example[] = { EXAMPLES(EXAMPLE) };

int main(void)
{
    int failed = 0;
    if (hal_init())
        hal_exit(1);
    for (uint32_t i = 0; i < sizeof example / sizeof example[0]; i++) {
        uint64_t sum = REPORT_HASH;
        const struct zs_sink sink = { .submit = report_hash, .ctx = &sum }, drop = { .submit = report_drop };
        const uint64_t start = hal_ticks();
        int err = example[i].draw(0, &drop);
        const uint64_t took = (hal_ticks() - start) * hal_tick_instructions();
        err = err ? err : example[i].draw(0, &sink); /* once more, for the checksum, which would count */
        hal_write(example[i].name);
        report_field(took);
        report_field(sum);
        hal_write(err ? ",failed\n" : "\n");
        failed |= err;
    }
    hal_exit(failed != 0);
}
