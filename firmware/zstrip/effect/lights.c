/* Light at a point: attenuation, cones, diffuse light and highlights; checks.
 *
 * Unit vectors have 15 fraction bits, so that a product of two of them has 32 bits: a cosine is off
 * by at most 2^-15.5 for each rounded vector. A highlight of power p multiplies that by p: 64 codes
 * * 128 * 2^-14.5 is 0.35 code. Colours are summed in 16.16 bits.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/rotation.h"
#include "core/usual.h"
#include "effect/lights.h"

#define SPAN_LEAST (1u << 22) /* least difference of a cone's cosines */
#define STRENGTH_MAX (4u * ZS_Q16_ONE)
#define RANGE_MAX (1u << 30)

_Static_assert(ZS_LIGHTS_MAX <= 16, "struct zs_lit_sum: below 2^23");

/* Value at the left end of a cell of 1/128, less half the error of a straight line between the
 * ends, q1_31 with 20 bits, and in the low 12 bits by how much it falls in the cell, 2^-16. */
const uint32_t zs_lit_root[96] = {
    0xfffd17d1u, 0xfc14b778u, 0xf858c726u, 0xf4c616d9u, 0xf159c691u, 0xee11364fu, 0xeaea1610u,
    0xe7e225d5u, 0xe4f7859fu, 0xe228556bu, 0xdf73053au, 0xdcd6050cu, 0xda4ff4e1u, 0xd7df94b8u,
    0xd583a491u, 0xd33b146du, 0xd104d44au, 0xcee01429u, 0xcccbd409u, 0xcac753ebu, 0xc8d1d3cfu,
    0xc6ea83b3u, 0xc510d399u, 0xc3442381u, 0xc183d369u, 0xbfcf6352u, 0xbe26433du, 0xbc880328u,
    0xbaf42314u, 0xb96a3301u, 0xb7e9e2eeu, 0xb672c2ddu, 0xb50472ccu, 0xb39e92bbu, 0xb240f2acu,
    0xb0eb229du, 0xaf9ce28eu, 0xae55f280u, 0xad160272u, 0xabdce265u, 0xaaaa4259u, 0xa97e024cu,
    0xa857d241u, 0xa7379235u, 0xa61d022au, 0xa508021fu, 0xa3f85215u, 0xa2edd20bu, 0xa1e85201u,
    0xa0e7b1f8u, 0x9febc1efu, 0x9ef461e6u, 0x9e0171ddu, 0x9d12d1d5u, 0x9c2851cdu, 0x9b41f1c5u,
    0x9a5f71bdu, 0x9980d1b6u, 0x98a5e1afu, 0x97ce91a8u, 0x96fad1a1u, 0x962a719au, 0x955d7194u,
    0x9493a18du, 0x93cd1187u, 0x93098181u, 0x9248f17bu, 0x918b6176u, 0x90d09170u, 0x9018a16bu,
    0x8f635165u, 0x8eb0b160u, 0x8e00b15bu, 0x8d532156u, 0x8ca82151u, 0x8bff714du, 0x8b592148u,
    0x8ab52144u, 0x8a13613fu, 0x8973c13bu, 0x88d65137u, 0x883b0133u, 0x87a1b12fu, 0x870a612bu,
    0x86751127u, 0x85e1b123u, 0x8550211fu, 0x84c0711cu, 0x84329118u, 0x83a66115u, 0x831c0111u,
    0x8293410eu, 0x820c310bu, 0x8186d108u, 0x8102f105u, 0x8080b102u,
};

/* ---- Vectors --------------------------------------------------------------------------------- */

int zs_lit_unit(int32_t out[3], const int32_t v[3], uint32_t *square, int32_t *exp)
{
    const uint32_t most = zs_size32(v[0]) | zs_size32(v[1]) | zs_size32(v[2]);
    if (!most) {
        out[0] = out[1] = out[2] = 0;
        return 0;
    }
    const int32_t up = zs_clz32(most) - 2; /* -1 .. 29: the largest in [2^29, 2^30) */
    int32_t w[3];
    uint64_t sum = 0;
    for (int k = 0; k < 3; k++) {
        w[k] = up < 0 ? v[k] >> 1 : v[k] * (1 << up);
        sum += (uint64_t)zs_mul_ss(w[k], w[k]); /* < 3 * 2^60 */
    }
    const uint32_t m = (uint32_t)(sum >> 30); /* [2^28, 2^31.6) */
    const int32_t even = zs_clz32(m) & ~1;    /* 0 or 2 */
    const uint32_t q = m << even;
    uint32_t y = zs_lit_rsqrt(q - (1u << 30));
    const int32_t over = (int32_t)(zs_umulh(zs_umulh(y, y), q) - (1u << 30)); /* |.| < 2^17.6 */
    y -= (uint32_t)(((int32_t)(y >> 18) * over) >> 13); /* Newton: y (1 - over / 2^31), 2^-27 */
    const int32_t down = 47 - even / 2;
    for (int k = 0; k < 3; k++) /* |w| < 2^30 / sqrt(m / 2^30) */
        out[k] = (int32_t)((zs_mul_su(w[k], y) + ((int64_t)1 << (down - 1))) >> down);
    *square = m;
    *exp = -up;
    return 1;
}

/* Return e, and v * 2^-e with 31 bits, for any v below 2^62. */
static int32_t narrow(int32_t out[3], const int64_t v[3])
{
    const int64_t most = zs_size64(v[0]) | zs_size64(v[1]) | zs_size64(v[2]);
    const int32_t e = 34 - zs_clz64((uint64_t)most | 1u); /* below 2^30 */
    for (int k = 0; k < 3; k++)
        out[k] = (int32_t)zs_scale2(v[k], -e);
    return e;
}

/* Convert a unit vector from q2_30. */
static inline void short_unit(int32_t out[3], const zs_q2_30 v[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = (v[k] + (1 << 14)) >> 15;
}

/* ---- The point ------------------------------------------------------------------------------- */

int zs_lit_placed(const struct zs_lit_material *m, const struct zs_camera *camera)
{
    const struct zs_lighting *l = m->lighting;
    if (camera->projection == ZS_PERSPECTIVE && m->flags & (ZS_LIT_TWO_SIDED | ZS_LIT_NEAR_VIEWER))
        return 1;
    for (uint32_t k = 0; k < l->n_lamps; k++)
        if (l->lamp[k].kind != ZS_LAMP_DIRECTIONAL)
            return 1;
    return 0;
}

/* rot * p in steps, q17_14, times scale = mantissa * 2^(32 - lz) / 2^32, mantissa >= 2^31. The
 * product has 63 bits; what is beyond the world is out of view. */
void zs_lit_place(struct zs_lit_at *at, const struct zs_instance *in, const int32_t p[3])
{
    const zs_q2_30 *const rot = zs_usual_rotation(in->pose.rot);
    const uint64_t scale = zs_usual_scale(in);
    const int32_t lz = zs_clz64(scale);
    const uint32_t mantissa = (uint32_t)(scale << lz >> 32);
    for (int k = 0; k < 3; k++) {
        const int64_t turned = zs_dot(rot + 3 * k, p); /* q_38 steps, |.| < 2^54.8 */
        const int64_t part = zs_mul_su((int32_t)((turned + (1 << 23)) >> 24), mantissa);
        at->pos[k] = zs_scale2(part, 2 - lz) + in->pose.pos[k] * (int64_t)ZS_Q16_ONE;
    }
}

void zs_lit_view(struct zs_lit_at *at, const struct zs_camera *camera, int near)
{
    int64_t to[3];
    int32_t v[3], exp;
    uint32_t square;
    if (!near || camera->projection == ZS_ORTHOGRAPHIC) {
        short_unit(at->view, camera->rot + 6);
        return;
    }
    for (int k = 0; k < 3; k++)
        to[k] = camera->pos[k] * (int64_t)ZS_Q16_ONE - at->pos[k];
    (void)narrow(v, to);
    (void)zs_lit_unit(at->view, v, &square, &exp);
}

void zs_lit_normal(struct zs_lit_at *at, const struct zs_instance *in, const int32_t n[3])
{
    const zs_q2_30 *const rot = zs_usual_rotation(in->pose.rot);
    int32_t v[3], exp;
    uint32_t square;
    for (int k = 0; k < 3; k++) { /* q_30, |.| < 2^30.9 */
        v[k] = 0;
        for (int j = 0; j < 3; j++)
            v[k] += ((rot[3 * k + j] + (1 << 14)) >> 15) * n[j];
    }
    (void)zs_lit_unit(at->n, v, &square, &exp);
}

/* ---- Lamps ----------------------------------------------------------------------------------- */

/* Multiply two fractions, a up to 2^18 and b up to 2^16, uq16_16. */
static inline uint32_t times(uint32_t a, uint32_t b)
{
    return (a >> 3) * b >> 13;
}

/* Return (d / limit)^2, uq16_16, at most 2^31. d^2 = m * 2^exp world units, m in [2^28, 2^31.6). */
static uint32_t ratio(uint32_t m, int32_t exp, uint32_t limit)
{
    const uint64_t square = zs_mul_uu(limit, limit);
    const int32_t lz = zs_clz64(square);
    const uint32_t p = zs_umulh(m, zs_recip((uint32_t)(square << lz >> 32)));
    const int32_t down = 47 - exp - lz;
    if (down > 31)
        return 0;
    return down < 0 || p >> down > 1u << 31 ? 1u << 31 : p >> down;
}

/* How much of the light is left at a distance, up to 2^16. */
static uint32_t faded(const struct zs_lamp *lamp, uint32_t m, int32_t exp)
{
    uint32_t left = ZS_Q16_ONE;
    if (lamp->range) {
        const uint32_t t = ratio(m, exp, lamp->range);
        if (t >= ZS_Q16_ONE)
            return 0;
        left = ZS_Q16_ONE - t;
        left = times(left, left);
    }
    if (lamp->half) {
        const uint32_t whole = ZS_Q16_ONE + ratio(m, exp, lamp->half);
        const int32_t lz = zs_clz32(whole);
        left = times(zs_recip(whole << lz) >> (31 - lz), left);
    }
    return left;
}

/* How much of a spot's light goes in the direction -l, up to 2^16. */
static uint32_t in_cone(const struct zs_lamp *lamp, const int32_t l[3])
{
    int64_t c = 0; /* q_45 */
    for (int k = 0; k < 3; k++)
        c -= zs_mul_ss(lamp->dir[k], l[k]);
    const int64_t inside = (c >> 15) - lamp->outer; /* q_30 */
    if (inside <= 0)
        return 0;
    const uint32_t span = (uint32_t)lamp->inner - (uint32_t)lamp->outer; /* <= 2^31 */
    if (inside >= span)
        return ZS_Q16_ONE;
    const int32_t lz = zs_clz32(span);
    const uint32_t t = zs_umulh((uint32_t)inside << lz, zs_recip(span << lz)) >> 15;
    const uint32_t tt = times(t, t); /* t <= 2^16 */
    return zs_minu32(times(3u * ZS_Q16_ONE - 2u * t, tt), ZS_Q16_ONE);
}

/* Set l to the unit vector to a lamp; return the strength of its light there, up to 2^18. */
static uint32_t lamp_at(const struct zs_lamp *lamp, const struct zs_lit_at *at, int32_t l[3])
{
    const uint32_t strength = lamp->strength ? lamp->strength : ZS_Q16_ONE;
    if (lamp->kind == ZS_LAMP_DIRECTIONAL) {
        short_unit(l, lamp->dir);
        return strength;
    }
    int64_t to[3];
    int32_t v[3], exp;
    uint32_t m;
    for (int k = 0; k < 3; k++)
        to[k] = lamp->pos[k] * (int64_t)ZS_Q16_ONE - at->pos[k];
    const int32_t e = narrow(v, to);
    if (!zs_lit_unit(l, v, &m, &exp))
        return 0;
    exp = 2 * (e + exp) + 30 - 32; /* from q_16 to world units */
    const int32_t near = -exp - 16;
    if (near > 31 || (near > 0 && m >> near == 0))
        return 0; /* nearer than 2^-8 */
    const uint32_t left = faded(lamp, m, exp);
    const uint32_t cone = lamp->kind == ZS_LAMP_SPOT && left ? in_cone(lamp, l) : ZS_Q16_ONE;
    return times(strength, times(left, cone));
}

uint32_t zs_lit_shine(const struct zs_shine *shine, int32_t c)
{
    const int32_t t = zs_min32(c, 65535) - shine->least;
    if (t < 0)
        return 0;
    const uint32_t at = (uint32_t)t * shine->scale >> 15; /* 1/256 entries, up to 2^16 */
    const uint32_t i = at >> 8, low = shine->level[i];
    const uint32_t v = (low << 8) + (shine->level[i + 1u] - low) * (at & 255u); /* 255 * 2^8 is 1 */
    return v + (v >> 8) + (v >> 15);
}

/* Cosine of the highlight's angle, uq0_16. */
static int32_t gloss_at(const struct zs_lit_material *m, const struct zs_lit_at *at,
                        const int32_t l[3], int32_t n_l)
{
    int32_t h[3], exp;
    uint32_t square;
    if (m->flags & ZS_LIT_REFLECT) { /* R . V = 2 (N . L) (N . V) - L . V; q_30 */
        const int32_t n_v = zs_lit_dot(at->n, at->view), l_v = zs_lit_dot(l, at->view);
        return (int32_t)(((zs_mul_ss(n_l, n_v) >> 29) - l_v) >> 14);
    }
    for (int k = 0; k < 3; k++)
        h[k] = l[k] + at->view[k];
    (void)zs_lit_unit(h, h, &square, &exp);
    return zs_lit_dot(at->n, h) >> 14;
}

/* Add light of a lamp's colour to a sum. */
static void lamp_color(const struct zs_lamp *lamp, uint32_t light, uint32_t sum[3])
{
    static const struct zs_rgb white = { 255, 255, 255 };
    const struct zs_rgb c = lamp->rgb.r | lamp->rgb.g | lamp->rgb.b ? lamp->rgb : white;
    if (!light)
        return;
    sum[0] += zs_lit_part(c.r, light);
    sum[1] += zs_lit_part(c.g, light);
    sum[2] += zs_lit_part(c.b, light);
}

void zs_lit_add(const struct zs_lit_material *m, const struct zs_lit_at *at, struct zs_lit_sum *sum)
{
    const struct zs_lighting *const lighting = m->lighting;
    const struct zs_rgb specular = m->specular, ambient = lighting->ambient;
    const int glossy = m->shine && (specular.r | specular.g | specular.b);
    sum->diffuse[0] = zs_lit_part(ambient.r, ZS_Q16_ONE);
    sum->diffuse[1] = zs_lit_part(ambient.g, ZS_Q16_ONE);
    sum->diffuse[2] = zs_lit_part(ambient.b, ZS_Q16_ONE);
    sum->shine[0] = sum->shine[1] = sum->shine[2] = 0;
    for (uint32_t i = 0; i < lighting->n_lamps; i++) {
        const struct zs_lamp *const lamp = &lighting->lamp[i];
        int32_t l[3];
        const uint32_t strength = lamp_at(lamp, at, l);
        const int32_t n_l = strength ? zs_lit_dot(at->n, l) : 0;
        if (n_l <= 0)
            continue;
        const uint32_t lambert = (uint32_t)(n_l + (1 << 13)) >> 14; /* <= 2^16.1 */
        const uint32_t light = times(strength, lambert);
        lamp_color(lamp, light, sum->diffuse);
        if (glossy)
            lamp_color(lamp, times(strength, zs_lit_shine(m->shine, gloss_at(m, at, l, n_l))),
                       sum->shine);
    }
}

void zs_lit_lamp(const struct zs_lit_material *m, struct zs_lit_sum *sum)
{
    const struct zs_lamp *const lamp = m->lighting->lamp;
    for (int k = 0; k < 3; k++)
        sum->diffuse[k] = sum->shine[k] = 0;
    lamp_color(lamp, lamp->strength ? lamp->strength : ZS_Q16_ONE, sum->diffuse);
    lamp_color(lamp, lamp->strength ? lamp->strength : ZS_Q16_ONE, sum->shine);
}

void zs_lit_mix(const struct zs_lit_material *m, struct zs_rgb rgb, const struct zs_lit_sum *sum,
                uint16_t out[3])
{
    const uint8_t c[3] = { rgb.r, rgb.g, rgb.b };
    const uint8_t s[3] = { m->specular.r, m->specular.g, m->specular.b };
    const uint8_t e[3] = { m->emission.r, m->emission.g, m->emission.b };
    for (int k = 0; k < 3; k++) {
        const uint32_t v = zs_lit_part(c[k], sum->diffuse[k]) + zs_lit_part(s[k], sum->shine[k]) +
                           e[k] * 257u;
        out[k] = (uint16_t)zs_minu32(v, 65535u);
    }
}

/* ---- Highlights ------------------------------------------------------------------------------ */

/* Return c^n, uq0_32, for c below 1. */
static uint32_t power_of(uint32_t c, uint32_t n)
{
    uint32_t result = UINT32_MAX;
    for (; n; n >>= 1) {
        if (n & 1u)
            result = zs_umulh(result, c);
        c = zs_umulh(c, c);
    }
    return result;
}

int zs_shine_set(struct zs_shine *shine, uint32_t power)
{
    if (!shine)
        return ZS_ERR_NULL;
    if (power < 1 || power > 255)
        return ZS_ERR_RANGE;
    uint32_t least = 0;
    for (uint32_t bit = 1u << 15; bit; bit >>= 1) /* the largest with a power of at most 1/256 */
        if (power_of((least + bit) << 16, power) <= 1u << 24)
            least += bit;
    const uint32_t span = ZS_Q16_ONE - least; /* 1400 .. 65280 */
    shine->least = (uint16_t)least;
    shine->scale = (1u << 31) / span;
    for (uint32_t i = 0; i < sizeof shine->level; i++) {
        const uint32_t c = least + (i * span + 128u) / 256u;
        const uint32_t full = c < ZS_Q16_ONE ? power_of(c << 16, power) : UINT32_MAX;
        shine->level[i] = (uint8_t)((zs_umulh(full, 510u) + 1u) / 2u);
    }
    shine->level[0] = 0;
    return ZS_OK;
}

/* ---- Checks ---------------------------------------------------------------------------------- */

static int lamp_check(const struct zs_lamp *lamp)
{
    const int spot = lamp->kind == ZS_LAMP_SPOT;
    int far = 0;
    for (int k = 0; k < 3; k++)
        far |= zs_size32(lamp->pos[k]) > (uint32_t)ZS_WORLD_MAX;
    if (lamp->kind > ZS_LAMP_SPOT || lamp->strength > STRENGTH_MAX)
        return ZS_ERR_RANGE;
    if (lamp->kind != ZS_LAMP_DIRECTIONAL &&
        (far || lamp->range > RANGE_MAX || lamp->half > RANGE_MAX))
        return ZS_ERR_RANGE;
    if (spot &&
        (lamp->inner > ZS_Q30_ONE || lamp->outer < -ZS_Q30_ONE || lamp->outer > lamp->inner ||
         (uint32_t)lamp->inner - (uint32_t)lamp->outer < SPAN_LEAST))
        return ZS_ERR_RANGE;
    if (lamp->kind != ZS_LAMP_POINT) {
        uint32_t d[3];
        for (int k = 0; k < 3; k++) {
            d[k] = zs_size32(lamp->dir[k]);
            if (d[k] > (uint32_t)ZS_Q30_ONE + (1u << 18))
                return ZS_ERR_VECTOR;
        }
        const int64_t off = (int64_t)(zs_mul_uu(d[0], d[0]) + zs_mul_uu(d[1], d[1]) +
                                      zs_mul_uu(d[2], d[2])) -
                            ((int64_t)1 << 60);
        if (zs_size64(off) > (int64_t)1 << 49) /* of the square: twice that of the length */
            return ZS_ERR_VECTOR;
    }
    return ZS_OK;
}

int zs_lighting_check(const struct zs_lighting *lighting)
{
    if (!lighting || (lighting->n_lamps && !lighting->lamp))
        return ZS_ERR_NULL;
    if (lighting->n_lamps > ZS_LIGHTS_MAX)
        return ZS_ERR_RANGE;
    for (uint32_t i = 0; i < lighting->n_lamps; i++) {
        const int err = lamp_check(&lighting->lamp[i]);
        if (err)
            return err;
    }
    return ZS_OK;
}

int zs_lit_check(const struct zs_instance *in, const struct zs_config *config)
{
    const struct zs_lit_material *m = zs_lit_material_of(in);
    (void)config;
    if (m->flags & ~7u || (m->shine && !m->shine->scale))
        return ZS_ERR_RANGE;
    return zs_lighting_check(m->lighting);
}
