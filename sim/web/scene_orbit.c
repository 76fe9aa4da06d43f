/* A demo scene seen from another side: its camera goes around the middle of what is there.
 *
 * SPDX-License-Identifier: MIT
 */
#include <math.h>

#include "engine.h"
#include "stage.h"
#include "vec.h"

#define Q30 1073741824.0

/* How far the middle of the instances is along the view, between near and far. */
static double middle(const struct demo_frame *at, const double back[3])
{
    const struct zs_camera *camera = &at->camera;
    const double lo = (double)camera->z_near / 65536.0, hi = (double)camera->z_far / 65536.0;
    double sum = 0.0;
    for (uint32_t i = 0; i < at->scene.n_instances; i++)
        for (int k = 0; k < 3; k++)
            sum -= back[k] * ((double)at->scene.instance[i].pose.pos[k] - (double)camera->pos[k]);
    const double z = at->scene.n_instances > 0 ? sum / at->scene.n_instances : lo;
    return fmin(fmax(z, 2.0 * lo), hi);
}

/* What is z units in front of the camera, toward -back, stays there; its own axes are the rows of rot. */
static void orbit(struct zs_camera *camera, double row[3][3], double z, const struct web_orbit *by)
{
    static const double up[3] = { 0.0, 1.0, 0.0 };
    double eye[3];
    for (int k = 0; k < 3; k++)
        eye[k] = (double)camera->pos[k] - row[2][k] * z;
    for (int i = 0; i < 3; i++)
        sim_turned(row[i], row[i], up, by->yaw);
    sim_turned(row[1], row[1], row[0], -by->pitch);
    sim_turned(row[2], row[2], row[0], -by->pitch);
    for (int k = 0; k < 3; k++)
        camera->pos[k] = (int32_t)lround(eye[k] + row[2][k] * z * by->distance);
    for (int i = 0; i < 9; i++)
        camera->rot[i] = (int32_t)lround(row[i / 3][i % 3] * Q30);
    if (by->distance > 1.0)
        camera->z_far += (int64_t)(z * (by->distance - 1.0) * 65536.0);
    else if (z > 0.0)
        camera->z_near = (int64_t)((double)camera->z_near * by->distance);
}

static int is_home(const struct web_orbit *by)
{
    return by->yaw == 0.0 && by->pitch == 0.0 && by->distance == 1.0;
}

static void rows_of(double row[3][3], const struct zs_camera *camera)
{
    for (int i = 0; i < 9; i++)
        row[i / 3][i % 3] = (double)camera->rot[i] / Q30;
    if (camera->rot[0] == 0 && camera->rot[4] == 0 && camera->rot[8] == 0 && camera->rot[2] == 0)
        row[0][0] = row[1][1] = row[2][2] = 1.0; /* no rotation */
}

void web_scene_orbit(struct demo_frame *at, const struct web_orbit *by)
{
    double row[3][3];
    if (is_home(by))
        return;
    rows_of(row, &at->camera);
    orbit(&at->camera, row, middle(at, row[2]), by);
}

/* Of a showpiece, from where its own camera is placed. */
void stage_orbit(struct zs_camera *camera, int32_t distance)
{
    double row[3][3];
    if (is_home(&web.orbit))
        return;
    rows_of(row, camera);
    orbit(camera, row, (double)distance, &web.orbit);
}
