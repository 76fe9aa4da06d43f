/* zsim: the host's side of zstrip.
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdio.h>
#include <string.h>

#include "accuracy.h"
#include "budget.h"
#include "convert.h"
#include "costs.h"
#include "demo.h"
#include "depths.h"
#include "panel_decode.h"
#include "render.h"
#include "sim.h"
#include "study.h"

static const struct {
    const char *name, *what;
    int (*run)(int argc, char **argv); /* the arguments after the name */
} commands[] = {
    { "render", "a model file to a frame", sim_render },
    { "convert", "a model or picture to const C for firmware", sim_convert },
    { "demo", "the demo scenes to numbered frames and a table", sim_demo },
    { "panel", "a recorded stream of a panel's bytes to what its glass shows", sim_panel },
    { "accuracy", "how exact the renderer is: a table, measured", sim_accuracy },
    { "budget", "what a display, a part and a scene take: RAM, flash, wire, time", sim_budget },
    { "costs", "what each stage of the renderer costs on a core", sim_costs },
    { "depths", "which depth mapping tells surfaces apart, and how far", sim_depths },
    { "study", "settings swept: what they cost and give, as CSV, plots and a page", sim_study },
};

#define N_COMMANDS (sizeof commands / sizeof commands[0])

static void help(void)
{
    (void)puts("usage: zsim COMMAND [options]");
    for (size_t i = 0; i < N_COMMANDS; i++)
        (void)printf("  %-8s %s\n", commands[i].name, commands[i].what);
    (void)puts("zsim COMMAND --help tells more.");
}

int main(int argc, char **argv)
{
    if (argc < 2)
        return sim_usage("a command is missing");
    if (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0 ||
        strcmp(argv[1], "help") == 0) {
        help();
        return SIM_OK;
    }
    for (size_t i = 0; i < N_COMMANDS; i++)
        if (strcmp(argv[1], commands[i].name) == 0) {
            const int status = commands[i].run(argc - 2, argv + 2);
            if (fflush(stdout) != 0 && status == SIM_OK)
                return sim_refuse(NULL, 0, "the output could not be written");
            return status;
        }
    return sim_usage("unknown command '%s'", argv[1]);
}
