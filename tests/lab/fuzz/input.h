/* Bytes for a libFuzzer target without libFuzzer.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef TESTS_FUZZ_INPUT_H
#define TESTS_FUZZ_INPUT_H

#include <stddef.h>
#include <stdint.h>

#include "prng.h"
#include "replay.h"

/* A case begins: the generator that makes it. */
static inline struct prng input_case(unsigned long long seed, unsigned long long number)
{
    struct prng p = { seed * 0x9e3779b97f4a7c15u ^ number };
    replay_case(number, 60);
    (void)prng_next(&p);
    return p;
}

/* Run the target on them, in a block of exactly their size, so that reading beyond is seen. */
void input_run(const uint8_t *byte, size_t size);
/* 0; 1 after a sentence on stderr: it cannot be written. */
int input_save(const char *name, const uint8_t *byte, size_t size);
/* Run the target on a file's first bytes, at most `most`, for at most a minute. 0; 1: it cannot be read. */
int input_replay(const char *target, const char *name, size_t most);

#endif
