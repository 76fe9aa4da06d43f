/* Lines: parallelograms on the screen (zs_lines.h defines their pixels), or a row of them.
 *
 * A line's ends are fetched in one of three ways. Usually they are vertices of the pool, which
 * other lines share. If there is no room for two vertices and four corners, they are transformed
 * for this line alone: the corners need the room. A line that is clipped or dashed is fetched in
 * camera units. The ends are the same in all three ways.
 *
 * Dashes. Dash j is the parallelogram between two borders of columns (of rows, if the line is
 * rather vertical). An end that a border cuts off is in its place along the line, rounded to a
 * sub-pixel; its distance and varyings are interpolated perspective-correctly, and its key is that
 * of the distance. So a dash does not depend on how many of them are seen.
 *
 * Pieces (*piece): 2 j and 2 j + 1 are the triangles of dash j; a solid line is dash 0. j < 2^14.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/depth.h"
#include "core/fx.h"
#include "core/primitive.h"
#include "method/quad.h"
#include "zs_lines.h"
#include "zs_shader.h"

/* A line on the screen: n along its longer direction m. */
struct line {
    struct zs_end end[2]; /* in the order of m; from where dashes are counted: end[turned] */
    int32_t m[2], n[2];   /* of the ends moved outwards, sub-pixels, m[0] < m[1] */
    int32_t half;         /* of the width, sub-pixels */
    uint8_t down;         /* 1: m is y, and n is x; 0: m is x */
    uint8_t turned;       /* 1: the ends were swapped */
};

static const struct zs_lines *lines_of(const struct zs_instance *in)
{
    return (const struct zs_lines *)(const void *)in->material->primitive;
}

static int dashed(const struct zs_lines *lines)
{
    return lines->on && lines->off;
}

/* ---- Ends ----------------------------------------------------------------------------------- */

static int beyond_guard(const struct zs_renderer *r, const struct zs_vertex *v)
{
    return zs_abs32(v->x - r->view.cx) > ZS_QUAD_GUARD ||
           zs_abs32(v->y - r->view.cy) > ZS_QUAD_GUARD;
}

/* Fetch the ends in camera units, clip the line between them, and project what is left. Return
 * ZS_OUTCOME_OPEN, or why nothing is left. Both ends are in the polygon that is clipped, one twice:
 * its first two corners are what is left of the line. */
static ZS_RARE ZS_NOINLINE enum zs_outcome clipped(struct zs_renderer *r, const uint16_t v[2],
                                                   struct zs_end end[2], uint32_t piece)
{
    const struct zs_shader *shader = r->xform.instance->material->shader;
    struct zs_clip_vertex cv[ZS_CLIP_MAX];
    struct zs_view view = r->view; /* with a narrower guard band */
    uint32_t any = 0, all = ~0u;
    for (int k = 0; k < 2; k++) {
        zs_xform_vertex(&r->xform, v[k], &cv[k].p);
        if (shader->vertex)
            shader->vertex(&r->shading, v[k], cv[k].attr);
        const uint32_t code = zs_xform_outcode(&r->view, &cv[k].p);
        any |= code;
        all &= code;
        (void)zs_xform_project(r, &cv[k].p, &end[k].v); /* undefined where code says so */
        if (!code && beyond_guard(r, &end[k].v))
            any |= ZS_OUT_SIDES;
    }
    r->stats.verts_transformed += 2;
    if (all)
        return zs_outcome_outside(all);
    if (any) {
        if (r->counting && piece == 0)
            r->stats.tris_clipped++;
        cv[2] = cv[1];
        view.guard = (uint64_t)ZS_QUAD_GUARD << (view.perspective ? 0 : view.scale_bits);
        if (!zs_clip_polygon(&view, cv, 3, any | ZS_OUT_SIDES,
                             shader->n_varyings))
            return any & ZS_OUT_NEAR  ? ZS_OUTCOME_NEAR
                   : any & ZS_OUT_FAR ? ZS_OUTCOME_FAR
                                      : ZS_OUTCOME_OFFSCREEN;
    }
    for (int k = 0; k < 2; k++) {
        struct zs_vertex *const at = &end[k].v;
        (void)zs_xform_project(r, &cv[k].p, at); /* clipped: between near and far */
        at->x = r->view.cx + (int32_t)zs_held64(at->x - r->view.cx, ZS_QUAD_GUARD);
        at->y = r->view.cy + (int32_t)zs_held64(at->y - r->view.cy, ZS_QUAD_GUARD);
        end[k].z = cv[k].p.c[2];
        for (uint32_t a = 0; a < shader->n_varyings; a++)
            end[k].attr[a] = cv[k].attr[a];
    }
    return ZS_OUTCOME_OPEN;
}

/* Fetch the ends of a line that is not dashed. Return ZS_OUTCOME_OPEN; ZS_OUTCOME_DRAWN: it has to
 * be clipped. */
static enum zs_outcome shared(struct zs_renderer *r, const uint16_t v[2], struct zs_end end[2])
{
    const struct zs_shader *shader = r->xform.instance->material->shader;
    const uint16_t both[3] = { v[0], v[1], v[1] };
    uint32_t slot[3];
    const int pooled = r->n_verts + 6u <= r->config.max_verts && zs_bin_corners(r, both, slot);
    for (int k = 0; k < 2; k++) {
        if (pooled) {
            end[k].v = r->vert[slot[k]];
        } else {
            zs_xform_screen(r, v[k], &end[k].v);
            r->stats.verts_transformed++;
        }
        if (end[k].v.d >= ZS_D_OUT || beyond_guard(r, &end[k].v))
            return ZS_OUTCOME_DRAWN;
    }
    for (int k = 0; k < 2 && shader->vertex; k++) {
        if (!pooled) {
            shader->vertex(&r->shading, v[k], end[k].attr);
            continue;
        }
        zs_bin_corner(r, slot[k], r->config.varyings);
        for (uint32_t a = 0; a < shader->n_varyings; a++)
            end[k].attr[a] = r->attr[slot[k] * r->config.varyings + a];
    }
    return ZS_OUTCOME_OPEN;
}

/* ---- On the screen -------------------------------------------------------------------------- */

/* Put the ends in order, and move them outwards. */
static void line_set(struct line *line, int32_t width)
{
    struct zs_vertex *const a = &line->end[0].v, *const b = &line->end[1].v;
    const int32_t dx = b->x - a->x, dy = b->y - a->y; /* |.| < 2^22 */
    line->down = zs_abs32(dy) > zs_abs32(dx);
    const int32_t along = line->down ? dy : dx;
    line->turned = along < 0 || (along == 0 && b->d < a->d);
    if (line->turned) {
        const struct zs_end first = line->end[0];
        line->end[0] = line->end[1];
        line->end[1] = first;
    }
    for (int k = 0; k < 2; k++) {
        line->m[k] = line->down ? line->end[k].v.y : line->end[k].v.x;
        line->n[k] = line->down ? line->end[k].v.x : line->end[k].v.y;
    }
    const int32_t dm = line->m[1] - line->m[0], dn = line->n[1] - line->n[0]; /* |dn| <= dm */
    int32_t by = 0;
    if (dm) {
        const int32_t size = (zs_abs32(dn) * ZS_SUBPX_ONE + dm) / (2 * dm); /* < 2^30.1 */
        by = dn < 0 ? -size : size;
    }
    line->m[0] -= ZS_SUBPX_HALF;
    line->m[1] += ZS_SUBPX_HALF;
    line->n[0] -= by;
    line->n[1] += by;
    line->half = width * ZS_SUBPX_HALF;
}

/* Bin the parallelogram between two places of a line, in the order of m. */
static enum zs_outcome parallelogram(struct zs_renderer *r, const struct line *line,
                                     const struct zs_end *const end[2], const int32_t m[2],
                                  const int32_t n[2], uint32_t t, uint32_t dash, uint32_t *piece)
{
    struct zs_quad quad;
    for (int k = 0; k < 4; k++) { /* clockwise from the upper left one */
        const int at = line->down ? k >= 2 : k == 1 || k == 2;
        const int32_t off = (line->down ? k == 1 || k == 2 : k >= 2) ? line->half : -line->half;
        quad.v[k].x = line->down ? n[at] + off : m[at];
        quad.v[k].y = line->down ? m[at] : n[at] + off;
        quad.v[k].d = end[at]->v.d;
        quad.from[k] = end[at];
    }
    return zs_quad_bin(r, &quad, t, 2u * dash + 1u, piece); /* piece 0: none is binned */
}

/* ---- Dashes --------------------------------------------------------------------------------- */

/* Return a + (b - a) num / den, rounded down to a's side. num <= den < 2^32, |b - a| < 2^31 */
static int32_t between(int32_t a, int32_t b, uint64_t num, uint64_t den)
{
    const int32_t part = (int32_t)(zs_mul_uu(zs_size32(b - a), (uint32_t)num) / den);
    return b < a ? a - part : a + part;
}

/* Set the end that the border at m cuts off, and return its n. */
static ZS_NOINLINE int32_t cut(const struct zs_renderer *r, const struct line *line, int32_t m,
                               struct zs_end *out)
{
    const struct zs_end *const a = &line->end[0], *const b = &line->end[1];
    const struct zs_view *const view = &r->view;
    const int32_t from = line->m[0] + ZS_SUBPX_HALF, to = line->m[1] - ZS_SUBPX_HALF;
    uint64_t num = (uint64_t)(zs_min32(zs_max32(m, from), to) - from), den = (uint64_t)(to - from);
    const int32_t n = between(line->n[0], line->n[1], (uint64_t)(m - line->m[0]),
                              (uint64_t)(line->m[1] - line->m[0]));
    if (den == 0) {
        *out = *a;
        return n;
    }
    if (view->perspective) { /* from the screen to the line: by a.z, b.z < 2^30 */
        const uint64_t rest = (den - num) * (uint32_t)b->z; /* < 2^52 */
        num *= (uint32_t)a->z;
        den = num + rest;
        const int down = 32 - zs_clz64(den); /* to 32 bits: by 2^-31 of the line at most */
        if (down > 0) {
            num >>= down;
            den >>= down;
        }
    }
    out->z = between(a->z, b->z, num, den);
    const int32_t lz = zs_clz32((uint32_t)out->z | 1u);
    const uint32_t rcp = view->perspective ? zs_recip((uint32_t)out->z << lz) : 1u << 31;
    out->v.d = view->depth->vertex(view, out->z, rcp, view->perspective ? lz : 0);
    for (int k = 0; k < r->xform.instance->material->shader->n_varyings; k++)
        out->attr[k] = (uint16_t)between(a->attr[k], b->attr[k], num, den);
    return n;
}

/* Bin the dashes of a line that lie in the rows or columns that are drawn. */
static ZS_NOINLINE enum zs_outcome dashes(struct zs_renderer *r, const struct line *line,
                                          uint32_t t, uint32_t *piece)
{
    const struct zs_lines *const lines = lines_of(r->xform.instance);
    const int32_t first = zs_first_sample(line->m[0]), end = zs_first_sample(line->m[1]);
    const int32_t low = zs_max32(line->down ? r->walk_y : r->walk_x, first),
                  high = zs_min32(line->down ? r->walk_y_end : r->walk_end, end);
    const int32_t on = lines->on, period = on + lines->off;
    enum zs_outcome all = ZS_OUTCOME_OFFSCREEN;
    if (low >= high)
        return all;
    /* columns of the line, counted from its first end: [from, to) of them are in view */
    const int32_t from = line->turned ? end - high : low - first,
                  to = line->turned ? end - low : high - first;
    for (int32_t j = from / period; j * period < to; j++) {
        const int32_t near = j * period, far = zs_min32(near + on, end - first);
        const int32_t column[2] = { line->turned ? end - far : first + near,
                                    line->turned ? end - near : first + far };
        struct zs_end place[2];
        const struct zs_end *at[2];
        int32_t m[2], n[2];
        for (int k = 0; k < 2; k++) {
            const int whole = k ? column[1] == end : column[0] == first;
            at[k] = whole ? &line->end[k] : &place[k];
            m[k] = whole ? line->m[k] : column[k] * ZS_SUBPX_ONE;
            n[k] = whole ? line->n[k] : cut(r, line, m[k], &place[k]);
        }
        const enum zs_outcome outcome = parallelogram(r, line, at, m, n, t, (uint32_t)j, piece);
        if (outcome == ZS_OUTCOME_FULL)
            return outcome;
        if (all != ZS_OUTCOME_DRAWN)
            all = outcome;
    }
    return all;
}

/* ---- Assembly ------------------------------------------------------------------------------- */

static enum zs_outcome line_assemble(struct zs_renderer *r, uint32_t t, uint32_t *piece)
{
    const struct zs_instance *in = r->xform.instance;
    const struct zs_lines *lines = lines_of(in);
    const uint16_t *const v = lines->line[t];
    struct line line;
    if (v[0] >= in->mesh->n_verts || v[1] >= in->mesh->n_verts)
        return ZS_OUTCOME_INDEX;
    enum zs_outcome outcome = ZS_OUTCOME_DRAWN;
    if (!dashed(lines))
        outcome = shared(r, v, line.end);
    if (outcome != ZS_OUTCOME_OPEN)
        outcome = clipped(r, v, line.end, *piece);
    if (outcome != ZS_OUTCOME_OPEN)
        return outcome;
    line_set(&line, zs_quad_width(lines->width));
    if (dashed(lines)) {
        outcome = dashes(r, &line, t, piece);
    } else {
        const struct zs_end *const end[2] = { &line.end[0], &line.end[1] };
        outcome = parallelogram(r, &line, end, line.m, line.n, t, 0, piece);
    }
    if (outcome != ZS_OUTCOME_FULL)
        *piece = 0;
    return outcome;
}

static int lines_widen(const struct zs_renderer *r, const struct zs_instance *in,
                       struct zs_bounds *b)
{
    const struct zs_lines *lines = lines_of(in);
    return lines->line || !lines->primitive.n ? zs_quad_widen(r, in, lines->width, b) : ZS_ERR_NULL;
}

const struct zs_primitive_ops zs_lines_ops = { .assemble = line_assemble, .widen = lines_widen };
