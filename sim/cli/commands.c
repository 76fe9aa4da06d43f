/* Which command, and the list of them.
 *
 * SPDX-License-Identifier: MIT
 */
#include "commands.h"

#include <stdio.h>
#include <string.h>

#include "kept.h"
#include "sim.h"

static int help(const struct sim_command *commands, size_t n)
{
    (void)printf("usage: %s COMMAND [options]\n", sim_program);
    for (size_t i = 0; i < n; i++)
        (void)printf("  %-8s %s\n", commands[i].name, commands[i].what);
    (void)printf("%s COMMAND --help tells more.\n", sim_program);
    return SIM_OK;
}

/* What a command has printed may be lost where it goes. */
static int flushed(int status)
{
    return fflush(stdout) != 0 && status == SIM_OK ? sim_refuse(NULL, 0, "the output could not be written") : status;
}

int sim_commands_run(const struct sim_command *commands, size_t n, int argc, char **argv)
{
    sim_keep_freed();
    if (argc < 2)
        return sim_usage("a command is missing");
    const int asks = strcmp(argv[1], "help") == 0; /* "help render": "render --help" */
    if (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0 || (asks && argc == 2))
        return flushed(help(commands, n));
    const char *const name = argv[asks ? 2 : 1];
    for (size_t i = 0; i < n; i++)
        if (strcmp(name, commands[i].name) == 0) {
            static char option[] = "--help", *only[] = { option, NULL };
            sim_command = commands[i].name;
            return flushed(asks ? commands[i].run(1, only) : commands[i].run(argc - 2, argv + 2));
        }
    return sim_usage("unknown command '%s'", name);
}
