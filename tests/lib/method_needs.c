/* What memory a method of hidden-surface removal asks for: see method_needs.h.
 *
 * SPDX-License-Identifier: MIT
 */
#include "method_needs.h"

#include "cases.h"
#include "picture.h"

void assert_method_needs(const struct method_needs *needs)
{
    static const int16_t corner[3][3] = { { 0, 0, -2000 }, { 900, 0, -2000 }, { 0, 900, -2000 } };
    struct lone l;
    struct zs_camera camera;
    lone_set(&l, corner, 3, ZS_Q16_ONE);
    assert_int_equal(zs_camera_perspective(&camera, ZS_DEGREES(60), 48, 100, 40000), ZS_OK);
    struct zs_config c = picture_config(64, 48, needs->other);
    c.method = needs->method;
    struct picture is = picture_draw(&c, &l.scene, &camera);
    assert_int_equal(is.err, ZS_ERR_DEPTH);
    picture_free(&is);
    c.depth = needs->depth;
    for (c.max_tris = 1; c.max_tris <= needs->tris + 1; c.max_tris++)
        for (c.max_verts = 5; c.max_verts <= 6; c.max_verts++) {
            is = picture_draw(&c, &l.scene, &camera);
            assert_int_equal(is.err, c.max_tris >= needs->tris && c.max_verts == 6 ? ZS_OK : ZS_ERR_SIZE);
            picture_free(&is);
        }
}

void method_needs_test(void **state)
{
    assert_method_needs(*state);
}
