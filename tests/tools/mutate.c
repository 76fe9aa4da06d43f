/* A program on copies of a file with a few bytes that are others, by a seed: flipped bits, bytes of 0 or 255, another
 * digit, a piece twice or left out.
 * mutate FILE SEED >COPY
 * mutate FILE FROM TO COPY PROGRAM ARGUMENT...   each seed's copy is written and PROGRAM run, a minute at most: what it
 *     says on standard error, and then a line: end SEED STATUS
 *
 * SPDX-License-Identifier: MIT
 */
#include <fcntl.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

enum { MOST = 1 << 19, MINUTE = 60 };

static uint32_t state;

static uint32_t below(size_t n)
{
    state ^= state << 13;
    state ^= state >> 17;
    state ^= state << 5;
    return (uint32_t)(state % n);
}

/* Twice the room, as pieces may be there twice; returns how many bytes they are afterwards. */
static size_t mutate(unsigned char *bytes, size_t n, int seed)
{
    state = 2654435761u * (uint32_t)(seed + 1);
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
    return n;
}

/* The status of the program as a shell has it. */
static int run(char **program)
{
    int status;
    (void)fflush(stdout);
    const pid_t child = fork();
    if (child == 0) {
        const int nothing = open("/dev/null", O_RDWR);
        if (nothing < 0 || dup2(STDOUT_FILENO, STDERR_FILENO) < 0 || dup2(nothing, STDOUT_FILENO) < 0 ||
            dup2(nothing, STDIN_FILENO) < 0)
            _exit(126);
        (void)alarm(MINUTE); /* it stays behind execv */
        (void)execv(program[0], program);
        _exit(127);
    }
    if (child < 0 || waitpid(child, &status, 0) != child)
        return 126;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

int main(int argc, char **argv)
{
    static unsigned char original[MOST], bytes[2 * MOST];
    FILE *f = argc == 3 || argc > 5 ? fopen(argv[1], "rb") : NULL;
    if (f == NULL)
        return 1;
    const size_t n = fread(original, 1, sizeof original, f);
    (void)fclose(f);
    const int first = atoi(argv[2]), last = argc == 3 ? first : atoi(argv[3]);
    for (int seed = first; seed <= last; seed++) {
        memcpy(bytes, original, n);
        const size_t now = mutate(bytes, n, seed);
        FILE *to = argc == 3 ? stdout : fopen(argv[4], "wb");
        if (to == NULL || fwrite(bytes, 1, now, to) != now || (to != stdout && fclose(to)))
            return 1;
        if (to != stdout)
            printf("end %d %d\n", seed, run(argv + 5));
    }
    return 0;
}
