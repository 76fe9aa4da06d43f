/* A model that turns about the upright axis through its middle, once in 256 frames. Frame 0 is what `zsim render`
 * draws. Built with -DLINUX_MODELS=0 (for tests/boards/linux.sh) there are no models: assimp need not be linked then.
 *
 * SPDX-License-Identifier: MIT
 */
#include "source.h"

#include "sim.h"

#ifndef LINUX_MODELS
#define LINUX_MODELS 1
#endif

#if LINUX_MODELS

#include <math.h>

#include "model.h"
#include "render_options.h"
#include "scene_parts.h"
#include "framing.h"
#include "zs_fast.h"

static struct sim_model model;
static struct sim_scene scene;

int turning_open(struct source *s, const struct linux_options *o)
{
    static const struct zs_fast *const fast[] = { ZS_FAST_ALL, ZS_FAST_END };
    struct sim_options as;
    struct sim_view view;
    sim_options_defaults(&as);
    as.model = o->model;
    as.opaque = 1; /* the depth buffer alone sorts it */
    as.size[0] = o->size[0];
    as.size[1] = o->size[1];
    int status = sim_scene_load(&model, &as);
    if (status == SIM_OK)
        status = sim_view_plan(&view, &as, &model);
    if (status == SIM_OK)
        status = sim_scene_build(&scene, &model, &view, &as);
    *s = (struct source){ o->model,      &scene.scene,
                          &scene.camera, &zs_depth_float,
                          fast,          status == SIM_OK ? sim_scene_varyings(&scene.scene) : 0 };
    return status;
}

/* Meshes lie about the world's middle, the model's elsewhere: pos brings that back to where it was. */
void turning_pose(uint32_t t)
{
    struct zs_pose pose;
    double middle[3];
    zs_pose_identity(&pose);
    zs_pose_turn(&pose, (zs_turn)(t * 256u), 0, 0);
    for (int k = 0; k < 3; k++)
        middle[k] = (model.center[k] - scene.origin[k]) / scene.unit;
    for (int k = 0; k < 3; k++) {
        double to = middle[k];
        for (int j = 0; j < 3; j++)
            to -= (double)pose.rot[3 * k + j] / ZS_Q30_ONE * middle[j];
        pose.pos[k] = (int32_t)lrint(to);
    }
    for (uint32_t i = 0; i < scene.n_parts; i++)
        scene.instance[i].pose = pose;
}

void turning_close(void)
{
    sim_scene_free(&scene);
    sim_model_free(&model);
}

#else

int turning_open(struct source *s, const struct linux_options *o)
{
    (void)s;
    return sim_refuse(o->model, 0, "--model: this program was built without models; name a --scene, or build it with "
                      "make linux");
}

void turning_pose(uint32_t t)
{
    (void)t;
}

void turning_close(void)
{
}

#endif
