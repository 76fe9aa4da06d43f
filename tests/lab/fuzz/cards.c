/* Cards for fuzz_mesh.c: seeds from random worlds, a fuzzer of its own that only mutates them, and replays.
 *
 *   cards write DIR N       N seeds for libFuzzer
 *   cards SEED cases N      seeds and what mutations make of them, without libFuzzer: cases 1 .. N
 *   cards SEED case K       one of them again; it is written to ./card
 *   cards replay FILE...    what libFuzzer has found
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "card.h"
#include "input.h"
#include "kinds.h"
#include "replay.h"
#include "world.h"

struct file {
    uint8_t byte[CARD_BYTES_MAX];
    size_t size;
};

/* What does not fit is cut off. */
static void put(struct file *f, const void *from, size_t bytes)
{
    const size_t room = sizeof f->byte - f->size, n = bytes < room ? bytes : room;
    if (n)
        memcpy(f->byte + f->size, from, n);
    f->size += n;
}

static void card_write(struct file *f, const struct zs_mesh *m, const struct zs_texture *t, struct prng *p)
{
    struct card_header h = { .n_verts = m->n_verts, .n_tris = m->n_tris, .n_clusters = m->n_clusters,
                             .scale = m->scale, .radius = m->radius, .uv_bits = m->uv_bits, .log2_w = t->log2_w,
                             .log2_h = t->log2_h, .clamp = t->clamp, .n_colors = t->n_colors };
    memcpy(h.center, m->center, sizeof h.center);
    h.yaw = (zs_turn)prng_next(p);
    h.pitch = (int16_t)prng_next(p);
    h.distance = (uint8_t)(one_in(p, 3) ? prng_next(p) : 100u + prng_pick(p, 100));
    h.depth = (uint8_t)prng_pick(p, KINDS(kind_depths));
    h.look = (uint8_t)prng_next(p);
    if ((h.look & CARD_CULL) == CARD_CULL)
        h.look &= (uint8_t)~2u;
    h.look |= one_in(p, 4) ? 0u : 4u; /* mostly both sides */
    if (h.look & CARD_ORTHOGRAPHIC)
        h.depth = 1;
    h.state = (uint8_t)(one_in(p, 2) ? 0 : prng_next(p));
    h.texel = KINDS(kind_texels);
    for (size_t k = 0; k < KINDS(kind_texels); k++)
        if (kind_texels[k].format == t->format)
            h.texel = (uint8_t)k;
    if (one_in(p, 16))
        *(one_in(p, 2) ? &h.log2_w : &h.log2_h) = (uint8_t)(one_in(p, 2) ? 0 : 11);
#define BIT(bit, field, count) h.arrays |= (uint8_t)(m->field ? (bit) : 0);
    CARD_ARRAYS(BIT)
#undef BIT
    f->size = 0;
    put(f, &h, sizeof h);
    put(f, m->pos, m->n_verts * sizeof *m->pos);
    put(f, m->tri, m->n_tris * sizeof *m->tri);
#define PUT(bit, field, count) \
    if (m->field) \
        put(f, m->field, m->count * sizeof *m->field);
    CARD_ARRAYS(PUT)
#undef PUT
    if (h.texel == KINDS(kind_texels) || !t->texel || t->log2_w > 10 || t->log2_h > 10)
        return;
    if (t->palette)
        put(f, t->palette, t->n_colors * sizeof *t->palette);
    put(f, t->texel, ((size_t)kind_texels[h.texel].bits << (t->log2_w + t->log2_h)) / 8u);
}

static void card_make(struct file *f, struct prng *p)
{
    static struct world w;
    world_make(&w, p, one_in(p, 3) ? 30 : 0);
    card_write(f, &w.mesh[prng_pick(p, WORLD_MESHES)], &w.texture[prng_pick(p, WORLD_TEXTURES)], p);
    world_free(&w);
}

static void mutate(struct file *f, struct prng *p)
{
    static const int16_t ends[] = { -32768, 32767, -1, 0, 1, 255, 256, -2 };
    const size_t near_front = one_in(p, 2) && f->size > 40 ? 40 : f->size;
    const size_t at = prng_pick(p, (uint32_t)near_front), even = at & ~(size_t)1;
    switch (prng_pick(p, 6)) {
    case 0: f->byte[at] = (uint8_t)prng_next(p); break;
    case 1: f->byte[at] ^= (uint8_t)(1u << prng_pick(p, 8)); break;
    case 2: f->byte[at] = (uint8_t)(f->byte[at] + 2u * prng_pick(p, 2) - 1u); break;
    case 3:
        if (even + 2 <= f->size)
            memcpy(f->byte + even, &ends[prng_pick(p, 8)], 2);
        break;
    case 4: {
        const size_t from = prng_pick(p, (uint32_t)f->size), n = prng_pick(p, 64);
        if (from + n <= f->size && at + n <= f->size)
            memmove(f->byte + at, f->byte + from, n);
        break;
    }
    default:
        if (one_in(p, 4) && f->size > 40)
            f->size = 40 + prng_pick(p, (uint32_t)f->size - 40);
        break;
    }
}

static void run_case(unsigned long long seed, unsigned long long number, int keep)
{
    static struct file f;
    struct prng p = input_case(seed, number);
    card_make(&f, &p);
    for (uint32_t n = one_in(&p, 4) ? 0 : 1u << prng_pick(&p, 6); n > 0; n--)
        mutate(&f, &p);
    if (keep && input_save("card", f.byte, f.size))
        exit(1);
    input_run(f.byte, f.size);
}

static int write_seeds(const char *dir, unsigned long long n)
{
    static struct file f;
    for (unsigned long long k = 1; k <= n; k++) {
        struct prng p = { k };
        char name[4096];
        card_make(&f, &p);
        snprintf(name, sizeof name, "%s/seed-%03llu", dir, k);
        if (input_save(name, f.byte, f.size))
            return 1;
    }
    return 0;
}

int main(int argc, char **argv)
{
    if (argc == 4 && strcmp(argv[1], "write") == 0)
        return write_seeds(argv[2], strtoull(argv[3], NULL, 0));
    if (argc > 2 && strcmp(argv[1], "replay") == 0) {
        int bad = 0;
        for (int i = 2; i < argc; i++)
            bad |= input_replay("cards", argv[i], CARD_BYTES_MAX);
        return bad;
    }
    if (argc != 4) {
        fprintf(stderr, "usage: %s write DIR N | SEED cases N | SEED case K | replay FILE...\n", argv[0]);
        return 2;
    }
    const unsigned long long seed = strtoull(argv[1], NULL, 0);
    const unsigned long long n = strtoull(argv[3], NULL, 0);
    replay_arm("cards", "%s %llu case", argv[0], seed);
    if (strcmp(argv[2], "case") == 0) {
        run_case(seed, n, 1);
        printf("ok cards: case %llu\n", n);
        return 0;
    }
    for (unsigned long long k = 1; k <= n; k++)
        run_case(seed, k, 0);
    printf("ok stress_29_cards: %llu cases of seed %llu\n", n, seed);
    return 0;
}
