/* Loading in a process of its own. The child reads the file and writes the model into a pipe; whatever ends it, the
 * parent says one sentence and goes on.
 *
 * Under AddressSanitizer, whose shadow takes terabytes of addresses, there is no limit of memory, and its own reports
 * are printed.
 *
 * SPDX-License-Identifier: MIT
 */
#include <errno.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "model.h"
#include "model_pack.h"
#include "sim.h"

#if defined(__SANITIZE_ADDRESS__)
#define SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define SANITIZED 1
#endif
#endif
#ifndef SANITIZED
#define SANITIZED 0
#endif

#define MEGABYTE 1048576.0
#define STACK_BYTES (8u << 20)
#define STACK_SPENT 77 /* exit status: it was not enough */
#define PATIENCE                                                                                   \
    8 /* times as long on the clock as of CPU time: a disk may be slow, and other programs run */

/* Limits of one file, as numbers. */
struct cage {
    const char *file;
    uint64_t bytes; /* of addresses */
    long seconds;
};

static struct cage cage_for(const char *file, const struct sim_limits *limits)
{
    struct stat st;
    const double size = stat(file, &st) == 0 && S_ISREG(st.st_mode) ? (double)st.st_size / MEGABYTE
                                                                    : 0.0;
    const double machine = (double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGESIZE) /
                           MEGABYTE;
    double megabytes = 1536.0 + 64.0 * size, seconds = 20.0 + size;
    if (megabytes > 0.75 * machine)
        megabytes = 0.75 * machine;
    if (limits->megabytes > 0)
        megabytes = (double)limits->megabytes;
    if (limits->seconds > 0)
        seconds = (double)limits->seconds;
    if (sizeof(void *) < 8 && megabytes > 3072.0)
        megabytes = 3072.0;
    return (struct cage){ file, (uint64_t)(megabytes * MEGABYTE),
                          (long)(seconds < 1e6 ? seconds : 1e6) };
}

static const char *no_memory(const struct cage *c)
{
    static char text[4096];
    (void)snprintf(text, sizeof text,
                   "%.3000s: loading it takes more than %.0f MB of memory; it may be damaged. "
                   "Where you trust it, give "
                   "--load-memory more",
                   c->file, (double)c->bytes / MEGABYTE);
    return text;
}

/* ---- The child ------------------------------------------------------------------------------- */

static const char *stack_top;

/* A fault just below the stack is the stack's. */
static void on_fault(int number, siginfo_t *info, void *context)
{
    const char *at = info->si_addr;
    (void)context;
    if (at < stack_top && stack_top - at < (ptrdiff_t)(2 * STACK_BYTES))
        _exit(STACK_SPENT);
    (void)signal(number, SIG_DFL);
    (void)raise(number);
}

static void watch_stack(void)
{
    static char spare[65536];
    const stack_t other = { .ss_sp = spare, .ss_size = sizeof spare };
    struct sigaction act = { .sa_flags = SA_SIGINFO | SA_ONSTACK };
    act.sa_sigaction = on_fault;
    stack_top = (const char *)__builtin_frame_address(0);
    if (sigaltstack(&other, NULL) == 0)
        (void)sigaction(SIGSEGV, &act, NULL);
}

static void limit(int what, uint64_t most)
{
    struct rlimit now;
    if (getrlimit(what, &now) != 0)
        return;
    now.rlim_cur = now.rlim_max == RLIM_INFINITY || most < now.rlim_max ? (rlim_t)most
                                                                        : now.rlim_max;
    (void)setrlimit(what, &now);
}

static void enter(const struct cage *c)
{
    (void)prctl(PR_SET_PDEATHSIG, SIGKILL);
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_CPU, (uint64_t)c->seconds);
    if (SANITIZED)
        return;
    limit(RLIMIT_STACK, STACK_BYTES);
    limit(RLIMIT_AS, c->bytes);
    watch_stack();
    sim_no_memory = no_memory(c);
    sim_messages_keep();
}

/* By exit, not _exit, so that sanitizers look for leaks and coverage is written. */
static _Noreturn void child(int fd, const struct cage *c, const struct sim_want *want)
{
    struct sim_model model;
    enter(c);
    int status = sim_model_read(&model, c->file, want);
    if (status == SIM_OK) {
        FILE *f = fdopen(fd, "wb");
        if (f != NULL)
            sim_model_pack(f, &model);
        if (f == NULL || ferror(f) || fclose(f) != 0)
            status = sim_refuse(c->file, 0, "its model could not be handed over: %s",
                                strerror(errno));
    }
    sim_model_free(&model);
    sim_progress_end();
    exit(status);
}

/* ---- The parent ------------------------------------------------------------------------------ */

/* What the child has written, which is not trusted. */
struct handed {
    char *bytes;
    size_t n, room;
};

static double now(void)
{
    struct timespec t;
    (void)clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Read until the pipe's other end is closed, which it is when the child has ended; at most c->bytes. */
enum reading { DONE, TOO_LONG, TOO_MUCH };
static enum reading read_all(struct handed *to, int from, const struct cage *c)
{
    const double due = now() + (double)c->seconds * PATIENCE;
    for (;;) {
        struct pollfd on = { .fd = from, .events = POLLIN };
        const double left = due - now();
        const int ready = left > 0.0 ? poll(&on, 1, left < 1000.0 ? (int)(left * 1e3) + 1 : 1000000)
                                     : 0;
        if (left <= 0.0)
            return TOO_LONG;
        if (ready <= 0)
            continue; /* a signal, or the next look at the clock */
        if (to->n == to->room) {
            to->room = to->room < (1u << 16) ? 1u << 16 : 2 * to->room;
            to->bytes = sim_grow(to->bytes, to->room, 1);
        }
        const ssize_t got = read(from, to->bytes + to->n, to->room - to->n);
        if (got == 0)
            return DONE;
        to->n += got > 0 ? (size_t)got : 0;
        if (to->n > c->bytes)
            return TOO_MUCH;
    }
}

/* What ended it, if not that it was done or has said why not. */
static int say_why(const struct cage *c, enum reading read, int ended)
{
    const int number = WIFSIGNALED(ended) ? WTERMSIG(ended) : 0,
              code = WIFEXITED(ended) ? WEXITSTATUS(ended) : -1;
    if (read == DONE && (code == SIM_OK || code == SIM_REFUSED))
        return code;
    sim_progress_lost();
    if (read == TOO_MUCH)
        return sim_refuse(NULL, 0, "%s", no_memory(c));
    if (read == TOO_LONG || number == SIGXCPU)
        return sim_refuse(c->file, 0,
                          "loading it takes more than %ld s; it may never end. Where you trust it, "
                          "give --load-seconds "
                          "more",
                          c->seconds);
    if (code == STACK_SPENT)
        return sim_refuse(c->file, 0,
                          "cannot be loaded: its parts are nested too deep; flatten the model");
    if (number != 0)
        return sim_refuse(
            c->file, 0,
            "cannot be loaded: the loader was ended by signal %d (%s); the file may be damaged",
            number, strsignal(number));
    return sim_refuse(c->file, 0,
                      "cannot be loaded: the loader ended with status %d; the file may be damaged",
                      code);
}

/* The model of a child that writes into a pipe. */
static int take_model(struct sim_model *model, pid_t pid, int from, const struct cage *c,
                      const struct sim_want *want)
{
    struct handed handed = { 0 };
    int ended = 0;
    const enum reading read = read_all(&handed, from, c);
    if (read != DONE)
        (void)kill(pid, SIGKILL);
    while (waitpid(pid, &ended, 0) < 0 && errno == EINTR) {
    }
    int status = say_why(c, read, ended);
    if (status == SIM_OK &&
        sim_model_unpack(model, handed.bytes, handed.n, c->file, want) != SIM_OK)
        status = sim_refuse(
            c->file, 0,
            "cannot be loaded: the loader left no sound model; the file may be damaged");
    free(handed.bytes);
    return status;
}

int sim_model_load(struct sim_model *model, const char *file, const struct sim_want *want)
{
    const struct cage c = cage_for(file, &want->limits);
    int ends[2], status = SIM_REFUSED;
    memset(model, 0, sizeof *model);
    if (pipe(ends) != 0)
        return sim_refuse(file, 0, "cannot be loaded: %s", strerror(errno));
    (void)fflush(NULL);
    sim_progress("loading", 0, 1); /* here, so that both processes count from now on */
    const pid_t pid = fork();
    if (pid == 0) {
        (void)close(ends[0]);
        child(ends[1], &c, want);
    }
    const int why = errno;
    (void)close(ends[1]);
    if (pid > 0)
        status = take_model(model, pid, ends[0], &c, want);
    else
        status = sim_refuse(file, 0, "cannot be loaded: %s", strerror(why));
    (void)close(ends[0]);
    return status;
}
