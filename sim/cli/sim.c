/* Messages, memory, progress.
 *
 * SPDX-License-Identifier: MIT
 */
#include "sim.h"

#include <fcntl.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

const char *sim_program = "zsim";
const char *sim_command;
const char *sim_no_memory;

int sim_quiet;

static int progress_shown;
static FILE *messages; /* NULL: stderr */

static FILE *out(void)
{
    return messages != NULL ? messages : stderr;
}

void sim_messages_keep(void)
{
    const int kept = fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3), nothing = open("/dev/null", O_WRONLY | O_CLOEXEC);
    messages = kept >= 0 ? fdopen(kept, "w") : NULL;
    if (messages == NULL || nothing < 0)
        return;
    (void)setvbuf(messages, NULL, _IONBF, 0);
    (void)dup2(nothing, STDOUT_FILENO);
    (void)dup2(nothing, STDERR_FILENO);
}

/* One line: what would break it becomes a question mark. */
static void print_line(char *text)
{
    for (char *p = text; *p != '\0'; p++)
        if ((unsigned char)*p < 0x20 || *p == 0x7f)
            *p = '?';
    sim_progress_end();
    (void)fflush(stdout);
    (void)fprintf(out(), "%s\n", text);
}

int sim_refuse(const char *file, unsigned long line, const char *format, ...)
{
    char text[6144];
    if (sim_quiet > 0)
        return SIM_REFUSED;
    int n = snprintf(text, 64, "%s: ", sim_program);
    if (file != NULL && line != 0)
        n += snprintf(text + n, 4200, "%s:%lu: ", file, line);
    else if (file != NULL)
        n += snprintf(text + n, 4200, "%s: ", file);
    if (n > 4200)
        n = 4200; /* a longer name was cut */
    va_list args;
    va_start(args, format);
    (void)vsnprintf(text + n, sizeof text - (size_t)n, format, args);
    va_end(args);
    print_line(text);
    return SIM_REFUSED;
}

int sim_usage(const char *format, ...)
{
    char text[1024];
    va_list args;
    va_start(args, format);
    (void)vsnprintf(text, sizeof text, format, args);
    va_end(args);
    char line[1152];
    (void)snprintf(line, sizeof line, "%s: %s; see %s%s%s --help", sim_program, text, sim_program,
                   sim_command != NULL ? " " : "", sim_command != NULL ? sim_command : "");
    print_line(line);
    return SIM_USAGE;
}

void *sim_grow(void *block, size_t n, size_t size)
{
    void *p = size != 0 && n > SIZE_MAX / size ? NULL : realloc(block, n * size + 1);
    if (p == NULL) {
        sim_quiet = 0;
        if (sim_no_memory != NULL)
            (void)sim_refuse(NULL, 0, "%s", sim_no_memory);
        else
            (void)sim_refuse(NULL, 0, "out of memory: %zu x %zu bytes more were needed", n, size);
        exit(SIM_REFUSED);
    }
    return p;
}

void *sim_alloc(size_t n, size_t size)
{
    void *p = sim_grow(NULL, n, size);
    memset(p, 0, n * size);
    return p;
}

void sim_free_all(void *const *blocks, size_t n)
{
    for (size_t i = 0; i < n; i++)
        free(blocks[i]);
}

static double now_s(void)
{
    struct timespec t;
    (void)clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

void sim_progress(const char *what, size_t done, size_t total)
{
    static int terminal = -1;
    static double due_s;
    if (terminal < 0) {
        terminal = isatty(fileno(out()));
        due_s = now_s() + 0.5;
    }
    if (!terminal)
        return;
    if (now_s() < due_s)
        return;
    due_s = now_s() + 0.1;
    const double percent = total > 0 ? 100.0 * (double)done / (double)total : 0.0;
    (void)fprintf(out(), "\r%s: %s %3.0f %%\033[K", sim_program, what, percent);
    (void)fflush(out());
    progress_shown = 1;
}

void sim_progress_end(void)
{
    if (progress_shown)
        (void)fprintf(out(), "\r\033[K");
    progress_shown = 0;
}

void sim_progress_lost(void)
{
    progress_shown = isatty(fileno(out()));
}
