/* depth/linear.c.
 *
 * SPDX-License-Identifier: MIT
 */
#include "prove.h"

#include "../../lib/internals.h"

/* Proved by planes (plane_proof.c). */
/*@ requires values: v0 <= 0x10000000000 && v1 <= 0x10000000000 && v2 <= 0x10000000000;
    assigns *out \from *g, v0, v1, v2; */
void zs_plane64(const struct zs_geom *g, uint64_t v0, uint64_t v1, uint64_t v2, struct zs_plane64 *out);
/* Proved by linear_perspective, octave by octave. */
/*@ assigns \result \from *view, w, scale;
    ensures bound: \result <= 65535; */
static uint32_t pixel_key(const struct zs_view *view, uint64_t w, int32_t scale);
#include "depth/linear.c"

static struct zs_view view;

/* near at both ends of its range and at the middle, far by octave of what it is beyond near */
static void any_view(int perspective, uint32_t bits, int64_t z_near, int k)
{
    struct zs_camera camera;
    view.perspective = (uint8_t)perspective;
    view.z_near = perspective ? any_i32(256, 1 << 30) : any_i32(-(1 << 30), 1 << 30);
    view.shift = any_i32(-34, 30);
    camera.z_near = z_near;
    camera.z_far = any_i64(z_near + (int64_t)OCTAVE_LO(k), z_near + (int64_t)OCTAVE_HI(k));
    (void)linear_setup(&view, &camera, bits);
}

/* PROVE linear_orthographic: near at both ends of its range and 0, far beyond it by 1 .. 2^60 by octave, 8 and 16 bits,
 * every shift of units -34 .. 30, every z of a frame */
void linear_orthographic(void)
{
    static const int64_t near[3] = { -((int64_t)1 << 45), 0, (int64_t)1 << 45 };
    for (uint32_t bits = 8; bits <= 16; bits += 8)
        for (int i = 0; i < 3; i++)
            for (int k = 0; k < 60; k++) {
                any_view(0, bits, near[i], k);
                (void)linear_vertex(&view, any_i32(-(1 << 30), 1 << 30), 0, 0);
            }
}

/* PROVE linear_perspective: w of a pixel, 64 bits by octave and 0; scales of every triangle; every shift of the mapping
 * that its set-up gives, 8 .. 16 bits */
void linear_perspective(void)
{
    view.perspective = 1;
    view.z_near = any_i32(256, 1 << 30);
    view.key_mul = any_u32(1u << 30, 0x7fffffffu);
    view.key_shift = any_i32(-40, 128);
    view.key_top = any_u32(255u << 16, 65535u << 16);
    for (int scale = 9; scale <= 9 + 15; scale++)
        for (int k = 0; k < 64; k++)
            ASSERT(pixel_key(&view, any_u64(OCTAVE_LO(k), OCTAVE_HI(k)), scale) <= 65535u);
    ASSERT(pixel_key(&view, 0, 9) <= 65535u);
    (void)linear_inverse(&view, any_u32(256, 1u << 30));
    (void)linear_key(&view, any_u32(256, 1u << 30));
}

/* PROVE linear_triangles -eva-use-spec=zs_plane64: corners of every distance, the nearest by octave: w at most 2^40,
 * its scale one that pixels take */
void linear_triangles(void)
{
    static struct zs_renderer renderer;
    static struct zs_job job;
    static struct zs_vertex v[3];
    job.r = &renderer;
    for (int k = 8; k < 30; k++) {
        for (int i = 0; i < 3; i++) {
            v[i].d = any_u32((uint32_t)OCTAVE_LO(k), i ? 1u << 30 : (uint32_t)OCTAVE_HI(k));
            job.v[i] = &v[i];
        }
        ASSERT(linear_planes(&job) == 0);
        ASSERT(job.w64_scale >= 9 && job.w64_scale <= 9 + 15);
    }
}

static int32_t next_piece;

static void a_piece(struct zs_job *j, const struct zs_row *row, int32_t i0, int32_t i1, uint32_t sum, uint32_t step)
{
    ASSERT(i0 == next_piece && i1 == i0 + 1 && i1 <= row->i1 && step == 0);
    (void)j;
    ASSERT((sum & 0xffffu) == 0);
    next_piece = i1;
}

/* PROVE linear_rows -eva-min-loop-unroll=24 -eva-use-spec=pixel_key: rows of 1 .. 20 pixels, any w and step: each pixel
 * is a piece, whose key has 16 bits */
void linear_rows(void)
{
    static struct zs_renderer renderer;
    static struct zs_job job;
    job.r = &renderer;
    job.piece = a_piece;
    renderer.view.perspective = 1;
    renderer.view.z_near = any_i32(256, 1 << 30);
    renderer.view.key_mul = any_u32(1u << 30, 0x7fffffffu);
    renderer.view.key_shift = any_i32(-40, 128);
    renderer.view.key_top = any_u32(255u, 65535u) << 16;
    job.w64.gx = any_u64(0, UINT64_MAX);
    job.w64_scale = any_i32(9, 9 + 15);
    for (int32_t n = 1; n <= 20; n++) {
        const struct zs_row row = { 0, 0, 0, -5, 4096, 4090 - n, 4090, any_u64(0, UINT64_MAX) };
        next_piece = row.i0;
        linear_row(&job, &row);
        ASSERT(next_piece == row.i1);
    }
}
