/* A table of them.
 *
 * SPDX-License-Identifier: MIT
 */
#include "settings.h"

#include <stdio.h>
#include <string.h>

#include "panel_model.h"

/* "panel" has the values that pm_glass_list names */
const struct view_setting view_settings[] = {
    { 's', "shading", "--shade" },
    { 'v', "visible surfaces", "--method", .usual_first = 1 },
    { 'd', "depth mapping", "--depth" },
    { 'b', "bits of a depth key", "--depth-bits", .usual = "16", .values = "14|12|11|10|9|8" },
    { 'r', "rows of a strip", "--strip", .values = "24|32|48|64|120|240|1|2|4|8|16" },
    { 't', "triangles at a time", "--tris", .usual = "ample", .values = "2000|1000|500|250|120|60|30|10" },
    { 'e', "vertices at a time", "--verts", .usual = "ample", .values = "2000|1000|500|250|120|60|30|10" },
    { 'n', "near plane", "--near", .factor = 1.25 },
    { 'o', "projection", "--projection", .usual_first = 1 },
    { 'c', "faces left out", "--cull", .usual_first = 1 },
    { 'l', "lines and points", "--style", .usual_first = 1 },
    { 'f', "false colours", "--show", .usual_first = 1 },
    { 'a', "accelerators", "--fast", .usual = "all", .values = "none" },
    { 'g', "panel", "--panel", .usual = "none", .values = "" },
    { 'k', "turned on the glass", "--rotate", .usual_first = 1 },
};
const int n_view_settings = sizeof view_settings / sizeof view_settings[0];

#define LIST_MAX 64
#define TEXT_MAX 1024

/* Values, cut at bars, commas and blanks. */
struct list {
    char text[TEXT_MAX];
    const char *at[LIST_MAX];
    int n;
};

static void list_of(struct list *list, const struct view_setting *s, const struct view_words *words)
{
    const struct sim_option *row = sim_option_find(words->table, words->n_table, s->option);
    const char *from = s->values == NULL ? row->words : s->values[0] == '\0' ? pm_glass_list() : s->values;
    list->n = 0;
    (void)snprintf(list->text, sizeof list->text, "%s", from);
    char *rest = list->text;
    for (char *at; (at = strsep(&rest, "|, ")) != NULL;)
        if (*at != '\0' && list->n < LIST_MAX)
            list->at[list->n++] = at;
}

int view_setting_there(const struct view_setting *s, const struct view_words *words)
{
    return sim_option_find(words->table, words->n_table, s->option) != NULL;
}

/* ---- Steps ------------------------------------------------------------------------------------------- */

static void step_number(const struct view_setting *s, struct view_words *words, const struct view_shot *shot, int back)
{
    const char *now = view_words_get(words, s->option);
    double value = shot->seen.view.near_z;
    char text[VIEW_VALUE_MAX];
    if (now != NULL)
        (void)sscanf(now, "%lf", &value);
    (void)snprintf(text, sizeof text, "%.4g", back ? value / s->factor : value * s->factor);
    view_words_set(words, s->option, text);
}

/* The size of the picture is the panel's, where there is one, and only that has what is its own. */
static void with_panel(struct view_words *words)
{
    static const char *const own[] = { "--rotate", "--invert", "--bgr" };
    if (view_words_get(words, "--panel") != NULL)
        view_words_set(words, "--size", NULL);
    for (size_t i = 0; view_words_get(words, "--panel") == NULL && i < sizeof own / sizeof own[0]; i++)
        view_words_set(words, own[i], NULL);
}

void view_setting_step(const struct view_setting *s, struct view_words *words, const struct view_shot *shot, int back)
{
    struct list list;
    if (s->factor > 0.0) {
        step_number(s, words, shot, back);
        return;
    }
    list_of(&list, s, words);
    const char *now = view_words_get(words, s->option);
    const int first = s->usual_first ? 0 : -1; /* where it is not given */
    int at = first;
    for (int i = 0; now != NULL && i < list.n; i++)
        at = strcmp(list.at[i], now) == 0 ? i : at;
    at += back ? -1 : 1;
    at = at < first ? list.n - 1 : at >= list.n ? first : at;
    view_words_set(words, s->option, at == first ? NULL : list.at[at]);
    if (strcmp(s->option, "--panel") == 0)
        with_panel(words);
}

/* ---- What is shown ----------------------------------------------------------------------------------- */

static const char *word_of(const struct view_words *words, const char *option, int number, char *text, size_t room)
{
    const char *at = sim_option_find(words->table, words->n_table, option)->words;
    for (; number > 0; number--)
        at = strchr(at, '|') + 1;
    (void)snprintf(text, room, "%.*s", (int)strcspn(at, "|"), at);
    return text;
}

void view_setting_text(const struct view_setting *s, const struct view_words *words, const struct view_shot *shot,
                       char text[VIEW_VALUE_MAX])
{
    const char *given = view_words_get(words, s->option);
    const int of_model = words->model != NULL;
    if (given != NULL)
        (void)snprintf(text, VIEW_VALUE_MAX, "%s", given);
    else if (s->usual != NULL)
        (void)snprintf(text, VIEW_VALUE_MAX, "%s", s->usual);
    else if (s->usual_first)
        (void)word_of(words, s->option, 0, text, VIEW_VALUE_MAX);
    else if (s->key == 's')
        (void)word_of(words, s->option, (int)shot->shade, text, VIEW_VALUE_MAX);
    else if (s->key == 'd')
        (void)word_of(words, s->option, (int)sim_depth_of(&shot->o, &shot->seen.view), text, VIEW_VALUE_MAX);
    else if (s->key == 'r')
        (void)snprintf(text, VIEW_VALUE_MAX, "%d", of_model ? 16 : 24);
    else
        (void)snprintf(text, VIEW_VALUE_MAX, "%.4g", shot->seen.view.near_z);
}
