/* Lines and points are quadrilaterals on the screen, and those are two triangles each.
 *
 * The two triangles share the diagonal from corner 0 to corner 2, so that each pixel is drawn once.
 * They share four vertices if both pools have room for all; if not, the second one gets vertices of
 * its own after room has been made. Vertices are the same, and so is the picture.
 *
 * SPDX-License-Identifier: MIT
 */
#include "method/quad.h"
#include "core/cull.h"
#include "core/fx.h"
#include "zs_lines.h"
#include "zs_shader.h"

/* Append a corner to the pool. */
static uint32_t corner_push(struct zs_renderer *r, const struct zs_quad *quad, uint32_t corner)
{
    const uint32_t slot = r->n_verts++;
    r->vert[slot] = quad->v[corner];
    r->vert_src[slot] = ZS_NO_SOURCE;
    for (uint32_t a = 0; a < r->xform.instance->material->shader->n_varyings; a++)
        r->attr[slot * r->config.varyings + a] = quad->from[corner]->attr[a];
    return slot;
}

/* Return 1 if a face stage may read the mesh's arrays at a line's number. */
static int reads_faces(const struct zs_instance *in)
{
    const struct zs_shader *shader = in->material->shader;
    if (shader == &zs_shade_raw)
        return in->mesh->face_raw != 0;
    return shader->face && shader->face != zs_plain_face;
}

/* Return the face stage's value; 0 where it would look at a triangle with a vertex that there is
 * not, which is not drawn. */
static uint16_t paint_of(const struct zs_renderer *r, uint32_t t)
{
    const struct zs_instance *in = r->xform.instance;
    if (!in->material->shader->face)
        return 0;
    for (int k = 0; k < 3 && reads_faces(in); k++)
        if (in->mesh->tri[t][k] >= in->mesh->n_verts)
            return 0;
    return in->material->shader->face(&r->shading, t);
}

enum zs_outcome zs_quad_bin(struct zs_renderer *r, const struct zs_quad *quad, uint32_t t,
                            uint32_t first, uint32_t *piece)
{
    uint32_t pushed[4] = { ZS_NIL, ZS_NIL, ZS_NIL, ZS_NIL };
    enum zs_outcome all = ZS_OUTCOME_EMPTY;
    for (uint32_t k = first; k < first + 2u; k++) {
        struct zs_candidate at = { { 0, k - first + 1u, k - first + 2u }, 0, 0 };
        const enum zs_outcome outcome = zs_assemble_box(r, quad->v, &at);
        if (all != ZS_OUTCOME_DRAWN)
            all = outcome;
        if (outcome != ZS_OUTCOME_DRAWN || k < *piece)
            continue;
        const uint32_t strip = zs_bin_place(r, at.y0, at.y1);
        if (strip == ZS_NIL)
            continue;
        uint32_t need = 0;
        for (int c = 0; c < 3; c++)
            need += pushed[at.slot[c]] == ZS_NIL;
        if (r->n_tris == r->config.max_tris || r->n_verts + need > r->config.max_verts) {
            *piece = k;
            return ZS_OUTCOME_FULL;
        }
        for (int c = 0; c < 3; c++) {
            uint32_t *const slot = &pushed[at.slot[c]];
            if (*slot == ZS_NIL)
                *slot = corner_push(r, quad, at.slot[c]);
            at.slot[c] = *slot;
        }
        zs_bin_add(r, at.slot, paint_of(r, t), strip);
    }
    return all;
}

/* A corner is at most 3/4 of the width from its end, the diagonal of a point: in px on the screen,
 * and by as much as a px is at the sphere's far side in the world. One more px is for snapping and
 * for the half px that a line is longer at its ends. */
int zs_quad_widen(const struct zs_renderer *r, const struct zs_instance *in, uint32_t width,
                  struct zs_bounds *b)
{
    const struct zs_camera *camera = &r->camera;
    const int64_t most = (int64_t)ZS_WORLD_MAX * 65536 + 1; /* of b->r: core/cull.c */
    const uint64_t quarters = 3u * (uint32_t)zs_quad_width(width) + 4u; /* 1/4 px, < 2^8 */
    if (width > ZS_WIDTH_MAX)
        return ZS_ERR_RANGE;
    if (in->material->primitive->n > in->mesh->n_tris && reads_faces(in))
        return ZS_ERR_MESH;
    uint64_t by; /* 1/4 of q48_16 */
    if (r->view.perspective) {
        const int64_t z = b->c[2] + b->r + b->slack; /* < 2^49 */
        if (z <= 0)
            return ZS_OK; /* all of it is behind the eye */
        if (camera->focal >> 32 == 0 && (uint64_t)z >> 36)
            return ZS_ERR_RANGE; /* so that the quotient is below 2^63 */
        by = zs_muldiv_u64((uint64_t)z * quarters, (uint64_t)1 << 32, camera->focal); /* < 2^60 */
    } else {
        by = (uint64_t)camera->height * quarters / r->view.height;
    }
    if (by / 4u + 1u > (uint64_t)(most - b->r))
        return ZS_ERR_RANGE;
    b->r += (int64_t)(by / 4u) + 1;
    return ZS_OK;
}
