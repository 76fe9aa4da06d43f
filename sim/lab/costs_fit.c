/* `zlab costs`: what a stage costs, fitted from what probes took on a core and how often each thing was done in them;
 * and how well that tells what other scenes take.
 *
 * The fit: costs c >= 0 that make the sum over probes of (1 - sum_k n_k c_k / taken)^2 least, by Lawson and Hanson's
 * active set. So an error counts as a part of its probe, small or large.
 *
 * SPDX-License-Identifier: MIT
 */
#include "costs_fit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "costs.h"
#include "frame.h"
#include "option_help.h"
#include "option_table.h"
#include "probes.h"
#include "sim.h"

#define N SIM_COST_N
#define RIDGE 1e-10 /* of the Gram matrix's diagonal: settles what probes do not tell apart */
#define PICO_HZ 125e6
#define PICO_TICK_HZ 1e6

/* ---- Probes, counted ---------------------------------------------------------------------------- */

struct counted_probe {
    char name[PROBE_NAME_CHARS];
    struct sim_counted counted;
};

struct probes {
    struct counted_probe *at; /* [n] */
    size_t n;
};

static int count_probes(struct probes *p)
{
    struct probe *probe = sim_alloc(1, sizeof *probe);
    int status = SIM_OK;
    memset(p, 0, sizeof *p);
    for (uint32_t i = 0; status == SIM_OK && probe_make(probe, i); i++) {
        p->at = sim_grow(p->at, i + 1u, sizeof *p->at);
        memcpy(p->at[i].name, probe->name, sizeof probe->name);
        const int err = sim_costs_count(&p->at[i].counted, &probe->frame.scene, &probe->frame.camera, &probe->config);
        if (err)
            status = sim_refuse(probe->name, 0, "cannot be counted: %s",
                                err == SIM_FRAME_BROKEN ? "pixels found are not those that the renderer tested" :
                                    zs_error_string(err));
        p->n = i + 1u;
    }
    free(probe);
    return status;
}

/* ---- What they took
 * -------------------------------------------------------------------------------------------------- */

/* taken[n] from a file of firmware/app/costs.c, checked line by line. */
static int read_taken(double *taken, const char *file, const struct probes *p)
{
    char line[256], name[PROBE_NAME_CHARS];
    FILE *f = fopen(file, "r");
    double scale = 1.0;
    size_t found = 0; /* probes up to the last one */
    int status = SIM_OK, ended = 0;
    memset(taken, 0, p->n * sizeof *taken); /* 0: not measured */
    if (!f)
        return sim_refuse(file, 0, "cannot be read; make costs writes it");
    for (unsigned long at = 1; status == SIM_OK && fgets(line, sizeof line, f); at++) {
        unsigned long number, sum;
        double count;
        if (strncmp(line, "probe,name,ticks", 16) == 0)
            scale = PICO_HZ / PICO_TICK_HZ;
        ended |= strncmp(line, "# ok", 4) == 0;
        if (strstr(line, "error") || strstr(line, "# failed"))
            status = sim_refuse(file, at, "the probe failed there: %.100s", line);
        else if (sscanf(line, "%lu,%47[a-z0-9_],%lf,%lu", &number, name, &count, &sum) == 4) {
            if (number < found || (number > found && sum) || number >= p->n || strcmp(name, p->at[number].name) != 0)
                status = sim_refuse(file, at, "probe %lu, %s, is not the one that this zlab has there; measure again",
                                    number,
                                    name);
            else if (sum && sum != p->at[number].counted.checksum)
                status = sim_refuse(file, at, "%s: its frame is not the one that this zlab draws", name);
            else {
                taken[number] = count * scale;
                found = number + 1u;
            }
        }
    }
    (void)fclose(f);
    if (status == SIM_OK && !ended)
        status = sim_refuse(file, 0, "it was cut off after %zu of %zu probes; measure again", found, p->n);
    return status;
}

/* ---- The fit
 * ----------------------------------------------------------------------------------------------------------- */

/* Solve G x = b for the unknowns in `in`, others 0, by elimination. */
static void solve(const double g[N][N], const double b[N], const char in[N], double x[N])
{
    double a[N][N + 1];
    int at[N], n = 0;
    for (int k = 0; k < N; k++)
        if (in[k])
            at[n++] = k;
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++)
            a[i][j] = g[at[i]][at[j]];
        a[i][n] = b[at[i]];
    }
    for (int i = 0; i < n; i++) { /* positive definite: no pivots */
        for (int k = i + 1; k < n; k++) {
            const double part = a[k][i] / a[i][i];
            for (int j = i; j <= n && part != 0.0; j++)
                a[k][j] -= part * a[i][j];
        }
    }
    memset(x, 0, N * sizeof *x);
    for (int i = n - 1; i >= 0; i--) {
        double sum = a[i][n];
        for (int j = i + 1; j < n; j++)
            sum -= a[i][j] * x[at[j]];
        x[at[i]] = sum / a[i][i];
    }
}

/* One more unknown, the one that the rest falls by most. Return 0: none is left. */
static int take_in(const double g[N][N], const double b[N], const double x[N], char in[N])
{
    double most = 1e-9;
    int best = -1;
    for (int k = 0; k < N; k++) {
        double down = b[k];
        for (int j = 0; j < N; j++)
            down -= g[k][j] * x[j];
        if (!in[k] && down > most) {
            most = down;
            best = k;
        }
    }
    if (best >= 0)
        in[best] = 1;
    return best >= 0;
}

/* From x towards what solves it, as far as nothing falls below 0; unknowns that reach it leave. */
static void step_down(const double g[N][N], const double b[N], double x[N], char in[N])
{
    double to[N];
    for (int tries = 0; tries < N; tries++) {
        double part = 1.0;
        solve(g, b, in, to);
        for (int k = 0; k < N; k++)
            if (in[k] && to[k] <= 0.0 && x[k] / (x[k] - to[k]) < part)
                part = x[k] / (x[k] - to[k]);
        for (int k = 0; k < N; k++) {
            x[k] += part * (to[k] - x[k]);
            if (in[k] && part < 1.0 && x[k] <= 1e-12) {
                x[k] = 0.0;
                in[k] = 0;
            }
        }
        if (part >= 1.0)
            return;
    }
}

static void fit(double cost[N], const struct probes *p, const double *taken)
{
    static double g[N][N];
    double b[N] = { 0 }, x[N] = { 0 }, unit[N];
    char in[N] = { 0 };
    memset(g, 0, sizeof g);
    for (int k = 0; k < N; k++) { /* columns of length 1 */
        double sum = 0.0;
        for (size_t i = 0; i < p->n; i++)
            if (taken[i] > 0.0)
                sum += pow(p->at[i].counted.n[k] / taken[i], 2.0);
        unit[k] = sum > 0.0 ? 1.0 / sqrt(sum) : 0.0;
    }
    for (size_t i = 0; i < p->n; i++)
        for (int k = 0; k < N && taken[i] > 0.0; k++) {
            const double row = p->at[i].counted.n[k] / taken[i] * unit[k];
            b[k] += row;
            for (int j = 0; j < N && row != 0.0; j++)
                g[k][j] += row * p->at[i].counted.n[j] / taken[i] * unit[j];
        }
    for (int k = 0; k < N; k++)
        g[k][k] += RIDGE;
    for (int tries = 0; tries < 3 * N && take_in((const double(*)[N])g, b, x, in); tries++)
        step_down((const double(*)[N])g, b, x, in);
    for (int k = 0; k < N; k++)
        cost[k] = x[k] * unit[k];
}

/* ---- Output
 * -------------------------------------------------------------------------------------------------------------- */

static double sum_of(const double cost[N], const struct sim_counted *c)
{
    double sum = 0.0;
    for (int k = 0; k < N; k++)
        sum += cost[k] * c->n[k];
    return sum;
}

static void print_costs(double cost[SIM_CORES][N], const char have[SIM_CORES])
{
    printf("%-9s", "stage");
    for (int c = 0; c < SIM_CORES; c++)
        if (have[c])
            printf(" %8s", sim_core_names[c]);
    printf("  of one\n");
    for (int k = 0; k < N; k++) {
        printf("%-9s", k == 0 || strcmp(sim_cost_names[k].stage, sim_cost_names[k - 1].stage) ? sim_cost_names[k].stage
               : "");
        for (int c = 0; c < SIM_CORES; c++)
            if (have[c])
                printf(" %8.*f", cost[c][k] < 100.0 ? 1 : 0, cost[c][k]);
        printf("  %s\n", sim_cost_names[k].what);
    }
}

struct residual {
    double rms, worst;
    size_t at, n;
};

static struct residual residual_of(const double cost[N], const struct probes *p, const double *taken)
{
    struct residual r = { 0 };
    for (size_t i = 0; i < p->n; i++) {
        if (taken[i] == 0.0)
            continue;
        r.n++;
        const double off = sum_of(cost, &p->at[i].counted) / taken[i] - 1.0;
        r.rms += off * off;
        if (fabs(off) > fabs(r.worst)) {
            r.worst = off;
            r.at = i;
        }
    }
    r.rms = sqrt(r.rms / (double)r.n);
    return r;
}

static void print_header(double cost[SIM_CORES][N], const double error[SIM_CORES], double of_methods)
{
    puts("/* Instructions of one of each, cycles on the RP2040 (sim/budget/costs.h says of what): "
         "fitted from the probes of\n"
         " * firmware/scenes/probes.h. Recorded by make costs-record.\n"
         " *\n"
         " * SPDX-License-Identifier: MIT\n"
         " */\n"
         "#ifndef SIM_STAGE_COSTS_H\n"
         "#define SIM_STAGE_COSTS_H\n"
         "\n"
         "static const struct {\n"
         "    const char *name;\n"
         "    double cost[SIM_CORES]; /* M0, M3, M4, M7, RV32, RP2040 */\n"
         "} stage_costs[] = {");
    for (int k = 0; k < N; k++) {
        if (sim_effect_cost(SIM_CORE_M3, (enum sim_cost)k) >= 0.0)
            continue;
        printf("    { \"%s\", {", sim_cost_names[k].name);
        for (int c = 0; c < SIM_CORES; c++)
            printf("%s %.2f", c ? "," : "", cost[c][k]);
        puts(" } },");
    }
    printf("};\n\n/* The most that they are off by, percent of what frames of the demo and bench scenes take. */\n"
           "static const double stage_error[SIM_CORES] = {");
    for (int c = 0; c < SIM_CORES; c++)
        printf("%s %.1f", c ? "," : "", error[c]);
    printf(" };\n/* The same of other methods than the depth buffer, over M0, M3 and RP2040. */\n"
           "static const double method_error = %.1f;\n\n#endif\n", of_methods);
}

/* ---- Command line
 * ----------------------------------------------------------------------------------------------------------- */

struct request {
    const char *files[SIM_CORES];
    const char *error, *scene;
    double bar, drift;
    int has_drift, header, probes, help; /* flags */
};

#define AT(field) offsetof(struct request, field)
static const struct sim_option table[] = {
    { "--m0", SIM_OPTION_FILE, AT(files[SIM_CORE_M0]), .value = "F.csv", .help = "" },
    { "--m3", SIM_OPTION_FILE, AT(files[SIM_CORE_M3]), .value = "F.csv", .help = "" },
    { "--m4", SIM_OPTION_FILE, AT(files[SIM_CORE_M4]), .value = "F.csv", .help = "" },
    { "--m7", SIM_OPTION_FILE, AT(files[SIM_CORE_M7]), .value = "F.csv", .help = "" },
    { "--rv32", SIM_OPTION_FILE, AT(files[SIM_CORE_RV32]), .value = "F.csv", .help = "" },
    { "--rp2040", SIM_OPTION_FILE, AT(files[SIM_CORE_RP2040]), .value = "F.csv",
      .help = "what firmware/app/costs.c printed on a core: fit from it" },
    { "--drift", SIM_OPTION_NUMBER, AT(drift), AT(has_drift), 0, 1000,
      .help = "hold what is on record against it instead: exit status 1 where that is more than N percent off, "
              "{range}, in the root mean square of the probes" },
    { "--header", SIM_OPTION_FLAG, AT(header),
      .help =
          "print it as sim/budget/stage_costs.h; cores that were not measured keep what is on record; with --error, "
          "that on record too" },
    { "--probes", SIM_OPTION_FLAG, AT(probes), .help = "each probe: taken, and how far the fit is from it" },
    { "--error", SIM_OPTION_FILE, AT(error),
      .help = "how far it is from what the demo and bench scenes take, which are not in the fit: lines of core, scene "
              "and number, as in tests/records/bench.txt" },
    { "--bar", SIM_OPTION_NUMBER, AT(bar), 0, 0, 1000,
      .help = "with --error: exit status 1 where one is more than N percent off (15)" },
    { "--scene", SIM_OPTION_TEXT, AT(scene),
      .help = "what is counted in frame 0 of a demo or bench scene as make bench draws it, and what that costs" },
    SIM_HELP_OPTIONS(AT(help)),
};

static const struct sim_help help = {
    "zlab costs [options]",
    "What each stage of the renderer costs, instructions on a core (cycles on the RP2040): as on record, or fitted "
    "from what the probes took, scenes that isolate a stage each (make costs measures them).",
    "Exit status: 0 done; 1 refused; 2 the command line makes no sense.",
};

static int parse(struct request *rq, int argc, char **argv)
{
    char seen[N_TABLE] = { 0 };
    memset(rq, 0, sizeof *rq);
    rq->bar = 15.0;
    int status = sim_options_take(table, N_TABLE, rq, seen, argc, argv, 0);
    return status == SIM_OK && !rq->help ? sim_options_in_range(table, N_TABLE, rq, seen, NULL) : status;
}

static int run(const struct request *rq)
{
    static double cost[SIM_CORES][N];
    double error[SIM_CORES];
    char have[SIM_CORES] = { 0 };
    struct residual residual[SIM_CORES] = { { 0 } };
    struct probes p = { 0 };
    int any = 0, status = SIM_OK;
    for (int c = 0; c < SIM_CORES; c++)
        any |= rq->files[c] != NULL;
    if (any)
        status = count_probes(&p);
    double *taken = sim_alloc(p.n + 1u, sizeof *taken);
    for (int c = 0; c < SIM_CORES; c++)
        for (int k = 0; k < N; k++)
            cost[c][k] = sim_cost_of((enum sim_core)c, (enum sim_cost)k);
    for (int c = 0; status == SIM_OK && c < SIM_CORES; c++) {
        have[c] = rq->files[c] != NULL || !any;
        if (!rq->files[c])
            continue;
        status = read_taken(taken, rq->files[c], &p);
        if (status != SIM_OK)
            break;
        if (!rq->has_drift)
            fit(cost[c], &p, taken);
        sim_costs_set((enum sim_core)c, cost[c]);
        residual[c] = residual_of(cost[c], &p, taken);
        for (size_t i = 0; rq->probes && i < p.n; i++)
            if (taken[i] > 0.0)
                printf("%-8s %-40s %12.0f %+6.1f %%\n", sim_core_names[c], p.at[i].name, taken[i],
                   100.0 * (sum_of(cost[c], &p.at[i].counted) / taken[i] - 1.0));
    }
    for (int c = 0; c < SIM_CORES; c++)
        error[c] = sim_cost_error((enum sim_core)c);
    double of_methods = sim_cost_method_error();
    if (status == SIM_OK && rq->header && rq->error)
        status = sim_costs_worst(rq->error, error, &of_methods);
    if (status == SIM_OK && rq->header)
        print_header(cost, error, of_methods);
    else if (status == SIM_OK && !rq->has_drift && (any || !rq->error))
        print_costs(cost, have);
    for (int c = 0; status == SIM_OK && !rq->header && c < SIM_CORES; c++)
        if (rq->files[c])
            printf("%-8s %s %zu probes: off by %.1f %% (root mean square), at most %+.1f %% (%s)\n", sim_core_names[c],
                   rq->has_drift ? "on record, held against" : "fitted to", residual[c].n, 100.0 * residual[c].rms,
                       100.0 * residual[c].worst, p.at[residual[c].at].name);
    for (int c = 0; status == SIM_OK && rq->has_drift && c < SIM_CORES; c++)
        if (100.0 * residual[c].rms > rq->drift)
            status = sim_refuse(NULL, 0, "costs on record for %s are %.1f %% off, more than %g: make costs-record",
                                sim_core_names[c],
                                100.0 * residual[c].rms, rq->drift);
    free(taken);
    free(p.at);
    return status;
}

int sim_costs(int argc, char **argv)
{
    struct request rq;
    const int status = parse(&rq, argc, argv);
    if (status != SIM_OK)
        return status;
    if (rq.help) {
        sim_option_help(table, N_TABLE, &help);
        return SIM_OK;
    }
    if (rq.scene)
        return sim_costs_scene(rq.scene);
    const int done = run(&rq);
    return done == SIM_OK && rq.error && !rq.header ? sim_costs_error(rq.error, rq.bar) : done;
}
