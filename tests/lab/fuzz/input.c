/* Bytes for a libFuzzer target: see input.h.
 *
 * SPDX-License-Identifier: MIT
 */
#include "input.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "target.h"

void input_run(const uint8_t *byte, size_t size)
{
    uint8_t *exact = malloc(size ? size : 1);
    if (!exact)
        abort();
    memcpy(exact, byte, size);
    (void)LLVMFuzzerTestOneInput(exact, size);
    free(exact);
}

int input_save(const char *name, const uint8_t *byte, size_t size)
{
    FILE *out = fopen(name, "wb");
    if (!out || fwrite(byte, 1, size, out) != size || fclose(out)) {
        fprintf(stderr, "%s: cannot be written\n", name);
        return 1;
    }
    return 0;
}

int input_replay(const char *target, const char *name, size_t most)
{
    FILE *in = fopen(name, "rb");
    if (!in) {
        fprintf(stderr, "%s: cannot be read\n", name);
        return 1;
    }
    uint8_t *byte = malloc(most);
    if (!byte)
        abort();
    const size_t size = fread(byte, 1, most, in);
    fclose(in);
    (void)alarm(60);
    input_run(byte, size);
    free(byte);
    printf("ok %s: %s\n", target, name);
    return 0;
}
