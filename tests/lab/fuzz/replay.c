/* How a case is run again: see replay.h. A signal may come anywhere: the line is made before, then only written.
 *
 * SPDX-License-Identifier: MIT
 */
#include "replay.h"

#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <sys/time.h>
#include <unistd.h>

#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/common_interface_defs.h>
#endif

static char line[340]; /* with NUMBER and a line feed behind the command */
static size_t command_bytes, bytes; /* bytes 0: no case has begun */

void replay_say(void)
{
    if (bytes && write(2, line, bytes) != (ssize_t)bytes)
        _exit(1);
}

static void on_signal(int signal)
{
    const char *text = signal == SIGPROF   ? "wrong: hangs\n"
                       : signal == SIGABRT ? "" /* whoever aborts says why */
                       : signal == SIGILL || signal == SIGTRAP ? "wrong: an assertion of the library\n"
                                                               : "wrong: a stray access\n";
    (void)!write(2, text, strlen(text));
    replay_say();
    _exit(1);
}

void replay_arm(const char *name, const char *format, ...)
{
    static const int fatal[] = { SIGABRT, SIGTRAP, SIGPROF };
    int n = snprintf(line, 300, "FAILED %s: replay with: ", name);
    va_list args;
    va_start(args, format);
    n += n < 299 ? vsnprintf(line + n, 300u - (size_t)n, format, args) : 0;
    va_end(args);
    command_bytes = n < 299 ? (size_t)n : 299u;
    for (size_t k = 0; k < sizeof fatal / sizeof *fatal; k++)
        (void)signal(fatal[k], on_signal);
#ifdef __SANITIZE_ADDRESS__ /* it reports SIGILL, UBSan's and an assertion's, with its line (handle_sigill) */
    __sanitizer_set_death_callback(replay_say);
#else
    (void)signal(SIGILL, on_signal);
    (void)signal(SIGSEGV, on_signal);
    (void)signal(SIGBUS, on_signal);
    (void)signal(SIGFPE, on_signal);
#endif
}

void replay_case(unsigned long long number, unsigned seconds)
{
    const int n = snprintf(line + command_bytes, sizeof line - command_bytes, " %llu\n", number);
    bytes = command_bytes + (size_t)n;
    const struct itimerval time = { .it_value.tv_sec =
                                        (time_t)seconds }; /* of the processor's: a busy machine hangs nothing */
    (void)setitimer(ITIMER_PROF, &time, NULL);
}
