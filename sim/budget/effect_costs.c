/* What effects cost, one of each, as differences of what make effects-record has measured without accelerators. The
 * record has M0, M3 and RP2040: M4 and M7 take the M3's, rv32imc a fifth more, as they do of what was fitted.
 *
 * SPDX-License-Identifier: MIT
 */
#include <string.h>

#include "costs.h"
#include "record_effects.h"

#define STARTS_A_VERTEX 2.5 /* triangles set up in strips, to a vertex of the record's sheets, ... */
#define RUNS_A_VERTEX 9.2   /* ... and rows of triangles: 1920 more of 208 more vertices */

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
    default:
        return -1.0;
    }
}

double sim_effect_cost(enum sim_core core, enum sim_cost cost)
{
    static const char *const names[SIM_CORES] = { [SIM_CORE_M0] = "M0", [SIM_CORE_RP2040] = "RP2040" };
    if (cost < SIM_COST_lit_vertex || cost > SIM_COST_blend_texel_run)
        return -1.0;
    if (names[core] != NULL)
        return on_record(core, names[core], cost);
    return on_record(SIM_CORE_M3, "M3", cost) * (core == SIM_CORE_RV32 ? 1.2 : 1.0);
}
