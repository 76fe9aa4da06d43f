/* `zsim study`: sweeps over settings. A study is a list of runs; a run is a row of CSV: parameters, then what was
 * measured. The command (study.c) plans, resumes, shards and merges; the page (study_page.c) plots and explains.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_STUDY_H
#define SIM_STUDY_H

#include <stddef.h>
#include <stdio.h>

/* The command. Return an exit status. */
int sim_study(int argc, char **argv);

enum study_effort { STUDY_QUICK, STUDY_USUAL, STUDY_FULL };

/* The fields of a row in the making. */
struct study_text {
    char text[1024];
    size_t n; /* characters */
};

/* Add a field: no comma, quote or line end in it. Numbers: "%.5g" and the like, so that rows are the same bytes
 * wherever doubles are. */
void study_put(struct study_text *row, const char *format, ...) __attribute__((format(printf, 2, 3)));
void study_skip(struct study_text *row, int n); /* n empty fields */

/* Rows of one study that were read back. */
struct study_table {
    const struct study *study;
    enum study_effort effort;
    size_t n_rows, n_columns;
    const char **cell; /* [n_rows][n_columns] */
    char *bytes;       /* what the cells point into */
};

const char *study_cell(const struct study_table *t, size_t row, const char *column); /* there must be such a column */
double study_number(const struct study_table *t, size_t row, const char *column);    /* NAN where it is empty */
/* The first row that has the most of a column; NAN is never it. */
size_t study_most(const struct study_table *t, const char *column);
int study_is(const struct study_table *t, size_t row, const char *column, const char *text);

struct study_page;

struct study {
    const char *name, *what;
    const char *params, *results; /* names of columns with commas between; the first four come before: see study.c */
    size_t (*runs)(enum study_effort effort);             /* how many; also makes the plan that the next two look at */
    void (*describe)(size_t run, struct study_text *row); /* the parameters */
    int (*measure)(size_t run, struct study_text *row);   /* the results. SIM_OK; SIM_REFUSED, said why */
    int (*report)(struct study_page *page, const struct study_table *t); /* plots, pictures and what follows */
    void (*settings)(size_t run,
                     FILE *out); /* the run as a struct setting of firmware/app/study.c; NULL: on no board */
};

extern const struct study study_depth, study_memory, study_stability, study_time;

/* Instructions that a board counted for a run (--counts CORE=FILE). 0: none were given for this core and run.
 * *checksum: of the frame that the board drew. */
unsigned long long study_counted(const char *core, size_t run, unsigned long long *checksum);
/* Which cores were counted, "m0+m3", or "none". Static storage. */
const char *study_cores(void);

/* ---- The page (study_page.c) ------------------------------------------------------------------------------- */

/* Open and close the section of a study in DIR; closing makes index.html of all sections there
 * are. NULL, SIM_REFUSED: said why; also where gnuplot is missing, and all but the plots was written. */
struct study_page *study_page_open(const char *dir, const struct study *study, size_t runs);
int study_page_close(struct study_page *page, int status);

/* A paragraph, a heading of a part; text as HTML. */
void study_say(struct study_page *page, const char *format, ...) __attribute__((format(printf, 2, 3)));
void study_head(struct study_page *page, const char *title);

/* A plot: gnuplot's commands and data go to the file; the terminal is set. */
FILE *study_plot_open(struct study_page *page, const char *name, int width, int height);
int study_plot_close(struct study_page *page, const char *caption);

/* A picture, [height][width][3], as DIR/STUDY-NAME.png and in the page. */
int study_picture(struct study_page *page, const char *name, unsigned width, unsigned height, const unsigned char *rgb,
                  const char *caption);

/* A table: columns with bars between, then rows. */
void study_table_open(struct study_page *page, const char *columns);
void study_table_row(struct study_page *page, const char *format, ...) __attribute__((format(printf, 2, 3)));
void study_table_close(struct study_page *page, const char *caption);

#endif
