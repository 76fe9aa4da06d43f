/* STL: is it all there? Text ends in `endsolid`; binary says how long it is.
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
    return bytes - i >= 5 && memcmp(text + i, "solid", 5) == 0 &&
           memchr(text, '\0', bytes < 1024 ? bytes : 1024) == NULL;
}

/* Has each line of a vertex three numbers? A facet with more than three vertices is noted: assimp reads its first. */
static int check_vertices(struct sim_lost *lost, const char *file, const char *text, size_t bytes)
{
    uint32_t line = 1, corners = 0;
    for (const char *p = text, *const end = text + bytes; p < end; line++) {
        const char *const from = p + strspn(p, " \t");
        const size_t n = strcspn(from, "\r\n");
        if (strncmp(from, "vertex", 6) == 0 && (from[6] == ' ' || from[6] == '\t')) {
            const char *at = from + 6;
            char *stop;
            int numbers = 0;
            while (numbers < 3 && ((void)strtod(at, &stop), stop != at && stop <= from + n)) {
                at = stop;
                numbers++;
            }
            if (numbers < 3)
                return sim_refuse(file, line, "'%.*s' is not a vertex of three numbers", (int)(n < 40 ? n : 40), from);
            if (++corners == 4)
                sim_lose(lost, SIM_LOST_CORNERS, "");
        } else if (strncmp(from, "facet", 5) == 0) {
            corners = 0;
        }
        p = from + n;
        p += p < end && p[0] == '\r' && p[1] == '\n' ? 2 : 1;
    }
    return SIM_OK;
}

int sim_stl_check(struct sim_lost *lost, const char *file, const char *text, size_t bytes)
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
    if (!is_text(text, bytes) && strncasecmp(text + mark, "solid", 5) == 0 && memchr(text, '\0', bytes) == NULL)
        return sim_refuse(file, 0, "its words are not in small letters (`%.5s`); write them so, as by tr A-Z a-z",
                          text + mark);
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
    if (text[0] != 's')
        return sim_refuse(file, 0, "begins with blanks in place of `solid`; export the model again");
    size_t end = bytes;
    while (end > 0 && strchr(" \t\r\n", text[end - 1]) && text[end - 1] != '\0')
        end--;
    size_t from = end;
    while (from > 0 && text[from - 1] != '\n' && text[from - 1] != '\r')
        from--;
    while (from < end && (text[from] == ' ' || text[from] == '\t'))
        from++;
    if (end - from < 8 || memcmp(text + from, "endsolid", 8) != 0)
        return sim_refuse(file, 0, "cut off: its last line is not `endsolid`; get the whole file");
    if (strstr(text, "facet") == NULL)
        return sim_refuse(file, 0, "no faces in it");
    return check_vertices(lost, file, text, bytes);
}
