/* float.c.
 *
 * SPDX-License-Identifier: MIT
 */
#include "prove.h"

#include "core/rows.h"

/* Proved by planes (plane_proof.c). */
/*@ requires values: v0 <= 0x10000000000 && v1 <= 0x10000000000 && v2 <= 0x10000000000;
    assigns *out \from *g, v0, v1, v2; */
void zs_plane64(const struct zs_geom *g, uint64_t v0, uint64_t v1, uint64_t v2, struct zs_plane64 *out);
/*@ assigns *out \from *g, v0, v1, v2, kind; */
void zs_plane32(const struct zs_geom *g, uint32_t v0, uint32_t v1, uint32_t v2, int32_t kind,
                struct zs_plane *out);
/*@ assigns \nothing; */
static ZS_NOINLINE void pair_piece(struct zs_job *job, const struct zs_row *row, int32_t i, int32_t n, uint32_t w,
                                   int32_t farther);
#include "depth/float.c"

static struct zs_view view;

static void any_view(uint32_t bits, uint32_t exponent_bits, int k)
{
    struct zs_camera camera;
    view.perspective = 1;
    view.shift = any_i32(-34, 30);
    camera.z_near = any_i64((int64_t)OCTAVE_LO(k), (int64_t)OCTAVE_HI(k));
    camera.z_far = any_i64(2, (int64_t)1 << 60);
    (void)float_setup(&view, &camera, bits, exponent_bits);
}

/* PROVE float_setups: near of 2^-16 to 2^29 world units by octave, every shift of units, 8 and 16 bits, exponents
 * of 3 .. 5 */
void float_setups(void)
{
    for (uint32_t bits = 8; bits <= 16; bits += 8)
        for (uint32_t e = 3; e <= 5; e++)
            for (int k = 0; k <= 45; k++)
                any_view(bits, e, k);
}

/* PROVE float_keys: 8 and 16 bits, exponents of 3 .. 5, near of 2^8 .. 2^30 camera units by octave, every z by
 * octave */
void float_keys(void)
{
    for (uint32_t bits = 8; bits <= 16; bits += 8)
        for (uint32_t e = 3; e <= 5; e++) {
            any_view(bits, e, 0);
            view.key_shift = any_i32(1, 24); /* near = key_mul / 2^key_shift */
            view.key_lz = view.key_octaves - 1 - view.key_shift;
            view.key_mul = any_u32(1u << 31, UINT32_MAX);
            for (int k = 8; k <= 30; k++)
                (void)float_vertex(&view, any_i32((int32_t)OCTAVE_LO(k), (int32_t)OCTAVE_HI(k)),
                                   any_u32(1u << 31, UINT32_MAX), 31 - k);
        }
}

/* PROVE float_inverses_of: octave and mantissa of every key, 8 and 16 bits, exponents 3 .. 5 */
void float_inverses_of(void)
{
    for (uint32_t bits = 8; bits <= 16; bits += 8)
        for (uint32_t e = 3; e <= 5; e++) {
            any_view(bits, e, 0);
            for (int32_t o = 1; o <= (int32_t)view.key_octaves; o++) {
                const uint32_t d = any_u32(0, view.key_top + 0xffffu);
                const int32_t of = octave_of(&view, d);
                ASSERT(of >= 1 && of <= (int32_t)view.key_octaves);
                (void)mantissa_of(&view, d, o);
            }
        }
}

/* PROVE float_rounding: shifts 2 .. 63, sums of 64 bits, any */
void float_rounding(void)
{
    for (int32_t shift = 2; shift < 64; shift++) {
        (void)rounded(any_u64(0, UINT64_MAX), shift, 0);
        (void)rounded(any_u64(0, UINT64_MAX), shift, 1);
    }
    for (int32_t last = 1; last <= 31; last++) {
        const int32_t down = octaves_down(any_u64(0, UINT64_MAX), last);
        ASSERT(down >= 1 && down <= last);
    }
}

/* ---- Triangles across octaves ---------------------------------------------------------------------------- */

static struct zs_renderer renderer;
static struct zs_job job;
static struct zs_vertex pool[3];

static void a_view(uint32_t bits, uint32_t exponent_bits)
{
    any_view(bits, exponent_bits, 20);
    renderer.view = view;
    job.r = &renderer;
}

static uint32_t any_of_octave(int32_t o)
{
    const uint32_t most = (((uint32_t)o + 1u) << view.key_fraction) - 1u; /* code + 2^-16; modulo 2^32 */
    const uint32_t least = o > 1 ? (uint32_t)o << view.key_fraction : 0u;
    return any_u32(view.piece_base - most, view.piece_base - least);
}

static void planes_of(int32_t nearest, int32_t o)
{
    for (int k = 0; k < 3; k++) {
        pool[k].d = any_of_octave(k ? o : nearest);
        job.v[k] = &pool[k];
    }
    job.geom.tiny = any_i32(0, 1);
    job.w64_scale = 0;
    ASSERT(float_planes(&job) == (o == nearest));
    ASSERT(job.w64_scale == (o == nearest ? 0 : nearest));
}

/* PROVE float_planes_of -eva-use-spec=zs_plane32,zs_plane64 -eva-min-loop-unroll=32: 8 .. 16 bits with exponents of 3
 * and 4, 8, 12 and 16 with 5, the nearest vertex in every octave and the others in that and in every farther one, every
 * key of theirs, tiny or not: the planes' values are at most 2^40 */
void float_planes_of(void)
{
    for (uint32_t bits = 8; bits <= 16; bits++)
        for (uint32_t e = 3; e <= (bits % 4u ? 4u : 5u); e++) {
            a_view(bits, e);
            for (int32_t nearest = 1; nearest <= (int32_t)view.key_octaves; nearest++)
                for (int32_t o = 1; o <= nearest; o++)
                    planes_of(nearest, o);
        }
}

static void inverses_of(int32_t nearest, int32_t o)
{
    const struct zs_vertex *const v[3] = { &pool[0], &pool[1], &pool[2] };
    uint32_t w[3];
    for (int k = 0; k < 3; k++)
        pool[k].d = any_of_octave(k ? o : nearest);
    float_inverses(&view, v, w);
}

/* PROVE float_inverses_shifts -eva-min-loop-unroll=32: 8, 12 and 16 bits, exponents of 3 .. 5, the nearest vertex in
 * every octave and the others in that and in every farther one, every key of theirs */
void float_inverses_shifts(void)
{
    for (uint32_t bits = 8; bits <= 16; bits += 4)
        for (uint32_t e = 3; e <= 5; e++) {
            any_view(bits, e, 20);
            for (int32_t nearest = 1; nearest <= (int32_t)view.key_octaves; nearest++)
                for (int32_t o = 1; o <= nearest; o++)
                    inverses_of(nearest, o);
        }
}

static void a_piece(struct zs_job *j, const struct zs_row *row, int32_t i0, int32_t i1, uint32_t sum, uint32_t gx)
{
    (void)j;
    (void)sum;
    (void)gx;
    ASSERT(row->i0 <= i0 && i0 < i1 && i1 <= row->i1);
}

static struct zs_row a_row(int32_t n)
{
    const struct zs_row row = { 0, 0, any_u32(0, UINT32_MAX), -5, 4096, 4090 - n, 4090, 0 };
    job.piece = a_piece;
    return row;
}

/* 8 .. 16 bits, exponents of 3 .. 5, the nearest vertex in every octave from `least` on: for each, `of`, with a row of
 * 6 pixels. */
static void each_nearest(int32_t least, void (*of)(int32_t nearest, const struct zs_row *row))
{
    const struct zs_row row = a_row(6);
    for (uint32_t bits = 8; bits <= 16; bits++)
        for (uint32_t e = 3; e <= 5; e++) {
            a_view(bits, e);
            for (int32_t nearest = least; nearest <= (int32_t)view.key_octaves; nearest++)
                of(nearest, &row);
        }
}

static void pair_pieces_of(int32_t nearest, const struct zs_row *row)
{
    for (int32_t farther = 0; farther < 2; farther++) {
        job.w64_scale = nearest;
        job.key.gx = any_u32(0, UINT32_MAX);
        pair_piece(&job, row, row->i0, 6, any_u32(0, UINT32_MAX), farther);
    }
}

/* PROVE float_pair_pieces -eva-use-spec=zs_recip: 8 .. 16 bits, exponents of 3 .. 5, every octave, any w and step:
 * either piece */
void float_pair_pieces(void)
{
    each_nearest(2, pair_pieces_of);
}

/* PROVE float_pair_spans -eva-use-spec=pair_piece: every step by octave and sign, 2, 64 and 4096 pixels, any w
 * from which as many steps reach the border of the octaves, which lies ahead. Taken as given: in other rows both
 * ends lie on one side of it, and pieces lie within the row */
void float_pair_spans(void)
{
    static const int32_t number[3] = { 2, 64, 4096 };
    for (int k = 0; k < 31; k++)
        for (int i = 0; i < 6; i++) {
            const int64_t reach = (int64_t)OCTAVE_HI(k) * (number[i / 2] - 1);
            struct zs_row row = a_row(number[i / 2]);
            const uint32_t gx = any_u32((uint32_t)OCTAVE_LO(k), (uint32_t)OCTAVE_HI(k));
            row.i1 -= row.i0;
            row.i0 = 0;
            if (i & 1) {
                row.key = (uint32_t)(PAIR_END + any_i64(0, reach < INT32_MAX ? reach : INT32_MAX));
                job.key.gx = 0u - gx;
            } else {
                row.key = (uint32_t)(PAIR_END - any_i64(1, reach < PAIR_END ? reach : PAIR_END));
                job.key.gx = gx;
            }
            pair_span(&job, &row);
        }
}

static void pieces_of(int32_t nearest, const struct zs_row *row)
{
    for (int32_t down = 1; down <= nearest; down++) {
        job.w64_scale = nearest;
        job.w64.gx = any_u64(0, UINT64_MAX);
        float_piece(&job, row, any_u64(0, UINT64_MAX), down, row->i0, 6);
    }
}

/* PROVE float_pieces -eva-use-spec=zs_recip: 8 .. 16 bits, exponents of 3 .. 5, every octave of the nearest vertex
 * and of the piece, any w and step */
void float_pieces(void)
{
    each_nearest(1, pieces_of);
}

/* PROVE float_bisections -eva-use-spec=zs_recip: 2 .. 9 pixels and up to 4096, any w and step, every number of
 * octaves: at least one pixel lies in the first one's octave, and not all do */
void float_bisections(void)
{
    for (int32_t last = 1; last <= 31; last++) {
        const int32_t down = any_i32(1, last), n = any_i32(2, 4096);
        for (int32_t k = 2; k < 10; k++) {
            const int32_t in = pixels_within(any_u64(0, UINT64_MAX), any_u64(0, UINT64_MAX), k, down, last);
            ASSERT(in >= 1 && in < k);
        }
        (void)pixels_within(any_u64(0, UINT64_MAX), any_u64(0, UINT64_MAX), n, down, last);
    }
}
