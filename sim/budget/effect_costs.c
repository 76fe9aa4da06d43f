/* What effects cost, as differences of what make effects-record has measured without accelerators. The record has M0,
 * M3 and RP2040: M4 and M7 take the M3's, rv32imc a fifth more, as they do of what was fitted.
 *
 * Effects of materials are stages of their own (costs.h). Of any other, its pixels, vertices and runs are counted, and
 * what they take beyond the stages is added. Rows of the record are of a card that faces the camera, drawn in the
 * general way; a row "a vertex: ..." is of a sheet of 10 x 7.5 px squares: a vertex has two triangles, in some sixteen
 * runs. What begins a run by normals, filters and shadow maps is therefore a run's, the rest the vertex'.
 *
 * SPDX-License-Identifier: MIT
 */
#include <math.h>
#include <string.h>

#include "costs.h"
#include "record_effects.h"
#include "shader_table.h"
#include "zs_dither.h"
#include "zs_environment.h"
#include "zs_fog.h"
#include "zs_lights.h"
#include "zs_overlay.h"
#include "zs_shadow.h"

#define STARTS_A_VERTEX 2.5 /* triangles set up in strips, to a vertex of the record's sheets, ... */
#define RUNS_A_VERTEX 9.2   /* ... and rows of triangles: 1920 more of 208 more vertices */

static const char *const record_of[SIM_CORES] = { "M0", "M3", "M3", "M3", "M3", "RP2040" };

/* How many instructions a core takes for one of that record's. */
static double times(enum sim_core core)
{
    return core == SIM_CORE_RV32 ? 1.2 : 1.0;
}

static double of(const char *core, const char *name)
{
    for (size_t i = 0; i < sizeof record_effects / sizeof record_effects[0]; i++)
        if (strcmp(record_effects[i].core, core) == 0 && strcmp(record_effects[i].name, name) == 0)
            return record_effects[i].hundred / 100.0;
    return 0.0;
}

/* More by one than by another. */
static double more(const char *core, const char *name, const char *than)
{
    const double d = of(core, name) - of(core, than);
    return d > 0.0 ? d : 0.0;
}

static double on_record(enum sim_core base, const char *core, enum sim_cost cost)
{
    switch ((int)cost) {
    case SIM_COST_lit_vertex:
        return sim_cost_of(base, SIM_COST_light_smooth) + more(core, "a vertex: lit", "a vertex: smooth");
    case SIM_COST_lit_shine:
        return more(core, "a vertex: lit, shining", "a vertex: lit");
    case SIM_COST_lit_face:
        return more(core, "a vertex: lit, shining", "a vertex: smooth");
    case SIM_COST_gloss_vertex:
        return sim_cost_of(base, SIM_COST_light_texture) +
               more(core, "a vertex: gloss, no highlight", "a vertex: texture_smooth");
    case SIM_COST_gloss_start:
        return more(core, "a vertex: texture_gloss", "a vertex: gloss, no highlight") / STARTS_A_VERTEX;
    case SIM_COST_gloss_px:
        return more(core, "texture_gloss", "texture_smooth");
    case SIM_COST_cutout_px:
        return more(core, "cutout_smooth, 4444", "texture_smooth") - more(core, "cutout, hidden", "raw, hidden");
    case SIM_COST_cutout_tested_px:
        return more(core, "cutout, hidden", "raw, hidden");
    case SIM_COST_cutout_pal_px:
        return more(core, "cutout, pal8a", "cutout, 4444");
    case SIM_COST_cutout_run:
        return more(core, "a vertex: cutout_smooth", "a vertex: texture_smooth") / RUNS_A_VERTEX;
    case SIM_COST_blend_px:
        return more(core, "blend_smooth", "smooth");
    case SIM_COST_blend_run:
        return more(core, "a vertex: blend_smooth", "a vertex: smooth") / RUNS_A_VERTEX;
    case SIM_COST_blend_texel_run:
        return more(core, "a vertex: blend_texture_smooth", "a vertex: texture_smooth") / RUNS_A_VERTEX;
    case SIM_COST_add_px:
        return more(core, "add", "blend");
    default:
        return -1.0;
    }
}

double sim_effect_cost(enum sim_core core, enum sim_cost cost)
{
    if (cost < SIM_COST_lit_vertex || cost > SIM_COST_add_px)
        return -1.0;
    return on_record(core == SIM_CORE_RV32 ? SIM_CORE_M3 : core, record_of[core], cost) * times(core);
}

double sim_effects_error(void)
{
    return 30.0;
}

void sim_effects_unknown(struct sim_counted *counted, const char *what)
{
    for (int c = 0; c < SIM_CORES; c++)
        counted->effects[c] = (double)NAN;
    counted->unknown = counted->unknown != NULL ? counted->unknown : what;
}

/* ---- Lamps -------------------------------------------------------------------------------------- */

#define EMPTY_FOG 0.57     /* of fog's work on a pixel: where nothing is drawn, as one frame on the RP2040 has it */
#define FURTHER_NEAR 0.46 /* of what the first lamp at a point takes, which has the pixel placed: a further one */
#define FURTHER 0.15       /* of a vertex lit by one directional lamp: what one more takes */

static const struct zs_lit_material *lit_material(const struct zs_material *m)
{
    return (const struct zs_lit_material *)(const void *)m;
}

static double n_near(const struct zs_lighting *lighting)
{
    double near = 0.0;
    for (uint32_t k = 0; k < lighting->n_lamps; k++)
        near += lighting->lamp[k].kind != ZS_LAMP_DIRECTIONAL;
    return near;
}

/* Of a vertex or a face: what lamps take beyond one directional lamp. */
static double more_lamps(const char *rec, const struct zs_lit_material *lit)
{
    const double dark = of(rec, "a vertex: lit"), bright = of(rec, "a vertex: lit, shining"),
                 near = of(rec, "a vertex: lit, point"), further = lit->lighting->n_lamps - 1.0;
    return n_near(lit->lighting) * (near - dark) +
           further * (FURTHER * (dark - of(rec, "a vertex: smooth")) + (lit->shine != NULL ? bright - dark : 0.0));
}

/* ---- Shaders ------------------------------------------------------------------------------------ */

static int is_shadowed_phong(const struct zs_shader *s)
{
    return s == &zs_shade_shadowed_phong || s == &zs_shade_shadowed_texture_phong;
}

static int is_phong(const struct zs_shader *s)
{
    return s == &zs_shade_phong || s == &zs_shade_phong_near || s == &zs_shade_texture_phong || is_shadowed_phong(s);
}

static int is_shadowed_lit(const struct zs_shader *s)
{
    return s == &zs_shade_shadowed_lit || s == &zs_shade_shadowed_texture;
}

/* Pixels lit one by one, all of them, beyond the depth test: a lamp that reaches none takes little, one that does takes
 * its product, and with highlights a root and a power. */
static double of_lamps(const char *rec, const struct zs_shader *shader, const struct zs_lit_material *lit,
                       const struct sim_effect_work *work)
{
    const double near = n_near(lit->lighting), n = lit->lighting->n_lamps;
    const double reached = more(rec, "phong_near, matt", "phong_near, dark"),
                 bright = more(rec, "phong_near, shining", "phong_near, matt"),
                 further = more(rec, "phong_near, two dark", "phong_near, dark"),
                 first = more(rec, "phong_near, point", "phong_near, shining"), at_point = FURTHER_NEAR * first;
    const int glossy = lit->shine != NULL && (lit->specular.r | lit->specular.g | lit->specular.b) != 0;
    const double a_lamp = work->lit * (reached + (glossy ? bright : 0.0));
    double px = further * (n - 1.0);
    if (is_shadowed_phong(shader)) {
        const double looked_up = more(rec, "shadowed_phong", "shadowed_phong, dark") - reached - bright;
        px += of(rec, "shadowed_phong, dark") + at_point * near +
              (shader == &zs_shade_shadowed_phong ? 0.0
                                                  : of(rec, "shadowed_texture_phong") - of(rec, "shadowed_phong"));
        return px * work->px + a_lamp + looked_up * work->lit;
    }
    if (shader == &zs_shade_phong) {
        const double blocks = work->px - work->single;
        px += of(rec, "phong by two, dark") - further;
        return px * work->single + (blocks > 0.0 ? blocks * of(rec, glossy ? "phong, no highlight" : "phong, matt")
                                                 : a_lamp) +
               (blocks > 0.0 ? work->shiny * more(rec, "phong, shining", "phong, no highlight") : 0.0);
    }
    px += of(rec, shader == &zs_shade_texture_phong ? "texture_phong, dark" : "phong_near, dark") +
          (near > 0.0 ? first + at_point * (near - 1.0) : 0.0);
    return px * work->px + a_lamp;
}

/* The row of a pixel, where that depends on the material. */
static const char *pixel_row(const struct sim_shader_row *shader, const struct zs_material *m)
{
    if (shader->shader == &zs_shade_shadowed_smooth &&
        ((const struct zs_shadowed_material *)(const void *)m)->map->soft)
        return "shadowed_smooth, soft";
    if (is_shadowed_lit(shader->shader) && n_near(lit_material(m)->lighting) > 0.0)
        return shader->shader == &zs_shade_shadowed_lit ? "shadowed_lit, point" : "shadowed_texture, point";
    return shader->pixel[0];
}

/* Of a pixel, what layers and filters of any shader take more. */
static double of_made(const char *rec, const struct sim_shader_made *made)
{
    static const char *const filter[] = { [SIM_KIND_NEAREST] = "texture",
                                          [SIM_KIND_LINEAR] = "bilinear, 8 px a texel",
                                          [SIM_KIND_LEVELS] = "1 px a texel: mipmap",
                                          [SIM_KIND_LEVELS_LINEAR] = "1 px a texel: mipmap_bilinear" };
    const double mixed = more(rec, "a layer of lit", "lit");
    return more(rec, filter[made->filter], "texture") +
           (made->is_dithered ? more(rec, "smooth_ordered", "smooth") : 0.0) +
           (made->is_fogged ? more(rec, "a layer of lit, in fog", "a layer of lit") : 0.0) +
           (made->layer == SIM_LAYER_MIX    ? mixed
            : made->layer == SIM_LAYER_ADD  ? mixed + more(rec, "add", "blend")
            : made->layer == SIM_LAYER_DOOR ? more(rec, "screen-door of lit", "lit")
                                            : 0.0);
}

/* Of a run, what they take more; its begin alone. */
static double run_of_made(const char *rec, const struct sim_shader_made *made)
{
    const char *const layer = made->is_fogged                   ? "a vertex: a layer of lit, in fog"
                              : made->layer == SIM_LAYER_DOOR   ? "a vertex: screen-door of lit"
                              : made->layer != SIM_LAYER_NONE ? "a vertex: a layer of lit"
                                                                : "a vertex: lit";
    return (more(rec, layer, "a vertex: lit") +
            (made->filter != SIM_KIND_NEAREST ? more(rec, "a vertex: bilinear", "a vertex: texture") : 0.0) +
            (made->is_dithered ? more(rec, "a vertex: smooth_ordered", "a vertex: smooth") : 0.0)) /
           RUNS_A_VERTEX;
}

/* Of all its pixels, beyond the depth test and what wins it; fetched: beyond a texture's, which is counted. */
static double of_pixels(enum sim_core core, const struct sim_shader_made *made, const struct zs_material *m,
                        const struct sim_effect_work *work)
{
    const char *const rec = record_of[core];
    const struct sim_shader_row *const row = made->row;
    const double counted = work->fetched ? of(rec, "texture")
                                         : sim_cost_of(core, SIM_COST_px_runs) + sim_cost_of(core, SIM_COST_won_runs);
    const double px = row == NULL           ? of(rec, "a fragment of one's own")
                      : is_phong(made->of) ? 0.0
                                           : of(rec, pixel_row(row, m)) + of(rec, row->pixel[1]) -
                                                 of(rec, row->pixel[2]);
    return work->px * (px + of_made(rec, made) - counted) +
           (row != NULL && is_phong(made->of) ? of_lamps(rec, made->of, lit_material(m), work) : 0.0) +
           work->gloss * more(rec, "texture_gloss", "texture_smooth") +
           work->runs * run_of_made(rec, made);
}

int sim_effects_begin_runs(const struct sim_shader_row *shader)
{
    return shader->vertex != NULL &&
           (is_phong(shader->shader) || is_shadowed_lit(shader->shader) || shader->material == SIM_MATERIAL_SHADOWED ||
            strcmp(shader->vertex, "a vertex: bilinear") == 0);
}

/* Runs to a vertex, of a shader whose row of a vertex is what begins them; 0: it is not. Of light at each pixel and of
 * shadow maps a part of it is what triangles take. */
static double runs_of_vertex(const struct sim_shader_row *shader)
{
    if (shader->vertex != NULL && strcmp(shader->vertex, "a vertex: smooth_ordered") == 0)
        return RUNS_A_VERTEX;
    return !sim_effects_begin_runs(shader)                              ? 0.0
           : strcmp(shader->vertex, "a vertex: bilinear") == 0 ? RUNS_A_VERTEX
                                                                         : 1.3 * RUNS_A_VERTEX;
}

/* Of a vertex, beyond what the plain shader with as many attributes takes. */
static double of_vertex(enum sim_core core, const struct sim_shader_row *shader, const struct zs_material *m)
{
    const char *const rec = record_of[core];
    if (shader->vertex == NULL)
        return 0.0;
    return of(rec, shader->vertex) - of(rec, m->texture != NULL ? "a vertex: texture" : "a vertex: smooth") +
           (shader->material == SIM_MATERIAL_LIT && !is_phong(shader->shader) ? more_lamps(rec, lit_material(m)) : 0.0);
}

void sim_effects_add(struct sim_counted *counted, const struct zs_material *material,
                     const struct sim_effect_work *work)
{
    struct sim_shader_made made;
    sim_shader_made(&made, material->shader);
    if (work->px <= 0.0 && work->vertices <= 0.0)
        return;
    counted->has_effects = 1;
    counted->has_own |= made.row == NULL;
    for (int c = 0; c < SIM_CORES; c++) {
        const enum sim_core core = (enum sim_core)c;
        counted->effects[c] += times(core) * of_pixels(core, &made, material, work);
        if (made.row == NULL) {
            counted->effects[c] += times(core) * work->runs / RUNS_A_VERTEX *
                                   more(record_of[c], "a vertex: a fragment of one's own", "a vertex: smooth");
            continue;
        }
        const double begun = made.of == &zs_shade_phong && work->px > 0.0 ? 1.0 - work->single / work->px : 1.0;
        const double runs = runs_of_vertex(made.row);
        const double vertices = runs > 0.0 ? begun * work->runs / runs : work->vertices;
        counted->effects[c] += times(core) * vertices * of_vertex(core, made.row, material);
    }
}

void sim_effects_add_lamps(struct sim_counted *counted, const struct zs_material *material,
                           const struct sim_effect_work *work)
{
    const struct zs_lighting *const lighting = lit_material(material)->lighting;
    const double lit = material->shader == &zs_shade_lit_face ? work->faces : work->vertices;
    if (lighting->n_lamps != 1 || n_near(lighting) > 0.0)
        counted->has_effects |= lit > 0.0;
    for (int c = 0; c < SIM_CORES; c++)
        counted->effects[c] += times((enum sim_core)c) * lit * more_lamps(record_of[c], lit_material(material));
}

/* ---- Hooks, samples ----------------------------------------------------------------------------- */

static void add_pixels(struct sim_counted *counted, const char *name, double n)
{
    for (int c = 0; c < SIM_CORES; c++)
        counted->effects[c] += times((enum sim_core)c) * n * of(record_of[c], name);
    counted->has_effects = 1;
}

void sim_effects_add_windows(struct sim_counted *counted, double n)
{
    add_pixels(counted, "a pass in windows", n);
}

void sim_effects_add_sky(struct sim_counted *counted, const struct zs_background *sky, double n)
{
    struct zs_sky_gradient none;
    zs_sky_gradient(&none, (const struct zs_rgb[4]){ { 0 } });
    const int own = sky->fill != none.sky.background.fill;
    counted->has_own |= own;
    add_pixels(counted, own ? "a sky of one's own" : "a sky of a gradient", n);
}

void sim_effects_add_mirrored(struct sim_counted *counted, double n)
{
    add_pixels(counted, "a triangle in a mirror", n);
}

/* An overlay: pixels of the rectangles that hold its items. One of a program's own counts as a disc. */
static void add_overlay(struct sim_counted *counted, const struct zs_overlay *overlay)
{
    for (uint32_t i = 0; i < overlay->n; i++) {
        const struct zs_item *item = &overlay->item[i];
        const struct zs_item_kind *kind = item->kind;
        int32_t box[4];
        if (kind == NULL || (kind->check != NULL && kind->check(item) != ZS_OK))
            continue;
        kind->bounds(item, box);
        const int is_disc = kind == &zs_item_arc && item->h == 0;
        const int is_thin = kind == &zs_item_ticks || kind == &zs_item_line || kind == &zs_item_outline;
        add_pixels(counted,
                   kind == &zs_item_fill || kind == &zs_item_bar ? "an overlay's fill"
                   : kind == &zs_item_sprite                     ? "an overlay's sprite"
                   : kind == &zs_item_text                       ? "an overlay's text"
                   : kind == &zs_item_needle                     ? "an overlay's needle"
                   : is_thin                                     ? "an overlay's ticks"
                   : kind == &zs_item_arc && !is_disc            ? "an overlay's ring"
                                                                 : "an overlay's disc",
                   (double)(box[2] - box[0]) * (box[3] - box[1]));
    }
}

void sim_effects_add_hook(struct sim_counted *counted, const struct zs_resolve *hook, double drawn, double all)
{
    const struct zs_dither *d = hook->ctx;
    if (hook->draw == zs_fog_draw)
        add_pixels(counted, "fog", drawn + EMPTY_FOG * (all - drawn));
    else if (hook->draw == zs_dither_draw)
        add_pixels(counted,
                   d->format == &zs_dither_mono    ? "dither to 1 bit"
                   : d->format == &zs_dither_grey4 ? "dither to 16 greys"
                                                   : "dither to rgb332",
                   all);
    else if (hook->draw == zs_overlay_draw)
        add_overlay(counted, hook->ctx);
    else
        sim_effects_unknown(counted, "a drawing over the picture");
}

void sim_effects_add_samples(struct sim_counted *counted, double n)
{
    add_pixels(counted, "4 samples averaged", n);
}
