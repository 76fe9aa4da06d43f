/* A command line that changes: options by name, each as it would be typed. What a window shows is what these words
 * draw, so that they can be printed and run.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_VIEW_WORDS_H
#define SIM_VIEW_WORDS_H

#include <stddef.h>

#include "option_table.h"

#define VIEW_WORDS_MAX 96

struct view_words {
    const struct sim_option *table; /* what options there are */
    size_t n_table;
    const char *model; /* behind them; NULL: none. Borrowed */
    char *text[VIEW_WORDS_MAX + 3]; /* "--name=value" or "--name"; malloc'ed, the rest is NULL */
    int n;
};

void view_words_free(struct view_words *w);
/* *to is freed first. */
void view_words_copy(struct view_words *to, const struct view_words *from);

/* Add the option at argv[*i] with its value, in place of what it was before; *i is at the last word that was taken.
 * SIM_OK; SIM_USAGE, said why: no such option, or no value. */
int view_words_take(struct view_words *w, int argc, char **argv, int *i);

/* The value of an option, "" of a flag; NULL: it is not given. */
const char *view_words_get(const struct view_words *w, const char *name);
/* Give it another value, as text; NULL: it is no longer given. */
void view_words_set(struct view_words *w, const char *name, const char *value);

/* Arguments for the command that the table is of: pointers to the words, the last one NULL. Return their number. */
#define VIEW_ARGV_MAX (VIEW_WORDS_MAX + 3)
int view_words_argv(const struct view_words *w, char *argv[VIEW_ARGV_MAX]);

/* As a line for a shell: command, model, options but those named in `but` (the last one NULL), free() it. */
char *view_words_line(const struct view_words *w, const char *command, const char *const *but);

#endif
