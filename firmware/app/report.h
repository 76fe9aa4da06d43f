/* What programs that count frames share: a field of a line of CSV, and where their strips go.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef REPORT_H
#define REPORT_H

#include "hal.h"
#include "number.h"
#include "zstrip.h"

#define REPORT_HASH 0xcbf29ce484222325u /* a checksum before its first byte */

/* Write a comma and v. */
static inline void report_field(uint64_t v)
{
    char room[NUMBER_CHARS];
    hal_write(",");
    hal_write(number_text(room, v));
}

/* Pools for all of a scene, and some to spare for what is clipped. */
static inline void report_pools(struct zs_config *c, const struct zs_scene *scene)
{
    uint32_t tris = 256, verts = 256;
    for (uint32_t i = 0; i < scene->n_instances; i++) {
        tris += scene->instance[i].mesh->n_tris;
        verts += scene->instance[i].mesh->n_verts;
    }
    c->max_tris = (uint16_t)(tris < ZS_POOL_MAX ? tris : ZS_POOL_MAX);
    c->max_verts = (uint16_t)(verts < ZS_POOL_MAX ? verts : ZS_POOL_MAX);
}

/* zs_sink.submit: to nowhere. */
static inline int report_drop(void *ctx, const struct zs_strip *s)
{
    (void)ctx;
    (void)s;
    return 0;
}

/* zs_sink.submit: FNV-1a, 64 bits, over the bytes as they leave. ctx: uint64_t, REPORT_HASH before the frame. */
static inline int report_hash(void *ctx, const struct zs_strip *s)
{
    uint64_t *sum = ctx;
    uint64_t h = *sum;
    for (uint32_t i = 0; i < s->n_bytes; i++)
        h = (h ^ s->px[i]) * 0x100000001b3u;
    *sum = h;
    return 0;
}

#endif
