/* FNV-1a, 64 bits: a hash of bytes, one after the other.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef FNV1A_H
#define FNV1A_H

#include <stddef.h>
#include <stdint.h>

#define FNV1A_BASIS 14695981039346656037u /* the hash of no bytes */

/* The hash of what `hash` is of, and these bytes behind it. */
static inline uint64_t fnv1a(uint64_t hash, const void *of, size_t bytes)
{
    const uint8_t *b = of;
    for (size_t i = 0; i < bytes; i++)
        hash = (hash ^ b[i]) * 1099511628211u;
    return hash;
}

#endif
