/* Which command, and the list of them.
 *
 * SPDX-License-Identifier: MIT
 */
#include "commands.h"

#include <stdio.h>
#include <string.h>

#include "kept.h"
#include "sim.h"

static void help(const struct sim_command *commands, size_t n)
{
    (void)printf("usage: %s COMMAND [options]\n", sim_program);
    for (size_t i = 0; i < n; i++)
        (void)printf("  %-8s %s\n", commands[i].name, commands[i].what);
    (void)printf("%s COMMAND --help tells more.\n", sim_program);
}

int sim_commands_run(const struct sim_command *commands, size_t n, int argc, char **argv)
{
    sim_keep_freed();
    if (argc < 2)
        return sim_usage("a command is missing");
    if (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0 || strcmp(argv[1], "help") == 0) {
        help(commands, n);
        return SIM_OK;
    }
    for (size_t i = 0; i < n; i++)
        if (strcmp(argv[1], commands[i].name) == 0) {
            const int status = commands[i].run(argc - 2, argv + 2);
            if (fflush(stdout) != 0 && status == SIM_OK)
                return sim_refuse(NULL, 0, "the output could not be written");
            return status;
        }
    return sim_usage("unknown command '%s'", argv[1]);
}
