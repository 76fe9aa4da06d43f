/* Light (shade/light.c) against double precision.
 *
 * SPDX-License-Identifier: MIT
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cases.h"
#include "doubles.h"
#include "internals.h"

static double light_worst;

static int light_case(uint64_t seed)
{
    struct prng p = { seed };
    struct zs_renderer r;
    struct zs_mesh mesh;
    struct zs_material material;
    struct zs_instance in = { .mesh = &mesh, .material = &material };
    struct zs_scene scene = { .instance = &in, .n_instances = 1 };
    memset(&r, 0, sizeof r);
    memset(&mesh, 0, sizeof mesh);
    memset(&material, 0, sizeof material);
    mesh.scale = ZS_Q16_ONE;
    material.shader = &zs_shade_flat;
    zs_pose_identity(&in.pose);
    zs_pose_turn(&in.pose, (zs_turn)prng_next(&p), (zs_turn)prng_next(&p), (zs_turn)prng_next(&p));
    in.pose.pos[2] = -1000;
    const int32_t dir[3] = { prng_range(&p, -999, 999), prng_range(&p, -999, 999),
                             1 + prng_range(&p, 0, 999) };
    (void)zs_unit(scene.light.dir, dir);
    scene.light.ambient = prng_pick(&p, ZS_Q16_ONE / 2 + 1);
    scene.light.diffuse = prng_pick(&p, ZS_Q16_ONE / 2 + 1); /* the sum is at most 1 */
    /* a frame sets r->xform up when it is walked: do as bin.c does */
    struct zs_camera camera;
    struct zs_config config = { .width = 8, .height = 8, .strip_h = 8, .max_tris = 8, .max_verts = 8, .buffers = 1,
                                .subpixel_bits = 8, .depth_bits = 16, .depth = &zs_depth_recip };
    uint32_t arena[2048];
    if (zs_camera_perspective(&camera, 8192, 8, 1, 2000) ||
        zs_init(&r, &config, arena, sizeof arena) || zs_frame_begin(&r, &scene, &camera))
        return case_wrong("set-up");
    struct zs_bounds b;
    CASE_CHECK(zs_cull_bounds(&b, &r, &in) == ZS_OK && zs_xform_instance(&r, 0, &b) == 1);
    for (int n = 0; n < 50; n++) {
        double v[3] = { prng_range(&p, -99, 99), prng_range(&p, -99, 99), prng_range(&p, -99, 99) };
        if (v[0] == 0 && v[1] == 0 && v[2] == 0)
            continue;
        unit3(v);
        const zs_q1_15 normal[3] = { (zs_q1_15)lrint(v[0] * 32767), (zs_q1_15)lrint(v[1] * 32767),
                                     (zs_q1_15)lrint(v[2] * 32767) };
        double dot = 0;
        for (int k = 0; k < 3; k++) {
            double world = 0;
            for (int j = 0; j < 3; j++)
                world += q30(in.pose.rot[3 * k + j]) * normal[j] / 32767;
            dot += world * q30(scene.light.dir[k]);
        }
        const double want = scene.light.ambient + scene.light.diffuse * fmax(0, dot);
        const double off = fabs(zs_light_intensity(&r.shading, normal) - want) / 65536;
        light_worst = fmax(light_worst, off);
        if (off > 0x1p-14)
            return case_wrong("intensity off by %g", off);
    }
    return 1;
}

static void light_intensity_against_doubles(void **state)
{
    (void)state;
    light_worst = 0;
    CASES(light_case, 2000);
    print_message("light: off by at most 2^-16 * %.3f\n", light_worst * 0x1p16);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(light_intensity_against_doubles)
};

CASES_MAIN(tests)
