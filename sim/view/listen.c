/* Standard error is a file for a while.
 *
 * SPDX-License-Identifier: MIT
 */
#include "listen.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

static FILE *file; /* kept for the next time */
static int before = -1;

void view_listen_begin(void)
{
    (void)fflush(stderr);
    if (file == NULL)
        file = tmpfile();
    if (file == NULL || ftruncate(fileno(file), 0) != 0 || lseek(fileno(file), 0, SEEK_SET) != 0)
        return;
    before = dup(STDERR_FILENO);
    if (before >= 0)
        (void)dup2(fileno(file), STDERR_FILENO);
}

void view_listen_end(char said[VIEW_SAID_MAX])
{
    said[0] = '\0';
    if (before < 0)
        return;
    (void)fflush(stderr);
    const ssize_t n = pread(fileno(file), said, VIEW_SAID_MAX - 1, 0);
    said[n > 0 ? n : 0] = '\0';
    (void)dup2(before, STDERR_FILENO);
    (void)close(before);
    before = -1;
    (void)fputs(said, stderr);
    const size_t length = strlen(said);
    if (length > 0 && said[length - 1] == '\n')
        said[length - 1] = '\0';
}
