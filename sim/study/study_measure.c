/* Frames against the reference, for studies.
 *
 * SPDX-License-Identifier: MIT
 */
#include "study_measure.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "frame.h"
#include "frame_inside.h"
#include "image.h"
#include "error_bound.h"
#include "sim.h"
#include "texel_numbers.h"
#include "reference_frame.h"

const struct study_mapping study_mapping[STUDY_MAPPINGS] = {
    { "recip", &zs_depth_recip, "#d62728" }, { "linear", &zs_depth_linear, "#8c8c8c" },
    { "e3m13", &zs_depth_e3m13, "#1f77b4" }, { "e4m12", &zs_depth_e4m12, "#2ca02c" },
    { "e5m11", &zs_depth_e5m11, "#9467bd" }, { "float", &zs_depth_float, "#000000" },
};

static int exponent_bits(int mapping, double near_z, double far_z)
{
    if (mapping != 5)
        return mapping + 1; /* e3, e4, e5 */
    return far_z <= 128 * near_z ? 3 : far_z <= 32768 * near_z ? 4 : 5;
}

/* The octave of near / z that z lies in, the last one going on for ever. */
static int octave(int e, double near_z, double z)
{
    const int k = (int)floor(log2(z / near_z)), last = (1 << e) - 2;
    return k > last ? last : k;
}

double study_bucket(int mapping, int bits, double near_z, double far_z, double z)
{
    const double steps = ldexp(1, bits) - 1;
    if (mapping == 0)
        return z * z * (far_z - near_z) / (far_z * near_z * steps);
    if (mapping == 1)
        return (far_z - near_z) / steps;
    const int e = exponent_bits(mapping, near_z, far_z);
    return z * z / near_z * ldexp(1, -(octave(e, near_z, z) + 1 + bits - e));
}

double study_key(int mapping, int bits, double near_z, double far_z, double z)
{
    const double steps = ldexp(1, bits) - 1;
    if (mapping == 0)
        return steps * (1 / near_z - 1 / z) / (1 / near_z - 1 / far_z);
    if (mapping == 1)
        return steps * (z - near_z) / (far_z - near_z);
    const int e = exponent_bits(mapping, near_z, far_z), k = octave(e, near_z, z), m = bits - e;
    return ldexp(1, bits) - (ldexp((1 << e) - 2 - k, m) + near_z / z * ldexp(1, k + 1 + m));
}

uint64_t study_checksum(const uint16_t *rgb565, size_t n)
{
    uint64_t h = 0xcbf29ce484222325u;
    for (size_t i = 0; i < n; i++) {
        h = (h ^ rgb565[i] >> 8) * 0x100000001b3u;
        h = (h ^ (rgb565[i] & 255u)) * 0x100000001b3u;
    }
    return h;
}

const char *study_error_name(int err)
{
    static const char *const name[] = { "OK",
                                        "ZS_ERR_NULL",
                                        "ZS_ERR_SIZE",
                                        "ZS_ERR_ARENA",
                                        "ZS_ERR_DEPTH",
                                        "ZS_ERR_CAMERA",
                                        "ZS_ERR_RANGE",
                                        "ZS_ERR_MESH",
                                        "ZS_ERR_SEQUENCE",
                                        "ZS_ERR_VARYINGS",
                                        "ZS_ERR_VECTOR",
                                        "ZS_ERR_NEAR",
                                        "ZS_ERR_TEXTURE",
                                        "ZS_ERR_BUILD",
                                        "ZS_ERR_PASS" };
    return err <= 0 && err > -(int)(sizeof name / sizeof name[0]) ? name[-err] : "broken";
}

/* ---- A frame and its truth --------------------------------------------------------------------------------------- */

static void judge_pixels(struct study_frame *f, const struct sim_reference_frame *t, const struct ref_image *ours,
                         const struct zs_config *config)
{
    const struct sim_judge *judge = &t->judge;
    const double top = ldexp(1, config->depth_bits) - 2;
    for (int y = 0; y < config->height; y++)
        for (int x = 0; x < config->width; x++) {
            const size_t at = (size_t)y * config->width + (size_t)x;
            const uint32_t a = ours->id[at], b = t->image.id[at];
            if (a != b) {
                f->wrong[at] = a && b && !sim_judge_same_plane(&t->tri[a - 1], &t->tri[b - 1]);
                f->surface += f->wrong[at];
                f->unexplained += sim_judge_pixel(judge, a, b, x, y) == SIM_WRONG;
            } else if (a && ours->key) {
                double off = fabs(ours->key[at] - fmin(fmax(t->image.exact_key[at], 0), top));
                if (off > 0.5)
                    off -= sim_judge_key_slack(judge, a, x, y);
                f->key_beyond = fmax(f->key_beyond, off);
            }
        }
}

int study_frame_open(struct study_frame *f, const struct zs_scene *scene, const struct zs_camera *camera,
                     const struct zs_config *config)
{
    const size_t n = (size_t)config->width * config->height;
    struct sim_frame frame;
    struct sim_reference_frame truth;
    int textured = 0;
    memset(f, 0, sizeof *f);
    int err = sim_frame_render(&frame, scene, camera, config, NULL);
    if (err != ZS_OK)
        return err;
    for (uint32_t k = 0; k < scene->n_instances; k++)
        textured |= scene->instance[k].material->texture != NULL;
    struct ref_image ours = { .rgb565 = frame.rgb565, .key = frame.key, .id = sim_alloc(n, sizeof(uint32_t)) };
    ours.texel = textured ? sim_alloc(n, sizeof(uint32_t)) : NULL;
    f->stats = frame.stats;
    f->arena_bytes = frame.arena_bytes;
    f->checksum = study_checksum(frame.rgb565, n);
    f->wrong = sim_alloc(n, 1);
    if (sim_frame_no_keys(config))
        ours.key = NULL;
    err = sim_frame_ids(ours.id, scene, camera, config);
    if (!err && textured)
        err = sim_frame_texels(ours.texel, scene, camera, config);
    if (!err) {
        err = sim_reference_frame_draw(&truth, scene, camera, config);
        if (!err)
            err =
                ref_compare(&ours, &truth.image, &truth.depth, &truth.camera, config->width, config->height, &f->diff);
        if (!err)
            judge_pixels(f, &truth, &ours, config);
        err = err ? SIM_FRAME_BROKEN + err : 0;
        sim_reference_frame_free(&truth);
    }
    free(ours.id);
    free(ours.texel);
    f->rgb565 = frame.rgb565;
    frame.rgb565 = NULL;
    sim_frame_free(&frame);
    if (err)
        study_frame_free(f);
    return err;
}

void study_frame_free(struct study_frame *f)
{
    free(f->rgb565);
    free(f->wrong);
    f->rgb565 = NULL;
    f->wrong = NULL;
}

void study_sheet_put(uint8_t *rgb, unsigned sheet_width, unsigned x0, unsigned y0, const uint16_t *rgb565,
                     const uint8_t *wrong, unsigned width, unsigned height)
{
    for (unsigned y = 0; y < height; y++)
        for (unsigned x = 0; x < width; x++) {
            uint8_t *to = rgb + ((size_t)(y0 + y) * sheet_width + x0 + x) * 3u;
            const size_t at = (size_t)y * width + x;
            sim_rgb565_expand(to, rgb565[at]);
            if (wrong && wrong[at]) {
                to[0] = to[2] = 255;
                to[1] = 0;
            }
        }
}
