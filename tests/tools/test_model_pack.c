/* A model as a block of bytes: what comes back is what was written; a block that is cut off or changed is refused, or
 * gives a model whose indices, sides and coordinates are in their ranges.
 *
 * SPDX-License-Identifier: MIT
 */
#include <math.h>
#include <stdarg.h>
#include <setjmp.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "model_pack.h"
#include "sim.h"

static double points[4][3] = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
static uint32_t tris[2][3] = { { 0, 1, 2 }, { 0, 2, 3 } };
static float normals[2][3][3] = { { { 0, 0, 1 }, { 0, 0, 1 }, { 0, 0, 1 } },
                                  { { 1, 0, 0 }, { 1, 0, 0 }, { 1, 0, 0 } } };
static struct zs_rgb colors[2][3] = { { { 1, 2, 3 }, { 4, 5, 6 }, { 7, 8, 9 } } };
static double uvs[2][3][2] = { { { 0, 0 }, { 1, 0 }, { 0, 1 } },
                               { { 0.5, 0.25 }, { -3, 2 }, { 0, 0 } } };
static uint8_t has_uv[2] = { 1, 1 };
static uint32_t tri_material[2] = { 0, 1 };
static struct sim_material materials[2] = {
    { .name = (char *)"wood", .rgb = { 10, 20, 30 }, .power = 40, .alpha_mode = SIM_ALPHA_MASK, .alpha_least = 100 },
    { .name = (char *)"", .rgb = { 1, 1, 1 }, .two_sided = 1, .texture = SIM_NO_TEXTURE }
};
static uint8_t texels[8][3] = { { 255, 0, 1 }, { 2 }, { 3 }, { 4 }, { 5 }, { 6 }, { 7 }, { 8 } };
static uint8_t alphas[8] = { 0, 255, 3, 4, 5, 6, 7, 8 };
static struct sim_texture textures[1] = { { .name = (char *)"a.png", .image = { 4, 2, texels, alphas }, .file_width = 5,
                                            .file_height = 3, .clamp = ZS_CLAMP_U, .alpha_mode = SIM_ALPHA_MASK } };

static struct sim_model whole(void)
{
    return (struct sim_model){ .file = "m.obj", .point = points, .tri = tris, .normal = normals, .rgb = colors,
                               .uv = uvs, .has_uv = has_uv, .tri_material = tri_material, .material = materials,
                               .texture = textures, .lost_materials = (char *)"gone.mtl", .n_points = 4, .n_tris = 2,
                               .n_materials = 2, .n_textures = 1, .single = 1, .file_normals = 1,
                               .hi = { 1, 1, 1 }, .center = { 0.5, 0.5, 0.5 }, .radius = 0.9,
                               .lost = { [SIM_LOST_SKIN] = { 3, "bones" } } };
}

static const struct sim_want all = { .normals = 1, .textures = 1 };
static const struct sim_want shape; /* alone */

static char block[4096];

static size_t packed(const struct sim_model *model)
{
    FILE *f = fmemopen(block, sizeof block, "wb");
    assert_non_null(f);
    sim_model_pack(f, model);
    const long n = ftell(f);
    assert_int_equal(fclose(f), 0);
    assert_true(n > 0 && (size_t)n < sizeof block);
    return (size_t)n;
}

/* A copy of its own, so that reading beyond it is seen. */
static int unpacked(struct sim_model *out, size_t n, const struct sim_want *want)
{
    char *own = malloc(n + (n == 0));
    assert_non_null(own);
    memcpy(own, block, n);
    const int status = sim_model_unpack(out, own, n, "n.obj", want);
    free(own);
    return status;
}

static void comes_back_whole(void **state)
{
    const struct sim_model in = whole();
    struct sim_model out;
    (void)state;
    assert_int_equal(unpacked(&out, packed(&in), &all), SIM_OK);
    assert_string_equal(out.file, "n.obj");
    assert_string_equal(out.lost_materials, "gone.mtl");
    assert_int_equal(out.n_points, 4);
    assert_int_equal(out.n_tris, 2);
    assert_memory_equal(out.point, points, sizeof points);
    assert_memory_equal(out.tri, tris, sizeof tris);
    assert_memory_equal(out.normal, normals, sizeof normals);
    assert_memory_equal(out.rgb, colors, sizeof colors);
    assert_memory_equal(out.uv, uvs, sizeof uvs);
    assert_memory_equal(out.has_uv, has_uv, sizeof has_uv);
    assert_memory_equal(out.tri_material, tri_material, sizeof tri_material);
    assert_string_equal(out.material[0].name, "wood");
    assert_string_equal(out.material[1].name, "");
    assert_int_equal(out.material[0].rgb.g, 20);
    assert_int_equal(out.material[1].texture, SIM_NO_TEXTURE);
    assert_string_equal(out.texture[0].name, "a.png");
    assert_int_equal(out.texture[0].image.width, 4);
    assert_int_equal(out.texture[0].file_height, 3);
    assert_memory_equal(out.texture[0].image.rgb, texels, sizeof texels);
    assert_memory_equal(out.texture[0].image.alpha, alphas, sizeof alphas);
    assert_int_equal(out.material[0].alpha_least, 100);
    assert_int_equal(out.material[1].two_sided, 1);
    assert_int_equal(out.lost[SIM_LOST_SKIN].n, 3);
    assert_string_equal(out.lost[SIM_LOST_SKIN].first, "bones");
    assert_memory_equal(out.hi, in.hi, sizeof in.hi);
    assert_true(out.radius == 0.9 && out.single == 1 && out.file_normals == 1);
    sim_model_free(&out);
}

static void arrays_that_are_not_there(void **state)
{
    struct sim_model in = whole(), out;
    (void)state;
    in.normal = NULL;
    in.uv = NULL;
    in.has_uv = NULL;
    in.texture = NULL;
    in.n_textures = 0;
    in.lost_materials = NULL;
    materials[0].texture = SIM_NO_TEXTURE;
    const size_t n = packed(&in);
    materials[0].texture = 0;
    assert_int_equal(unpacked(&out, n, &all), SIM_REFUSED); /* they were asked for */
    assert_int_equal(unpacked(&out, n, &shape), SIM_OK);
    assert_null(out.normal);
    assert_null(out.uv);
    assert_null(out.has_uv);
    assert_null(out.lost_materials);
    assert_int_equal(out.n_textures, 0);
    sim_model_free(&out);
}

static void cut_off_or_longer(void **state)
{
    const struct sim_model in = whole();
    const size_t n = packed(&in);
    struct sim_model out;
    (void)state;
    for (size_t k = 0; k <= n + 8; k++) {
        assert_int_equal(unpacked(&out, k, &all), k == n ? SIM_OK : SIM_REFUSED);
        sim_model_free(&out);
    }
}

/* What others rely on, looked up here again. */
static void must_be_sound(const struct sim_model *m)
{
    assert_true(m->n_points > 0 && m->n_tris > 0 && m->n_materials > 0);
    assert_true(m->normal != NULL && m->uv != NULL && m->has_uv != NULL);
    for (uint32_t i = 0; i < m->n_points; i++)
        for (int k = 0; k < 3; k++)
            assert_true(isfinite(m->point[i][k]));
    for (uint32_t t = 0; t < m->n_tris; t++) {
        assert_true(m->tri_material[t] < m->n_materials && m->has_uv[t] <= 1);
        for (int k = 0; k < 3; k++) {
            assert_true(m->tri[t][k] < m->n_points);
            assert_true(fabs(m->uv[t][k][0]) <= SIM_UV_MAX && fabs(m->uv[t][k][1]) <= SIM_UV_MAX);
            assert_true(isfinite(m->normal[t][k][0]) && isfinite(m->normal[t][k][1]) &&
                        isfinite(m->normal[t][k][2]));
        }
    }
    for (uint32_t i = 0; i < m->n_materials; i++) {
        assert_non_null(m->material[i].name);
        assert_true(m->material[i].texture < m->n_textures ||
                    m->material[i].texture == SIM_NO_TEXTURE);
    }
    for (uint32_t i = 0; i < m->n_textures; i++) {
        const struct sim_image *image = &m->texture[i].image;
        assert_true(image->width <= SIM_TEXTURE_MAX && image->height <= SIM_TEXTURE_MAX);
        assert_true(image->width > 0 && (image->width & (image->width - 1)) == 0);
        assert_true(image->height > 0 && (image->height & (image->height - 1)) == 0);
        (void)image->rgb[(size_t)image->width * image->height - 1][2];
        if (image->alpha != NULL)
            (void)image->alpha[(size_t)image->width * image->height - 1];
        assert_true(m->texture[i].alpha_mode <= SIM_ALPHA_BLEND);
        assert_non_null(m->texture[i].name);
    }
    for (int i = 0; i < SIM_LOST_KINDS; i++)
        assert_non_null(memchr(m->lost[i].first, 0, sizeof m->lost[i].first));
    assert_true(isfinite(m->radius) && m->radius > 0.0);
}

static void every_byte_changed(void **state)
{
    static const unsigned char by[] = { 1, 2, 0x80, 0x40, 0xff };
    const struct sim_model in = whole();
    const size_t n = packed(&in);
    size_t refused = 0, taken = 0;
    (void)state;
    for (size_t at = 0; at < n; at++)
        for (size_t k = 0; k < sizeof by; k++) {
            struct sim_model out;
            block[at] = (char)(block[at] ^ by[k]);
            if (unpacked(&out, n, &all) == SIM_OK) {
                must_be_sound(&out);
                taken++;
            } else {
                refused++;
            }
            sim_model_free(&out);
            block[at] = (char)(block[at] ^ by[k]);
        }
    assert_true(refused > 200 && taken > 200);
}

/* Counts whose products wrap, or that ask for terabytes. */
static void huge_counts(void **state)
{
    static const uint32_t counts[] = {
        0, 0x7fffffff, 0x80000000, 0xffffffff, 0x55555556, 0x40000001
    };
    const struct sim_model in = whole();
    const size_t n = packed(&in);
    static const size_t at[] = { offsetof(struct sim_model, n_points),
                                 offsetof(struct sim_model, n_tris),
                                 offsetof(struct sim_model, n_materials),
                                 offsetof(struct sim_model, n_textures) };
    struct sim_model out;
    (void)state;
    for (size_t k = 0; k < 4; k++)
        for (size_t i = 0; i < sizeof counts / sizeof counts[0]; i++) {
            char kept[4];
            memcpy(kept, block + at[k], 4);
            memcpy(block + at[k], &counts[i], 4);
            assert_int_equal(unpacked(&out, n, &all), SIM_REFUSED);
            memcpy(block + at[k], kept, 4);
        }
}

/* Sides of a texture that the renderer does not take, with as many texels as they say. */
static void odd_sides(void **state)
{
    static const uint32_t sides[][3] = { { 4, 2, 1 }, { 8, 1, 1 }, { 3, 2, 0 },
                                         { 2, 3, 0 }, { 0, 4, 0 }, { 4, 0, 0 } };
    (void)state;
    for (size_t i = 0; i < sizeof sides / sizeof sides[0]; i++) {
        const struct sim_model in = whole();
        struct sim_model out;
        textures[0].image.width = sides[i][0];
        textures[0].image.height = sides[i][1];
        const size_t n = packed(&in);
        assert_int_equal(unpacked(&out, n, &all), sides[i][2] ? SIM_OK : SIM_REFUSED);
        sim_model_free(&out);
    }
    textures[0].image.width = 4;
    textures[0].image.height = 2;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(comes_back_whole),  cmocka_unit_test(arrays_that_are_not_there),
        cmocka_unit_test(cut_off_or_longer), cmocka_unit_test(every_byte_changed),
        cmocka_unit_test(huge_counts),       cmocka_unit_test(odd_sides),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
