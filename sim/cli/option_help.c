/* Two columns: an option with what stands for its value, and its sentence.
 *
 * SPDX-License-Identifier: MIT
 */
#include "option_help.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sim.h"

#define WIDTH 110   /* columns to a line */
#define LEFT_MAX 22 /* an option that takes more has its sentence on the next line */
#define INDENT 2

/* ---- Text that grows --------------------------------------------------------------------------------- */

static void add_n(char **text, const char *more, size_t n)
{
    const size_t at = *text != NULL ? strlen(*text) : 0;
    *text = sim_grow(*text, at + n + 1, 1);
    memcpy(*text + at, more, n);
    (*text)[at + n] = '\0';
}

static void add(char **text, const char *more)
{
    add_n(text, more, strlen(more));
}

/* Print text that begins at a column: further lines begin at `indent`. A line may end behind one of `ends`, which is
 * not printed there where it is a blank. Return the column behind it. */
static size_t wrap(const char *text, char ends, size_t column, size_t indent)
{
    for (int first = 1; *text != '\0'; first = 0) {
        const char stops[] = { ends, '\n', '\0' };
        const size_t length = strcspn(text, stops);
        const size_t all = length + (text[length] == ends && ends != ' ');
        if (!first && column + (ends == ' ') + all > WIDTH) {
            (void)printf("\n%*s", (int)indent, "");
            column = indent;
        } else if (!first && ends == ' ' && column > indent) {
            (void)putchar(' ');
            column++;
        }
        (void)printf("%.*s", (int)all, text);
        column += all;
        text += length;
        if (*text == '\n') {
            (void)printf("\n%*s", (int)indent, "");
            column = indent;
        }
        if (*text != '\0')
            text++;
    }
    return column;
}

static void print_lines(const char *text)
{
    (void)wrap(text, ' ', 0, 0);
    (void)putchar('\n');
}

/* ---- A row ------------------------------------------------------------------------------------------- */

static const char *value_of(const struct sim_option *opt)
{
    static const char *const by_kind[] = {
        [SIM_OPTION_FILE] = "FILE",    [SIM_OPTION_PATH] = "FILE",  [SIM_OPTION_TEXT] = "NAME",
        [SIM_OPTION_SIZE] = "WxH",     [SIM_OPTION_COUNT] = "N",    [SIM_OPTION_NUMBER] = "N",
        [SIM_OPTION_VECTOR] = "x,y,z", [SIM_OPTION_RGB] = "RRGGBB", [SIM_OPTION_CHOICE] = "WORD",
        [SIM_OPTION_TEXTS] = "TEXT",
        [SIM_OPTION_FLAG] = NULL,      [SIM_OPTION_HEADING] = NULL, [SIM_OPTION_WORD] = NULL,
    };
    return opt->words != NULL ? opt->words : opt->value != NULL ? opt->value : by_kind[opt->kind];
}

static int joins_next(const struct sim_option *table, size_t n, size_t k)
{
    return table[k].help != NULL && table[k].help[0] == '\0' && k + 1 < n && table[k + 1].kind < SIM_OPTION_HEADING;
}

/* The options of a row, and of those above it that it is told with. Return their number; *left: free() it. */
static size_t left_of(const struct sim_option *table, size_t n, size_t k, char **left)
{
    const size_t first = k;
    for (*left = NULL;; k++) {
        const char *value = value_of(&table[k]);
        add(left, k > first ? ", " : "");
        add(left, table[k].name);
        if (value != NULL) {
            add(left, " ");
            add(left, value);
        }
        if (!joins_next(table, n, k))
            return k + 1 - first;
    }
}

static void add_range(char **text, const struct sim_option *opt)
{
    char range[64];
    (void)snprintf(range, sizeof range, "%.10g to %.10g", opt->lo, opt->hi);
    add(text, range);
}

/* Where the brackets begin that a sentence ends with, the blank before them too; its end, where there are none. */
static size_t brackets(const char *help)
{
    const size_t n = strlen(help);
    int deep = 0;
    for (size_t at = n; n > 0 && help[n - 1] == ')' && at > 1; at--) {
        deep += (help[at - 1] == ')') - (help[at - 1] == '(');
        if (deep == 0)
            return help[at - 2] == ' ' ? at - 2 : at - 1;
    }
    return n;
}

/* The sentence, with the range and the names that there are; free() it. */
static char *right_of(const struct sim_option *opt)
{
    static const char place[] = "{range}";
    const char *help = opt->help != NULL ? opt->help : "";
    const char *here = strstr(help, place);
    char *text = NULL;
    if (opt->lo < opt->hi) {
        const size_t at = here != NULL ? (size_t)(here - help) : brackets(help);
        add_n(&text, help, at);
        add(&text, here != NULL || at == 0 ? "" : ", ");
        add_range(&text, opt);
        help += here != NULL ? at + sizeof place - 1 : at;
    }
    add(&text, help);
    if (opt->list != NULL) {
        add(&text, text[0] != '\0' ? "\n" : "");
        add(&text, opt->list());
    }
    return text;
}

/* Return how many rows of the table it was. */
static size_t print_row(const struct sim_option *table, size_t n, size_t k, size_t column)
{
    char *left;
    const size_t rows = left_of(table, n, k, &left);
    char *right = right_of(&table[k + rows - 1]);
    (void)printf("%*s", INDENT, "");
    size_t at = wrap(left, '|', INDENT, INDENT + strlen(table[k].name) + 1);
    if (right[0] != '\0' && at + 2 > column) {
        (void)putchar('\n');
        at = 0;
    }
    if (right[0] != '\0') {
        (void)printf("%*s", (int)(column - at), "");
        (void)wrap(right, ' ', column, column);
    }
    (void)putchar('\n');
    SIM_FREE(left, right);
    return rows;
}

/* ---- All of it --------------------------------------------------------------------------------------- */

/* Where sentences begin: behind the longest option that leaves room for them. */
static size_t column_of(const struct sim_option *table, size_t n)
{
    size_t most = 0;
    for (size_t k = 0; k < n;) {
        char *left;
        const size_t rows = left_of(table, n, k, &left), length = strlen(left);
        if (table[k].kind != SIM_OPTION_HEADING && length <= LEFT_MAX && length > most)
            most = length;
        free(left);
        k += rows;
    }
    return INDENT + most + 2;
}

void sim_option_help(const struct sim_option *table, size_t n, const struct sim_help *help)
{
    const size_t column = column_of(table, n);
    int values = 0;
    (void)printf("usage: ");
    (void)wrap(help->usage, ' ', 7, 7);
    (void)putchar('\n');
    print_lines(help->about);
    (void)putchar('\n');
    for (size_t k = 0; k < n;) {
        values |= value_of(&table[k]) != NULL;
        if (table[k].kind == SIM_OPTION_HEADING)
            print_lines(table[k++].name);
        else
            k += print_row(table, n, k, column);
    }
    (void)putchar('\n');
    if (values)
        print_lines("An option's value may follow after a space or an equals sign.");
    print_lines(help->closing);
}
