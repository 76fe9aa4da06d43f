/* Shadows: flat ones on a plane, soft discs, and shadow maps.
 *
 *     flat  the thing's mesh, flattened onto a plane along the light. Exact edges, one plane, one
 *           light; memory for the flattened vertices
 *     disc  a dark disc below a thing: two triangles
 *     map   what a light sees, as keys in memory: shadows of all on all
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_SHADOW_H
#define ZS_SHADOW_H

#include "zs_lights.h"
#include "zs_shader.h"

ZS_C_BEGIN

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
 *     err = zs_shadow_flatten(&things[2], &flat, flat_pos, &things[1], &ground, &light);
 *
 * shadow   in: material (of zs_shade_shadow or any other) and depth_state, which stay; out: mesh
 *          and pose. Draw it after all that it may darken: as the last of the scene.
 * mesh     the flattened mesh, the caller's; all of it is set. It shares the caster's triangles.
 * pos      [caster->mesh->n_verts], the caller's, 6 bytes a vertex; kept while shadow is drawn.
 * caster   what throws the shadow. Its sphere must hold its vertices. Parts below the plane are
 *          flattened too, towards the light: let it stand on the plane or above it.
 * Culling  a triangle that faces the light faces the plane's front when it is flat. ZS_CULL_BACK
 *          is enough for a closed mesh; take ZS_CULL_NONE for others.
 * Exact    a vertex is within half a step (0.52) of its true place in each axis, and the shadow's
 *          stretch (1 below the light, at most 256) times 2^-16 world unit; on a plane along two
 *          world axes it is exactly on the plane. The shadow as a whole is up to 2^-22 of the
 *          thing's height above the plane aside, too: a step at 100 of its radii or so. The
 *          longest side of the bound of a shadow takes 16,350 to 32,700 steps to each side, and a
 *          shadow a fifth to all of its bound.
 * Cost     7,000 instructions, and 330 for a vertex (a point light: 10,000 and 520) on a Cortex-M3.
 *          Flash: 2.4 KB.
 * Return   ZS_OK; ZS_ERR_NULL; ZS_ERR_VECTOR: the light is behind the plane, in it, or so low that
 *          the shadow would be more than 256 times as long as the thing is high; ZS_ERR_RANGE: a
 *          pose, plane or light is out of range, the shadow reaches out of the world, or a point
 *          light is not above the thing's sphere by 1/256 of its own height above the plane. With
 *          an error, *shadow, *mesh and pos are untouched. */
int zs_shadow_flatten(struct zs_instance *shadow, struct zs_mesh *mesh, int16_t (*pos)[3],
                      const struct zs_instance *caster, const struct zs_shadow_plane *plane,
                      const struct zs_shadow_light *light);

/* Darken what is there. material.rgb is a grey, read from .g: what is left of the light, of 255, in
 * steps of 1/32; 0: black.
 *
 * Where    on what is drawn already and lies in the plane: where the key that is there is less than
 *          |b| before the shadow's, or at most |b| behind it. b is depth_state->bias, or -8 buckets
 *          without a depth_state. Things on the plane hide the shadow, and it ends where the ground
 *          ends. On one plane keys differ by 2 buckets and 1/128 of the key's change from pixel to
 *          pixel; triangles thinner than 1/256 px may be off by more, as their keys are.
 *          Where vertices are not exactly on the plane, add what that moves their keys.
 * Once     a pixel is darkened once, however many triangles of the shadow, or of other shadows on
 *          the same plane, lie over each other there: its key is written moved by 2 b, so that the
 *          next triangle does not find the plane there. What is drawn later, and is less than 2 |b|
 *          above the plane, is hidden there.
 * Cost     20 instructions a pixel more than zs_shade_raw with a depth_state. Flash: 500 bytes.
 * Refused  ZS_ERR_RANGE: a depth_state that is not a .bias < 0 and all else 0; ZS_ERR_DEPTH:
 *          zs_depth_none, or a method, which would darken pixels twice, but for
 *          zs_method_transparent. */
extern const struct zs_shader zs_shade_shadow;

/* ---- Discs -------------------------------------------------------------------------------- */

/* A square in its x-z plane whose front is +y, 256 steps wide. For a disc of a radius in world
 * units: pose.scale = radius * 512; pose.pos: on the ground below the thing. Turn it by pose.rot
 * for ground that is not level. */
extern const struct zs_mesh zs_shadow_disc;

/* A disc on that mesh, darkest in the middle: 1 - d (1 - r^2)^2 of the light is left at r of the
 * radius, where material.rgb.g / 255 is 1 - d. Discs that overlap darken a pixel twice. Draw it
 * after the ground, with a depth_state of .read_only = 1 and a .bias of some buckets below 0.
 *
 * Cost     170 instructions a pixel on a Cortex-M3. Flash: 300 bytes, and the fragment stage. */
extern const struct zs_shader zs_shade_disc;
#define ZS_VARYINGS_DISC 2u

/* ---- Shadow maps -------------------------------------------------------------------------- */

/* The keys of a light's view. A point is in shadow if its key is greater than the map's there: if
 * the light sees something else first.
 *
 *     n = zs_shadow_casters(casters, things, n_things, &bias);
 *     err = zs_shadow_map_draw(&map, &light_renderer, &casters_scene, &light_camera);
 *     zs_shadow_map_light(&map, &scene.light);
 *     err = err ? err : zs_render(&screen, &scene, &camera, &sink);
 *
 * RAM       2 bytes a texel: 32 KB for 128 x 128; and a renderer with an arena for w x h, which may
 *           be the screen's arena if zs_init is called before each use.
 * Time      the light's frame is drawn when something has moved: 1.05 million instructions on a
 *           Cortex-M3 for 128 x 128 texels and a torus of 672 triangles.
 * Lamps     a directional light's camera is orthographic. A spot light's is a perspective one along
 *           its axis, as wide as its cone; a point light's is a perspective one towards what is to
 *           throw shadows: beside that view nothing is in shadow. Perspective maps are taken by
 *           zs_shade_shadowed_lit and _texture, _phong and _texture_phong.
 * Looks     edges are steps of texels; `soft` makes ramps of a texel of them. With too little bias
 *           surfaces are striped with their own shadow (acne); with too much, shadows begin behind
 *           the feet of things (peter-panning). Take .slope_bias = 288, or 544 with `soft`: a
 *           texel's middle is half a texel away each way, or a whole one, and 1/16 is for
 *           rounding. And .bias = 4; more where a step of a varying (zs_shade_shadowed_flat) is
 *           more than a key: 3 and the keys of a step.
 * Edges     within a texel of a shadow's edge, or of an edge of a thing in the light's view, either
 *           may be seen; elsewhere lit and dark are right.
 */
struct zs_shadow_map {
    uint16_t *key; /* [h][w], the caller's */
    uint16_t w, h; /* 1 .. ZS_SIZE_MAX */
    uint8_t soft;  /* 1: four texels are compared, and the results interpolated, in 1/16 texel */
    uint8_t drawn; /* these are set by zs_shadow_map_draw */
    uint8_t texels_shift, keys_shift;
    int32_t pos[3];
    zs_q2_30 rot[9];
    int64_t z_near;
    uint64_t texels, keys;
};

/* Make casters of instances: the same in their places, without colours.
 *
 * out      [n]; lines and points (zs_lines.h) are left out, and what has no material or a `cull`
 *          above 2. May not be `in`. What a shader makes
 *          of vertices (zs_shader.position) is not: a mesh is cast as it is.
 * Culling  as in the picture. A closed mesh may show the light its back faces in place of its front
 *          (out[k].material = &zs_shadow_caster[ZS_CULL_FRONT]): finely curved surfaces then have
 *          no specks, where a neighbour of another slope is within a texel.
 * state    the depth_state of all of them, with the map's bias and slope_bias; kept. NULL: none.
 * Return   the number of casters. */
extern const struct zs_material zs_shadow_caster[3]; /* by enum zs_cull */
uint32_t zs_shadow_casters(struct zs_instance *out, const struct zs_instance *in, uint32_t n,
                           const struct zs_depth_state *state);

/* Draw the map.
 *
 * map      key, w, h (and soft) set; the rest is.
 * r        w x h, set up with zs_depth_linear, or for a perspective camera zs_depth_recip, without
 *          method and damage tracking. Its varyings are 0 for casters. Accelerators help.
 * casters  any scene; colours are drawn and dropped.
 * light    orthographic (zs_camera_orthographic, zs_camera_look_along); or perspective, at the
 *          lamp: at most 126.8 degrees wide and high, of a focal length below 8192 px; near 1/4096
 *          to 15/16 of far; 16 depth bits. What is beside its view, before near, or beyond 2 to 4
 *          times far, is lit; what is beyond far, or with its bias in the last bucket before it,
 *          throws no shadow.
 * After    zs_invalidate for the renderers of the picture: they do not see that the map changed.
 * Return   as zs_render; ZS_ERR_NULL; ZS_ERR_SIZE: the map is not as large as r's frame;
 *          ZS_ERR_DEPTH: another mapping, or a method; ZS_ERR_CAMERA: another perspective camera,
 *          or another number of depth bits for it;
 *          ZS_ERR_SEQUENCE: damage tracking is on. With an error the map cannot be used. */
int zs_shadow_map_draw(struct zs_shadow_map *map, struct zs_renderer *r,
                       const struct zs_scene *casters, const struct zs_camera *light);

/* Set light->dir to where the map's light comes from. ambient and diffuse stay; where both are 0,
 * they become the usual light's, 1/4 and 3/4. */
void zs_shadow_map_light(const struct zs_shadow_map *map, struct zs_light *light);

/* The material of what may lie in shadow. */
struct zs_shadowed_material {
    struct zs_material material;     /* .rgb is its colour; with zs_shade_shadowed_smooth where the
                                        mesh has no face_rgb, which is rounded to RGB565 */
    const struct zs_shadow_map *map; /* drawn */
};

/* material.rgb, lit as zs_shade_flat does it (by the face's normal) or by the normals of the
 * vertices, interpolated; where the map's light does not arrive, by the ambient light alone.
 *
 * Exact    place and distance are varyings of 16 bits over a cube around the instance's sphere,
 *          whose side is 2 to 4 times the radius; they are interpolated perspective-correctly, to a
 *          step. A step is 2^-16 of the side: at most 1/4 texel and 64 keys, or the instance is
 *          refused. Cut it into parts then, or take a coarser map.
 * Cost     flat 160, smooth 190 instructions a pixel on a Cortex-M3; `soft` 40 more. Set-up of a
 *          triangle in a strip finds the instance's place in the map anew. Flash: 3.1 KB in all.
 * Refused  ZS_ERR_NULL: no map, or it is not drawn; ZS_ERR_RANGE: steps too coarse; ZS_ERR_MESH:
 *          smooth without mesh.normal; ZS_ERR_VARYINGS: smooth needs 4, and so a library compiled
 *          with ZS_VARYINGS_MAX of 4 or more; ZS_ERR_CAMERA: a map by a perspective camera. */
extern const struct zs_shader zs_shade_shadowed_flat;
extern const struct zs_shader zs_shade_shadowed_smooth;
#define ZS_VARYINGS_SHADOWED_FLAT 3u
#define ZS_VARYINGS_SHADOWED_SMOOTH 4u

/* The material of what may lie in the shadow of a lamp (zs_lights.h). */
struct zs_shadowed_lit {
    struct zs_lit_material lit;      /* its lighting has one lamp, the map's: at the camera of a
                                        perspective map, along that of an orthographic one. shine
                                        is not read; specular neither */
    const struct zs_shadow_map *map; /* drawn */
};

/* A colour (material.rgb or mesh.face_rgb, rounded to RGB565), or a texture, times ambient light
 * and the lamp's light at the vertices (Lambert, with its colour, cone and fading), of which the
 * map says at each pixel how much arrives; and emission. Need mesh.normal.
 *
 * Exact    as above; a step is at most 1/4 texel where a perspective map's near is, and 64 keys.
 *          The lamp's light is at most twice full, and rounded to 2^-15.
 * Cost     a pixel 331 (M0: 621), of a perspective map 441 (886); on a texture about as much.
 *          Flash, M3 -O2: 3 KB both, and 1.3 for places, beside those of lamps and textures.
 * Refused  as above; and ZS_ERR_RANGE: another number of lamps; as zs_shade_lit; the texture as
 *          zs_shade_texture. Varyings: 4, with a texture 6; compile with ZS_VARYINGS_MAX at least
 *          that. */
extern const struct zs_shader zs_shade_shadowed_lit, zs_shade_shadowed_texture;
#define ZS_VARYINGS_SHADOWED_LIT 4u
#define ZS_VARYINGS_SHADOWED_TEXTURE 6u

/* The material of what several lamps light, with highlights, in shadows of some or all of them. */
struct zs_shadowed_phong {
    struct zs_lit_material lit;
    /* Of each lamp: drawn at it or along it, as for zs_shadowed_lit. NULL: it throws no shadows. */
    const struct zs_shadow_map *map[ZS_LIGHTS_MAX ? ZS_LIGHTS_MAX : 1];
};

/* Lit at each pixel, as zs_shade_phong_near and zs_shade_texture_phong do it (zs_lights.h), each
 * lamp's light and highlight times what its map lets through. The maps' keys are looked up from the
 * pixel's place in the world; instances of any size beside a map's texels are taken.
 *
 * Cost     of a pixel with one lamp and its map 1,945 (M0: 4,520), of a point 2,105 (4,560);
 *          textures as much.
 * Refused  as zs_shade_phong_near, zs_shade_texture_phong; ZS_ERR_NULL: a map that is not drawn.
 *          Varyings: 6, with a texture 8. */
extern const struct zs_shader zs_shade_shadowed_phong, zs_shade_shadowed_texture_phong;
#define ZS_VARYINGS_SHADOWED_PHONG 6u
#define ZS_VARYINGS_SHADOWED_TEXTURE_PHONG 8u

ZS_C_END

#endif
