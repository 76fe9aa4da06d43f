/* Load where words about loading have changed, draw, keep.
 *
 * SPDX-License-Identifier: MIT
 */
#include "shot.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "demo.h"
#include "value.h"
#include "scene_parts.h"
#include "sim.h"
#include "vec.h"

#define RADIANS 0.01745329251994329577
#define DIGITS 1e-5 /* of the distance, to which places are rounded */

/* Options that do not change how a model is loaded; from the ninth on, not what it is converted to, either: they say
 * the view, light, background or renderer. */
static const char *const after_loading[] = {
    "--show", "--method", "--threads", "--style", "--line-width", "--edges", "--crease", "--dash",
    "--out", "--size", "--strip", "--depth", "--depth-bits", "--subpixel", "--tris", "--verts", "--buffers", "--fast",
    "--panel", "--rotate", "--invert", "--bgr", "--eye", "--at", "--up", "--fov", "--near", "--far", "--projection",
    "--background", "--light", "--ambient", "--diffuse", NULL
};
static const char *const *const after_converting = after_loading + 8;

/* ---- Pictures ---------------------------------------------------------------------------------------- */

static int draw_scene(struct view_shot *shot, struct sim_rendered *seen)
{
    char *argv[VIEW_ARGV_MAX];
    const int argc = view_words_argv(&shot->words, argv);
    return sim_demo_seen(seen, &shot->n_frames, argc, argv);
}

static int load(struct view_shot *shot, char *by)
{
    const int status = sim_scene_load(&shot->model, &shot->o);
    if (status != SIM_OK)
        return status;
    shot->loaded_by = by;
    shot->shade = shot->o.shade;
    shot->shade_chosen = shot->o.shade_chosen;
    return SIM_OK;
}

static void drop_kept(struct view_shot *shot)
{
    if (shot->kept != NULL)
        sim_kept_free(shot->kept);
    free(shot->kept_by);
    shot->kept_by = NULL;
}

/* From what `before` has kept, where it is of the same model and words. */
static int render(struct sim_rendered *r, struct view_shot *shot, struct view_shot *before, int loaded)
{
    char *by = view_words_line(&shot->words, "", after_converting);
    if (before->kept == NULL)
        before->kept = sim_alloc(1, sizeof *before->kept);
    if (loaded || before->kept_by == NULL || strcmp(before->kept_by, by) != 0)
        drop_kept(before);
    const int status = sim_render_all(r, before->kept, &shot->model, &shot->o);
    free(before->kept_by);
    before->kept_by = by;
    if (status != SIM_OK)
        drop_kept(before);
    shot->kept = before->kept;
    shot->kept_by = before->kept_by;
    return status;
}

/* The model of `before` is borrowed where nothing says that it has changed: *loaded is 0 then. */
static int draw_model(struct view_shot *shot, struct view_shot *before, struct sim_rendered *seen, int reload,
                      int *loaded)
{
    char *argv[VIEW_ARGV_MAX], *by = view_words_line(&shot->words, "", after_loading);
    const int argc = view_words_argv(&shot->words, argv);
    int status = sim_options_parse(&shot->o, argc, argv);
    *loaded = 0;
    if (status == SIM_OK && !reload && before->loaded_by != NULL && strcmp(before->loaded_by, by) == 0) {
        shot->o.shade = before->shade;
        shot->o.shade_chosen = before->shade_chosen;
        free(by);
    } else if (status == SIM_OK && (status = load(shot, by)) == SIM_OK) {
        *loaded = 1;
    } else {
        free(by);
    }
    shot->o.explain = SIM_EXPLAIN_EMPTY;
    if (status == SIM_OK)
        status = render(seen, shot, before, *loaded);
    return status;
}

int view_shot_take(struct view_shot *shot, const struct view_words *words, int reload)
{
    struct view_shot next = *shot;
    struct sim_rendered seen = { 0 };
    int loaded = 0;
    next.words = (struct view_words){ 0 };
    view_words_copy(&next.words, words);
    const int status =
        words->model != NULL ? draw_model(&next, shot, &seen, reload, &loaded) : draw_scene(&next, &seen);
    if (status != SIM_OK) {
        view_words_free(&next.words);
        sim_render_free(&seen);
        if (loaded) {
            sim_model_free(&next.model);
            free(next.loaded_by);
        }
        return status;
    }
    view_words_free(&shot->words);
    sim_render_free(&shot->seen);
    if (loaded) {
        sim_model_free(&shot->model);
        free(shot->loaded_by);
    }
    sim_rendered_show(&seen);
    next.seen = seen;
    next.serial++;
    *shot = next;
    return SIM_OK;
}

void view_shot_free(struct view_shot *shot)
{
    view_words_free(&shot->words);
    sim_render_free(&shot->seen);
    drop_kept(shot);
    free(shot->kept);
    sim_model_free(&shot->model);
    free(shot->loaded_by);
    memset(shot, 0, sizeof *shot);
}

/* ---- The camera -------------------------------------------------------------------------------------- */

static void set_place(struct view_words *words, const char *name, const double v[3], double distance)
{
    char text[96];
    const double step = pow(10.0, floor(log10(distance * DIGITS)));
    double r[3];
    for (int k = 0; k < 3; k++)
        r[k] = round(v[k] / step) * step + 0.0; /* no -0 */
    (void)snprintf(text, sizeof text, "%.9g,%.9g,%.9g", r[0], r[1], r[2]);
    view_words_set(words, name, text);
}

void view_shot_orbit(const struct view_shot *shot, struct view_words *words, double turn, double rise, double factor)
{
    const struct sim_view *v = &shot->seen.view;
    double eye[3], off[3];
    sim_view_orbit(eye, v, shot->o.up, turn * RADIANS, rise * RADIANS, factor);
    sim_sub(off, eye, v->at);
    set_place(words, "--eye", eye, sqrt(sim_dot(off, off)));
}

/* Degrees, degrees, a factor. */
static void orbit_of(double at[3], const struct view_words *words)
{
    const char *now = view_words_get(words, "--orbit");
    at[0] = at[1] = 0.0;
    at[2] = 1.0;
    if (now != NULL)
        (void)sim_value_vector(now, at);
}

struct sim_orbit view_scene_orbit(const struct view_words *words)
{
    double at[3];
    orbit_of(at, words);
    return (struct sim_orbit){ at[0] * RADIANS, at[1] * RADIANS, at[2] };
}

void view_scene_turn(struct view_words *words, double turn, double rise, double factor)
{
    double at[3];
    char text[96];
    orbit_of(at, words);
    at[0] = remainder(at[0] + turn, 360.0) + 0.0; /* no -0 */
    at[1] = fmax(-180.0, fmin(180.0, at[1] + rise)) + 0.0;
    at[2] = fmax(SIM_ORBIT_LEAST, fmin(SIM_ORBIT_MOST, at[2] * factor));
    (void)snprintf(text, sizeof text, "%.5g,%.5g,%.4g", at[0], at[1], at[2]);
    view_words_set(words, "--orbit", strcmp(text, "0,0,1") == 0 ? NULL : text);
}

void view_shot_pan(const struct view_shot *shot, struct view_words *words, double dx, double dy)
{
    const struct sim_view *v = &shot->seen.view;
    double off[3], eye[3], at[3];
    sim_sub(off, v->eye, v->at);
    const double distance = sqrt(sim_dot(off, off));
    const double px = v->orthographic ? v->span / v->height : distance / v->focal; /* model units, at v->at */
    for (int k = 0; k < 3; k++) {
        const double by = px * (dy * v->up[k] - dx * v->right[k]);
        eye[k] = v->eye[k] + by;
        at[k] = v->at[k] + by;
    }
    set_place(words, "--eye", eye, distance);
    set_place(words, "--at", at, distance);
}
