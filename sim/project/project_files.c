/* Templates and copies.
 *
 * SPDX-License-Identifier: MIT
 */
#define _XOPEN_SOURCE 700 /* nftw */
#include "project_files.h"

#include <dirent.h>
#include <errno.h>
#include <ftw.h>
#include <limits.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "input_file.h"
#include "output_file.h"
#include "sim.h"

#define KNOWN_BY "firmware/zstrip/zstrip.h" /* a file that only the folder of sources has */

/* ---- The sources ----------------------------------------------------------------------------------------- */

static int has_sources(const char *folder)
{
    char name[PATH_MAX + sizeof KNOWN_BY + 1];
    (void)snprintf(name, sizeof name, "%s/" KNOWN_BY, folder);
    return access(name, R_OK) == 0;
}

char *sim_sources_find(void)
{
    static const char cure[] = "set ZSTRIP to the folder that has firmware/ and hal/ in it";
    char folder[PATH_MAX + 1];
    const char *named = getenv("ZSTRIP");
    if (named != NULL) {
        if (realpath(named, folder) != NULL && has_sources(folder))
            return strcpy(sim_alloc(strlen(folder) + 1, 1), folder);
        (void)sim_refuse(named, 0, "is not the folder of zstrip's sources; %s", cure);
        return NULL;
    }
    const ssize_t n = readlink("/proc/self/exe", folder, PATH_MAX);
    folder[n > 0 ? n : 0] = '\0';
    for (char *slash = strrchr(folder, '/'); slash != NULL; slash = strrchr(folder, '/')) {
        *slash = '\0';
        if (has_sources(folder))
            return strcpy(sim_alloc(strlen(folder) + 1, 1), folder);
    }
    (void)sim_refuse(NULL, 0, "zstrip's sources are not above this program; %s", cure);
    return NULL;
}

/* ---- Templates ------------------------------------------------------------------------------------------- */

/* The word whose @name@ stands at p; NULL: none. */
static const struct sim_word *word_at(const char *p, const struct sim_word *word, size_t n)
{
    for (size_t i = 0; *p == '@' && i < n; i++) {
        const size_t length = strlen(word[i].name);
        if (strncmp(p + 1, word[i].name, length) == 0 && p[1 + length] == '@')
            return &word[i];
    }
    return NULL;
}

int sim_template_write(const char *from, const char *to, const struct sim_word *word, size_t n)
{
    uint8_t *text;
    size_t bytes;
    struct sim_output out;
    int status = sim_file_read(from, &text, &bytes);
    if (status == SIM_OK)
        status = sim_output_open(&out, to);
    if (status == SIM_OK) {
        for (const char *p = (const char *)text; *p != '\0'; p++) {
            const struct sim_word *found = word_at(p, word, n);
            if (found != NULL) {
                (void)fputs(found->text, out.file);
                p += strlen(found->name) + 1;
            } else {
                (void)fputc(*p, out.file);
            }
        }
        status = sim_output_commit(&out, 1);
    }
    free(text);
    return status;
}

/* ---- Trees ----------------------------------------------------------------------------------------------- */

static int copy_file(const char *from, const char *to)
{
    char block[65536];
    FILE *in = fopen(from, "rb"), *out = in != NULL ? fopen(to, "wb") : NULL;
    int good = out != NULL;
    for (size_t n = 1; good && n > 0;) {
        n = fread(block, 1, sizeof block, in);
        good = fwrite(block, 1, n, out) == n && !ferror(in);
    }
    int why = errno;
    if (in != NULL)
        (void)fclose(in);
    if (out != NULL && fclose(out) != 0 && good) {
        good = 0;
        why = errno;
    }
    return good ? SIM_OK : sim_refuse(in != NULL ? to : from, 0, "cannot be copied: %s", strerror(why));
}

static int copy_entry(const char *from, const char *to);

static int copy_folder(const char *from, const char *to)
{
    char in[PATH_MAX], out[PATH_MAX];
    DIR *d = opendir(from);
    int status = d != NULL ? SIM_OK : sim_refuse(from, 0, "cannot be read: %s", strerror(errno));
    for (struct dirent *e = NULL; status == SIM_OK && (e = readdir(d)) != NULL;) {
        if (strcmp(e->d_name, ".") == 0 || strcmp(e->d_name, "..") == 0)
            continue;
        if (snprintf(in, sizeof in, "%s/%s", from, e->d_name) >= (int)sizeof in ||
            snprintf(out, sizeof out, "%s/%s", to, e->d_name) >= (int)sizeof out)
            status = sim_refuse(from, 0, "its path is too long");
        else
            status = copy_entry(in, out);
    }
    if (d != NULL)
        (void)closedir(d);
    return status;
}

static int copy_entry(const char *from, const char *to)
{
    struct stat st;
    if (stat(from, &st) != 0)
        return sim_refuse(from, 0, "cannot be read: %s", strerror(errno));
    if (!S_ISDIR(st.st_mode))
        return copy_file(from, to);
    if (mkdir(to, 0777) != 0)
        return sim_refuse(to, 0, "cannot be made a folder: %s", strerror(errno));
    return copy_folder(from, to);
}

int sim_tree_copy(const char *from, const char *to)
{
    char above[PATH_MAX];
    (void)snprintf(above, sizeof above, "%s", to);
    char *slash = strrchr(above, '/');
    if (slash != NULL) {
        *slash = '\0';
        const int status = sim_output_folder(above, PATH_MAX - 1);
        if (status != SIM_OK)
            return status;
    }
    return copy_entry(from, to);
}

static int remove_one(const char *path, const struct stat *st, int kind, struct FTW *at)
{
    (void)st;
    (void)kind;
    (void)at;
    return remove(path);
}

void sim_tree_remove(const char *folder)
{
    (void)nftw(folder, remove_one, 16, FTW_DEPTH | FTW_PHYS);
}
