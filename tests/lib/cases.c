/* Random cases by seed.
 *
 * SPDX-License-Identifier: MIT
 */
#include "cases.h"

#include <string.h>

const char *cases_program = "?";

void cases_run(const char *test, case_fn *fn, uint64_t n)
{
    const char *only = getenv("ZS_SEED");
    uint64_t first = 1, last = n;
    if (only && *only)
        first = last = strtoull(only, NULL, 0);
    for (uint64_t seed = first; seed <= last; seed++) {
        if (fn(seed))
            continue;
        fprintf(stderr, "replay: ZS_SEED=%llu %s '%s'\n", (unsigned long long)seed, cases_program,
                test);
        fail();
    }
}

void cases_test(void **state)
{
    const struct cases *cases = *state;
    for (const struct cases_count *c = cases->counts; c->what; c++)
        *c->count = 0;
    cases_run(cases->test, cases->fn, cases->n);
    for (const struct cases_count *c = cases->counts; c->what; c++)
        print_message("%u %s\n", *c->count, c->what);
    for (const struct cases_count *c = cases->counts; c->what; c++)
        assert_true(getenv("ZS_SEED") || *c->count > c->least);
}
