/* What memory a method of hidden-surface removal asks for.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef TESTS_METHOD_NEEDS_H
#define TESTS_METHOD_NEEDS_H

#include "zstrip.h"

/* A method that draws a triangle with pools of `tris` triangles and 6 vertices and the depth mapping `depth`, and that
 * refuses smaller pools, and the mapping `other`, by name. */
struct method_needs {
    const struct zs_method *method;
    const struct zs_depth *depth, *other;
    uint16_t tris;
};
void assert_method_needs(const struct method_needs *needs);

/* A row of a program's table of tests: its name, and a struct method_needs. */
void method_needs_test(void **state);
#define METHOD_NEEDS_TEST(name_, ...) \
    { .name = #name_, .test_func = method_needs_test, .initial_state = &(struct method_needs){ __VA_ARGS__ } }

#endif
