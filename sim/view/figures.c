/* A budget's request from what is seen.
 *
 * SPDX-License-Identifier: MIT
 */
#include "figures.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "line_style.h"
#include "sim.h"
#include "value.h"

/* The words of `zsim demo` that a budget knows, too. */
static void of_scene(struct budget_request *rq, const struct view_shot *shot)
{
    const char *strip = view_words_get(&shot->words, "--strip"), *start = view_words_get(&shot->words, "--start");
    const char *method = view_words_get(&shot->words, "--method");
    const char *size = view_words_get(&shot->words, "--size");
    rq->o.fast_names = view_words_get(&shot->words, "--fast");
    rq->scene = view_words_get(&shot->words, "--scene");
    rq->frame = start != NULL ? atol(start) : 0;
    rq->orbit = view_scene_orbit(&shot->words);
    rq->o.strip = strip != NULL ? atol(strip) : 24;
    for (int k = 0; method != NULL && k < (int)SIM_METHODS; k++)
        if (strcmp(sim_methods[k].name, method) == 0)
            rq->o.method = k;
    if (view_words_get(&shot->words, "--panel") != NULL) {
        rq->o.has_size = 1;
        rq->o.size[0] = shot->seen.shown.width;
        rq->o.size[1] = shot->seen.shown.height;
    } else if (size != NULL && sim_value_size(size, rq->o.size)) {
        rq->o.has_size = 1;
    }
}

void view_figures_count(struct view_figures *f, const struct view_shot *shot)
{
    struct budget_request *rq = sim_alloc(1, sizeof *rq);
    struct budget *b = sim_alloc(1, sizeof *b);
    const int of_model = shot->words.model != NULL;
    memset(f, 0, sizeof *f);
    budget_defaults(rq);
    if (of_model)
        rq->o = shot->o;
    else
        of_scene(rq, shot);
    rq->quiet = 1;
    rq->has_tris = view_words_get(&shot->words, "--tris") != NULL;
    rq->has_verts = view_words_get(&shot->words, "--verts") != NULL;
    sim_quiet++;
    rq->kept = shot->kept;
    int status = of_model ? budget_model(b, rq, &shot->model) : budget_scene(b, rq);
    if (status == SIM_OK)
        status = budget_take(b, rq);
    sim_quiet--;
    if (status == SIM_OK) {
        f->known = 1;
        f->plain = of_model && shot->o.style != SIM_STYLE_SOLID;
        f->ram = b->ram;
    }
    for (int i = 0; status == SIM_OK && i < BUDGET_USUAL_PARTS; i++) {
        const struct budget_part *p = budget_part_named(budget_usual_parts[i]);
        const enum budget_cpu cpu = budget_cpu_of(p->core);
        f->fps[i] = 1e6 * p->mhz / budget_cycles(rq, b, p->core);
        if (isfinite(f->fps[i]))
            f->error = fmax(f->error, ceil(budget_error(b, p->core)));
        f->too_small[i] = budget_ram_on(&b->ram, p->core) > p->ram ||
                          (budget_of_all(rq) && b->flash[cpu].total > p->flash);
    }
    SIM_FREE(rq, b);
}
