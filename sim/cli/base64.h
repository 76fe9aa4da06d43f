/* Base64 of RFC 4648.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_BASE64_H
#define SIM_BASE64_H

#include <stddef.h>
#include <stdint.h>

/* Characters for n bytes, with the '\0'. */
#define SIM_BASE64_CHARS(n) (((size_t)(n) + 2u) / 3u * 4u + 1u)

/* n bytes as text. out: [SIM_BASE64_CHARS(n)]. */
void sim_base64_encode(char *out, const void *bytes, size_t n);

/* The bytes of text from p to end, up to the first '='; a character that is none of the 64 counts as 'A'. malloc'ed, at
 * least one byte. */
uint8_t *sim_base64_decode(const char *p, const char *end, size_t *n);

#endif
