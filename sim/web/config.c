/* What is set, as a header that a program includes: a renderer with these pools, its mapping, method and accelerators.
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdlib.h>

#include "answer.h"
#include "budget.h"
#include "engine.h"
#include "sim.h"

static const char *depth_name(const struct zs_depth *depth)
{
    if (depth == &zs_depth_none || depth == &zs_depth_order) /* of methods without depth memory */
        return depth == &zs_depth_none ? "none" : "order";
    const int asked = web.chosen.depth, usual = asked == SIM_DEPTH_DEFAULT || asked == SIM_DEPTH_float;
    for (size_t i = 0; i < SIM_DEPTH_DEFAULT; i++)
        if (sim_depths[i].depth == depth && !(usual && web.scene == NULL && !sim_depths[i].any_camera)) /* float's */
            return sim_depths[i].name;
    return "float";
}

static void put_setting(FILE *f, const char *name, unsigned value, unsigned usual)
{
    if (value != 0 && value != usual)
        (void)fprintf(f, "    screen_config.%s = %u;\n", name, value);
}

static void put_head(FILE *f, const struct zs_config *c, const struct sim_method *method)
{
    (void)fprintf(f, "/* The renderer as it is set in zstrip's page, for %s", web.name);
    if (web.chosen.panel.name != NULL)
        (void)fprintf(f, " on %s", web.chosen.panel.name);
    (void)fputs(".\n"
                " * Include it in one file, and call screen_begin() once, before zs_render(&screen, ...): it returns\n"
                " * ZS_OK, or an error that zs_error_string names.\n",
                f);
    if (c->varyings > 3)
        (void)fprintf(f, " * Compile the library and your files with -DZS_VARYINGS_MAX=%u.\n", (unsigned)c->varyings);
    (void)fprintf(f, " */\n#include \"zstrip.h\"\n#include \"zs_fast.h\"\n%s\n",
                  method->method != NULL ? "#include \"zs_method.h\"\n" : "");
}

/* zs_config of what was drawn last; pools: those that are set, or for one pass. NULL: it is refused. */
WEB_EXPORT(config) const char *web_config(void)
{
    static struct budget_request rq;
    static struct budget b;
    const struct sim_method *method = &sim_methods[web.chosen.method];
    budget_defaults(&rq);
    rq.o = web.chosen;
    rq.has_tris = rq.o.tris > 0;
    rq.has_verts = rq.o.verts > 0;
    if (web.name == NULL || web.drawn.frame.width == 0) {
        (void)sim_refuse(NULL, 0, "there is nothing to configure; choose a scene or a model");
        return NULL;
    }
    if (web.scene == NULL && web.chosen.effects.samples > 1) {
        (void)sim_refuse(web.name, 0,
                         "four samples a pixel are a renderer of twice the size each way: see zs_supersample.h");
        return NULL;
    }
    budget_frame(&b, &rq, &web.drawn.config, &web.drawn.frame.stats);
    const struct zs_config *c = &b.config;
    FILE *f = answer_begin();
    put_head(f, c, method);
    (void)fprintf(f, "ZS_RENDERER_BUFFERS(screen, %u, %u, %u, %u, %u, %u, %u);\n\n", (unsigned)c->width,
                  (unsigned)c->height, (unsigned)c->strip_h,
                  (unsigned)(rq.has_tris ? c->max_tris : sim_method_pool(method, c->max_tris)), (unsigned)c->max_verts,
                  (unsigned)c->varyings, (unsigned)c->buffers);
    (void)fprintf(f, "static inline int screen_begin(void)\n{\n"
                     "    static const struct zs_fast *const fast[] = { ZS_FAST_ALL, ZS_FAST_END };\n"
                     "    screen_config.depth = &zs_depth_%s;\n"
                     "    screen_config.fast = fast;\n", depth_name(c->depth));
    if (method->method != NULL)
        (void)fprintf(f, "    screen_config.method = &zs_method_%s;\n", method->name);
    put_setting(f, "subpixel_bits", c->subpixel_bits, 8);
    put_setting(f, "depth_bits", c->depth_bits, 16);
    (void)fputs("    return ZS_INIT(screen);\n}\n", f);
    return answer_end();
}
