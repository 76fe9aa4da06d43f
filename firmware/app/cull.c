/* What culling saves. Instructions of zs_render, one line of CSV a frame: scene, variant, instructions, the instances,
 * clusters and vertices that were looked at.
 *
 *   crowd   CROWD x CROWD cubes on a plane, of which SEEN are in view: those alone; all
 *   model   model_instance[], from afar, close by, and from within; with zs_fast_clusters and without
 *
 * SPDX-License-Identifier: MIT
 */
#include "hal.h"
#include "model.h" /* made by zsim convert --name model */
#include "report.h"
#include "zs_fast.h"

#define CROWD 100
#define SEEN 20
#define APART 3000 /* world units */
#define W 320
#define H 240
#define VERTS 20000

ZS_ARENA(arena, ZS_ARENA_BYTES(W, H, 24, VERTS, VERTS, MODEL_VARYINGS, 1));
static struct zs_renderer renderer;
static struct zs_instance crowd[CROWD * CROWD], alone[SEEN];

static const int16_t corner[8][3] = { { -9, -9, -9 }, { 9, -9, -9 }, { 9, 9, -9 }, { -9, 9, -9 },
                                      { -9, -9, 9 },  { 9, -9, 9 },  { 9, 9, 9 },  { -9, 9, 9 } };
static const uint16_t face[12][3] = { { 4, 5, 6 }, { 4, 6, 7 }, { 1, 0, 3 }, { 1, 3, 2 }, { 5, 1, 2 }, { 5, 2, 6 },
                                      { 0, 4, 7 }, { 0, 7, 3 }, { 7, 6, 2 }, { 7, 2, 3 }, { 0, 1, 5 }, { 0, 5, 4 } };
static const struct zs_mesh cube = { .pos = corner, .tri = face, .n_verts = 8, .n_tris = 12,
                                     .scale = 100 * ZS_Q16_ONE, .radius = 16 };
static const struct zs_fast *const fast[] = { ZS_FAST_FRAME, ZS_FAST_CLUSTERS, ZS_FAST_FLAT, ZS_FAST_SMOOTH,
                                              ZS_FAST_END };
static const struct zs_fast *const plain[] = { ZS_FAST_FRAME, ZS_FAST_FLAT, ZS_FAST_SMOOTH, ZS_FAST_END };
static const struct zs_material red = { .shader = &zs_shade_flat, .rgb = { 230, 60, 40 } };

/* Draw and print. The frame must be the one that *sum is of, unless that is 0. Return instructions; 0: it went
 * wrong. */
static uint64_t measure(const char *scene_name, const char *variant, const struct zs_scene *scene,
                        const struct zs_camera *camera, const struct zs_fast *const *list, uint64_t *sum)
{
    const struct zs_config config = { .width = W, .height = H, .strip_h = 24, .max_tris = VERTS, .max_verts = VERTS,
                                      .varyings = MODEL_VARYINGS, .buffers = 1, .subpixel_bits = 8, .depth_bits = 16,
                                      .depth = &zs_depth_float, .fast = list };
    uint64_t now = REPORT_HASH;
    const struct zs_sink sink = { .submit = report_drop }, summing = { .submit = report_hash, .ctx = &now };
    int err = zs_init(&renderer, &config, arena, sizeof arena);
    err = err ? err : zs_render(&renderer, scene, camera, &summing);
    const uint64_t start = hal_ticks();
    err = err ? err : zs_render(&renderer, scene, camera, &sink);
    const uint64_t took = (hal_ticks() - start) * hal_tick_instructions();
    const struct zs_stats *s = zs_frame_stats(&renderer);
    hal_write(scene_name);
    hal_write(",");
    hal_write(variant);
    report_field(took);
    report_field(s->instances_in);
    report_field(s->instances_in - s->instances_culled);
    report_field(s->clusters_in);
    report_field(s->clusters_culled);
    report_field(s->verts_transformed);
    report_field(s->tris_drawn);
    hal_write(err ? "\n# FAILED: " : "\n");
    if (err)
        hal_write(zs_error_string(err));
    if (*sum && now != *sum) {
        err = 1;
        hal_write("# FAILED, the line above: another picture\n");
    }
    *sum = now;
    return err ? 0 : took;
}

/* Along a curve that keeps near what is near: bits of x and z take turns. */
static void crowd_place(void)
{
    uint32_t n = 0;
    for (uint32_t m = 0; m < 1u << 14; m++) {
        uint32_t x = 0, z = 0;
        for (uint32_t k = 0; k < 7u; k++) {
            x |= (m >> 2u * k & 1u) << k;
            z |= (m >> (2u * k + 1u) & 1u) << k;
        }
        if (x >= CROWD || z >= CROWD)
            continue;
        struct zs_instance *in = &crowd[n++];
        in->mesh = &cube;
        in->material = &red;
        zs_pose_identity(&in->pose);
        zs_pose_turn(&in->pose, (zs_turn)(m * 977u), 0, 0);
        in->pose.pos[0] = (int32_t)x * APART;
        in->pose.pos[2] = (int32_t)z * APART;
    }
}

/* Bring those in view together. Return how many. */
static uint32_t crowd_pick(const struct zs_scene *all, const struct zs_camera *camera)
{
    uint32_t n = 0;
    const struct zs_config config = { .width = W, .height = H, .strip_h = 24, .max_tris = VERTS, .max_verts = VERTS,
                                      .varyings = MODEL_VARYINGS, .buffers = 1, .subpixel_bits = 8, .depth_bits = 16,
                                      .depth = &zs_depth_float, .fast = fast };
    if (zs_init(&renderer, &config, arena, sizeof arena))
        return 0;
    for (uint32_t i = 0; i < all->n_instances; i++) {
        struct zs_scene one = *all;
        one.instance = &crowd[i];
        one.n_instances = 1;
        struct zs_strip strip; /* the first walks the scene */
        if (zs_frame_begin(&renderer, &one, camera) || zs_frame_strip(&renderer, &strip) != 1)
            return 0;
        if (zs_frame_stats(&renderer)->instances_culled)
            continue;
        if (n < SEEN)
            alone[n] = crowd[i];
        n++;
    }
    return n;
}

static int crowd_measure(void)
{
    static const int32_t eye[3] = { 51 * APART, 3 * APART, 57 * APART }, at[3] = { 50 * APART, 0, 50 * APART };
    static const int32_t up[3] = { 0, 1, 0 };
    struct zs_scene all = { .instance = crowd, .n_instances = CROWD * CROWD,
                            .light = { .dir = { 0, 0, ZS_Q30_ONE }, .ambient = ZS_Q16_ONE / 4,
                                       .diffuse = ZS_Q16_ONE / 2 } };
    struct zs_camera camera;
    uint64_t sum = 0;
    crowd_place();
    int err = zs_camera_perspective(&camera, 8192, H, 2000, 17000);
    err = err ? err : zs_camera_look_at(&camera, eye, at, up);
    const uint32_t seen = crowd_pick(&all, &camera);
    if (err || seen != SEEN) {
        hal_write("# FAILED: in view are");
        report_field(seen);
        hal_write("\n");
        return 1;
    }
    struct zs_scene few = all;
    few.instance = alone;
    few.n_instances = SEEN;
    const uint64_t least = measure("crowd", "those alone", &few, &camera, fast, &sum);
    const uint64_t took = measure("crowd", "all", &all, &camera, fast, &sum);
    return !least || !took;
}

static int model_measure(void)
{
    static const struct {
        const char *name;
        int32_t distance, middle[3]; /* quarters of the model's radius: from a point beside its middle */
        int16_t pitch;
    } view[] = { { "model from afar", 12, { 0, 0, 0 }, 3500 }, { "model close by", 2, { 3, 0, 0 }, 3500 },
                 { "model from within", 0, { 3, 0, 0 }, 0 } };
    static const struct {
        const char *name;
        const struct zs_fast *const *fast;
    } variant[] = { { "clusters", fast }, { "no clusters", plain } };
    static const int32_t middle[3] = MODEL_MIDDLE;
    const struct zs_scene scene = { .instance = model_instance, .n_instances = MODEL_INSTANCES,
                                    .light = { .dir = { 0, 0, ZS_Q30_ONE }, .ambient = ZS_Q16_ONE / 4,
                                               .diffuse = ZS_Q16_ONE / 2 } };
    for (uint32_t v = 0; v < sizeof view / sizeof view[0]; v++) {
        struct zs_camera camera;
        uint64_t sum = 0;
        int32_t at[3];
        for (int k = 0; k < 3; k++)
            at[k] = middle[k] + view[v].middle[k] * (MODEL_RADIUS / 4);
        int err = zs_camera_perspective(&camera, 8192, H, MODEL_RADIUS / 100 + 1, 5 * MODEL_RADIUS);
        err = err ? err : zs_camera_orbit(&camera, at, view[v].distance * (MODEL_RADIUS / 4) + 1, 3000, view[v].pitch);
        for (uint32_t k = 0; k < sizeof variant / sizeof variant[0] && !err; k++)
            err = measure(view[v].name, variant[k].name, &scene, &camera, variant[k].fast, &sum) == 0;
        if (err)
            return 1;
    }
    return 0;
}

int main(void)
{
    if (hal_init())
        hal_exit(1);
    hal_write("scene,variant,instructions,instances,in view,clusters,left out,vertices,triangles drawn\n");
    const int failed = crowd_measure() | model_measure();
    hal_exit(failed != 0);
}
