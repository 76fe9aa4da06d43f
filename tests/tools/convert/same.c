/* A program on a board: a converted model, NAME m, in front of a camera. Is its frame the one of zsim render?
 *
 *     same views PLACE      the cameras of all views as options of zsim render, a line each
 *     same draw             of each view the checksum of its frame: FNV-1a of the RGB565 values, high byte first; and
 *                           how many triangles were found one by one to turn away, which clusters leave few of
 *
 * PLACE: five numbers, as of probe.c.
 *
 * SPDX-License-Identifier: MIT
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "m.h"
#include "zs_fast.h"
#include "zs_method.h"

#define W 200
#define H 160
#define ROWS 20
#define TRIS 20000
#define VERTS 30000

/* In radii from the middle, rounded to whole world units; the last one is close: it cuts. */
enum { VIEWS = 3 };
static const struct {
    double eye[3], z_near, z_far;
    int32_t light[3];
} views[VIEWS] = { { { 1.2, 0.9, 2.4 }, 1.0, 4.5, { 2, 3, 6 } },
               { { -2.0, -1.5, 0.7 }, 0.5, 4.0, { -6, -2, 3 } },
               { { 0.5, 0.6, -0.9 }, 0.1, 3.0, { 1, 0, 0 } } };
static const int32_t middle[3] = M_MIDDLE;
static uint32_t sum;

static int32_t whole(double radii)
{
    return (int32_t)lrint(radii * M_RADIUS);
}

static int take(void *ctx, const struct zs_strip *s)
{
    (void)ctx;
    for (uint32_t i = 0; i < 2u * s->w * s->h; i++)
        sum = (sum ^ s->px[i]) * 16777619u;
    return 0;
}

static void draw(int n)
{
    static const struct zs_fast *const fast[] = { ZS_FAST_ALL, ZS_FAST_END };
    static const struct zs_config config = { .width = W,
                                             .height = H,
                                             .strip_h = ROWS,
                                             .max_tris = TRIS,
                                             .max_verts = VERTS,
                                             .varyings = M_VARYINGS,
                                             .buffers = 1,
                                             .subpixel_bits = 8,
                                             .depth_bits = 16,
#ifdef M_METHOD
                                             .method = M_METHOD,
#endif
                                             .depth = &zs_depth_float,
                                             .fast = fast };
    static struct zs_renderer renderer;
    static uint32_t arena[16000000 / 4];
    static const int32_t up[3] = { 0, 1, 0 };
    struct zs_scene scene = { .instance = m_instance,
                              .n_instances = M_INSTANCES,
                              .light = { .ambient = ZS_Q16_ONE / 4, .diffuse = ZS_Q16_ONE * 3 / 4 },
                              .background = zs_rgb565(10, 20, 60) };
    const struct zs_sink sink = { .submit = take };
    struct zs_camera camera = { .projection = ZS_PERSPECTIVE };
    int32_t eye[3];
    double length = 0.0;
    sum = 2166136261u;
    for (int k = 0; k < 3; k++) {
        eye[k] = middle[k] + whole(views[n].eye[k]);
        length += (double)views[n].light[k] * views[n].light[k];
    }
    for (int k = 0; k < 3; k++)
        scene.light.dir[k] = (zs_q2_30)lrint(views[n].light[k] / sqrt(length) * 1073741824.0);
#ifdef M_LITS
    memcpy(m_lamp[0].dir, scene.light.dir, sizeof m_lamp[0].dir);
#endif
    camera.focal = (zs_uq32_32)H / 2 << 32; /* 90 degrees */
    camera.z_near = (zs_q48_16)whole(views[n].z_near) * 65536;
    camera.z_far = (zs_q48_16)whole(views[n].z_far) * 65536;
    int err = zs_camera_look_at(&camera, eye, middle, up);
    err = err ? err : zs_init(&renderer, &config, arena, sizeof arena);
    err = err ? err : zs_render(&renderer, &scene, &camera, &sink);
    if (err) {
        printf("%s\n", zs_error_string(err));
        exit(1);
    }
    printf("%08x %u\n", (unsigned)sum, (unsigned)renderer.stats.tris_facing);
}

static void view(int n, char **place)
{
    const double unit = strtod(place[4], NULL);
    printf("--size %dx%d --fov 90 --background 0a143c --light %d,%d,%d", W, H,
           (int)views[n].light[0], (int)views[n].light[1], (int)views[n].light[2]);
    printf(" --near %.17g --far %.17g", whole(views[n].z_near) / unit,
           whole(views[n].z_far) / unit);
    for (int at = 0; at < 2; at++) {
        printf(at ? " --at " : " --eye ");
        for (int k = 0; k < 3; k++)
            printf("%s%.17g", k ? "," : "",
                   strtod(place[k], NULL) + (middle[k] + (at ? 0 : whole(views[n].eye[k]))) / unit);
    }
    printf("\n");
}

int main(int argc, char **argv)
{
    const char *what = argc > 1 ? argv[1] : "";
    const int views_asked = argc == 7 && strcmp(what, "views") == 0;
    if (!views_asked && (argc != 2 || strcmp(what, "draw") != 0))
        return 2;
    for (int n = 0; n < VIEWS; n++) {
        if (views_asked)
            view(n, argv + 2);
        else
            draw(n);
    }
    return 0;
}
