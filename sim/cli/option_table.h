/* Options of a command line by a table: a value goes to its place in a struct. `--name value` and `--name=value`.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_OPTION_TABLE_H
#define SIM_OPTION_TABLE_H

#include <stddef.h>

enum sim_option_kind {
    SIM_OPTION_FILE,   /* const char *, not empty */
    SIM_OPTION_PATH,   /* the same, of a file or a folder */
    SIM_OPTION_TEXT,   /* the same, of something else */
    SIM_OPTION_SIZE,   /* long[2] */
    SIM_OPTION_COUNT,  /* long */
    SIM_OPTION_NUMBER, /* double */
    SIM_OPTION_VECTOR, /* double[3] */
    SIM_OPTION_RGB,    /* struct zs_rgb */
    SIM_OPTION_CHOICE, /* int or an enum: the number of the word */
    SIM_OPTION_FLAG,   /* int */
    SIM_OPTION_TEXTS,  /* struct sim_texts: it may be given several times */
    /* Rows of --help alone, which no argument matches: */
    SIM_OPTION_HEADING, /* name: the heading of the rows below it */
    SIM_OPTION_WORD     /* name: a word that is no option, such as MODEL */
};

#define SIM_TEXTS_MAX 8
struct sim_texts {
    const char *text[SIM_TEXTS_MAX];
    int n;
};

struct sim_option {
    const char *name;
    enum sim_option_kind kind;
    size_t to;         /* offset of the value */
    size_t has;        /* offset of an int that becomes 1; 0: none */
    double lo, hi;     /* range of a count, number or side, both ends inside; equal: none */
    const char *words; /* "a|b|c": choices, or the only counts there are; else NULL */
    int use;           /* flags of the program's own, which nothing here reads */

    /* For --help (option_help.h). The words and the range are told from the fields above: a sentence leaves them out */
    const char *value;         /* what stands for the value, such as ROWS; NULL: the words, or one by kind */
    const char *help;          /* a sentence, its default in brackets at its end. The range is put before these, or in
                                * the place of "{range}"; a line feed begins a new line. "": the next row's, and both
                                * are named on one line */
    const char *(*list)(void); /* names that there are, told on lines of their own behind the sentence; NULL: none */
};

/* Rows of a program's own table, which is called so. */
#define N_TABLE (sizeof table / sizeof table[0])
/* The rows that every table ends with: a flag at the offset `to`. */
#define SIM_HELP_OPTIONS(to) \
    { "-h", SIM_OPTION_FLAG, to, .help = "" }, { "--help", SIM_OPTION_FLAG, to, .help = "this text" }

/* The row of the option that `arg` names, with a value behind an equals sign or not; NULL: there is none. */
const struct sim_option *sim_option_find(const struct sim_option *table, size_t n, const char *arg);

/* The option at argv[*i], with its value, into the struct at `to`; *i is at the last word that was taken. seen[k]
 * becomes 1 for row k of the table. SIM_OK; SIM_USAGE where there is no such option or its value is not of its kind. */
int sim_option_take(const struct sim_option *table, size_t n, void *to, char *seen, int argc, char **argv, int *i);
/* All words from argv[first] on, in the same way, to the first that cannot be taken. */
int sim_options_take(const struct sim_option *table, size_t n, void *to, char *seen, int argc, char **argv,
                     int first);

/* Do the options that were seen lie in their ranges? SIM_OK; SIM_REFUSED, said why about `file`. */
int sim_options_in_range(const struct sim_option *table, size_t n, const void *at, const char *seen, const char *file);

/* Is an argument an option? Not a lone "-", a name, nor "--", behind which all are names. */
int sim_is_option(const char *arg);

/* Any other argument: "--", which *only_names notes, or the name of a model, of which there is one. SIM_OK; SIM_USAGE,
 * said why. */
int sim_model_take(const char **model, const char *arg, int *only_names);

#endif
