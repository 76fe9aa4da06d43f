/* A stream in memory.
 *
 * SPDX-License-Identifier: MIT
 */
#include "answer.h"

#include <stdlib.h>

static FILE *stream;
static char *text;
static size_t bytes;

FILE *answer_begin(void)
{
    free(text);
    text = NULL;
    stream = open_memstream(&text, &bytes);
    return stream;
}

const char *answer_end(void)
{
    (void)fclose(stream);
    return text;
}

void answer_text(FILE *f, const char *from)
{
    (void)putc('"', f);
    for (const unsigned char *p = (const unsigned char *)from; *p != '\0'; p++)
        if (*p == '"' || *p == '\\')
            (void)fprintf(f, "\\%c", *p);
        else if (*p < 0x20)
            (void)fprintf(f, "\\u%04x", *p);
        else
            (void)putc(*p, f);
    (void)putc('"', f);
}
