/* Where the camera stands, in double precision and the model's units.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_FRAMING_H
#define SIM_FRAMING_H

#include "model.h"
#include "render_options.h"

struct sim_view {
    int orthographic; /* flag */
    int width, height; /* px */
    double eye[3], at[3];
    double right[3], up[3], back[3]; /* orthonormal, of the camera */
    double near_z, far_z;            /* along the view axis */
    double focal;                    /* perspective: px */
    double span;                     /* orthographic: what the frame's height shows */
    double light[3];                 /* unit, towards the light */
};

/* Take what the user gave and choose the rest so that the model is seen whole:
 *
 *   at        the middle of the model's box
 *   eye       from at along (0.5, 0.35, 1), so far that the sphere around `at` that holds the model
 *             fits the frame both ways with 5 % to spare
 *   near, far just before and behind the sphere around the model, at most 1000 to 1 apart where the
 *             eye is inside it; one that is given pushes the other away
 *   light     over the camera's left shoulder: 0.8 back - 0.5 right + 0.8 up
 *
 * Return SIM_OK; SIM_REFUSED, said why. */
int sim_view_plan(struct sim_view *view, const struct sim_options *o,
                  const struct sim_model *model);

/* An eye that goes around what it looks at: by `yaw` about the upright axis, to the right, and up by `pitch`, radians,
 * not quite to straight above or below; `factor` times as far. up: as of --up, of any length. */
void sim_view_orbit(double eye[3], const struct sim_view *view, const double up[3], double yaw, double pitch,
                    double factor);

/* Could a triangle inside this sphere need clipping? By the near and far planes, and the guard band. center: of the
 * sphere, its radius: the model's units. */
int sim_view_clips(const struct sim_view *view, const double center[3], double radius);

/* Pools that hold what is drawn in one pass. */
struct sim_pools {
    uint64_t tris, verts;
};
/* For a mesh of so many triangles and vertices; clips: some of its triangles may be clipped. */
struct sim_pools sim_pools_of(uint64_t n_tris, uint64_t n_verts, int clips);

/* The mapping that is meant by the options for a view, one by name: never FLOAT or DEFAULT. */
enum sim_depth sim_depth_of(const struct sim_options *o, const struct sim_view *view);

/* The renderer's mappings with depth memory, by enum sim_depth; SIM_DEPTH_DEFAULT is none. */
struct sim_depth_mapping {
    const char *name;
    const struct zs_depth *depth;
    int any_camera; /* flag: orthographic views too */
};
extern const struct sim_depth_mapping sim_depths[SIM_DEPTH_DEFAULT];

#endif
