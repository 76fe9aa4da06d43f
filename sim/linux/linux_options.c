/* Parsing, by sim's option table.
 *
 * SPDX-License-Identifier: MIT
 */
#include "linux_options.h"

#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "load_options.h"
#include "option_help.h"
#include "scenes.h"
#include "sim.h"

#define AT(field) offsetof(struct linux_options, field)
#define JUMPERS_HZ 32000000   /* no more than jumper wires carry */
#define FRAMES_MAX 1000000000 /* of a run; frame numbers wrap at 2^32 */

static const char *scene_list(void)
{
    static char text[1024];
    size_t n = 0;
    for (uint32_t i = 0; i < n_demos && n + 64u < sizeof text; i++)
        n += (size_t)snprintf(text + n, sizeof text - n, "%s%s", i == 0 ? "" : ", ", demos[i]->name);
    return text;
}

static const struct sim_option table[] = {
    { "Panel", SIM_OPTION_HEADING },
    SIM_PANEL_OPTIONS(struct linux_options, panel, "the controller and its picture's size. There are:"),
    { "Wiring", SIM_OPTION_HEADING },
    { "--spi", SIM_OPTION_FILE, AT(spi), .value = "DEV",
      .help = "the bus it is on: /dev/spidev0.0 is SPI 0, chip select 0" },
    { "--speed", SIM_OPTION_COUNT, AT(speed), AT(has_speed), 1000, 1e9, .value = "HZ",
      .help = "clock of the bus (st7789 and gc9a01 32000000, ssd1351 20000000, ili9341 and ssd1306 10000000, ssd0323 "
              "4000000)" },
    { "--mode", SIM_OPTION_COUNT, AT(mode), .words = "0|3", .help = "SPI mode: 3 for modules without a CS pin (0)" },
    { "--dc", SIM_OPTION_TEXT, AT(dc), .value = "LINE", .help = "" },
    { "--reset", SIM_OPTION_TEXT, AT(reset), .value = "LINE", .help = "" },
    { "--backlight", SIM_OPTION_TEXT, AT(backlight), .value = "LINE",
      .help = "outputs: a line's name, or CHIP:LINE, where CHIP is a number, gpiochip0, a path or a chip's label. D/C "
              "is needed; without RESET st7789 and ili9341 get a command in its place, and others keep what the set-up "
              "does not set" },
    { "--te", SIM_OPTION_TEXT, AT(te), .value = "LINE",
      .help = "input: each frame begins with its next rising edge. When none comes for a second, frames are drawn "
              "without it from then on" },
    { "Picture", SIM_OPTION_HEADING },
    { "--scene", SIM_OPTION_TEXT, AT(scene), .help = "one of these, turning or moving:", .list = scene_list },
    { "--model", SIM_OPTION_FILE, AT(model),
      .help = "what `zsim render` draws, turning; materials are opaque" },
    { "--frames", SIM_OPTION_COUNT, AT(frames), 0, 1, FRAMES_MAX,
      .help =
          "frames 0, 1, 2 ... N - 1 of the animation, N {range}, then the end; without it for ever, by the clock" },
    { "--step", SIM_OPTION_COUNT, AT(step), AT(has_step), 0, 65535,
      .help = "with --frames: frames 0, N, 2 N ..., N {range} (1)" },
    { "--subpixel", SIM_OPTION_COUNT, AT(subpixel), .words = "4|8", .help = "sub-pixel bits (8)" },
    { "--strip", SIM_OPTION_COUNT, AT(strip), 0, 1, ZS_SIZE_MAX, .value = "ROWS", .help = "rows to a strip (24)" },
    { "--partial", SIM_OPTION_FLAG, AT(partial), .help = "of each strip, send only the columns that have changed" },
    SIM_LOAD_OPTIONS(struct linux_options, limits),
    { "Else", SIM_OPTION_HEADING },
    { "--stats", SIM_OPTION_FLAG, AT(stats),
      .help = "every 32 frames and at the end a line of numbers, averages of a frame" },
    { "--dry-run", SIM_OPTION_FLAG, AT(dry_run),
      .help = "say what would be opened, and stop: no line is requested, nothing is sent" },
    SIM_HELP_OPTIONS(AT(help)),
};

static int check(struct linux_options *o)
{
    struct pm_glass glass;
    const struct {
        const char *name, *value;
    } needed[] = { { "--panel", o->panel.name }, { "--spi", o->spi }, { "--dc", o->dc } };
    for (size_t i = 0; i < sizeof needed / sizeof needed[0]; i++)
        if (needed[i].value == NULL)
            return sim_usage("%s is missing", needed[i].name);
    if ((o->scene == NULL) == (o->model == NULL))
        return sim_usage("%s", o->scene == NULL ? "--scene or --model is missing" : "either --scene or --model");
    if (o->has_step && o->frames == 0)
        return sim_usage("--step is for --frames, which is missing");
    if (!o->has_speed)
        o->speed = sim_panel_hz(o->panel.name, JUMPERS_HZ);
    return sim_panel_take(&o->panel, NULL, 0, o->size, o->strip, &glass);
}

int linux_options_parse(struct linux_options *o, int argc, char **argv)
{
    char seen[N_TABLE] = { 0 };
    *o = (struct linux_options){ .step = 1, .subpixel = 8, .strip = 24 };
    int status = sim_options_take(table, N_TABLE, o, seen, argc, argv, 1);
    if (status != SIM_OK || o->help)
        return status;
    status = sim_options_in_range(table, N_TABLE, o, seen, NULL);
    return status == SIM_OK ? check(o) : status;
}

void linux_options_help(void)
{
    static const struct sim_help help = {
        "zstrip-linux --panel NAME:WxH --spi DEV --dc LINE --reset LINE --scene NAME | --model FILE [options]",
        "Draws a scene or a model on a panel that is wired to this machine, for ever.",
        "SIGINT, SIGTERM, SIGHUP and the last frame end it: panel asleep, backlight off, lines released.\n"
        "Exit status: 0 done, or ended by a signal; 1 refused or failed, a line on stderr says why: one of --frames "
        "was not shown, or none of three in a row; 2 the command line makes no sense.",
    };
    sim_option_help(table, N_TABLE, &help);
}
