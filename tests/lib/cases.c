/* Random cases by seed.
 *
 * SPDX-License-Identifier: MIT
 */
#include "cases.h"

#include <string.h>

const char *cases_program = "?";

uint64_t cases_step(uint64_t n)
{
    const char *set = getenv("ZS_EVERY");
    const uint64_t every = set ? strtoull(set, NULL, 10) : 1;
    const uint64_t most = n / CASES_LEAST;
    const uint64_t step = every < most ? every : most;
    return step ? step : 1;
}

int cases_all(void)
{
    return !getenv("ZS_SEED") && cases_step(UINT64_MAX) == 1;
}

void cases_run(const char *test, case_fn *fn, uint64_t n)
{
    const char *only = getenv("ZS_SEED");
    uint64_t first = 1, last = n;
    if (only && *only)
        first = last = strtoull(only, NULL, 0);
    for (uint64_t seed = first; seed <= last; seed += cases_step(n)) {
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
        assert_true(!cases_all() || *c->count > c->least);
}
