/* Rows of CSV: those in the making, those that were read back, and what boards counted for them.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_STUDY_ROWS_H
#define SIM_STUDY_ROWS_H

#include "study.h"

/* The names of a study's columns, in place of what the row held. */
void study_header(const struct study *study, struct study_text *row);

/* Has a row, which ends with its line or a 0, a result that no run gives, or other columns? *column: the first name. */
int study_damaged(const struct study *study, const char *row, struct study_text *column);

/* Is there a regular file, or none? */
int study_is_file(const char *path);

/* A file's text, with a 0 behind it, for free; *n: characters. NULL: it cannot be read, errno says why. */
char *study_read(const char *path, size_t *n);

/* Read rows back, for study_table_free in any case. SIM_OK; SIM_REFUSED, said why. */
int study_table_load(struct study_table *t, const struct study *study, enum study_effort effort, const char *path);
void study_table_free(struct study_table *t);

/* Read what boards counted, CORE=FILE with commas between, for study_counted. An exit status. */
int study_counts_load(const char *list);

#endif
