/* Texts of options that have parts, TYPE:VALUE:VALUE.
 *
 * SPDX-License-Identifier: MIT
 */
#include "effect_options.h"

#include <math.h>
#include <string.h>

#include "sim.h"
#include "value.h"

#define PARTS_MAX 5
#define TEXT_MAX 127

/* A text, cut at its colons. */
struct parts {
    char text[TEXT_MAX + 1];
    const char *part[PARTS_MAX];
    int n; /* 0: it is too long, has too many parts, or an empty one */
};

/* Return 0: there is no text, which is NULL then. */
static int parts_of(struct parts *p, const char *text)
{
    p->n = 0;
    if (text == NULL)
        return 0;
    if (strlen(text) > TEXT_MAX)
        return 1;
    strcpy(p->text, text);
    for (char *at = p->text; at != NULL;) {
        char *colon = strchr(at, ':');
        if (p->n == PARTS_MAX || *at == '\0' || colon == at) {
            p->n = 0;
            return 1;
        }
        if (colon != NULL)
            *colon++ = '\0';
        p->part[p->n++] = at;
        at = colon;
    }
    return 1;
}

static int take_number(const char *text, double *out)
{
    const char *end;
    return sim_value_double(text, '\0', &end, out) && isfinite(*out);
}

static int take_vector(const char *text, double v[3])
{
    const char *end;
    return sim_value_double(text, ',', &end, &v[0]) && sim_value_double(end + 1, ',', &end, &v[1]) &&
           sim_value_double(end + 1, '\0', &end, &v[2]) && isfinite(v[0]) && isfinite(v[1]) && isfinite(v[2]);
}

/* ---- Lights ---------------------------------------------------------------------------------------------------- */

static int take_light(struct sim_effect_options *e, const char *text, const char *file)
{
    struct parts p;
    (void)parts_of(&p, text);
    struct sim_light light = { .rgb = ZS_RGB(0xffffff) };
    const int kind = p.n > 0 ? sim_value_choice(p.part[0], "dir|point|spot") : -1;
    if (kind < 0 || p.n < 2 || p.n > 4 || !take_vector(p.part[1], light.at) ||
        (p.n > 2 && !sim_value_rgb(p.part[2], &light.rgb)) || (p.n > 3 && !take_number(p.part[3], &light.range)))
        return sim_usage("--light wants x,y,z or TYPE:X,Y,Z[:RRGGBB[:RANGE]] with TYPE dir, point or spot, not '%s'",
                         text);
    light.kind = (enum sim_light_kind)kind;
    if (e->n_lights == SIM_LIGHTS_MAX)
        return sim_refuse(file, 0, "--light %s: there are at most %d lights", text, SIM_LIGHTS_MAX);
    if (kind == SIM_LIGHT_DIR && light.at[0] == 0.0 && light.at[1] == 0.0 && light.at[2] == 0.0)
        return sim_refuse(file, 0, "--light %s has no direction", text);
    if (kind == SIM_LIGHT_DIR && p.n > 3)
        return sim_refuse(file, 0, "--light %s: a directional light has no range; leave it out", text);
    if (p.n > 3 && light.range <= 0.0)
        return sim_refuse(file, 0, "--light %s: the range must be more than 0; leave it out for none", text);
    e->light[e->n_lights++] = light;
    return SIM_OK;
}

static int take_lights(struct sim_effect_options *e, double plain[3], int *has_plain, const char *file)
{
    int status = SIM_OK;
    for (int k = 0; status == SIM_OK && k < e->light_texts.n; k++) {
        const char *text = e->light_texts.text[k];
        if (strchr(text, ':') != NULL)
            status = take_light(e, text, file);
        else if (!take_vector(text, plain))
            status = sim_usage(
                "--light wants x,y,z or TYPE:X,Y,Z[:RRGGBB[:RANGE]] with TYPE dir, point or spot, not '%s'", text);
        else
            *has_plain = 1;
    }
    return status;
}

/* ---- The rest -------------------------------------------------------------------------------------------------- */

static int take_specular(struct sim_effect_options *e, const char *file)
{
    struct parts p;
    if (!parts_of(&p, e->specular_text))
        return SIM_OK;
    const char *end;
    if (p.n != 2 || !sim_value_long(p.part[0], &end, &e->specular_power) || *end != '\0' ||
        !take_number(p.part[1], &e->specular_strength))
        return sim_usage("--specular wants POWER:STRENGTH, as 20:0.5, not '%s'", e->specular_text);
    if (e->specular_power < 1 || e->specular_power > 128)
        return sim_refuse(file, 0, "--specular %s: the power is outside its range, 1 to 128", e->specular_text);
    if (e->specular_strength < 0.0 || e->specular_strength > 1.0)
        return sim_refuse(file, 0, "--specular %s: the strength is outside its range, 0 to 1", e->specular_text);
    return SIM_OK;
}

static int take_fog(struct sim_effect_options *e, const char *file)
{
    struct parts p;
    if (!parts_of(&p, e->fog_text))
        return SIM_OK;
    const int kind = p.n > 0 ? sim_value_choice(p.part[0], "linear|exp") : -1;
    const int linear = kind == 0 && p.n == 4 && take_number(p.part[1], &e->fog_start) &&
                       take_number(p.part[2], &e->fog_end);
    const int exponential = kind == 1 && p.n == 3 && take_number(p.part[1], &e->fog_density);
    if ((!linear && !exponential) || !sim_value_rgb(p.part[p.n - 1], &e->fog_rgb))
        return sim_usage("--fog wants linear:START:END:RRGGBB or exp:DENSITY:RRGGBB, not '%s'", e->fog_text);
    if (linear && (e->fog_start < 0.0 || e->fog_end <= e->fog_start))
        return sim_refuse(file, 0, "--fog %s: it must begin at 0 or beyond, and end after it begins", e->fog_text);
    if (exponential && e->fog_density <= 0.0)
        return sim_refuse(file, 0, "--fog %s: the density must be more than 0", e->fog_text);
    e->fog = linear ? SIM_FOG_LINEAR : SIM_FOG_EXP;
    return SIM_OK;
}

void sim_effects_defaults(struct sim_effect_options *e)
{
    memset(e, 0, sizeof *e);
    e->alpha = 1.0;
    e->samples = 1;
}

int sim_effects_take(struct sim_effect_options *e, double plain[3], int *has_plain, const char *file)
{
    int status = take_lights(e, plain, has_plain, file);
    status = status == SIM_OK ? take_specular(e, file) : status;
    return status == SIM_OK ? take_fog(e, file) : status;
}

int sim_effects_floor(const struct sim_effect_options *e)
{
    return e->shadow != SIM_SHADOW_NONE || e->mirror;
}

int sim_effects_any(const struct sim_effect_options *e)
{
    return e->n_lights > 0 || e->specular_text != NULL || e->per_pixel || e->has_alpha || e->has_blend ||
           e->filter != SIM_FILTER_NEAREST || e->samples > 1 || e->fog != SIM_FOG_NONE ||
           e->dither != SIM_DITHER_NONE || e->shadow != SIM_SHADOW_NONE || e->environment != NULL || e->mirror;
}

const char *sim_effects_unreferenced(const struct sim_effect_options *e)
{
    return e->has_alpha && e->blend == SIM_BLEND_SCREEN_DOOR ? "--blend screen-door"
           : e->samples > 1                    ? "--samples 4"
           : e->dither != SIM_DITHER_NONE      ? "--dither"
           : e->shadow == SIM_SHADOW_PLANAR    ? "--shadow planar"
           : e->shadow == SIM_SHADOW_MAP       ? "--shadow map"
           : e->environment != NULL            ? "--environment"
           : e->mirror                         ? "--mirror"
                                               : NULL;
}
