/* Words and rows of numbers: see convert_text.h.
 *
 * SPDX-License-Identifier: MIT
 */
#include "convert_text.h"

#include <ctype.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#define COLUMNS 100

const char *sim_text_exact(char text[32], double v)
{
    for (int digits = 15; digits <= 17; digits++) {
        (void)snprintf(text, 32, "%.*g", digits, v + 0.0);
        if (strtod(text, NULL) == v)
            break;
    }
    return text;
}

void sim_text_quote(FILE *f, const char *name)
{
    (void)fputc('"', f);
    for (int n = 0; *name != '\0' && n < 40; name++, n++)
        (void)fputc(isascii((unsigned char)*name) &&
                            (isalnum((unsigned char)*name) || strchr(" ._,+=@#-()", *name) != NULL)
                        ? *name
                        : '_',
                    f);
    (void)fputc('"', f);
}

const char *sim_text_last_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash != NULL ? slash + 1 : path;
}

const char *sim_texels_name(enum sim_texels format)
{
    static const char *const names[] = {
        [SIM_TEXELS_565] = "565",   [SIM_TEXELS_PAL8] = "pal8",   [SIM_TEXELS_PAL4] = "pal4",
        [SIM_TEXELS_4444] = "4444", [SIM_TEXELS_PAL8A] = "pal8a", [SIM_TEXELS_PAL4A] = "pal4a"
    };
    return names[format];
}

void sim_text_put(struct sim_text_row *row, const char *format, ...)
{
    char text[160];
    va_list args;
    va_start(args, format);
    const int n = vsnprintf(text, sizeof text, format, args);
    va_end(args);
    if (row->column + n > COLUMNS && row->column > 0) {
        (void)fputc('\n', row->f);
        row->column = 0;
    }
    (void)fputs(text, row->f);
    row->column += n;
}
