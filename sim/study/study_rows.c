/* Rows of CSV, and tables of them: see study_rows.h.
 *
 * SPDX-License-Identifier: MIT
 */
#include "study_rows.h"

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "sim.h"

#define COMMON "study,build,effort,run"

void study_put(struct study_text *row, const char *format, ...)
{
    va_list args;
    if (row->n > 0 && row->n + 1 < sizeof row->text)
        row->text[row->n++] = ',';
    va_start(args, format);
    const int n = vsnprintf(row->text + row->n, sizeof row->text - row->n, format, args);
    va_end(args);
    row->n += n < 0 ? 0 : (size_t)n;
    if (row->n >= sizeof row->text) {
        (void)sim_refuse(NULL, 0, "a row of a study is too long");
        exit(SIM_REFUSED);
    }
}

void study_skip(struct study_text *row, int n)
{
    for (; n > 0; n--)
        study_put(row, "%s", "");
}

void study_header(const struct study *study, struct study_text *row)
{
    row->n = 0;
    study_put(row, "%s", COMMON);
    study_put(row, "%s", study->params);
    study_put(row, "%s", study->results);
}

/* Is a cell of results what a run may give: nothing, a number, or the letters of these columns? */
static int is_result(const char *column, size_t length, const char *cell, size_t n)
{
    static const char *const letters[][2] = { { "checksum", "0123456789abcdef" },
                                              { "status", "ABCDEFGHIJKLMNOPQRSTUVWXYZ_" } };
    for (size_t k = 0; k < sizeof letters / sizeof letters[0]; k++)
        if (strlen(letters[k][0]) == length && !memcmp(letters[k][0], column, length))
            return strspn(cell, letters[k][1]) == n;
    char *end;
    const double value = n ? strtod(cell, &end) : 0.0;
    return n == 0 || (end == cell + n && isfinite(value));
}

int study_damaged(const struct study *study, const char *row, struct study_text *column)
{
    struct study_text head;
    study_header(study, &head);
    const char *const results = head.text + strlen(COMMON ",") + strlen(study->params) + 1;
    const char *name = head.text, *cell = row;
    for (int more = 1; more;) {
        const size_t length = strcspn(name, ","), n = strcspn(cell, ",\n");
        more = name[length] == ',';
        if ((name >= results && !is_result(name, length, cell, n)) || (cell[n] == ',') != more) {
            column->n = 0;
            study_put(column, "%.*s", (int)length, name);
            return 1;
        }
        name += length + 1;
        cell += n + 1;
    }
    return 0;
}

/* ---- Tables ------------------------------------------------------------------------------------------------------ */

static size_t count_commas(const char *text)
{
    size_t n = 0;
    for (; *text; text++)
        n += *text == ',';
    return n;
}

static size_t column_of(const struct study *study, const char *name)
{
    struct study_text head;
    const size_t length = strlen(name);
    size_t k = 0;
    study_header(study, &head);
    for (const char *at = head.text; at; k++) {
        const char *comma = strchr(at, ',');
        const size_t n = comma ? (size_t)(comma - at) : strlen(at);
        if (n == length && !memcmp(at, name, n))
            return k;
        at = comma ? comma + 1 : NULL;
    }
    (void)sim_refuse(NULL, 0, "study %s has no column %s", study->name, name);
    abort();
}

const char *study_cell(const struct study_table *t, size_t row, const char *column)
{
    return t->cell[row * t->n_columns + column_of(t->study, column)];
}

double study_number(const struct study_table *t, size_t row, const char *column)
{
    const char *text = study_cell(t, row, column);
    char *end;
    const double v = strtod(text, &end);
    return end == text || *end ? (double)NAN : v;
}

size_t study_most(const struct study_table *t, const char *column)
{
    size_t most = 0;
    for (size_t r = 1; r < t->n_rows; r++)
        if (study_number(t, r, column) > study_number(t, most, column))
            most = r;
    return most;
}

int study_is(const struct study_table *t, size_t row, const char *column, const char *text)
{
    return !strcmp(study_cell(t, row, column), text);
}

int study_is_file(const char *path)
{
    struct stat st;
    return stat(path, &st) ? errno == ENOENT : S_ISREG(st.st_mode);
}

char *study_read(const char *path, size_t *n)
{
    FILE *f = fopen(path, "rb");
    size_t room = 65536;
    if (!f)
        return NULL;
    char *text = sim_alloc(room, 1);
    *n = 0;
    for (size_t got; (got = fread(text + *n, 1, room - *n - 1, f)) > 0;)
        if (*n += got, room - *n < 2)
            text = sim_grow(text, room *= 2, 1);
    text[*n] = '\0';
    const int bad = ferror(f);
    (void)fclose(f);
    if (bad) {
        free(text);
        return NULL;
    }
    return text;
}

int study_table_load(struct study_table *t, const struct study *study, enum study_effort effort, const char *path)
{
    size_t n;
    struct study_text head;
    memset(t, 0, sizeof *t);
    t->bytes = study_read(path, &n);
    if (!t->bytes)
        return sim_refuse(path, 0, "cannot be read: %s", strerror(errno));
    study_header(study, &head);
    t->study = study;
    t->effort = effort;
    t->n_columns = count_commas(head.text) + 1;
    for (const char *at = strchr(t->bytes, '\n'); at && at[1]; at = strchr(at + 1, '\n'))
        t->n_rows++;
    t->cell = sim_alloc(t->n_rows * t->n_columns, sizeof *t->cell);
    char *at = strchr(t->bytes, '\n');
    for (size_t r = 0; at && r < t->n_rows; r++)
        for (size_t c = 0; c < t->n_columns; c++) {
            *at++ = '\0';
            t->cell[r * t->n_columns + c] = at;
            at += strcspn(at, ",\n");
        }
    if (at)
        *at = '\0';
    return SIM_OK;
}

void study_table_free(struct study_table *t)
{
    free(t->cell);
    free(t->bytes);
}
