/* Parsing, by sim's option table.
 *
 * SPDX-License-Identifier: MIT
 */
#include "linux_options.h"

#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "scenes.h"
#include "sim.h"

static const char usage[] =
    "usage: zstrip-linux --panel NAME:WxH --spi DEV --dc LINE --reset LINE --scene NAME | --model FILE [options]\n"
    "Draws a scene or a model on a panel that is wired to this machine, for ever.\n"
    "\n"
    "Panel\n"
    "  --panel NAME:WxH  There are:\n"
    "                    %s\n"
    "  --rotate DEGREES  0, 90, 180 or 270: how far the picture is turned clockwise on the glass (0)\n"
    "  --invert, --bgr   the glass shows negatives (most IPS glass), or has blue for red\n"
    "Wiring\n"
    "  --spi DEV         /dev/spidev0.0 is SPI 0, chip select 0\n"
    "  --speed HZ        of its clock (st7789 and gc9a01 32000000, ssd1351 20000000, ili9341 and ssd1306 10000000,\n"
    "                    ssd0323 4000000)\n"
    "  --dc LINE, --reset LINE, --backlight LINE\n"
    "                    outputs: a line's name, or CHIP:LINE, where CHIP is a number, gpiochip0, a path or a\n"
    "                    chip's label. D/C is needed; without RESET the panel gets a command in its place\n"
    "  --te LINE         input: each frame begins with its next rising edge. When none comes for a second, frames are\n"
    "                    drawn without it from then on\n"
    "Picture\n"
    "  --scene NAME      %s\n"
    "  --model FILE      what `zsim render --shade textured` draws (without textures: smooth), turning\n"
    "  --frames N        frames 0, 1, 2 ... N - 1 of the animation, then the end; without it for ever, by the clock\n"
    "  --step N          with --frames: frames 0, N, 2 N ... (1)\n"
    "  --subpixel 4|8    sub-pixel bits (8)\n"
    "  --strip ROWS      rows to a strip (24)\n"
    "  --partial         of each strip, send only the columns that have changed\n"
    "Else\n"
    "  --stats           every 32 frames and at the end a line of numbers, averages of a frame\n"
    "  --dry-run         say what would be opened, and stop: no line is requested, nothing is sent\n"
    "\n"
    "SIGINT, SIGTERM, SIGHUP and the last frame end it: panel asleep, backlight off, lines released.\n"
    "Exit status: 0 done, or ended by a signal; 1 refused or failed, a line on stderr says why: one of --frames was\n"
    "not shown, or none of three in a row; 2 the command line makes no sense.\n";

#define AT(field) offsetof(struct linux_options, field)
#define FRAMES_MAX 1000000000 /* of a run; frame numbers wrap at 2^32 */

static const struct sim_option table[] = {
    SIM_PANEL_OPTIONS(struct linux_options, panel,
                      "There are:"),
    { "--spi", SIM_OPTION_FILE, AT(spi) },
    { "--speed", SIM_OPTION_COUNT, AT(speed), AT(has_speed), 1000, 1e9 },
    { "--dc", SIM_OPTION_TEXT, AT(dc) }, { "--reset", SIM_OPTION_TEXT, AT(reset) },
    { "--backlight", SIM_OPTION_TEXT, AT(backlight) }, { "--te", SIM_OPTION_TEXT, AT(te) },
    { "--scene", SIM_OPTION_TEXT, AT(scene) }, { "--model", SIM_OPTION_FILE, AT(model) },
    { "--frames", SIM_OPTION_COUNT, AT(frames), 0, 1, FRAMES_MAX },
    { "--step", SIM_OPTION_COUNT, AT(step), AT(has_step), 0, 65535 },
    { "--subpixel", SIM_OPTION_COUNT, AT(subpixel), .words = "4|8" },
    { "--strip", SIM_OPTION_COUNT, AT(strip), 0, 1, ZS_SIZE_MAX },
    { "--partial", SIM_OPTION_FLAG, AT(partial) }, { "--stats", SIM_OPTION_FLAG, AT(stats) },
    { "--dry-run", SIM_OPTION_FLAG, AT(dry_run) },
    SIM_HELP_OPTIONS(AT(help)),
};

#define N_TABLE (sizeof table / sizeof table[0])

/* What datasheets allow, and no more than jumper wires carry. */
static long usual_speed(const char *panel)
{
    static const struct {
        const char *name;
        long hz;
    } of[] = { { "ssd1351:", 20000000 }, { "ili9341:", 10000000 }, { "ssd1306:", 10000000 }, { "ssd0323:", 4000000 } };
    for (size_t i = 0; i < sizeof of / sizeof of[0]; i++)
        if (strncmp(panel, of[i].name, strlen(of[i].name)) == 0)
            return of[i].hz;
    return 32000000;
}

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
        o->speed = usual_speed(o->panel.name);
    return sim_panel_take(&o->panel, NULL, 0, o->size, o->strip, &glass);
}

int linux_options_parse(struct linux_options *o, int argc, char **argv)
{
    char seen[N_TABLE] = { 0 };
    int status = SIM_OK;
    *o = (struct linux_options){ .step = 1, .subpixel = 8, .strip = 24 };
    for (int i = 1; status == SIM_OK && i < argc; i++)
        status = sim_option_take(table, N_TABLE, o, seen, argc, argv, &i);
    if (status != SIM_OK || o->help)
        return status;
    status = sim_options_in_range(table, N_TABLE, o, seen, NULL);
    return status == SIM_OK ? check(o) : status;
}

void linux_options_help(void)
{
    char scenes[1024], list[1024];
    size_t n = 0;
    for (uint32_t i = 0; i < n_demos && n + 64u < sizeof list; i++)
        n += (size_t)snprintf(list + n, sizeof list - n, "%s%s", i == 0 ? "" : ", ", demos[i]->name);
    sim_wrap(scenes, sizeof scenes, list, 20);
    (void)printf(usage, sim_panel_list(20), scenes);
}
