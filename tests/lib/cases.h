/* Random cases by seed, and the command that replays one.
 *
 * A test program takes a cmocka filter as its argument ("stress_09*"); ZS_SEED=n in the environment
 * runs seed n alone in every random test that passes the filter. ZS_EVERY=n: each nth seed
 * alone, as in make quick.
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
#include "wrong.h"

/* One case. Return 1 if it is right; 0 after case_wrong(). */
typedef int case_fn(uint64_t seed);

/* Run seeds 1 .. n, or the one of ZS_SEED. Fails the current cmocka test at the first wrong one. */
void cases_run(const char *test, case_fn *fn, uint64_t n);
#define CASES(fn, n) cases_run(__func__, fn, n)
/* From one seed of 1 .. n to the next that is to be run: 1, or with ZS_EVERY as many, but that CASES_LEAST are run. */
#define CASES_LEAST 8u
uint64_t cases_step(uint64_t n);
/* 1: all cases are run, so that what they have met in all can be asserted. */
int cases_all(void);

/* What cases count, so that it is known that they met it often enough. */
struct cases_count {
    const char *what; /* as it is printed behind the figure */
    unsigned *count;
    unsigned least; /* it is more than this in the end, where all cases are run */
};

/* A row of a program's table of tests that is nothing but cases: its name, and what CASES takes. */
struct cases {
    const char *test;
    case_fn *fn;
    uint64_t n;
    const struct cases_count *counts; /* set to 0 before the first case; an entry without `what` is the end */
};
void cases_test(void **state); /* *state: a struct cases */
#define CASES_TEST(name_, fn_, n_) CASES_COUNTS(name_, fn_, n_, { NULL, NULL, 0 })
#define CASES_COUNT(name_, fn_, n_, count_, least_, what_) CASES_COUNTS(name_, fn_, n_, { what_, count_, least_ })
/* Counts as initialisers of struct cases_count: CASES_COUNTS(test, fn, n, { "walks", &walks, 100 }, ...) */
#define CASES_COUNTS(name_, fn_, n_, ...) \
    { .name = #name_, \
      .test_func = cases_test, \
      .initial_state = &(struct cases){ #name_, fn_, n_, \
                                        (const struct cases_count[]){ __VA_ARGS__, { NULL, NULL, 0 } } } }

/* Say what is wrong; always 0, to be returned. */
#define case_wrong(...) wrong_said("", __VA_ARGS__)

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
