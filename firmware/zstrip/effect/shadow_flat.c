/* Flat shadows: a mesh flattened onto a plane along a light.
 *
 * Let n be the plane's normal, C the middle of the thing's sphere, h its height above the plane,
 * and l the vector along which a height of 1 is brought down: n . l = 1, l = dir / (n . dir), or
 * for a point light l = (L - C) / (n . (L - C)). C falls to Q = C - l h. What is beside C by d
 * falls to
 *
 *     Q + f (d - l (n . d)),   f = 1, or for a point light f = H / (H - h - n . d)
 *
 * where H is the light's height. So the linear part is one matrix for both lights, I - l n^T, whose
 * norm is |l|, and a point light adds a factor a vertex. |l| and f are held to at most 256.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/fx.h"
#include "core/rotation.h"
#include "core/usual.h"
#include "zs_shadow.h"

#define STEEP 256     /* the most that |l| and f may be */
#define L_BITS 22     /* l and f are q10_22: below 2^30.1 */
#define V_BITS 14     /* of a flattened vertex, before f */
#define OUT_MAX 32700 /* steps: what the radius of a shadow is brought to, at most */
#define WORLD_Q16 ((int64_t)ZS_WORLD_MAX * 65536)

struct flat {
    int64_t q[3];       /* C, later Q: q48_16 world units */
    int64_t h, above;   /* height of C, and of the light above C, q48_16 */
    int64_t radius;     /* of the thing's sphere, q48_16 */
    int64_t size;       /* bound of the shadow's radius around Q's nearest world unit, q48_16 */
    zs_q2_30 n[3];      /* the normal in mesh axes */
    int32_t l[3];       /* q10_22 */
    int32_t m[9];       /* (I - l n^T) rot, q10_22: rows are at most 2^30.1 long */
    int32_t f;          /* f for n . d = 0, q10_22 */
    uint64_t scale;     /* world units of a step, q32_32 */
    int32_t mantissa;   /* of the scale, 2^30 .. 2^31 - 1 */
    int32_t cut, shift; /* of a product with a row of m; of that times the mantissa */
    int point;
};

/* n . v for v in q48_16, |v| < 2^48; exact but for three roundings. */
static int64_t along(const zs_q2_30 n[3], const int64_t v[3])
{
    int64_t sum = 0;
    for (int k = 0; k < 3; k++)
        sum += n[k] < 0 ? -zs_mulshift_s64(v[k], zs_size32(n[k]), 30)
                        : zs_mulshift_s64(v[k], (uint32_t)n[k], 30);
    return sum;
}

static int in_world(const int32_t p[3])
{
    return zs_size32(p[0]) <= ZS_WORLD_MAX && zs_size32(p[1]) <= ZS_WORLD_MAX &&
           zs_size32(p[2]) <= ZS_WORLD_MAX;
}

/* Return 1 for a vector of length 1, to 2^-10. */
static int is_unit(const zs_q2_30 v[3])
{
    int64_t square = 0; /* q2_40 */
    for (int k = 0; k < 3; k++)
        square += (int64_t)(v[k] >> 10) * (v[k] >> 10); /* <= 2^42 */
    return zs_size64(square - ((int64_t)1 << 40)) < (int64_t)1 << 31;
}

/* Set l from any vector towards the light and its part along the normal. */
static int slope(struct flat *f, const int64_t to[3], int64_t up)
{
    uint64_t square = 0; /* q20_20 of |l| */
    if (up <= 0)
        return ZS_ERR_VECTOR;
    for (int k = 0; k < 3; k++) {
        const uint64_t size = (uint64_t)zs_size64(to[k]);
        if (size / STEEP >= (uint64_t)up)
            return ZS_ERR_VECTOR;
        const int32_t l = (int32_t)zs_muldiv_u64(size, 1u << L_BITS, (uint64_t)up); /* <= 2^30 */
        f->l[k] = to[k] < 0 ? -l : l;
        square += (uint64_t)(l >> 12) * (uint64_t)(l >> 12); /* <= 2^36 */
    }
    return square >> 36 ? ZS_ERR_VECTOR : ZS_OK;
}

/* |l|, q10_22, rounded up. */
static uint64_t length(const int32_t l[3])
{
    uint64_t square = 0;
    for (int k = 0; k < 3; k++)
        square += (uint64_t)((int64_t)l[k] * l[k]); /* <= 2^60 */
    return zs_isqrt64(square) + 2u;
}

/* Set C (in q), h, `above`, l, f and the size. */
static int fall(struct flat *f, const struct zs_instance *in, const struct zs_shadow_plane *plane,
                const struct zs_shadow_light *light)
{
    const zs_q2_30 *const rot = zs_usual_rotation(in->pose.rot);
    int64_t from[3], to[3];
    int32_t center[3];
    f->scale = zs_usual_scale(in);
    if (!is_unit(plane->normal) || !in_world(plane->at) || !in_world(in->pose.pos) ||
        !zs_rotation_ok(rot) || f->scale >> 47 ||
        (f->point ? !in_world(light->pos) : !is_unit(light->dir)))
        return ZS_ERR_RANGE;
    f->radius = (int64_t)((in->mesh->radius + 1u) * f->scale >> 16) + 1; /* <= 2^47.1 */
    if (f->radius > WORLD_Q16)
        return ZS_ERR_RANGE;
    for (int k = 0; k < 3; k++)
        center[k] = in->mesh->center[k];
    for (int k = 0; k < 3; k++) {
        f->q[k] = (int64_t)in->pose.pos[k] * 65536 +
                  zs_mulshift_s64(zs_dot(rot + 3 * k, center), f->scale, 46); /* < 2^48 */
        from[k] = f->q[k] - (int64_t)plane->at[k] * 65536;                    /* < 2^48.3 */
        to[k] = f->point ? (int64_t)light->pos[k] * 65536 - f->q[k]
                         : (int64_t)light->dir[k] * 65536; /* < 2^48.3 */
    }
    f->h = along(plane->normal, from);
    f->above = along(plane->normal, to);
    f->f = 1 << L_BITS;
    if (f->point && f->h + f->above <= 0)
        return ZS_ERR_VECTOR; /* behind the plane, or in it */
    if (f->point && (f->above - f->radius) < (f->h + f->above) / STEEP + 1)
        return ZS_ERR_RANGE; /* not above the thing */
    const int err = slope(f, to, f->above);
    if (err)
        return err;
    const uint64_t l = length(f->l);
    f->size = zs_mulshift_s64(f->radius, l, L_BITS); /* <= 2^53.1 */
    if (f->point) {
        const uint64_t high = (uint64_t)(f->h + f->above), least = (uint64_t)(f->above - f->radius);
        f->f = (int32_t)zs_muldiv_u64(high, 1u << L_BITS, (uint64_t)f->above); /* <= 2^30 */
        if (f->size > 2 * WORLD_Q16)
            return ZS_ERR_RANGE;
        f->size = (int64_t)zs_muldiv_u64((uint64_t)f->size, high, least) + 1; /* <= 2^54 */
    }
    f->size += 0xddb5; /* the anchor's rounding: sqrt(3) / 2 units */
    for (int k = 0; k < 3; k++)
        f->q[k] -= zs_mulshift_s64(f->h, zs_size32(f->l[k]), L_BITS) * (f->l[k] < 0 ? -1 : 1);
    for (int k = 0; k < 3; k++)
        if (zs_size64(f->q[k]) > WORLD_Q16)
            return ZS_ERR_RANGE;
    return f->size > WORLD_Q16 ? ZS_ERR_RANGE : ZS_OK;
}

/* Set the matrix, and the shifts for steps of 2^e world units. */
static void matrix(struct flat *f, const struct zs_instance *in, const zs_q2_30 normal[3],
                   int32_t e)
{
    const zs_q2_30 *const rot = zs_usual_rotation(in->pose.rot);
    for (int j = 0; j < 3; j++) {
        const int32_t column[3] = { rot[j], rot[3 + j], rot[6 + j] };
        f->n[j] = (zs_q2_30)zs_round_shift(zs_dot(normal, column), 30);
        for (int i = 0; i < 3; i++) /* q52, < 2^60.1 */
            f->m[3 * i + j] = (int32_t)zs_round_shift(
                (int64_t)column[i] * (1 << L_BITS) - (int64_t)f->l[i] * f->n[j], 30);
    }
    const int32_t lz = zs_clz64(f->scale); /* 17 .. 63: scale = mantissa 2^(33 - lz) */
    f->mantissa = (int32_t)(f->scale << lz >> 33);
    /* |d| < 2^8 (radius + 2), 1/256 step; rows < 2^30.1: a product is below 2^31 when it is cut */
    f->cut = 40 - zs_clz32(in->mesh->radius + 2u); /* 40 - 31 .. 40 - 15 */
    /* q30 2^-cut times the mantissa, 2^(1 - lz), is world units; steps of 2^e, q_14 */
    f->shift = L_BITS + 8 - V_BITS - 1 + lz + e - f->cut;
    f->shift = f->shift < 0 ? 0 : f->shift > 62 ? 62 : f->shift;
}

/* f at a vertex under a point light: H / (H - h - n . d), q10_22. */
static int32_t factor(const struct flat *f, const int32_t d[3])
{
    const int64_t up = zs_mulshift_s64(zs_dot(f->n, d), f->scale, 54); /* q38 * q32 to q48_16 */
    const int64_t drop = f->above - up;
    if (drop <= 0)
        return f->f;                             /* a vertex outside the sphere */
    const int32_t lz = zs_clz64((uint64_t)drop); /* 15 .. */
    const uint32_t rcp = zs_recip((uint32_t)((uint64_t)drop << lz >> 32)); /* 2^(95 - lz) / drop */
    const int64_t factor = zs_mulshift_s64(f->h + f->above, rcp, 95 - L_BITS - lz);
    return (int32_t)zs_held64(factor, INT32_MAX);
}

/* Flatten the vertices. frac: of Q beside the anchor, steps in q_36. */
static void flatten(const struct flat *f, int16_t (*pos)[3], const struct zs_mesh *mesh,
                    const int64_t frac[3])
{
    for (uint32_t v = 0; v < mesh->n_verts; v++) {
        int32_t d[3];
        zs_mesh_place(mesh, v, d);
        for (int k = 0; k < 3; k++)
            d[k] -= mesh->center[k] * 256;
        const int32_t by = f->point ? factor(f, d) : 1 << L_BITS;
        for (int k = 0; k < 3; k++) {
            const int32_t part = (int32_t)(zs_dot(f->m + 3 * k, d) >> f->cut);
            const int64_t at = ((int64_t)part * f->mantissa) >> f->shift; /* q_14, |.| < 2^29 */
            const int64_t step = (zs_held64(at, (int64_t)1 << 30) * by + frac[k]) >>
                                 (V_BITS + L_BITS);
            pos[v][k] = (int16_t)zs_held64(step, 32767);
        }
    }
}

int zs_shadow_flatten(struct zs_instance *shadow, struct zs_mesh *mesh, int16_t (*pos)[3],
                      const struct zs_instance *caster, const struct zs_shadow_plane *plane,
                      const struct zs_shadow_light *light)
{
    static const struct zs_mesh no_mesh;
    static const struct zs_pose no_pose;
    struct flat f;
    if (!shadow || !mesh || !caster || !plane || !light || !caster->mesh)
        return ZS_ERR_NULL;
    const struct zs_mesh *from = caster->mesh;
    if (from->n_verts && (!pos || !from->pos))
        return ZS_ERR_NULL;
    f.point = light->point;
    const int err = fall(&f, caster, plane, light);
    if (err)
        return err;
    int32_t e = -16;
    while (f.size >> (16 + e) > OUT_MAX) /* size <= 2^45: e <= 15 */
        e++;
    matrix(&f, caster, plane->normal, e);
    int64_t frac[3];
    struct zs_pose pose = no_pose;
    for (int k = 0; k < 3; k++) {
        pose.pos[k] = (int32_t)zs_round_shift(f.q[k], 16);
        frac[k] = (f.q[k] - (int64_t)pose.pos[k] * 65536) *
                      ((int64_t)1 << (V_BITS + L_BITS - 16 - e)) +
                  ((int64_t)1 << (V_BITS + L_BITS - 1)); /* < 2^15 2^36 */
    }
    flatten(&f, pos, from, frac);
    *mesh = no_mesh;
    mesh->pos = (const int16_t(*)[3])pos;
    mesh->tri = from->tri;
    mesh->n_verts = from->n_verts;
    mesh->n_tris = from->n_tris;
    mesh->scale = (zs_uq16_16)1 << (16 + e);
    mesh->radius = (uint16_t)((f.size >> (16 + e)) + 2);
    shadow->mesh = mesh;
    shadow->pose = pose;
    return ZS_OK;
}
