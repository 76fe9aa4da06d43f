/* Programs that zsim calls.
 *
 * SPDX-License-Identifier: MIT
 */
#include "run_program.h"

#include <errno.h>
#include <stdint.h>
#include <sys/wait.h>

extern char **environ;

int sim_run_program(const char *const *words, posix_spawn_file_actions_t *files)
{
    pid_t pid;
    int status = 0;
    const int err = posix_spawnp(&pid, words[0], files, NULL, (char *const *)(uintptr_t)words, environ);
    (void)posix_spawn_file_actions_destroy(files);
    if (err)
        return -1;
    while (waitpid(pid, &status, 0) < 0 && errno == EINTR)
        continue;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 126;
}
