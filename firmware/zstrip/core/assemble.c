/* Triangle assembly: fetch the vertices, test facing and bounding box, bin.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/assemble.h"
#include "core/fast.h"
#include "core/fx.h"
#include "core/job.h"
#include "core/xform.h"
#include "zs_shader.h"

int64_t zs_assemble_area(const struct zs_vertex *a, const struct zs_vertex *b,
                         const struct zs_vertex *c)
{
    return zs_mul_ss(b->x - a->x, c->y - a->y) - zs_mul_ss(c->x - a->x, b->y - a->y);
}

int zs_assemble_culled(int64_t area, uint32_t cull)
{
    return (cull == ZS_CULL_BACK && area > 0) || (cull == ZS_CULL_FRONT && area < 0);
}

enum zs_outcome zs_assemble_box(const struct zs_renderer *r, const struct zs_vertex *pool,
                                struct zs_candidate *at)
{
    int32_t x0 = INT32_MAX, x1 = INT32_MIN, y1 = INT32_MIN, first = 0;
    const struct zs_vertex *top = &pool[at->slot[0]];
    for (int k = 0; k < 3; k++) {
        const struct zs_vertex *v = &pool[at->slot[k]];
        x0 = zs_min32(x0, v->x);
        x1 = zs_max32(x1, v->x);
        y1 = zs_max32(y1, v->y);
        if (v->y < top->y || (v->y == top->y && v->x < top->x)) {
            top = v;
            first = k;
        }
    }
    for (; first > 0; first--) {
        const uint32_t turned = at->slot[0];
        at->slot[0] = at->slot[1];
        at->slot[1] = at->slot[2];
        at->slot[2] = turned;
    }
    x0 = zs_first_sample(x0);
    x1 = zs_first_sample(x1);
    at->y0 = zs_first_sample(top->y);
    at->y1 = zs_first_sample(y1);
    if (x1 <= r->walk_x || x0 >= r->walk_end || at->y1 <= r->walk_y ||
        at->y0 >= r->walk_y_end)
        return ZS_OUTCOME_OFFSCREEN;
    return x0 >= x1 || at->y0 >= at->y1 ? ZS_OUTCOME_EMPTY : ZS_OUTCOME_DRAWN;
}

/* Fetch a triangle's vertices, in clockwise order. Return ZS_OUTCOME_OPEN if the triangle is to be
 * drawn, else its outcome; a triangle that has to be clipped is done here (zs_fan_bin). */
static enum zs_outcome fetch(struct zs_renderer *r, uint32_t t, struct zs_candidate *at,
                             uint32_t *piece)
{
    const struct zs_mesh *mesh = r->xform.instance->mesh;
    const uint16_t *index = mesh->tri[t];
    uint32_t *const slot = at->slot;
    for (int k = 0; k < 3; k++)
        if (index[k] >= mesh->n_verts)
            return ZS_OUTCOME_INDEX;
    if (index[0] == index[1] && index[0] == index[2])
        return ZS_OUTCOME_ZERO; /* even if it is outside the view */
    if (!zs_bin_corners(r, index, slot))
        return ZS_OUTCOME_FULL;
    const struct zs_vertex *a = &r->vert[slot[0]], *b = &r->vert[slot[1]], *c = &r->vert[slot[2]];
    if (a->d >= ZS_D_OUT || b->d >= ZS_D_OUT || c->d >= ZS_D_OUT) {
        const uint32_t all = a->d & b->d & c->d; /* above ZS_D_OUT: the outcodes share a bit */
        return all > ZS_D_OUT ? zs_outcome_outside(all) : zs_fan_bin(r, t, piece);
    }
    const int64_t area = zs_assemble_area(a, b, c);
    if (area == 0)
        return ZS_OUTCOME_ZERO;
    if (area < 0) {
        const uint32_t first = slot[0];
        slot[0] = slot[2];
        slot[2] = first;
    }
    return zs_assemble_culled(area, r->xform.cull) ? ZS_OUTCOME_FACING : ZS_OUTCOME_OPEN;
}

ZS_NOINLINE enum zs_outcome zs_assemble_tri(struct zs_renderer *r, uint32_t t, uint32_t *piece)
{
    const struct zs_shader *shader = r->xform.instance->material->shader;
    struct zs_candidate at;
    if (*piece)
        return zs_fan_bin(r, t, piece);
    enum zs_outcome outcome = fetch(r, t, &at, piece);
    if (outcome != ZS_OUTCOME_OPEN)
        return outcome;
    if (ZS_IF_FAST(r->tiles))
        r->tiles->cover(r, &r->vert[at.slot[0]], &r->vert[at.slot[1]], &r->vert[at.slot[2]]);
    outcome = zs_assemble_box(r, r->vert, &at);
    const uint32_t strip = outcome == ZS_OUTCOME_DRAWN ? zs_bin_place(r, at.y0, at.y1) : ZS_NIL;
    if (strip == ZS_NIL)
        return outcome;
    if (r->n_tris == r->config.max_tris)
        return ZS_OUTCOME_FULL;
    for (int k = 0; k < 3 && shader->vertex; k++)
        zs_bin_corner(r, at.slot[k], r->config.varyings);
    zs_bin_add(r, at.slot, shader->face ? shader->face(&r->shading, t) : 0u, strip);
    return ZS_OUTCOME_DRAWN;
}
