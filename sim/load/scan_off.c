/* OFF: have its faces colours? assimp reads those of vertices alone.
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdlib.h>
#include <string.h>

#include "scan.h"

/* The next line that says something, without its end; 0: there is none. */
static int next_line(const char **p, const char *end, const char **line, size_t *n)
{
    while (*p < end) {
        *line = *p + strspn(*p, " \t\r\n");
        *n = strcspn(*line, "\r\n#");
        *p = *line + strcspn(*line, "\r\n");
        if (*n > 0)
            return 1;
        *p += *p < end; /* a '\0' is a blank, too */
    }
    return 0;
}

static unsigned long words(const char *line, size_t n)
{
    unsigned long count = 0;
    for (size_t i = 0; i < n; i++)
        count += strchr(" \t", line[i]) == NULL && (i == 0 || strchr(" \t", line[i - 1]) != NULL);
    return count;
}

void sim_off_look(struct sim_lost *lost, const char *text, size_t bytes)
{
    const char *p = text, *const end = text + bytes, *line;
    size_t n;
    int found = next_line(&p, end, &line, &n);
    if (found && memchr(line, 'F', n) != NULL) { /* the counts may stand behind "OFF", or in the next line */
        const size_t name = strcspn(line, " \t\r\n");
        line += name;
        n -= name < n ? name : n;
        found = words(line, n) > 0 || next_line(&p, end, &line, &n);
    }
    if (!found)
        return;
    char *stop;
    const unsigned long points = strtoul(line, &stop, 10), faces = strtoul(stop, NULL, 10);
    for (unsigned long i = 0; found && i < points; i++)
        found = next_line(&p, end, &line, &n);
    for (unsigned long i = 0; found && i < faces && (found = next_line(&p, end, &line, &n)) != 0; i++)
        if (words(line, n) > strtoul(line, NULL, 10) + 1) {
            sim_lose(lost, SIM_LOST_COLORS, "of faces");
            return;
        }
}
