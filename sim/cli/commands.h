/* A program of several commands: zsim, zlab.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_COMMANDS_H
#define SIM_COMMANDS_H

#include <stddef.h>

struct sim_command {
    const char *name, *what;
    int (*run)(int argc, char **argv); /* the arguments after the name */
};

/* Run the command that argv[1] names, or print the list of all n. Return an exit status. */
int sim_commands_run(const struct sim_command *commands, size_t n, int argc, char **argv);

#endif
