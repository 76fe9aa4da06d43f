/* `zsim convert`: a model or a picture to const C.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_CONVERT_H
#define SIM_CONVERT_H

#include <stdio.h>

#include "convert_options.h"
#include "converted.h"

/* All that is written. Of a picture: textures alone. */
struct sim_conversion {
    struct sim_convert_options options;
    struct sim_model model;
    struct sim_converted made;
};

/* argv: the arguments after "convert". Return an enum sim_status. */
int sim_convert(int argc, char **argv);

/* Does this file begin as a PNG or a JPEG does? */
int sim_is_picture(const char *file);

/* NAME.h, NAME.c and the --map file into open streams; errors show in ferror. */
void sim_convert_header(FILE *f, const struct sim_conversion *c);
void sim_convert_source(FILE *f, const struct sim_conversion *c);
void sim_convert_map(FILE *f, const struct sim_conversion *c);

/* Flash by part and what was lost, each line after `lead`. */
void sim_convert_figures(FILE *f, const struct sim_conversion *c, const char *lead);

#endif
