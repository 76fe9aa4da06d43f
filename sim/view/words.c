/* Words.
 *
 * SPDX-License-Identifier: MIT
 */
#include "words.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sim.h"

static char *join(const char *a, const char *b, const char *c)
{
    const size_t n = strlen(a) + strlen(b) + strlen(c) + 1;
    char *text = sim_alloc(n, 1);
    (void)snprintf(text, n, "%s%s%s", a, b, c);
    return text;
}

void view_words_free(struct view_words *w)
{
    for (int i = 0; i < w->n; i++) {
        free(w->text[i]);
        w->text[i] = NULL;
    }
    w->n = 0;
}

void view_words_copy(struct view_words *to, const struct view_words *from)
{
    view_words_free(to);
    *to = *from;
    for (int i = 0; i < to->n; i++)
        to->text[i] = join(from->text[i], "", "");
}

static int is_named(const char *text, const char *name)
{
    const size_t n = strlen(name);
    return strncmp(text, name, n) == 0 && (text[n] == '=' || text[n] == '\0');
}

static void drop(struct view_words *w, const char *name)
{
    int kept = 0;
    for (int i = 0; i < w->n; i++) {
        if (is_named(w->text[i], name))
            free(w->text[i]);
        else
            w->text[kept++] = w->text[i];
    }
    for (int i = kept; i < w->n; i++)
        w->text[i] = NULL;
    w->n = kept;
}

int view_words_take(struct view_words *w, int argc, char **argv, int *i)
{
    const char *arg = argv[*i];
    const struct sim_option *row = sim_option_find(w->table, w->n_table, arg);
    const int has_value = strchr(arg, '=') != NULL;
    if (row == NULL)
        return sim_usage("unknown option '%s'", arg);
    if (row->kind != SIM_OPTION_FLAG && !has_value && *i + 1 >= argc)
        return sim_usage("%s wants a value", arg);
    if (row->kind != SIM_OPTION_TEXTS)
        drop(w, row->name);
    if (w->n == VIEW_WORDS_MAX)
        return sim_usage("too many options");
    const int more = row->kind != SIM_OPTION_FLAG && !has_value;
    w->text[w->n++] = join(arg, more ? "=" : "", more ? argv[++*i] : "");
    return SIM_OK;
}

const char *view_words_get(const struct view_words *w, const char *name)
{
    for (int i = 0; i < w->n; i++)
        if (is_named(w->text[i], name)) {
            const char *value = w->text[i] + strlen(name);
            return *value == '=' ? value + 1 : value;
        }
    return NULL;
}

void view_words_set(struct view_words *w, const char *name, const char *value)
{
    int at = 0;
    while (at < w->n && !is_named(w->text[at], name))
        at++;
    if (value == NULL || at == VIEW_WORDS_MAX) {
        drop(w, name);
        return;
    }
    char *text = join(name, value[0] != '\0' ? "=" : "", value);
    if (at < w->n)
        free(w->text[at]); /* it keeps its place */
    else
        w->n++;
    w->text[at] = text;
}

int view_words_argv(const struct view_words *w, char *argv[VIEW_ARGV_MAX])
{
    int n = 0;
    for (; n < w->n; n++)
        argv[n] = w->text[n];
    if (w->model != NULL) {
        argv[n++] = (char *)(uintptr_t) "--";
        argv[n++] = (char *)(uintptr_t)w->model;
    }
    argv[n] = NULL;
    return n;
}

/* A word as a shell takes it. */
static void add_word(char *line, const char *word)
{
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+./,:=@%";
    char *to = line + strlen(line);
    if (to > line)
        *to++ = ' ';
    if (word[0] != '\0' && word[strspn(word, plain)] == '\0') {
        (void)strcpy(to, word);
        return;
    }
    *to++ = '\'';
    for (; *word != '\0'; word++) {
        if (*word == '\'')
            to = stpcpy(to, "'\\''");
        else
            *to++ = *word;
    }
    *to++ = '\'';
    *to = '\0';
}

char *view_words_line(const struct view_words *w, const char *command, const char *const *but)
{
    size_t n = strlen(command) + 8 + (w->model != NULL ? 4 * strlen(w->model) + 16 : 0);
    for (int i = 0; i < w->n; i++)
        n += 4 * strlen(w->text[i]) + 3;
    char *line = sim_alloc(n, 1);
    (void)strcpy(line, command);
    const int dashed = w->model != NULL && w->model[0] == '-';
    if (w->model != NULL && !dashed)
        add_word(line, w->model);
    for (int i = 0; i < w->n; i++) {
        const char *const *k = but;
        while (*k != NULL && !is_named(w->text[i], *k))
            k++;
        if (*k == NULL)
            add_word(line, w->text[i]);
    }
    if (dashed) {
        add_word(line, "--");
        add_word(line, w->model);
    }
    return line;
}
