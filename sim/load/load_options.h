/* The options of every command that loads a model.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_LOAD_OPTIONS_H
#define SIM_LOAD_OPTIONS_H

#include "option_table.h"

#define SIM_LOAD_MEGABYTES_MAX 1000000
#define SIM_LOAD_SECONDS_MAX 86400

/* Rows of a table, into a struct sim_limits that is the member `limits` of `type`. */
#define SIM_LOAD_OPTIONS(type, limits) \
    { "Loading, in a process of its own that ends where it takes too much", SIM_OPTION_HEADING }, \
    { "--allow-outside", SIM_OPTION_FLAG, offsetof(type, limits.outside), \
      .help = "read files, too, that the model names outside its own folder, by their paths or through links" }, \
    { "--load-memory", SIM_OPTION_COUNT, offsetof(type, limits.megabytes), 0, 16, SIM_LOAD_MEGABYTES_MAX, \
      .value = "MB", .help = "most that it may take (1536 and 64 times the file, at most 3/4 of this machine's)" }, \
    { "--load-seconds", SIM_OPTION_COUNT, offsetof(type, limits.seconds), 0, 1, SIM_LOAD_SECONDS_MAX, \
      .value = "S", .help = "CPU time that it may take (20, and 1 for each MB of the file)" }

#endif
