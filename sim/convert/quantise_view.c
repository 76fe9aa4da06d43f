/* World unit, camera and light of a scene for one view.
 *
 * The world unit: a mesh step (256 grid steps) is 2^k world units, with k as large as the eye and the
 * model allow, so that they use 2^28 .. 2^29 of the world. A converted mesh keeps its own world unit, halved as often.
 * The far plane may be 2^15 times farther. Where half a unit would be more than OFF_MAX_PX on the screen, the camera is
 * refused: better than a wrong picture.
 *
 * SPDX-License-Identifier: MIT
 */
#include "quantise_parts.h"

#include "sim.h"
#include "vec.h"

#define WORLD_USE 0.98        /* of ZS_WORLD_MAX: room for bounding spheres rounded up */
#define UNITS_LOG2_MAX 15     /* world units to a mesh step: mesh.scale is uq16_16 */
#define UNITS_LOG2_MIN (-15) /* the model is then one world unit wide */
#define WHOLE_MAX (1.0 / 4096.0) /* world units that a camera at whole ones may be off, from text */
#define OFF_MAX_PX (1.0 / 32.0)

/* Rounding the eye to a unit moves the model by up to half of one. */
static int check_unit(const struct sim_scene *s, const struct sim_model *model,
                      const struct sim_view *v, double need)
{
    double d[3];
    sim_sub(d, model->center, v->eye);
    const double clear = sqrt(sim_dot(d, d)) - model->radius; /* from the eye to the model */
    const double z = fmax(fmax(v->near_z, clear), model->radius / 16.0);
    const double px = v->orthographic ? v->height / v->span : v->focal / z;
    if (s->unit / 2.0 * px <= OFF_MAX_PX)
        return SIM_OK;
    return sim_refuse(model->file, 0,
                      "the eye or the far plane is so far away, %g beside a model of %g, that the "
                      "integers would move the model by %.2g px; bring it closer",
                      fmax(need, v->far_z), sim_model_extent(model), s->unit / 2.0 * px);
}

#define FLOOR_ROOM 16.0 /* what a floor, its shadows and its mirror images reach, of what the scene does */

/* World units to a mesh step, uq16_16. unit: of convert's, model units; 0: there is none to keep to. */
static int choose_unit(struct sim_scene *s, uint32_t *scale, const struct sim_model *model,
                       const struct sim_view *v, const struct sim_effect_options *e, double unit)
{
    double d[3], eye = 0.0;
    sim_sub(d, model->center, s->origin);
    double need = model->radius + sqrt(sim_dot(d, d));
    for (int k = 0; k < 3; k++)
        eye = fmax(eye, fabs(v->eye[k] - s->origin[k]));
    need = fmax(fmax(need, eye), fabs(v->near_z));
    need = fmax(need, fabs(v->far_z) * ZS_WORLD_MAX / (double)ZS_FAR_MAX); /* may be far outside */
    if (v->orthographic)
        need = fmax(need, v->span / 2.0);
    for (int i = 0; i < e->n_lights; i++)
        for (int k = 0; k < 3 && e->light[i].kind != SIM_LIGHT_DIR; k++)
            need = fmax(need, fabs(e->light[i].at[k] - s->origin[k]));
    if (sim_effects_floor(e))
        need *= FLOOR_ROOM;
    const double mesh_step = 256.0 * s->step;
    const double k = floor(log2(WORLD_USE * ZS_WORLD_MAX * mesh_step / need));
    if (!(k >= UNITS_LOG2_MIN)) {
        const double size = sim_model_extent(model);
        const double most = WORLD_USE * ZS_WORLD_MAX * exp2(-UNITS_LOG2_MIN) * mesh_step / size;
        return sim_refuse(
            model->file, 0,
            "%s %g is %.3g times the model's size %g; the integers hold up to %.3g times",
            eye >= 0.5 * need ? "the eye's distance" : "the far plane's or the view's extent", need,
            need / size, size, most);
    }
    const int units_log2 = k > UNITS_LOG2_MAX ? UNITS_LOG2_MAX : (int)k;
    *scale = (uint32_t)ldexp(65536.0, units_log2);
    s->unit = ldexp(mesh_step, -units_log2);
    if (unit > 0.0 && WORLD_USE * ZS_WORLD_MAX * unit >= need) { /* a part of it, so that no scale is rounded */
        *scale = (uint32_t)rint(mesh_step / unit * 65536.0);
        s->unit = unit;
        while (*scale < 1u << 30 && WORLD_USE * ZS_WORLD_MAX * s->unit >= 2.0 * need) {
            *scale *= 2u;
            s->unit /= 2.0;
        }
    }
    return check_unit(s, model, v, need);
}

static void scaled(int32_t out[3], const double v[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = (int32_t)lrint(v[k] * 1073741824.0 * (1.0 - 0x1p-30));
}

/* A camera that a program on the board can have, at whole world units, and looking at such a place: as it has it. */
static void take_whole(const struct sim_scene *s, const struct sim_view *v, const struct sim_options *o, double unit,
                       int32_t eye[3], int32_t dir[3], int32_t up[3])
{
    double from[3], to[3];
    for (int k = 0; k < 3; k++) {
        from[k] = (v->eye[k] - s->origin[k]) / unit;
        to[k] = (v->at[k] - s->origin[k]) / unit;
        if (fabs(from[k] - rint(from[k])) > WHOLE_MAX || fabs(to[k] - rint(to[k])) > WHOLE_MAX ||
            fabs(to[k] - from[k]) > ZS_WORLD_MAX || o->up[k] != rint(o->up[k]) || fabs(o->up[k]) > ZS_WORLD_MAX)
            return;
    }
    for (int k = 0; k < 3; k++) {
        eye[k] = (int32_t)lrint(rint(from[k]) * (unit / s->unit));
        dir[k] = (int32_t)lrint(rint(to[k]) - rint(from[k]));
        up[k] = (int32_t)lrint(o->up[k]);
    }
}

/* unit: of convert's, model units; 0: there is none. */
static int build_camera(struct sim_scene *s, const struct sim_view *v, const struct sim_options *o, double unit,
                        const char *file)
{
    struct zs_camera *c = &s->camera;
    double forward[3];
    int32_t eye[3], dir[3], up[3];
    for (int k = 0; k < 3; k++) {
        eye[k] = (int32_t)lrint((v->eye[k] - s->origin[k]) / s->unit);
        forward[k] = -v->back[k];
    }
    scaled(dir, forward);
    scaled(up, v->up);
    if (unit > 0.0)
        take_whole(s, v, o, unit, eye, dir, up);
    c->projection = v->orthographic ? ZS_ORTHOGRAPHIC : ZS_PERSPECTIVE;
    c->focal = (zs_uq32_32)llrint(v->focal * 4294967296.0);
    c->height = llrint(v->span / s->unit * 65536.0);
    c->z_near = llrint(v->near_z / s->unit * 65536.0);
    c->z_far = llrint(v->far_z / s->unit * 65536.0);
    const int err = zs_camera_look_along(c, eye, dir, up);
    if (err != ZS_OK)
        return sim_refuse(file, 0, "the camera was refused: %s", zs_error_string(err));
    if (!v->orthographic && c->z_near <= 0)
        return sim_refuse(file, 0,
                          "near %g is too small beside a world that reaches %g; enlarge it",
                          v->near_z, s->unit * ZS_WORLD_MAX);
    return SIM_OK;
}

static void build_light(struct sim_scene *s, const struct sim_view *v, const struct sim_options *o)
{
    for (int k = 0; k < 3; k++)
        s->scene.light.dir[k] = (zs_q2_30)lrint(v->light[k] * 1073741824.0);
    s->scene.light.ambient = (zs_uq16_16)lrint(o->ambient * 65536.0);
    s->scene.light.diffuse = (zs_uq16_16)lrint(o->diffuse * 65536.0);
    const uint8_t ambient = (uint8_t)lrint(o->ambient * 255.0);
    s->lamp = (struct zs_lamp){ .rgb = { 255, 255, 255 },
                                .strength = s->scene.light.diffuse > 0 ? s->scene.light.diffuse : 1u, /* 0 would be 1 */
                                .dir = { s->scene.light.dir[0], s->scene.light.dir[1], s->scene.light.dir[2] } };
    s->lighting = (struct zs_lighting){ .lamp = &s->lamp, .n_lamps = 1, .ambient = { ambient, ambient, ambient } };
    s->scene.background = zs_rgb565(o->background.r, o->background.g, o->background.b);
}

int sim_scene_view(struct sim_scene *s, uint32_t *scale, const struct sim_model *model, const struct sim_view *view,
                   const struct sim_options *o)
{
    int status = choose_unit(s, scale, model, view, &o->effects, s->made_unit);
    if (status == SIM_OK)
        status = build_camera(s, view, o, s->made_unit, model->file);
    if (status == SIM_OK)
        build_light(s, view, o);
    return status;
}
