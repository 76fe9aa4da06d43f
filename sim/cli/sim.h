/* What every part of zsim shares: exit codes, the one-line messages, memory, progress.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_SIM_H
#define SIM_SIM_H

#include <stddef.h>
#include <stdio.h>

enum sim_status {
    SIM_OK = 0,
    SIM_REFUSED = 1, /* understood, and cannot be done: one line on stderr said why */
    SIM_USAGE = 2    /* the command line was not understood: one line on stderr said why */
};

/* The program's name in its messages: "zsim" where this is not set. Borrowed. */
extern const char *sim_program;
/* The command that runs, for messages; NULL: none. Borrowed. */
extern const char *sim_command;

/* Above 0: sim_refuse prints nothing, for what is tried and may fail. */
extern int sim_quiet;

/* What is said, in place of how many bytes were needed, where there is no memory; NULL. Borrowed. */
extern const char *sim_no_memory;

/* From here on messages and progress alone go where stderr went; what libraries print to stdout and stderr goes
 * nowhere. */
void sim_messages_keep(void);

/* Print "zsim: FILE:LINE: ..." to stderr, one line whatever the names and values hold. file NULL
 * and line 0 are left out. Return SIM_REFUSED. */
int sim_refuse(const char *file, unsigned long line, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* The same for a command line, with a hint at --help. Return SIM_USAGE. */
int sim_usage(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Zeroed memory for n things of a size, and a block made larger. Never NULL: where there is no
 * memory, zsim says so and exits with SIM_REFUSED. free() it. */
void *sim_alloc(size_t n, size_t size);
void *sim_grow(void *block, size_t n, size_t size);

/* free() each of these. */
void sim_free_all(void *const *blocks, size_t n);
#define SIM_FREE(...) \
    sim_free_all((void *const[]){ __VA_ARGS__ }, sizeof((void *const[]){ __VA_ARGS__ }) / sizeof(void *))

/* Say on stderr how far a job is. Prints nothing unless stderr is a terminal and half a second has passed since the
 * first call: jobs that are short by themselves show, too, once the program takes long. sim_progress_end wipes the
 * line; sim_refuse does too. */
void sim_progress(const char *what, size_t done, size_t total);
void sim_progress_end(void);

/* Another process may have shown progress and not wiped its line: the next message wipes it. */
void sim_progress_lost(void);

#endif
