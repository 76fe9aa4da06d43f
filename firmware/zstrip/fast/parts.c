/* Scenes that the pools do not hold: they are walked several times, each time for a band of strips.
 * The first walk notes in which rows the triangles of each part of a mesh lie; the others leave out
 * the parts that do not reach their band, and instances without such a part.
 *
 * A part is 2^part_log2 triangles of an instance. Its first and last row, in units of 2^part_down
 * rows, are two bytes in the last records of the triangle pool, which the frame does without
 * (parts_tris of them). Notes begin in the first walk, which leaves out only what is drawn in no
 * band: where the band first ends earlier, or with a mesh that is surely more than the pools hold.
 * Parts before that place are taken to reach all rows, until a later walk bins one from its first
 * triangle on, and notes it; it notes none of a mesh whose clusters may be left out, as these may
 * be drawn in another band. Parts that are not binned in batches, and those with a vertex that is
 * not on the screen, are always taken to reach all rows.
 *
 * Not for frames in passes; not with damage tracking, where the first walk, too, leaves out
 * instances that do not reach its band; and not under methods other than the depth buffer. What it
 * is worth: DESIGN.md (Scale, RAM).
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/bin.h"
#include "core/fx.h"
#include "core/method.h"
#include "core/pass.h"
#include "core/xform.h"
#include "fast/parts.h"
#include "zs_shader.h"

#define PART_LOG2_MIN 5
#define PART_LOG2_MAX 15
#define SHARE 16u   /* parts take at most 1 / SHARE of the triangle pool */
#define ALL 0xff00u /* rows 0 .. 255: reaches all bands */
#define NONE 0x00ffu

static uint16_t *parts(const struct zs_renderer *r)
{
    return (uint16_t *)(void *)(r->tri + r->config.max_tris);
}

/* The number of an instance's parts. Those of lines and points are its mesh's, and note nothing. */
ZS_RARE static ZS_NOINLINE uint32_t parts_of(const struct zs_instance *in, uint32_t log2)
{
    return (in->mesh->n_tris + (1u << log2) - 1u) >> log2;
}

ZS_RARE int zs_parts_batched(const struct zs_renderer *r, const struct zs_instance *in)
{
    const struct zs_material *material = in->material;
    /* batches do not call zs_fast_tiles.cover for triangles of up to 128 px; in a small frame such
     * triangles can be good occluders */
    return !material->primitive && !material->shader->place &&
           !(r->tiles && r->config.width <= 160u && in->mesh->n_tris <= ZS_PARTS_FEW);
}

/* Choose the size of parts. Return their number; 0 if they are there already, have no room or would
 * not pay. */
static ZS_RARE ZS_NOINLINE uint32_t choose(struct zs_renderer *r)
{
    const struct zs_mesh *mesh = r->xform.instance->mesh;
    const int many = mesh->n_tris > r->config.max_tris && mesh->n_verts > r->config.max_verts;
    if (r->parts_tris || !r->counting || (r->band_end == r->band_begun && !many) || r->passes ||
        r->track || r->config.method->begin)
        return 0;
    const uint32_t most = ZS_TRI_BYTES(r->config.max_tris) / SHARE / 2u;
    for (r->part_log2 = PART_LOG2_MIN; r->part_log2 <= PART_LOG2_MAX; r->part_log2++) {
        uint32_t n = 0;
        for (uint32_t i = 0; i < r->n_instances && n <= most; i++)
            n += parts_of(zs_instance_of(r, i), r->part_log2);
        if (n <= most)
            return n;
    }
    return 0;
}

ZS_RARE void zs_parts_begin(struct zs_renderer *r, uint32_t t)
{
    const uint32_t n = choose(r), tris = (2u * n + 11u) / 12u;
    if (n == 0 || r->n_tris + tris > r->config.max_tris)
        return;
    r->parts_tris = (uint16_t)tris;
    r->config.max_tris = (uint16_t)(r->config.max_tris - tris);
    r->part_down = 0;
    while (r->config.height >> r->part_down > 255)
        r->part_down++;
    uint16_t *at = parts(r);
    for (uint32_t i = 0; i < r->n_instances; i++) {
        const struct zs_instance *in = zs_instance_of(r, i);
        const uint32_t of = parts_of(in, r->part_log2);
        const uint32_t first = !zs_parts_batched(r, in) || i < r->xform.number ? UINT32_MAX
                               : i > r->xform.number                           ? 0u
                                                                               : t;
        if (i == r->xform.number) {
            r->part = (uint16_t)(at - parts(r));
            r->part_end = (uint16_t)(r->part + of);
        }
        for (uint32_t k = 0; k < of; k++)
            *at++ = first <= k << r->part_log2 ? NONE : ALL;
    }
}

ZS_RARE int zs_parts_end(struct zs_renderer *r, uint32_t t)
{
    uint32_t n = 0u - t;
    if (!r->counting || r->n_tris < r->config.max_tris || r->band_end < r->band_begun)
        return 0;
    for (uint32_t i = r->xform.number; i < r->n_instances; i++)
        n += zs_instance_of(r, i)->mesh->n_tris;
    if (n > 4u * r->parts_tris)
        return 0;
    r->config.max_tris = (uint16_t)(r->config.max_tris + r->parts_tris);
    r->parts_tris = 0;
    return 1;
}

/* Return 1 if a part reaches the band. */
ZS_RARE static ZS_NOINLINE int reaches(const struct zs_renderer *r, uint32_t part)
{
    const uint32_t rows = parts(r)[part], h = r->config.strip_h;
    return rows >> 8 >= r->strip * h >> r->part_down &&
           (rows & 255u) <= (r->band_end * h - 1u) >> r->part_down;
}

/* Return how many parts of the current instance reach the band. */
ZS_RARE static ZS_NOINLINE uint32_t in_band(const struct zs_renderer *r)
{
    uint32_t n = 0;
    for (uint32_t k = r->part; k < r->part_end; k++)
        n += (uint32_t)reaches(r, k);
    return n;
}

ZS_RARE int zs_parts_beside(struct zs_renderer *r, uint32_t number)
{
    r->part = number ? r->part_end : 0u;
    r->part_end = (uint16_t)(r->part + parts_of(zs_instance_of(r, number), r->part_log2));
    return !r->counting && r->part_end != r->part && !in_band(r);
}

ZS_RARE int zs_parts_whole(const struct zs_renderer *r)
{
    return in_band(r) == (uint32_t)(r->part_end - r->part);
}

ZS_RARE uint32_t zs_parts_next(const struct zs_renderer *r, uint32_t *from, uint32_t end,
                               uint32_t n)
{
    const uint32_t mask = (1u << r->part_log2) - 1u;
    for (uint32_t t = *from, next; t < end; t = next) {
        const uint32_t k = t >> r->part_log2;
        next = (k + 1u) << r->part_log2;
        if (r->counting || t & mask || reaches(r, r->part + k)) {
            *from = t;
            return zs_minu32(zs_minu32(n, end - t), next - t);
        }
    }
    return 0;
}

/* A row, which may be outside the frame, in units. */
ZS_RARE static ZS_NOINLINE uint32_t row_of(const struct zs_renderer *r, int32_t row)
{
    return (uint32_t)zs_min32(zs_max32(row, 0), r->config.height - 1) >> r->part_down;
}

ZS_RARE int zs_parts_noted(struct zs_renderer *r, uint32_t from)
{
    uint16_t *const part = parts(r) + r->part + (from >> r->part_log2);
    if ((from & ((1u << r->part_log2) - 1u)) == 0 && !r->counting) {
        r->noting = *part == ALL && !r->by_clusters;
        *part = r->noting ? NONE : *part;
    }
    return r->counting || r->noting;
}

ZS_RARE void zs_parts_unknown(struct zs_renderer *r, uint32_t t)
{
    if (r->counting || r->noting)
        parts(r)[r->part + (t >> r->part_log2)] = ALL;
}

ZS_RARE void zs_parts_note(struct zs_renderer *r, uint32_t from, const struct zs_tri *tri,
                           const struct zs_tri *end, int32_t y0, int32_t y1)
{
    uint16_t *const part = parts(r) + r->part + (from >> r->part_log2);
    for (; tri != end; tri++) {
        const struct zs_vertex *const v = r->vert;
        y0 = zs_min32(y0, zs_first_sample(v[tri->v[0]].y));
        y1 = zs_max32(y1, zs_first_sample(zs_max32(v[tri->v[1]].y, v[tri->v[2]].y)));
    }
    if (y0 < y1)
        *part = (uint16_t)(zs_minu32(*part & 255u, row_of(r, y0)) |
                           zs_maxu32(*part >> 8, row_of(r, y1 - 1)) << 8);
}
