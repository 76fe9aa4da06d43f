/* See json_text.h.
 *
 * SPDX-License-Identifier: MIT
 */
#include "json_text.h"

#include <stdlib.h>
#include <string.h>

static const char *lead(const char *p, const char *end)
{
    while (p < end && (*p == ' ' || *p == '\t' || *p == '\r' || *p == '\n' || *p == ',' || *p == ':'))
        p++;
    return p;
}

/* Behind the value at p. */
static const char *skip(const char *p, const char *end)
{
    size_t depth = 0;
    do {
        p = lead(p, end);
        if (p == end)
            return end;
        const char c = *p++;
        if (c == '"') {
            for (; p < end && *p != '"'; p++)
                p += *p == '\\' && p + 1 < end;
            p += p < end;
        } else if (c == '{' || c == '[') {
            depth++;
        } else if (c == '}' || c == ']') {
            depth -= depth > 0;
        } else {
            while (p < end && *p != '\0' && strchr(" \t\r\n,:{}[]\"", *p) == NULL)
                p++;
        }
    } while (depth > 0 && p < end);
    return p;
}

static int is_list(struct sim_text v)
{
    return v.p != NULL && v.end - v.p >= 2 && (*v.p == '[' || *v.p == '{');
}

struct sim_text sim_text_inside(struct sim_text v)
{
    return is_list(v) ? (struct sim_text){ v.p + 1, v.end - 1 } : (struct sim_text){ "", "" };
}

int sim_text_next(struct sim_text *left, struct sim_text *key, struct sim_text *value)
{
    left->p = lead(left->p, left->end);
    if (key != NULL && left->p < left->end) {
        *key = (struct sim_text){ left->p, skip(left->p, left->end) };
        left->p = lead(key->end, left->end);
    }
    if (left->p == left->end)
        return 0;
    *value = (struct sim_text){ left->p, skip(left->p, left->end) };
    left->p = value->end;
    return 1;
}

int sim_text_begins(struct sim_text string, const char *with)
{
    const size_t n = strlen(with);
    return (size_t)(string.end - string.p) > n && *string.p == '"' && memcmp(string.p + 1, with, n) == 0;
}

int sim_text_is(struct sim_text string, const char *text)
{
    return sim_text_begins(string, text) && (size_t)(string.end - string.p) == strlen(text) + 2;
}

struct sim_text sim_text_member(struct sim_text of, const char *name)
{
    struct sim_text left = sim_text_inside(of), key, value;
    while (of.p != NULL && *of.p == '{' && sim_text_next(&left, &key, &value))
        if (sim_text_is(key, name))
            return value;
    return (struct sim_text){ NULL, NULL };
}

uint64_t sim_text_number(struct sim_text v, uint64_t usual)
{
    const double x = v.p != NULL && *v.p >= '0' && *v.p <= '9' ? strtod(v.p, NULL) : -1.0; /* the text ends in a '\0' */
    return x >= 0.0 && x <= 4294967295.0 ? (uint64_t)x : usual;
}
