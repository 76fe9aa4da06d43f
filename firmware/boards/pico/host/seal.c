/* seal IN OUT.c: a second stage of at most 252 bytes becomes the 256 that the RP2040's boot ROM accepts, as C.
 *
 * The last four are the CRC-32 of the others, least significant byte first: polynomial 0x04c11db7 from the top bit,
 * begun with all ones, nothing reflected or inverted (RP2040 datasheet, 2.8.1.3.1).
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdint.h>
#include <stdio.h>

#define STAGE 256u
#define CODE (STAGE - 4u)

static uint32_t crc32(const uint8_t *at, uint32_t n)
{
    uint32_t crc = 0xffffffffu;
    for (uint32_t i = 0; i < n; i++) {
        crc ^= (uint32_t)at[i] << 24;
        for (int bit = 0; bit < 8; bit++)
            crc = crc & 0x80000000u ? crc << 1 ^ 0x04c11db7u : crc << 1;
    }
    return crc;
}

static int fail(const char *what, const char *name)
{
    fprintf(stderr, "seal: %s: %s\n", name, what);
    return 1;
}

int main(int argc, char **argv)
{
    uint8_t stage[STAGE + 1] = { 0 };
    if (argc != 3)
        return fail("usage: seal IN OUT.c", "arguments");
    FILE *in = fopen(argv[1], "rb");
    if (!in)
        return fail("cannot be read", argv[1]);
    const size_t n = fread(stage, 1, sizeof stage, in);
    fclose(in);
    if (n == 0 || n > CODE)
        return fail("not 1 to 252 bytes", argv[1]);
    const uint32_t crc = crc32(stage, CODE);
    for (uint32_t i = 0; i < 4; i++)
        stage[CODE + i] = (uint8_t)(crc >> 8 * i);
    FILE *out = fopen(argv[2], "w");
    if (!out)
        return fail("cannot be written", argv[2]);
    fprintf(out, "/* Made by seal from boot2.S: the boot ROM's second stage and its checksum. */\n"
                 "__attribute__((section(\".boot2\"), used)) const unsigned char boot2[%u] = {", STAGE);
    for (uint32_t i = 0; i < STAGE; i++)
        fprintf(out, "%s0x%02x,", i % 16 ? " " : "\n    ", stage[i]);
    fprintf(out, "\n};\n");
    return fclose(out) ? fail("cannot be written", argv[2]) : 0;
}
