/* Rows by the interpolators' twin (arch/lanes.h) against the core alone: every pixel and every key of scenes with
 * smooth colours and textures of each kind. tests/boards/pico.sh compares what the interpolators themselves draw.
 *
 * SPDX-License-Identifier: MIT
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "fast/lanes.h"
#include "core/fast.h"
#include "fast/less.h"
#include "frame.h"
#include "scenes.h"
#include "zs_fast.h"

static unsigned drawn; /* triangles */

static int smooth_rows(struct zs_job *job)
{
    if (job->sub_log2 != ZS_AFFINE || job->saturates)
        return zs_fast_less_rows(job);
    zs_lanes_smooth_rows(job);
    drawn++;
    return 1;
}

static int texture_rows(struct zs_job *job)
{
    if (!job->texel || !job->sampler.direct || job->saturates || !zs_lanes_texture_rows(job))
        return zs_fast_less_rows(job);
    drawn++;
    return 1;
}

/* Accelerators in which these rows stand in place of others. */
static const struct zs_fast *const *list_of(void)
{
    static struct zs_fast of[4];
    static const struct zs_fast *list[] = { &zs_fast_batch, &of[0], &of[1], &of[2], &of[3], &zs_fast_565,
                                            &zs_fast_pal8, &zs_fast_pal4, NULL };
    of[0] = zs_fast_smooth;
    of[1] = zs_fast_texture;
    of[2] = zs_fast_texture_flat;
    of[3] = zs_fast_texture_smooth;
    for (int k = 0; k < 4; k++) {
        of[k].draw = 0;
        of[k].rows = k ? texture_rows : smooth_rows;
    }
    return list;
}

/* A scene of one textured thing by another shader, its palette's texture with colours of 16 bits in it. */
static void other_format(struct zs_scene *scene, const struct zs_shader *shader, int wide)
{
    static struct zs_instance in;
    static struct zs_material material;
    static struct zs_texture texture;
    static uint16_t texel[1 << 16];
    in = scene->instance[0];
    material = *in.material;
    texture = *material.texture;
    assert_ptr_equal(texture.format, &zs_texel_pal8);
    assert_true(texture.log2_w + texture.log2_h <= 16);
    for (uint32_t i = 0; wide && i < 1u << (texture.log2_w + texture.log2_h); i++)
        texel[i] = texture.palette[((const uint8_t *)texture.texel)[i]];
    if (wide) {
        texture.format = &zs_texel_565;
        texture.texel = texel;
    }
    material.shader = shader;
    material.texture = &texture;
    in.material = &material;
    scene->instance = &in;
    scene->n_instances = 1;
}

/* A scene in strips of `strip_h` rows, drawn by both; its frame `number`. */
static void same_with(const struct demo *d, uint32_t number, uint16_t strip_h, unsigned least,
                      const struct zs_shader *shader, int wide)
{
    static struct demo_frame f;
    struct sim_frame ours, core;
    struct zs_config c;
    const size_t n = (size_t)d->width * d->height;
    sim_frame_config(&c, d->width, d->height, (uint8_t)d->varyings);
    c.depth = d->depth;
    c.strip_h = strip_h;
    d->pose(&f, number, d->width, d->height);
    if (shader)
        other_format(&f.scene, shader, wide);
    c.fast = NULL;
    assert_int_equal(sim_frame_render(&core, &f.scene, &f.camera, &c, NULL), ZS_OK);
    c.fast = list_of();
    drawn = 0;
    assert_int_equal(sim_frame_render(&ours, &f.scene, &f.camera, &c, NULL), ZS_OK);
    assert_memory_equal(ours.rgb565, core.rgb565, n * 2);
    assert_memory_equal(ours.key, core.key, n * 2);
    print_message("%s: %u triangles by lanes\n", d->name, drawn);
    assert_true(drawn >= least);
    sim_frame_free(&ours);
    sim_frame_free(&core);
}

static void same(const struct demo *d, uint32_t number, uint16_t strip_h, unsigned least)
{
    same_with(d, number, strip_h, least, NULL, 0);
}

static void smooth_colours_as_the_core(void **state)
{
    same(&demo_teapot, 0, 17, 1000);
    same(&demo_teapot, 29, 240, 1000);
    same(&demo_knot, 5, 24, 1000);
}

static void textures_as_the_core(void **state)
{
    same(&demo_mesh_tex, 0, 24, 500);
    same(&demo_relief_tex, 0, 7, 500);
    same(&demo_globe, 3, 24, 200);
    same(&demo_hall, 2, 24, 50);
}

static void light_over_textures_as_the_core(void **state)
{
    same(&demo_mesh_tex_lit, 0, 24, 500);
    same(&demo_mesh_tex_smooth, 0, 24, 500);
    same(&demo_china, 7, 60, 500);
}

static void other_formats_as_the_core(void **state)
{
    same_with(&demo_mesh_tex_lit, 0, 24, 500, &zs_shade_texture, 0);
    same_with(&demo_mesh_tex_lit, 0, 24, 500, &zs_shade_texture, 1);
    same_with(&demo_mesh_tex_smooth, 0, 24, 500, &zs_shade_texture_smooth, 1);
    same_with(&demo_china, 7, 60, 500, &zs_shade_texture_flat, 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(smooth_colours_as_the_core),
                                        cmocka_unit_test(textures_as_the_core),
                                        cmocka_unit_test(other_formats_as_the_core),
                                        cmocka_unit_test(light_over_textures_as_the_core) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
