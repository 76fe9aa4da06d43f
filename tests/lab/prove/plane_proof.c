/* plane.c: sides, geometry, gradients, planes.
 *
 * SPDX-License-Identifier: MIT
 */
#include "prove.h"

#include "../../lib/internals.h"

/* Proved by quotients below, and what the planes' proofs know of it. */
/*@ requires 1 <= lz <= 31 && (least_shift == 2 || least_shift == 5);
    requires -0x1000000000000 <= n <= 0x1000000000000;
    assigns \result \from n, rcp, lz, least_shift;
    ensures bound: \result == -2147483648 || -1073741824 <= \result <= 1073741824; */
int32_t zs_plane_quotient(int64_t n, uint32_t rcp, int32_t lz, int32_t least_shift);
#include "core/plane.c"

/* Snapped coordinates: the guard band, a step beside it, and the place of the frame's middle. */
#define COORD_LO (-ZS_GUARD_SUBPX - 1)
#define COORD_HI (ZS_GUARD_SUBPX + 1 + ZS_SIZE_MAX * ZS_SUBPX_HALF)
#define SPAN_MAX (((int32_t)1 << ZS_EXTENT_BITS) - 1)

static struct zs_renderer renderer;
static struct zs_job job;

/* PROVE differences: any two vertices that are not to be clipped: every difference below 2^22 */
void differences(void)
{
    /* both lie within the guard band around one middle, which is the larger part of COORD_HI */
    const int32_t mid = any_i32(0, ZS_SIZE_MAX * ZS_SUBPX_HALF);
    const int32_t a = any_i32(-ZS_GUARD_SUBPX - 1, ZS_GUARD_SUBPX + 1),
                  b = any_i32(-ZS_GUARD_SUBPX - 1, ZS_GUARD_SUBPX + 1);
    ASSERT(mid + a >= COORD_LO && mid + a <= COORD_HI);
    ASSERT(b - a <= SPAN_MAX && b - a >= -SPAN_MAX);
}

static void sides_of(int32_t x, int32_t y, int32_t dx1, int32_t dx2, int32_t dy1, int32_t dy2)
{
    const struct zs_vertex top = { x, y, 0 }, mid = { x + dx1, y + dy1, 0 }, bottom = { x + dx2, y + dy2, 0 };
    zs_plane_sides(&job, &top, &mid, &bottom);
    ASSERT(job.geom.area >= -((int64_t)1 << 46) && job.geom.area < (int64_t)1 << 46);
    ASSERT(job.v[0] == &top && job.v[1] == &mid && job.v[2] == &bottom);
}

/* PROVE sides: the first vertex at both ends of its range and at 0, differences |dx| < 2^22, 0 <= dy < 2^22, in the box
 * of tiny triangles and in six boxes that are all that is outside it */
void sides(void)
{
    static const int32_t at[3] = { COORD_LO, 0, COORD_HI };
    for (int i = 0; i < 3; i++) {
        const int32_t c = at[i], tiny = ZS_TINY, most = SPAN_MAX;
        const int32_t any_x = any_i32(-most, most), any_y = any_i32(0, most);
        sides_of(c, c, any_i32(-tiny, tiny - 1), any_i32(-tiny, tiny - 1), any_i32(0, tiny - 1), any_i32(0, tiny - 1));
        sides_of(c, c, any_i32(tiny, most), any_x, any_y, any_y);
        sides_of(c, c, any_i32(-most, -tiny - 1), any_x, any_y, any_y);
        sides_of(c, c, any_x, any_i32(tiny, most), any_y, any_y);
        sides_of(c, c, any_x, any_i32(-most, -tiny - 1), any_y, any_y);
        sides_of(c, c, any_x, any_x, any_y, any_i32(tiny, most));
    }
}

/* A geometry after zs_plane_sides: any. */
static void any_sides(int32_t most)
{
    struct zs_geom *g = &job.geom;
    static struct zs_vertex v[3];
    job.r = &renderer;
    renderer.config.width = (uint16_t)any_u32(1, ZS_SIZE_MAX);
    renderer.config.height = renderer.view.height = (uint16_t)any_u32(1, ZS_SIZE_MAX);
    job.width = job.pitch = renderer.config.width;
    job.bottom = renderer.config.height;
    for (int k = 0; k < 3; k++) {
        v[k].x = any_i32(COORD_LO, COORD_HI);
        v[k].y = any_i32(COORD_LO, COORD_HI);
        v[k].d = any_u32(0, UINT32_MAX);
        job.v[k] = &v[k];
    }
    g->dx1 = any_i32(-most, most);
    g->dx2 = any_i32(-most, most);
    g->dy1 = any_i32(0, most);
    g->dy2 = any_i32(0, most);
}

/* PROVE geometry: every area by octave, tiny (below 2^30) or not, vertices and frames in their whole range; relations
 * between differences and area taken as given */
void geometry(void)
{
    for (int k = 0; k < 45; k++)
        for (int tiny = 0; tiny < (k < 30 ? 2 : 1); tiny++) {
            any_sides(SPAN_MAX);
            job.geom.area = any_i64((int64_t)OCTAVE_LO(k), (int64_t)OCTAVE_HI(k));
            job.geom.tiny = tiny;
            zs_plane_geom(&job);
            ASSERT(job.geom.ax >= -(1 << 24) && job.geom.ax <= 1 << 24);
            ASSERT(job.geom.exp <= 0 && job.geom.exp >= -31);
        }
}

static void any_reciprocal(int least, int most)
{
    job.geom.rcp = any_u32(1u << 31, UINT32_MAX);
    job.geom.exp = any_i32(least, most);
}

static void quotient_of(int64_t n, int32_t lz)
{
    for (int least = ZS_PLANE_WIDE; least <= ZS_PLANE_KEY; least += ZS_PLANE_KEY - ZS_PLANE_WIDE) {
        const int32_t q = zs_plane_quotient(n, any_u32(1u << 31, UINT32_MAX), lz, least);
        const int32_t most = 1 << (32 - least); /* 2^30 or 2^27 */
        ASSERT(q == ZS_TOO_STEEP || (q >= -most && q <= most));
    }
}

/* PROVE quotients -eva-split-return=full: |n| <= 2^48 by octave and sign, leading zeros 1 .. 31 of the area, every
 * reciprocal, both least shifts: at most 2^30 or 2^27, or too steep */
void quotients(void)
{
    for (int32_t lz = 1; lz <= 31; lz++) {
        quotient_of(0, lz);
        for (int k = 0; k < 48; k++) {
            const int64_t n = any_i64((int64_t)OCTAVE_LO(k), (int64_t)OCTAVE_HI(k));
            quotient_of(n, lz);
            quotient_of(-n, lz);
        }
        quotient_of((int64_t)1 << 48, lz);
        quotient_of(-((int64_t)1 << 48), lz);
    }
}

/* PROVE gradients -eva-use-spec=zs_plane_quotient: differences of values of 32 bits, of a tiny triangle's corners and
 * of a small one's: what is divided is at most 2^48 */
void gradients(void)
{
    static const int32_t most[2] = { ZS_SMALL_EXTENT, ZS_TINY };
    for (int tiny = 0; tiny < 2; tiny++) {
        const int32_t d[2] = { any_i32(-most[tiny], most[tiny]), any_i32(-most[tiny], most[tiny]) };
        any_reciprocal(-31, -1);
        job.geom.tiny = tiny;
        for (int least = ZS_PLANE_WIDE; least <= ZS_PLANE_KEY; least += ZS_PLANE_KEY - ZS_PLANE_WIDE)
            (void)gradient(&job.geom, any_i32(INT32_MIN, INT32_MAX), any_i32(INT32_MIN, INT32_MAX), d, least);
    }
}

/* PROVE large_division: every numerator of 64 bits, every area up to 2^46 by octave */
void large_division(void)
{
    for (int k = 0; k < 46; k++) {
        int64_t whole;
        (void)divide(any_i64(INT64_MIN, INT64_MAX), any_i64((int64_t)OCTAVE_LO(k), (int64_t)OCTAVE_HI(k)), &whole);
    }
}

/* PROVE small_division: every numerator of 64 bits, every area of a small triangle */
void small_division(void)
{
    for (int exp = -31; exp <= -1; exp++) {
        int64_t whole;
        any_reciprocal(exp, exp);
        job.geom.area = any_i64((int64_t)OCTAVE_LO(31 + exp), (int64_t)OCTAVE_HI(31 + exp));
        (void)small_divide(&job.geom, any_i64(INT64_MIN, INT64_MAX), &whole);
    }
}

/* exp: of a small triangle's area; of a large one's the octave */
static void plane_of(int small, int tiny, int32_t exp)
{
    struct zs_geom *g = &job.geom;
    const int32_t most = tiny ? ZS_TINY : small ? ZS_SMALL_EXTENT : SPAN_MAX;
    any_sides(most);
    g->tiny = tiny;
    if (small) {
        any_reciprocal(exp, exp);
        g->area = any_i64((int64_t)OCTAVE_LO(31 + exp), (int64_t)OCTAVE_HI(31 + exp));
        g->ax = any_i32(-127, 128);
        g->ay = any_i32(-127, 128);
    } else {
        g->rcp = 0;
        g->area = any_i64((int64_t)OCTAVE_LO(exp), (int64_t)OCTAVE_HI(exp));
        g->ax = any_i32(-(1 << 23), 1 << 23);
        g->ay = any_i32(-(1 << 23), 1 << 23);
    }
    for (int kind = ZS_PLANE_WIDE; kind <= ZS_PLANE_KEY; kind += ZS_PLANE_KEY - ZS_PLANE_WIDE) {
        struct zs_plane out;
        struct zs_plane64 wide;
        zs_plane32(g, any_u32(0, UINT32_MAX), any_u32(0, UINT32_MAX), any_u32(0, UINT32_MAX), (enum zs_plane_kind)kind,
                   &out);
        zs_plane64(g, any_u64(0, (uint64_t)1 << 40), any_u64(0, (uint64_t)1 << 40), any_u64(0, (uint64_t)1 << 40),
                   &wide);
    }
}

/* PROVE planes -eva-use-spec=zs_recip,zs_plane_quotient: three values of 32 bits, or of 2^40, any, over
 * triangles tiny, small and large, every difference and area of each, both kinds */
void planes(void)
{
    for (int32_t exp = -18; exp <= -2; exp++)
        plane_of(1, 1, exp);
    for (int32_t exp = -31; exp <= -1; exp++)
        plane_of(1, 0, exp);
    for (int32_t k = 0; k < 46; k++)
        plane_of(0, 0, k);
}
