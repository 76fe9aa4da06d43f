/* uf2 IN.bin OUT.uf2: a flash image as the file that is dragged onto the Pico's drive.
 *
 * UF2 (github.com/microsoft/uf2, "File format"): blocks of 512 bytes, all words least significant byte first: two magic
 * numbers, flags, address, payload size, block number, blocks in all, family; 476 bytes of room, of which the boot ROM
 * takes 256 (RP2040 datasheet, 2.8.4.1); a third magic number.
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define BLOCK 512u
#define PAYLOAD 256u
#define FLASH 0x10000000u
#define FLASH_BYTES (2u << 20)
#define FAMILY_RP2040 0xe48bff56u
#define FLAG_FAMILY 0x2000u

static void put(uint8_t *at, uint32_t v)
{
    for (uint32_t i = 0; i < 4; i++)
        at[i] = (uint8_t)(v >> 8 * i);
}

static int fail(const char *what, const char *name)
{
    fprintf(stderr, "uf2: %s: %s\n", name, what);
    return 1;
}

static int write_blocks(FILE *out, const uint8_t *image, uint32_t blocks)
{
    for (uint32_t i = 0; i < blocks; i++) {
        uint8_t b[BLOCK] = { 0 };
        const uint32_t head[8] = { 0x0a324655u, 0x9e5d5157u, FLAG_FAMILY, FLASH + i * PAYLOAD, PAYLOAD, i, blocks,
                                   FAMILY_RP2040 };
        for (uint32_t k = 0; k < 8; k++)
            put(b + 4 * k, head[k]);
        memcpy(b + 32, image + i * PAYLOAD, PAYLOAD);
        put(b + BLOCK - 4, 0x0ab16f30u);
        if (fwrite(b, 1, BLOCK, out) != BLOCK)
            return 1;
    }
    return 0;
}

int main(int argc, char **argv)
{
    if (argc != 3)
        return fail("usage: uf2 IN.bin OUT.uf2", "arguments");
    uint8_t *image = calloc(FLASH_BYTES + 1u, 1);
    FILE *in = fopen(argv[1], "rb");
    if (!image || !in)
        return fail("cannot be read", argv[1]);
    const size_t n = fread(image, 1, FLASH_BYTES + 1u, in);
    fclose(in);
    if (n == 0 || n > FLASH_BYTES)
        return fail("not 1 byte to 2 MB", argv[1]);
    FILE *out = fopen(argv[2], "wb");
    if (!out)
        return fail("cannot be written", argv[2]);
    int bad = write_blocks(out, image, ((uint32_t)n + PAYLOAD - 1u) / PAYLOAD);
    bad |= fclose(out);
    free(image);
    return bad ? fail("cannot be written", argv[2]) : 0;
}
