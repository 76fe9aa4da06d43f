/* cc makes an object of each file, with a list of the headers that it includes, and a library of the objects. The
 * library takes the renderer's functions from this program: shaders, mappings and methods are then the same objects
 * here and there.
 *
 * SPDX-License-Identifier: MIT
 */
#include "scene_file.h"

#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "demo_frame.h"
#include "input_file.h"
#include "project_files.h"
#include "run_program.h"
#include "show.h"
#include "sim.h"

#define FILES_MAX 16
#define SOURCES_MAX 256
#define WORDS_MAX (FILES_MAX + 24)
#define TRY_S 10u /* seconds that all frames of the animation may take at the first try */
#define TEXT(macro) TEXT_OF(macro)
#define TEXT_OF(text) #text

static struct demo loaded;      /* what was loaded last, named after its file */
static char *loaded_as;         /* by which words; NULL: nothing was */
static char *source[SOURCES_MAX + 1];
static size_t n_sources;

/* ---- Names ------------------------------------------------------------------------------------------------- */

/* The files of a name, malloc'ed one by one. Return how many. */
static int split(char *file[FILES_MAX], const char *name)
{
    int n = 0;
    if (access(name, F_OK) == 0) { /* one, even with a blank in its name */
        file[n++] = strcpy(sim_alloc(strlen(name) + 1, 1), name);
        return n;
    }
    for (const char *at = name + strspn(name, " "); *at != '\0' && n < FILES_MAX; at += strspn(at, " ")) {
        const size_t length = strcspn(at, " ");
        file[n] = sim_alloc(length + 1, 1);
        memcpy(file[n++], at, length);
        at += length;
    }
    return n;
}

int sim_scene_file_is(const char *name)
{
    const size_t n = strlen(name);
    return n > 2 && strcmp(name + n - 2, ".c") == 0;
}

static void source_add(const char *name, size_t length)
{
    for (size_t i = 0; i < n_sources; i++)
        if (strncmp(source[i], name, length) == 0 && source[i][length] == '\0')
            return;
    if (n_sources == SOURCES_MAX)
        return;
    source[n_sources] = sim_alloc(length + 1, 1);
    memcpy(source[n_sources++], name, length);
}

static void sources_clear(void)
{
    while (n_sources > 0) {
        free(source[--n_sources]);
        source[n_sources] = NULL;
    }
}

const char *const *sim_scene_file_sources(void)
{
    return (const char *const *)source;
}

/* What a rule of a makefile depends on, as the compiler writes it: "OBJECT: FILE FILE \"; blanks in names behind \. */
static void sources_read(const char *rule)
{
    uint8_t *text;
    size_t n;
    if (access(rule, R_OK) != 0 || sim_file_read(rule, &text, &n) != SIM_OK)
        return;
    char name[PATH_MAX];
    size_t length = 0;
    for (const char *p = strchr((char *)text, ':'); p != NULL && *p != '\0'; p++) {
        if (*p == '\\' && p[1] == ' ' && length + 1 < sizeof name) {
            name[length++] = *++p;
        } else if (*p == ' ' || *p == '\n' || (*p == '\\' && p[1] == '\n') || *p == ':') {
            if (length > 0)
                source_add(name, length);
            length = 0;
        } else if (length + 1 < sizeof name) {
            name[length++] = *p;
        }
    }
    free(text);
}

/* ---- The compiler ------------------------------------------------------------------------------------------ */

/* Where things are made. */
struct workshop {
    char folder[PATH_MAX];
    char *root; /* of zstrip's sources */
    char *file[FILES_MAX];
    int n_files;
};

static const char *compiler(void)
{
    const char *cc = getenv("CC");
    return cc != NULL && cc[0] != '\0' ? cc : "cc";
}

static void place(char to[PATH_MAX], const struct workshop *w, const char *what, int i)
{
    (void)snprintf(to, PATH_MAX, "%.*s/%s%d", PATH_MAX - 32, w->folder, what, i);
}

/* Run it; what it says goes into said. Its exit status; -1: there is no such program. */
static int run(const char *const *words, const char *said)
{
    posix_spawn_file_actions_t files;
    (void)posix_spawn_file_actions_init(&files);
    (void)posix_spawn_file_actions_addopen(&files, STDERR_FILENO, said, O_WRONLY | O_CREAT | O_TRUNC, 0600);
    (void)posix_spawn_file_actions_adddup2(&files, STDERR_FILENO, STDOUT_FILENO);
    return sim_run_program(words, &files);
}

/* The first line that holds "error", else the first; without its end. */
static const char *first_error(char *said)
{
    char *first = said;
    for (char *line = said; line != NULL && *line != '\0'; line = strchr(line, '\n')) {
        line += *line == '\n';
        const char *found = strstr(line, "error"), *reference = strstr(line, "undefined reference");
        const char *end = strchr(line, '\n');
        if ((found != NULL && (end == NULL || found < end)) ||
            (reference != NULL && (end == NULL || reference < end))) {
            first = line;
            break;
        }
    }
    first[strcspn(first, "\n")] = '\0';
    return first;
}

static int refuse_compiler(const char *name, const char *said, int status)
{
    uint8_t *text = NULL;
    size_t n = 0;
    if (status < 0)
        return sim_refuse(name, 0, "wants a C compiler, and %s cannot be run; install gcc, or set CC", compiler());
    if (sim_file_read(said, &text, &n) != SIM_OK)
        return SIM_REFUSED;
    (void)sim_refuse(name, 0, "does not compile: %s", n > 0 ? first_error((char *)text) : "the compiler failed");
    free(text);
    return SIM_REFUSED;
}

/* An object of file i, with the options that this program's own copy of the renderer was compiled with. */
static int compile(const struct workshop *w, int i)
{
    static const char *const headers[] = { "firmware/app", "firmware/scenes", "firmware/scenes/pieces",
                                           "firmware/zstrip", "hal", "hal/panel" };
    enum { N_HEADERS = sizeof headers / sizeof headers[0] };
    char include[N_HEADERS][PATH_MAX], object[PATH_MAX], rule[PATH_MAX], said[PATH_MAX];
    const char *words[WORDS_MAX] = { compiler(), "-std=gnu11", "-O2", "-fPIC", "-fvisibility=default", "-c",
                                     "-DZS_STATS=" TEXT(ZS_STATS), "-DZS_VARYINGS_MAX=" TEXT(ZS_VARYINGS_MAX),
                                     "-fdiagnostics-color=never", "-MMD" };
    int n = 0;
    while (words[n] != NULL)
        n++;
    for (int k = 0; k < N_HEADERS; k++) {
        (void)snprintf(include[k], PATH_MAX, "-I%.*s/%s", PATH_MAX - 32, w->root, headers[k]);
        words[n++] = include[k];
    }
    place(object, w, "object", i);
    place(rule, w, "rule", i);
    place(said, w, "said", i);
    const char *const rest[] = { "-MF", rule, "-o", object, w->file[i] };
    memcpy(&words[n], rest, sizeof rest);
    const int status = run(words, said);
    source_add(w->file[i], strlen(w->file[i]));
    sources_read(rule);
    return status == 0 ? SIM_OK : refuse_compiler(w->file[i], said, status);
}

static int link_all(const struct workshop *w, const char *library)
{
    char object[FILES_MAX][PATH_MAX], said[PATH_MAX];
    const char *words[WORDS_MAX] = { compiler(), "-shared", "-o", library };
    int n = 4;
    for (int i = 0; i < w->n_files; i++) {
        place(object[i], w, "object", i);
        words[n++] = object[i];
    }
    place(said, w, "said", w->n_files);
    const int status = run(words, said);
    return status == 0 ? SIM_OK : refuse_compiler(w->file[0], said, status);
}

static int workshop_open(struct workshop *w, const char *name)
{
    const char *tmp = getenv("TMPDIR");
    memset(w, 0, sizeof *w);
    w->root = sim_sources_find();
    if (w->root == NULL)
        return SIM_REFUSED;
    w->n_files = split(w->file, name);
    for (int i = 0; i < w->n_files; i++)
        if (access(w->file[i], R_OK) != 0)
            return sim_refuse(w->file[i], 0, "cannot be read: %s", strerror(errno));
    (void)snprintf(w->folder, sizeof w->folder, "%.2000s/zsim-XXXXXX", tmp != NULL && tmp[0] != '\0' ? tmp : "/tmp");
    if (mkdtemp(w->folder) == NULL) {
        w->folder[0] = '\0';
        return sim_refuse(name, 0, "cannot be compiled: no folder can be made in %s: %s",
                          tmp != NULL && tmp[0] != '\0' ? tmp : "/tmp", strerror(errno));
    }
    return SIM_OK;
}

static void workshop_close(struct workshop *w)
{
    if (w->folder[0] != '\0')
        sim_tree_remove(w->folder);
    for (int i = 0; i < w->n_files; i++)
        free(w->file[i]);
    free(w->root);
}

/* ---- What was made ----------------------------------------------------------------------------------------- */

/* Pose and draw all frames, small; *at is the one that is on. */
static void try_all(const struct demo *demo, volatile uint32_t *at)
{
    static struct demo_frame f;
    struct zs_config config;
    for (*at = 0; *at < demo->frames; ++*at) {
        struct sim_frame frame;
        sim_frame_config(&config, demo->width, demo->height, (uint8_t)demo->varyings);
        config.depth = demo->depth;
        demo->pose(&f, *at, demo->width, demo->height);
        if (*at == 0 && sim_demo_render(&frame, demo, &f, &config, NULL, NULL) == ZS_OK)
            sim_frame_free(&frame);
    }
}

/* In a process of its own, which may crash. */
static int survives(const struct demo *demo, const char *name)
{
    uint32_t *at = mmap(NULL, sizeof *at, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    int status = 0;
    if (at == MAP_FAILED)
        return sim_refuse(name, 0, "cannot be tried: %s", strerror(errno));
    *at = 0;
    const pid_t pid = fork();
    if (pid == 0) {
        const int nowhere = open("/dev/null", O_WRONLY);
        (void)dup2(nowhere, STDERR_FILENO);
        for (int s = 1; s < 32; s++)
            (void)signal(s, SIG_DFL);
        (void)alarm(TRY_S);
        try_all(demo, at);
        _exit(0);
    }
    while (pid > 0 && waitpid(pid, &status, 0) < 0 && errno == EINTR)
        continue;
    const uint32_t frame = *at;
    (void)munmap(at, sizeof *at);
    if (pid < 0)
        return sim_refuse(name, 0, "cannot be tried: %s", strerror(errno));
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM)
        return sim_refuse(name, 0, "its %u frames take longer than %u s: is there an endless loop at frame %u?",
                          demo->frames, TRY_S, frame);
    if (status != 0)
        return sim_refuse(name, 0, "crashes at frame %u%s%s", frame, WIFSIGNALED(status) ? ": " : "",
                          WIFSIGNALED(status) ? strsignal(WTERMSIG(status)) : "");
    return SIM_OK;
}

/* The file's name without its folder and .c, for names of pictures. malloc'ed. */
static char *stem(const char *file)
{
    const char *slash = strrchr(file, '/');
    const char *from = slash != NULL ? slash + 1 : file;
    const size_t n = strlen(from) - 2;
    return memcpy(sim_alloc(n + 1, 1), from, n);
}

static int adopt(const struct workshop *w, const char *name, const char *library)
{
    void *handle = dlopen(library, RTLD_NOW | RTLD_LOCAL);
    if (handle == NULL) {
        const char *why = dlerror(), *undefined = strstr(why, "undefined symbol: ");
        return undefined == NULL ? sim_refuse(name, 0, "cannot be loaded: %s", why)
                                 : sim_refuse(name, 0, "%s; name the file that has it, too, as in view scene.c "
                                              "thing.c or, in quotes, --scene \"scene.c thing.c\"", undefined);
    }
    const struct show *its = dlsym(handle, "show");
    const struct demo *demo = its != NULL ? its->demo : NULL;
    int status = demo != NULL && demo->pose != NULL && demo->depth != NULL && demo->frames > 0 && demo->width > 0 &&
                         demo->height > 0
                     ? SIM_OK
                     : sim_refuse(name, 0, "has no scene: it ends with SHOW(...), as firmware/app/my_scene.c does");
    if (status == SIM_OK)
        status = survives(demo, name);
    if (status != SIM_OK) {
        (void)dlclose(handle);
        return status;
    }
    /* What was loaded before is not unloaded: frames that are still seen may point into it. */
    char *as = strcpy(sim_alloc(strlen(name) + 1, 1), name);
    free((char *)(uintptr_t)loaded.name);
    free(loaded_as);
    loaded = *demo;
    loaded.name = stem(w->file[0]);
    loaded_as = as;
    sim_demo_own(&loaded, loaded_as);
    return SIM_OK;
}

int sim_scene_file_load(const char *name)
{
    struct workshop w;
    char library[PATH_MAX];
    int status = workshop_open(&w, name);
    sources_clear();
    for (int i = 0; i < w.n_files; i++)
        source_add(w.file[i], strlen(w.file[i])); /* looked at again even if one is not compiled */
    for (int i = 0; status == SIM_OK && i < w.n_files; i++)
        status = compile(&w, i);
    place(library, &w, "scene", 0);
    if (status == SIM_OK)
        status = link_all(&w, library);
    if (status == SIM_OK)
        status = adopt(&w, name, library);
    workshop_close(&w);
    return status;
}

int sim_scene_file_need(const char *name)
{
    if (!sim_scene_file_is(name) || (loaded_as != NULL && strcmp(loaded_as, name) == 0))
        return SIM_OK;
    return sim_scene_file_load(name);
}
