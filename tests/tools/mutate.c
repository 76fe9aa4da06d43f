/* A copy of a file with a few bytes that are others, by a seed: flipped bits, bytes of 0 or 255, another digit, a piece
 * twice or left out.
 * mutate FILE SEED >COPY
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static uint32_t state;

static uint32_t below(size_t n)
{
    state ^= state << 13;
    state ^= state >> 17;
    state ^= state << 5;
    return (uint32_t)(state % n);
}

int main(int argc, char **argv)
{
    static unsigned char bytes[1 << 20];
    FILE *f = argc == 3 ? fopen(argv[1], "rb") : NULL;
    if (f == NULL)
        return 1;
    size_t n = fread(bytes, 1, sizeof bytes / 2, f);
    (void)fclose(f);
    state = 2654435761u * (uint32_t)(atoi(argv[2]) + 1);
    for (uint32_t edits = 1 + below(4); n > 8 && edits > 0; edits--) {
        const size_t at = below(n), some = 1 + below(8);
        unsigned char *b = &bytes[at];
        switch (below(6)) {
        case 0:
            *b ^= (unsigned char)(1u << below(8));
            break;
        case 1:
            *b = below(2) != 0 ? 255 : 0;
            break;
        case 2: /* the next digit */
            while (b < bytes + n - 1 && (*b < '0' || *b > '9'))
                b++;
            *b = (unsigned char)('0' + below(10));
            break;
        case 3:
            memset(b, 255, at + some < n ? some : n - at);
            break;
        case 4: /* twice */
            memmove(b + some, b, n - at);
            n += some;
            break;
        default: /* left out */
            if (at + some < n) {
                memmove(b, b + some, n - at - some);
                n -= some;
            }
        }
    }
    return fwrite(bytes, 1, n, stdout) != n;
}
