/* Numbers as text, for applications.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef NUMBER_H
#define NUMBER_H

#include <stdint.h>

#define NUMBER_CHARS 21u /* of the longest, its NUL included */

/* Decimal digits of v, ending with a NUL at the end of room. Return where they begin. */
static inline const char *number_text(char room[NUMBER_CHARS], uint64_t v)
{
    char *at = room + NUMBER_CHARS - 1u;
    *at = '\0';
    do {
        *--at = (char)('0' + (char)(v % 10u));
        v /= 10u;
    } while (v);
    return at;
}

#endif
