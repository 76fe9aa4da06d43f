/* zlab: how exact the renderer is, and what it costs, measured by those who work on it.
 *
 * SPDX-License-Identifier: MIT
 */
#include "accuracy.h"
#include "commands.h"
#include "costs_fit.h"
#include "looks_error.h"
#include "sim.h"

static const struct sim_command commands[] = {
    { "accuracy", "how exact the renderer is: a table, measured", sim_accuracy },
    { "costs", "what each stage of the renderer costs on a core", sim_costs },
    { "looks", "how far that is from frames with effects and several passes", sim_looks },
};

int main(int argc, char **argv)
{
    sim_program = "zlab";
    return sim_commands_run(commands, sizeof commands / sizeof commands[0], argc, argv);
}
