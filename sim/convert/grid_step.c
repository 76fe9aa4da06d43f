/* Choosing the grid.
 *
 * With U world units to a model unit, a step of S / 65536 world units is S / K model units, K =
 * 65536 U (256 times that for steps of 1/256). S is a whole number, the mesh's scale. If all
 * coordinates are whole multiples of 1 / K, and differ by multiples of G of them, then every S that
 * divides G loses nothing; the least that still holds the model is taken. Otherwise S is the least
 * that holds the model.
 *
 * SPDX-License-Identifier: MIT
 */
#include "grid_step.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sim.h"
#include "vec.h"
#include "zstrip.h"

#define WORLD_USE 0.98    /* of ZS_WORLD_MAX: room for spheres rounded up */
#define SPAN_LEAST 1000.0 /* world units, of a model whose unit is chosen */
#define SPAN_PLAIN 1e6    /* up to here a unit of 1 is kept */
#define SCALE_LEAST 16.0  /* of 65536: a model below that has too few steps or world units */
#define WASTE_MAX 64.0    /* an exact grid may be that much coarser than the finest */
#define WHOLE_MAX 0x1p52
#define STEPS_LEAST 1024.0 /* across a model that keeps its origin */

/* A model in the places of a lattice, K to a unit. */
struct lattice {
    double per_unit;
    double lo[3], reach; /* reach: what the steps must span from the origin, both ways */
    uint64_t common;     /* G */
};

static uint64_t common_divisor(uint64_t a, uint64_t b)
{
    while (b != 0) {
        const uint64_t rest = a % b;
        a = b;
        b = rest;
    }
    return a;
}

/* 0: some coordinate lies between places. */
static int find_lattice(struct lattice *l, const struct sim_model *model, double per_unit,
                        int keep_origin)
{
    double hi[3] = { 0.0, 0.0, 0.0 };
    l->per_unit = per_unit;
    l->common = 0;
    l->reach = 0.0;
    for (int k = 0; k < 3; k++) {
        l->lo[k] = rint(model->lo[k] * per_unit);
        hi[k] = rint(model->hi[k] * per_unit);
        if (!(fabs(l->lo[k]) < WHOLE_MAX && fabs(hi[k]) < WHOLE_MAX))
            return 0;
        l->reach = fmax(l->reach,
                        keep_origin ? 2.0 * fmax(fabs(l->lo[k]), fabs(hi[k])) : hi[k] - l->lo[k]);
    }
    for (uint32_t i = 0; i < model->n_points; i++)
        for (int k = 0; k < 3; k++) {
            const double p = model->point[i][k], n = rint(p * per_unit), back = n / per_unit;
            if (model->single ? (float)back != (float)p : back < p || back > p)
                return 0;
            l->common = common_divisor(l->common, (uint64_t)fabs(keep_origin ? n : n - l->lo[k]));
        }
    return l->common != 0;
}

/* The least divisor of G that is at least `least` and not wastefully more; 0: none. */
static double exact_scale(const struct lattice *l, double least)
{
    const double g = (double)l->common;
    uint64_t parts = (uint64_t)(g / least);
    const uint64_t fewest = (uint64_t)(g / (least * WASTE_MAX));
    for (; parts > 0 && parts >= fewest; parts--)
        if (l->common % parts == 0)
            return g / (double)parts <= UINT32_MAX ? g / (double)parts : 0.0;
    return 0.0;
}

/* An exact grid for a unit, if there is one. */
static int try_exact(struct sim_steps *s, const struct sim_model *model, double unit,
                     int keep_origin, int fine)
{
    struct lattice l;
    const double per_unit = 65536.0 * unit * (fine ? 256.0 : 1.0);
    if (!find_lattice(&l, model, per_unit, keep_origin))
        return 0;
    const double most = 2.0 * SIM_STEPS_MAX * (fine ? 256.0 : 1.0);
    const double scale = exact_scale(&l, fmax(ceil(l.reach / most), SCALE_LEAST));
    if (scale <= 0.0)
        return 0;
    s->exact = 1;
    s->fine = fine;
    s->scale = (uint32_t)scale;
    s->unit = unit;
    s->lattice = per_unit;
    for (int k = 0; k < 3; k++) {
        const double across = rint(model->hi[k] * per_unit) - l.lo[k];
        s->first[k] = keep_origin ? 0.0 : l.lo[k] + scale * floor(across / scale / 2.0);
        s->origin[k] = s->first[k] / per_unit;
    }
    s->step = scale / (65536.0 * unit);
    return 1;
}

/* The extent that the steps must cover, model units. */
static double span_of(const struct sim_model *model, int keep_origin)
{
    double span = 0.0;
    for (int k = 0; k < 3; k++)
        span = fmax(span, keep_origin ? 2.0 * fmax(fabs(model->lo[k]), fabs(model->hi[k]))
                                      : model->hi[k] - model->lo[k]);
    return span;
}

static double extent_of(const struct sim_model *model)
{
    return span_of(model, 0);
}

/* A value with as few digits as stay within `slack` of it. */
static double brief(double v, double slack)
{
    char text[32];
    for (int digits = 1; digits < 17; digits++) {
        (void)snprintf(text, sizeof text, "%.*g", digits, v);
        if (fabs(strtod(text, NULL) - v) <= slack)
            return strtod(text, NULL);
    }
    return v;
}

/* The finest grid that holds the model. */
static void take_finest(struct sim_steps *s, const struct sim_model *model,
                        const struct sim_steps_want *want)
{
    const double scale =
        ceil(span_of(model, want->keep_origin) * s->unit * 65536.0 / (2.0 * SIM_STEPS_MAX));
    s->exact = 0;
    s->fine = want->fine;
    s->scale = (uint32_t)fmax(scale, 1.0);
    s->step = (double)s->scale / (65536.0 * s->unit);
    for (int k = 0; k < 3; k++)
        s->origin[k] = want->keep_origin ? 0.0
                                         : brief(model->lo[k] + (model->hi[k] - model->lo[k]) / 2.0,
                                                 s->step / (s->fine ? 2048.0 : 8.0));
}

static double power_of_ten(int n)
{
    double power = 1.0;
    for (int i = 0; i < (n < 0 ? -n : n); i++)
        power *= 10.0;
    return n < 0 ? 1.0 / power : power;
}

static double plain_unit(double extent)
{
    int n = 0;
    while (extent * power_of_ten(n) < SPAN_LEAST)
        n++;
    while (extent * power_of_ten(n) > SPAN_PLAIN)
        n--;
    return power_of_ten(n);
}

/* How far from 0,0,0 the mesh reaches, model units. */
static double reach_of(const struct sim_model *model, int keep_origin)
{
    double corner[3];
    for (int k = 0; k < 3; k++)
        corner[k] = keep_origin ? fmax(fabs(model->lo[k]), fabs(model->hi[k]))
                                : (model->hi[k] - model->lo[k]) / 2.0;
    return sqrt(sim_dot(corner, corner));
}

/* Is the unit one that the integers can hold? */
static int check_unit(const struct sim_model *model, const struct sim_steps_want *want, double unit)
{
    const double reach = reach_of(model, want->keep_origin), extent = extent_of(model);
    const double most = WORLD_USE * ZS_WORLD_MAX;
    if (reach * unit > most)
        return sim_refuse(
            model->file, 0,
            "with %g world units to a unit the model reaches %.3g; the world ends at %.3g: "
            "give --unit %.3g or less%s",
            unit, reach * unit, most, 0.995 * most / reach, /* printed with three digits, it is below most / reach */
            want->keep_origin && reach_of(model, 0) * unit <= most ? ", or --center yes" : "");
    if (extent * unit * 65536.0 < SCALE_LEAST * 2.0 * SIM_STEPS_MAX)
        return sim_refuse(
            model->file, 0,
            "with %g world units to a unit the model is only %.3g wide; give --unit %.3g or more",
            unit, extent * unit, SPAN_LEAST / extent);
    return SIM_OK;
}

int sim_steps_choose(struct sim_steps *out, const struct sim_model *model,
                     const struct sim_steps_want *want)
{
    const double unit = want->unit > 0.0 ? want->unit : plain_unit(extent_of(model));
    const int status = check_unit(model, want, unit);
    memset(out, 0, sizeof *out);
    if (status != SIM_OK)
        return status;
    for (int fine = 0; fine <= want->fine; fine++)
        for (double times = 1.0; times <= 100.0; times *= 10.0) {
            if (times > 1.0 &&
                (want->unit > 0.0 || unit < 1.0 ||
                 reach_of(model, want->keep_origin) * unit * times > WORLD_USE * ZS_WORLD_MAX))
                break;
            if (try_exact(out, model, unit * times, want->keep_origin, fine))
                return SIM_OK;
        }
    out->unit = unit;
    take_finest(out, model, want);
    if (extent_of(model) / out->step * (out->fine ? 256.0 : 1.0) >= STEPS_LEAST)
        return SIM_OK;
    return sim_refuse(
        model->file, 0,
        "the model is so far from its origin that it would be %.3g steps wide; give --center yes",
        extent_of(model) / out->step);
}

void sim_steps_place(int32_t out[3], const struct sim_steps *s, const double position[3])
{
    const double per_step = s->fine ? 256.0 : 1.0;
    for (int k = 0; k < 3; k++) {
        const double n = s->exact
                             ? (rint(position[k] * s->lattice) - s->first[k]) / (double)s->scale
                             : rint((position[k] - s->origin[k]) / s->step * per_step);
        const double most = SIM_STEPS_MAX * per_step;
        out[k] = (int32_t)(fmin(fmax(n, -most), most) * (256.0 / per_step));
    }
}

void sim_steps_position(double out[3], const struct sim_steps *s, const int32_t place[3])
{
    const double per_step = s->fine ? 256.0 : 1.0;
    for (int k = 0; k < 3; k++) {
        const double n = place[k] / (256.0 / per_step);
        out[k] = s->exact ? (s->first[k] + n * (double)s->scale) / s->lattice
                          : s->origin[k] + n * s->step / per_step;
    }
}
