/* Random cases by seed, and the command that replays one.
 *
 * A test program takes a cmocka filter as its argument ("stress_09*"); ZS_SEED=n in the environment
 * runs seed n alone in every random test that passes the filter.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef TESTS_CASES_H
#define TESTS_CASES_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "prng.h"

/* One case. Return 1 if it is right; 0 after case_wrong(). */
typedef int case_fn(uint64_t seed);

/* Run seeds 1 .. n, or the one of ZS_SEED. Fails the current cmocka test at the first wrong one. */
void cases_run(const char *test, case_fn *fn, uint64_t n);
#define CASES(fn, n) cases_run(__func__, fn, n)

/* A row of a program's table of tests that is nothing but cases: its name, and what CASES takes. */
struct cases {
    const char *test;
    case_fn *fn;
    uint64_t n;
    unsigned *count; /* what they count; NULL: nothing */
    unsigned least;  /* it is more than this in the end, where all are run */
    const char *what;
};
void cases_test(void **state); /* *state: a struct cases */
#define CASES_TEST(name_, fn_, n_) CASES_COUNT(name_, fn_, n_, NULL, 0, NULL)
/* The same where cases count what they met, so that it is known that they met it often enough. */
#define CASES_COUNT(name_, fn_, n_, count_, least_, what_) \
    { .name = #name_, \
      .test_func = cases_test, \
      .initial_state = &(struct cases){ #name_, fn_, n_, count_, least_, what_ } }

/* Say what is wrong; always 0, to be returned. */
int case_wrong(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* assert_true for the body of a case. */
#define CASE_CHECK(condition) \
    do { \
        if (!(condition)) \
            return case_wrong("%s:%d: %s", __FILE__, __LINE__, #condition); \
    } while (0)

/* cmocka's main: argv[1] is a filter. */
#define CASES_MAIN(tests) \
    int main(int argc, char **argv) \
    { \
        cases_program = argv[0]; \
        if (argc > 1) \
            cmocka_set_test_filter(argv[1]); \
        return cmocka_run_group_tests(tests, NULL, NULL); \
    }
extern const char *cases_program;

#endif
