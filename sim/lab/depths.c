/* `zsim depths`: for each mapping, near/far ratio and distance, the least separation of two parallel walls
 * that the renderer never swaps, found by drawing them: tilted in several ways, in both orders, 16-bit keys.
 * In parts of the distance, so that 0.01 % at 10 m is a millimetre.
 *
 * SPDX-License-Identifier: MIT
 */
#include "depths.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "frame.h"
#include "sim.h"

#define W SIM_DEPTHS_W
#define H SIM_DEPTHS_H_PX
#define NEAR SIM_DEPTHS_NEAR
#define TILTS 6
#define BISECTIONS 14

static const struct {
    const char *name;
    const struct zs_depth *depth;
} mappings[] = { { "linear", &zs_depth_linear }, { "recip", &zs_depth_recip },  { "e3m13", &zs_depth_e3m13 },
                 { "e4m12", &zs_depth_e4m12 },   { "e5m11", &zs_depth_e5m11 } };
#define N_MAPPINGS (sizeof mappings / sizeof mappings[0])

static const double ratios[] = { 10, 100, 1000, 10000, 100000 };
static const double places[] = { 1.2, 3, 8, 30, 80, 300, 800, 3000, 8000, 30000, 80000 }; /* times near */

static const uint16_t wall_tri[2][3] = { { 0, 1, 2 }, { 0, 2, 3 } };

void sim_depths_wall(struct sim_depths_wall *w, double z, const double slope[2], double beyond)
{
    static const double corner[4][2] = { { -1, -1 }, { 1, -1 }, { 1, 1 }, { -1, 1 } };
    const double scale = z / 20000.0, unit = floor(scale * 65536.0 + 1.0) / 65536.0;
    memset(w, 0, sizeof *w);
    for (int k = 0; k < 4; k++) {
        const double x = corner[k][0] * z * 0.8, y = corner[k][1] * z * 0.8;
        const double p[3] = { x, y, -(z + x * slope[0] + y * slope[1] + beyond) };
        for (int c = 0; c < 3; c++) {
            const double steps = floor(p[c] / unit * 256.0 + 0.5);
            const double whole = floor(steps / 256.0);
            w->pos[k][c] = (int16_t)whole;
            w->lo[k][c] = (uint8_t)(steps - whole * 256.0);
        }
    }
    w->mesh.pos = (const int16_t(*)[3])w->pos;
    w->mesh.pos_lo = (const uint8_t(*)[3])w->lo;
    w->mesh.tri = wall_tri;
    w->mesh.n_verts = 4;
    w->mesh.n_tris = 2;
    w->mesh.scale = (zs_uq16_16)(unit * 65536.0);
    w->mesh.center[2] = -20000;
    w->mesh.radius = 26000;
}

int sim_depths_in_order(const struct zs_depth *depth, int bits, double far_over_near, const struct sim_depths_wall w[2],
                        int swap)
{
    static const struct zs_material paint[2] = {
        { .shader = &zs_shade_raw, .rgb = { 255, 255, 255 }, .cull = ZS_CULL_NONE },
        { .shader = &zs_shade_raw, .rgb = { 255, 0, 0 }, .cull = ZS_CULL_NONE }
    };
    struct zs_instance in[2];
    struct zs_camera camera;
    struct zs_config config;
    struct sim_frame frame;
    int good = 1;
    for (int k = 0; k < 2; k++) {
        const int which = swap ? 1 - k : k;
        in[k] = (struct zs_instance){ .mesh = &w[which].mesh, .material = &paint[which] };
        zs_pose_identity(&in[k].pose);
    }
    const struct zs_scene scene = { .instance = in, .n_instances = 2 };
    (void)zs_camera_perspective(&camera, 8192, H, NEAR, 2 * NEAR);
    camera.z_far = (zs_q48_16)(far_over_near * NEAR * 65536.0);
    sim_frame_config(&config, W, H, ZS_VARYINGS_FLAT);
    config.depth = depth;
    config.depth_bits = (uint8_t)bits;
    config.max_tris = config.max_verts = 64;
    const int err = sim_frame_render(&frame, &scene, &camera, &config, NULL);
    if (err != ZS_OK)
        return err < 0 ? err : -1;
    for (size_t i = 0; i < (size_t)W * H; i++)
        good &= frame.rgb565[i] == 0xffffu;
    sim_frame_free(&frame);
    return good;
}

/* Two walls `gap` apart, in all tilts and both orders. */
static int holds(const struct zs_depth *depth, double far_over_near, double z, double gap)
{
    static const double slope[TILTS][2] = { { 0, 0 },        { 0.05, 0 },       { 0, -0.05 },
                                            { 0.031, 0.017 }, { -0.043, 0.029 }, { 0.011, -0.007 } };
    for (int t = 0; t < TILTS; t++) {
        struct sim_depths_wall w[2];
        sim_depths_wall(&w[0], z, slope[t], 0.0);
        sim_depths_wall(&w[1], z, slope[t], gap);
        for (int swap = 0; swap < 2; swap++) {
            const int good = sim_depths_in_order(depth, 16, far_over_near, w, swap);
            if (good != 1)
                return good;
        }
    }
    return 1;
}

/* The least gap that holds, in parts of z; 0: none below z / 8; < 0: refused. */
static double least_gap(const struct zs_depth *depth, double far_over_near, double z)
{
    double bad = 1e-7, good = 0.1;
    const int whole = holds(depth, far_over_near, z, good * z);
    if (whole != 1)
        return whole < 0 ? -1.0 : 0.0;
    for (int i = 0; i < BISECTIONS; i++) {
        const double mid = sqrt(bad * good);
        if (holds(depth, far_over_near, z, mid * z) == 1)
            good = mid;
        else
            bad = mid;
    }
    return good;
}

static void table(double far_over_near)
{
    printf("\nfar / near = %.0f\n  %-14s", far_over_near, "z / near");
    for (size_t m = 0; m < N_MAPPINGS; m++)
        printf(" %9s", mappings[m].name);
    puts("");
    double worst[N_MAPPINGS] = { 0 };
    for (size_t p = 0; p < sizeof places / sizeof places[0]; p++) {
        if (places[p] > far_over_near * 0.81)
            break;
        printf("  %-14.4g", places[p]);
        for (size_t m = 0; m < N_MAPPINGS; m++) {
            const double gap = least_gap(mappings[m].depth, far_over_near, places[p] * NEAR);
            if (gap > 0)
                printf(" %8.4f%%", 100.0 * gap);
            else
                printf(" %9s", gap < 0 ? "refused" : "> 10 %");
            worst[m] = fmax(worst[m], gap > 0 ? gap : 1.0);
            (void)fflush(stdout);
        }
        puts("");
    }
    printf("  %-14s", "worst");
    for (size_t m = 0; m < N_MAPPINGS; m++)
        if (worst[m] < 1.0)
            printf(" %8.4f%%", 100.0 * worst[m]);
        else
            printf(" %9s", "> 10 %");
    puts("");
}

int sim_depths(int argc, char **argv)
{
    if (argc > 0 && strcmp(argv[0], "--help") == 0) {
        puts("zsim depths\n  The least separation of two walls that is never drawn the wrong way round, in percent of\n"
             "  their distance, for each depth mapping, far / near from 10 to 100,000, and distance.");
        return SIM_OK;
    }
    if (argc > 0)
        return sim_usage("depths: takes no arguments, not '%s'", argv[0]);
    puts("Least separation that is never swapped, in percent of the distance (16-bit keys; walls tilted in 6 ways, "
         "both\n"
         "orders, 96x72). A wall spans up to 11 % of its distance, so that the finest place in it decides.");
    for (size_t r = 0; r < sizeof ratios / sizeof ratios[0]; r++) {
        table(ratios[r]);
        sim_progress("depths", r + 1, sizeof ratios / sizeof ratios[0]);
    }
    sim_progress_end();
    return SIM_OK;
}
