/* Lossless compression of depth tiles as planes.
 *
 * DPCM: a tile keeps its first key, the one to the right and the one below, which name a plane. A pixel of the first
 * row is predicted from the two to its left; of the first column, from the two above; any other is left + above - left
 * above. On a plane a residual is rounding alone, at most 2 either way: 3 bits. Residuals are kept in two's
 * complement:
 *   4:1 (32 bytes)   6 bytes of plane + 61 residuals of up to 3 bits (23 bytes)
 *   2:1 (64 bytes)   6 bytes of plane + 61 residuals of up to 7 bits (54 bytes)
 *   1:1 (128 bytes)  the keys
 * Differences are modulo 2^16, so that nothing overflows.
 *
 * SPDX-License-Identifier: MIT
 */
#include "planes.h"

#include <string.h>

#define N PLANES_TILE
#define CLEARED 65535u

static const int bits_of[PLANES_KINDS] = { 0, 3, 7, 16 };
static const uint32_t bytes_of[PLANES_KINDS] = { 0, PLANES_RAW / 4, PLANES_RAW / 2, PLANES_RAW };

/* What the pixels before (x, y) say of it. at(0, 0), (1, 0) and (0, 1) are kept. */
static uint16_t predicted(const uint16_t t[N][N], int x, int y)
{
    if (y == 0)
        return (uint16_t)(2 * t[0][x - 1] - t[0][x - 2]);
    if (x == 0)
        return (uint16_t)(2 * t[y - 1][0] - t[y - 2][0]);
    return (uint16_t)(t[y][x - 1] + t[y - 1][x] - t[y - 1][x - 1]);
}

static int kept(int x, int y)
{
    return x + y < 2 && x * y == 0;
}

static int16_t residual(const uint16_t t[N][N], int x, int y)
{
    return (int16_t)(uint16_t)(t[y][x] - predicted(t, x, y));
}

static enum planes_kind kind_of(const uint16_t t[N][N])
{
    int flat = 1, most = 0;
    for (int y = 0; y < N; y++)
        for (int x = 0; x < N; x++) {
            flat &= t[y][x] == CLEARED;
            if (kept(x, y))
                continue;
            const int r = residual(t, x, y), size = r < 0 ? -r - 1 : r;
            most = size > most ? size : most;
        }
    return flat ? PLANES_FLAT : most < 1 << (bits_of[PLANES_4] - 1) ? PLANES_4
           : most < 1 << (bits_of[PLANES_2] - 1) ? PLANES_2 : PLANES_1;
}

static void put(uint8_t *out, uint32_t *at, uint32_t value, int bits)
{
    for (int k = 0; k < bits; k++, (*at)++)
        out[*at / 8] = (uint8_t)(out[*at / 8] | (value >> k & 1u) << *at % 8);
}

static uint32_t get(const uint8_t *in, uint32_t *at, int bits)
{
    uint32_t value = 0;
    for (int k = 0; k < bits; k++, (*at)++)
        value |= (uint32_t)(in[*at / 8] >> *at % 8 & 1) << k;
    return value;
}

/* Pack a tile into bytes_of[kind] bytes, and unpack it again. Return 1 if it is the same. */
static int lossless(const uint16_t t[N][N], enum planes_kind kind)
{
    uint8_t room[PLANES_RAW] = { 0 };
    uint16_t back[N][N];
    uint32_t at = 0;
    const int bits = bits_of[kind];
    if (kind == PLANES_FLAT || kind == PLANES_1)
        return 1;
    for (int y = 0; y < N; y++)
        for (int x = 0; x < N; x++)
            put(room, &at, kept(x, y) ? t[y][x] : (uint16_t)residual(t, x, y), kept(x, y) ? 16 : bits);
    if (at > 8 * bytes_of[kind])
        return 0;
    at = 0;
    for (int y = 0; y < N; y++)
        for (int x = 0; x < N; x++) {
            const uint32_t v = get(room, &at, kept(x, y) ? 16 : bits);
            const uint32_t sign = 1u << (bits - 1);
            back[y][x] = kept(x, y) ? (uint16_t)v
                                    : (uint16_t)(predicted((const uint16_t(*)[N])back, x, y) + (v ^ sign) - sign);
        }
    return !memcmp(back, t, sizeof back);
}

void planes_strip(struct planes *p, const uint16_t *keys, int w, int h)
{
    uint32_t packed = 0, tiles = 0;
    for (int y = 0; y < h; y += N)
        for (int x = 0; x < w; x += N, tiles++) {
            uint16_t t[N][N];
            for (int j = 0; j < N; j++)
                for (int i = 0; i < N; i++)
                    t[j][i] = y + j < h && x + i < w ? keys[(y + j) * w + x + i] : (uint16_t)CLEARED;
            const enum planes_kind kind = kind_of((const uint16_t(*)[N])t);
            p->of[kind]++;
            p->wrong += !lossless((const uint16_t(*)[N])t, kind);
            packed += bytes_of[kind];
            if (kind == PLANES_4 || kind == PLANES_2) {
                p->pixels += N * N;
                /* of each residual: two additions, a mask, a shift, a sign (two), a store; a word of bits to load for
                 * every 32 / bits of them; three stores of the keys that are kept */
                p->operations += (N * N - 3) * 7 + (N * N - 3) * (uint32_t)bits_of[kind] / 32 * 2 + 3;
            }
        }
    packed += (tiles * 2 + 7) / 8;
    p->tiles += tiles;
    p->raw += tiles * PLANES_RAW;
    p->packed += packed;
    p->strip_raw = tiles * PLANES_RAW > p->strip_raw ? tiles * PLANES_RAW : p->strip_raw;
    p->worst = packed > p->worst ? packed : p->worst;
}
