/* Output files that are whole or not there: written beside their place, then moved into it.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_OUTPUT_FILE_H
#define SIM_OUTPUT_FILE_H

#include <stddef.h>
#include <stdio.h>

struct sim_output {
    FILE *file;       /* write here */
    char *path;       /* where it will be; symbolic links followed */
    char *temporary;  /* where it is; NULL: a device, a pipe or standard output, written directly */
    const char *name; /* as given, for messages; borrowed */
};

/* Do two names stand for one file, there or not yet? "-" is its own; devices are not files. */
int sim_output_same(const char *a, const char *b);

/* From here on until NULL is given, this folder and all in it are removed where the program is stopped by a signal. */
void sim_output_unfinished(const char *folder);

/* Could this path be written, as far as one can tell without writing? SIM_OK; SIM_REFUSED, said
 * why. source: a file that must not be overwritten, or NULL. */
int sim_output_check(const char *name, const char *source);

/* Open an output; "-" is standard output. Until sim_output_commit, what was at the path stays as it was.
 * SIM_OK; SIM_REFUSED, said why, nothing open. */
int sim_output_open(struct sim_output *out, const char *name);

/* Close all and move them into place; on a failure none is moved that can be held back.
 * SIM_OK; SIM_REFUSED, said why. Outputs are closed and free in either case. */
int sim_output_commit(struct sim_output *out, size_t n);

/* sim_output_commit where status is SIM_OK; else close and remove all n, and return status. */
int sim_output_end(int status, struct sim_output *out, size_t n);

/* Close and remove. Harmless on an output that is not open. Also done for every open output when
 * zsim exits or is interrupted; those of a zsim that was killed are removed when the next one opens an output in the
 * same folder. */
void sim_output_abort(struct sim_output *out);

/* Make the folder of --out and those above it, where they are missing; a path has at most `most` characters, up to
 * 4095. SIM_OK; SIM_REFUSED, said why. What stands at the path may still be another thing than a folder. */
int sim_output_folder(const char *path, size_t most);

#endif
