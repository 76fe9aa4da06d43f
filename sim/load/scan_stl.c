/* STL: is it all there? Text ends in `endsolid`; binary says how long it is. assimp takes words in small letters alone,
 * and after `endsolid` it ends at the first line that is not `solid`: it gets the text so that it loses nothing.
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "scan.h"
#include "sim.h"

static uint32_t u32(const char *p)
{
    const unsigned char *b = (const unsigned char *)p;
    return (uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
}

static int is_text(const char *text, size_t bytes)
{
    size_t i = 0;
    while (i < bytes && strchr(" \t\r\n", text[i]) && text[i] != '\0')
        i++;
    return bytes - i >= 5 && strncasecmp(text + i, "solid", 5) == 0 &&
           memchr(text, '\0', bytes < 1024 ? bytes : 1024) == NULL;
}

/* Is it the word at p? */
static int is_word(const char *p, const char *word)
{
    const size_t n = strlen(word);
    return strncasecmp(p, word, n) == 0 && (p[n] == '\0' || strchr(" \t\r\n", p[n]) != NULL);
}

/* Does a word stand anywhere in a line? */
static int has_word(const char *line, size_t n, const char *word)
{
    for (size_t i = 0; i < n; i++)
        if ((i == 0 || line[i - 1] == ' ' || line[i - 1] == '\t') && is_word(line + i, word))
            return 1;
    return 0;
}

/* Does a solid end in a line, that is not its first? `end solid`, which assimp passes over, may be the last. */
static int ends_solid(const char *line, size_t n)
{
    return has_word(line, n, "endsolid") || (is_word(line, "end") && has_word(line, n, "solid"));
}

/* The word after the one at p, in a line that ends at `end`. */
static char *next_word(char *p, const char *end)
{
    while (p < end && *p != ' ' && *p != '\t')
        p++;
    while (p < end && (*p == ' ' || *p == '\t'))
        p++;
    return p;
}

/* The first facet behind `solid` or `endsolid` and a name, which has no `facet normal`; the line's end: none. */
static char *facets_behind(char *word, char *end)
{
    char *p = next_word(word, end);
    while (p < end && !(is_word(p, "facet") && is_word(next_word(p, end), "normal")))
        p = next_word(p, end);
    return p;
}

/* Small letters, up to the name of a solid. */
static void lower(char *p, const char *end)
{
    for (int named = 0; p < end && !(named && (*p == ' ' || *p == '\t')); p++) {
        named |= is_word(p, "endsolid") || is_word(p, "solid");
        *p = (char)(*p >= 'A' && *p <= 'Z' ? *p - 'A' + 'a' : *p);
    }
}

/* Has a vertex three numbers? */
static int check_vertex(const char *file, uint32_t number, const char *vertex, size_t n)
{
    const char *at = vertex + 6;
    char *stop;
    int numbers = 0;
    while (numbers < 3 && ((void)strtod(at, &stop), stop != at && stop <= vertex + n)) {
        at = stop;
        numbers++;
    }
    return numbers == 3 ? SIM_OK
                        : sim_refuse(file, number, "'%.*s' is not a vertex of three numbers", (int)(n < 40 ? n : 40),
                                     vertex);
}

/* The vertices of a line, of which a facet may have several. A facet with more than three is noted: assimp reads its
 * first. */
static int check_vertices(struct sim_lost *lost, const char *file, uint32_t number, char *p, char *end,
                          uint32_t *corners)
{
    int status = SIM_OK;
    for (; status == SIM_OK && p < end; p = next_word(p, end))
        if (is_word(p, "endsolid")) {
            return facets_behind(p, end) == end
                       ? SIM_OK
                       : sim_refuse(file, number, "facets stand behind `endsolid`; begin a line there");
        } else if (is_word(p, "vertex")) {
            status = check_vertex(file, number, p, (size_t)(end - p));
            if (++*corners == 4)
                sim_lose(lost, SIM_LOST_CORNERS, "");
        } else if (is_word(p, "facet")) {
            *corners = 0;
        }
    return status;
}

/* What stands between solids becomes blanks. */
static int check_lines(struct sim_lost *lost, const char *file, char *text, size_t bytes)
{
    static const char *const inside[] = { "facet", "outer", "vertex", "endloop", "endfacet" };
    uint32_t line = 1, corners = 0;
    int open = 0, status = SIM_OK;
    for (char *p = text, *const end = text + bytes; status == SIM_OK && p < end; line++) {
        char *const from = p + strspn(p, " \t");
        const size_t n = strcspn(from, "\r\n");
        int known = 0;
        for (size_t i = 0; i < sizeof inside / sizeof inside[0]; i++)
            known |= is_word(from, inside[i]);
        if (known && !open)
            status = sim_refuse(file, line, "'%.*s' is outside a solid; put `solid` before it",
                                (int)(n < 40 ? n : 40), from);
        open |= is_word(from, "solid");
        char *const facets = is_word(from, "solid") ? facets_behind(from, from + n) : from;
        if (!open) {
            memset(from, ' ', n);
        } else if (known || is_word(from, "solid") || is_word(from, "endsolid")) {
            lower(from, from + n);
            lower(facets, from + n);
        }
        if (status == SIM_OK && (known || facets != from || is_word(from, "endsolid")))
            status = check_vertices(lost, file, line, facets, from + n, &corners);
        open = open && !has_word(facets, (size_t)(from + n - facets), "endsolid");
        p = from + n;
        p += p < end && p[0] == '\r' && p[1] == '\n' ? 2 : 1;
    }
    return status;
}

int sim_stl_check(struct sim_lost *lost, const char *file, char *text, size_t bytes)
{
    const uint64_t n = bytes >= 84 ? u32(text + 80) : 0;
    const int binary = bytes >= 84 && bytes == 84 + 50 * n;
    for (int i = 0; binary && i <= 74; i++)
        if (memcmp(text + i, "COLOR=", 6) == 0) { /* red and blue the other way round, and bit 15 too */
            sim_lose(lost, SIM_LOST_COLORS, "of Materialise Magics");
            break;
        }
    if (binary)
        return n > 0 ? SIM_OK : sim_refuse(file, 0, "no faces in it");
    const size_t mark = bytes >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0 ? 3 : 0;
    if (mark > 0 && is_text(text + mark, bytes - mark))
        return sim_refuse(file, 0, "begins with a UTF-8 byte order mark; save it without one, as by tail -c +4");
    if (!is_text(text, bytes)) {
        if (bytes < 84)
            return sim_refuse(file, 0, "cut off: %zu bytes are no STL file; get the whole file",
                              bytes);
        if (bytes < 84 + 50 * n)
            return sim_refuse(file, 0,
                              "cut off: %llu faces take %llu bytes, it has %zu; get the whole file",
                              (unsigned long long)n, (unsigned long long)(84 + 50 * n), bytes);
        return sim_refuse(file, 0,
                          "is longer than it says: %llu faces take %llu bytes, it has %zu; export the model again",
                          (unsigned long long)n, (unsigned long long)(84 + 50 * n), bytes);
    }
    if (text[0] != 's' && text[0] != 'S')
        return sim_refuse(file, 0, "begins with blanks in place of `solid`; export the model again");
    size_t end = bytes;
    while (end > 0 && strchr(" \t\r\n", text[end - 1]) && text[end - 1] != '\0')
        end--;
    size_t from = end;
    while (from > 0 && text[from - 1] != '\n' && text[from - 1] != '\r')
        from--;
    while (from < end && (text[from] == ' ' || text[from] == '\t'))
        from++;
    if (!ends_solid(text + from, end - from))
        return sim_refuse(file, 0, "cut off: its last line is not `endsolid`; get the whole file");
    const int status = check_lines(lost, file, text, bytes);
    return status == SIM_OK && strstr(text, "facet") == NULL ? sim_refuse(file, 0, "no faces in it") : status;
}
