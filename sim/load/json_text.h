/* Looking values up in JSON text, as far as it is well-formed: what is not is nothing.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_JSON_TEXT_H
#define SIM_JSON_TEXT_H

#include <stddef.h>
#include <stdint.h>

/* A part of the text, which ends in a '\0' somewhere behind it: a value, or what is left of a list. p NULL: none. */
struct sim_text {
    const char *p, *end;
};

/* What is in an array or object, for sim_text_next; of other values nothing. */
struct sim_text sim_text_inside(struct sim_text value);

/* The next value of what is left, of an object with its key (else NULL); 0: there is none. */
int sim_text_next(struct sim_text *left, struct sim_text *key, struct sim_text *value);

struct sim_text sim_text_member(struct sim_text object, const char *name);

/* Is it this string, or does it begin with it? Escapes are not read. */
int sim_text_is(struct sim_text string, const char *text);
int sim_text_begins(struct sim_text string, const char *with);

/* A whole number of 0 to 2^32 - 1; `usual` where there is none. */
uint64_t sim_text_number(struct sim_text value, uint64_t usual);

#endif
