/* Numbers as text, for applications.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef NUMBER_H
#define NUMBER_H

#include <stdint.h>

#define NUMBER_CHARS 21u /* of the longest, its NUL included */
#define HEX_CHARS 17u

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

/* The 16 hexadecimal digits of v and a NUL. Return room. */
static inline const char *number_hex(char room[HEX_CHARS], uint64_t v)
{
    room[16] = '\0';
    for (int i = 15; i >= 0; i--, v >>= 4)
        room[i] = "0123456789abcdef"[v & 15u];
    return room;
}

#endif
