/* What boards counted for the runs of a study.
 *
 * SPDX-License-Identifier: MIT
 */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sim.h"
#include "study_rows.h"

#define CORES_MAX 4

static struct core {
    char name[16];
    size_t n;
    struct {
        unsigned long long instructions, checksum;
    } *run;
} cores[CORES_MAX];
static size_t n_cores;

unsigned long long study_counted(const char *core, size_t run, unsigned long long *checksum)
{
    for (size_t k = 0; k < n_cores; k++)
        if (!strcmp(cores[k].name, core) && run < cores[k].n) {
            *checksum = cores[k].run[run].checksum;
            return cores[k].run[run].instructions;
        }
    return 0;
}

const char *study_cores(void)
{
    static char text[CORES_MAX * 17];
    size_t n = 0;
    for (size_t k = 0; k < n_cores; k++)
        n += (size_t)snprintf(text + n, sizeof text - n, "%s%s", k ? "+" : "", cores[k].name);
    return n_cores ? text : "none";
}

/* Lines "run,checksum,instructions" among others. */
static int core_load(const char *name, const char *path)
{
    size_t n;
    char *text = study_read(path, &n);
    struct core *c = &cores[n_cores++];
    if (!text)
        return sim_refuse(path, 0, "cannot be read: %s", strerror(errno));
    (void)snprintf(c->name, sizeof c->name, "%s", name);
    for (char *line = text; *line;) {
        unsigned long long run, checksum, instructions;
        if (sscanf(line, "%llu,%llx,%llu", &run, &checksum, &instructions) == 3 && run < 1000000) {
            if (run >= c->n) {
                c->run = sim_grow(c->run, run + 1, sizeof *c->run);
                memset(c->run + c->n, 0, (run + 1 - c->n) * sizeof *c->run);
                c->n = run + 1;
            }
            c->run[run].checksum = checksum;
            c->run[run].instructions = instructions;
        }
        line += strcspn(line, "\n");
        line += *line == '\n';
    }
    free(text);
    return c->n ? SIM_OK
                : sim_refuse(path, 0,
                             "holds no counts: lines of run,checksum,instructions as firmware/app/study.c "
                             "writes them");
}

int study_counts_load(const char *list)
{
    char text[4096];
    if (strlen(list) >= sizeof text)
        return sim_usage("--counts: too long");
    (void)snprintf(text, sizeof text, "%s", list);
    for (char *save, *word = strtok_r(text, ",", &save); word; word = strtok_r(NULL, ",", &save)) {
        char *file = strchr(word, '=');
        if (!file || file == word || file - word > 15 || !file[1] || n_cores == CORES_MAX)
            return sim_usage("--counts takes CORE=FILE, at most %d with commas between, not '%s'", CORES_MAX, word);
        *file++ = '\0';
        const int status = core_load(word, file);
        if (status != SIM_OK)
            return status;
    }
    return SIM_OK;
}
