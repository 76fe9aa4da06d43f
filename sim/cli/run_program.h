/* Programs that zsim calls: a compiler, gnuplot, ffmpeg.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_RUN_PROGRAM_H
#define SIM_RUN_PROGRAM_H

#include <spawn.h>

/* Run a program and wait for it.
 *
 * words   its name, which is looked for along PATH, its arguments, NULL.
 * files   what it gets in place of this program's files; destroyed here.
 * Return  its exit status; 126 if a signal ended it; -1 if it cannot be run, as where it is not installed. */
int sim_run_program(const char *const *words, posix_spawn_file_actions_t *files);

#endif
