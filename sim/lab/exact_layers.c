/* Two layers, one behind the other by a share of a bucket: see exact_cases.h.
 *
 * SPDX-License-Identifier: MIT
 */
#include "exact_cases.h"

#include <math.h>
#include <string.h>

#include "frame.h"
#include "prng_log.h"
#include "reference.h"
#include "scene_reference.h"
#include "sim.h"
#include "two_layers.h"

#define LAYER_W 32
#define LAYER_H 24

struct layers {
    struct two_layers of;
    struct zs_camera camera;
    struct zs_config config;
};

static void layers_open(struct layers *l, struct prng *r, const struct zs_depth *mapping)
{
    memset(l, 0, sizeof *l);
    sim_frame_config(&l->config, LAYER_W, LAYER_H, ZS_VARYINGS_FLAT);
    l->config.max_tris = 16;
    l->config.max_verts = 40;
    l->config.depth = mapping;
    l->config.depth_bits = (uint8_t)(prng_pick(r, 2) ? 16 : prng_range(r, 8, 16));
    (void)zs_camera_perspective(&l->camera, 8192, LAYER_H, 1, 2);
    l->camera.focal = (zs_uq32_32)LAYER_W << 32;
}

/* Place the layers so many buckets apart. Return 0 where the keys there are saturated. */
static int layers_place(struct layers *l, struct prng *r, double buckets)
{
    const struct ref_depth depth = { sim_reference_mapping(l->config.depth, &l->camera),
                                     l->config.depth_bits };
    const double ratio = prng_real_log(r, 10, 1e5);
    const int32_t z = TWO_LAYERS_Z + (int32_t)prng_pick(r, 1 << 20);
    const double near = floor(fmax(64, z / prng_real_log(r, 1, ratio)));
    struct ref_camera camera;
    l->camera.z_near = (zs_q48_16)near * 65536;
    l->camera.z_far = (zs_q48_16)(near * ratio * 1.001) * 65536;
    sim_reference_camera(&camera, &l->camera);
    const double key = ref_exact_key(&depth, &camera, z);
    if (key < buckets + 0.1 || key > ldexp(1, l->config.depth_bits) - 2.6)
        return 0;
    int32_t lo = 0, hi = (int32_t)(z - near); /* the least gap that is enough */
    while (hi - lo > 1) {
        const int32_t mid = lo + (hi - lo) / 2;
        if (key - ref_exact_key(&depth, &camera, z - mid) >= buckets)
            hi = mid;
        else
            lo = mid;
    }
    two_layers_set(&l->of, z - hi, z);
    return 1;
}

static int layers_draw(struct sim_exact_layers *out, struct layers *l)
{
    struct sim_frame f[3]; /* each alone, then both */
    int err = ZS_OK;
    memset(f, 0, sizeof f);
    for (uint32_t k = 0; k < 3 && !err; k++) {
        l->of.scene.instance = &l->of.in[k % 2 ? 1 : 0];
        l->of.scene.n_instances = k < 2 ? 1 : 2;
        err = sim_frame_render(&f[k], &l->of.scene, &l->camera, &l->config, NULL);
    }
    for (int i = 0; i < LAYER_W * LAYER_H && !err; i++) {
        const int right = f[2].rgb565[i] == zs_rgb565(0, 255, 0);
        out->pixels++;
        out->swapped += !right;
        out->unequal += !right && f[0].key[i] != f[1].key[i];
    }
    for (int k = 0; k < 3; k++)
        sim_frame_free(&f[k]);
    return err ? sim_exact_refuse(err) : SIM_OK;
}

int sim_exact_layers(struct sim_exact_layers *out, uint64_t seed, uint32_t n, double buckets)
{
    int status = SIM_OK;
    memset(out, 0, sizeof *out);
    for (uint32_t k = 0; k < n && status == SIM_OK; k++) {
        struct prng r = { seed + k };
        struct layers l;
        layers_open(&l, &r, sim_exact_depth[k % (SIM_EXACT_MAPPINGS - 1)]);
        if (layers_place(&l, &r, buckets))
            status = layers_draw(out, &l);
        sim_progress("layers", k, n);
    }
    sim_progress_end();
    return status;
}
