/* Groups made at run time, and groups that cannot be trusted.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/cold.h"
#include "core/pipeline.h"

#define FAN 4u     /* instances of the smallest groups, groups of the others: ZS_GROUPS_MAX */
#define LEVELS 8   /* 4^8 > 65535 */
#define NONE UINT32_MAX
#define CENTER_MAX ((int64_t)2 * ZS_WORLD_MAX)
#define RADIUS_MAX ((int64_t)4 * ZS_WORLD_MAX)
#define TOO_FAR (4 * RADIUS_MAX) /* more than a radius of 32 bits and what it may be off by */

/* A sphere, and the point about which its instance turns. World units. */
struct ball {
    int64_t c[3], r; /* |c| < 2^31.3, r <= 2^31; rounded up by what c may be off by */
    int32_t origin[3];
};

/* The sphere that an instance is culled by. Return ZS_OK, ZS_ERR_NULL or ZS_ERR_RANGE. */
static int ball_of(struct ball *out, const struct zs_instance *in)
{
    static const struct zs_camera world = { .rot = { ZS_Q30_ONE, 0, 0, 0, ZS_Q30_ONE, 0, 0, 0, ZS_Q30_ONE } };
    struct zs_bounds b;
    if (!in->mesh)
        return ZS_ERR_NULL;
    const int err = in->mesh->scale ? zs_cull_bounds(&b, in, &world) : ZS_ERR_RANGE;
    if (err)
        return err;
    for (int k = 0; k < 3; k++) { /* camera axes: right, down, away */
        out->c[k] = zs_round_shift(k ? -b.c[k] : b.c[k], 16);
        out->origin[k] = in->pose.pos[k];
    }
    out->r = (b.r >> 16) + 2;
    return ZS_OK;
}

/* |a - b|, rounded up; where a difference alone is beyond RADIUS_MAX, TOO_FAR. Differences < 2^32.1 */
static int64_t distance(const int32_t a[3], const int64_t b[3])
{
    uint64_t square = 0;
    for (int k = 0; k < 3; k++) {
        const int64_t d = zs_size64(a[k] - b[k]);
        if (d > RADIUS_MAX)
            return TOO_FAR;
        square += (uint64_t)(d * d); /* <= 3 * 2^62 */
    }
    return square ? (int64_t)zs_isqrt64(square) + 1 : 0;
}

/* ---- Building ------------------------------------------------------------------------------------------ */

/* A box that grows, and what it is to hold. */
struct box {
    int64_t from[3], to[3];
};

static void box_add(struct box *box, const int64_t c[3], int64_t r)
{
    for (int k = 0; k < 3; k++) {
        if (box->from[k] > c[k] - r)
            box->from[k] = c[k] - r;
        if (box->to[k] < c[k] + r)
            box->to[k] = c[k] + r;
    }
}

/* The i-th thing in group g: an instance of the smallest groups, else a group. Return 0: there is none; or an error < 0. */
static int part_of(struct ball *out, uint32_t *origins, const struct zs_group *group, uint32_t g, uint32_t *at,
                   const struct zs_instance *instance)
{
    *origins = 0;
    if (group[g].next == g + 1u) {
        const uint32_t i = (*at)++;
        if (i >= group[g].n)
            return 0;
        const int err = ball_of(out, &instance[group[g].first + i]);
        return err ? err : 1;
    }
    if (*at == 0)
        *at = g + 1u;
    if (*at >= group[g].next)
        return 0;
    const struct zs_group *part = &group[*at];
    for (int k = 0; k < 3; k++) {
        out->c[k] = part->center[k];
        out->origin[k] = part->center[k];
    }
    out->r = part->radius;
    *origins = part->origins;
    *at = part->next;
    return 1;
}

static int sphere_build(struct zs_group *group, uint32_t g, const struct zs_instance *instance)
{
    struct box box = { { INT64_MAX, INT64_MAX, INT64_MAX }, { INT64_MIN, INT64_MIN, INT64_MIN } };
    struct ball b;
    uint32_t at = 0, origins;
    int got;
    while ((got = part_of(&b, &origins, group, g, &at, instance)) > 0)
        box_add(&box, b.c, b.r);
    if (got < 0)
        return got;
    for (int k = 0; k < 3; k++) {
        const int64_t middle = (box.from[k] + box.to[k]) / 2;
        if (middle > CENTER_MAX || middle < -CENTER_MAX)
            return ZS_ERR_RANGE;
        group[g].center[k] = (int32_t)middle;
    }
    int64_t radius = 0, reach = 0;
    at = 0;
    while (part_of(&b, &origins, group, g, &at, instance) > 0) {
        const int64_t to = distance(group[g].center, b.c) + b.r;
        const int64_t pos[3] = { b.origin[0], b.origin[1], b.origin[2] };
        const int64_t away = distance(group[g].center, pos) + origins;
        radius = radius < to ? to : radius;
        reach = reach < away ? away : reach;
    }
    group[g].radius = (uint32_t)radius;
    group[g].origins = (uint32_t)reach;
    return radius > RADIUS_MAX || reach > RADIUS_MAX ? ZS_ERR_RANGE : ZS_OK;
}

/* Nothing more comes into groups of the lowest `levels` levels. n: the group that is next. */
static void close(struct zs_group *group, uint32_t *open, int levels, uint32_t n)
{
    for (int k = 0; k < levels; k++) {
        if (open[k] != NONE)
            group[open[k]].next = (uint16_t)n;
        open[k] = NONE;
    }
}

int zs_groups_build(struct zs_group *group, uint32_t n_max, const struct zs_instance *instance, uint32_t n_instances,
                    uint32_t *n_groups)
{
    uint32_t open[LEVELS], n = 0, top = FAN; /* groups that more may come into, one a level */
    if (!n_groups)
        return ZS_ERR_NULL;
    *n_groups = 0;
    if ((!group && n_max) || (!instance && n_instances))
        return ZS_ERR_NULL;
    if (n_instances > 65535u)
        return ZS_ERR_SIZE;
    int levels = 1;
    for (; top < n_instances; top *= FAN)
        levels++;
    for (int k = 0; k < levels; k++)
        open[k] = NONE;
    for (uint32_t first = 0; first < n_instances; first += FAN) {
        uint32_t size = top;
        for (int k = levels - 1; k >= 0; k--, size /= FAN) { /* from the largest that begin here */
            if (first % size)
                continue;
            if (n == n_max || n == 65535u)
                return ZS_ERR_SIZE;
            close(group, open, k + 1, n);
            open[k] = n;
            group[n].first = (uint16_t)first;
            group[n].n = (uint16_t)zs_minu32(size, n_instances - first);
            n++;
        }
    }
    close(group, open, levels, n);
    for (uint32_t g = n; g-- > 0;) {
        const int err = sphere_build(group, g, instance);
        if (err)
            return err;
    }
    *n_groups = n;
    return ZS_OK;
}

/* ---- Checks -------------------------------------------------------------------------------------------- */

static enum zs_flaw found(enum zs_flaw flaw, uint32_t *index, uint32_t at)
{
    if (index)
        *index = at;
    return flaw;
}

enum zs_flaw zs_groups_check(const struct zs_scene *scene, uint32_t *index)
{
    if (!scene || !scene->groups || (!scene->instance && scene->n_instances) ||
        (!scene->groups->group && scene->groups->n_groups))
        return found(ZS_FLAW_NULL, index, 0);
    const struct zs_group *group = scene->groups->group;
    const uint32_t n = scene->groups->n_groups;
    if (n > 65535u || scene->n_instances > 65535u)
        return found(ZS_FLAW_COUNT, index, n);
    for (uint32_t g = 0; g < n; g++) {
        const struct zs_group *at = &group[g];
        const uint32_t end = at->first + (uint32_t)at->n;
        if (end > scene->n_instances || at->n == 0 || at->next <= g || at->next > n ||
            (at->next < n && group[at->next].first < end))
            return found(ZS_FLAW_GROUPS, index, g);
        for (uint32_t k = g + 1u; k < at->next; k++) /* those within it */
            if (group[k].first < at->first || group[k].first + (uint32_t)group[k].n > end || group[k].next > at->next)
                return found(ZS_FLAW_GROUPS, index, k);
    }
    for (uint32_t g = 0; g < n; g++)
        for (uint32_t i = 0; i < group[g].n; i++) {
            const struct zs_group *at = &group[g];
            struct ball b;
            if (ball_of(&b, &scene->instance[at->first + i]))
                return found(ZS_FLAW_GROUP_SPHERE, index, g);
            const int64_t pos[3] = { b.origin[0], b.origin[1], b.origin[2] };
            if (at->radius > RADIUS_MAX || distance(at->center, b.c) + b.r > (int64_t)at->radius + 4)
                return found(ZS_FLAW_GROUP_SPHERE, index, g);
            if (at->origins > RADIUS_MAX || distance(at->center, pos) > (int64_t)at->origins + 2)
                return found(ZS_FLAW_GROUP_ORIGINS, index, g);
        }
    return found(ZS_FLAW_NONE, index, 0);
}
