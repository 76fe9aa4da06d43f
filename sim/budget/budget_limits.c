/* Limits of people's own, and what a build takes.
 *
 * A file of limits has one a line, "name = number", blanks as one likes; # begins a comment.
 *
 * SPDX-License-Identifier: MIT
 */
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "budget.h"
#include "sim.h"
#include "value.h"

/* Name and number of a line. 0: nothing on it; -1: not understood. */
static int take_line(char *line, char **name, double *value)
{
    const char *end;
    char *hash = strchr(line, '#'), *equals, *p;
    if (hash)
        *hash = '\0';
    for (p = line + strlen(line); p > line && isspace((unsigned char)p[-1]);)
        *--p = '\0';
    while (isspace((unsigned char)*line))
        line++;
    if (*line == '\0')
        return 0;
    equals = strchr(line, '=');
    if (!equals)
        return -1;
    *name = line;
    for (p = equals; p > line && isspace((unsigned char)p[-1]);)
        p--;
    *p = '\0';
    do
        equals++;
    while (isspace((unsigned char)*equals));
    return sim_value_double(equals, '\0', &end, value) && isfinite(*value) ? 1 : -1;
}

int budget_check(const char *file, const struct budget_figure *figure, size_t n)
{
    char line[256], names[512] = "";
    unsigned long at = 0, limits = 0, beyond = 0;
    int status = SIM_OK;
    FILE *f = fopen(file, "r");
    if (!f)
        return sim_refuse(file, 0, "cannot be read; it holds limits, one a line, such as ram = 65536");
    for (size_t i = 0; i < n; i++)
        if (!figure[i].needs)
            (void)snprintf(names + strlen(names), sizeof names - strlen(names), "%s%s", i ? ", " : "", figure[i].key);
    while (status == SIM_OK && fgets(line, sizeof line, f)) {
        char *name;
        double limit;
        const int got = take_line(line, &name, &limit);
        at++;
        if (got == 0)
            continue;
        if (got < 0) {
            status = sim_refuse(file, at, "a limit reads name = number, such as ram = 65536");
            break;
        }
        size_t i = 0;
        while (i < n && strcmp(figure[i].key, name) != 0)
            i++;
        if (i == n) {
            status = sim_refuse(file, at, "%s is not known here; there are %s", name, names);
            break;
        }
        if (figure[i].needs) {
            status = sim_refuse(file, at, "%s needs %s", name, figure[i].needs);
            break;
        }
        const int ok = figure[i].at_least ? figure[i].value >= limit : figure[i].value <= limit;
        printf("%s %s: %.*f, %s %.*f\n", ok ? "ok" : "EXCEEDED", figure[i].key, figure[i].value < 1000.0 ? 2 : 0,
               figure[i].value,
               figure[i].at_least ? "at least" : "at most", limit < 1000.0 ? 2 : 0, limit);
        limits++;
        beyond += !ok;
    }
    (void)fclose(f);
    if (status == SIM_OK && limits == 0)
        return sim_refuse(file, 0, "holds no limit; one reads name = number, such as ram = 65536");
    if (status == SIM_OK && beyond)
        return sim_refuse(file, 0, "%lu of %lu limits exceeded", beyond, limits);
    return status;
}

/* ---- A build
 * --------------------------------------------------------------------------------------------------------- */

static uint32_t word(const uint8_t *p)
{
    return p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
}

static uint32_t half(const uint8_t *p)
{
    return p[0] | (uint32_t)p[1] << 8;
}

/* Segments that are loaded: what lies in the file takes flash. What runs elsewhere than it is stored, such as code that
 * is copied at the start, what is written, and zeros take RAM. */
static int add_segments(FILE *f, uint32_t at, uint32_t size, uint32_t n, double *flash, double *ram)
{
    enum { RUNS_AT = 8, STORED_AT = 12, STORED = 16, BYTES = 20, FLAGS = 24, LOAD = 1, WRITE = 2, HEADER = 32 };
    uint8_t s[HEADER];
    for (uint32_t i = 0; i < n; i++) {
        if (fseek(f, (long)(at + i * size), SEEK_SET) || fread(s, HEADER, 1, f) != 1)
            return 0;
        if (word(s) != LOAD)
            continue;
        const int in_ram = word(s + RUNS_AT) != word(s + STORED_AT) || (word(s + FLAGS) & WRITE);
        *flash += word(s + STORED);
        *ram += (double)word(s + BYTES) - (in_ram ? 0.0 : word(s + STORED));
    }
    return n > 0;
}

int budget_elf(const char *file, double *flash, double *ram)
{
    enum { HEADER = 52, SEGMENTS = 28, SEGMENT_BYTES = 42, N_SEGMENTS = 44 };
    uint8_t h[HEADER];
    FILE *f = fopen(file, "rb");
    *flash = *ram = 0.0;
    if (!f)
        return sim_refuse(file, 0, "--elf: cannot be read");
    const int ok = fread(h, HEADER, 1, f) == 1 && memcmp(h, "\177ELF\1\1", 6) == 0 && half(h + SEGMENT_BYTES) >= 32 &&
                   add_segments(f, word(h + SEGMENTS), half(h + SEGMENT_BYTES), half(h + N_SEGMENTS), flash, ram);
    (void)fclose(f);
    return ok ? SIM_OK :
        sim_refuse(file, 0, "--elf: no linked program of a 32-bit little-endian core; give the .elf that is flashed");
}
