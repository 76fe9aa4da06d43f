/* `zsim study`: the command. A row is study,build,effort,run, then the study's parameters and results. Rows are written
 * as they are measured, to DIR/NAME.csv.part, which becomes DIR/NAME.csv when it is whole; a sweep that was killed goes
 * on where the last whole row ended. Run k belongs to shard k mod N + 1.
 *
 * SPDX-License-Identifier: MIT
 */
#include "study.h"

#include <errno.h>
#include <fcntl.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "option_help.h"
#include "option_table.h"
#include "output_file.h"
#include "sim.h"
#include "study_build.h"
#include "study_rows.h"

static const struct study *const studies[] = { &study_time, &study_depth, &study_memory, &study_stability };
#define N_STUDIES (sizeof studies / sizeof studies[0])

static const char *const effort_name[] = { "quick", "usual", "full" };

struct request {
    const char *out, *shard, *counts;
    int quick, full, redo, settings, help, has_run; /* flags */
    long run;
    enum study_effort effort;
    size_t part, of; /* shard part of `of`, from 1 */
};

#define AT(field) offsetof(struct request, field)
static const struct sim_option table[] = {
    { "Studies", SIM_OPTION_HEADING },
    { "time", SIM_OPTION_WORD,
      .help = "run time against error: sub-pixel bits, reciprocals, sub-spans, depth mapping and bits, shading, "
              "method of hidden-surface removal" },
    { "depth", SIM_OPTION_WORD, .help = "what the depth mappings keep apart; z-fighting and its cures" },
    { "memory", SIM_OPTION_WORD, .help = "strip height, pools and formats: bytes, passes, time" },
    { "stability", SIM_OPTION_WORD,
      .help = "scale, distance, near plane, slivers, rotations, ratio of w: the worst error of each" },
    { "Options", SIM_OPTION_HEADING },
    { "--out", SIM_OPTION_TEXT, AT(out), .value = "DIR", .help = "the folder, made if there is none (build/study)" },
    { "--quick", SIM_OPTION_FLAG, AT(quick), .help = "fewer runs: seconds" },
    { "--full", SIM_OPTION_FLAG, AT(full), .help = "more runs than usual" },
    { "--shard", SIM_OPTION_TEXT, AT(shard), .value = "I/N",
      .help =
          "only runs I, I + N, I + 2 N ...: DIR/NAME.I-of-N.csv, no plots. merge joins the shards, in any order, to "
          "the same bytes as one run, and makes the plots" },
    { "--redo", SIM_OPTION_FLAG, AT(redo),
      .help = "start over where DIR holds rows of another build, effort or counts; else go on" },
    { "--run", SIM_OPTION_COUNT, AT(run), AT(has_run), .value = "K",
      .help = "measure run K alone, of which the first is 0, and print its results" },
    { "--settings", SIM_OPTION_FLAG, AT(settings),
      .help = "print the runs for firmware/app/study.c, and measure nothing (time, memory)" },
    { "--counts", SIM_OPTION_TEXT, AT(counts), .value = "CORE=FILE,...",
      .help = "what that counted on a core (time, memory); make report does all of it" },
    SIM_HELP_OPTIONS(AT(help)),
};

static const struct sim_help help = {
    "zsim study NAME [options]\n"
    "zsim study merge FILE... [--out DIR]",
    "Sweeps settings and measures what they give: DIR/NAME.csv, a row a run; plots and pictures; and the page "
    "DIR/index.html of all studies in DIR, which needs no other file.",
    "A sweep that was interrupted goes on where it was. Plots need gnuplot (package gnuplot-nox).\n"
    "Exit status: 0 done; 1 refused; 2 the command line makes no sense.",
};

/* ---- Rows -------------------------------------------------------------------------------------------------------- */

/* A row's beginning: all that is known before it is measured. */
static void begin_row(const struct study *study, enum study_effort effort, size_t run, struct study_text *row)
{
    row->n = 0;
    study_put(row, "%s,%s,%s,%zu", study->name, STUDY_BUILD, effort_name[effort], run);
    study->describe(run, row);
}

/* ---- A sweep ----------------------------------------------------------------------------------------------------- */

struct sweep {
    const struct study *study;
    const struct request *rq;
    size_t runs;                /* of all shards */
    char csv[4096], part[4104]; /* whole, and in the making */
    FILE *file;                 /* part */
};

static size_t first_run(const struct request *rq)
{
    return rq->part - 1;
}

/* How much of a text is rows of this sweep, *next the run behind them. -1: it holds something else, and *why what. */
static long kept_bytes(const struct sweep *s, const char *text, size_t *next, const char **why)
{
    struct study_text row;
    const char *at = text;
    study_header(s->study, &row);
    row.text[row.n] = '\0';
    *next = first_run(s->rq);
    if (!strchr(text, '\n'))
        return 0; /* not even the header is whole */
    *why = "its columns are others";
    if (strncmp(at, row.text, row.n) || at[row.n] != '\n')
        return -1;
    at += row.n + 1;
    for (const char *end; (end = strchr(at, '\n')) != NULL; at = end + 1) {
        char build[64] = "", effort[16] = "";
        (void)sscanf(at, "%*[^,],%63[^,],%15[^,]", build, effort);
        *why = strcmp(build, STUDY_BUILD)                   ? "its rows are of another build"
               : strcmp(effort, effort_name[s->rq->effort]) ? "its rows are of another effort"
                                                            : "its parameters are others";
        if (*next >= s->runs)
            return -1;
        begin_row(s->study, s->rq->effort, *next, &row);
        if (strncmp(at, row.text, row.n) || at[row.n] != ',')
            return -1;
        if (study_damaged(s->study, at, &row)) {
            static char said[128];
            (void)snprintf(said, sizeof said, "its row of run %zu has no result in column %.40s", *next, row.text);
            *why = said;
            return -1;
        }
        *next += s->rq->of;
    }
    return at - text;
}

static int refuse_kept(const char *path, const char *why)
{
    return sim_refuse(path, 0, "is not of this sweep: %s; --redo starts over, another --out leaves it as it is", why);
}

/* What there is already. *next: the run to go on with; past the last: all is there in DIR/NAME.csv. */
static int sweep_open(struct sweep *s, size_t *next)
{
    const char *why = NULL;
    size_t n;
    long keep = 0;
    for (int k = 0; k < 2; k++) {
        const char *const path = k ? s->part : s->csv;
        if (!study_is_file(path))
            return sim_refuse(path, 0, "is not a regular file; remove it, or name another folder by --out");
    }
    char *text = study_read(s->csv, &n);
    *next = first_run(s->rq);
    if (text) {
        keep = kept_bytes(s, text, next, &why);
        free(text);
        if (keep >= 0 && *next >= s->runs)
            return SIM_OK;
        if (!s->rq->redo)
            return refuse_kept(s->csv, keep < 0 ? why : "rows are missing");
    }
    const int fd = open(s->part, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (fd < 0 || (s->file = fdopen(fd, "r+b")) == NULL)
        return sim_refuse(s->part, 0, "cannot be written: %s", strerror(errno));
    if (flock(fd, LOCK_EX | LOCK_NB))
        return sim_refuse(s->part, 0, "another zsim is writing this sweep; wait for it, or take another --out");
    keep = 0;
    text = study_read(s->part, &n);
    if (text)
        keep = kept_bytes(s, text, next, &why);
    free(text);
    if (keep < 0 && !s->rq->redo)
        return refuse_kept(s->part, why);
    if (keep <= 0) {
        keep = 0;
        *next = first_run(s->rq);
    }
    if (ftruncate(fd, keep) || fseek(s->file, keep, SEEK_SET))
        return sim_refuse(s->part, 0, "cannot be written: %s", strerror(errno));
    if (keep == 0) {
        struct study_text row;
        study_header(s->study, &row);
        (void)fprintf(s->file, "%.*s\n", (int)row.n, row.text);
    }
    return SIM_OK;
}

static int sweep_run(struct sweep *s)
{
    size_t next;
    int status = sweep_open(s, &next);
    for (; status == SIM_OK && next < s->runs; next += s->rq->of) {
        struct study_text row;
        sim_progress(s->study->name, next, s->runs);
        begin_row(s->study, s->rq->effort, next, &row);
        status = s->study->measure(next, &row);
        if (status == SIM_OK && (fprintf(s->file, "%.*s\n", (int)row.n, row.text) < 0 || fflush(s->file)))
            status = sim_refuse(s->part, 0, "cannot be written: %s", strerror(errno));
    }
    sim_progress_end();
    if (!s->file)
        return status;
    if (status == SIM_OK && (fflush(s->file) || rename(s->part, s->csv)))
        status = sim_refuse(s->csv, 0, "cannot be written: %s", strerror(errno));
    (void)fclose(s->file);
    return status;
}

static int report(const struct study *study, enum study_effort effort, const char *dir, const char *csv)
{
    struct study_table t;
    int status = study_table_load(&t, study, effort, csv);
    if (status != SIM_OK)
        return status;
    struct study_page *page = study_page_open(dir, study, t.n_rows);
    status = page ? study_page_close(page, study->report(page, &t)) : SIM_REFUSED;
    study_table_free(&t);
    if (status == SIM_OK)
        printf("%s, %s/index.html\n", csv, dir);
    return status;
}

/* The output folder and those above it may be missing; what stands there is a folder. */
static int make_folder_with_parents(const char *path)
{
    struct stat st;
    const int status = sim_output_folder(path, 2999);
    if (status == SIM_OK && (stat(path, &st) || !S_ISDIR(st.st_mode)))
        return sim_refuse(path, 0, "is not a folder; name another by --out");
    return status;
}

static int sweep(const struct study *study, const struct request *rq)
{
    struct sweep s = { .study = study, .rq = rq };
    s.runs = study->runs(rq->effort);
    if (rq->of == 1)
        (void)snprintf(s.csv, sizeof s.csv, "%s/%s.csv", rq->out, study->name);
    else
        (void)snprintf(s.csv, sizeof s.csv, "%s/%s.%zu-of-%zu.csv", rq->out, study->name, rq->part, rq->of);
    (void)snprintf(s.part, sizeof s.part, "%s.part", s.csv);
    int status = make_folder_with_parents(rq->out);
    if (status == SIM_OK)
        status = sweep_run(&s);
    if (status == SIM_OK && rq->of == 1)
        status = report(study, rq->effort, rq->out, s.csv);
    else if (status == SIM_OK)
        printf("%s\n", s.csv);
    return status;
}

/* ---- Merging ----------------------------------------------------------------------------------------------------- */

/* A file of rows to be merged: which study and effort it is of, and its rows. */
struct merge {
    const struct study *study;
    int effort;
    char **row; /* [runs]: malloc'ed lines; NULL: not seen */
    size_t runs;
    char build[64];
};

static int merge_begin(struct merge *m, const char *path, const char *line)
{
    char name[32] = "", effort[16] = "";
    (void)sscanf(line, "%31[^,],%63[^,],%15[^,]", name, m->build, effort);
    m->effort = -1;
    for (size_t k = 0; k < N_STUDIES; k++)
        if (!strcmp(studies[k]->name, name))
            m->study = studies[k];
    for (int e = 0; e < 3; e++)
        if (!strcmp(effort_name[e], effort))
            m->effort = e;
    if (!m->study || m->effort < 0)
        return sim_refuse(path, 2, "is no row of a study; name files that zsim study has written");
    if (strcmp(m->build, STUDY_BUILD))
        return sim_refuse(path, 2, "is of another build; make its rows again with this zsim");
    m->runs = m->study->runs((enum study_effort)m->effort);
    m->row = sim_alloc(m->runs, sizeof *m->row);
    return SIM_OK;
}

static int merge_row(struct merge *m, const char *path, unsigned long number, const char *line)
{
    char name[32] = "", build[64] = "", effort[16] = "";
    size_t run = 0;
    const int got = sscanf(line, "%31[^,],%63[^,],%15[^,],%zu,", name, build, effort, &run);
    if (got != 4 || strcmp(name, m->study->name) || strcmp(build, m->build) || run >= m->runs ||
        strcmp(effort, effort_name[m->effort]))
        return sim_refuse(path, number, "is not of the same study, build and effort (%s, %s, %s)", m->study->name,
                          m->build, effort_name[m->effort]);
    struct study_text column;
    if (study_damaged(m->study, line, &column))
        return sim_refuse(path, number, "run %zu has no result in column %s; make its rows again", run, column.text);
    if (m->row[run] && strcmp(m->row[run], line))
        return sim_refuse(path, number, "run %zu has another row in another file; leave one of them out", run);
    if (!m->row[run]) {
        m->row[run] = sim_alloc(strlen(line) + 1, 1);
        memcpy(m->row[run], line, strlen(line) + 1);
    }
    return SIM_OK;
}

static int merge_file(struct merge *m, const char *path)
{
    size_t n;
    int status = SIM_OK;
    char *text = study_read(path, &n);
    if (!text)
        return sim_refuse(path, 0, "cannot be read: %s", strerror(errno));
    unsigned long number = 1;
    for (char *line = text; status == SIM_OK && *line; number++) {
        char *end = strchr(line, '\n');
        struct study_text head;
        if (!end) {
            status = sim_refuse(path, number, "ends in half a row; run that shard again, it goes on from there");
            break;
        }
        *end = '\0';
        if (number == 2 && !m->study)
            status = merge_begin(m, path, line);
        if (status == SIM_OK && number > 1)
            status = merge_row(m, path, number, line);
        if (number == 2 && status == SIM_OK) {
            study_header(m->study, &head);
            if (strcmp(text, head.text))
                status = sim_refuse(path, 1, "has other columns than study %s; make its rows again with this zsim",
                                    m->study->name);
        }
        line = end + 1;
    }
    free(text);
    return status;
}

static int merge_write(const struct merge *m, const char *csv)
{
    struct sim_output out = { 0 };
    struct study_text head;
    for (size_t k = 0; k < m->runs; k++)
        if (!m->row[k])
            return sim_refuse(NULL, 0, "merge: run %zu of %zu of study %s is in none of the files; name all shards", k,
                              m->runs, m->study->name);
    int status = sim_output_open(&out, csv);
    if (status != SIM_OK)
        return status;
    study_header(m->study, &head);
    (void)fprintf(out.file, "%.*s\n", (int)head.n, head.text);
    for (size_t k = 0; k < m->runs; k++)
        (void)fprintf(out.file, "%s\n", m->row[k]);
    return sim_output_commit(&out, 1);
}

static int merge(const struct request *rq, int n, char **file)
{
    struct merge m = { 0 };
    char csv[4096];
    int status = n ? SIM_OK : sim_usage("study merge: name the files that the shards have written");
    for (int k = 0; status == SIM_OK && k < n; k++)
        status = merge_file(&m, file[k]);
    if (status == SIM_OK && !m.study)
        status = sim_refuse(file[0], 0, "holds no rows");
    if (status == SIM_OK)
        status = make_folder_with_parents(rq->out);
    if (status == SIM_OK) {
        (void)snprintf(csv, sizeof csv, "%s/%s.csv", rq->out, m.study->name);
        status = merge_write(&m, csv);
    }
    if (status == SIM_OK)
        status = report(m.study, (enum study_effort)m.effort, rq->out, csv);
    for (size_t k = 0; m.row && k < m.runs; k++)
        free(m.row[k]);
    free(m.row);
    return status;
}

/* ---- Command line ------------------------------------------------------------------------------------------------ */

static int parse_shard(struct request *rq)
{
    char behind;
    unsigned part, of;
    rq->part = rq->of = 1;
    if (!rq->shard)
        return SIM_OK;
    if (sscanf(rq->shard, "%u/%u%c", &part, &of, &behind) != 2 || part < 1 || part > of || of > 100000 ||
        strspn(rq->shard, "0123456789/") != strlen(rq->shard))
        return sim_usage("study: --shard takes I/N with I from 1 to N, not '%s'", rq->shard);
    rq->part = part;
    rq->of = of;
    return SIM_OK;
}

/* Options to *rq, other words to the front of argv; *words: how many. */
static int parse(struct request *rq, int argc, char **argv, int *words)
{
    char seen[N_TABLE] = { 0 };
    int status = SIM_OK;
    *words = 0;
    for (int i = 0; status == SIM_OK && i < argc; i++)
        if (argv[i][0] == '-')
            status = sim_option_take(table, N_TABLE, rq, seen, argc, argv, &i);
        else
            argv[(*words)++] = argv[i];
    if (status == SIM_OK && rq->quick && rq->full)
        status = sim_usage("study: --quick or --full, not both");
    rq->effort = rq->quick ? STUDY_QUICK : rq->full ? STUDY_FULL : STUDY_USUAL;
    return status == SIM_OK ? parse_shard(rq) : status;
}

static int print_settings(const struct study *study, enum study_effort effort)
{
    if (!study->settings)
        return sim_usage("study %s runs on no board; --settings are of time and memory", study->name);
    const size_t n = study->runs(effort);
    printf("/* zsim study %s --settings: build %s, %s */\n", study->name, STUDY_BUILD, effort_name[effort]);
    for (size_t k = 0; k < n; k++)
        study->settings(k, stdout);
    return SIM_OK;
}

/* The results of one run alone. */
static int print_run(const struct study *study, const struct request *rq)
{
    struct study_text row = { .n = 0 };
    const size_t runs = study->runs(rq->effort);
    if (rq->run < 0 || (size_t)rq->run >= runs)
        return sim_usage("study: --run takes 0 to %zu, not %ld", runs - 1, rq->run);
    const int status = study->measure((size_t)rq->run, &row);
    if (status == SIM_OK)
        printf("%.*s\n", (int)row.n, row.text);
    return status;
}

int sim_study(int argc, char **argv)
{
    struct request rq = { .out = "build/study" };
    int words;
    int status = parse(&rq, argc, argv, &words);
    if (status != SIM_OK)
        return status;
    if (rq.help) {
        sim_option_help(table, N_TABLE, &help);
        return SIM_OK;
    }
    if (words == 0)
        return sim_usage("study: name one of time, depth, memory, stability");
    if (!strcmp(argv[0], "merge"))
        return merge(&rq, words - 1, argv + 1);
    if (words > 1)
        return sim_usage("study: one name at a time, not '%s'", argv[1]);
    for (size_t k = 0; k < N_STUDIES; k++)
        if (!strcmp(studies[k]->name, argv[0])) {
            if (rq.settings)
                return print_settings(studies[k], rq.effort);
            if (rq.has_run)
                return print_run(studies[k], &rq);
            status = rq.counts && !studies[k]->settings ? sim_usage("study %s takes no --counts", argv[0])
                     : rq.counts                        ? study_counts_load(rq.counts)
                                                        : SIM_OK;
            return status == SIM_OK ? sweep(studies[k], &rq) : status;
        }
    return sim_usage("study: there is no '%s'; there are time, depth, memory, stability, and merge", argv[0]);
}
