/* What errors are called: each its own clause, and one for what is no error of the library.
 *
 * SPDX-License-Identifier: MIT
 */
#include <limits.h>
#include <string.h>

#include "cases.h"
#include "zstrip.h"

static const int errors[] = { ZS_OK, ZS_ERR_NULL, ZS_ERR_SIZE, ZS_ERR_ARENA, ZS_ERR_DEPTH, ZS_ERR_CAMERA, ZS_ERR_RANGE,
                              ZS_ERR_MESH, ZS_ERR_SEQUENCE, ZS_ERR_VARYINGS, ZS_ERR_VECTOR, ZS_ERR_NEAR,
                              ZS_ERR_TEXTURE, ZS_ERR_BUILD, ZS_ERR_PASS };
#define N (sizeof errors / sizeof errors[0])

/* A word of each clause, so that none is another's. */
static const char *const words[N] = { "no error", "NULL", "pool", "arena", "depth", "near, far", "integers", "mesh",
                                      "order", "varyings", "direction", "too close", "texture", "compiled",
                                      "viewport" };

static void each_has_its_clause(void **state)
{
    (void)state;
    for (size_t k = 0; k < N; k++) {
        const char *said = zs_error_string(errors[k]);
        assert_non_null(said);
        if (!strstr(said, words[k]))
            fail_msg("error %d is called: %s", errors[k], said);
        assert_true(said[strlen(said) - 1] != '.' && !strchr(said, '\n'));
        for (size_t i = 0; i < k; i++)
            assert_string_not_equal(said, zs_error_string(errors[i]));
    }
}

static void others_are_unknown(void **state)
{
    (void)state;
    static const int others[] = { 1, 2, 99, INT_MAX, -(int)N, -(int)N - 1, -1000, INT_MIN, INT_MIN + 1 };
    for (size_t k = 0; k < sizeof others / sizeof others[0]; k++)
        assert_string_equal(zs_error_string(others[k]), "unknown error");
}

static const struct CMUnitTest tests[] = { cmocka_unit_test(each_has_its_clause),
                                           cmocka_unit_test(others_are_unknown) };
CASES_MAIN(tests)
