/* Demo scenes; models are turning.c's.
 *
 * SPDX-License-Identifier: MIT
 */
#include "source.h"

#include <stddef.h>
#include <string.h>

#include "scenes.h"
#include "sim.h"

static const struct demo *demo; /* NULL: a model */
static struct demo_frame frame;
static uint16_t width, height;

int source_open(struct source *s, const struct linux_options *o)
{
    width = (uint16_t)o->size[0];
    height = (uint16_t)o->size[1];
    if (o->model != NULL)
        return turning_open(s, o);
    for (uint32_t i = 0; i < n_demos; i++)
        if (strcmp(demos[i]->name, o->scene) == 0)
            demo = demos[i];
    if (demo == NULL)
        return sim_refuse(NULL, 0, "--scene %s: there is no such scene; --help lists them", o->scene);
    *s = (struct source){ demo->name, &frame.scene, &frame.camera, demo->depth, demo->fast, (uint8_t)demo->varyings };
    return SIM_OK;
}

void source_pose(struct source *s, uint32_t t)
{
    (void)s;
    if (demo != NULL)
        demo->pose(&frame, t, width, height);
    else
        turning_pose(t);
}

void source_close(void)
{
    if (demo == NULL)
        turning_close();
}
