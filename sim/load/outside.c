/* Paths are compared as text, made absolute and without "." and "..", and again with their links followed. Those that
 * are outside as text are not looked at in the file system.
 *
 * SPDX-License-Identifier: MIT
 */
#include "outside.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "sim.h"

static const char *model;
static int all;       /* flag: all folders are the model's */
static char *kept;    /* a path that may not be read; NULL: none */
static int irregular; /* flag: because it is no regular file */

static char *joined(const char *a, const char *b)
{
    const size_t room = strlen(a) + strlen(b) + 2;
    char *out = sim_alloc(room, 1);
    (void)snprintf(out, room, "%s/%s", a, b);
    return out;
}

/* An absolute path without empty parts, "." and "..", each part behind a slash; malloc'ed. */
static char *plain(const char *path)
{
    char *here = path[0] != '/' ? getcwd(NULL, 0) : NULL;
    char *from = joined(here != NULL ? here : "", path), *out = sim_alloc(strlen(from) + 2, 1);
    size_t n = 0;
    for (const char *p = from; *p != '\0';) {
        const size_t part = strcspn(p, "/");
        if (part == 2 && strncmp(p, "..", 2) == 0) {
            while (n > 0 && out[--n] != '/') {
            }
        } else if (part > 0 && !(part == 1 && *p == '.')) {
            out[n++] = '/';
            memcpy(out + n, p, part);
            n += part;
        }
        p += part + (p[part] == '/');
    }
    out[n] = '\0';
    free(here);
    free(from);
    return out;
}

/* The folder of an absolute path, in place. */
static char *folder_of(char *path)
{
    char *slash = strrchr(path, '/');
    if (slash != NULL)
        *slash = '\0';
    return path;
}

static int below(const char *folder, const char *path)
{
    const size_t n = strlen(folder);
    return strncmp(path, folder, n) == 0 && path[n] == '/';
}

/* Where links lead; "" where there is nothing. */
static char *followed(const char *path)
{
    char *real = realpath(path, NULL);
    return real != NULL ? real : sim_alloc(1, 1);
}

static int is_own(const char *path)
{
    char *folder = folder_of(plain(model)), *as_text = plain(path);
    int own = below(folder, as_text);
    if (own) {
        char *dot = joined(folder, "."), *real_folder = followed(dot), *real = followed(path);
        own = real[0] == '\0' || below(strcmp(real_folder, "/") != 0 ? real_folder : "", real);
        SIM_FREE(dot, real_folder, real);
    }
    SIM_FREE(folder, as_text);
    return own;
}

void sim_outside_begin(const char *model_file, int outside)
{
    model = model_file;
    all = outside;
    sim_outside_forget();
}

int sim_outside_allows(const char *path)
{
    struct stat st;
    const int own = all || is_own(path), found = own && stat(path, &st) == 0;
    if (own && (!found || S_ISREG(st.st_mode)))
        return 1;
    if (kept == NULL && !(found && S_ISDIR(st.st_mode))) {
        kept = strcpy(sim_alloc(strlen(path) + 1, 1), path);
        irregular = own;
    }
    return 0;
}

void sim_outside_forget(void)
{
    free(kept);
    kept = NULL;
}

int sim_outside_check(void)
{
    if (kept == NULL)
        return SIM_OK;
    if (irregular)
        return sim_refuse(model, 0, "names %s, which is not a regular file; copy it to one", kept);
    return sim_refuse(model, 0,
                      "names %s, which is outside the model's folder; copy it there, or give "
                      "--allow-outside where you "
                      "trust the model",
                      kept);
}
