/* Limits of people's own, and what a build takes.
 *
 * A file of limits has one a line, "name = number", blanks as one likes; # begins a comment.
 *
 * SPDX-License-Identifier: MIT
 */
#include <ctype.h>
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
    return sim_value_double(equals, '\0', &end, value) ? 1 : -1;
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

/* Sections that take room: with bytes in the file, in flash, and in RAM too where they are written; without, in RAM. */
static int add_sections(FILE *f, uint32_t at, uint32_t size, uint32_t n, double *flash, double *ram)
{
    enum { TYPE = 4, FLAGS = 8, BYTES = 20, NOBITS = 8, WRITE = 1, ALLOC = 2, HEADER = 40 };
    uint8_t s[HEADER];
    for (uint32_t i = 0; i < n; i++) {
        if (fseek(f, (long)(at + i * size), SEEK_SET) || fread(s, HEADER, 1, f) != 1)
            return 0;
        if (!(word(s + FLAGS) & ALLOC))
            continue;
        const int empty = word(s + TYPE) == NOBITS;
        *flash += empty ? 0.0 : word(s + BYTES);
        *ram += empty || (word(s + FLAGS) & WRITE) ? word(s + BYTES) : 0.0;
    }
    return 1;
}

int budget_elf(const char *file, double *flash, double *ram)
{
    enum { HEADER = 52, SECTIONS = 32, SECTION_BYTES = 46, N_SECTIONS = 48 };
    uint8_t h[HEADER];
    FILE *f = fopen(file, "rb");
    *flash = *ram = 0.0;
    if (!f)
        return sim_refuse(file, 0, "--elf: cannot be read");
    const int ok = fread(h, HEADER, 1, f) == 1 && memcmp(h, "\177ELF\1\1", 6) == 0 && half(h + SECTION_BYTES) >= 40 &&
                   add_sections(f, word(h + SECTIONS), half(h + SECTION_BYTES), half(h + N_SECTIONS), flash, ram);
    (void)fclose(f);
    return ok ? SIM_OK :
        sim_refuse(file, 0, "--elf: no linked program of a 32-bit little-endian core; give the .elf that is flashed");
}
