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
#include "zs_fog.h"
#include "zs_lights.h"
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
        return more(core, "cutout_smooth, 4444", "texture_smooth");
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

#define RUNS_OF_SHEET 16.0 /* to a vertex of it */
#define EMPTY_FOG 0.57     /* of fog's work on a pixel: where nothing is drawn, as one frame on the RP2040 has it */
#define PARALLEL 0.48      /* light at each pixel: by parallel lamps, of one at a point ... */
#define MATT 0.81          /* ... and without highlights, likewise */
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

static int is_phong(const struct zs_shader *s)
{
    return s == &zs_shade_phong || s == &zs_shade_phong_near || s == &zs_shade_texture_phong;
}

static int is_shadowed_lit(const struct zs_shader *s)
{
    return s == &zs_shade_shadowed_lit || s == &zs_shade_shadowed_texture;
}

/* Of a pixel lit by lamps of its own: what they take beyond the shader's row. */
static double pixel_lamps(const char *rec, const struct zs_shader *shader, const struct zs_lit_material *lit,
                          const char *row)
{
    const double more = lit->lighting->n_lamps - 1.0;
    if (shader == &zs_shade_phong)
        return more * (of(rec, "phong, shining") - of(rec, "phong, matt"));
    const double parallel = shader == &zs_shade_texture_phong ? 1.0 : PARALLEL; /* that row is of a parallel lamp */
    const double lamps = n_near(lit->lighting) > 0.0 ? parallel / PARALLEL : parallel;
    return (lamps * (lit->shine != NULL ? 1.0 : MATT) - 1.0) * of(rec, row) +
           more * FURTHER * (of(rec, "a vertex: lit") - of(rec, "a vertex: smooth"));
}

/* The row of a pixel, where that depends on the material. */
static const char *pixel_row(const struct sim_shader_row *shader, const struct zs_material *m)
{
    if (shader->shader == &zs_shade_shadowed_smooth &&
        ((const struct zs_shadowed_material *)(const void *)m)->map->soft)
        return "shadowed_smooth, soft";
    if (is_shadowed_lit(shader->shader) && n_near(lit_material(m)->lighting) > 0.0)
        return shader->shader == &zs_shade_shadowed_lit ? "shadowed_lit, point" : "shadowed_texture, point";
    return shader->shader == &zs_shade_phong && lit_material(m)->shine != NULL ? "phong, shining" : shader->pixel[0];
}

/* Of a pixel, beyond the depth test and what wins it; fetched: beyond a texture's, which is counted. */
static double of_pixel(enum sim_core core, const struct sim_shader_row *shader, const struct zs_material *m,
                       int fetched)
{
    const char *const rec = record_of[core], *row = pixel_row(shader, m);
    return of(rec, row) + of(rec, shader->pixel[1]) - of(rec, shader->pixel[2]) +
           (is_phong(shader->shader) ? pixel_lamps(rec, shader->shader, lit_material(m), row) : 0.0) -
           (fetched ? of(rec, "texture") : sim_cost_of(core, SIM_COST_px_runs) + sim_cost_of(core, SIM_COST_won_runs));
}

int sim_effects_begin_runs(const struct sim_shader_row *shader)
{
    return shader->vertex != NULL &&
           (is_phong(shader->shader) || is_shadowed_lit(shader->shader) || shader->material == SIM_MATERIAL_SHADOWED ||
            strcmp(shader->vertex, "a vertex: bilinear") == 0);
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
    const struct sim_shader_row *shader = sim_shader_row_of(material->shader);
    if (work->px <= 0.0 && work->vertices <= 0.0)
        return;
    if (shader == NULL || shader->pixel[0] == NULL) {
        sim_effects_unknown(counted, shader != NULL ? shader->effect : "a shader of its own");
        return;
    }
    counted->has_effects = 1;
    for (int c = 0; c < SIM_CORES; c++) {
        const enum sim_core core = (enum sim_core)c;
        const double vertices = sim_effects_begin_runs(shader) ? work->runs / RUNS_OF_SHEET : work->vertices;
        counted->effects[c] += times(core) * (work->px * of_pixel(core, shader, material, work->fetched) +
                                              vertices * of_vertex(core, shader, material));
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
    else
        sim_effects_unknown(counted, "a drawing over the picture");
}

void sim_effects_add_samples(struct sim_counted *counted, double n)
{
    add_pixels(counted, "4 samples averaged", n);
}
