/* Values of options, from text. Each returns 1, or 0 where the text is not of its kind.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_VALUE_H
#define SIM_VALUE_H

#include "zstrip.h"

/* A whole number; *end is behind it. Saturates. */
int sim_value_long(const char *text, const char **end, long *out);
/* One decimal number up to `stop`, where *end is; may come out infinite or NaN. */
int sim_value_double(const char *text, char stop, const char **end, double *out);
/* Three of them, with commas between. */
int sim_value_vector(const char *text, double v[3]);
/* WIDTHxHEIGHT, any whole numbers. */
int sim_value_size(const char *text, long size[2]);
/* RRGGBB, with or without # before it. */
int sim_value_rgb(const char *text, struct zs_rgb *out);
/* The place of a word in "a|b|c"; -1 in place of 0: it is not there. */
int sim_value_choice(const char *text, const char *words);

#endif
