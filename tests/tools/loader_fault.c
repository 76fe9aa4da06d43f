/* A loader that goes wrong, in place of assimp's. LOADER_FAULT says how. By LD_PRELOAD: where assimp is asked for, this
 * library is what is loaded; it is linked with assimp for all but what goes wrong.
 *
 * SPDX-License-Identifier: MIT
 */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

const void *aiImportFileEx(const char *file, unsigned flags, void *io);

void *dlopen(const char *file, int mode)
{
    void *(*open)(const char *, int);
    Dl_info own = { 0 };
    *(void **)&open = dlsym(RTLD_NEXT, "dlopen");
    if (file != NULL && strstr(file, "assimp") != NULL && strcmp(getenv("LOADER_FAULT"), "missing") == 0)
        return open("no/libassimp.so", mode);
    if (file != NULL && strstr(file, "assimp") != NULL && dladdr((void *)(size_t)dlopen, &own) != 0)
        file = own.dli_fname;
    return open(file, mode);
}

/* Into the pipe that the model is handed over in. */
static void leave_junk(size_t n)
{
    for (int fd = 3; fd < 64; fd++) {
        char name[64], where[64] = "";
        (void)snprintf(name, sizeof name, "/proc/self/fd/%d", fd);
        if (readlink(name, where, sizeof where - 1) > 0 && strstr(where, "pipe:") != NULL)
            for (size_t at = 0; at < n;) {
                char some[1000];
                for (size_t i = 0; i < sizeof some; i++)
                    some[i] = (char)((at + i) * 37 + 11);
                const ssize_t wrote = write(fd, some, n - at < sizeof some ? n - at : sizeof some);
                if (wrote <= 0)
                    _exit(9);
                at += (size_t)wrote;
            }
    }
}

static int deeper(volatile char *from)
{
    volatile char here[4096];
    here[0] = from[0];
    return here[0] != 0 ? deeper(here) + here[0] : 0;
}

const void *aiImportFileEx(const char *file, unsigned flags, void *io)
{
    const char *how = getenv("LOADER_FAULT");
    (void)flags;
    (void)io;
    (void)fprintf(stderr, "noise about %s\n", file);
    (void)printf("noise\n");
    (void)fflush(stdout);
    if (strcmp(how, "abort") == 0)
        abort();
    if (strcmp(how, "segv") == 0)
        *(volatile int *)8 = 1;
    if (strcmp(how, "stack") == 0)
        (void)deeper(&(volatile char){ 1 });
    if (strcmp(how, "kill") == 0)
        (void)raise(SIGKILL);
    if (strcmp(how, "status") == 0)
        _exit(42);
    if (strcmp(how, "nothing") == 0)
        _exit(0);
    if (strcmp(how, "junk") == 0) {
        leave_junk(5000);
        _exit(0);
    }
    while (strcmp(how, "flood") == 0)
        leave_junk(1 << 16);
    while (strcmp(how, "spin") == 0) {
    }
    while (strcmp(how, "sleep") == 0)
        (void)pause();
    return NULL;
}
