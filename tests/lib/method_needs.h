/* What memory a method of hidden-surface removal asks for.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef TESTS_METHOD_NEEDS_H
#define TESTS_METHOD_NEEDS_H

#include "zstrip.h"

/* Assert that a method draws a triangle with pools of `tris` triangles and 6 vertices and the depth mapping `depth`,
 * and that it refuses smaller pools, and the mapping `other`, by name. */
void assert_method_needs(const struct zs_method *method, const struct zs_depth *depth, const struct zs_depth *other,
                         uint16_t tris);

#endif
