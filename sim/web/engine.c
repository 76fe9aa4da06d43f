/* Options, scenes, frames.
 *
 * SPDX-License-Identifier: MIT
 */
#include "engine.h"

#include <stdlib.h>
#include <string.h>

#include "answer.h"
#include "demo_frame.h"
#include "option_table.h"
#include "scene_parts.h"
#include "sim.h"
#include "stats.h"

struct web web = { .orbit = SIM_ORBIT_HOME };

/* ---- Memory that the caller fills --------------------------------------------------------------- */

WEB_EXPORT(take) void *web_take(size_t bytes)
{
    return sim_alloc(bytes, 1);
}

WEB_EXPORT(give) void web_give(void *block)
{
    free(block);
}

/* ---- Options ------------------------------------------------------------------------------------ */

static const char *kind_name(enum sim_option_kind kind)
{
    switch (kind) {
    case SIM_OPTION_SIZE:
        return "size";
    case SIM_OPTION_COUNT:
        return "count";
    case SIM_OPTION_NUMBER:
        return "number";
    case SIM_OPTION_VECTOR:
        return "vector";
    case SIM_OPTION_RGB:
        return "rgb";
    case SIM_OPTION_CHOICE:
        return "choice";
    case SIM_OPTION_FLAG:
        return "flag";
    default:
        return "text";
    }
}

/* The rows of zsim render's table, but for files. */
WEB_EXPORT(options) const char *web_options(void)
{
    size_t n;
    const struct sim_option *row = sim_options_rows(&n);
    FILE *f = answer_begin();
    const char *comma = "[";
    for (size_t i = 0; i < n; i++) {
        if (row[i].kind >= SIM_OPTION_HEADING || row[i].kind == SIM_OPTION_FILE ||
            row[i].kind == SIM_OPTION_PATH || row[i].name[1] != '-')
            continue;
        (void)fprintf(f, "%s{\"name\":", comma);
        answer_text(f, row[i].name + 2);
        (void)fprintf(f, ",\"kind\":\"%s\"", kind_name(row[i].kind));
        if (row[i].lo < row[i].hi)
            (void)fprintf(f, ",\"min\":%.17g,\"max\":%.17g", row[i].lo, row[i].hi);
        if (row[i].words != NULL) {
            (void)fputs(",\"words\":", f);
            answer_text(f, row[i].words);
        }
        (void)fputs(",\"text\":", f);
        answer_text(f, row[i].help != NULL ? row[i].help : "");
        (void)fputs("}", f);
        comma = ",";
    }
    (void)fputs("]", f);
    return answer_end();
}

/* Options from n words that follow each other, each with a '\0' behind it; *words becomes the place that they point
 * to. */
static int parse(struct sim_options *o, char **words, const char *given, size_t bytes, int n)
{
    char **argv = sim_alloc((size_t)n + 4, sizeof *argv);
    static char out[] = "--out", frame[] = "frame.png", none[] = "model", only[] = "--";
    int argc = 0;
    *words = sim_alloc(bytes, 1);
    memcpy(*words, given, bytes);
    char *p = *words;
    for (; argc < n; argc++) {
        argv[argc] = p;
        p += strlen(p) + 1;
    }
    argv[argc++] = out;
    argv[argc++] = frame;
    argv[argc++] = only;
    argv[argc++] = none;
    const int status = sim_options_parse(o, argc, argv);
    free(argv);
    if (status != SIM_OK)
        free(*words);
    return status;
}

/* ---- What is drawn ------------------------------------------------------------------------------ */

static int draw(struct sim_rendered *out, struct sim_kept_scene *scene, const struct sim_model *model,
                const struct sim_options *o)
{
    if (web.name == NULL)
        return sim_refuse(NULL, 0, "there is nothing to draw; choose a scene or a model");
    return web.scene != NULL ? web_scene_draw(out, web.scene, o) : web_model_draw(out, scene, model, o);
}

void web_choose(const struct demo *scene, const char *name, const struct sim_model *model,
                const struct sim_options *chosen, const struct sim_rendered *drawn)
{
    sim_kept_free(&web.kept);
    sim_model_free(&web.model);
    sim_render_free(&web.drawn);
    web.scene = scene;
    web.name = name;
    web.model = *model;
    web.chosen = *chosen;
    web.drawn = *drawn;
}

/* A frame with what is set. */
WEB_EXPORT(render) int web_render(void)
{
    struct sim_rendered drawn;
    struct sim_options o = web.chosen;
    if (o.panel.name != NULL && !web_has_levels(&o) && o.panel.turns == 0) {
        o.panel.name = NULL; /* its glass shows the frame as it is: web_configure has seen that its driver takes it */
        o.has_size = 1;      /* the panel's */
    }
    const int status = draw(&drawn, &web.kept, &web.model, &o);
    if (status == SIM_OK) {
        sim_render_free(&web.drawn);
        web.drawn = drawn;
    }
    return status;
}

/* Its first frame with what is set, which may be refused; then what was drawn before stays. */
WEB_EXPORT(scene) int web_scene(const char *name)
{
    const struct demo *scene = sim_demo_named(name);
    static const struct sim_model none;
    const uint32_t time = web.time;
    struct sim_rendered drawn;
    if (scene == NULL)
        return sim_refuse(NULL, 0, "there is no scene '%s'", name);
    web.time = 0;
    const int status = web_scene_draw(&drawn, scene, &web.options);
    if (status != SIM_OK) {
        web.time = time;
        return status;
    }
    web_choose(scene, scene->name, &none, &web.options, &drawn);
    return SIM_OK;
}

WEB_EXPORT(configure) int web_configure(const char *given, size_t bytes, int n)
{
    struct sim_options o;
    struct sim_rendered drawn;
    char *words;
    int status = parse(&o, &words, given, bytes, n);
    if (status != SIM_OK)
        return status;
    struct sim_options chosen = o;
    struct sim_model model = { 0 };
    const int is_model = web.name != NULL && web.scene == NULL;
    if (is_model)
        status = web_model_load(&model, &chosen);
    if (status == SIM_OK && web.name != NULL)
        status = draw(&drawn, NULL, &model, &chosen);
    if (status != SIM_OK) {
        sim_model_free(&model);
        free(words);
        return status;
    }
    if (web.name != NULL)
        web_choose(web.scene, web.name, &model, &chosen, &drawn);
    free(web.words);
    web.words = words;
    web.options = o;
    web.chosen = chosen;
    return SIM_OK;
}

WEB_EXPORT(orbit) void web_orbit_set(double yaw, double pitch, double distance)
{
    web.orbit = (struct sim_orbit){ yaw, pitch, distance };
}

WEB_EXPORT(time) void web_time(uint32_t frame)
{
    web.time = frame;
}

/* ---- The last frame ----------------------------------------------------------------------------- */

WEB_EXPORT(width) uint32_t web_width(void)
{
    return web.drawn.frame.width;
}

WEB_EXPORT(height) uint32_t web_height(void)
{
    return web.drawn.frame.height;
}

WEB_EXPORT(pixels) const uint16_t *web_pixels(void)
{
    return web.drawn.frame.rgb565;
}

WEB_EXPORT(keys) const uint16_t *web_keys(void)
{
    return web.drawn.frame.no_keys ? NULL : web.drawn.frame.key;
}

/* False colours, [height][width][3]; NULL: none were asked for. */
WEB_EXPORT(shown) const uint8_t *web_shown(void)
{
    return web.drawn.shown.rgb;
}

WEB_EXPORT(shown_width) uint32_t web_shown_width(void)
{
    return web.drawn.shown.width;
}

WEB_EXPORT(shown_height) uint32_t web_shown_height(void)
{
    return web.drawn.shown.height;
}

/* The numbers of zsim render --stats, and those of struct zs_stats by their own names. */
WEB_EXPORT(stats) const char *web_stats(void)
{
    const struct zs_stats *s = &web.drawn.frame.stats;
    const struct {
        const char *name;
        uint32_t value;
    } own[] = {
#define OWN(field) { #field, s->field }
        OWN(clusters_in),    OWN(clusters_culled), OWN(tris_in),           OWN(tris_drawn),
        OWN(tris_frustum),   OWN(tris_cluster),    OWN(tris_near),         OWN(tris_far),
        OWN(tris_offscreen), OWN(tris_facing),     OWN(tris_zero),         OWN(tris_empty),
        OWN(tris_index),     OWN(tris_clipped),    OWN(verts_transformed), OWN(tris_setup),
        OWN(tris_hidden),    OWN(strips_clean),    OWN(strips_skipped),    OWN(max_tris_used),
        OWN(max_verts_used), OWN(pairs),           OWN(pixels_hidden),     OWN(tiles_tested),
#undef OWN
    };
    struct sim_json json;
    sim_json_begin(&json, answer_begin());
    sim_stats_frame(&json, &web.drawn.frame, &web.drawn.config);
    for (size_t i = 0; i < sizeof own / sizeof own[0]; i++)
        sim_json_number(&json, own[i].name, own[i].value);
    if (web.scene == NULL) {
        sim_json_number(&json, "view_near", web.drawn.view.near_z);
        sim_json_number(&json, "view_far", web.drawn.view.far_z);
    }
    if (web.chosen.compare) {
        sim_json_number(&json, "wrong_missing", web.wrong.missing);
        sim_json_number(&json, "wrong_extra", web.wrong.extra);
        sim_json_number(&json, "wrong_color", web.wrong.color);
        sim_json_number(&json, "wrong_one_step", web.wrong.near);
    }
    sim_json_end(&json);
    return answer_end();
}

/* ---- Start -------------------------------------------------------------------------------------- */

WEB_EXPORT(begin) void web_begin(void)
{
    sim_program = "zstrip";
    sim_options_defaults(&web.options);
    web.chosen = web.options;
}
