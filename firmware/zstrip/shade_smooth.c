/* Smooth (Gouraud) shading: lit at the vertices, interpolated perspective-correctly.
 *
 * Colours are carried as codes (0 .. 31, 0 .. 63) with 16 fraction bits.
 *
 * How they go over the screen is in persp.h; the bound is 1/8 code, sub-spans are up to 16 pixels.
 *
 * SPDX-License-Identifier: MIT
 */
#include "persp.h"

#define SUB_LOG2_MAX 4u
#define CODE5 2031647u /* 31 * 65536 * 65536 / 65535, nearest: uq0_16 of 65535 to codes, uq16_16 */
#define CODE6 4128831u /* 63 ... */

static const uint32_t code_scale[3] = { CODE5, CODE6, CODE5 };

static void smooth_vertex(const struct zs_renderer *r, uint32_t v, uint16_t *out)
{
    const struct zs_instance *in = r->xform.instance;
    const struct zs_rgb *c = in->mesh->vertex_rgb ? &in->mesh->vertex_rgb[v] : &in->material->rgb;
    const uint32_t light = zs_light_intensity(r, in->mesh->normal[v]);
    out[0] = (uint16_t)zs_light_channel(c->r, light);
    out[1] = (uint16_t)zs_light_channel(c->g, light);
    out[2] = (uint16_t)zs_light_channel(c->b, light);
}

static int smooth_check(const struct zs_instance *in, const struct zs_config *config)
{
    (void)config;
    return in->mesh->normal ? ZS_OK : ZS_ERR_MESH;
}

/* ---- Set-up ------------------------------------------------------------------------------------------ */

/* Largest change of a channel over the triangle, uq0_16. */
static uint32_t color_range(const uint16_t *const a[3])
{
    uint32_t range = 0;
    for (int c = 0; c < 3; c++) {
        const int32_t lo = zs_min32(zs_min32(a[0][c], a[1][c]), a[2][c]);
        const int32_t hi = zs_max32(zs_max32(a[0][c], a[1][c]), a[2][c]);
        if (range < (uint32_t)(hi - lo))
            range = (uint32_t)(hi - lo);
    }
    return range;
}

/* range / 65536 * 63 codes * (change / least) / 4 <= 1/8 code; 63 taken as 64. */
static int affine_enough(uint32_t range, uint32_t change, uint32_t least)
{
    return (uint64_t)range * change <= (uint64_t)least * 512u; /* < 2^16 * 2^31 */
}

static uint32_t sub_span(const struct zs_plane *w, uint32_t range, uint32_t least)
{
    const uint32_t slope = (uint32_t)((int32_t)w->gx < 0 ? 0u - w->gx : w->gx);
    uint32_t log2 = SUB_LOG2_MAX;
    while (log2 > 0 && (slope >> (31 - log2) || !affine_enough(range, slope << log2, least)))
        log2--;
    return log2;
}

static void smooth_start(struct zs_job *job)
{
    const uint16_t *a[3];
    uint32_t w[3];
    zs_persp_attrs(job, a);
    zs_persp_w(job, w);
    const uint32_t range = color_range(a);
    uint32_t most = w[0], least = w[0];
    for (int k = 1; k < 3; k++) {
        most = w[k] > most ? w[k] : most;
        least = w[k] < least ? w[k] : least;
    }
    job->sub_log2 = ZS_AFFINE;
    if (!affine_enough(range, most - least, least)) {
        zs_plane32(&job->geom, w[0], w[1], w[2], ZS_PLANE_WIDE, &job->w);
        job->sub_log2 = sub_span(&job->w, range, least);
    }
    for (int c = 0; c < 3; c++) {
        uint32_t v[3];
        for (int k = 0; k < 3; k++)
            v[k] = job->sub_log2 == ZS_AFFINE ? zs_umulh((uint32_t)a[k][c] << 16, code_scale[c])
                                           : zs_umulh((uint32_t)a[k][c] << 16, w[k]);
        zs_plane32(&job->geom, v[0], v[1], v[2],
                   job->sub_log2 == ZS_AFFINE ? ZS_PLANE_KEY : ZS_PLANE_WIDE, &job->c[c]);
        if (job->sub_log2 == ZS_AFFINE)
            job->c[c].base += 0x8000u; /* nearest */
    }
}

/* ---- Runs ------------------------------------------------------------------------------------------- */

/* Codes with half a code added, uq16_16: at most 63.5, so the sums below never carry over. */
static inline uint16_t pack(uint32_t red, uint32_t green, uint32_t blue)
{
    return zs_wire16((uint16_t)((red >> 16) << 11 | (green >> 16) << 5 | blue >> 16));
}

static void fill_linear(uint16_t *out, int32_t n, uint32_t c[3], const uint32_t step[3])
{
    uint32_t red = c[0], green = c[1], blue = c[2];
    for (int32_t i = 0; i < n; i++) {
        out[i] = pack(red, green, blue);
        red += step[0];
        green += step[1];
        blue += step[2];
    }
}

/* Colour at a covered pixel by division, codes with half a code added. */
static void color_at(const struct zs_job *job, int32_t i, int32_t row, uint32_t out[3])
{
    uint32_t w;
    int32_t lz;
    const uint32_t rcp = zs_persp_rcp(job, i, row, &w, &lz);
    for (int c = 0; c < 3; c++) {
        const uint32_t level = zs_persp_over(zs_plane_at(job, &job->c[c], i, row), w, rcp, lz);
        out[c] = zs_umulh(level << 1, code_scale[c]) + 0x8000u;          /* <= 63.5 codes */
    }
}

static void smooth_run(struct zs_job *job, const struct zs_row *row, int32_t r0, int32_t r1)
{
    uint16_t *color = job->color + row->at;
    uint32_t c[3], next[3], step[3];
    if (job->sub_log2 == ZS_AFFINE) {
        for (int k = 0; k < 3; k++) {
            c[k] = zs_plane_at(job, &job->c[k], r0, row->y);
            step[k] = job->c[k].gx;
        }
        fill_linear(color + r0, r1 - r0, c, step);
        return;
    }
    const int32_t length = 1 << job->sub_log2;
    int32_t from = row->x0 + ((r0 - row->x0) & -length);
    color_at(job, from, row->y, next);
    for (; from < r1; from += length) {
        const int32_t to = zs_min32(from + length, row->x1 - 1); /* its far end, covered */
        for (int k = 0; k < 3; k++) {
            c[k] = next[k];
            step[k] = 0;
        }
        if (to > from) {
            color_at(job, to, row->y, next);
            for (int k = 0; k < 3; k++) { /* |difference| < 2^22, times 2^16 */
                const int64_t part = ((int64_t)next[k] - c[k]) * zs_one_over[to - from];
                step[k] = (uint32_t)(int32_t)(part >> 32);
            }
        }
        const int32_t i0 = zs_max32(from, r0), i1 = zs_min32(from + length, r1);
        for (int k = 0; k < 3; k++)
            c[k] += zs_wrap_mul(step[k], i0 - from);
        fill_linear(color + i0, i1 - i0, c, step);
    }
}

const struct zs_shader zs_shade_smooth = { smooth_vertex, 0, zs_persp_rows, smooth_start,
                                           zs_persp_span, smooth_run, smooth_check, 0, ZS_ATTRS_SMOOTH };
