/* RAM, flash and frames a second on the parts of zsim budget; what is wrong with a picture; the files of zsim convert.
 *
 * SPDX-License-Identifier: MIT
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "answer.h"
#include "budget.h"
#include "convert.h"
#include "demo_frame.h"
#include "engine.h"
#include "explanation.h"
#include "sim.h"

/* ---- Budget ------------------------------------------------------------------------------------- */

static int draw(struct sim_rendered *out, const struct sim_options *o)
{
    return web.scene != NULL ? web_scene_draw(out, web.scene, o)
                             : web_model_draw(out, NULL, &web.model, o);
}

static int count(struct budget *b, struct budget_request *rq)
{
    memset(b, 0, sizeof *b);
    b->method = &sim_methods[rq->o.method];
    const int status = web.scene != NULL ? budget_scene(b, rq) : budget_model(b, rq, &web.model);
    if (status != SIM_OK)
        return status;
    return budget_take(b, rq);
}

static void put_number(FILE *f, const char *name, double value)
{
    (void)fprintf(f, ",\"%s\":", name);
    if (isfinite(value))
        (void)fprintf(f, "%.9g", value);
    else
        (void)fputs("null", f);
}

static void put_pools(FILE *f, const struct budget *b)
{
    const struct budget_ram *r = &b->ram;
    const struct {
        const char *name;
        uint32_t bytes;
    } pools[] = {
        { "strip buffers", r->color },      { "depth keys", r->depth },
        { "hidden tiles", r->tiles },       { "bins", r->bins },
        { "triangles", r->tris },           { "vertices", r->verts },
        { "vertex numbers", r->numbers },   { "vertex attributes", r->attrs },
        { "renderer", r->renderer },        { "scene and camera", r->scene },
        { "panel", r->panel + r->scratch }, { "stack", r->stack[BUDGET_M3] },
    };
    const char *comma = "";
    (void)fputs("\"ram\":{\"pools\":[", f);
    for (size_t i = 0; i < sizeof pools / sizeof pools[0]; i++) {
        if (pools[i].bytes == 0)
            continue;
        (void)fprintf(f, "%s{\"name\":\"%s\",\"bytes\":%u}", comma, pools[i].name,
                      (unsigned)pools[i].bytes);
        comma = ",";
    }
    (void)fprintf(f, "],\"arena\":%u,\"total\":%u}", (unsigned)r->arena,
                  (unsigned)r->total[BUDGET_M3]);
}

static void put_part(FILE *f, const struct budget_request *rq, const struct budget *b,
                     const struct budget_part *p, int piece)
{
    const struct sim_counted *n = &b->counted;
    const int effects = piece || (web.scene == NULL && sim_effects_any(&rq->o.effects));
    const double wire = budget_wire_ms(rq, b, p);
    struct budget_totals t;
    budget_totals(&t, rq, b, p->core, p->mhz, wire);
    t.flash = effects || !budget_of_all(rq) ? (double)NAN : t.flash;
    (void)fprintf(f, "{\"name\":\"%s\",\"core\":\"%s\",\"text\":", p->name,
                  sim_core_names[p->core]);
    answer_text(f, p->text);
    put_number(f, "mhz", p->mhz);
    put_number(f, "ramBytes", p->ram);
    put_number(f, "flashBytes", p->flash);
    put_number(f, "ramUsed", t.ram);
    put_number(f, "flashUsed", t.flash);
    put_number(f, "drawMs", t.draw_ms);
    put_number(f, "wireMs", wire);
    put_number(f, "fps", isnan(t.draw_ms) ? (double)NAN : t.fps);
    put_number(f, "fpsError", budget_error(b, p->core) / 100.0);
    (void)fprintf(f, ",\"limit\":\"%s\",\"ramFits\":%s,\"flashFits\":%s",
                  wire > t.draw_ms ? "wire" : "drawing", t.ram <= p->ram ? "true" : "false",
                  t.flash > p->flash ? "false" : "true");
    if (!budget_of_all(rq))
        (void)fputs(",\"why\":\"Time and flash are known only of all accelerators together.\"", f);
    else if (isnan(t.draw_ms) && n->unknown != NULL)
        (void)fprintf(f, ",\"why\":\"Not known: what %s takes was not measured.\"", n->unknown);
    else if (isnan(t.draw_ms))
        (void)fputs(",\"why\":\"Of numbers alone there is no estimate for this method.\"", f);
    (void)fputs("}", f);
}

/* What a frame takes on every part, through a panel ("": that of the options) that is turned by so many times 90
 * degrees. NULL: it is refused. */
WEB_EXPORT(figures) const char *web_figures(const char *panel, int turns)
{
    static struct budget_request rq;
    static struct budget b;
    budget_defaults(&rq);
    rq.quiet = 1;
    rq.kept = &web.kept;
    rq.o = web.chosen;
    rq.has_tris = rq.o.tris > 0;
    rq.has_verts = rq.o.verts > 0;
    if (web.scene != NULL) {
        rq.scene = web.scene->name;
        rq.frame = (long)(web.time % web.scene->frames);
        rq.orbit = web.orbit;
    }
    if (panel[0] != '\0' && rq.o.panel.name == NULL) {
        struct pm_glass glass;
        rq.o.panel.name = panel;
        rq.o.panel.turns = turns;
        if (sim_panel_glass(&rq.o.panel, NULL, &glass) != SIM_OK)
            return NULL;
        rq.o.spi_hz = sim_panel_hz(panel, SIM_PANEL_HZ);
    }
    const int piece = web.scene != NULL && sim_demo_piece(web.scene) != NULL;
    if (web.name == NULL || count(&b, &rq) != SIM_OK)
        return NULL;
    FILE *f = answer_begin();
    (void)fputs("{", f);
    put_pools(f, &b);
    (void)fputs(",\"parts\":[", f);
    for (uint32_t i = 0; i < n_budget_parts; i++) {
        (void)fputs(i > 0 ? "," : "", f);
        put_part(f, &rq, &b, &budget_parts[i], piece);
    }
    (void)fputs("]}", f);
    return answer_end();
}

/* ---- Sentences ---------------------------------------------------------------------------------- */

/* What is wrong with the picture, a sentence a line on stderr. */
WEB_EXPORT(explain) void web_explain(void)
{
    struct sim_rendered drawn;
    struct sim_options o = web.chosen;
    o.explain = 1;
    if (web.name == NULL)
        return;
    if (draw(&drawn, &o) == SIM_OK)
        sim_render_free(&drawn);
}

/* ---- Files -------------------------------------------------------------------------------------- */

/* The model as const C, by the arguments of zsim convert: {"h": text, "c": text}. NULL: it is refused. */
WEB_EXPORT(convert) const char *web_convert(const char *given, size_t bytes, int n)
{
    struct sim_conversion *c = sim_alloc(1, sizeof *c);
    char **argv = sim_alloc((size_t)n, sizeof *argv),
         *words = memcpy(sim_alloc(bytes, 1), given, bytes), *p = words;
    const char *answer = NULL;
    for (int i = 0; i < n; i++) {
        argv[i] = p;
        p += strlen(p) + 1;
    }
    int status = web.name == NULL || web.scene != NULL
                     ? sim_refuse(
                           NULL, 0,
                           "files are made of a model; demo scenes have theirs in the repository")
                     : sim_convert_parse(&c->options, n, argv);
    if (status == SIM_OK)
        status = sim_convert_load(&c->model, &c->options);
    if (status == SIM_OK)
        status = sim_converted_make(&c->made, &c->model, &c->options);
    if (status == SIM_OK) {
        char *text[2] = { NULL, NULL };
        size_t size;
        for (int i = 0; i < 2; i++) {
            FILE *f = open_memstream(&text[i], &size);
            (i == 0 ? sim_convert_header : sim_convert_source)(f, c);
            (void)fclose(f);
        }
        FILE *f = answer_begin();
        (void)fputs("{\"h\":", f);
        answer_text(f, text[0]);
        (void)fputs(",\"c\":", f);
        answer_text(f, text[1]);
        (void)fputs("}", f);
        answer = answer_end();
        SIM_FREE(text[0], text[1]);
    }
    sim_converted_free(&c->made);
    sim_model_free(&c->model);
    free(c->options.command);
    SIM_FREE(c, argv, words);
    return answer;
}
