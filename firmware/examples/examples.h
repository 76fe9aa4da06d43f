/* The examples, for the test that checks their pictures. An example needs nothing of this.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef EXAMPLES_H
#define EXAMPLES_H

#include "zstrip.h"

#define EXAMPLE_W 48
#define EXAMPLE_H 32

/* Draw frame t into a sink. Return ZS_OK or an error. */
int example_first_triangle(uint32_t t, const struct zs_sink *sink);
int example_glass(uint32_t t, const struct zs_sink *sink);
int example_cockpit_gauges(uint32_t t, const struct zs_sink *sink);
int example_dither(uint32_t t, const struct zs_sink *sink);
int example_fog(uint32_t t, const struct zs_sink *sink);
int example_cutout(uint32_t t, const struct zs_sink *sink);
int example_explain(uint32_t t, const struct zs_sink *sink);
extern char example_said[256]; /* of example_explain: what zs_explain said */
int example_filters(uint32_t t, const struct zs_sink *sink);
int example_gradient_sky(uint32_t t, const struct zs_sink *sink);
int example_frame_counter(uint32_t t, const struct zs_sink *sink);
int example_hidden_line(uint32_t t, const struct zs_sink *sink);
int example_matcap(uint32_t t, const struct zs_sink *sink);
int example_mirror(uint32_t t, const struct zs_sink *sink);
int example_no_depth(uint32_t t, const struct zs_sink *sink);
int example_planar_shadow(uint32_t t, const struct zs_sink *sink);
int example_sky(uint32_t t, const struct zs_sink *sink);
int example_shadow_map(uint32_t t, const struct zs_sink *sink);
int example_split_screen(uint32_t t, const struct zs_sink *sink);
int example_supersampled(uint32_t t, const struct zs_sink *sink);
int example_user_shader(uint32_t t, const struct zs_sink *sink);
int example_dissolve(uint32_t t, const struct zs_sink *sink);
int example_marble(uint32_t t, const struct zs_sink *sink);
int example_three_lights(uint32_t t, const struct zs_sink *sink);
int example_toon(uint32_t t, const struct zs_sink *sink);
int example_waving_flag(uint32_t t, const struct zs_sink *sink);

#endif
