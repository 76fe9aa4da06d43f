/* All unit test programs in one, for mutants: each case in a process of its own, in the order that is asked for, until
 * one fails. Linked with --wrap=_cmocka_run_group_tests; each program's main is renamed to main_NAME.
 *
 *   runner list                        every case: NAME/CASE, a line
 *   runner measure NAME...             every case of these: NAME/CASE, its status, ms of the processor
 *   runner cover DIR                   the same of a program with coverage: what case n, of the list, reaches into
 *                                      DIR/n
 *   runner first <FILE                 FILE: NAME/CASE and how many ms it may take, a line; prints the first that fails
 *                                      and "late" where it took too long; nothing where all pass
 *
 * SPDX-License-Identifier: MIT
 */
#define _GNU_SOURCE
#include <fcntl.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h>

#define PROGRAM(name) int main_##name(int argc, char **argv); /* or (void): they take no heed */
#include "programs.h"
#undef PROGRAM
static const struct {
    const char *name;
    int (*main)(int, char **);
} programs[] = {
#define PROGRAM(name) { #name, main_##name },
#include "programs.h"
};
#define N_PROGRAMS ((int)(sizeof programs / sizeof programs[0]))

static const char *only; /* the case to run; none: they are listed */
static int list_to;      /* and written here */

int __real__cmocka_run_group_tests(const char *group, const struct CMUnitTest *tests, size_t n,
                                   CMFixtureFunction set_up, CMFixtureFunction tear_down);
int __wrap__cmocka_run_group_tests(const char *group, const struct CMUnitTest *tests, size_t n,
                                   CMFixtureFunction set_up, CMFixtureFunction tear_down)
{
    for (size_t i = 0; i < n; i++) {
        if (!only)
            dprintf(list_to, "%s\n", tests[i].name);
        else if (!strcmp(tests[i].name, only))
            return __real__cmocka_run_group_tests(group, &tests[i], 1, set_up, tear_down);
    }
    return only ? 99 : 0;
}

static int call(int program)
{
    char name[] = "runner", *argv[2] = { name, 0 };
    return programs[program].main(1, argv);
}

static int lines_of(int program, char *text, int size) /* names of its cases */
{
    int to[2], n = 0, got;
    if (pipe(to))
        return 0;
    if (fork() == 0) {
        list_to = to[1];
        (void)call(program);
        _exit(0);
    }
    close(to[1]);
    while ((got = (int)read(to[0], text + n, (size_t)(size - 1 - n))) > 0)
        n += got;
    close(to[0]);
    wait(0);
    text[n] = 0;
    return n;
}

/* Status of a case: 0 passes; -1 took more than ms of the processor, or ten times that on the clock. */
static int run(int program, const char *name, long ms, const char *cover, long *took)
{
    struct rusage before, after;
    int status;
    fflush(stdout);
    getrusage(RUSAGE_CHILDREN, &before);
    const pid_t child = fork();
    if (child == 0) {
        const int nothing = open("/dev/null", O_RDWR);
        const struct itimerval cpu = { { 0, 0 }, { ms / 1000, ms % 1000 * 1000 } };
        const struct itimerval clock = { { 0, 0 }, { 10 * ms / 1000 + 10, 0 } };
        setpgid(0, 0);
        dup2(nothing, 0), dup2(nothing, 1), dup2(nothing, 2);
        if (ms) {
            setitimer(ITIMER_PROF, &cpu, 0);
            setitimer(ITIMER_REAL, &clock, 0);
        }
        if (cover)
            setenv("GCOV_PREFIX", cover, 1);
        only = name;
        exit(call(program));
    }
    waitpid(child, &status, 0);
    kill(-child, SIGKILL); /* what it has started and left */
    getrusage(RUSAGE_CHILDREN, &after);
    *took = (after.ru_utime.tv_sec - before.ru_utime.tv_sec + after.ru_stime.tv_sec - before.ru_stime.tv_sec) * 1000 +
            (after.ru_utime.tv_usec - before.ru_utime.tv_usec + after.ru_stime.tv_usec - before.ru_stime.tv_usec) /
                1000;
    if (WIFSIGNALED(status))
        return WTERMSIG(status) == SIGPROF || WTERMSIG(status) == SIGALRM ? -1 : 128 + WTERMSIG(status);
    return WEXITSTATUS(status);
}

int main(int argc, char **argv)
{
    static char text[65536], line[512];
    const char *what = argc > 1 ? argv[1] : "";
    if (!strcmp(what, "first")) {
        while (fgets(line, sizeof line, stdin)) {
            char name[256];
            long ms = 0, took;
            if (sscanf(line, "%255s %ld", name, &ms) < 1)
                continue;
            char *test = strchr(name, '/');
            int p = 0;
            *test++ = 0;
            while (p < N_PROGRAMS && strcmp(programs[p].name, name))
                p++;
            if (p == N_PROGRAMS)
                return 2;
            const int status = run(p, test, ms, 0, &took);
            if (status) {
                printf("%s/%s%s\n", name, test, status < 0 ? " late" : "");
                return 0;
            }
        }
        return 0;
    }
    const char *cover = argc > 2 && !strcmp(what, "cover") ? argv[2] : 0;
    const int measure = cover || !strcmp(what, "measure");
    int n = 0;
    for (int p = 0; p < N_PROGRAMS; p++) {
        int asked = cover || !measure;
        for (int k = 2; k < argc && !asked; k++)
            asked = !strcmp(argv[k], programs[p].name);
        if (!asked)
            continue;
        lines_of(p, text, sizeof text);
        for (char *name = strtok(text, "\n"); name; name = strtok(0, "\n")) {
            long took = 0;
            snprintf(line, sizeof line, "%s/%d", cover ? cover : "", n++);
            const int status = measure ? run(p, name, 0, cover ? line : 0, &took) : 0;
            if (measure)
                printf("%s/%s %d %ld\n", programs[p].name, name, status, took);
            else
                printf("%s/%s\n", programs[p].name, name);
        }
    }
    return 0;
}
