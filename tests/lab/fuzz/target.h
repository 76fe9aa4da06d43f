/* What the libFuzzer targets share, and what drive.c needs of one to run it without libFuzzer.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef TESTS_FUZZ_TARGET_H
#define TESTS_FUZZ_TARGET_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

/* libFuzzer's entry; 0. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* Of the target: its name; words to throw in, a NULL at the end; seeds beside those of its corpus's text, the kth into
 * to[room]: its size, 0: there is none. */
extern const char target_name[];
extern const char *const target_words[];
size_t target_seed(uint32_t k, uint8_t *to, size_t room);

#define EXPECT(condition) \
    do { \
        if (!(condition)) { \
            dprintf(2, "wrong: %s:%d: %s\n", __FILE__, __LINE__, #condition); \
            abort(); \
        } \
    } while (0)

/* What is written to stdout and stderr between begin and end: stdout goes nowhere, stderr's lines are counted. */
struct said {
    char text[65536];
    size_t lines;
};
void said_begin(struct said *s);
void said_end(struct said *s);

#endif
