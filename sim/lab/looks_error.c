/* Looks, counted, and held against what they took on a core.
 *
 * SPDX-License-Identifier: MIT
 */
#include "looks_error.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "costs.h"
#include "frame.h"
#include "looks.h"
#include "option_help.h"
#include "option_table.h"
#include "sim.h"

#define LINE_CHARS 256

struct request {
    const char *files[SIM_CORES];
    double bar;
    int details, help; /* flags */
};

#define AT(field) offsetof(struct request, field)
static const struct sim_option table[] = {
    { "--m0", SIM_OPTION_FILE, AT(files[SIM_CORE_M0]), .value = "F.csv", .help = "" },
    { "--m3", SIM_OPTION_FILE, AT(files[SIM_CORE_M3]), .value = "F.csv", .help = "" },
    { "--rp2040", SIM_OPTION_FILE, AT(files[SIM_CORE_RP2040]), .value = "F.csv",
      .help = "what tests/lab/effects/looks_app.c printed on a core" },
    { "--bar", SIM_OPTION_NUMBER, AT(bar), 0, 0, 1000,
      .help = "exit status 1 where one is more than N percent off (20)" },
    { "--details", SIM_OPTION_FLAG, AT(details), .help = "of each, what its stages and its effects take" },
    SIM_HELP_OPTIONS(AT(help)),
};

static const struct sim_help help = {
    "zlab looks [options]",
    "How far the estimate is from what frames with effects together, in several passes, and showpieces take "
    "(tests/lab/looks.sh measures them).",
    "Exit status: 0 done; 1 refused, or one is too far off; 2 the command line makes no sense.",
};

static int count(struct sim_counted *out, const struct look *look)
{
    struct zs_config c;
    sim_frame_config(&c, look->w, look->h, look->varyings);
    c.strip_h = LOOK_STRIP;
    c.buffers = 1;
    c.max_tris = LOOK_TRIS;
    c.max_verts = LOOK_VERTS;
    c.method = look->method;
    return sim_costs_count_passes(out, look->pass, look->n, &c);
}

/* The next number of a file's lines "NAME,NUMBER,...", of that name; < 0: there is none. */
static double next_taken(FILE *f, const char *name)
{
    char line[LINE_CHARS];
    const size_t n = strlen(name);
    while (f != NULL && fgets(line, sizeof line, f) != NULL)
        if (strncmp(line, name, n) == 0 && line[n] == ',')
            return strtod(line + n + 1, NULL);
    return -1.0;
}

static void print_details(const struct sim_counted *counted, enum sim_core core)
{
    for (int k = 0; k < SIM_COST_N; k++) {
        const double cost = counted->n[k] * sim_cost_of(core, (enum sim_cost)k);
        if (cost > 0.0)
            printf("    %-9s %9.0f %9.0f  %s\n", sim_cost_names[k].stage, counted->n[k], cost, sim_cost_names[k].what);
    }
    printf("    effects             %9.0f\n", counted->effects[core]);
}

static int run(const struct request *rq)
{
    FILE *f[SIM_CORES] = { NULL };
    double worst[SIM_CORES] = { 0.0 }, sum[SIM_CORES] = { 0.0 };
    struct sim_counted counted;
    struct look look;
    int err, n = 0, status = SIM_OK;
    for (int c = 0; status == SIM_OK && c < SIM_CORES; c++)
        if (rq->files[c] != NULL && (f[c] = fopen(rq->files[c], "r")) == NULL)
            status = sim_refuse(rq->files[c], 0, "cannot be read");
    for (uint32_t i = 0; status == SIM_OK && look_make(&look, i, &err); i++, n++) {
        err = err ? err : count(&counted, &look);
        if (err)
            status = sim_refuse(look.name, 0, "cannot be counted (%d)", err);
        printf("%-40s", look.name);
        for (int c = 0; status == SIM_OK && c < SIM_CORES; c++) {
            if (f[c] == NULL)
                continue;
            const double taken = next_taken(f[c], look.name), of = sim_costs_sum((enum sim_core)c, &counted);
            const double off = 100.0 * (of / taken - 1.0);
            if (taken <= 0.0)
                status = sim_refuse(rq->files[c], 0, "has no line of '%s'", look.name);
            printf("  %s %6.2f M of %6.2f M, %+5.1f %%", sim_core_names[c], of / 1e6, taken / 1e6, off);
            worst[c] = fmax(worst[c], fabs(off));
            sum[c] += off * off;
        }
        puts("");
        for (int c = 0; rq->details && c < SIM_CORES; c++)
            if (f[c] != NULL)
                print_details(&counted, (enum sim_core)c);
    }
    for (int c = 0; c < SIM_CORES; c++) {
        if (f[c] == NULL)
            continue;
        (void)fclose(f[c]);
        printf("%s: %d looks, off by %.1f %% (root mean square), at most %.1f %%%s\n", sim_core_names[c], n,
               sqrt(sum[c] / (n > 0 ? n : 1)), worst[c], worst[c] > rq->bar ? ": too far" : "");
        status = status == SIM_OK && worst[c] > rq->bar ? SIM_REFUSED : status;
    }
    return status;
}

int sim_looks(int argc, char **argv)
{
    struct request rq = { .bar = 20.0 };
    char seen[N_TABLE] = { 0 };
    int status = sim_options_take(table, N_TABLE, &rq, seen, argc, argv, 0);
    if (status == SIM_OK && rq.help) {
        sim_option_help(table, N_TABLE, &help);
        return SIM_OK;
    }
    status = status == SIM_OK ? sim_options_in_range(table, N_TABLE, &rq, seen, NULL) : status;
    return status == SIM_OK ? run(&rq) : status;
}
