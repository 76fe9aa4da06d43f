/* Atomic files. A temporary one is locked as long as it is written, and the lock ends with its writer, however that
 * ends: one that is not locked is left over.
 *
 * SPDX-License-Identifier: MIT
 */
#include "output_file.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "sim.h"

#define OPEN_MAX_OUTPUTS 16

/* Temporary files that exist, for the signal handler: pointers are set and cleared whole. */
static char *volatile pending[OPEN_MAX_OUTPUTS];
static pid_t owner; /* a child has its parent's list */

static const char *volatile unfinished; /* a folder */

/* In a signal handler: by a program of its own. */
static void remove_unfinished(void)
{
    const char *const folder = unfinished;
    const pid_t child = folder != NULL && getpid() == owner ? fork() : -1;
    if (child == 0) {
        (void)execl("/bin/rm", "rm", "-rf", "--", folder, (char *)NULL);
        _exit(1);
    }
    if (child > 0)
        (void)waitpid(child, NULL, 0);
}

static void remove_pending(void)
{
    for (int i = 0; i < OPEN_MAX_OUTPUTS; i++)
        if (pending[i] != NULL && getpid() == owner)
            (void)unlink(pending[i]);
}

static void on_signal(int number)
{
    remove_pending();
    remove_unfinished();
    (void)signal(number, SIG_DFL);
    (void)raise(number);
}

static void watch_signals(void)
{
    static int installed;
    if (installed)
        return;
    installed = 1;
    owner = getpid();
    (void)atexit(remove_pending);
    (void)signal(SIGXFSZ, SIG_IGN); /* a write beyond a limit of size fails instead */
    const int numbers[] = { SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE };
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++)
        if (signal(numbers[i], on_signal) == SIG_IGN)
            (void)signal(numbers[i], SIG_IGN); /* nohup stays nohup */
}

void sim_output_unfinished(const char *folder)
{
    watch_signals();
    unfinished = folder;
}

static void watch(char *temporary)
{
    watch_signals();
    for (int i = 0; i < OPEN_MAX_OUTPUTS; i++)
        if (pending[i] == NULL) {
            pending[i] = temporary;
            return;
        }
}

static void unwatch(const char *temporary)
{
    for (int i = 0; i < OPEN_MAX_OUTPUTS; i++)
        if (pending[i] == temporary)
            pending[i] = NULL;
}

/* The folder of a path, malloc'ed. */
static char *folder_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    const size_t n = slash == NULL ? 0 : slash == path ? 1 : (size_t)(slash - path);
    char *folder = sim_alloc(n + 2, 1);
    memcpy(folder, n > 0 ? path : ".", n > 0 ? n : 1);
    return folder;
}

int sim_output_same(const char *a, const char *b)
{
    struct stat sa, sb;
    const int there_a = stat(a, &sa) == 0, there_b = stat(b, &sb) == 0;
    if (strcmp(a, "-") == 0 || strcmp(b, "-") == 0)
        return strcmp(a, b) == 0;
    if (there_a || there_b) {
        const int one = there_a && there_b && sa.st_dev == sb.st_dev && sa.st_ino == sb.st_ino;
        return one && S_ISREG(sa.st_mode);
    }
    const char *slash_a = strrchr(a, '/'), *slash_b = strrchr(b, '/');
    if (strcmp(slash_a != NULL ? slash_a + 1 : a, slash_b != NULL ? slash_b + 1 : b) != 0)
        return 0;
    char *folder_a = folder_of(a), *folder_b = folder_of(b);
    const int found = stat(folder_a, &sa) == 0 && stat(folder_b, &sb) == 0;
    const int same = found ? sa.st_dev == sb.st_dev && sa.st_ino == sb.st_ino : strcmp(folder_a, folder_b) == 0;
    free(folder_a);
    free(folder_b);
    return same;
}

int sim_output_check(const char *name, const char *source)
{
    struct stat st, from;
    if (strcmp(name, "-") == 0)
        return SIM_OK;
    const int exists = stat(name, &st) == 0;
    if (exists && S_ISDIR(st.st_mode))
        return sim_refuse(name, 0, "cannot be written: it is a directory");
    if (exists && source != NULL && stat(source, &from) == 0 && from.st_dev == st.st_dev &&
        from.st_ino == st.st_ino)
        return sim_refuse(name, 0, "cannot be written: it is the model itself");
    if (exists && access(name, W_OK) != 0)
        return sim_refuse(name, 0, "cannot be written: %s", strerror(errno));
    if (exists && !S_ISREG(st.st_mode))
        return SIM_OK;
    char *folder = folder_of(name);
    int status = SIM_OK;
    if (name[0] == '\0' || name[strlen(name) - 1] == '/')
        status = sim_refuse(name, 0, "cannot be written: not the name of a file");
    else if (stat(folder, &st) != 0)
        status = sim_refuse(name, 0, "cannot be written: no folder %s", folder);
    else if (access(folder, W_OK | X_OK) != 0)
        status = sim_refuse(name, 0, "cannot be written: %s: %s", folder, strerror(errno));
    free(folder);
    return status;
}

#define TEMPORARY ".zsim-"

static int is_temporary(const char *name)
{
    return strncmp(name, TEMPORARY, sizeof TEMPORARY - 1) == 0 && strlen(name) == sizeof TEMPORARY - 1 + 6;
}

/* Remove temporary files that zsim has left in a folder because it was killed. */
static void remove_left_over(const char *folder)
{
    const int dir = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    DIR *list = dir >= 0 ? fdopendir(dir) : NULL;
    for (const struct dirent *e; list != NULL && (e = readdir(list)) != NULL;) {
        struct stat st;
        const int fd = is_temporary(e->d_name)
            ? openat(dir, e->d_name, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC) : -1;
        if (fd >= 0 && fstat(fd, &st) == 0 && S_ISREG(st.st_mode) && flock(fd, LOCK_EX | LOCK_NB) == 0)
            (void)unlinkat(dir, e->d_name, 0);
        if (fd >= 0)
            (void)close(fd);
    }
    if (list != NULL)
        (void)closedir(list);
    else if (dir >= 0)
        (void)close(dir);
}

/* A new file by a pattern, locked. Another zsim may take it for one that is left over before it is locked: then there
 * is one more. -1: errno says why. */
static int open_locked(char *pattern)
{
    char *ending = pattern + strlen(pattern) - 6;
    for (int tries = 0; tries < 100; tries++) {
        struct stat st;
        memcpy(ending, "XXXXXX", 6);
        const int fd = mkstemp(pattern);
        if (fd < 0)
            return -1;
        const int locked = flock(fd, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK; /* else there are no locks */
        if (locked && fstat(fd, &st) == 0 && st.st_nlink > 0)
            return fd;
        (void)unlink(pattern);
        (void)close(fd);
    }
    errno = EBUSY;
    return -1;
}

/* A new file beside the path, with the mode that the path has or would get. */
static FILE *open_beside(struct sim_output *out, const struct stat *st)
{
    char *folder = folder_of(out->path);
    const size_t room = strlen(folder) + 20;
    remove_left_over(folder);
    out->temporary = sim_alloc(room, 1);
    (void)snprintf(out->temporary, room, "%s/" TEMPORARY "XXXXXX", folder);
    free(folder);
    const int fd = open_locked(out->temporary);
    if (fd < 0) {
        free(out->temporary);
        out->temporary = NULL;
        return NULL;
    }
    watch(out->temporary);
    const mode_t mask = umask(0);
    (void)umask(mask);
    (void)fchmod(fd, st != NULL ? st->st_mode & 0777u : 0666u & ~mask);
    FILE *f = fdopen(fd, "wb");
    if (f == NULL)
        (void)close(fd);
    return f;
}

/* Standard output, which stays open when the file is closed. */
static FILE *open_standard(void)
{
    (void)fflush(stdout);
    const int fd = dup(STDOUT_FILENO);
    FILE *f = fd >= 0 ? fdopen(fd, "wb") : NULL;
    if (f == NULL && fd >= 0)
        (void)close(fd);
    return f;
}

int sim_output_open(struct sim_output *out, const char *name)
{
    struct stat st;
    memset(out, 0, sizeof *out);
    const int exists = stat(name, &st) == 0;
    out->name = name;
    out->path = exists ? realpath(name, NULL) : NULL;
    if (out->path == NULL)
        out->path = strcpy(sim_alloc(strlen(name) + 1, 1), name);
    if (strcmp(name, "-") == 0)
        out->file = open_standard();
    else if (exists && !S_ISREG(st.st_mode))
        out->file = fopen(out->path, "wb");
    else
        out->file = open_beside(out, exists ? &st : NULL);
    if (out->file != NULL)
        return SIM_OK;
    const int why = errno;
    sim_output_abort(out);
    return sim_refuse(name, 0, "cannot be written: %s", strerror(why));
}

void sim_output_abort(struct sim_output *out)
{
    if (out->file != NULL)
        (void)fclose(out->file);
    if (out->temporary != NULL) {
        (void)unlink(out->temporary);
        unwatch(out->temporary);
    }
    free(out->temporary);
    free(out->path);
    memset(out, 0, sizeof *out);
}

int sim_output_commit(struct sim_output *out, size_t n)
{
    int status = SIM_OK;
    for (size_t i = 0; i < n; i++) {
        const int bad = ferror(out[i].file);
        errno = 0;
        const int closed = fclose(out[i].file);
        out[i].file = NULL;
        if ((bad || closed != 0) && status == SIM_OK)
            status = sim_refuse(out[i].name, 0, "cannot be written: %s",
                                errno != 0 ? strerror(errno) : "the disk may be full");
    }
    for (size_t i = 0; i < n; i++) {
        if (status == SIM_OK && out[i].temporary != NULL) {
            if (rename(out[i].temporary, out[i].path) == 0) {
                unwatch(out[i].temporary);
                free(out[i].temporary);
                out[i].temporary = NULL;
            } else {
                status = sim_refuse(out[i].name, 0, "cannot be written: %s", strerror(errno));
            }
        }
        sim_output_abort(&out[i]);
    }
    return status;
}

int sim_output_end(int status, struct sim_output *out, size_t n)
{
    if (status == SIM_OK)
        return sim_output_commit(out, n);
    while (n > 0)
        sim_output_abort(&out[--n]);
    return status;
}

int sim_output_folder(const char *path, size_t most)
{
    char part[4096];
    if (strlen(path) > most)
        return sim_refuse(NULL, 0, "--out: the path is too long");
    for (size_t i = 1; i <= strlen(path); i++)
        if (path[i] == '/' || path[i] == '\0') {
            memcpy(part, path, i);
            part[i] = '\0';
            struct stat st;
            if (mkdir(part, 0777) && errno != EEXIST)
                return sim_refuse(part, 0, "cannot make this folder: %s", strerror(errno));
            if (stat(part, &st) == 0 && !S_ISDIR(st.st_mode))
                return sim_refuse(part, 0, "is not a folder; name another by --out");
        }
    return SIM_OK;
}
