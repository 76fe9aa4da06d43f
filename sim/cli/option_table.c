/* One function for each kind of value. A value that is not of its kind is a usage error; one that is, but lies outside
 * its range, is refused.
 *
 * SPDX-License-Identifier: MIT
 */
#include "option_table.h"

#include <math.h>
#include <string.h>

#include "sim.h"
#include "value.h"

#define COORD_MAX 1e30 /* keeps products of three lengths inside a double */

static int take_count(const char *text, const char *words, long *count)
{
    const char *end;
    return (words == NULL || sim_value_choice(text, words) >= 0) && sim_value_long(text, &end, count) &&
           *end == '\0';
}

static int take_text(const char *text, struct sim_texts *texts)
{
    if (text[0] == '\0' || texts->n == SIM_TEXTS_MAX)
        return 0;
    texts->text[texts->n++] = text;
    return 1;
}

/* A value into its place; 0 where it is not of its option's kind. */
static int take_value(const struct sim_option *opt, const char *text, void *to)
{
    const char *end;
    int word;
    switch (opt->kind) {
    case SIM_OPTION_FILE:
    case SIM_OPTION_PATH:
    case SIM_OPTION_TEXT:
        *(const char **)to = text;
        return text[0] != '\0';
    case SIM_OPTION_TEXTS:
        return take_text(text, to);
    case SIM_OPTION_SIZE:
        return sim_value_size(text, to);
    case SIM_OPTION_COUNT:
        return take_count(text, opt->words, to);
    case SIM_OPTION_NUMBER:
        return sim_value_double(text, '\0', &end, to);
    case SIM_OPTION_VECTOR:
        return sim_value_vector(text, to);
    case SIM_OPTION_RGB:
        return sim_value_rgb(text, to);
    case SIM_OPTION_CHOICE:
        word = sim_value_choice(text, opt->words);
        *(int *)to = word >= 0 ? word : 0;
        return word >= 0;
    case SIM_OPTION_FLAG:
    case SIM_OPTION_HEADING:
    case SIM_OPTION_WORD:
        break;
    }
    return 0;
}

static const char *wanted(const struct sim_option *opt)
{
    static const char *const names[] = {
        [SIM_OPTION_FILE] = "a file name",     [SIM_OPTION_PATH] = "a file or folder",
        [SIM_OPTION_TEXT] = "a name",
        [SIM_OPTION_SIZE] = "WIDTHxHEIGHT",    [SIM_OPTION_COUNT] = "a whole number",
        [SIM_OPTION_NUMBER] = "a number",      [SIM_OPTION_VECTOR] = "numbers x,y,z",
        [SIM_OPTION_RGB] = "a colour RRGGBB",  [SIM_OPTION_CHOICE] = "a word",
        [SIM_OPTION_FLAG] = "no value",        [SIM_OPTION_TEXTS] = "a value, at most 8 times",
    };
    return opt->words != NULL ? opt->words : names[opt->kind];
}

const struct sim_option *sim_option_find(const struct sim_option *table, size_t n, const char *arg)
{
    const size_t length = strcspn(arg, "=");
    for (size_t k = 0; k < n; k++)
        if (table[k].kind < SIM_OPTION_HEADING && strlen(table[k].name) == length &&
            memcmp(table[k].name, arg, length) == 0)
            return &table[k];
    return NULL;
}

int sim_option_take(const struct sim_option *table, size_t n, void *to, char *seen, int argc, char **argv, int *i)
{
    const char *arg = argv[*i];
    const size_t length = strcspn(arg, "=");
    const struct sim_option *opt = sim_option_find(table, n, arg);
    if (opt == NULL)
        return sim_usage("unknown option '%s'", arg);
    char *base = to;
    const char *value = arg[length] == '=' ? arg + length + 1 : NULL;
    seen[opt - table] = 1;
    if (opt->kind == SIM_OPTION_FLAG && value == NULL) {
        *(int *)(void *)(base + opt->to) = 1;
        return SIM_OK;
    }
    if (value == NULL && *i + 1 >= argc)
        return sim_usage("%s wants a value: %s", opt->name, wanted(opt));
    if (value == NULL)
        value = argv[++*i];
    if (!take_value(opt, value, base + opt->to))
        return sim_usage("%s wants %s, not '%s'", opt->name, wanted(opt), value);
    if (opt->has != 0)
        *(int *)(void *)(base + opt->has) = 1;
    return SIM_OK;
}

int sim_options_take(const struct sim_option *table, size_t n, void *to, char *seen, int argc, char **argv,
                     int first)
{
    int status = SIM_OK;
    for (int i = first; status == SIM_OK && i < argc; i++)
        status = sim_option_take(table, n, to, seen, argc, argv, &i);
    return status;
}

static int size_in_range(const struct sim_option *opt, const long size[2], const char *file)
{
    for (int k = 0; opt->lo < opt->hi && k < 2; k++)
        if ((double)size[k] < opt->lo || (double)size[k] > opt->hi)
            return sim_refuse(file, 0, "%s %ldx%ld: the frame must be %g to %g px wide and high", opt->name, size[0],
                              size[1], opt->lo, opt->hi);
    return SIM_OK;
}

/* What is understood and still cannot be done. */
static int in_range(const struct sim_option *opt, const void *at, const char *file)
{
    const int is_number = opt->kind == SIM_OPTION_NUMBER, is_vector = opt->kind == SIM_OPTION_VECTOR;
    const double *v = at;
    if (opt->kind == SIM_OPTION_SIZE)
        return size_in_range(opt, at, file);
    for (int k = 0; is_number || (is_vector && k < 3); k++) {
        if (!isfinite(v[k]))
            return sim_refuse(
                file, 0, "%s holds a number that is not finite; give ordinary numbers", opt->name);
        if (fabs(v[k]) > COORD_MAX)
            return sim_refuse(file, 0, "%s %g is beyond %g; scale the scene down", opt->name, v[k],
                              COORD_MAX);
        if (is_number)
            break;
    }
    const double value = is_number                         ? v[0]
                         : opt->kind == SIM_OPTION_COUNT ? (double)*(const long *)at
                                                           : 0.0;
    if (opt->lo < opt->hi && (value < opt->lo || value > opt->hi))
        return sim_refuse(file, 0, "%s %g is outside its range, %g to %g", opt->name, value,
                          opt->lo, opt->hi);
    return SIM_OK;
}

int sim_options_in_range(const struct sim_option *table, size_t n, const void *at, const char *seen, const char *file)
{
    int status = SIM_OK;
    for (size_t k = 0; status == SIM_OK && k < n; k++)
        if (seen[k])
            status = in_range(&table[k], (const char *)at + table[k].to, file);
    return status;
}

int sim_is_option(const char *arg)
{
    return arg[0] == '-' && arg[1] != '\0' && strcmp(arg, "--") != 0;
}

int sim_model_take(const char **model, const char *arg, int *only_names)
{
    if (!*only_names && strcmp(arg, "--") == 0) {
        *only_names = 1;
        return SIM_OK;
    }
    if (*model != NULL)
        return sim_usage("one model at a time: '%s' is one too many", arg);
    *model = arg;
    return SIM_OK;
}
