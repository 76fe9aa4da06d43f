/* Device nodes: their names, and who may open them.
 *
 * SPDX-License-Identifier: MIT
 */
#define _POSIX_C_SOURCE 200809L
#include <dirent.h>
#include <errno.h>
#include <grp.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "hal.h"
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

/* The group that may read and write it, root's left out; 0: there is none. */
static gid_t group_of(const char *path)
{
    struct stat st;
    const mode_t both = S_IRGRP | S_IWGRP;
    return stat(path, &st) == 0 && (st.st_mode & both) == both ? st.st_gid : 0;
}

int linux_refuse_access(const char *what, const char *path, int why)
{
    char number[16];
    const gid_t gid = group_of(path);
    const struct group *group = gid ? getgrgid(gid) : NULL;
    (void)snprintf(number, sizeof number, "%lu", (unsigned long)gid); /* of one without a name; usermod takes it */
    const char *name = group ? group->gr_name : number;
    if (why == EPERM)
        return linux_fail(HAL_ERR_BUS, "%s%s is closed to this process, whatever its user: a container's rule; let the "
                          "container have it (--device %s)", what, path, path);
    if (!gid)
        return linux_fail(HAL_ERR_BUS, "%s%s is open to root alone; give it to a group of yours, by a line in "
                          "/etc/udev/rules.d: KERNEL==\"%s\", GROUP=\"NAME\", MODE=\"0660\"", what, path,
                          strrchr(path, '/') ? strrchr(path, '/') + 1 : path);
    return linux_fail(HAL_ERR_BUS, "%s%s is open to the group %s, and not to this user; join it: sudo usermod -aG %s "
                      "$USER, then log in again", what, path, name, name);
}
