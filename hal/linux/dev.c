/* Names of device nodes.
 *
 * SPDX-License-Identifier: MIT
 */
#define _POSIX_C_SOURCE 200809L
#include <dirent.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "parts.h"

/* Shorter ones first, so that 9 comes before 10. */
static int is_before(const char *a, const char *b)
{
    const size_t n = strlen(a), m = strlen(b);
    return n != m ? n < m : strcmp(a, b) < 0;
}

static int is_device(const char *name, const char *prefix)
{
    char path[DEV_NAME + 8];
    struct stat st;
    const size_t n = strlen(prefix);
    if (strlen(name) >= DEV_NAME || strncmp(name, prefix, n) != 0 || name[n] == '\0' ||
        name[n + strspn(name + n, "0123456789.")] != '\0')
        return 0;
    (void)snprintf(path, sizeof path, "/dev/%.*s", DEV_NAME, name);
    return lstat(path, &st) == 0 && S_ISCHR(st.st_mode);
}

int linux_next_device(const char *prefix, const char *last, char next[DEV_NAME])
{
    DIR *dir = opendir("/dev");
    int found = 0;
    if (dir == NULL)
        return 0;
    for (const struct dirent *entry; (entry = readdir(dir)) != NULL;) {
        const char *name = entry->d_name;
        const int is_next = is_device(name, prefix) && (last[0] == '\0' || is_before(last, name));
        if (!is_next || (found && !is_before(name, next)))
            continue;
        (void)strcpy(next, name);
        found = 1;
    }
    (void)closedir(dir);
    return found;
}
