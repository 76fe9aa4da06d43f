/* What `zsim demo` is asked for: options, and which frames of which scenes.
 *
 * SPDX-License-Identifier: MIT
 */
#include "demo_options.h"

#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "demo.h"
#include "option_help.h"
#include "scene_file.h"
#include "sim.h"

#define FRAMES_MAX 65535 /* of a scene, uint16_t */

#define AT(field) offsetof(struct sim_demo_request, field)

/* The names of all scenes. Static storage. */
static const char *scene_list(void)
{
    static char text[1024];
    size_t n = 0;
    for (uint32_t i = 0; i < sim_demo_count() && n + 64u < sizeof text; i++)
        n += (size_t)snprintf(text + n, sizeof text - n, "%s%s", i == 0 ? "" : ", ", sim_demo_at(i)->name);
    return text;
}

static const struct sim_option table[] = {
    { "--out", SIM_OPTION_TEXT, AT(out), .value = "DIR", .help = "the folder, made if there is none (build/demo)" },
    { "--scene", SIM_OPTION_TEXT, AT(scenes), .value = "NAME,...",
      .help = "these alone (all), or a scene's own file, which is compiled: my_scene.c. There are:",
      .list = scene_list },
    { "--size", SIM_OPTION_SIZE, AT(size), AT(has_size), 1, ZS_SIZE_MAX,
      .help = "px (what each scene was composed for)" },
    { "--strip", SIM_OPTION_COUNT, AT(strip), 0, 1, ZS_SIZE_MAX, .value = "ROWS", .help = "rows to a strip (24)" },
    { "--subpixel", SIM_OPTION_COUNT, AT(subpixel), .words = "4|8", .help = "sub-pixel bits (8)" },
    { "--orbit", SIM_OPTION_VECTOR, AT(orbit), AT(has_orbit), .value = "YAW,RISE,DISTANCE",
      .help = "the camera elsewhere: degrees around the middle of the scene and upwards, and a factor of the distance "
              "(0,0,1)" },
    { "--start", SIM_OPTION_COUNT, AT(start), 0, 0, FRAMES_MAX, .value = "T",
      .help = "the first frame of the animation to be drawn (0)" },
    { "--step", SIM_OPTION_COUNT, AT(step), 0, 1, FRAMES_MAX,
      .help = "frames T, T + N, T + 2 N ... to the animation's end, N {range} (1)" },
    { "--frames", SIM_OPTION_COUNT, AT(frames), 0, 1, FRAMES_MAX, .help = "at most so many of each scene (all)" },
    { "--fast", SIM_OPTION_TEXT, AT(fast_names), .value = "LIST", .list = sim_fast_list,
      .help = "accelerators to draw with, the same frames: all, none, names with commas between, or all but some, as "
              "all-tiles-touch (all). There are:" },
    { "--method", SIM_OPTION_CHOICE, AT(method), .words = SIM_METHOD_WORDS,
      .help = "how hidden surfaces are removed (zbuffer), as of zsim render" },
    { "--show", SIM_OPTION_CHOICE, AT(show), .words = SIM_SHOW_WORDS,
      .help = "pictures are false colours with a legend, as of zsim render (frame)" },
    SIM_PANEL_OPTIONS(struct sim_demo_request, panel,
                      "frames go through this panel's driver and the model of its controller: pictures are what its "
                      "viewer sees, of its size. There are:"),
    { "--moving", SIM_OPTION_FILE, AT(moving), .value = "F.png",
      .help = "contact sheets of the first frames, the second ones and so on as an animated PNG, too, or a GIF "
              "or MP4 where the name ends so; a scene with fewer frames begins again" },
    { "--delay", SIM_OPTION_COUNT, AT(delay), 0, 10, 65535, .value = "MS", .help = "of a frame in it, {range} (80)" },
    { "--raw", SIM_OPTION_FLAG, AT(raw),
      .help = "DIR/SCENE_NNN.bin too: RGB565, most significant byte first, row by row; of grey and one-bit panels a "
              "byte for each level or bit" },
    SIM_HELP_OPTIONS(AT(help)),
};

static const struct sim_help help = {
    "zsim demo [options]",
    "Draws demo scenes, with and without effects, and bench scenes strip by strip as a board would: DIR/SCENE_NNN.png, "
    "where NNN is the frame of the animation, a contact sheet DIR/contact.png of their first frames, and a table of "
    "what they took and of how far the frames, before any panel, are from the double-precision reference.",
    "Exit status: 0 done; 1 refused; 2 the command line makes no sense.",
};

struct sim_demo_size sim_demo_size_of(const struct sim_demo_request *rq, const struct demo *demo)
{
    if (!rq->has_size)
        return (struct sim_demo_size){ demo->width, demo->height };
    return (struct sim_demo_size){ (uint16_t)rq->size[0], (uint16_t)rq->size[1] };
}

uint32_t sim_demo_frames(const struct sim_demo_request *rq, const struct demo *demo)
{
    const long all = (demo->frames - rq->start + rq->step - 1) / rq->step;
    return (uint32_t)(rq->frames > 0 && rq->frames < all ? rq->frames : all);
}

/* The frame of the animation that is the k-th to be drawn. */
uint32_t sim_demo_frame_number(const struct sim_demo_request *rq, uint32_t k)
{
    return (uint32_t)rq->start + k * (uint32_t)rq->step;
}

struct sim_orbit sim_demo_orbit(const struct sim_demo_request *rq)
{
    const double radians = 0.01745329251994329577;
    if (!rq->has_orbit)
        return (struct sim_orbit)SIM_ORBIT_HOME;
    return (struct sim_orbit){ radians * rq->orbit[0], radians * rq->orbit[1], rq->orbit[2] };
}

static int is_name(const struct demo *demo, const char *text, size_t length)
{
    const char *name = sim_demo_name(demo);
    return strlen(name) == length && !memcmp(name, text, length);
}

/* The name behind that at `at`; NULL: it was the last. */
static const char *next_name(const char *at)
{
    const char *comma = strchr(at, ',');
    return comma ? comma + 1 : NULL;
}

/* Asked for are pictures or methods that scenes with effects do not have. */
static int plain(const struct sim_demo_request *rq)
{
    return rq->show != SIM_SHOW_FRAME || rq->method;
}

int sim_demo_wanted(const struct sim_demo_request *rq, const struct demo *demo)
{
    for (const char *at = rq->scenes; at; at = next_name(at))
        if (is_name(demo, at, strcspn(at, ",")))
            return 1;
    return !rq->scenes && !(sim_demo_piece(demo) && plain(rq));
}

/* Scenes' own files among the names. */
static int load_scenes(const struct sim_demo_request *rq)
{
    const char *own = NULL;
    for (const char *at = rq->scenes; at; at = next_name(at)) {
        const size_t length = strcspn(at, ",");
        char *name = sim_alloc(length + 1, 1);
        memcpy(name, at, length);
        int status = SIM_OK;
        if (sim_scene_file_is(name)) {
            status = own ? sim_usage("--scene: one scene's own file at a time") : sim_scene_file_need(name);
            own = at;
        }
        free(name);
        if (status != SIM_OK)
            return status;
    }
    return SIM_OK;
}

/* Are names and frames such as there are? */
static int check_scenes(const struct sim_demo_request *rq)
{
    const int status = load_scenes(rq);
    if (status != SIM_OK)
        return status;
    for (const char *at = rq->scenes; at; at = next_name(at)) {
        const size_t length = strcspn(at, ",");
        uint32_t i = 0;
        while (i < sim_demo_count() && !is_name(sim_demo_at(i), at, length))
            i++;
        if (i == sim_demo_count())
            return sim_refuse(NULL, 0, "--scene %.*s: there is no such scene; there are %s", (int)length, at,
                              scene_list());
        if (sim_demo_piece(sim_demo_at(i)) && plain(rq))
            return sim_usage("--scene %s: it has effects, so that there are no false colours and no other methods",
                             sim_demo_at(i)->name);
    }
    for (uint32_t i = 0; i < sim_demo_count(); i++)
        if (sim_demo_wanted(rq, sim_demo_at(i)) && rq->start >= sim_demo_at(i)->frames)
            return sim_refuse(NULL, 0, "--start %ld: frames of %s are 0 to %u; start at one of them%s", rq->start,
                              sim_demo_at(i)->name, sim_demo_at(i)->frames - 1u,
                              rq->scenes ? "" : ", or name scenes by --scene");
    return SIM_OK;
}

int sim_demo_parse(struct sim_demo_request *rq, int argc, char **argv)
{
    char seen[N_TABLE] = { 0 };
    struct pm_glass glass;
    int status = sim_options_take(table, N_TABLE, rq, seen, argc, argv, 0);
    if (status != SIM_OK || rq->help)
        return status;
    status = sim_fast_take(&rq->fast, rq->fast_names);
    if (status == SIM_OK)
        status = sim_options_in_range(table, N_TABLE, rq, seen, NULL);
    if (status == SIM_OK)
        status = sim_panel_take(&rq->panel, NULL, rq->has_size, rq->size, rq->strip, &glass);
    if (status == SIM_OK && rq->show != SIM_SHOW_FRAME && rq->panel.name != NULL)
        return sim_usage("--show does not go through a panel: leave --panel out");
    if (status == SIM_OK && rq->has_orbit && (rq->orbit[2] < SIM_ORBIT_LEAST || rq->orbit[2] > SIM_ORBIT_MOST))
        return sim_usage("--orbit %g,%g,%g: a distance is %g to %g times the scene's own", rq->orbit[0], rq->orbit[1],
                         rq->orbit[2], SIM_ORBIT_LEAST, SIM_ORBIT_MOST);
    if (status == SIM_OK && rq->method && rq->show != SIM_SHOW_FRAME && rq->show != SIM_SHOW_OVERDRAW)
        return sim_usage("--method %s: of --show there is overdraw", sim_methods[rq->method].name);
    rq->has_size |= rq->panel.name != NULL;
    return status == SIM_OK ? check_scenes(rq) : status;
}

const struct sim_demo_request sim_demo_usual = {
    .out = "build/demo", .strip = 24, .subpixel = 8, .step = 1, .delay = 80
};

const struct sim_option *sim_demo_rows(size_t *n)
{
    *n = N_TABLE;
    return table;
}

void sim_demo_help(void)
{
    sim_option_help(table, N_TABLE, &help);
}
