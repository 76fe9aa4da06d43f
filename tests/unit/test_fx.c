/* Fixed-point helpers against exact arithmetic.
 *
 * SPDX-License-Identifier: MIT
 */
#include "cases.h"
#include "core/fx.h"
#include "products.h"

/* ---- Reciprocal ------------------------------------------------------------------------------ */

/* |zs_recip(a) - 2^63 / a| * a as a part of 2^63: relative error times 2^63. */
static uint64_t recip_error(uint32_t a)
{
    const __int128 off = (__int128)zs_recip(a) * a - ((__int128)1 << 63);
    return (uint64_t)(off < 0 ? -off : off);
}

/* 2^31 exactly cannot be told: 2^32 does not fit, the answer is one less. */
#define RECIP_BOUND ((uint64_t)1 << 33) /* 2^-30 */

static void recip_over_every_table_entry(void **state)
{
    struct prng p = { 1 };
    uint64_t most = 0;
    for (uint32_t cell = 0; cell < 256; cell++) {
        const uint32_t first = 0x80000000u + (cell << 23);
        for (uint32_t k = 0; k < 20000; k++) {
            const uint32_t in = k < 64      ? k
                                : k < 128   ? (1u << 23) - 1u - (k - 64)
                                            : (uint32_t)prng_next(&p) & ((1u << 23) - 1u);
            const uint64_t error = recip_error(first + in);
            most = error > most ? error : most;
            if (error > RECIP_BOUND)
                print_error("zs_recip(%u) is off by %g\n", first + in, (double)error / 0x1p63);
            assert_true(error <= RECIP_BOUND);
        }
    }
    print_message("zs_recip: 5.1 M values, relative error at most 2^-30 * %.3f\n",
                  (double)most / 0x1p33);
}

static void recip_in_steps(void **state)
{
    for (uint64_t a = 0x80000000u; a <= 0xffffffffu; a += 41) /* 52 M values */
        assert_true(recip_error((uint32_t)a) <= RECIP_BOUND);
    assert_int_equal(zs_recip(0x80000000u), 0xffffffffu);
    assert_true(recip_error(0xffffffffu) <= RECIP_BOUND);
}

/* ---- Square root, wide products -------------------------------------------------------------- */

static int isqrt_case(uint64_t seed)
{
    struct prng p = { seed };
    for (int k = 0; k < 1000; k++) {
        const uint64_t root = (uint64_t)prng_log(&p) & 0xffffffffu;
        const uint64_t near_square = root * root + (uint64_t)prng_range(&p, -2, 2);
        const uint64_t v = k % 2 ? near_square : (uint64_t)prng_log(&p);
        const uint64_t r = zs_isqrt64(v);
        if ((unsigned __int128)r * r > v || (unsigned __int128)(r + 1) * (r + 1) <= v)
            return case_wrong("zs_isqrt64(%llu) = %llu", (unsigned long long)v,
                              (unsigned long long)r);
    }
    return 1;
}

static void isqrt_is_the_floor(void **state)
{
    assert_int_equal(zs_isqrt64(0), 0);
    assert_int_equal(zs_isqrt64(UINT64_MAX), UINT32_MAX);
    CASES(isqrt_case, 1000);
}

static int muldiv_case(uint64_t seed)
{
    struct prng p = { seed };
    for (int k = 0; k < 1000; k++) {
        const uint64_t a = (uint64_t)prng_log(&p), b = (uint64_t)prng_log(&p);
        const unsigned __int128 product = (unsigned __int128)a * b;
        uint64_t d = (uint64_t)prng_log(&p);
        const uint64_t least = (uint64_t)(product >> 64) + 1u; /* the quotient must fit */
        if (d < least)
            d = k % 3 ? least + (uint64_t)prng_pick(&p, 3) : least;
        if (d < least)
            d = UINT64_MAX;
        if (d < least || d == 0)
            continue;
        if (zs_muldiv_u64(a, b, d) != (uint64_t)(product / d))
            return case_wrong("zs_muldiv_u64(%llu, %llu, %llu)", (unsigned long long)a,
                              (unsigned long long)b, (unsigned long long)d);
    }
    return 1;
}

static int mulshift_case(uint64_t seed)
{
    struct prng p = { seed };
    for (int k = 0; k < 1000; k++) {
        const int64_t a = prng_log(&p);
        const uint64_t b = (uint64_t)prng_log(&p), mag = a < 0 ? 0u - (uint64_t)a : (uint64_t)a;
        const unsigned __int128 product = (unsigned __int128)mag * b;
        const int n = prng_range(&p, 0, 127);
        const unsigned __int128 want = product >> n;
        if (want >> 63)
            continue;
        const int64_t signed_want = a < 0 ? -(int64_t)want : (int64_t)want;
        if (zs_mulshift_s64(a, b, n) != signed_want)
            return case_wrong("zs_mulshift_s64(%lld, %llu, %d)", (long long)a,
                              (unsigned long long)b, n);
    }
    return 1;
}

static void products_and_leading_zeros(void **state)
{
    uint32_t wrong[2];
    const int right = wide_right(3000000, wrong);
    if (!right)
        print_error("wide.h: wrong with %#x, %#x\n", wrong[0], wrong[1]);
    assert_true(right);
}

/* ---- Small ones ------------------------------------------------------------------------------ */

static int small_case(uint64_t seed)
{
    struct prng p = { seed };
    for (int k = 0; k < 1000; k++) {
        const int32_t c = prng_range(&p, -(1 << 23), 1 << 23);
        const int32_t i = zs_first_sample(c); /* the least i with 256 i + 128 >= c */
        CASE_CHECK((int64_t)i * 256 + 128 >= c && ((int64_t)i - 1) * 256 + 128 < c);
        const uint64_t v = (uint64_t)prng_log(&p);
        if (v) {
            const int lz = zs_clz64(v);
            CASE_CHECK(v >> (63 - lz) == 1);
        }
        if ((uint32_t)v)
            CASE_CHECK((uint32_t)v >> (31 - zs_clz32((uint32_t)v)) == 1);
        CASE_CHECK(zs_umulh((uint32_t)v, (uint32_t)c) ==
                   (uint64_t)(uint32_t)v * (uint32_t)c / ((uint64_t)1 << 32));
        const int64_t w = prng_log(&p) / 4;
        const int n = prng_range(&p, 0, 62);
        const __int128 twice = ((__int128)w * 2 + ((__int128)1 << n)); /* halves up */
        const __int128 down = twice >> (n + 1);
        CASE_CHECK(w >= (int64_t)1 << 62 || zs_round_shift(w, n) == (int64_t)down);
    }
    return 1;
}

static void samples_leading_zeros_and_shifts(void **state)
{
    assert_int_equal(zs_first_sample(128), 0);  /* on a sample: that one */
    assert_int_equal(zs_first_sample(129), 1);
    assert_int_equal(zs_first_sample(-128), -1);
    assert_int_equal(zs_first_sample(-127), 0);
    assert_int_equal(zs_clz32(1), 31);
    assert_int_equal(zs_clz32(UINT32_MAX), 0);
    assert_int_equal(zs_clz64(1), 63);
    assert_int_equal(zs_clz64((uint64_t)1 << 32), 31);
    assert_int_equal(zs_scale2(-5, 3), -40);
    assert_int_equal(zs_scale2(5, -1), 3);
    assert_int_equal(zs_scale2(INT32_MAX, -100), 0);
    CASES(small_case, 1000);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(recip_over_every_table_entry),
    cmocka_unit_test(recip_in_steps),
    cmocka_unit_test(isqrt_is_the_floor),
    CASES_TEST(muldiv_against_128_bits, muldiv_case, 1000),
    CASES_TEST(mulshift_against_128_bits, mulshift_case, 1000),
    cmocka_unit_test(products_and_leading_zeros),
    cmocka_unit_test(samples_leading_zeros_and_shifts)
};

CASES_MAIN(tests)
