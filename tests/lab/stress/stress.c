/* The stress runner: cases of one kind by seed, for a time; what they add up to is kept in a file, and the next run
 * goes on where this one ended.
 *
 *   stress tris|frames STATE NAME SECONDS     for so long; NAME is told apart in STATE: the code and how it was built
 *   stress tris|frames STATE NAME cases N     N cases more
 *   stress tris|frames case SEED              one of them again
 *   stress tris|frames seen STATE             what frames of all NAMEs had in them; fails where something never was
 *
 * STATE is text, a line a NAME: NAME, first and next seed, then struct stress_counts, CPU seconds before `seen`.
 * Another NAME goes on with seeds that none has had.
 *
 * SPDX-License-Identifier: MIT
 */
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "fast_lists.h"
#include "replay.h"
#include "stress.h"
#include "zs_damage.h"
#include "zstrip.h"

#define CASE_SECONDS 120 /* a case that takes longer hangs */
#define SAVE_SECONDS 20
#define FINDINGS_MAX 20  /* then a run ends */
#define LINES_MAX 200

static volatile sig_atomic_t stopped;

static void stop(int signal)
{
    (void)signal;
    stopped = 1; /* after this case */
}

/* ---- What was seen --------------------------------------------------------------------------------------- */

static const char *const seen_name[] = {
    "several passes",
    "two buffers",
    "fewer depth bits",
    "4 sub-pixel bits",
    "zs_damage_compare",
    "zs_damage_track",
    "both",
    "strips unchanged",
    "strips not drawn",
    "zs_invalidate",
    "two renderers",
    "clipped triangles",
    "clusters",
    "camera inside",
    "orthographic",
    "states",
    "sky",
    "resolve",
#define NAME(name_, ...) #name_,
    ZS_DEPTH_EACH(NAME)
    "raw",
    "flat",
    "smooth",
    "texture",
    "texture_flat",
    "texture_smooth",
    "own",
    "glass",
    "565",
    "pal8",
    "pal4",
    "4444",
    "pal8a",
    "pal4a",
    "zbuffer",
    ZS_METHOD_EACH(NAME)
#undef NAME
    "transparent",
};
static const char *const seen_last[] = { "lines", "points", "fog", "dither", "overlay" };
_Static_assert(SEEN_PASSES + sizeof seen_name / sizeof *seen_name == SEEN_EFFECT &&
                   SEEN_LINES + sizeof seen_last / sizeof *seen_last == SEEN_N, "a name each");

static const char *name_of(int k)
{
    return k < SEEN_EFFECT  ? seen_name[k - SEEN_PASSES]
           : k < SEEN_LINES ? kind_effects[k - SEEN_EFFECT].name
                            : seen_last[k - SEEN_LINES];
}

uint32_t stress_fasts(struct prng *p)
{
    const uint32_t all = (1u << STRESS_FASTS) - 1u, one = 1u << prng_pick(p, STRESS_FASTS);
    switch (prng_pick(p, 16)) {
    case 0: return 0;
    case 1: return one;
    case 2:
    case 3:
    case 4: return prng_pick(p, all + 1u);
    case 5:
    case 6:
    case 7:
    case 8:
    case 9: return all & ~one;
    default: return all;
    }
}

const struct zs_fast *const *stress_list(uint32_t fasts)
{
    return fasts ? fast_of(fasts) : NULL;
}

void stress_saw_fasts(uint64_t *seen, uint32_t fasts, uint32_t did)
{
    for (uint32_t k = 0; k < STRESS_FASTS; k++) {
        const uint32_t on = fasts >> k & 1u;
        seen[SEEN_OFF + k] += 1u - on;
        seen[SEEN_ON + k] += on;
        seen[SEEN_DID + k] += did >> k & 1u;
    }
}

/* ---- State -------------------------------------------------------------------------------------------- */

struct line {
    char name[100];
    unsigned long long first, next;
    struct stress_counts sum;
    double seconds;
};

struct state {
    const char *file;
    struct line line[LINES_MAX];
    int n;
};

static int read_line(FILE *in, struct line *l)
{
    static char text[4096];
    unsigned long long v[6];
    int at, n;
    if (!fgets(text, sizeof text, in) ||
        sscanf(text, "%99s %llu %llu %llu %llu %llu %llu %llu %llu %lf%n", l->name, &l->first, &l->next, &v[0],
               &v[1], &v[2], &v[3], &v[4], &v[5], &l->seconds, &at) != 10)
        return 0;
    const struct stress_counts c = { v[0], v[1], v[2], v[3], v[4], v[5], { 0 } };
    l->sum = c;
    int k = 0;
    for (; k < SEEN_N && sscanf(text + at, "%llu%n", &v[0], &n) == 1; k++, at += n)
        l->sum.seen[k] = v[0];
    if (k < SEEN_N || sscanf(text + at, "%llu", &v[0]) == 1) /* of a runner that counted other things */
        memset(l->sum.seen, 0, sizeof l->sum.seen);
    return 1;
}

static void state_read(struct state *s)
{
    FILE *in = fopen(s->file, "r");
    while (in && s->n < LINES_MAX && read_line(in, &s->line[s->n]))
        s->n++;
    if (in)
        fclose(in);
}

static void state_write(const struct state *s)
{
    char beside[4096];
    snprintf(beside, sizeof beside, "%s.new", s->file);
    FILE *out = fopen(beside, "w");
    for (int i = 0; out && i < s->n; i++) {
        const struct line *l = &s->line[i];
        const struct stress_counts *c = &l->sum;
        fprintf(out, "%s %llu %llu %llu %llu %llu %llu %llu %llu %.1f", l->name, l->first, l->next,
                (unsigned long long)c->cases, (unsigned long long)c->units, (unsigned long long)c->frames,
                (unsigned long long)c->tris, (unsigned long long)c->pixels, (unsigned long long)c->findings,
                l->seconds);
        for (int k = 0; k < SEEN_N; k++)
            fprintf(out, " %llu", (unsigned long long)c->seen[k]);
        fputc('\n', out);
    }
    if (!out || fclose(out) || rename(beside, s->file)) {
        fprintf(stderr, "%s: cannot be written\n", s->file);
        exit(2);
    }
}

/* The line to add to: the last one where it has this name, else a new one. */
static struct line *state_line(struct state *s, const char *name)
{
    struct line *last = s->n ? &s->line[s->n - 1] : NULL;
    if (last && strcmp(last->name, name) == 0)
        return last;
    if (s->n == LINES_MAX) {
        fprintf(stderr, "%s: full\n", s->file);
        exit(2);
    }
    struct line *l = &s->line[s->n++];
    memset(l, 0, sizeof *l);
    snprintf(l->name, sizeof l->name, "%s", name);
    l->first = l->next = last ? last->next : 1;
    return l;
}

/* Print it. Return 1: something never was; of triangles only accelerators are looked at, and whether they were
 * listed. */
static int seen_print(const struct state *s, int frames)
{
    uint64_t sum[SEEN_N] = { 0 };
    for (int i = 0; i < s->n; i++)
        for (int k = 0; k < SEEN_N; k++)
            sum[k] += s->line[i].sum.seen[k];
    int never = 0;
    printf("%-20s %9s %9s%s\n", frames ? "frames" : "tris: frames", "without", "with",
           frames ? "   with, and it did something" : "");
    for (int k = 0; k < STRESS_FASTS; k++) {
        printf("  %-18s %9llu %9llu", fast_name((unsigned)k), (unsigned long long)sum[SEEN_OFF + k],
               (unsigned long long)sum[SEEN_ON + k]);
        if (frames)
            printf(" %9llu", (unsigned long long)sum[SEEN_DID + k]);
        printf("\n");
        never |= !sum[SEEN_OFF + k] || !sum[SEEN_ON + k] || (frames && !sum[SEEN_DID + k]);
    }
    if (frames)
        printf("frames with:\n");
    for (int k = SEEN_PASSES, column = 0; k < SEEN_N && frames; k++) {
        column += printf("  %s %llu", name_of(k), (unsigned long long)sum[k]);
        if (column > 95 || k == SEEN_N - 1)
            column = putchar('\n') & 0;
        never |= !sum[k];
    }
    return never;
}

/* ---- Running -------------------------------------------------------------------------------------------- */

static double seconds_of(clockid_t clock)
{
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

static int run(stress_fn *fn, const char *kind, struct state *s, struct line *l, double seconds,
               unsigned long long cases)
{
    const double start = seconds_of(CLOCK_MONOTONIC), before = l->seconds;
    const struct stress_counts from = l->sum;
    const int progress = isatty(2);
    double saved = start, shown = start, at = start;
    unsigned long long done = 0;
    while (!stopped && (cases ? done < cases : at - start < seconds) &&
           l->sum.findings - from.findings < FINDINGS_MAX) {
        replay_case(l->next, CASE_SECONDS);
        if (!fn(l->next, &l->sum)) {
            l->sum.findings++;
            replay_say();
        }
        l->sum.cases++;
        l->next++;
        done++;
        at = seconds_of(CLOCK_MONOTONIC);
        l->seconds = before + seconds_of(CLOCK_PROCESS_CPUTIME_ID);
        if (at - saved > SAVE_SECONDS) {
            state_write(s);
            saved = at;
        }
        if (progress && at - shown > 0.5) {
            fprintf(stderr, "\r%s: %llu in all, %.0f a second ", kind, (unsigned long long)l->sum.units,
                    (double)(l->sum.units - from.units) / (at - start));
            shown = at;
        }
    }
    alarm(0);
    if (progress)
        fprintf(stderr, "\r%60s\r", "");
    state_write(s);
    const uint64_t units = l->sum.units - from.units, findings = l->sum.findings - from.findings;
    const double cpu = l->seconds - before;
    printf("%s %s, seeds %llu to %llu: %llu %s in %.0f s, %.0f a second of CPU; %llu pixels; %llu findings\n",
           findings ? "FAILED stress" : "ok stress", kind, l->next - done, l->next - 1,
           (unsigned long long)units, kind, at - start, cpu > 0 ? (double)units / cpu : 0,
           (unsigned long long)(l->sum.pixels - from.pixels), (unsigned long long)findings);
    return findings != 0;
}

int main(int argc, char **argv)
{
    stress_fn *const fn = argc > 1 && strcmp(argv[1], "tris") == 0     ? stress_tris
                          : argc > 1 && strcmp(argv[1], "frames") == 0 ? stress_frames
                                                                       : NULL;
    if (fast_count() != STRESS_FASTS) {
        fprintf(stderr, "stress.h: there are %u accelerators\n", fast_count());
        return 2;
    }
    if (fn)
        replay_arm("stress", "%s %s case", argv[0], argv[1]);
    signal(SIGINT, stop);
    signal(SIGTERM, stop);
    if (fn && argc == 4 && strcmp(argv[2], "case") == 0) {
        struct stress_counts c = { 0 };
        const unsigned long long seed = strtoull(argv[3], NULL, 0);
        replay_case(seed, CASE_SECONDS);
        const int ok = fn(seed, &c);
        printf("%s: seed %llu, %llu triangles, %llu pixels\n", ok ? "ok" : "FAILED", seed,
               (unsigned long long)c.tris, (unsigned long long)c.pixels);
        return !ok;
    }
    static struct state s;
    if (fn && argc == 4 && strcmp(argv[2], "seen") == 0) {
        s.file = argv[3];
        state_read(&s);
        return seen_print(&s, fn == stress_frames);
    }
    const int counted = argc == 6 && strcmp(argv[4], "cases") == 0;
    if (!fn || !(argc == 5 || counted)) {
        fprintf(stderr,
                "usage: %s tris|frames STATE NAME SECONDS | cases N\n       %s tris|frames case SEED | seen STATE\n",
                argv[0], argv[0]);
        return 2;
    }
    s.file = argv[2];
    state_read(&s);
    struct line *l = state_line(&s, argv[3]);
    return run(fn, argv[1], &s, l, counted ? 0 : strtod(argv[4], NULL), counted ? strtoull(argv[5], NULL, 0) : 0);
}
