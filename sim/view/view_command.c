/* Which words are taken, and --help.
 *
 * SPDX-License-Identifier: MIT
 */
#include "view_command.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "demo.h"
#include "option_help.h"
#include "scene_file.h"
#include "sim.h"
#include "view_loop.h"

/* Options of `zsim render` and `zsim demo` that are about files and numbers alone, or about many frames. */
static const char *const not_here[] = { "--depth-out", "--id-out", "--turntable", "--stats", "--explain",
                                        "--reference", "--compare", "--spi", "--raw", "--moving", "--delay",
                                        "--step", "--frames", NULL };

static int is_here(const char *name)
{
    for (int i = 0; not_here[i] != NULL; i++)
        if (strcmp(not_here[i], name) == 0)
            return 0;
    return 1;
}

/* The rows that are taken here. */
static void print_help(const struct sim_option *rows, size_t n)
{
    static const struct sim_help help = {
        "zsim view MODEL [options]\nzsim view --scene NAME [options]\nzsim view my_scene.c [MORE.c] [options]",
        "Shows a model or a demo scene in a window, as a board would draw it, with what it takes beside it. Drag to "
        "turn it, use the wheel to go nearer. Each setting has a key, which the window names; h shows all keys. p "
        "writes the picture and prints the command that draws it. A model is loaded again when its file changes. "
        "A scene's own file, of the form that make firmware APP_SCENE=my_scene.c takes, is compiled, and again when it "
        "or a header of it changes. A scene takes the options of zsim demo, a model those of zsim render:",
        "Exit status: 0 the window was closed; 1 refused, as without a desktop; 2 the command line makes no sense.",
    };
    struct sim_option *here = sim_alloc(n + 1, sizeof *here);
    size_t kept = 0;
    here[kept++] = (struct sim_option){ "--scene", SIM_OPTION_TEXT,
                                        .help = "a demo scene in place of a model, or a scene's own file; "
                                                "zsim demo --help lists scenes" };
    for (size_t i = 0; i < n; i++)
        if (is_here(rows[i].name)) {
            here[kept] = rows[i];
            if (strcmp(rows[i].name, "--out") == 0)
                here[kept].help = "the file that p writes (view.png); of a scene its folder (build/view)";
            kept++;
        }
    sim_option_help(here, kept, &help);
    free(here);
}

static int is_scene_file(const char *word)
{
    return word[0] != '-' && sim_scene_file_is(word);
}

/* One more file of the scene; behind them all there is no other --scene. */
static int take_scene_file(struct view_words *w, const char *file)
{
    const char *before = view_words_get(w, "--scene");
    char name[4096];
    (void)snprintf(name, sizeof name, "%.2000s%s%.2000s", before != NULL ? before : "", before != NULL ? " " : "",
                   file);
    view_words_set(w, "--scene", name);
    return SIM_OK;
}

/* Are the words for a scene's own file all that speaks of a scene? */
static int check_scene_file(const struct view_words *w, int argc, char **argv)
{
    const char *file = NULL, *name = NULL;
    for (int i = 0; i < argc && strcmp(argv[i], "--") != 0; i++) {
        file = is_scene_file(argv[i]) && (i == 0 || strcmp(argv[i - 1], "--scene") != 0) ? argv[i] : file;
        name = strncmp(argv[i], "--scene", 7) == 0 ? argv[i] : name;
    }
    return file != NULL && name != NULL ? sim_usage("--scene or the scene %s: leave one out", file)
           : file != NULL && w->model != NULL ? sim_usage("%s or the model %s: leave one out", file, w->model)
                                              : SIM_OK;
}

static int parse(struct view_words *w, int argc, char **argv, int *help)
{
    int only_names = 0, status = SIM_OK, scene = 0;
    for (int i = 0; i < argc && strcmp(argv[i], "--") != 0; i++)
        scene |= (strncmp(argv[i], "--scene", 7) == 0 && (argv[i][7] == '=' || argv[i][7] == '\0')) ||
                 is_scene_file(argv[i]);
    w->table = scene ? sim_demo_rows(&w->n_table) : sim_options_rows(&w->n_table);
    for (int i = 0; status == SIM_OK && !*help && i < argc; i++) {
        const struct sim_option *row = sim_option_find(w->table, w->n_table, argv[i]);
        *help = !only_names && (strcmp(argv[i], "-h") == 0 || strcmp(argv[i], "--help") == 0);
        if (*help)
            break;
        if (!only_names && row != NULL && !is_here(row->name))
            return sim_usage("%s has no use in a window: leave it out", row->name);
        status = !only_names && sim_is_option(argv[i]) ? view_words_take(w, argc, argv, &i)
                 : is_scene_file(argv[i])              ? take_scene_file(w, argv[i])
                                                       : sim_model_take(&w->model, argv[i], &only_names);
    }
    if (status != SIM_OK || *help)
        return status;
    status = check_scene_file(w, argc, argv);
    if (status != SIM_OK)
        return status;
    const char *name = view_words_get(w, "--scene");
    if (scene && (name == NULL || name[0] == '\0')) /* NULL: the word is another option's value */
        return sim_usage("--scene wants a name, not ''");
    if (scene && w->model != NULL)
        return sim_usage("--scene %s or the model %s: leave one out", name, w->model);
    if (!scene && (w->model == NULL || w->model[0] == '\0'))
        return sim_usage("a model is missing: zsim view MODEL, zsim view --scene NAME or zsim view my_scene.c");
    if (scene && strchr(name, ',') != NULL)
        return sim_usage("one scene at a time: --scene %s", name);
    if (view_words_get(w, "--out") == NULL)
        view_words_set(w, "--out", scene ? "build/view" : "view.png");
    if (scene && view_words_get(w, "--start") == NULL)
        view_words_set(w, "--start", "0");
    if (scene)
        view_words_set(w, "--frames", "1");
    return SIM_OK;
}

int sim_view(int argc, char **argv)
{
    struct view_words words = { 0 };
    int help = 0, status = parse(&words, argc, argv, &help);
    if (status == SIM_OK && help)
        print_help(words.table, words.n_table);
    else if (status == SIM_OK)
        status = view_loop(&words);
    view_words_free(&words);
    return status;
}
