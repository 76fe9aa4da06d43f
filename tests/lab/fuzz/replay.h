/* How a fuzzer's or the stress runner's case is run again: what a crash says.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef TESTS_FUZZ_REPLAY_H
#define TESTS_FUZZ_REPLAY_H

/* From the first replay_case() on, what ends the program says "FAILED NAME: replay with: COMMAND NUMBER" on stderr: a
 * finding of a sanitizer, a trap (ZS_ASSERT), abort(), a case that takes too long; without ASan a stray access too.
 * name, and the command by format: copied, cut at 300 characters together. */
void replay_arm(const char *name, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* A case begins, and hangs if it takes longer than some seconds (0: no limit). number >= 1. */
void replay_case(unsigned long long number, unsigned seconds);

/* Say the line for the case that runs. */
void replay_say(void);

#endif
