/* --help of every command against what its parser takes, found by trying every option that any source of sim/ names:
 * none is missing and none is named that is not taken; words and ranges are those that the parser's refusals tell. And
 * how a page is laid out.
 *
 * SPDX-License-Identifier: MIT
 */
#define _GNU_SOURCE
#include "cases.h"

#include <glob.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "budget.h"
#include "convert.h"
#include "costs_fit.h"
#include "demo.h"
#include "gallery.h"
#include "linux_options.h"
#include "option_help.h"
#include "panel_decode.h"
#include "render.h"
#include "sim.h"
#include "study.h"
#include "try.h"
#include "view_command.h"

#define WIDTH 110
#define OPTIONS_MAX 1024 /* that sources name */
#define WORDS_MAX 8

/* ---- Commands ---------------------------------------------------------------------------------------- */

static int zstrip_linux(int argc, char **argv)
{
    struct linux_options o;
    char *with_name[WORDS_MAX + 2] = { (char *)"zstrip-linux" };
    memcpy(with_name + 1, argv, (size_t)argc * sizeof *argv);
    const int status = linux_options_parse(&o, argc + 1, with_name);
    if (status == SIM_OK && o.help)
        linux_options_help();
    return status;
}

/* What a value out of its range is tried with: words that lead to where ranges are checked, and no further. */
static const struct command {
    const char *name;
    int (*run)(int argc, char **argv);
    const char *words[WORDS_MAX - 2];
    int words_first; /* it reads options once its words are complete */
} commands[] = {
    { "zsim try", sim_try, { "none.obj" } },
    { "zsim render", sim_render, { "none.obj", "--out", "none/none.png" } },
    { "zsim convert", sim_convert, { "none.obj", "--name", "a", "--out", "none" } },
    { "zsim demo", sim_demo, { "--scene", "none" } },
    { "zsim gallery", sim_gallery, { "--m3", "none", "none" } },
    { "zsim view", sim_view, { "none.obj" }, .words_first = 1 },
    { "zsim panel", sim_panel, { NULL } },
    { "zsim budget", sim_budget, { "none.obj" } },
    { "zsim study", sim_study, { "none" } },
    { "zlab costs", sim_costs, { "--scene", "none" } },
    { "zstrip-linux", zstrip_linux, { NULL } },
};
#define N_COMMANDS (sizeof commands / sizeof commands[0])

static char said[65536];

/* What a call prints to a descriptor, in `said`. */
static void said_begin(int *kept, int to)
{
    const int made = memfd_create("said", 0);
    (void)fflush(NULL);
    assert_true(made >= 0);
    *kept = dup(to);
    assert_true(*kept >= 0 && dup2(made, to) == to);
    assert_int_equal(close(made), 0);
}

static void said_end(int kept, int to)
{
    (void)fflush(NULL);
    const ssize_t n = pread(to, said, sizeof said - 1, 0);
    assert_int_equal(dup2(kept, to), to);
    assert_int_equal(close(kept), 0);
    assert_true(n >= 0 && (size_t)n < sizeof said - 1);
    said[n] = '\0';
}

/* A command with its own words or not, then one argument. `said` is what it prints to `to`. */
static int run(const struct command *c, int own, const char *argument, int to)
{
    char *argv[WORDS_MAX + 1] = { NULL };
    int argc = 0, kept;
    while (own && c->words[argc] != NULL) {
        argv[argc] = (char *)c->words[argc];
        argc++;
    }
    argv[argc++] = (char *)argument;
    said_begin(&kept, to);
    const int status = c->run(argc, argv);
    said_end(kept, to);
    return status;
}

/* ---- Options that sources name ----------------------------------------------------------------------- */

static char *options[OPTIONS_MAX];
static size_t n_options;

static void note_option(const char *at, size_t length)
{
    char name[64];
    assert_true(length < sizeof name && n_options < OPTIONS_MAX);
    memcpy(name, at, length);
    name[length] = '\0';
    for (size_t i = 0; i < n_options; i++)
        if (strcmp(options[i], name) == 0)
            return;
    options[n_options++] = strdup(name);
}

static void read_source(const char *name)
{
    static char text[1 << 20];
    FILE *f = fopen(name, "r");
    assert_non_null(f);
    const size_t n = fread(text, 1, sizeof text - 1, f);
    assert_true(n < sizeof text - 1);
    assert_int_equal(fclose(f), 0);
    text[n] = '\0';
    for (const char *at = text; (at = strstr(at, "\"-")) != NULL; at++) {
        const size_t length = 1 + strspn(at + 2, "abcdefghijklmnopqrstuvwxyz0123456789-");
        if (at[1 + length] == '"' && length > 1 && strspn(at + 1, "-") < length)
            note_option(at + 1, length);
    }
}

static int find_options(void **state)
{
    static const char *const where[] = { "sim/*/*.c", "sim/*/*.h" };
    for (int k = 0; k < 2; k++) {
        glob_t found;
        assert_int_equal(glob(where[k], 0, NULL, &found), 0);
        for (size_t i = 0; i < found.gl_pathc; i++)
            read_source(found.gl_pathv[i]);
        globfree(&found);
    }
    return n_options < 100; /* it is not that there are none */
}

static int free_options(void **state)
{
    while (n_options > 0)
        free(options[--n_options]);
    return 0;
}

/* ---- Pages ------------------------------------------------------------------------------------------- */

/* An option as --help names it. */
struct row {
    char name[64], value[256], sentence[4096];
};
struct page {
    struct row row[256];
    size_t n;
};

/* Options with their values, commas between; their sentences are still empty. */
static void read_left(struct page *p, const char *left)
{
    while (*left != '\0') {
        struct row *row = &p->row[p->n++];
        assert_true(p->n <= sizeof p->row / sizeof p->row[0]);
        memset(row, 0, sizeof *row);
        size_t length = 0; /* up to the comma; one of x,y,z has no blank behind it */
        while (left[length] != '\0' && strncmp(left + length, ", ", 2) != 0)
            length++;
        assert_true(sscanf(left, "%63[^ ,]", row->name) == 1);
        const size_t name = strlen(row->name);
        if (length > name)
            (void)snprintf(row->value, sizeof row->value, "%.*s", (int)(length - name - 1), left + name + 1);
        left += length;
        left += *left != '\0' ? 2 : 0;
    }
}

/* The rows of what was said. A line that begins with two blanks is a row, one with more goes on with it, any other ends
 * it. */
static void read_page(struct page *p)
{
    char left[1024] = "", *rest = said;
    size_t first = 0; /* row of this sentence */
    p->n = 0;
    for (char *line; (line = strsep(&rest, "\n")) != NULL;) {
        const size_t blanks = strspn(line, " "), n = strlen(left);
        const char *sentence = line + blanks;
        if (n > 0 && left[n - 1] == '|') {
            (void)snprintf(left + n, sizeof left - n, "%s", line + blanks);
            sentence = "";
        } else if (blanks == 2 && line[2] == '-') {
            const char *gap = strstr(line + 2, "  ");
            const size_t length = gap != NULL ? (size_t)(gap - line) - 2 : strlen(line + 2);
            (void)snprintf(left, sizeof left, "%.*s", (int)length, line + 2);
            sentence = gap != NULL ? gap + strspn(gap, " ") : "";
        } else if (blanks < 3) {
            first = p->n;
        }
        if (left[0] != '\0' && left[strlen(left) - 1] != '|') {
            first = p->n;
            read_left(p, left);
            left[0] = '\0';
        }
        for (size_t k = first; k < p->n; k++) {
            const size_t at = strlen(p->row[k].sentence);
            (void)snprintf(p->row[k].sentence + at, sizeof p->row[k].sentence - at, "%s%s", at > 0 ? " " : "",
                           sentence);
        }
    }
}

static const struct row *row_of(const struct page *p, const char *name)
{
    const struct row *found = NULL;
    for (size_t k = 0; k < p->n; k++)
        if (strcmp(p->row[k].name, name) == 0) {
            if (found != NULL)
                fail_msg("%s is named twice", name);
            found = &p->row[k];
        }
    return found;
}

static void help_of(const struct command *c, struct page *p)
{
    assert_int_equal(run(c, 0, "--help", STDOUT_FILENO), SIM_OK);
    read_page(p);
}

/* Is "LO to HI" in a sentence? NULL: any range. */
static int has_range(const char *sentence, const double *range)
{
    for (const char *at = sentence; *at != '\0'; at++) {
        double lo, hi;
        int n = 0;
        if ((at == sentence || at[-1] == ' ') && sscanf(at, "%lf to %lf%n", &lo, &hi, &n) == 2 && n > 0 &&
            (range == NULL || (lo == range[0] && hi == range[1])))
            return 1;
    }
    return 0;
}

/* The range that a refusal tells. */
static int told_range(double range[2])
{
    static const char *const before[] = { "is outside its range, ", "the frame must be " };
    for (int k = 0; k < 2; k++) {
        const char *at = strstr(said, before[k]);
        if (at != NULL && sscanf(at + strlen(before[k]), "%lf to %lf", &range[0], &range[1]) == 2)
            return 1;
    }
    return 0;
}

/* ---- Cases ------------------------------------------------------------------------------------------- */

static void every_option_is_told(void **state)
{
    static struct page page;
    for (size_t c = 0; c < N_COMMANDS; c++) {
        size_t taken = 0;
        help_of(&commands[c], &page);
        for (size_t i = 0; i < n_options; i++) {
            char argument[96], unknown[128], no_use[128], wants[512];
            (void)snprintf(argument, sizeof argument, "%s=", options[i]);
            (void)snprintf(unknown, sizeof unknown, "unknown option '%s'", argument);
            (void)snprintf(no_use, sizeof no_use, "%s has no use", options[i]);
            assert_int_equal(run(&commands[c], commands[c].words_first, argument, STDERR_FILENO), SIM_USAGE);
            const struct row *row = row_of(&page, options[i]);
            if (strstr(said, unknown) != NULL || strstr(said, no_use) != NULL) {
                if (row != NULL)
                    fail_msg("%s --help names %s, which it does not take", commands[c].name, options[i]);
                continue;
            }
            taken++;
            if (row == NULL)
                fail_msg("%s --help does not name %s", commands[c].name, options[i]);
            if (row->sentence[0] == '\0')
                fail_msg("%s --help does not say what %s is", commands[c].name, options[i]);
            const char *told = strstr(said, " wants ");
            assert_non_null(told);
            assert_int_equal(sscanf(told, " wants %511[^,]", wants), 1); /* x,y,z has no bar */
            if (strcmp(wants, "no value") == 0 ? row->value[0] != '\0'
                : strchr(wants, '|') != NULL   ? strcmp(row->value, wants) != 0
                                               : row->value[0] == '\0' || strchr(row->value, '|') != NULL)
                fail_msg("%s %s wants %s, --help says '%s'", commands[c].name, options[i], wants, row->value);
        }
        assert_int_equal(taken, page.n);
        assert_true(taken >= 4);
    }
}

static void every_range_is_told(void **state)
{
    static const char *const beyond[] = { "-1000000000", "0x0", "1000000001", "65536x1", "1e31" }; /* low, low, high */
    static struct page page;
    size_t ranges = 0;
    for (size_t c = 0; c < N_COMMANDS; c++) {
        help_of(&commands[c], &page);
        for (size_t k = 0; k < page.n; k++) {
            const struct row *row = &page.row[k];
            int low = 0, high = 0;
            if (row->value[0] == '\0' || strchr(row->value, '|') != NULL)
                continue;
            for (size_t i = 0; i < sizeof beyond / sizeof beyond[0]; i++) {
                char argument[128];
                double range[2];
                (void)snprintf(argument, sizeof argument, "%s=%s", row->name, beyond[i]);
                assert_int_not_equal(run(&commands[c], 1, argument, STDERR_FILENO), SIM_OK);
                if (!told_range(range))
                    continue;
                *(i < 2 ? &low : &high) = 1;
                if (!has_range(row->sentence, range))
                    fail_msg("%s: %s--help says '%s'", commands[c].name, said, row->sentence);
            }
            if (low != high || low != has_range(row->sentence, NULL))
                fail_msg("%s %s refused low values: %d, high ones: %d; --help says '%s'", commands[c].name, row->name,
                         low, high, row->sentence);
            ranges += low != 0;
        }
    }
    assert_true(ranges > 40);
}

static void lines_are_short(void **state)
{
    for (size_t c = 0; c < N_COMMANDS; c++) {
        char usage[64], *rest = said, *last = NULL;
        assert_int_equal(run(&commands[c], 0, "-h", STDOUT_FILENO), SIM_OK);
        (void)snprintf(usage, sizeof usage, "usage: %s ", commands[c].name);
        assert_memory_equal(said, usage, strlen(usage));
        assert_non_null(strstr(said, "\nExit status: "));
        for (char *line; (line = strsep(&rest, "\n")) != NULL;) {
            const size_t n = strlen(line);
            if (n > WIDTH || (n > 0 && line[n - 1] == ' '))
                fail_msg("%s --help: %zu columns: '%s'", commands[c].name, n, line);
            last = line;
        }
        assert_string_equal(last, ""); /* a line feed at the end */
    }
}

static const char *names(void)
{
    return "first, second, third";
}

static void a_page(void **state)
{
    static const struct sim_option table[] = {
        { "Files", SIM_OPTION_HEADING },
        { "--out", SIM_OPTION_FILE, .value = "F.png", .help = "the picture" },
        { "-q", SIM_OPTION_FLAG, .help = "" },
        { "--quiet", SIM_OPTION_FLAG },
        { "Numbers, of which there are some", SIM_OPTION_HEADING },
        { "--rows", SIM_OPTION_COUNT, .lo = 1, .hi = 4096, .help = "rows (16)" },
        { "--spi", SIM_OPTION_COUNT, .lo = 1000, .hi = 1e9, .help = "{range} Hz (10 (ten))" },
        { "--part", SIM_OPTION_NUMBER, .lo = 0.001, .hi = 0.5, .help = "of all" },
        { "--none", SIM_OPTION_COUNT, .lo = 0, .hi = 0, .help = "no range (0)" },
        { "--bits", SIM_OPTION_COUNT, .words = "4|8", .value = "BITS", .help = "bits\nof one" },
        { "--method", SIM_OPTION_CHOICE,
          .words = "a-long-word-that-is-first|a-long-word-that-is-second|a-long-word-that-is-third|"
                   "a-long-word-that-is-fourth",
          .help =
              "a sentence that is as long as it has to be to go on in a second line, which begins below it (none)" },
        { "MODEL", SIM_OPTION_WORD, .help = "one of:", .list = names },
    };
    static const struct sim_help help = {
        "it MODEL\nit --help",
        "What it does.\nAnd more.",
        "The end.",
    };
    int kept;
    said_begin(&kept, STDOUT_FILENO);
    sim_option_help(table, sizeof table / sizeof table[0], &help);
    said_end(kept, STDOUT_FILENO);
    assert_string_equal(
        said,
        "usage: it MODEL\n"
        "       it --help\n"
        "What it does.\n"
        "And more.\n"
        "\n"
        "Files\n"
        "  --out F.png  the picture\n"
        "  -q, --quiet\n"
        "Numbers, of which there are some\n"
        "  --rows N     rows, 1 to 4096 (16)\n"
        "  --spi N      1000 to 1000000000 Hz (10 (ten))\n"
        "  --part N     of all, 0.001 to 0.5\n"
        "  --none N     no range (0)\n"
        "  --bits 4|8   bits\n"
        "               of one\n"
        "  --method a-long-word-that-is-first|a-long-word-that-is-second|a-long-word-that-is-third|\n"
        "           a-long-word-that-is-fourth\n"
        "               a sentence that is as long as it has to be to go on in a second line, which begins below it\n"
        "               (none)\n"
        "  MODEL        one of:\n"
        "               first, second, third\n"
        "\n"
        "An option's value may follow after a space or an equals sign.\n"
        "The end.\n");
    for (int k = 0; k < 2; k++) { /* such rows are no options */
        char seen[sizeof table / sizeof table[0]] = { 0 };
        char *word[] = { (char *)(k == 0 ? "MODEL" : "Files") };
        int i = 0, to = 0;
        said_begin(&kept, STDERR_FILENO);
        const int status = sim_option_take(table, sizeof table / sizeof table[0], &to, seen, 1, word, &i);
        said_end(kept, STDERR_FILENO);
        assert_int_equal(status, SIM_USAGE);
        assert_non_null(strstr(said, "unknown option"));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_option_is_told),
        cmocka_unit_test(every_range_is_told),
        cmocka_unit_test(lines_are_short),
        cmocka_unit_test(a_page),
    };
    return cmocka_run_group_tests(tests, find_options, free_options);
}
