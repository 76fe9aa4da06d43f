/* Answers of the engine as JSON text.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef WEB_ANSWER_H
#define WEB_ANSWER_H

#include <stdio.h>

/* A stream for the next answer, which answer_end ends: its text, '\0'-terminated, until the next answer_begin. */
FILE *answer_begin(void);
const char *answer_end(void);

/* A JSON string. */
void answer_text(FILE *f, const char *text);

#endif
