/* Blocks that are used again (kept.h): whole, apart from each other, watched by AddressSanitizer as malloc's are.
 *
 * SPDX-License-Identifier: MIT
 */
#include <string.h>

#include "cases.h"
#include "kept.h"

#define MANY 40 /* more than are kept */

#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/asan_interface.h>
#define OUT_OF_BOUNDS(at) __asan_address_is_poisoned(at)
#else
#define OUT_OF_BOUNDS(at) ((void)(at), 1)
#endif

static size_t size_of(uint32_t i)
{
    return 1 + (i * 7919u) % 300007u;
}

/* Lent at the same time, none writes into another one; and again, with sizes in another order. */
static void are_apart(void **state)
{
    (void)state;
    for (uint32_t turn = 0; turn < 5; turn++) {
        uint8_t *block[MANY];
        for (uint32_t i = 0; i < MANY; i++) {
            block[i] = sim_kept(size_of(i + turn * 13));
            assert_non_null(block[i]);
            assert_int_equal((uintptr_t)block[i] % 4, 0);
            memset(block[i], (int)i, size_of(i + turn * 13));
        }
        for (uint32_t i = 0; i < MANY; i++) {
            for (size_t at = 0; at < size_of(i + turn * 13); at++)
                assert_int_equal(block[i][at], i);
            sim_kept_end(block[i]);
        }
    }
}

/* It is the same memory that a frame's arena was in before. */
static void is_used_again(void **state)
{
    (void)state;
    void *const first = sim_kept(200000);
    sim_kept_end(first);
    for (int i = 0; i < 100; i++) {
        void *const again = sim_kept(200000);
        assert_ptr_equal(again, first);
        sim_kept_end(again);
    }
}

static void is_watched(void **state)
{
    (void)state;
    static const size_t sizes[] = { 1, 2, 7, 4096, 65535, 65536, 99998, 300001 };
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        char *const block = sim_kept(sizes[i]);
        block[0] = block[sizes[i] - 1] = 1;
        assert_true(OUT_OF_BOUNDS(block + sizes[i]));
        assert_true(OUT_OF_BOUNDS(block - 8));
        sim_kept_end(block);
        assert_true(OUT_OF_BOUNDS(block));
        assert_true(OUT_OF_BOUNDS(block + sizes[i] - 1));
    }
}

static void takes_mallocs_too(void **state)
{
    (void)state;
    sim_kept_end(malloc(10)); /* or it is a leak */
    sim_kept_end(NULL);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(are_apart),
    cmocka_unit_test(is_used_again),
    cmocka_unit_test(is_watched),
    cmocka_unit_test(takes_mallocs_too),
};
CASES_MAIN(tests)
