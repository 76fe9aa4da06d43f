/* Values of options, from text.
 *
 * SPDX-License-Identifier: MIT
 */
#include "value.h"

#include <stdlib.h>
#include <string.h>

int sim_value_long(const char *text, const char **end, long *out)
{
    char *e;
    *out = strtol(text, &e, 10); /* saturates */
    *end = e;
    return e != text && !(text[0] >= '\t' && text[0] <= ' ');
}

int sim_value_double(const char *text, char stop, const char **end, double *out)
{
    char *e;
    if (text[0] <= ' ' || strspn(text, "+-0123456789.eEinfatyINFATY") == 0)
        return 0;
    for (const char *p = text; *p != '\0' && *p != stop; p++)
        if (*p == 'x' || *p == 'X') /* no hexadecimal */
            return 0;
    *out = strtod(text, &e);
    *end = e;
    return e != text && *e == stop;
}

int sim_value_rgb(const char *text, struct zs_rgb *out)
{
    if (text[0] == '#')
        text++;
    if (strlen(text) != 6 || strspn(text, "0123456789abcdefABCDEF") != 6)
        return 0;
    const unsigned long v = strtoul(text, NULL, 16);
    out->r = (uint8_t)(v >> 16);
    out->g = (uint8_t)(v >> 8);
    out->b = (uint8_t)v;
    return 1;
}

int sim_value_choice(const char *text, const char *words)
{
    const size_t n = strlen(text);
    for (int i = 0; words != NULL; i++) {
        const char *bar = strchr(words, '|');
        const size_t length = bar != NULL ? (size_t)(bar - words) : strlen(words);
        if (length == n && memcmp(words, text, n) == 0)
            return i;
        words = bar != NULL ? bar + 1 : NULL;
    }
    return -1;
}

int sim_value_vector(const char *text, double v[3])
{
    const char *end;
    return sim_value_double(text, ',', &end, &v[0]) && sim_value_double(end + 1, ',', &end, &v[1]) &&
           sim_value_double(end + 1, '\0', &end, &v[2]);
}

int sim_value_size(const char *text, long size[2])
{
    const char *end;
    return sim_value_long(text, &end, &size[0]) && (*end == 'x' || *end == 'X') &&
           sim_value_long(end + 1, &end, &size[1]) && *end == '\0';
}
