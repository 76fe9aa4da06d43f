/* Words and rows of numbers in the C text that `zsim convert` writes.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_CONVERT_TEXT_H
#define SIM_CONVERT_TEXT_H

#include <stdint.h>
#include <stdio.h>

#include "convert.h"

/* The shortest decimal that reads back as the same double, into text, which is returned. */
const char *sim_text_exact(char text[32], double v);

/* Write a name from a file, in quotes, as it may stand in a comment. */
void sim_text_quote(FILE *f, const char *name);

/* The last part of a path; points into it. */
const char *sim_text_last_name(const char *path);

/* The name of a texel format, as options have it. */
const char *sim_texels_name(enum sim_texels format);

/* Elements one after another, broken where a line is full. Begin: { f, 0 }. */
struct sim_text_row {
    FILE *f;
    int column;
};

void sim_text_put(struct sim_text_row *row, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Write an array NAME_what_part of numbers of 16 bits, or (v16 NULL) of 8. */
void sim_convert_numbers(FILE *f, const char *name, uint32_t part, const char *what, const uint16_t *v16,
                         const uint8_t *v8, size_t n);

/* Write the arrays of mesh `part`. fine: 1: the low bits of positions too. */
void sim_convert_arrays(FILE *f, const char *name, uint32_t part, const struct sim_piece *p, int fine);

#endif
