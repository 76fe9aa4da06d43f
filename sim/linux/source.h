/* Where frames come from: a demo scene, or a model that turns.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_SOURCE_H
#define SIM_SOURCE_H

#include "linux_options.h"
#include "zstrip.h"

struct source {
    const char *name;
    const struct zs_scene *scene;   /* of the frame that was posed last */
    const struct zs_camera *camera;
    const struct zs_depth *depth;
    const struct zs_fast *const *fast; /* accelerators; NULL: none */
    uint8_t attrs;                  /* as in struct zs_config */
};

/* For pictures of o->size. There is one source in a program. SIM_OK; SIM_REFUSED, said why. */
int source_open(struct source *s, const struct linux_options *o);
void source_pose(struct source *s, uint32_t t);
void source_close(void);

/* turning.c: the same of a model. */
int turning_open(struct source *s, const struct linux_options *o);
void turning_pose(uint32_t t);
void turning_close(void);

#endif
