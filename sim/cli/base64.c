/* See base64.h.
 *
 * SPDX-License-Identifier: MIT
 */
#include "base64.h"

#include <string.h>

#include "sim.h"

static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

void sim_base64_encode(char *out, const void *bytes, size_t n)
{
    const uint8_t *const in = bytes;
    for (size_t i = 0; i < n; i += 3) {
        uint32_t v = 0;
        for (size_t k = 0; k < 3; k++)
            v = v << 8 | (i + k < n ? in[i + k] : 0u);
        for (unsigned k = 0; k < 4; k++)
            *out++ = i + k > n ? '=' : digits[v >> (18 - 6 * k) & 63];
    }
    *out = '\0';
}

uint8_t *sim_base64_decode(const char *p, const char *end, size_t *n)
{
    uint8_t *out = sim_alloc((size_t)(end - p) + 1, 1);
    uint32_t v = 0;
    *n = 0;
    for (unsigned bits = 0; p < end && *p != '='; p++) {
        const char *at = *p != '\0' ? strchr(digits, *p) : NULL;
        v = v << 6 | (at != NULL ? (uint32_t)(at - digits) : 0);
        bits += 6;
        if (bits >= 8)
            out[(*n)++] = (uint8_t)(v >> (bits -= 8));
    }
    return out;
}
