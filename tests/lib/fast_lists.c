/* Lists of accelerators for tests.
 *
 * SPDX-License-Identifier: MIT
 */
#include "fast_lists.h"

#include <assert.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "accelerator_table.h"
#include "core/fast.h"
#include "core/job.h"

const struct zs_fast *const fast_all[] = { ZS_FAST_ALL, ZS_FAST_END };

static_assert(KNOWN + 1 == sizeof fast_all / sizeof fast_all[0], "all that ZS_FAST_ALL names");
static_assert(FAST_COUNT == KNOWN, "a bit each");

unsigned fast_count(void)
{
    return (unsigned)KNOWN;
}

const char *fast_name(unsigned k)
{
    return known[k].name;
}

const struct zs_fast *const *fast_of(unsigned bits)
{
    static const struct zs_fast *list[8][KNOWN + 1];
    static unsigned next;
    const struct zs_fast **const out = list[next++ % 8u], **at = out;
    for (unsigned k = 0; k < KNOWN; k++)
        if (bits >> k & 1u)
            *at++ = known[k].fast;
    *at = NULL;
    return out;
}

const struct zs_fast *const *fast_without(unsigned k)
{
    return fast_of(~(1u << k));
}

const struct zs_fast *const *fast_any(struct prng *p)
{
    return fast_of(prng_pick(p, FAST_ALL + 1));
}

/* ---- Lists that count ------------------------------------------------------------------------ */

uint32_t fast_used[FAST_COUNT], fast_at_once;

/* Copies, by their numbers, and what they are copies of. */
static struct copy {
    struct zs_fast fast; /* comes first: job->fast points to it */
    const struct zs_fast *of;
} copy[KNOWN];
static struct texel_copy {
    struct zs_fast_texel texel; /* comes first: job->texel points to it */
    unsigned number;
} texel_copy[KNOWN];
static struct zs_fast_touch touch_copy;
static struct zs_fast_tiles tiles_copy;
static struct zs_fast_batch batch_copy;
static struct zs_fast_clusters clusters_copy;

/* Numbers of those of the frame in `known`. */
#define NUMBER(name) NUMBER_##name,
enum {
    ZS_FAST_EACH(NUMBER) BATCH = NUMBER_batch,
    TOUCH = NUMBER_touch,
    TILES = NUMBER_tiles,
    CLUSTERS = NUMBER_clusters,
    EDGES = NUMBER_edges
};
static_assert(FAST_BATCH == 1 << BATCH && FAST_TOUCH == 1 << TOUCH && FAST_TILES == 1 << TILES &&
                  FAST_CLUSTERS == 1 << CLUSTERS && FAST_EDGES == 1 << EDGES, "bits as `known` has them");

static unsigned number_of(const struct zs_job *job)
{
    return (unsigned)((const struct copy *)(const void *)job->fast - copy);
}

static int did(unsigned k, int what)
{
    fast_used[k] += what != 0;
    return what;
}

static int count_draw(struct zs_job *job)
{
    const unsigned k = number_of(job);
    const uint32_t setups = job->r->stats.tris_setup;
    const int done = did(k, copy[k].of->draw(job));
    const uint32_t drawn = job->r->stats.tris_setup - setups; /* it may go on to those next in the list */
    fast_at_once += drawn > 1 ? drawn : (uint32_t)(done != 0);
    return done;
}

static int count_rows(struct zs_job *job)
{
    const unsigned k = number_of(job);
    return did(k, copy[k].of->rows(job));
}

static int count_edges(struct zs_job *job, int32_t row)
{
    return did(EDGES, known[EDGES].fast->edges(job, row));
}

static int count_takes(struct zs_job *job)
{
    return did(TOUCH, known[TOUCH].fast->touch->takes(job));
}

static int count_hides(struct zs_job *job)
{
    return did(TILES, known[TILES].fast->tiles->hides(job));
}

static int count_sphere(struct zs_renderer *r, const struct zs_bounds *b)
{
    return did(TILES, known[TILES].fast->tiles->hides_sphere(r, b));
}

static uint32_t count_bin(struct zs_renderer *r, uint32_t from, uint32_t end, uint32_t *outcome, uint32_t *piece)
{
    const uint32_t to = known[BATCH].fast->batch->bin(r, from, end, outcome, piece);
    (void)did(BATCH, to > from);
    return to;
}

static int count_run(struct zs_renderer *r)
{
    const uint32_t end = r->clusters.end;
    const int more = known[CLUSTERS].fast->clusters->run(r);
    (void)did(CLUSTERS, !more || r->clusters.from > end); /* some are left out */
    return more;
}

static const struct texel_copy *texel_of(const struct zs_job *job)
{
    return (const struct texel_copy *)(const void *)job->texel;
}

static void count_texel_rows(struct zs_job *job)
{
    const unsigned k = texel_of(job)->number;
    (void)did(k, 1);
    known[k].fast->texel->rows(job);
}

static void count_small(struct zs_job *job, const struct zs_texture *texture, struct zs_texel_rows *rows)
{
    const unsigned k = texel_of(job)->number;
    (void)did(k, 1);
    known[k].fast->texel->small(job, texture, rows);
}

static void count_small_lit(struct zs_job *job, const struct zs_texture *texture, struct zs_texel_rows *rows)
{
    const unsigned k = texel_of(job)->number;
    (void)did(k, 1);
    known[k].fast->texel->small_lit(job, texture, rows);
}

/* The copy of these hooks, which the list has from here on. */
#define COPIED(hooks) (hooks##_copy = *fast->hooks, fast->hooks = &hooks##_copy, &hooks##_copy)
static void copy_frame_hooks(struct zs_fast *fast)
{
    if (fast->touch)
        COPIED(touch)->takes = count_takes;
    if (fast->tiles) {
        struct zs_fast_tiles *tiles = COPIED(tiles);
        tiles->hides = count_hides;
        tiles->hides_sphere = count_sphere;
    }
    if (fast->batch)
        COPIED(batch)->bin = count_bin;
    if (fast->clusters)
        COPIED(clusters)->run = count_run;
    if (fast->edges)
        fast->edges = count_edges;
}

static void copy_hooks(struct zs_fast *fast, unsigned k)
{
    copy_frame_hooks(fast);
    if (fast->draw)
        fast->draw = count_draw;
    if (fast->rows)
        fast->rows = count_rows;
    if (!fast->texel)
        return;
    struct texel_copy *t = &texel_copy[k];
    t->number = k;
    t->texel = *fast->texel;
    t->texel.rows = count_texel_rows;
    t->texel.small = t->texel.small ? count_small : NULL;
    t->texel.small_lit = t->texel.small_lit ? count_small_lit : NULL;
    fast->texel = &t->texel;
}

const struct zs_fast *const *fast_counting(const struct zs_fast *const *list)
{
    static const struct zs_fast *out[KNOWN + 1];
    unsigned n = 0;
    memset(fast_used, 0, sizeof fast_used);
    fast_at_once = 0;
    for (; list && *list; list++) {
        unsigned k = 0;
        while (k < KNOWN && known[k].fast != *list)
            k++;
        if (k == KNOWN || n == KNOWN)
            abort();
        copy[k].of = *list;
        copy[k].fast = **list;
        copy_hooks(&copy[k].fast, k);
        out[n++] = &copy[k].fast;
    }
    out[n] = NULL;
    return out;
}
