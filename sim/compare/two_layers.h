/* Two squares that face the camera and more than fill the frame, one behind the other: do their keys tell them apart?
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_TWO_LAYERS_H
#define SIM_TWO_LAYERS_H

#include <string.h>

#include "zs_shader.h"
#include "zstrip.h"

#define TWO_LAYERS_Z (1 << 26) /* world units, where they are made for: a bucket is a thousand of them or more */

struct two_layers {
    struct zs_mesh mesh;
    struct zs_material material[2];
    struct zs_instance in[2]; /* the farther one, red, first: it wins ties; the nearer one is green */
    struct zs_scene scene;
};

/* Place them at distances ahead of a camera at the origin, world units. It points into itself: do not move it. */
static inline void two_layers_set(struct two_layers *l, int32_t z_near, int32_t z_far)
{
    static const int16_t pos[4][3] = {
        { -32000, -32000, 0 }, { 32000, -32000, 0 }, { 32000, 32000, 0 }, { -32000, 32000, 0 }
    };
    static const uint16_t tri[2][3] = { { 0, 1, 2 }, { 0, 2, 3 } };
    memset(l, 0, sizeof *l);
    l->mesh.pos = pos;
    l->mesh.tri = tri;
    l->mesh.n_verts = 4;
    l->mesh.n_tris = 2;
    l->mesh.radius = 46000;
    l->mesh.scale = (zs_uq16_16)((TWO_LAYERS_Z / 32000) << 16);
    for (int k = 0; k < 2; k++) {
        l->material[k].shader = &zs_shade_raw;
        l->material[k].rgb.g = k ? 255 : 0;
        l->material[k].rgb.r = k ? 0 : 255;
        l->in[k].mesh = &l->mesh;
        l->in[k].material = &l->material[k];
        zs_pose_identity(&l->in[k].pose);
        l->in[k].pose.pos[2] = k ? -z_near : -z_far;
    }
    l->scene.instance = l->in;
    l->scene.n_instances = 2;
}

#endif
