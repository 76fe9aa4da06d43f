/* Shadows: flat ones on a plane, soft discs, and shadow maps.
 *
 *     flat     the thing's mesh, flattened onto a plane along the light: exact edges, any plane,
 * one light; memory for the flattened vertices; its triangles are drawn twice disc     a dark disc
 * below a thing: two triangles map      the distances from the light to what it sees, in memory:
 * shadows of all on all; directional lights
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_SHADOW_H
#define ZS_SHADOW_H

#include "zs_shader.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Flat shadows ------------------------------------------------------------------------- */

/* What is shadowed: a plane. Things that throw shadows are on its front. */
struct zs_shadow_plane {
    zs_q2_30 normal[3]; /* unit, world axes, towards the front */
    int32_t at[3];      /* world units: a point of the plane, |.| <= ZS_WORLD_MAX */
};

/* What throws shadows onto it. */
struct zs_shadow_light {
    zs_q2_30 dir[3]; /* a directional light: unit, world axes, towards the light (zs_light.dir) */
    int32_t pos[3];  /* a point light: world units, |.| <= ZS_WORLD_MAX */
    uint8_t point;   /* 1: a light at pos; 0: one from dir */
};

/* Flatten a thing onto a plane: its shadow, as a mesh in the plane and an instance of it. Call it
 * again when the thing, its vertices, the plane or the light has changed, and then zs_invalidate,
 * as damage tracking does not see the vertices.
 *
 *     err = zs_shadow_flatten(&things[2], &flat, flat_pos, &things[1], &floor, &light);
 *
 * shadow   in: material (zs_shade_shadow or any other) and depth_state, which stay; out: mesh,
 * pose. Draw it after all that it may darken, as the last of the scene. mesh     the flattened
 * mesh, the caller's; all of it is set. It shares the caster's triangles. pos
 * [caster->mesh->n_verts], the caller's, 6 bytes a vertex; kept while shadow is drawn. caster what
 * throws the shadow. Its sphere must hold its vertices. Parts below the plane are flattened too,
 * towards the light: let it stand on the plane or above it. Culling  triangles that face the light
 * face the plane's front as shadows. ZS_CULL_BACK is enough for a closed mesh; ZS_CULL_NONE for
 * others. Exact    a vertex is within half a step of its true place, and so of the plane, in each
 * axis; on a plane along two world axes it is exactly on it. The shadow takes 5,000 to 32,000 steps
 * to each side, more where it is not much longer than the thing. Cost     a few thousand
 * instructions, and 180 for a vertex (point light: 260) on a Cortex-M3. Flash: 1.6 KB. Return
 * ZS_OK; ZS_ERR_NULL; ZS_ERR_VECTOR: the light is behind the plane, in it, or so low that the
 * shadow would be more than 256 times as long as the thing is high; ZS_ERR_RANGE: a pose, plane or
 * light is out of range, the shadow reaches out of the world, or a point light is not clearly above
 * the thing's sphere: by 1/256 of its own height above the plane. With an error, *shadow, *mesh and
 * pos are untouched. */
int zs_shadow_flatten(struct zs_instance *shadow, struct zs_mesh *mesh, int16_t (*pos)[3],
                      const struct zs_instance *caster, const struct zs_shadow_plane *plane,
                      const struct zs_shadow_light *light);

/* Darken what is there. material.rgb is a grey, read from .g: what is left of the light, of 255, in
 * steps of 1/32; 0: black.
 *
 * A pixel is darkened once, however many triangles of the shadow, or of other shadows on the same
 * plane, lie over each other there: a pixel's key is moved by the bias b < 0 for the test, and
 * written moved by 2 b. So a triangle of the same plane, whose key differs by at most |b|, does not
 * pass again. b is depth_state->bias, or -8 buckets without a depth_state. On one plane keys differ
 * by 1 + g / 128 buckets at most, where g is the change of the key from a pixel to the next, to the
 * right and down together. (Triangles thinner than a sub-pixel may be off by more, as their keys
 * are.) For vertices that are not exactly on the plane, add what moves them.
 *
 * depth_state  NULL, or .bias < 0 and all else 0.
 * Shape of it  the written keys hide what is drawn later and is less than 2 b above the plane: draw
 *          shadows last.
 * Cost     9 instructions a pixel over the test of a shader that draws one colour. Flash: 400 B.
 * Refused  ZS_ERR_RANGE: another depth_state; ZS_ERR_DEPTH: zs_depth_none, or a method
 * (zs_method.h), which would darken pixels twice. */
extern const struct zs_shader zs_shade_shadow;

/* ---- Discs -------------------------------------------------------------------------------- */

/* A square in its x-z plane whose front is +y, 256 steps wide. For a disc of a radius in world
 * units: pose.scale = radius * 512. pose.pos: on the ground below the thing; for other grounds than
 * level ones, turn it by pose.rot. */
extern const struct zs_mesh zs_shadow_disc;

/* A disc on that mesh, darkest in the middle: 1 - d * (1 - r^2)^2 of the light is left at r of the
 * radius, where material.rgb.g / 255 is 1 - d. Needs config.varyings of 2. Discs that overlap
 * darken each other's pixels again. Draw it after the ground, with .read_only = 1 and a .bias of
 * some buckets below 0. Cost     120 instructions a pixel on a Cortex-M3. Flash: 300 bytes and the
 * fragment stage. */
extern const struct zs_shader zs_shade_disc;
#define ZS_VARYINGS_DISC 2u

#ifdef __cplusplus
}
#endif

#endif
