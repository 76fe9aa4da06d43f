/* --help from a table of options: no option is left out, and words and ranges are those that are taken.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_OPTION_HELP_H
#define SIM_OPTION_HELP_H

#include "option_table.h"

/* What stands around the options. Long lines are wrapped; a line feed begins a new one. */
struct sim_help {
    const char *usage;   /* "zsim render MODEL ...", a line for each form */
    const char *about;   /* what the command does */
    const char *closing; /* what stands below the options; the exit status is its last line */
};

/* Print to standard output: usage, what it does, the rows of the table in their order, what closes it. */
void sim_option_help(const struct sim_option *table, size_t n, const struct sim_help *help);

#endif
