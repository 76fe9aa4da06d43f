/* The examples, for the test that checks their pictures. An example needs nothing of this.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef EXAMPLES_H
#define EXAMPLES_H

#include "zstrip.h"

#define EXAMPLE_W 48
#define EXAMPLE_H 32

/* All of them, in the order of README.md. */
#define EXAMPLES(example)                                                                                           \
    example(first_triangle) example(explain) example(frame_counter) example(gradient_sky) example(split_screen)     \
    example(no_depth) example(hidden_line) example(three_lights) example(toon) example(filters) example(cutout)     \
    example(matcap) example(sky) example(mirror) example(glass) example(layered) example(fog) example(planar_shadow) \
    example(shadow_map) example(supersampled) example(dither) example(cockpit_gauges) example(user_shader)          \
    example(marble) example(dissolve) example(waving_flag) example(two_cores)

/* int example_NAME(uint32_t t, const struct zs_sink *sink): draw frame t into a sink. Return ZS_OK or an error. */
#define EXAMPLE_DECLARED(name) int example_##name(uint32_t t, const struct zs_sink *sink);
EXAMPLES(EXAMPLE_DECLARED)

extern char example_said[256]; /* of example_explain: what zs_explain said */

#endif
