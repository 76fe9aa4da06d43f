/* Why a frame or a configuration is refused: the field, and the instance.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/cold.h"
#include "core/frame.h"
#include "core/method.h"
#include "core/rotation.h"
#include "core/usual.h"
#include "support/explain.h"
#include "zs_shader.h"

/* The error's own clause, as the end of a sentence. */
static void say_error(struct zs_explainer *e, int err)
{
    ZS_PIECE(e, zs_error_string(err));
    ZS_SAY(e, ".");
}

/* Return 1, and say it, if a position lies outside the world. */
static int say_pos(struct zs_explainer *e, const char *name, const int32_t pos[3])
{
    if (zs_within(pos, 3, ZS_WORLD_MAX))
        return 0;
    ZS_PIECE(e, name);
    ZS_SAY(e, " is % % %, and % is the most.", pos[0], pos[1], pos[2], ZS_WORLD_MAX);
    return 1;
}

/* ---- Camera, light and scene ----------------------------------------------------------------- */

/* ZS_ERR_NEAR of an orthographic camera. */
static void say_span(struct zs_explainer *e)
{
    ZS_SAY(e, "near = $ and far = $ are closer to each other than 2^-29 of the distance: move far "
              "out.", e->r->camera.z_near, e->r->camera.z_far);
}

static void say_camera(struct zs_explainer *e, int err)
{
    const struct zs_camera *const c = &e->r->camera;
    const int perspective = c->projection == ZS_PERSPECTIVE;
    ZS_PIECE(e, "the camera is refused: ");
    if (c->projection > ZS_ORTHOGRAPHIC)
        ZS_SAY(e, "projection is %.", c->projection);
    else if (c->z_near >= c->z_far || (perspective && c->z_near <= 0))
        ZS_SAY(e,
               perspective ? "near = $ and far = $; 0 < near < far is needed: look at what "
                             "zs_camera_perspective returned."
                           : "near = $ and far = $; near < far is needed: look at what "
                             "zs_camera_orthographic returned.",
               c->z_near, c->z_far);
    else if (perspective && (c->focal < ZS_FOCAL_MIN || c->focal > ZS_FOCAL_MAX))
        ZS_SAY(e, "its focal length is % px: zs_camera_perspective sets it from an angle.",
               (int64_t)(c->focal >> 32));
    else if (!perspective && (c->height < ZS_HEIGHT_MIN || c->height > (int64_t)1 << 46))
        ZS_SAY(e, "its height is $: zs_camera_orthographic sets it.", c->height);
    else if (!zs_rotation_ok(c->rot))
        ZS_SAY(e, "rot is no rotation: zs_camera_look_at sets it.");
    else if (err == ZS_ERR_NEAR && !perspective)
        say_span(e);
    else if (!say_pos(e, "pos", c->pos) && err == ZS_ERR_RANGE)
        ZS_SAY(e, "its height is $, too small beside near = $: was % * 65536 meant?", c->height,
               c->z_near, c->height);
    else if (err != ZS_ERR_RANGE)
        ZS_SAY(e, "near = $ and far = $: near is at most 2^29, far 2^44, far - near at least "
                  "far / 65536.", c->z_near, c->z_far);
}

/* What is wrong without any instance. */
static void say_scene(struct zs_explainer *e, int err)
{
    const struct zs_scene *const scene = e->scene;
    const struct zs_light *const light = &scene->light;
    if (err == ZS_ERR_CAMERA)
        say_camera(e, err);
    else if (err == ZS_ERR_DEPTH && e->r->camera.projection == ZS_ORTHOGRAPHIC)
        ZS_SAY(e, "the depth mapping takes perspective cameras: zs_depth_linear takes an "
                  "orthographic one.");
    else if (err == ZS_ERR_NULL)
        ZS_SAY(e,
               scene->sky && !scene->sky->fill
                   ? "scene.sky.fill is NULL."
                   : "scene.resolve, or draw of a hook, is NULL, and n_resolves is %.",
               scene->n_resolves);
    else if (err == ZS_ERR_RANGE && (light->ambient > ZS_Q16_ONE || light->diffuse > ZS_Q16_ONE))
        ZS_SAY(e, "the light is refused: ambient is %, diffuse is %; 65536 is full.",
               light->ambient, light->diffuse);
    else if (err == ZS_ERR_RANGE && !zs_within(light->dir, 3, ZS_UNIT_MOST))
        ZS_SAY(e, "the light is refused: its dir is longer than 1, ZS_Q30_ONE: zs_unit makes it 1 "
                  "long.");
    else
        say_camera(e, err);
}

/* ---- Instances ------------------------------------------------------------------------------- */

/* Return 1 if a field is said that is NULL. */
static int say_null(struct zs_explainer *e, const struct zs_instance *in)
{
    const struct zs_material *const m = in->material;
    const char *const field = !in->mesh    ? "mesh is NULL."
                              : !m         ? "material is NULL."
                              : !m->shader ? "material.shader is NULL."
                              : m->shader->by_fragment && !m->shader->fragment
                                  ? "its shader's fragment stage is NULL."
                              : !m->shader->run ? "its shader has no ZS_FRAGMENTS (zs_shader.h)."
                              : m->primitive && !m->primitive->ops
                                  ? "material.primitive has no ops: ZS_LINES or ZS_POINTS sets it."
                              : !in->mesh->pos && in->mesh->n_verts ? "mesh.pos is NULL."
                              : !in->mesh->tri && in->mesh->n_tris  ? "mesh.tri is NULL."
                                                                    : 0;
    if (field)
        ZS_SAY(e, field);
    return field != 0;
}

/* What its shader's check says of an instance. */
static int shader_error(const struct zs_explainer *e, const struct zs_instance *in)
{
    const struct zs_shader *const shader = in->material->shader;
    return shader->check ? shader->check(in, &e->r->config) : ZS_OK;
}

/* Lines or points that are refused by what is drawn beyond their mesh. */
static void say_wide(struct zs_explainer *e, const struct zs_instance *in)
{
    struct zs_camera *const c = &e->r->camera;
    const zs_uq32_32 focal = c->focal;
    const zs_q48_16 height = c->height;
    struct zs_bounds b;
    c->focal = ZS_FOCAL_MAX; /* of a camera for which a px is next to nothing */
    c->height = 0;
    const int err = zs_cull_bounds(&b, e->r, in);
    c->focal = focal;
    c->height = height;
    ZS_SAY(e,
           err ? "the width of its lines, or the size of its points, is more than 64 px."
               : "its lines or points reach % world units beyond it: for their width, the camera's "
                 "focal length of $ px is too short, or its height too large.",
           ZS_WORLD_MAX, (int64_t)(focal >> 16));
}

/* Causes are left out one by one. */
static void say_range(struct zs_explainer *e, const struct zs_instance *in)
{
    const struct zs_depth_state *const state = in->depth_state;
    const uint64_t scale = zs_usual_scale(in); /* q32_32 */
    struct zs_material material = *in->material;
    struct zs_instance stateless = *in, bare = *in; /* without a state; without lines or points */
    struct zs_bounds b;
    stateless.depth_state = 0;
    material.primitive = 0;
    bare.material = &material;
    if (!zs_rotation_ok(zs_usual_rotation(in->pose.rot)))
        ZS_SAY(e, "pose.rot is no rotation: its elements are q2_30; zs_pose_turn sets it.");
    else if (say_pos(e, "pose.pos", in->pose.pos))
        return;
    else if (state && state->func > ZS_DEPTH_ALWAYS)
        ZS_SAY(e, "depth_state.func is %.", state->func);
    else if (zs_cull_bounds(&b, e->r, &bare))
        ZS_SAY(e,
               "it is too large: % steps, of $ world units each; steps of 32767 units are the "
               "most, and a radius of % units; 1 is ZS_Q16_ONE in mesh.scale and pose.scale.",
               in->mesh->radius, (int64_t)(scale >> 16), ZS_WORLD_MAX);
    else if (shader_error(e, &stateless))
        ZS_SAY(e, "its material has a field out of range: lamps, flags, a shine that zs_shine_set "
                  "has not set, or a shadow map too fine for its size.");
    else if (shader_error(e, in))
        ZS_SAY(e,
               "its depth_state has .bias %, .slope_bias %, .read_only %, .func %: its shader "
               "takes a bias below 0 alone.",
               state->bias, state->slope_bias, state->read_only, state->func);
    else if (zs_cull_bounds(&b, e->r, in))
        say_wide(e, in);
    else
        ZS_SAY(e, "the camera's height is $, too small for it: was % * 65536 meant?",
               e->r->camera.height, e->r->camera.height);
}

/* err: ZS_ERR_MESH or ZS_ERR_NULL. */
static void say_mesh(struct zs_explainer *e, const struct zs_instance *in, int err)
{
    const struct zs_mesh *const mesh = in->mesh;
    const struct zs_texture *const x = in->material->texture;
    struct zs_mesh fine = *mesh;
    struct zs_instance other = *in;
    other.mesh = &fine;
    fine.uv_bits = 15;
    if (mesh->n_verts > 65535u) {
        ZS_SAY(e, "mesh.n_verts is %, and 65535 is the most.", mesh->n_verts);
    } else if (in->material->cull > ZS_CULL_NONE) {
        ZS_SAY(e, "material.cull is %.", in->material->cull);
    } else if (mesh->uv && mesh->uv_bits > 15u) {
        ZS_SAY(e, "mesh.uv_bits is %, and 15 is the most.", mesh->uv_bits);
    } else if (x && err == ZS_ERR_NULL && !x->texel) {
        ZS_SAY(e, "its texture's texel is NULL.");
    } else if (x && err == ZS_ERR_NULL && !x->format) {
        ZS_SAY(e, "its texture's format is NULL: take &zs_texel_565, or another.");
    } else if (x && err == ZS_ERR_NULL && !x->palette && x->format != &zs_texel_565) {
        ZS_SAY(e, "its texture's palette is NULL.");
    } else if (in->material->primitive && !shader_error(e, in)) {
        ZS_SAY(e,
               err == ZS_ERR_NULL ? "its lines are NULL: ZS_LINES sets them."
                                  : "it has % lines or points, and its mesh % triangles, of which "
                                    "its shader reads the colours: zs_shade_plain takes any.",
               in->material->primitive->n, mesh->n_tris);
    } else if (x && err == ZS_ERR_MESH && !shader_error(e, &other)) {
        ZS_SAY(e,
               "mesh.uv_bits is %, and its texture's log2_w %, log2_h %: its shader takes more "
               "bits than both, 15 at most.",
               mesh->uv_bits, x->log2_w, x->log2_h);
    } else {
        ZS_PIECE(e, "its shader needs what is NULL:");
        if (!mesh->normal)
            ZS_PIECE(e, " mesh.normal,");
        if (!mesh->uv)
            ZS_PIECE(e, " mesh.uv,");
        if (!x)
            ZS_PIECE(e, " material.texture,");
        ZS_SAY(e, err == ZS_ERR_NULL ? " or more of its material (lighting, a map)."
                                     : " or one of these.");
    }
}

static void say_instance(struct zs_explainer *e, uint32_t i, int err)
{
    const struct zs_instance *const in = &e->scene->instance[i];
    const struct zs_texture *texture;
    ZS_PIECE(e, "instance % is refused: ", i);
    if (say_null(e, in))
        return;
    texture = in->material->texture;
    if (err == ZS_ERR_RANGE)
        say_range(e, in);
    else if (err == ZS_ERR_MESH || err == ZS_ERR_NULL)
        say_mesh(e, in, err);
    else if (err == ZS_ERR_VARYINGS && !in->material->shader->n_varyings)
        ZS_SAY(e, "its shader has a vertex stage, and n_varyings is 0.");
    else if (err == ZS_ERR_VARYINGS)
        ZS_SAY(e, "its shader takes % varyings, and config.varyings is %.",
               in->material->shader->n_varyings, e->r->config.varyings);
    else if (err == ZS_ERR_TEXTURE && texture)
        ZS_SAY(e,
               texture->n_levels > 1 && texture->clamp <= (ZS_CLAMP_U | ZS_CLAMP_V) &&
                       zs_maxu32(texture->log2_w, texture->log2_h) <= ZS_TEXTURE_LOG2_MAX
                   ? "its texture's log2_w is %, log2_h %, clamp %, n_levels %: it has no room for "
                     "so many levels (zs_filter.h)."
                   : "its texture's log2_w is %, log2_h %, clamp %; the first two are logarithms, "
                     "0 to 10.",
               texture->log2_w, texture->log2_h, texture->clamp, texture->n_levels);
    else if (err == ZS_ERR_CAMERA)
        ZS_SAY(e, "its shadow map was drawn by a perspective camera: zs_shade_shadowed_lit takes "
                  "those, and its shader takes orthographic ones.");
    else if (err == ZS_ERR_NEAR && e->r->camera.projection == ZS_ORTHOGRAPHIC)
        say_span(e);
    else if (err == ZS_ERR_VECTOR)
        ZS_SAY(e, "a lamp of its lighting has a dir that is not 1 long: give it a direction, and "
                  "zs_unit makes it ZS_Q30_ONE long.");
    else if (err == ZS_ERR_DEPTH)
        ZS_SAY(e, "its shader does not go with config.method, or with config.depth: the header of "
                  "either says which do.");
    else
        say_error(e, err);
}

void zs_explain_refused(struct zs_explainer *e)
{
    struct zs_renderer *const r = e->r;
    if (!e->scene || !e->camera) {
        ZS_SAY(e, e->scene ? "the camera is NULL." : "the scene is NULL.");
        return;
    }
    struct zs_scene part = *e->scene;
    if (part.n_instances > 65535u) {
        ZS_SAY(e, "scene.n_instances is %, and 65535 is the most.", part.n_instances);
        return;
    }
    part.n_instances = 0;
    int err = zs_frame_check(r, &part);
    if (err) {
        say_scene(e, err);
        return;
    }
    if (!e->scene->instance) {
        ZS_SAY(e, "scene.instance is NULL, and n_instances is %.", e->scene->n_instances);
        return;
    }
    part.n_instances = 1;
    for (uint32_t i = 0; i < e->scene->n_instances; i++) {
        part.instance = &e->scene->instance[i];
        err = zs_frame_check(r, &part);
        if (err)
            say_instance(e, i, err);
    }
    if (e->said == 0) {
        ZS_PIECE(e, "the frame is refused: ");
        say_error(e, zs_frame_check(r, e->scene));
    }
}

/* ---- Set-up ---------------------------------------------------------------------------------- */

static void say_field(struct zs_explainer *e, const char *name, uint32_t value, uint32_t least,
                      uint32_t most)
{
    if (value >= least && value <= most)
        return;
    ZS_PIECE(e, name);
    ZS_SAY(e, " is %: it takes % to %.", value, least, most);
}

/* Say it if config.method takes more of a pool, whatever the other one is. */
static void say_pool(struct zs_explainer *e, const char *name, uint16_t *pool, uint16_t *other)
{
    const uint16_t is = *pool, was = *other;
    *other = ZS_POOL_MAX;
    while (e->r->config.method->begin(e->r) && *pool < ZS_POOL_MAX)
        ++*pool;
    say_field(e, name, is, *pool, ZS_POOL_MAX);
    *pool = is;
    *other = was;
}

static void say_config(struct zs_explainer *e, const struct zs_config *c)
{
    say_field(e, "config.width", c->width, 1, ZS_SIZE_MAX);
    say_field(e, "config.height", c->height, 1, ZS_SIZE_MAX);
    say_field(e, "config.strip_h", c->strip_h, 1, 65535);
    say_field(e, "config.max_tris", c->max_tris, 1, ZS_POOL_MAX);
    say_field(e, "config.max_verts", c->max_verts, 3, ZS_POOL_MAX);
    say_field(e, "config.varyings", c->varyings, 0, ZS_VARYINGS_MAX);
    say_field(e, "config.buffers", c->buffers, 0, 2);
    if (c->subpixel_bits != 4 && c->subpixel_bits != 8 && c->subpixel_bits)
        ZS_SAY(e, "config.subpixel_bits is %: it takes 8, or 4.", c->subpixel_bits);
    if (c->depth_bits)
        say_field(e, "config.depth_bits", c->depth_bits, 8, 16);
    if (!c->depth)
        ZS_SAY(e, "config.depth is NULL: take &zs_depth_float, or another mapping.");
}

uint32_t zs_explain_init_build(struct zs_renderer *r, const struct zs_config *config, void *arena,
                               size_t bytes, void (*say)(void *ctx, const char *text), void *ctx,
                               uint32_t build)
{
    struct zs_explainer e = { r, 0, 0, say, ctx, 0, 0, { 0 }, 0 };
    const int err = zs_init_build(r, config, arena, bytes, build);
    if (!err)
        return 0;
    if (!r || !config || !arena)
        ZS_SAY(&e, !r ? "the renderer is NULL." : !config ? "config is NULL." : "arena is NULL.");
    else if (err != ZS_ERR_BUILD)
        say_config(&e, config);
    if (err == ZS_ERR_ARENA && (uintptr_t)arena % 4u)
        ZS_SAY(&e, "the arena is not aligned to 4 bytes: ZS_ARENA defines one that is.");
    else if (err == ZS_ERR_ARENA)
        ZS_SAY(&e, "the arena has % bytes, and % are needed: ZS_ARENA_BYTES.", (int64_t)bytes,
               zs_arena_bytes(config));
    if (err == ZS_ERR_DEPTH && config->method && !e.said)
        ZS_SAY(&e,
               "config.method does not take this config.depth: zs_method.h says which it takes.");
    if (err == ZS_ERR_SIZE && config->method && !e.said) {
        say_pool(&e, "for config.method, max_tris", &r->config.max_tris, &r->config.max_verts);
        say_pool(&e, "for config.method, max_verts", &r->config.max_verts, &r->config.max_tris);
    }
    if (!e.said) {
        ZS_PIECE(&e, "zs_init refuses: ");
        say_error(&e, err);
    }
    return e.said;
}
