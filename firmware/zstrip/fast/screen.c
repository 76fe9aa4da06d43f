/* Transform and projection of many vertices in one loop: zs_xform_screen (core/xform.c), bit for
 * bit. It belongs to fast/batch.c, with whose worth it is counted (zs_fast.h). Vertices that may
 * lie outside the view, or far from the viewport's centre, are left to the core one by one.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/cull.h"
#include "core/depth.h"
#include "core/fx.h"
#include "core/xform.h"
#include "zs_shader.h"
#include "fast/screen.h"

#define OUT_Y ((int32_t)1 << 30)
_Static_assert(OUT_Y - 2 * ZS_GUARD_SUBPX > 65536,
               "vertices outside must be far from those inside");

/* ---- Camera units ---------------------------------------------------------------------------- */

/* The result is exact, also if the rows are split (without ZS_ROW_WIDE). With m = high 2^s + low
 * and t = t_high 2^shift + t_low, the sum is
 *   high . p 2^s + (low . p + t_low) + t_high 2^shift
 * Successive floors compose, so zs_matrix_row may add the part of the bracket above 2^s to the
 * first sum. |bracket| is below 3 * 2^29 + 2^28. With a shift of 15 or less, s is the shift, and
 * sums wrap modulo 2^32, as the result does. With a larger shift, s is 15, and the sum with high
 * fits 32 bits: it is below 1.74 * 2^30 + 2^17, because a row of the matrix is no longer than 2^30
 * (1 + 2^-18), and p no longer than 2^15 sqrt 3. */
static void points(const struct zs_xform *xf, uint32_t v, uint32_t n, struct zs_vertex *out)
{
    zs_matrix_rows(xf->row, xf->instance->mesh->pos[v], &out->x, n);
}
_Static_assert(offsetof(struct zs_vertex, x) == 0 && offsetof(struct zs_vertex, y) == 4 &&
                   offsetof(struct zs_vertex, d) == 8,
               "a vertex is three words");

static void points_fine(const struct zs_xform *xf, uint32_t v, uint32_t n, struct zs_vertex *out)
{
    const struct zs_mesh *mesh = xf->instance->mesh;
    for (struct zs_vertex *const end = out + n; out != end; out++, v++) {
        out->x = zs_xform_fine(xf->row, mesh->pos[v], mesh->pos_lo[v]);
        out->y = zs_xform_fine(xf->row + ZS_ROW_WORDS, mesh->pos[v], mesh->pos_lo[v]);
        out->d = (uint32_t)zs_xform_fine(xf->row + 2 * ZS_ROW_WORDS, mesh->pos[v], mesh->pos_lo[v]);
    }
}

/* Transform vertices [v, v + n) to camera units: x', y', and z in d. */
static void transform(const struct zs_xform *xf, uint32_t v, uint32_t n, struct zs_vertex *out)
{
    if (xf->instance->mesh->pos_lo)
        points_fine(xf, v, n, out);
    else
        points(xf, v, n, out);
}

/* ---- Clip tests ------------------------------------------------------------------------------ */

/* From the bounding sphere, find the clip tests that a vertex of the instance may fail. */
ZS_RARE void zs_screen_needs(struct zs_renderer *r, const struct zs_bounds *b)
{
    const struct zs_camera *camera = &r->camera;
    struct zs_xform *xf = &r->xform;
    const int64_t z0 = b->c[2] - b->r - b->slack, z1 = b->c[2] + b->r + b->slack;
    int64_t side = 0;
    for (int k = 0; k < 2; k++) {
        const int64_t c = b->c[k] < 0 ? -b->c[k] : b->c[k];
        if (side < c + b->r + b->slack)
            side = c + b->r + b->slack;
    }
    xf->clip_depth = z0 <= camera->z_near || z1 >= camera->z_far;
    /* |x| * focal <= guard * z, in world units and whole pixels, rounded to the safe side */
    const int64_t side_w = (side >> 16) + 1; /* <= 2^32 */
    const int64_t guard_px = ZS_GUARD_PX - 2;
    if (r->view.perspective)
        xf->clip_guard = z0 <= 0 ||
                         side_w * (int64_t)((camera->focal >> 32) + 1) > guard_px * (z0 >> 16);
    else /* |x| * height_px / height <= guard */
        xf->clip_guard = side_w * r->view.height > guard_px * (camera->height >> 16);
}

/* ---- The screen ------------------------------------------------------------------------------ */

/* Return |c| * rcp / 2^(33 + down), nearest. The low half of the product does not matter. |c| <=
 * 2^31, 0 <= down <= 31 */
static inline uint32_t steps_of(int32_t c, uint32_t rcp, int32_t down)
{
    return ((zs_umulh(zs_size32(c), rcp) >> down) + 1u) >> 1;
}

/* Project a vertex of the pool that may be outside the view, or needs wider products. */
static ZS_NOINLINE void screen_slowly(const struct zs_renderer *r, struct zs_vertex *at)
{
    const struct zs_point p = { { at->x, at->y, (int32_t)at->d } };
    uint32_t code = 0;
    if (r->xform.clip_depth | r->xform.clip_guard)
        code = zs_xform_outcode(&r->view, &p);
    if (code == 0 && !zs_xform_project_at(r, at)) /* 0: the mesh exceeds its bounding sphere */
        code = zs_xform_outcode(&r->view, &p);
    if (code) {
        at->x = (int32_t)((uint32_t)r->vert_src[at - r->vert] << 16);
        at->y = OUT_Y;
        at->d = ZS_D_OUT + code;
    }
}

#define NEAR_MIDDLE (1u << 20) /* sub-pixels; a power of two, so that one comparison tests x and y
                                  */
_Static_assert(NEAR_MIDDLE < ZS_GUARD_SUBPX, "ZS_GUARD_PX: above 4096, or ZS_NO_FAST");

/* Project vertices. A vertex that is projected to a step or more inside the guard band is inside it
 * in camera units too, because its error is 1/2 step and 2^-9. So only vertices far from the
 * viewport's centre need the tests of screen_slowly(). */
ZS_ALWAYS_INLINE void screen(const struct zs_renderer *r, uint32_t n, struct zs_vertex *out,
                             int perspective, int32_t coarse)
{
    const struct zs_view *view = &r->view;
    const struct zs_depth *depth = r->view.depth;
    const int32_t cx = view->cx, cy = view->cy;
    const int32_t shift = perspective ? 30 - view->scale_bits + coarse
                                      : view->scale_bits + coarse - 2;
    const uint32_t most = NEAR_MIDDLE >> coarse;
    const int32_t z_near = view->z_near;
    const uint32_t depth_range = (uint32_t)view->z_far - (uint32_t)z_near; /* <= 2^31 */
    for (struct zs_vertex *const end = out + n; out != end; out++) {
        const int32_t x = out->x, y = out->y, z = (int32_t)out->d;
        if ((uint32_t)z - (uint32_t)z_near > depth_range) {
            screen_slowly(r, out);
            continue;
        }
        int32_t lz = 0;
        uint32_t rcp = 1u << 31;
        if (perspective) { /* as in zs_xform_project_at */
            lz = zs_clz32((uint32_t)z);
            rcp = ZS_RECIP_STEPS ? zs_recip_inline((uint32_t)z << lz)
                                 : zs_recip16((uint32_t)z << lz);
        }
        ZS_NARROW(rcp);
        const int32_t down = shift - lz;
        if ((uint32_t)down > 31u) {
            screen_slowly(r, out);
            continue;
        }
        const uint32_t sx = steps_of(x, rcp, down), sy = steps_of(y, rcp, down);
        if ((sx | sy) >= most) {
            screen_slowly(r, out);
            continue;
        }
        const int32_t px = (int32_t)(sx << coarse), py = (int32_t)(sy << coarse);
        out->x = cx + ((px ^ x >> 31) - (x >> 31)); /* with the sign of x */
        out->y = cy + ((py ^ y >> 31) - (y >> 31));
        out->d = depth->vertex(view, z, rcp, lz);
    }
}

/* For an orthographic camera, or with 4 sub-pixel bits. */
static ZS_NOINLINE void screen_any(const struct zs_renderer *r, uint32_t n, struct zs_vertex *out)
{
    screen(r, n, out, r->view.perspective, r->view.snap);
}

#if ZS_V7M
/* For a perspective camera with all sub-pixel bits; here for mappings with a loop of their own. */
static void project_usual(const struct zs_renderer *r, uint32_t n, struct zs_vertex *out)
{
    const struct zs_screen_of of = zs_screen_of(&r->view);
    struct zs_vertex *const end = out + n;
    while ((out = r->view.depth->vertices(&of, out, end)) != end)
        screen_slowly(r, out++);
}
#else
ZS_ALWAYS_INLINE void project_usual(const struct zs_renderer *r, uint32_t n, struct zs_vertex *out)
{
    screen(r, n, out, 1, 0);
}
#endif

static void project(const struct zs_renderer *r, uint32_t n, struct zs_vertex *out)
{
    if (r->view.perspective && r->view.snap == 0 && (!ZS_V7M || r->view.depth->vertices))
        project_usual(r, n, out);
    else
        screen_any(r, n, out);
}

void zs_screen(const struct zs_renderer *r, uint32_t v, uint32_t n, struct zs_vertex *out)
{
    if (r->xform.instance->material->shader->place) { /* n is 1: fast/batch.c opens none */
        zs_xform_screen(r, v, out);
        return;
    }
    transform(&r->xform, v, n, out);
    project(r, n, out);
}

void zs_screen_known(const struct zs_renderer *r, uint32_t slot, uint32_t end)
{
    const uint16_t *const src = r->vert_src;
    for (uint32_t from = slot, to; from < end; from = to) {
        for (to = from + 1u; to < end && src[to] == src[from] + (to - from); to++)
            ;
        transform(&r->xform, src[from], to - from, &r->vert[from]);
    }
    project(r, end - slot, &r->vert[slot]);
}
