/* A line of text: a board may send it by itself, so that it is written whole.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef LINE_H
#define LINE_H

#include "hal.h"
#include "number.h"

static char line[96];
static uint32_t line_n;

/* Append; what does not fit is left out. */
static inline void put(const char *text)
{
    while (*text && line_n + 1u < sizeof line)
        line[line_n++] = *text++;
}

static inline void put_number(uint64_t v)
{
    char room[NUMBER_CHARS];
    put(number_text(room, v));
}

/* Write what was put and a line feed, and begin anew. */
static inline void put_end(void)
{
    put("\n");
    line[line_n] = '\0';
    hal_write(line);
    line_n = 0;
}

#endif
