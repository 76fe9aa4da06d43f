/* zsim: the host's side of zstrip.
 *
 * SPDX-License-Identifier: MIT
 */
#include "budget.h"
#include "commands.h"
#include "convert.h"
#include "demo.h"
#include "gallery.h"
#include "new.h"
#include "panel_decode.h"
#include "render.h"
#include "study.h"
#include "try.h"
#include "view_command.h"

static const struct sim_command commands[] = {
    { "try", "a model file to a turntable and figures, all of it chosen", sim_try },
    { "view", "a model file or demo scene in a window, live", sim_view },
    { "render", "a model file to a frame", sim_render },
    { "convert", "a model or picture to const C for firmware", sim_convert },
    { "new", "a model to a project of its own, which draws it on a board or in an emulator", sim_new },
    { "demo", "the demo scenes to numbered frames and a table", sim_demo },
    { "gallery", "every method of hidden-surface removal, side by side, on one page", sim_gallery },
    { "panel", "a recorded stream of a panel's bytes to what its glass shows", sim_panel },
    { "budget", "what a display, a part and a scene take: RAM, flash, wire, time", sim_budget },
    { "study", "settings swept: what they cost and give, as CSV, plots and a page", sim_study },
};

int main(int argc, char **argv)
{
    return sim_commands_run(commands, sizeof commands / sizeof commands[0], argc, argv);
}
