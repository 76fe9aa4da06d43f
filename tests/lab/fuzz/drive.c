/* A libFuzzer target without libFuzzer: its seeds, and what mutations make of them.
 *
 *   NAME CORPUS SEED cases N       cases 1 .. N of a seed
 *   NAME CORPUS SEED case K        one of them again; it is written to ./NAME.input
 *   NAME CORPUS write DIR          all seeds as files, for libFuzzer
 *   NAME replay FILE...            what libFuzzer has found
 *
 * CORPUS is a text: seeds, each ended by a line feed and a line of two percent signs; in them, \xHH is a byte.
 *
 * SPDX-License-Identifier: MIT
 */
#include <string.h>

#include "input.h"
#include "prng.h"
#include "replay.h"
#include "target.h"

#define ROOM 8192
#define SEEDS 120

struct input {
    uint8_t byte[ROOM];
    size_t size;
};

static struct input seeds[SEEDS];
static uint32_t n_seeds;

static int digit(char c)
{
    return c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}

static void seeds_read(const char *name)
{
    static char line[4096];
    FILE *in = fopen(name, "r");
    if (!in) {
        fprintf(stderr, "%s: cannot be read\n", name);
        exit(2);
    }
    struct input *s = &seeds[0];
    while (n_seeds + 1 < SEEDS && fgets(line, sizeof line, in)) {
        if (strcmp(line, "%%\n") == 0) {
            s->size -= s->size != 0; /* the line feed before it */
            s = &seeds[++n_seeds];
            continue;
        }
        for (const char *p = line; *p && s->size < ROOM; p++) {
            const int escaped = p[0] == '\\' && p[1] == 'x' && digit(p[2]) >= 0 && digit(p[3]) >= 0;
            s->byte[s->size++] = (uint8_t)(escaped ? digit(p[2]) * 16 + digit(p[3]) : *p);
            p += escaped ? 3 : 0;
        }
    }
    fclose(in);
    for (uint32_t k = 0; n_seeds < SEEDS; k++, n_seeds++)
        if (!(seeds[n_seeds].size = target_seed(k, seeds[n_seeds].byte, ROOM)))
            break;
}

/* Put n bytes in at a place; what no longer fits is lost. */
static void insert(struct input *f, size_t at, const void *from, size_t n)
{
    if (at + n > ROOM)
        n = ROOM - at;
    size_t rest = f->size - at;
    if (at + n + rest > ROOM)
        rest = ROOM - at - n;
    memmove(f->byte + at + n, f->byte + at, rest);
    memcpy(f->byte + at, from, n);
    f->size = at + n + rest;
}

static void cut(struct input *f, size_t at, size_t n)
{
    n = at + n > f->size ? f->size - at : n;
    memmove(f->byte + at, f->byte + at + n, f->size - at - n);
    f->size -= n;
}

static void mutate(struct input *f, struct prng *p)
{
    uint32_t n_words = 0;
    while (target_words[n_words])
        n_words++;
    const size_t at = f->size ? prng_pick(p, (uint32_t)f->size) : 0;
    if (!f->size) {
        insert(f, 0, "\n", 1);
        return;
    }
    switch (prng_pick(p, 9)) {
    case 0: f->byte[at] = (uint8_t)prng_next(p); break;
    case 1: f->byte[at] ^= (uint8_t)(1u << prng_pick(p, 8)); break;
    case 2: f->byte[at] = (uint8_t)(f->byte[at] + 2u * prng_pick(p, 2) - 1u); break;
    case 3: cut(f, at, 1 + prng_pick(p, 24)); break;
    case 4: f->size = at; break;
    case 5: { /* a part of another seed */
        const struct input *other = &seeds[prng_pick(p, n_seeds)];
        const size_t from = other->size ? prng_pick(p, (uint32_t)other->size) : 0;
        const size_t n = 1 + prng_pick(p, 60);
        insert(f, at, other->byte + from, from + n > other->size ? other->size - from : n);
        break;
    }
    case 6: { /* a part of its own once more */
        uint8_t part[40];
        const size_t n = f->size - at < sizeof part ? f->size - at : sizeof part;
        memcpy(part, f->byte + at, n);
        insert(f, prng_pick(p, (uint32_t)f->size), part, n);
        break;
    }
    default: {
        const char *w = target_words[prng_pick(p, n_words)];
        const size_t n = strlen(w) + (strlen(w) == 1); /* with its 0: a word of two bytes */
        if (prng_pick(p, 2))
            cut(f, at, n);
        insert(f, at, w, n);
        break;
    }
    }
}

static void run_case(unsigned long long seed, unsigned long long number, int keep)
{
    static struct input f;
    struct prng p = input_case(seed, number);
    f = seeds[number <= n_seeds ? number - 1 : prng_pick(&p, n_seeds)]; /* first each as it is */
    for (uint32_t n = number <= n_seeds ? 0 : 1u << prng_pick(&p, 5); n > 0; n--)
        mutate(&f, &p);
    char name[100];
    snprintf(name, sizeof name, "%s.input", target_name);
    if (keep && input_save(name, f.byte, f.size))
        exit(1);
    input_run(f.byte, f.size);
}

int main(int argc, char **argv)
{
    int bad = 0;
    for (int i = 2; argc > 2 && strcmp(argv[1], "replay") == 0 && i < argc; i++)
        bad |= input_replay(target_name, argv[i], ROOM);
    if (argc > 2 && strcmp(argv[1], "replay") == 0)
        return bad;
    if (argc < 4) {
        fprintf(stderr, "usage: %s CORPUS SEED cases N | CORPUS SEED case K | CORPUS write DIR | replay FILE...\n",
                argv[0]);
        return 2;
    }
    seeds_read(argv[1]);
    if (strcmp(argv[2], "write") == 0) {
        for (uint32_t k = 0; k < n_seeds; k++) {
            char name[4096];
            snprintf(name, sizeof name, "%s/seed-%03u", argv[3], k);
            bad |= input_save(name, seeds[k].byte, seeds[k].size);
        }
        return bad;
    }
    const unsigned long long seed = strtoull(argv[2], NULL, 0);
    const unsigned long long n = argc > 4 ? strtoull(argv[4], NULL, 0) : 0;
    replay_arm(target_name, "%s %s %llu case", argv[0], argv[1], seed);
    if (strcmp(argv[3], "case") == 0) {
        run_case(seed, n, 1);
        printf("ok %s: case %llu\n", target_name, n);
        return 0;
    }
    for (unsigned long long k = 1; k <= n; k++)
        run_case(seed, k, 0);
    printf("ok stress_29_%s: %llu cases of seed %llu from %u seeds\n", target_name, n, seed, n_seeds);
    return 0;
}
